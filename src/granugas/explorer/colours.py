"""What the colours of the disks say: scales that go from dark to light, so that they read without hues, too."""

from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import matplotlib
import numpy as np
import xarray as xr
from matplotlib.colors import to_hex
from numpy.typing import NDArray

from granugas.plotting.snapshots import ENERGIES, FREQUENCIES, frequency_or_contact, relative_energy

LEVELS = 16
"""Of a scale: more are not seen in a picture of 80 000 disks, and fewer bits make the page small."""

Numbers = NDArray[np.float64]
LevelsAt = Callable[[int], NDArray[np.uint8]]


@dataclass(frozen=True)
class Scale:
    """Levels of a quantity, and how they look.

    Attributes:
        label: of its bar.
        low, high: ends of the first and the last level.
        logarithmic: whether levels are equal steps of the logarithm.
        colours: one for each level.
        ticks: of its bar.
        beyond: what a level after the last one means, "" where there is none; it is white.
    """

    label: str
    low: float
    high: float
    logarithmic: bool
    colours: tuple[str, ...]
    ticks: Sequence[float]
    beyond: str = ""

    def levels(self, values: Numbers) -> NDArray[np.uint8]:
        """(n,) the level of each value, those outside in the nearest; LEVELS for infinite ones."""
        steps = np.log if self.logarithmic else np.asarray
        share = (steps(np.clip(values, self.low, self.high)) - steps(self.low)) / (steps(self.high) - steps(self.low))
        return np.where(np.isinf(values), LEVELS, np.minimum(share * LEVELS, LEVELS - 1)).astype(np.uint8)

    def as_dict(self) -> dict[str, Any]:
        """All that the page needs to know."""
        return asdict(self)


def _colours(name: str, first: float, last: float) -> tuple[str, ...]:
    return tuple(to_hex(colour) for colour in matplotlib.colormaps[name](np.linspace(first, last, LEVELS)))


SCALES = {
    "energy": Scale("energy by its mean, eᵢ / ⟨e⟩", *ENERGIES, True, _colours("inferno", 0.3, 0.95), (0.2, 0.5, 1, 2, 5)),
    "collision_frequency": Scale(
        "collision frequency (1/s)",
        *FREQUENCIES,
        True,
        _colours("viridis", 0.2, 0.8),
        (1, 10, 100),
        "time between collisions < t_c",
    ),
    "initial_height": Scale("initial height, yᵢ(0) / l", 0, 1, False, _colours("cividis", 0.12, 1), (0, 0.25, 0.5, 0.75, 1)),
}
"""By the names of `animation.COLOURINGS`; the fourth, clusters, the page finds itself."""


def values_of(run: xr.Dataset, times: Numbers) -> dict[str, LevelsAt]:
    """For each scale that a run has the data of, the function that gives the levels (n,) at a sample.

    Args:
        run: with `trajectory` (time, particle, axis) in m and, for energy and collision frequency, `trajectory_velocity`
            (time, particle, axis) in m/s and `trajectory_collisions` (time, particle) since t = 0; opened lazily.
        times: (time,) of its samples in s.
    """
    height = SCALES["initial_height"].levels(run["trajectory"][0].sel(axis="y").values / run.attrs["box_y"])

    def energy(sample: int) -> NDArray[np.uint8]:
        return SCALES["energy"].levels(relative_energy(run["trajectory_velocity"][sample].values.astype(float)))

    def frequency(sample: int) -> NDArray[np.uint8]:
        """Since the sample before; at the first one nothing has collided."""
        before = max(sample - 1, 0)
        counts = run["trajectory_collisions"][sample].values - run["trajectory_collisions"][before].values
        rates = counts / (times[sample] - times[before] if sample else 1.0)
        return SCALES["collision_frequency"].levels(frequency_or_contact(rates, rates * np.max(run.attrs["contact_time"]) > 1))

    found: dict[str, LevelsAt] = {"energy": energy} if "trajectory_velocity" in run else {}
    found |= {"collision_frequency": frequency} if "trajectory_collisions" in run else {}
    return found | {"initial_height": lambda sample: height}
