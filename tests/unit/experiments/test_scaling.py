"""What is timed are the scenes that the dataset tells, and whole runs."""

import pytest

from granugas.experiments import scaling
from granugas.scene import Scene
from granugas.simulate import simulate
from granugas.storage.variables import describe


@pytest.fixture(scope="module")
def measured():
    return describe(scaling.measure(scaling.SMALL))


def test_every_collision_takes_time(measured):
    times = [name for name in measured.data_vars if name.startswith("cpu_")]
    assert len(times) == 4
    assert all(float(measured[name].min()) > 30 and float(measured[name].max()) < 1e5 for name in times)
    rounds = measured["cpu_by_size"]
    assert (rounds.sel(statistic="fastest") <= rounds.sel(statistic="median")).all()
    assert (rounds.sel(statistic="median") <= rounds.sel(statistic="slowest")).all()


def test_collisions_and_clusters_are_those_of_the_runs(measured):
    """The same gases through the door that all runs take."""
    n, times = scaling.SMALL.clustering
    scene = Scene(n, **scaling.PAPER_B)
    start = scaling.equilibrate(scene, seed=1, collisions_per_particle=30.0)
    run = simulate(scene, times[-1], state=start, samples={"count": 1}, progress=False)
    assert measured["collisions_per_particle"].values[-1] == 2 * int(run["events"]) / n
    found = scaling.find_clusters(run, distance_factors=[scaling.DISTANCE_FACTOR])
    assert measured["mean_cluster_size"].values[-1] == pytest.approx(float(found["mean_cluster_size"].values.ravel()[-1]))


def test_whole_runs_are_those_of_the_contact_times(measured):
    """And differ: a contact time of a thousandth of a second makes other collisions elastic than one of a hundredth of it."""
    for t_c, found in zip(scaling.SMALL.contact_times, measured["run_collisions"].values, strict=True):
        scene = Scene(scaling.SIZE, contact_time=t_c)
        start = scaling.equilibrate(scene, seed=1, collisions_per_particle=30.0)
        run = simulate(scene, scaling.SMALL.until, state=start, samples={"count": 1}, keep_positions=False, progress=False)
        assert found == 2 * int(run["events"]) / scaling.SIZE
    assert len(set(measured["run_collisions"].values)) == len(scaling.SMALL.contact_times)
