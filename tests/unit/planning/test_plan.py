"""Plans of studies: what is there, what is to be done, what it takes; and the other way round."""

import json
import math
from dataclasses import replace
from pathlib import Path

import pytest
import yaml
from workflow.project import ROOT

from granugas import studies
from granugas.__main__ import main
from granugas.configuration import merged
from granugas.execute import perform, start_states
from granugas.planning import plan
from granugas.planning.calibration import Calibration
from granugas.planning.choice import cheapest, overlay
from granugas.planning.expected import bias, end_of, rate_of, scatter
from granugas.planning.plan import as_numbers, forecast, motion_seconds, table
from granugas.scene import Scene
from granugas.storage.dataset import read, write

SCHEMA = yaml.safe_load((ROOT / "workflow/schemas/config.schema.yaml").read_text())
MACHINE = Calibration((500, 5740, 79524), (340.0, 365.0, 530.0), 1.2, 5e-5, 1e-7)
GRID = {"n_particles": 100, "area_fraction": 0.2, "restitution": [0.8, 0.4], "contact_time": 1.0e-5}
SCAN = {"grid": GRID, "until": {"time": 0.05}, "realizations": 2, "samples": {"count": 10}, "distance_factors": [1.1]}
MORE = {**SCAN, "grid": GRID | {"restitution": [0.8, 0.6]}}
BOTH = {"output": "out", "studies": {"scan": SCAN, "more": MORE}}


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with a configuration of two studies that share runs."""
    (tmp_path / "config").mkdir()
    (tmp_path / "config/config.yaml").write_text(yaml.safe_dump(BOTH, sort_keys=False))
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("granugas.planning.calibration.calibration", lambda: MACHINE)
    return tmp_path


def asked(**blocks) -> studies.Studies:
    return studies.load({"output": "out", "studies": blocks}, SCHEMA)


def test_what_is_to_be_done_and_what_is_there(here: Path) -> None:
    both = asked(scan=SCAN, more=MORE)
    found = forecast(both, MACHINE)
    assert (found["scan"].runs, found["scan"].there, found["scan"].shared) == (4, 0, 0)
    assert (found["more"].runs, found["more"].there, found["more"].shared) == (4, 0, 2)
    runs = both.studies["scan"].runs
    expected = sum(end_of(run.scene, run.until).collisions * 50 for run in runs)
    assert found["scan"].collisions == pytest.approx(expected + 2 * 50 * 100 * plan.EQUILIBRATION_ROUNDS)
    for path in (f"runs/{runs[0].address}.nc", f"states/{runs[0].state_address}.nc"):
        (here / "out" / path).parent.mkdir(parents=True, exist_ok=True)
        (here / "out" / path).touch()
    less = forecast(both, MACHINE)["scan"]
    assert less.there == 1 and less.collisions < found["scan"].collisions and less.seconds < found["scan"].seconds - 2
    assert less.errors == found["scan"].errors and less.memory == found["scan"].memory


def test_runs_of_other_sources_are_told(here: Path) -> None:
    one = asked(scan=SCAN | {"distance_factors": [1.1]})
    run = one.studies["scan"].runs[0]
    data = perform(run, start_states(run)).drop_vars("trajectory")
    write(data, f"out/runs/{run.address}.nc")
    engine = json.loads(read(f"out/runs/{run.address}.nc").attrs["provenance"])["engine"]
    assert forecast(one, MACHINE, engine)["scan"].of_other_sources == 0
    assert forecast(one, MACHINE, "another")["scan"].of_other_sources == 1
    assert "1 runs that are there are of other sources" in table(forecast(one, MACHINE, "another"), MACHINE)


def test_seconds_are_those_of_the_machine(here: Path) -> None:
    """Twice as slow in everything is twice the time; ten times the collisions are ten times their time."""
    slow = Calibration(MACHINE.sizes, tuple(2 * ns for ns in MACHINE.ns_per_collision), 2.4, 1e-4, 2e-7)
    once, twice = (forecast(asked(scan=SCAN), machine)["scan"].seconds for machine in (MACHINE, slow))
    assert twice == pytest.approx(2 * once)
    elastic = {"grid": GRID | {"restitution": 1.0, "n_particles": 5740}, "samples": {"count": 2}}
    few, many = (forecast(asked(scan=elastic | {"until": {"collisions_per_particle": c}}), MACHINE)["scan"] for c in (1e4, 1e5))
    assert many.seconds - few.seconds == pytest.approx(9e4 * 2870 * 365e-9, rel=1e-6)


def test_disk_is_about_what_files_take(here: Path) -> None:
    block = {"grid": {"n_particles": 1600, "restitution": 0.4}, "until": {"time": 0.01}, "samples": {"count": 40}}
    study = asked(scan=block | {"snapshots": [0.0, 0.01]})
    run = study.studies["scan"].runs[0]
    states = start_states(run)
    write(states, "state.nc")
    write(perform(run, states), "run.nc")
    taken = sum(Path(name).stat().st_size for name in ("state.nc", "run.nc", "run.nc"))  # the study's is as large as the run's
    assert 0.5 < forecast(study, MACHINE)["scan"].disk / taken < 2


def test_effects_and_other_dynamics_have_their_own_cost() -> None:
    plain = Scene(n_particles=5740, restitution=0.9)
    end = end_of(plain, {"time": 0.1})
    cost = motion_seconds(plain, end, MACHINE)
    assert cost == pytest.approx(end.collisions * 2870 * 365e-9 * plan.COOLING[2])
    walled = replace(plain, boundary="wall")
    assert motion_seconds(walled, end, MACHINE) == pytest.approx(1.12 * cost)
    assert motion_seconds(replace(plain, heating=1.0), end, MACHINE) > 5 * cost
    for dynamics, work, ns in (
        ("dsmc", end.collisions * 2870, plan.OTHER_DYNAMICS["dsmc"]),
        ("soft_spheres", 5740 * end.tau / rate_of(plain) / (1e-5 / 50), plan.OTHER_DYNAMICS["soft_spheres"]),
    ):
        scene = replace(plain, dynamics=dynamics)
        assert motion_seconds(scene, end, MACHINE) == pytest.approx(work * ns * 1e-9)


def test_a_plan_for_people_and_one_for_programs(here: Path, capsys) -> None:
    assert main(["plan", "--workflow", str(ROOT / "workflow")]) == 0
    said = capsys.readouterr().out
    lines = [line.split() for line in said.splitlines()]
    assert lines[0][:3] == ["study", "runs", "there"] and [line[0] for line in lines[1:4]] == ["scan", "more", "all"]
    assert "365 ns per collision" in said
    assert main(["plan", "--json", "--study", "more", "--workflow", str(ROOT / "workflow")]) == 0
    numbers = json.loads(capsys.readouterr().out)
    assert [*numbers["studies"]] == ["more"] and numbers["all"]["runs"] == 4
    found = {"more": forecast(asked(scan=SCAN, more=MORE), MACHINE)["more"]}
    found = json.loads(json.dumps(as_numbers(found, MACHINE)))["studies"]["more"]
    alone = {"runs", "errors", "biases", "memory"}  # what scan does first is not to be done by more
    assert {key: numbers["studies"]["more"][key] for key in alone} == {key: found[key] for key in alone}
    assert not (here / "out").exists()


def test_overlays_count_as_in_a_build(here: Path, capsys) -> None:
    Path("mine.yaml").write_text(yaml.safe_dump({"output": "elsewhere", "studies": {"scan": {"realizations": 5}}}))
    for files in (["mine.yaml"], ["config/config.yaml", "mine.yaml"]):
        assert main(["plan", "--json", "--configfile", *files, "--workflow", str(ROOT / "workflow")]) == 0
        assert json.loads(capsys.readouterr().out)["studies"]["scan"]["runs"] == 10


def study_until(time: float, **block) -> studies.Study:
    return asked(cold={"grid": {"n_particles": 42, "restitution": 0.8}, "until": {"time": time}, **block}).studies["cold"]


def test_the_cheapest_choice_is_good_enough_and_no_better_than_needed() -> None:
    study = study_until(0.05)
    for error in (0.05, 0.02, 0.005):
        choice = cheapest(study, error, "kinetic_energy", MACHINE)
        scene = replace(study.runs[0].scene, n_particles=choice.n_particles, contact_time=choice.contact_time)
        end = end_of(scene, {"time": 0.05})
        assert choice.error == pytest.approx(scatter(scene, end)["kinetic_energy"] / math.sqrt(choice.realizations))
        assert choice.bias == pytest.approx(math.hypot(*bias(scene, end).values())) and choice.bias <= error / 2
        assert math.hypot(choice.error, choice.bias) <= error
        one_less = choice.error * math.sqrt(choice.realizations / (choice.realizations - 1))
        assert choice.realizations == 4 or math.hypot(one_less, choice.bias) > error


def test_a_better_answer_costs_more() -> None:
    costs = [cheapest(study_until(0.05), error, "kinetic_energy", MACHINE).seconds for error in (0.1, 0.03, 0.01, 0.003)]
    assert costs == sorted(costs) and costs[-1] > 3 * costs[0]


def test_the_choice_is_a_study_that_runs_as_it_is(here: Path, capsys) -> None:
    words = ["--study", "more", "--error", "5%", "--of", "mean_cluster_size", "--output", "mine.yaml"]
    assert main(["plan", *words, "--workflow", str(ROOT / "workflow")]) == 0
    said = capsys.readouterr()
    name = "more_mean_cluster_size_5_percent"
    assert said.out.startswith("N = ") and f"out/studies/{name}.nc --configfile config/config.yaml mine.yaml" in said.err
    found = studies.load(merged(["config/config.yaml", "mine.yaml"]), SCHEMA)
    choice = cheapest(asked(more=MORE).studies["more"], 0.05, "mean_cluster_size", MACHINE)
    assert {run.scene.restitution for run in found.studies[name].runs} == {0.8, 0.6}
    assert {run.scene.n_particles for run in found.studies[name].runs} == {choice.n_particles}
    assert len(found.studies[name].runs) == 2 * choice.realizations  # one realization a job, for the clusters
    assert {*found.studies} == {"scan", "more", name}
    assert overlay(MORE, choice, "x")["studies"]["x"]["until"] == MORE["until"]


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--configfile", "none.yaml"], "none.yaml"),
        (["--study", "scam"], "--study = 'scam': unknown study, did you mean scan?"),
        (["--error", "1%"], "--error: name the study"),
        (["--error", "much", "--study", "scan"], "--error much: allowed is a number, or a percentage"),
        (["--error", "0", "--study", "scan"], "--error 0: allowed is a number > 0 and < 1"),
        (["--error", "nan", "--study", "scan"], "--error nan: allowed is"),
        (["--error", "1%", "--of", "energy", "--study", "scan"], "--of energy: allowed are kinetic_energy, pressure"),
        (["--error", "1e-7", "--study", "scan"], "not reached for kinetic_energy of study scan"),
        (["--error", "1%", "--study", "scan", "--output", "config"], "config: not written"),
        (["--error", "1%", "--study", "elastic", "--configfile", "elastic.yaml"], "the kinetic energy is exact"),
        (
            ["--error", "1%", "--of", "mean_cluster_size", "--study", "elastic", "--configfile", "elastic.yaml"],
            "no distance_fact",
        ),
        (["--configfile", "wrong.yaml"], "studies.scan.realizations = 0: allowed is an integer >= 1"),
    ],
)
def test_wrong_words_end_in_one_line(here: Path, words, said, capsys) -> None:
    elastic = {"grid": {"restitution": 1.0}, "until": {"collisions_per_particle": 10}}
    Path("elastic.yaml").write_text(yaml.safe_dump({"studies": {"elastic": elastic}}))
    Path("wrong.yaml").write_text(yaml.safe_dump({"studies": {"scan": {"realizations": 0}}}))
    assert main(["plan", *words, "--workflow", str(ROOT / "workflow")]) == 2
    error = capsys.readouterr().err
    assert said in error and error.count("\n") == 1
