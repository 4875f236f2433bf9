"""Disks of different sizes and masses: equipartition and pressure in equilibrium, conservation, clusters by B Eq. 6."""

import math

import numpy as np
import pytest
from gaps import TOLERATED, smallest_gap
from gases import lattice_gas
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from granugas.analysis import theory
from granugas.analysis.clusters import find_clusters
from granugas.analysis.observables import kinetic_energy
from granugas.diameters import diameters
from granugas.dynamics.events.effects.unequal import effect_of
from granugas.dynamics.events.engine import Engine
from granugas.equilibrate import equilibrate, state_of
from granugas.scene import Scene
from granugas.simulate import simulate

BIDISPERSE = {"sizes": "bidisperse", "size_ratio": 2.0, "size_share": 0.3}
UNIFORM = {"sizes": "uniform", "size_spread": 0.5}
LOG_NORMAL = {"sizes": "log_normal", "size_spread": 0.15}


def scene_of(sizes, n_particles=500, area_fraction=0.25, restitution=1.0, contact_time=0.0) -> Scene:
    return Scene(n_particles, area_fraction, restitution, contact_time, **sizes)


def equilibrium(scene: Scene, collisions: int, samples: int):
    """A run of r = 1 of about so many collisions."""
    d = diameters(scene) * scene.diameter
    until = 2 * collisions / scene.n_particles / theory.mixture_rate(scene.area_fraction, 0.5**2 / 3, d)
    spaced = {"spacing": "linear", "count": samples}
    return simulate(scene, until, seed=1998, samples=spaced, keep_positions=False, progress=False)


@pytest.mark.parametrize(
    ("sizes", "area_fraction", "collisions"),
    [(BIDISPERSE, 0.1, 500_000), (BIDISPERSE, 0.4, 2_500_000), (UNIFORM, 0.25, 1_000_000), (LOG_NORMAL, 0.4, 2_500_000)],
)
def test_pressure_and_rate_of_mixtures(sizes, area_fraction, collisions):
    """Z within .5 % (Jenkins & Mancini), the rate within 1 %; standard errors .05 to .1 %. The first interval is short."""
    scene = scene_of(sizes, 1000, area_fraction)
    run = equilibrium(scene, collisions, samples=20)
    expected = theory.mixture_pressure(area_fraction, diameters(scene))
    assert float(run["reduced_pressure"][2:].mean()) == pytest.approx(expected, rel=5e-3)
    assert float(run["collisions_per_particle"][-1] / run["tau"][-1]) == pytest.approx(1, rel=1e-2)


@pytest.mark.parametrize("sizes", [BIDISPERSE, UNIFORM])
def test_energy_is_shared_evenly(sizes):
    """T_l / T_s of many samples; standard error .4 %.

    As the whole is at rest, a particle has kT (1 - m_i/M), and the logarithm of a mean of n exponential energies is on
    average 1/2n below that of their expectation.
    """
    run = equilibrium(scene_of(sizes, 200), 600_000, samples=600)
    mass = run["particle_mass"].values
    large = mass > mass.mean()
    of_large, of_small = (math.log(1 - mass[some].mean() / mass.sum()) - 1 / (2 * some.sum()) for some in (large, ~large))
    assert float(np.log(run["species_temperature_ratio"]).mean()) == pytest.approx(of_large - of_small, abs=0.02)


def test_in_cooling_the_heavy_ones_stay_hotter():
    """No equipartition of dissipative particles (Garzo & Dufty 1999): T_l / T_s > 1 after some collisions."""
    run = simulate(scene_of(BIDISPERSE, restitution=0.8), {"collisions_per_particle": 20}, seed=1, progress=False)
    assert float(run["species_temperature_ratio"][-20:].mean()) > 1.1


@pytest.mark.parametrize("sizes", [BIDISPERSE, LOG_NORMAL], ids=lambda sizes: sizes["sizes"])
def test_conservation(sizes):
    """Momentum, no overlap, and the energy that is missing is what was dissipated."""
    engine = Engine(scene := scene_of(sizes, restitution=0.9), state_of(equilibrate(scene, seed=1)))
    mass = engine.state().more["mass"]
    left = start = kinetic_energy(engine.state().velocity, mass).sum()
    for _ in range(10):
        engine.advance(np.inf, 20_000)
        state, before = engine.state(), left
        left = kinetic_energy(state.velocity, mass).sum()
        assert engine.take_tally().loss == pytest.approx(before - left, abs=1e-12 * before)
        assert smallest_gap(engine) >= -TOLERATED
        assert np.abs(mass @ state.velocity).max() <= 1e-12 * np.sqrt(500 * 2 * start)
    assert engine.backwards == 0
    assert left < 0.1 * start


@pytest.mark.parametrize("contact_time", [0.0, 1e-5])
def test_equal_disks_as_unequal_ones_are_the_same_bit_for_bit(contact_time):
    scene = Scene(200, 0.5, restitution=0.8, contact_time=contact_time)
    state = lattice_gas(scene)
    state.more.update(diameter=np.full(200, scene.diameter), mass=np.ones(200))
    plain, other = Engine(scene, state), Engine(scene, state, sizes=effect_of(scene, state))
    for engine in (plain, other):
        engine.advance(np.inf, 20_000)
    for name, rows in plain.arrays.items():
        if name != "near":  # scratch
            assert rows.tobytes() == other.arrays[name].tobytes(), name


def test_clusters_of_a_run_are_those_of_eq_6():
    """B Eq. 6 with the diameters of the run, against all pairs of a tree."""
    scene = scene_of(BIDISPERSE, restitution=0.4, contact_time=1e-5)
    run = simulate(scene, 0.5, seed=1, samples={"count": 3}, progress=False)
    box = [run.attrs["box_x"], run.attrs["box_y"]]
    found = find_clusters(run, distance_factors=[1.05, 1.4])
    d = run["particle_diameter"].values
    for factor in (1.05, 1.4):
        for k in range(4):
            at = run["trajectory"].values[k]
            i, j = cKDTree(at, boxsize=box).query_pairs(factor * d.max(), output_type="ndarray").T
            r = at[j] - at[i]
            near = np.linalg.norm(r - box * np.round(r / box), axis=1) <= factor * (d[i] + d[j]) / 2
            bonds = coo_array((np.ones(near.sum()), (i[near], j[near])), shape=(500, 500))
            sizes = np.bincount(connected_components(bonds, directed=False)[1])
            here = found.sel(distance_factor=factor).isel(time=k)
            assert (here["cluster_count"], here["largest_cluster_size"]) == (len(sizes), sizes.max())
