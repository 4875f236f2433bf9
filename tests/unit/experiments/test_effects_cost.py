"""Effects timed side by side: that the same is timed, and against the right gas."""

import numpy as np
import pytest

from granugas.experiments import effects_cost
from granugas.experiments.effects import ROWS
from granugas.storage.variables import describe


@pytest.fixture(scope="module")
def measured():
    return describe(effects_cost.measure(effects_cost.Plan((effects_cost.Size(500, 5.0, 3), effects_cost.Size(1000, 2.0, 2)))))


def test_every_effect_of_the_loop_is_timed(measured):
    assert set(measured["effect"].values) == {row.name for row in ROWS} - {"LRV beads"}
    assert measured.attrs["plain"] == "elastic disks"
    cost = measured["cpu_per_collision"]
    assert float(cost.min()) > 10
    assert int(cost.sel(n_particles=500).isnull().sum()) == 0
    assert cost.sel(n_particles=1000).isnull().sum("repetition").values.tolist() == [1] * cost.sizes["effect"]


def test_what_is_added_is_counted_from_the_plain_gas_of_the_same_repetition(measured):
    assert (measured["cpu_added"].sel(effect="elastic disks").dropna("repetition", how="all").fillna(0) == 0).all()
    cost = measured["cpu_per_collision"]
    np.testing.assert_array_equal(measured["cpu_added"], cost - cost.sel(effect=measured.attrs["plain"]))


def test_what_takes_longer_is_seen(measured):
    """Random kicks predict everything anew, ten times in a mean free time; beads have two neighbours."""
    added = measured["cpu_added"].median("repetition")
    assert (added.sel(effect="random kicks (driving)") > 1000).all()
    assert (added.sel(effect="beads (one dimension)") < 0).all()


def test_nothing_of_it_is_content(measured):
    """Times differ from run to run: their names say so (dataset.NOT_CONTENT)."""
    assert all(name.startswith("cpu_") for name in measured.data_vars)


def test_repetitions_follow_the_same_collisions(monkeypatch):
    """Each one ends in the state in which the one before ended."""
    ends = {}

    class Remembering(effects_cost.Engine):
        def advance(self, *arguments):
            why = super().advance(*arguments)
            if self.collisions > 1:
                ends.setdefault(id(self), []).append((self.collisions, self.state().position.tobytes()))
            self.kept = ends  # alive as long as its number
            return why

    monkeypatch.setattr(effects_cost, "Engine", Remembering)
    effects_cost.timed(effects_cost.Size(100, 4.0, 3), tuple(effects_cost.NAMED))
    assert len(ends) == len(effects_cost.NAMED)
    assert all(len(found) == 3 and len(set(found)) == 1 for found in ends.values())
    assert {found[0][0] for found in ends.values()} == {200}
