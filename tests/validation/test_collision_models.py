"""What collision models do to a whole gas."""

import numpy as np
import pytest

from granugas.analysis import theory
from granugas.scene import Scene
from granugas.simulate import simulate

SCENE = Scene(2000, 0.02, contact_time=0.0, material="viscoelastic", viscosity=0.1)
RATE = theory.enskog_rate(SCENE.area_fraction, SCENE.velocity_half_width**2 / 3, SCENE.diameter)
END = 1.0e5
"""Of the runs, in tau."""


@pytest.fixture(scope="module")
def viscoelastic() -> tuple[np.ndarray, np.ndarray]:
    """tau, and K of three runs, (realizations, times)."""
    spaced = {"spacing": "log", "count": 50, "first": 1.0 / RATE}
    runs = [
        simulate(SCENE, END / RATE, seed=1998, realization=k, samples=spaced, keep_positions=False, progress=False)
        for k in range(3)
    ]
    return runs[0]["tau"].values, np.array([run["kinetic_energy"].values for run in runs])


def test_viscoelastic_disks_cool_with_the_power_five_thirds(viscoelastic):
    """T ~ t^(-5/3), fitted from tau = 2000 to 1e5, where K falls from 3e-4 to 5e-7; a constant r would give -2."""
    tau, energy = viscoelastic
    late = tau >= 2000
    exponents = [np.polyfit(np.log(tau[late]), np.log(run[late]), 1)[0] for run in energy]
    assert np.mean(exponents) == pytest.approx(-5 / 3, abs=0.02)


def test_viscoelastic_disks_follow_the_mean_field_law(viscoelastic):
    """d ln K / d tau = - sqrt(K)/2 <(1 - r(u)^2) u^2> / <u^2> over the normal velocities of Maxwellian collisions."""
    tau, energy = viscoelastic
    np.testing.assert_allclose(np.exp(np.log(energy).mean(axis=0)), mean_field(tau), rtol=0.04)


def mean_field(tau: np.ndarray) -> np.ndarray:
    """K; u^2/4T of the collisions is distributed exponentially, T = K w^2/3 per mass."""
    y, weight = np.polynomial.laguerre.laggauss(30)

    def slope(log_k: float) -> float:
        x = SCENE.viscosity * (2 * np.sqrt(y * np.exp(log_k) / 3) * SCENE.velocity_half_width) ** 0.2
        r = 1 - 1.15344 * x + 0.6 * 1.15344**2 * x**2
        return -0.5 * np.exp(log_k / 2) * np.sum(weight * y * (1 - r**2))

    fine = np.unique(np.concatenate([np.linspace(0, tau[1], 20), np.geomspace(tau[1], tau[-1], 3000), tau]))
    log_k = [0.0]
    for dt in np.diff(fine):
        half = log_k[-1] + dt / 2 * slope(log_k[-1])
        log_k.append(log_k[-1] + dt * slope(half))
    return np.exp(np.interp(tau, fine, log_k))
