"""All effects in short runs: what they conserve, theory, and how long they are."""

import math
import runpy
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from granugas.analysis import theory
from granugas.dynamics.events.effects import modules_of
from granugas.experiments import effects, effects_checks
from granugas.storage.variables import describe

TABLE = Path(__file__).parents[3] / "workflow" / "tables" / "effects.py"
EFFECTS = "granugas.dynamics.events.effects"


@pytest.mark.parametrize("row", effects.ROWS, ids=lambda row: row.name)
def test_theory_and_what_is_conserved(row):
    found = effects.measure_row(row, effects.SMALL)
    assert abs(found["measured"] - found["expected"]) <= found["allowed"] < 0.35 * abs(found["expected"])
    assert found["momentum_drift"] <= 1e-12
    assert found["energy_balance"] <= 1e-12


@pytest.fixture(scope="module")
def measured() -> xr.Dataset:
    return describe(effects.measure(effects.SMALL))


def test_a_plan_names_its_rows(measured):
    assert measured["effect"].values.tolist() == list(effects.FEW)
    assert effects.FULL.names is None


def test_there_is_a_row_for_each_effect_file():
    """Instruments, and what scenes without any effect hold, are none."""
    files = {path.stem for path in (effects.SOURCES / "dynamics/events/effects").glob("*.py")}
    told = {name for row in effects.ROWS for name in row.files}
    assert files - told == {"__init__", "nobody", "recorder", "contacts"}
    assert len(effects.ROWS) >= 16


@pytest.mark.parametrize("row", effects.ROWS, ids=lambda row: row.name)
def test_scenes_call_for_the_files_of_their_rows(row):
    called = modules_of(row.scene)
    names = [
        f"granugas.{name}" if "." in name else f"{EFFECTS}.{name}" for name in row.files if not name.startswith("lattices")
    ]
    assert set(names) <= set(called)
    assert all(effects.code_lines(name) >= 5 for name in row.files)


def test_a_number_beside_theory_is_told(measured):
    """The table says no where a measured value lies outside of what is allowed."""
    wrong = measured.copy(deep=True)
    wrong["measured"][3] = wrong["expected"][3] + 1.01 * wrong["allowed"][3]
    cost = ("effect", "n_particles", "repetition")
    timed = xr.Dataset(
        {"cpu_per_collision": (cost, np.full((2, 1, 3), 150.0)), "cpu_added": (cost, np.full((2, 1, 3), 50.0))},
        {"effect": measured["effect"].values[:2], "n_particles": [500]},
    )
    rows = runpy.run_path(str(TABLE))["table"]({"effects": wrong, "effects_cost": timed})
    assert rows["agrees"].tolist() == ["no" if k == 3 else "yes" for k in range(len(rows))]
    assert rows["relative_cost_n500"][:2].tolist() == [1.5, 1.5]
    assert rows["relative_cost_n500"][2:].isna().all()
    assert rows["code_lines"].tolist() == measured["code_lines"].values.tolist()


def test_drift_and_balance_see_a_push(monkeypatch):
    """Every particle a thousandth of v_rms faster along x at the end: momentum drifts by that, and energy is not balanced."""
    state = effects_checks.Engine.state

    def pushed(engine):
        found = state(engine)
        if engine.collisions:
            found.velocity[:, 0] += 1e-3 * math.sqrt(2 * effects.HOT)
        return found

    monkeypatch.setattr(effects_checks.Engine, "state", pushed)
    momentum, balance = effects.conservation(effects.PLAIN, 1.0)
    assert momentum == pytest.approx(1e-3, rel=1e-6)
    assert balance == pytest.approx(1e-6, rel=1e-3)


def test_momentum_across_walls_does_not_count():
    before = effects_checks.start_of(effects.PLAIN)
    after = effects.replace(before, velocity=before.velocity + np.array([0.0, 0.1]))
    assert effects.drift(before, after, np.array([True, False])) == 0
    assert effects.drift(before, after, np.array([True, True])) > 0.1
    assert math.isnan(effects.drift(before, after, np.array([False, False])))


def test_code_lines(tmp_path, monkeypatch):
    """No docstrings, comments or blank lines; a text over two lines that is code counts twice."""
    source = '"""About\nit."""\n\nA = 1  # one\n"""That."""\n# no\n\n\ndef f():\n    """No."""\n    return """\n    x"""\n'
    (tmp_path / "lattices").mkdir()
    (tmp_path / "lattices" / "thing.py").write_text(source)
    monkeypatch.setattr(effects, "SOURCES", tmp_path)
    assert effects.code_lines("lattices.thing") == 4


def test_balanced_kicks():
    """Slow partners, drawn: their kicks give what all collisions take."""
    speed = 2 * np.sqrt(effects.HOT * np.random.default_rng(1).exponential(size=1_000_000))
    (scene,) = (row.scene for row in effects.ROWS if row.check is effects.kick)
    loss = np.mean((1 - scene.restitution**2) * speed**2) / 4
    gain = np.mean(scene.restitution * speed < scene.kick_velocity) * scene.kick_energy / 2
    assert gain == pytest.approx(loss, rel=0.01)
    assert effects._balanced_heating() == pytest.approx(
        float((1 - 0.95**2) / 2 * effects.HOT * theory.enskog_rate(0.2267, 2 * effects.HOT / 2, 1e-3)), rel=1e-12
    )


def test_keys_are_what_a_scene_has_beyond_elastic_disks():
    assert effects.keys_of(effects.PLAIN) == ""
    scene = effects.replace(effects.PLAIN, restitution=0.9, contact_time=1 / 3e5, sizes="log_normal")
    assert effects.keys_of(scene) == "restitution: 0.9, contact_time: 3.33333e-06, sizes: log_normal"
