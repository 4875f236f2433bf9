"""How unevenly disks fill a periodic box, and on which length."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

Numbers = NDArray[np.float64]


def density_field(positions: ArrayLike, box: ArrayLike, parts: int) -> Numbers:
    """(parts, parts) number density in equal cells by its mean, from positions (n, 2) in a box (2,)."""
    cell = _cells(positions, box, parts)
    counts = np.bincount(cell[:, 0] * parts + cell[:, 1], minlength=parts**2)
    return counts.reshape(parts, parts) * (parts**2 / len(cell))


def density_variance(positions: ArrayLike, box: ArrayLike, parts: int) -> float:
    """Variance of the density in parts x parts cells by its mean squared: 0 if even, parts^2/n for n points at random."""
    return float(density_field(positions, box, parts).var())


def density_at(positions: ArrayLike, box: ArrayLike, parts: int) -> Numbers:
    """(n,) density, by its mean, in the cell of each particle."""
    cell = _cells(positions, box, parts)
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


def _cells(positions: ArrayLike, box: ArrayLike, parts: int) -> NDArray[np.int64]:
    """(n, 2) column and row of the cell of each particle, periodic images included."""
    return np.floor(np.asarray(positions) / np.asarray(box) * parts).astype(int) % parts


def _spectrum(positions: ArrayLike, box: ArrayLike, parts: int) -> tuple[Numbers, Numbers]:
    """|rho_k|^2 without the mean, and |k|/2 pi."""
    power = np.abs(np.fft.fft2(density_field(positions, box, parts))) ** 2
    power[0, 0] = 0
    index = np.fft.fftfreq(parts, 1 / parts)
    return power, np.hypot(index[:, np.newaxis] / box[0], index / box[1])
