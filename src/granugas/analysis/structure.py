"""How unevenly disks fill a periodic box, and on which length."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

Numbers = NDArray[np.float64]


def density_field(positions: ArrayLike, box: ArrayLike, parts: int) -> Numbers:
    """(parts, parts) number density in equal cells by its mean, from positions (n, 2) in a box (2,)."""
    cell = cells_of(positions, box, parts)
    counts = np.bincount(cell[:, 0] * parts + cell[:, 1], minlength=parts**2)
    return counts.reshape(parts, parts) * (parts**2 / len(cell))


def density_variance(positions: ArrayLike, box: ArrayLike, parts: int) -> float:
    """Variance of the density in parts x parts cells by its mean squared: 0 if even, parts^2/n for n points at random."""
    return float(density_field(positions, box, parts).var())


def density_at(positions: ArrayLike, box: ArrayLike, parts: int) -> Numbers:
    """(n,) density, by its mean, in the cell of each particle."""
    cell = cells_of(positions, box, parts)
    return density_field(positions, box, parts)[cell[:, 0], cell[:, 1]]


def structure_length(positions: ArrayLike, box: ArrayLike, parts: int) -> float:
    """Mean wavelength of the density, sum |rho_k|^2 / sum |k/2 pi| |rho_k|^2 over the modes of parts x parts cells.

    In the unit of the box. Sharp edges of clusters keep it well below their distances.
    """
    power, wave_number = _spectrum(positions, box, parts)
    return float(power.sum() / (power * wave_number).sum())


def strongest_wavelength(positions: ArrayLike, box: ArrayLike, parts: int) -> float:
    """Wavelength at which the density varies most: of the strongest of the shells |k| sqrt(V)/2 pi = 1, 2 ... (rounded).

    In units of sqrt(V): 1 where the structure is as large as the box, 1/2 where it repeats itself once along a side.
    """
    power, wave_number = _spectrum(positions, box, parts)
    shell = np.rint(wave_number * np.sqrt(np.prod(box))).astype(int)
    shell[0, 0] = 0
    inside = shell <= parts // 2
    count = np.bincount(shell[inside])
    strength = np.bincount(shell[inside], power[inside]) / np.maximum(count, 1)
    return 1 / float(1 + strength[1:].argmax())


def structure_factor(positions: ArrayLike, box: ArrayLike, parts: int) -> tuple[Numbers, Numbers]:
    """S(k) = |sum_i exp(i k r_i)|^2 / N, averaged over the directions of k: 1 for points at random.

    Args:
        positions: (n, 2) in m.
        box: sides in m.
        parts: cells along each side; what is shorter than four of them is left out, where the cells would be seen.

    Returns:
        k = 2 pi j / sqrt(V) in 1/m for the shells j = 1, 2 ... parts/4 (rounded), and S(k); NaN where a shell of a long box
        has no mode.
    """
    power, wave_number = _spectrum(positions, box, parts)
    unit = np.sqrt(np.prod(box))
    shell = np.rint(wave_number * unit).astype(int).ravel()
    modes = np.bincount(shell)
    strength = np.bincount(shell, power.ravel()) * len(positions) / parts**4
    with np.errstate(invalid="ignore", divide="ignore"):
        return 2 * np.pi / unit * np.arange(1, parts // 4 + 1), (strength / modes)[1 : parts // 4 + 1]


def mean_wavelength(k: Numbers, strength: Numbers, shortest: float) -> float:
    """2 pi / <k>, <k> = sum k S(k) / sum S(k) over wavelengths of at least `shortest`: the length of the structure factor.

    Args:
        k, strength: as `structure_factor` returns them, lengths in any unit.
        shortest: what is shorter is the order of neighbours, not of clusters.
    """
    kept = (k <= 2 * np.pi / shortest * (1 + 1e-9)) & ~np.isnan(strength)
    return float(2 * np.pi * strength[kept].sum() / (k * strength)[kept].sum())


def pair_correlation(positions: ArrayLike, box: ArrayLike, edges: ArrayLike) -> Numbers:
    """g(r): pairs at a distance, by how many there are among points without any order, in two dimensions.

    Args:
        positions: (n, 2) in the periodic box.
        box: (2,) its sides.
        edges: (m + 1,) ascending, of bins of the distance, at most half a side.

    Returns:
        (m,), for each bin; all pairs are looked at, so n should be some thousand at most.
    """
    place, sides, edges = np.asarray(positions, float), np.asarray(box, float), np.asarray(edges, float)
    n, counts = len(place), np.zeros(len(edges) - 1)
    for k in range(n - 1):
        apart = place[k + 1 :] - place[k]
        apart -= sides * np.round(apart / sides)
        counts += np.histogram(np.hypot(*apart.T), edges)[0]
    return counts / (n * (n - 1) / 2 * np.pi * np.diff(edges**2) / sides.prod())


def cells_of(positions: ArrayLike, box: ArrayLike, parts: int) -> NDArray[np.int64]:
    """(n, 2) column and row of the cell of each particle, periodic images included."""
    return np.floor(np.asarray(positions) / np.asarray(box) * parts).astype(int) % parts


def _spectrum(positions: ArrayLike, box: ArrayLike, parts: int) -> tuple[Numbers, Numbers]:
    """|rho_k|^2 without the mean, and |k|/2 pi."""
    power = np.abs(np.fft.fft2(density_field(positions, box, parts))) ** 2
    power[0, 0] = 0
    index = np.fft.fftfreq(parts, 1 / parts)
    return power, np.hypot(index[:, np.newaxis] / box[0], index / box[1])
