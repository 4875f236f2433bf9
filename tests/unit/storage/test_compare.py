"""Whether two datasets agree."""

import numpy as np
import pytest
import xarray as xr

import granugas as gg
from granugas.__main__ import main
from granugas.storage.compare import compare
from granugas.storage.dataset import pool, with_errors, write

RUNS = 40


def study_of(restitution: float, realizations: range, seed: int) -> list[xr.Dataset]:
    scene = gg.Scene(n_particles=30, area_fraction=0.1, restitution=restitution)
    start = {"samples": {"spacing": "log", "count": 15, "first": 1e-3}, "keep_positions": False, "progress": False}
    return [gg.simulate(scene, 0.1, seed=seed, realization=k, snapshots=[0.05], **start) for k in realizations]


@pytest.fixture(scope="module")
def runs() -> list[xr.Dataset]:
    return study_of(0.8, range(RUNS), 1)


@pytest.fixture(scope="module")
def others() -> list[xr.Dataset]:
    return study_of(0.6, range(8), 2)


def pooled(parts: list[xr.Dataset]) -> xr.Dataset:
    return pool([part.assign(realization=k) for k, part in enumerate(parts)], [])


def test_equal_bit_for_bit(runs):
    again = runs[0].assign(wall_time=99.0)
    found = compare(runs[0], again)
    assert found.same_bits and found.agree and str(found) == "equal bit for bit"


def test_two_single_runs_by_relative_differences(runs):
    one = runs[0]
    other = one.copy(deep=True)
    other["kinetic_energy"].values[7] *= 1.01
    found = compare(one, other)
    assert not found.agree and not found.statistical
    first = found.differences[0]
    assert first.name == "kinetic_energy" and first.size == pytest.approx(0.01 / 1.01)
    assert first.where == f"time = {one['time'].values[7]:.6g}"
    assert found.differences[1].size == 0
    other["kinetic_energy"].values[7] = one["kinetic_energy"].values[7] * (1 + 4e-16)
    assert compare(one, other).agree and not compare(one, other).same_bits
    other["kinetic_energy"].values[7] = np.nan
    assert not compare(one, other).agree
    assert not compare(one, runs[1]).agree


def test_errors_are_no_difference_of_their_own(runs):
    first, second = (with_errors(pooled(runs[k : k + 4])) for k in (0, 4))
    assert compare(first, second).agree
    assert not [found.name for found in compare(first, second).differences if found.name.endswith("_error")]


@pytest.mark.parametrize("size", [2, 4, 8])
def test_two_samples_of_one_system_agree(runs, size):
    """Random halves, many times: differences are named no more often than by chance."""
    rng, alarms, rounds = np.random.default_rng(size), 0, 5
    for _ in range(rounds):
        drawn = rng.permutation(RUNS)[: 2 * size]
        found = compare(pooled([runs[k] for k in drawn[:size]]), pooled([runs[k] for k in drawn[size:]]))
        assert found.statistical and not found.same_bits
        alarms += not found.agree
    assert alarms == 0


def test_another_restitution_is_seen(runs, others):
    as_if_equal = [other.assign_attrs(restitution=0.8) for other in others]
    found = compare(pooled(runs[:8]), pooled(as_if_equal))
    assert not found.agree and not found.remarks
    named = {difference.name for difference in found.differences if difference.size > found.limit}
    assert "kinetic_energy" in named and "enskog_rate" not in named
    assert [d.size for d in found.differences] == sorted((d.size for d in found.differences), reverse=True)
    assert found.differences[0].name in str(found).splitlines()[1]


def test_parameters_and_places_that_differ_are_said(runs, others):
    found = compare(pooled(runs[:4]), pooled(others[:4]))
    assert "restitution: 0.8 in the first, 0.6 in the second" in found.remarks and not found.agree
    half = pooled(runs[:4]).isel(time=slice(0, 8)).drop_vars("tau")
    found = compare(pooled(runs[4:8]), half)
    assert "only in the first: tau" in found.remarks
    assert "time: 16 values in the first, 8 in the second, 8 in common" in found.remarks
    fewer = pooled(runs[:4]).isel(particle=slice(0, 9))
    assert any(remark.startswith("position: ") for remark in compare(pooled(runs[4:8]), fewer).remarks)


def test_values_without_any_spread(runs):
    """A number that is the same in all realizations has no error: it agrees to rounding, or not."""
    one, other = pooled(runs[:4]), pooled(runs[4:8])
    assert compare(one, other.assign(enskog_rate=other["enskog_rate"] * (1 + 1e-14))).agree
    found = compare(one, other.assign(enskog_rate=other["enskog_rate"] * 1.001))
    assert not found.agree and found.differences[0].name == "enskog_rate"
    collapsed = other.assign(stop_reason=xr.full_like(other["stop_reason"], "inelastic_collapse"))
    assert "stop_reason: time in the first, inelastic_collapse in the second" in compare(one, collapsed).remarks


def test_from_the_shell(runs, others, tmp_path, capsys):
    for name, parts in {"a": runs[:4], "b": runs[4:8], "c": others[:4]}.items():
        write(pooled(parts), tmp_path / f"{name}.nc")
    a, b, c = (str(tmp_path / f"{name}.nc") for name in "abc")
    assert main(["compare", a, a]) == 0
    assert capsys.readouterr().out == "equal bit for bit\n"
    assert main(["compare", a, b]) == 0
    assert "equal within errors: means over realizations" in capsys.readouterr().out
    assert main(["compare", a, c]) == 1
    assert "different: means over realizations" in capsys.readouterr().out
