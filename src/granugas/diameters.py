"""How large the particles of a polydisperse scene are.

The diameters are the quantiles of their distribution at (k + 1/2)/N, and random is only who has which: so the numbers of
large and small particles are exact, the volume of the box and the largest diameter follow from the scene alone, and no
realization has more of the large ones than another.
"""

import math
from functools import lru_cache
from statistics import NormalDist

import numpy as np
from numpy.typing import NDArray

from granugas.scene import Scene

Numbers = NDArray[np.float64]


def diameters(scene: Scene) -> Numbers:
    """(N,) diameters in ascending order, by their mean."""
    quantile = (np.arange(scene.n_particles) + 0.5) / scene.n_particles
    found = DISTRIBUTIONS[scene.sizes](scene, quantile)
    return found / found.mean()


@lru_cache(maxsize=256)
def moment(scene: Scene, power: int) -> float:
    """<d^power> / <d>^power."""
    return float(np.mean(diameters(scene) ** power))


@lru_cache(maxsize=256)
def largest(scene: Scene) -> float:
    """The largest diameter by the mean one; 1 where all are equal."""
    return 1.0 if scene.sizes == "equal" else float(diameters(scene)[-1])


def of_particles(scene: Scene, rng: np.random.Generator) -> dict[str, Numbers]:
    """(N,) `diameter` in m and `mass` in mean masses of each particle, all of one density; nothing where all are equal."""
    if scene.sizes == "equal":
        return {}
    relative = rng.permutation(diameters(scene))
    return {"diameter": relative * scene.diameter, "mass": relative**scene.dimensions / moment(scene, scene.dimensions)}


def _equal(scene: Scene, quantile: Numbers) -> Numbers:
    return np.ones_like(quantile)


def _bidisperse(scene: Scene, quantile: Numbers) -> Numbers:
    large = round(scene.size_share * len(quantile))
    return np.where(np.arange(len(quantile)) >= len(quantile) - large, scene.size_ratio, 1.0)


def _uniform(scene: Scene, quantile: Numbers) -> Numbers:
    return 1 + scene.size_spread * (2 * quantile - 1)


def _log_normal(scene: Scene, quantile: Numbers) -> Numbers:
    normal = np.fromiter(map(NormalDist().inv_cdf, quantile), float, len(quantile))
    return np.exp(math.sqrt(math.log1p(scene.size_spread**2)) * normal)


DISTRIBUTIONS = {"equal": _equal, "bidisperse": _bidisperse, "uniform": _uniform, "log_normal": _log_normal}
"""Of the key `sizes`: a scene and quantiles in ascending order give diameters, in any unit."""
