"""Elastic disks in equilibrium against theory: pressure, collision rate, elastic fractions, velocities (A section 5).

Long averages of single runs with fixed seeds. Standard errors, from blocks of such runs, stand beside the tolerances:
five or more of them fit in, so that other rounding, which makes another trajectory, does not fail.
"""

import numpy as np
import pytest
import xarray as xr
from scipy import stats

from granugas.analysis import theory
from granugas.scene import Scene
from granugas.simulate import simulate

N = 1435
PAPERS_AREA_FRACTION = 0.2267
ENERGY_PER_MASS = Scene().velocity_half_width ** 2 / 3

CONTACT_TIMES = np.array([0.01, 0.03, 0.1, 1.0, 3.0])
"""t_c / t_E."""

UNLIKELY = 1e-6
"""Probability below which a sample is not drawn from a distribution."""


def rate(area_fraction: float) -> float:
    """1/t_E with the contact value that is right in dense gases, in 1/s."""
    excess = theory.reduced_pressure(area_fraction, theory.contact_value_dense(area_fraction)) - 1
    return float(theory.prefactor_rate(ENERGY_PER_MASS, Scene().diameter) * excess)


def equilibrium(area_fraction: float, collisions_per_particle: float, samples: int, n: int = N, **options) -> xr.Dataset:
    """A run of r = 1 in equal intervals of time; options: of the scene and of `simulate`."""
    scene = Scene(n, area_fraction, restitution=1.0, contact_time=options.pop("contact_time", 0.0))
    until = collisions_per_particle / rate(area_fraction)
    spaced = {"spacing": "linear", "count": samples, "first": until / samples}
    return simulate(scene, until, seed=1998, samples=spaced, keep_positions=False, progress=False, **options)


def excess_pressure(run: xr.Dataset) -> float:
    return float(run["reduced_pressure"].mean()) - 1


@pytest.fixture(scope="module", params=[0.05, 0.4, 0.6, PAPERS_AREA_FRACTION])
def run(request) -> xr.Dataset:
    if request.param == PAPERS_AREA_FRACTION:
        return request.getfixturevalue("papers_gas")
    return equilibrium(request.param, 10_000, samples=50)


@pytest.fixture(scope="module")
def papers_gas() -> xr.Dataset:
    """10^4 collisions of each disk, as many samples, and 250 snapshots; all t_c from the one trajectory."""
    t_e = 1 / rate(PAPERS_AREA_FRACTION)
    return equilibrium(
        PAPERS_AREA_FRACTION,
        10_000,
        samples=10_000,
        contact_time=tuple(CONTACT_TIMES * t_e),
        snapshots=np.linspace(40, 10_000, 250) * t_e,
    )


def test_the_run_is_long_enough(run):
    assert run["collisions_per_particle"][-1] >= 5000


def test_pressure(run):
    """P_0 - 1 = 2 nu g_4; standard error .05 %, g_4 itself is .1 % off at .6."""
    nu = run.attrs["area_fraction"]
    expected = theory.reduced_pressure(nu, theory.contact_value_dense(nu)) - 1
    assert excess_pressure(run) == pytest.approx(expected, rel=3e-3)


def test_collision_rate_is_that_of_the_pressure(run):
    """C_r = w_0 (P_0 - 1) (1 - 3/(8N)); standard error .026 %."""
    assert rate_by_pressure(run) == pytest.approx(1 - 3 / (8 * N), rel=1.5e-3)


def test_collision_rate_of_few_disks():
    """The finite size alone: .9 % at N = 42; standard error .02 %."""
    few = equilibrium(PAPERS_AREA_FRACTION, 400_000, samples=100, n=42)
    assert rate_by_pressure(few) == pytest.approx(1 - 3 / (8 * 42), rel=1.5e-3)


