"""Elastic collisions for t_c well below t_E and the time of flight over a diameter, against the exact limits (A Fig. 6).

Single runs with fixed seeds; the standard errors are those of the counts, and five of them fit into the tolerance.
"""

import numpy as np
import pytest
import xarray as xr

from granugas.analysis import theory
from granugas.scene import Scene
from granugas.simulate import simulate


@pytest.mark.parametrize(("area_fraction", "contact_times"), [(0.05, (5e-5, 1e-4)), (0.25, (1e-5, 2e-5))])
def test_elastic_collisions_miss_what_the_partner_hides(area_fraction, contact_times):
    """c_e = 1 - exp(-2 q t_c C_r) within 2.5 %, where mean field is 6 to 8 % higher; standard error .5 %."""
    scene = Scene(1435, area_fraction, restitution=1.0, contact_time=contact_times)
    run = simulate(scene, {"collisions_per_particle": 3000}, seed=1998, keep_positions=False, progress=False).isel(time=-1)
    c_e = (run["elastic_collisions_per_particle"] / run["collisions_per_particle"]).values
    rate = float(run["collisions_per_particle"]) / float(run["stop_time"])
    assert c_e.min() * float(run["events"]) > 10_000
    expected = theory.elastic_collision_fraction_shielded(run["contact_time"].values, rate, area_fraction)
    np.testing.assert_allclose(c_e, expected, rtol=0.025)
    assert np.all(c_e < 0.97 * theory.elastic_collision_fraction(run["contact_time"].values, rate))


def test_elastic_collisions_save_more_energy_than_their_number_tells():
    """The loss by that of t_c = 0 is exp(-2 q t_c C_r) with q = 1.1025 within .5 %, and not 1 - c_e; standard error .1 %."""
    t_c, area_fraction = 2e-4, 0.25
    run, without = nearly_elastic(area_fraction, t_c), nearly_elastic(area_fraction, 0.0)
    rate = float(run["collisions_per_particle"]) / float(run["stop_time"])
    c_e = float(run["elastic_collisions_per_particle"] / run["collisions_per_particle"])
    left = loss_of_a_collision(run) / loss_of_a_collision(without)
    assert left == pytest.approx(float(theory.dissipation_factor(t_c, rate, area_fraction)), rel=5e-3)
    assert left < 0.98 * (1 - c_e)


def nearly_elastic(area_fraction: float, contact_time: float) -> xr.Dataset:
    """The end of a run that loses a tenth of its energy."""
    scene = Scene(1435, area_fraction, restitution=0.9999, contact_time=contact_time)
    until = {"collisions_per_particle": 1000}
    return simulate(scene, until, seed=1998, keep_positions=False, progress=False).isel(time=-1)


def loss_of_a_collision(run: xr.Dataset) -> float:
    return -np.log(float(run["kinetic_energy"])) / float(run["collisions_per_particle"])
