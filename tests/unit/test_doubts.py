"""What a physicist would doubt about a run: said once, kept with the data."""

import logging

import numpy as np
import pytest

import granugas as gg
from granugas import doubts
from granugas.analysis.enskog import enskog_rate
from granugas.dynamics.events.engine import Engine
from granugas.equilibrate import at_rest
from granugas.initial import random_stream, sites, start_lattice, start_velocities
from granugas.storage.dataset import content_sha256, pool, read, write

GAS = gg.Scene(n_particles=144)
FLIGHT = 1 / float(enskog_rate(0.2267, 0.5**2 / 3, 1e-3))
FINE = {"equilibration_collisions_per_particle": 100.0, "equilibration_reached": 1, "box_x": 0.03, "box_y": 0.03}


@pytest.fixture(autouse=True)
def nothing_said_yet() -> None:
    doubts._say.cache_clear()


def before(scene=GAS, start=FINE, cells=(10, 10), keep_positions=True):
    return doubts.doubts_before(scene, start, cells, keep_positions)


def test_nothing_to_doubt():
    assert before() == []


@pytest.mark.parametrize(("times_flight", "number"), [(0.99, 0), (1.01, 1)])
def test_contact_time_by_mean_free_time(times_flight, number):
    lines = before(gg.Scene(n_particles=144, contact_time=times_flight * FLIGHT))
    assert len(lines) == number
    assert all(line.startswith("contact_time = ") and f"{FLIGHT:.4g} s" in line for line in lines)
    assert before(gg.Scene(n_particles=144, restitution=1.0, contact_time=times_flight * FLIGHT)) == []


@pytest.mark.parametrize(("cells", "number"), [((3, 3), 0), ((10, 2), 1), ((1, 9), 1)])
def test_box_by_cells(cells, number):
    lines = before(cells=cells)
    assert len(lines) == number
    assert all(line.startswith(f"box of 30 x 30 diameters in {cells[0]} x {cells[1]} cells") for line in lines)


@pytest.mark.parametrize(
    ("start", "said"),
    [
        ({"equilibration_collisions_per_particle": 9.0}, "equilibrated for 9 collisions per particle"),
        (
            {
                "equilibration_reached": 0,
                "equilibration_kurtosis": 0.7,
                "equilibration_anisotropy": 0.1,
                "equilibration_order": 9.0,
            },
            "not in equilibrium after 100 collisions per particle (kurtosis 0.7, anisotropy 0.1, order 9)",
        ),
    ],
)
def test_short_equilibration(start, said):
    (line,) = before(start=FINE | start)
    assert line.startswith("start state: ") and said in line
    assert before(gg.Scene(n_particles=1), FINE | start, keep_positions=False) == []


@pytest.mark.parametrize("area_fraction", [0.05, 0.2267, 0.6])
def test_velocities_are_maxwellian_when_it_says(area_fraction):
    """The kurtosis of uniformly distributed components is .6 of a Gaussian's."""
    scene = gg.Scene(n_particles=20_000, area_fraction=area_fraction, restitution=1.0, contact_time=0.0)
    lattice, rng = start_lattice(scene), random_stream(scene, 0, 0)
    engine = Engine(scene, at_rest(sites(lattice, scene.n_particles, rng), start_velocities(scene, rng), lattice.box))
    found = []
    for _ in range(2):
        engine.advance(np.inf, int(doubts.RELAXED * scene.n_particles / 4))
        velocity = engine.state().velocity
        found.append(np.mean(velocity**4) / np.mean(velocity**2) ** 2 / 3)
    assert found[0] < 0.97  # half as many do not suffice
    assert found[1] == pytest.approx(1, abs=0.03)


@pytest.mark.parametrize(("n_particles", "keep_positions", "number"), [(100, True, 0), (99, True, 1), (99, False, 0)])
def test_few_particles_for_clusters(n_particles, keep_positions, number):
    lines = before(gg.Scene(n_particles=n_particles), keep_positions=keep_positions)
    assert len(lines) == number