def test_no_direction_is_preferred(run):
    """Collisional stress (A Eq. 15) and energy along x and y; standard errors .03, .02 and .4 %."""
    stress = {ab: float(run[f"collisional_stress_{ab}"].mean()) for ab in ("xx", "xy", "yx", "yy")}
    trace = stress["xx"] + stress["yy"]
    assert abs(stress["xx"] - stress["yy"]) < 2e-3 * trace
    assert abs(stress["xy"]) < 1.5e-3 * trace
    assert stress["xy"] == pytest.approx(stress["yx"], abs=1e-9 * trace)
    assert abs(float((run["kinetic_energy_x"] - run["kinetic_energy_y"]).mean())) < 0.025


def test_times_since_the_last_collision_are_exponential(papers_gas):
    """n_e = 1 - exp(-t_c / t_E) (A Eq. 20); standard errors .4 % at .01 t_E, .02 % at 3 t_E."""
    t_c = papers_gas["contact_time"].values
    expected = theory.elastic_particle_fraction(t_c, rate(PAPERS_AREA_FRACTION))
    np.testing.assert_allclose(papers_gas["elastic_particle_fraction"][1:].mean("time"), expected, rtol=0.02)
    long = CONTACT_TIMES >= 0.1
    np.testing.assert_allclose(papers_gas["elastic_particle_fraction"][1:, long].mean("time"), expected[long], rtol=0.01)


def test_elastic_disks_are_the_fast_ones(papers_gas):
    """e_e = 5/4 n_e for t_c well below t_E (A Fig. 7); standard error .2 % at .01 t_E."""
    short = papers_gas.isel(contact_time=CONTACT_TIMES <= 0.03, time=slice(1, None))
    ratio = short["elastic_energy_fraction"].mean("time") / short["elastic_particle_fraction"].mean("time")
    np.testing.assert_allclose(ratio, theory.ENERGY_OF_ELASTIC_PARTICLES, rtol=0.02)


def test_elastic_collisions_are_fewer_than_in_mean_field(papers_gas):
    """c_e lies 3 to 9 % below A Eq. 21 for t_c well below t_E; standard error .3 %."""
    short = papers_gas.isel(contact_time=CONTACT_TIMES <= 0.03, time=-1)
    c_e = short["elastic_collisions_per_particle"] / short["collisions_per_particle"]
    mean_field = theory.elastic_collision_fraction(short["contact_time"].values, rate(PAPERS_AREA_FRACTION))
    missing = 1 - c_e.values / mean_field
    assert np.all((missing > 0.03) & (missing < 0.09))


def test_velocities_are_maxwellian(papers_gas):
    """Each component of 250 snapshots is normal, its square and the speed's distributed as they must be."""
    velocity = papers_gas["velocity"].values.reshape(-1, 2) / np.sqrt(ENERGY_PER_MASS)
    speed = np.hypot(*velocity.T)
    for component in velocity.T:
        assert stats.kstest(component, "norm").pvalue > UNLIKELY
    assert stats.kstest(speed, "rayleigh").pvalue > UNLIKELY
    free = 2 * N - 2
    assert np.mean(velocity**4) == pytest.approx(3 * free / (free + 2), rel=0.012)


def test_velocities_have_no_preferred_angle(papers_gas):
    angle = np.arctan2(*papers_gas["velocity"].values.reshape(-1, 2).T)
    assert stats.kstest(angle, "uniform", (-np.pi, 2 * np.pi)).pvalue > UNLIKELY
    for fold in (2, 4, 6):
        assert abs(np.exp(1j * fold * angle).mean()) < 6 / np.sqrt(angle.size)


@pytest.mark.full
@pytest.mark.timeout(3600)
def test_pressure_just_below_freezing():
    """Z = pi P*/(4 nu), P*(.698) = 9.1693 (Engel et al. 2013); standard error .12 %, N = 1435 is .2 % below."""
    fluid = equilibrium(0.698, 140_000, samples=100)
    assert fluid["collisions_per_particle"][-1] >= 100_000
    assert excess_pressure(fluid) == pytest.approx(np.pi * 9.1693 / (4 * 0.698) - 1, rel=7e-3)


def rate_by_pressure(run: xr.Dataset) -> float:
    """C_r / [w_0 (P_0 - 1)]."""
    w_0 = theory.prefactor_rate(ENERGY_PER_MASS, Scene().diameter)
    return float(run["collision_rate"].mean() / (w_0 * excess_pressure(run)))
