"""Beads on a line and spheres against theory, as test_equilibrium and test_cooling do it for disks.

Standard errors, from other seeds, stand beside the tolerances: four or more of them fit in.
"""

import math

import numpy as np
import pytest
import xarray as xr
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

import granugas as gg
from granugas.analysis import theory
from granugas.dynamics.events import loop
from granugas.dynamics.events.engine import Engine
from granugas.equilibrate import at_rest, equilibrate, state_of
from granugas.scene import Scene

CONTACT_TIMES = np.array([0.01, 0.1, 1.0])
"""t_c / t_E."""


def rate(scene: Scene) -> float:
    """1/t_E at the start, in 1/s."""
    return float(theory.enskog_rate(scene.area_fraction, scene.energy_per_mass, scene.diameter, scene.dimensions))


def equilibrium(n: int, fraction: float, dimensions: int, collisions_per_particle: float, samples: int) -> xr.Dataset:
    """A run of r = 1 in equal intervals of time, evaluated for three t_c."""
    scene = Scene(n, fraction, 1.0, 0.0, dimensions=dimensions)
    t_e = 1 / rate(scene)
    scene = Scene(n, fraction, 1.0, tuple(CONTACT_TIMES * t_e), dimensions=dimensions)
    until = collisions_per_particle * t_e
    spaced = {"spacing": "linear", "count": samples, "first": until / samples}
    return gg.simulate(scene, until, seed=1998, samples=spaced, keep_positions=False, progress=False)


@pytest.fixture(scope="module", params=[0.1, 0.3, 0.45])
def spheres(request) -> xr.Dataset:
    return equilibrium(1331, request.param, 3, 2000, samples=1000)


def test_pressure_of_spheres(spheres):
    """Kolafa's equation of state; standard error .05 %."""
    expected = theory.kolafa_pressure(spheres.attrs["area_fraction"])
    assert spheres["collisions_per_particle"][-1] > 1900
    assert float(spheres["reduced_pressure"].mean()) == pytest.approx(float(expected), rel=3e-3)


def test_collision_rate_of_spheres(spheres):
    """C_r = w_0 (P_0 - 1), and Enskog's rate with the contact value of Carnahan and Starling."""
    excess = float(spheres["reduced_pressure"].mean()) - 1
    w_0 = float(theory.prefactor_rate(0.5**2 / 2, 1e-3, dimensions=3))
    assert float(spheres["collision_rate"].mean()) / (w_0 * excess) == pytest.approx(1, abs=2e-3)
    assert float(spheres["collision_rate"].mean() / spheres["enskog_rate"]) == pytest.approx(1, abs=6e-3)


def test_elastic_spheres(spheres):
    """n_e as A Eq. 20 at the rate that is measured; e_e = 7/6 n_e for short t_c."""
    t_c, measured = spheres["contact_time"].values, float(spheres["collision_rate"].mean())
    n_e = spheres["elastic_particle_time_fraction"].mean("time")
    np.testing.assert_allclose(n_e, theory.elastic_particle_fraction(t_c, measured), rtol=0.02)
    short = spheres.isel(time=slice(1, None), contact_time=0)
    ratio = float(short["elastic_energy_fraction"].mean() / short["elastic_particle_fraction"].mean())
    assert ratio == pytest.approx(theory.energy_of_elastic_particles(3), rel=0.02)


def test_no_axis_is_preferred_by_spheres(spheres):
    along = [float(spheres[f"kinetic_energy_{axis}"].mean()) for axis in "xyz"]
    stress = np.array([[float(spheres[f"collisional_stress_{a}{b}"].mean()) for b in "xyz"] for a in "xyz"])
    np.testing.assert_allclose(along, 1 / 3, atol=0.01)
    np.testing.assert_allclose(stress / np.trace(stress), np.eye(3) / 3, atol=3e-3)
    np.testing.assert_allclose(stress, stress.T, atol=1e-9 * np.trace(stress))


