"""What rounding adds up to: a billion elastic collisions in `make test-full`, whose table and picture stand in docs."""

from pathlib import Path

import numpy as np
import pytest
from drift import FIRST, draw, measure
from gaps import TOLERATED

DOCS = Path(__file__).parents[2] / "docs" / "reliability"


def check(rows, collisions):
    """Nothing overlaps, momentum stays, and a collision adds to the energy at most 3e-20 of the energy of all 1435 disks."""
    assert rows["collisions"].iloc[[0, -1]].tolist() == [FIRST, collisions]
    assert rows["gap"].min() >= -TOLERATED
    assert rows["momentum"].max() <= 1e-14
    assert np.all(abs(rows["energy"]) <= 1e-15 + 3e-20 * rows["collisions"])
    assert rows["time"].is_monotonic_increasing


def test_two_million_collisions(tmp_path):
    collisions = 2_000_000
    rows = measure(collisions, tmp_path / "drift.csv")
    check(rows, collisions)
    draw(rows, tmp_path / "drift.png")
    assert (tmp_path / "drift.png").stat().st_size > 10_000
    assert len((tmp_path / "drift.csv").read_text().splitlines()) == len(rows) + 1


@pytest.mark.full
@pytest.mark.timeout(7200, method="thread")  # a signal would wait for the compiled code to return
def test_a_billion_collisions():
    collisions = 1_000_000_000
    rows = measure(collisions, DOCS / "drift.csv")
    draw(rows, DOCS / "drift.png")
    check(rows, collisions)
