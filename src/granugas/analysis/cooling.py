"""Cooling that the contact duration slows down (A section 7): how it begins, and kinetic theory with a factor 1 - c_e."""

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

LEAST_ENERGY = 0.9
"""The beginning lasts while K is above this: the collision rate is then within 5 % of its initial value."""

STEPS = 10_000
"""Of an integral; its error is then 1e-6."""


def initial_cooling(runs: xr.Dataset, restitution: float, contact_time: float, least: float = LEAST_ENERGY) -> xr.Dataset:
    """Cooling rate by that of inelastic hard spheres, and 1 - c_e, over the beginning of the runs.

    In homogeneous cooling K^(-1/2) grows by (1 - r^2)/4 in each t_E(0) (A Eq. 23); the TC model slows that down by a factor,
    which is fitted to K^(-1/2) - 1 against tau, all samples with the same weight.

    Args:
        runs: tau, kinetic_energy and the sums of collisions over `realization` and `time`, enskog_rate over `realization`.
        restitution: r below 1.
        contact_time: t_c in s.
        least: end of the beginning, as K.

    Returns:
        Dataset over `realization`: cooling_factor, inelastic_fraction, and contact_ratio = t_c/t_E, t_E averaged over the
        same samples.
    """
    begins = (runs["kinetic_energy"] >= least).where(runs["tau"] > 0, True).cumprod("time").astype(bool)
    tau, slowness = runs["tau"].where(begins), runs["kinetic_energy"].where(begins) ** -0.5
    slope = (tau * (slowness - 1)).sum("time") / (tau**2).sum("time")
    total, elastic = (
        runs[name].where(begins).max("time") for name in ("collisions_per_particle", "elastic_collisions_per_particle")
    )
    rate = runs["enskog_rate"] * (1 / slowness).mean("time")
    return xr.Dataset(
        {
            "cooling_factor": slope * 4 / (1 - restitution**2),
            "inelastic_fraction": 1 - elastic / total,
            "contact_ratio": contact_time * rate,
        }
    )


def cooling_with_contact_time(tau: ArrayLike, restitution: float, contact_ratio: float) -> NDArray[np.float64]:
    """K of a homogeneous gas that loses energy (1 - c_e) times as fast as inelastic hard spheres, c_e of A Eq. 21.

    1/t_E falls as K^(1/2), so s = K^(-1/2) obeys ds/dtau = (1 - r^2)/4 exp(-2 x/s) with x = t_c/t_E(0); x = 0 is A Eq. 23.

    Args:
        tau: t/t_E(0) of any shape, 0 or more.
        restitution: r below 1.
        contact_ratio: x.
    """
    tau = np.asarray(tau, dtype=float)
    rate = (1 - restitution**2) / 4
    s = np.geomspace(1, 1 + 2 * rate * tau.max(initial=0), STEPS)  # s - 1 <= rate * tau
    slowed = np.exp(2 * contact_ratio / s)
    passed = np.concatenate([[0], np.cumsum(np.diff(s) * (slowed[1:] + slowed[:-1]) / 2)]) / rate
    return np.interp(tau, passed, s) ** -2