@pytest.mark.parametrize("dimensions", [1, 3])
def test_weak_dissipation_follows_haff(dimensions):
    """K = [1 + (1 - r^2) tau / (2D)]^-2 down to K = .1; of beads, whose velocities do not stay normal, down to .5."""
    n, r, runs, lowest = (512, 0.95, 16, 0.1) if dimensions == 3 else (64, 0.999, 32, 0.5)
    scene = Scene(n, 0.2, r, contact_time=0.0, dimensions=dimensions)
    end = (lowest**-0.5 - 1) * 2 * dimensions / (1 - r**2)
    tau = np.linspace(0, end, 21)
    spaced = {"spacing": "linear", "count": 20, "first": tau[1] / rate(scene)}
    found = [
        gg.simulate(scene, end / rate(scene), seed=7, realization=k, samples=spaced, keep_positions=False, progress=False)
        for k in range(runs)
    ]
    energy = np.mean([run["kinetic_energy"].values for run in found], axis=0)
    np.testing.assert_allclose(energy, theory.homogeneous_cooling(tau, r, dimensions), rtol=0.03)
    collisions = np.mean([run["collisions_per_particle"].values for run in found], axis=0)
    np.testing.assert_allclose(energy, theory.energy_after_collisions(collisions, r, dimensions), rtol=0.03)


def test_clusters_of_spheres_are_those_of_a_graph():
    scene = Scene(1000, 0.15, 0.6, dimensions=3)
    run = gg.simulate(scene, 0.05, seed=2, samples={"count": 3}, progress=False)
    found = gg.find_clusters(run, distance_factors=[1.05, 1.2])
    for position, at_time in zip(run["trajectory"].values, found.transpose("time", ...)["cluster_count"].values, strict=True):
        for factor, count in zip([1.05, 1.2], at_time, strict=True):
            near = cKDTree(position, boxsize=[run.attrs[f"box_{axis}"] for axis in "xyz"])
            bonds = near.sparse_distance_matrix(near, factor * scene.diameter)
            assert connected_components(bonds, directed=False)[0] == count


# --- beads ----------------------------------------------------------------------------------------------------------------


def test_pressure_of_beads():
    """P_0 = 1 / (1 - nu), exact on a ring of any number (Tonks 1936)."""
    for fraction in (0.2, 0.8):
        run = equilibrium(50, fraction, 1, 10_000, samples=10)
        assert float(run["reduced_pressure"].mean()) == pytest.approx(1 / (1 - fraction), rel=2e-3)


def test_elastic_beads_exchange_their_velocities():
    scene = Scene(100, 0.5, restitution=1.0, contact_time=0.0, dimensions=1)
    start = state_of(equilibrate(scene, seed=3))
    engine = Engine(scene, start)
    engine.advance(math.inf, most_collisions=20_000)
    after = engine.state().velocity
    assert not np.array_equal(after, start.velocity)
    np.testing.assert_allclose(np.sort(after, axis=0), np.sort(start.velocity, axis=0), rtol=0, atol=1e-12 * 0.5)


def test_beads_keep_their_order():
    scene = Scene(50, 0.7, restitution=0.9, contact_time=1e-4, dimensions=1)
    engine = Engine(scene, state_of(equilibrate(scene, seed=4)))
    for _ in range(20):
        engine.advance(math.inf, most_collisions=500)
        state = engine.state()
        gaps = np.roll(state.position[:, 0], -1) - state.position[:, 0]
        gaps -= state.box[0] * np.floor(gaps / state.box[0])
        assert gaps.sum() == pytest.approx(state.box[0])
        assert gaps.min() > scene.diameter * (1 - 1e-12)


@pytest.mark.parametrize("middle", [-0.1, 0.0, 0.1])
@pytest.mark.parametrize(("factor", "collapses"), [(0.95, True), (1.05, False)])
def test_three_free_beads_collapse_below_the_exact_restitution(factor, collapses, middle):
    """r < 7 - 4 sqrt(3): two beads hit one between them again and again, infinitely often."""
    scene = Scene(3, 0.01, factor * (7 - 4 * math.sqrt(3)), contact_time=0.0, dimensions=1, diameter=1.0)
    position, velocity = np.array([[145.0], [150.0], [154.0]]), np.array([[1.0], [middle], [-1.0]])
    engine = Engine(scene, at_rest(position, velocity, (300.0,)))
    assert engine.advance(20.0) == (loop.WATCH if collapses else loop.TIME)
    v = engine.state().velocity[:, 0]
    assert v.sum() == pytest.approx(velocity.sum(), abs=1e-12)
    assert collapses or v[0] < v[1] < v[2]