def test_a_run_that_ends_early_says_what_is_missing(caplog):
    until = {"time": 0.1, "collisions_per_particle": 10}
    asked = {"seed": 3, "samples": {"spacing": "linear", "count": 20}, "snapshots": [0.001, 0.08, 0.2], "progress": False}
    with caplog.at_level(logging.WARNING, "granugas"):
        run = gg.simulate(GAS, until, **asked)
    missing = int(np.isnan(run["kinetic_energy"]).sum())
    stopped = f"beyond the end of the run at t = {run['stop_time'].item():.6g} s (collisions_per_particle) and are NaN"
    assert 0 < missing < 20
    said = [f"samples: {missing} of 21 lie {stopped}", f"snapshots: those at 0.08, 0.2 s lie {stopped}"]
    assert run.attrs["warnings"].splitlines() == said
    assert [record.getMessage() for record in caplog.records] == said
    assert content_sha256(gg.simulate(GAS, until, **asked)) == content_sha256(run)
    assert len(caplog.records) == 2  # not again


def test_what_is_missing_after_a_stop_that_was_told_is_not_told_aloud_again(caplog):
    with caplog.at_level(logging.INFO, "granugas"):
        run = gg.simulate(GAS, 0.1, seed=3, snapshots=[0.09], max_collisions=300, progress=False)
    late = [record for record in caplog.records if "beyond the end of the run" in record.getMessage()]
    assert [record.getMessage() for record in late] == run.attrs["warnings"].splitlines() != []
    assert {record.levelno for record in late} == {logging.INFO}
    aloud = [record.getMessage() for record in caplog.records if record.levelno == logging.WARNING]
    assert len(aloud) == 1 and aloud[0].startswith("max_collisions reached at t = ")


def test_where_double_precision_ends(caplog):
    """138/(1 - r^2) = 164 collisions of a disk end at K = 1e-30 in the homogeneous state."""
    gas = gg.Scene(n_particles=42, restitution=0.4, contact_time=1e-12)
    asked = {"samples": {"spacing": "linear", "count": 20}, "keep_positions": False, "progress": False}
    with caplog.at_level(logging.WARNING, "granugas"):
        run = gg.simulate(gas, {"collisions_per_particle": 300}, **asked)
    number = int((run["kinetic_energy"] < 1e-30).sum())
    assert 0 < number < 20
    (line,) = run.attrs["warnings"].splitlines()
    assert line.startswith(f"kinetic_energy: {number} of 21 samples lie below 1e-30, beyond the end of double precision")
    assert [record.getMessage() for record in caplog.records] == [line]


def test_a_run_without_doubts_is_silent(caplog):
    with caplog.at_level(logging.WARNING, "granugas"):
        run = gg.simulate(GAS, 0.02, snapshots=[0.0, 0.01, 0.02], progress=False)
    assert run.attrs["warnings"] == "" and not caplog.records


def test_all_at_once_in_a_narrow_box_on_disk_and_pooled(tmp_path, caplog):
    scene = gg.Scene(n_particles=4, area_fraction=0.4, contact_time=1.0)
    with caplog.at_level(logging.WARNING, "granugas"):
        runs = [gg.simulate(scene, 0.01, realization=k, progress=False) for k in range(2)]
    assert [line.split(" ")[0] for line in runs[0].attrs["warnings"].splitlines()] == ["contact_time", "box", "n_particles"]
    said = [record.getMessage() for record in caplog.records]
    assert len(said) == len(set(said)) == 3
    write(runs[0], tmp_path / "run.nc")
    assert read(tmp_path / "run.nc").attrs["warnings"] == runs[0].attrs["warnings"]
    pooled = pool([runs[0], runs[1].assign_attrs(warnings="")], ["n_particles"])
    assert pooled["warnings"].values.tolist() == [[runs[0].attrs["warnings"], ""]]


def test_heating_that_nothing_balances():
    lines = before(gg.Scene(n_particles=144, restitution=1.0, contact_time=0.0, heating=2.0))
    assert lines == ["heating = 2 m^2/s^3 at restitution = 1: nothing dissipates, the energy grows without end"]
    assert before(gg.Scene(n_particles=144, restitution=0.9, heating=2.0)) == []


def test_keys_of_other_sizes():
    assert before(gg.Scene(n_particles=144, size_ratio=3.0)) == ["size_ratio = 3 has no effect with sizes = equal"]
    assert before(gg.Scene(n_particles=144, sizes="bidisperse", size_ratio=3.0)) == []
    lines = before(gg.Scene(n_particles=144, sizes="uniform", size_share=0.1, size_spread=0.3))
    assert lines == ["size_share = 0.1 has no effect with sizes = uniform"]
