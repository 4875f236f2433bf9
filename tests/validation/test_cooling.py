"""Cooling: the homogeneous law where it must hold (A Eq. 23), and where it must not (A Figs. 8 and 12)."""

import numpy as np
import pytest

from granugas.analysis import theory
from granugas.equilibrate import equilibrate
from granugas.scene import Scene
from granugas.simulate import simulate

AREA_FRACTION = 0.2267
RATE = theory.enskog_rate(AREA_FRACTION, Scene().velocity_half_width ** 2 / 3, Scene().diameter)
"""1/t_E(0) in 1/s."""


def cooling(scene: Scene, tau: np.ndarray, realizations: int) -> dict[str, np.ndarray]:
    """K and collisions per particle, (realizations, times), at equidistant tau from 0 on."""
    spaced = {"spacing": "linear", "count": len(tau) - 1, "first": tau[1] / RATE}
    runs = [
        simulate(scene, tau[-1] / RATE, seed=1998, realization=k, samples=spaced, keep_positions=False, progress=False)
        for k in range(realizations)
    ]
    names = ("kinetic_energy", "collisions_per_particle")
    return {name: np.array([run[name].values for run in runs]) for name in names}


def test_weak_dissipation_follows_haff():
    """r = .99, down to K = 1e-2, mean of 32 runs; its standard error is .2 %, and it lies 1 % above at the end."""
    r = 0.99
    end = 4 / (1 - r**2) * (np.sqrt(100) - 1)
    tau = np.linspace(0, end, 101)
    expected = theory.homogeneous_cooling(tau, r)
    assert expected[-1] == pytest.approx(1e-2)
    runs = cooling(Scene(378, AREA_FRACTION, r, contact_time=0.0), tau, realizations=32)
    np.testing.assert_allclose(runs["kinetic_energy"].mean(axis=0), expected, rtol=0.02)
    by_collisions = theory.energy_after_collisions(runs["collisions_per_particle"], r)
    early = expected > 0.1
    np.testing.assert_allclose(runs["kinetic_energy"][:, early].mean(axis=0), by_collisions[:, early].mean(axis=0), rtol=0.0125)


def test_strong_dissipation_leaves_the_homogeneous_law_where_clusters_begin():
    """r = .4: K is 15 % above A Eq. 23 at tau = 5 (standard error .3), right before and far above it later."""
    tau = np.linspace(0, 25, 251)
    runs = cooling(Scene(1435, AREA_FRACTION, 0.4, contact_time=1e-5), tau, realizations=16)
    above = np.log(runs["kinetic_energy"]).mean(axis=0) - np.log(theory.homogeneous_cooling(tau, 0.4))
    assert np.all(np.abs(above[tau <= 2]) < 0.12)
    assert 3.5 < np.interp(np.log(1.15), above, tau) < 6.5
    assert above[-1] > 0.5


@pytest.fixture(scope="module")
def energies() -> dict[float, np.ndarray]:
    """ln K of 16 realizations at tau = 5, 20, 80, 320 for each t_c (s); the same start states for all."""
    times = np.array([5.0, 20.0, 80.0, 320.0]) / RATE
    spaced = {"spacing": "log", "count": len(times), "first": times[0]}
    found = {t_c: [] for t_c in (1e-3, 1e-5, 1e-6, 1e-8, 1e-12)}
    for realization in range(16):
        start = equilibrate(Scene(1435, AREA_FRACTION), seed=1998, realization=realization)
        for t_c, logarithms in found.items():
            scene = Scene(1435, AREA_FRACTION, restitution=0.4, contact_time=t_c)
            run = simulate(scene, times[-1], state=start, samples=spaced, keep_positions=False, progress=False)
            logarithms.append(np.log(run["kinetic_energy"].values[1:]))
    return {t_c: np.array(logarithms) for t_c, logarithms in found.items()}


def standard_errors_apart(some: np.ndarray, others: np.ndarray) -> np.ndarray:
    """Difference of the means over realizations in units of its standard error, at each time."""
    variance = (some.var(axis=0, ddof=1) + others.var(axis=0, ddof=1)) / len(some)
    return np.abs(some.mean(axis=0) - others.mean(axis=0)) / np.sqrt(variance)


@pytest.mark.parametrize("contact_time", [1e-5, 1e-6, 1e-8])
def test_short_contact_times_do_not_matter(energies, contact_time):
    """Six standard errors of 16 realizations: once in 1e6 by chance."""
    assert np.all(standard_errors_apart(energies[contact_time], energies[1e-12]) < 6)


def test_long_contact_times_do(energies):
    """The comparison sees a difference: t_c = 1e-3 s, nearly half of t_E."""
    assert np.all(standard_errors_apart(energies[1e-3], energies[1e-12])[:2] > 10)
