"""A wrong configuration ends before any job, with one line that names the key, the value and what is allowed."""

import copy
from pathlib import Path

import pytest
import yaml
from snakemake.utils import update_config
from workflow.project import ROOT, Project

from granugas import studies
from granugas.configuration import ConfigError, refuse_duplicate_keys

SCHEMA = yaml.safe_load((ROOT / "workflow/schemas/config.schema.yaml").read_text())
FIGURES = {"cooling": ("scan",), "elsewhere": ("another_study",)}
GOOD = yaml.safe_load("""
output: results
seed: 7
figures: all
studies:
  scan:
    grid: {n_particles: [42, 100], area_fraction: 0.2, restitution: [0.8, 0.4], contact_time: 1.0e-5}
    realizations: 2
    until: {time: 0.2}
    samples: {spacing: log, count: 20, first: 1.0e-3}
    snapshots: [0.1]
    distance_factors: [1.05, 1.1]
""")

GRID = "studies: {scan: {grid: {%s}}}"
STUDY = "studies: {scan: {%s}}"
WRONG = [
    # overlay, key, value, what is allowed
    (GRID % "restitution: 1.2", "studies.scan.grid.restitution", "1.2", ">= 0 and <= 1"),
    (GRID % "restitution: [0.8, -0.1]", "studies.scan.grid.restitution", "-0.1", ">= 0 and <= 1"),
    (GRID % "restitution: .nan", "studies.scan.grid.restitution", "nan", ">= 0 and <= 1"),
    (GRID % "restitution: true", "studies.scan.grid.restitution", "True", ">= 0 and <= 1"),
    (GRID % "restitution: []", "studies.scan.grid.restitution", "[]", "a list with at least one value"),
    (GRID % "restitution: [0.8, 0.80]", "studies.scan.grid.restitution", "0.8", "stands twice; allowed is once"),
    (GRID % "restitution: null", "studies.scan.grid.restitution", "None", ">= 0 and <= 1"),
    (GRID % "restitutoin: 0.8", "studies.scan.grid.restitutoin", "0.8", "did you mean restitution?"),
    (
        GRID % "contact_time: 1e-5",
        "studies.scan.grid.contact_time",
        "'1e-5'",
        ">= 0 s ('1e-5' is text; as a number write 1.0e-5)",
    ),
    (GRID % "contact_time: -1.0e-5", "studies.scan.grid.contact_time", "-1e-05", ">= 0 s"),
    (GRID % "contact_time: .inf", "studies.scan.grid.contact_time", "inf", ">= 0 s"),
    (GRID % "contact_time: [[1.0e-5]]", "studies.scan.grid.contact_time", "[1e-05]", "restitution = 1 only"),
    (GRID % "n_particles: 100.0", "studies.scan.grid.n_particles", "100.0", "an integer from 1 to 10000000"),
    (GRID % "n_particles: 0", "studies.scan.grid.n_particles", "0", "an integer from 1 to 10000000"),
    (GRID % "n_particles: '100'", "studies.scan.grid.n_particles", "'100'", "as a number write 100"),
    (GRID % "area_fraction: 0.91", "studies.scan.grid.area_fraction", "0.91", "> 0 and <= 0.9069 (close packing)"),
    (GRID % "area_fraction: 0", "studies.scan.grid.area_fraction", "0", "> 0 and <= 0.9069"),
    (GRID % "{lattice: square, area_fraction: 0.8}"[1:-1], "studies.scan.grid.area_fraction", "0.8", "0.785"),
    (GRID % "{lattice: square, n_particles: 43}"[1:-1], "studies.scan.grid.n_particles", "43", "42"),
    (GRID % "diameter: 0", "studies.scan.grid.diameter", "0", "> 0 m"),
    (GRID % "velocity_half_width: fast", "studies.scan.grid.velocity_half_width", "'fast'", "> 0 m/s"),
    (GRID % "lattice: hexagonal", "studies.scan.grid.lattice", "'hexagonal'", "auto, triangular, square"),
    (GRID % "dynamics: [events, magic]", "studies.scan.grid.dynamics", "'magic'", "allowed are events"),
    (STUDY % "grid: [42]", "studies.scan.grid", "[42]", "a block with the keys n_particles, area_fraction"),
    (STUDY % "scene: {dimensions: 7}", "studies.scan.scene.dimensions", "7", "allowed are 2"),
    (STUDY % "scene: {boundary: open}", "studies.scan.scene.boundary", "'open'", "allowed are periodic"),
    (STUDY % "scene: {aspect_ratio: -1}", "studies.scan.scene.aspect_ratio", "-1", "> 0"),
    (
        STUDY % "scene: {gravity: 9.81}",
        "studies.scan.scene.gravity",
        "9.81",
        "allowed are aspect_ratio, boundary, dimensions",
    ),
    (
        STUDY % "grid: {aspect_ratio: 2}, scene: {aspect_ratio: 1}",
        "studies.scan.scene.aspect_ratio",
        "1",
        "allowed once",
    ),
    (STUDY % "realizations: 0", "studies.scan.realizations", "0", "an integer >= 1 and <= 10000"),
    (STUDY % "realizations: true", "studies.scan.realizations", "True", "an integer >= 1"),
    (STUDY % "realizations: 2.0", "studies.scan.realizations", "2.0", "an integer >= 1"),
    (STUDY % "realisations: 2", "studies.scan.realisations", "2", "did you mean realizations?"),
    (STUDY % "until: null", "studies.scan.until", "None", "a block with the keys time, collisions_per_particle"),
    (STUDY % "until: {time: 0}", "studies.scan.until.time", "0", "a number > 0"),
    (
        STUDY % "until: {time: 1e3}",
        "studies.scan.until.time",
        "'1e3'",
        "a number > 0 ('1e3' is text; as a number write 1000)",
    ),
    (STUDY % "until: {time: .inf}", "studies.scan.until.time", "inf", "a number > 0"),
    (STUDY % "until: {time: true}", "studies.scan.until.time", "True", "a number > 0"),
    (STUDY % "until: {tme: 1}", "studies.scan.until.tme", "1", "did you mean time?"),
    (
        STUDY % "until: {collisions_per_particle: -3}",
        "studies.scan.until.collisions_per_particle",
        "-3",
        "a number > 0",
    ),
    (
        STUDY % "samples: {spacing: logarithmic}",
        "studies.scan.samples.spacing",
        "'logarithmic'",
        "allowed are log, linear",
    ),
    (STUDY % "samples: {count: 1}", "studies.scan.samples.count", "1", "an integer >= 2"),
    (STUDY % "samples: {count: 20.0}", "studies.scan.samples.count", "20.0", "an integer >= 2"),
    (STUDY % "samples: {first: 0}", "studies.scan.samples.first", "0", "a number > 0"),
    (STUDY % "samples: {first: 0.2}", "studies.scan.samples.first", "0.2", "> 0 and < 0.2 (until.time)"),
    (
        STUDY % "samples: {axis: collisions}",
        "studies.scan.samples.axis",
        "'collisions'",
        "until.collisions_per_particle",
    ),
    (STUDY % "samples: {axis: space}", "studies.scan.samples.axis", "'space'", "allowed are time, collisions"),
    (STUDY % "snapshots: [0.1, 0.3]", "studies.scan.snapshots", "0.3", "from 0 to 0.2 s (until.time)"),
    (STUDY % "snapshots: [-0.1]", "studies.scan.snapshots", "-0.1", "a number >= 0"),
    (STUDY % "snapshots: 0.1", "studies.scan.snapshots", "0.1", "a list with at least one value, each a number >= 0"),
    (STUDY % "snapshots: []", "studies.scan.snapshots", "[]", "a list with at least one value"),
    (STUDY % "snapshots: [0.1, 0.1]", "studies.scan.snapshots", "0.1", "stands twice"),
    (STUDY % "distance_factors: [1.05, 0.9]", "studies.scan.distance_factors", "0.9", "> 1"),
    (STUDY % "distance_factors: [1.1, .nan]", "studies.scan.distance_factors", "nan", "> 1"),
    (STUDY % "distance_factors: [1.1, '1.2']", "studies.scan.distance_factors", "'1.2'", "as a number write 1.2"),
    (
        STUDY % "equilibration: {collisions_per_particle: 0}",
        "studies.scan.equilibration.collisions_per_particle",
        "0",
        "> 0",
    ),
    (STUDY % "checkpoint_seconds: -1", "studies.scan.checkpoint_seconds", "-1", "a number > 0"),
    ("studies: {scan: null}", "studies.scan", "None", "a block with the keys grid"),
    ("studies: {My-Study: {until: {time: 1}}}", "studies.My-Study", "{'until'", "a name of a-z, 0-9 and _"),
    ("studies: {1998: {until: {time: 1}}}", "studies.1998", "1998", "write it in quotes"),
    ("studies: {empty: {}}", "studies.empty.until", "(missing)", "a block with the keys time"),
    ("animations: {film: {study: scam}}", "animations.film.study", "'scam'", "did you mean scan?"),
    ("animations: {film: {study: scan}}", "animations.film.study", "'scan'", "one point in its grid"),
    ("animations: {film: {colour: energy}}", "animations.film.study", "(missing)", "text"),
    (
        "animations: {film: {study: scan, colour: red}}",
        "animations.film.colour",
        "'red'",
        "allowed are energy, collision_frequency",
    ),
    ("animations: {film: {study: scan, color: energy}}", "animations.film.color", "'energy'", "did you mean colour?"),
    ("animations: {a/b: {study: scan}}", "animations.a/b", "{'study'", "names of a-z, 0-9 and _"),
    ("seed: -1", "seed", "-1", "an integer >= 0 and <= 4294967295"),
    ("seed: 1.5", "seed", "1.5", "an integer >= 0"),
    ("sead: 1", "sead", "1", "did you mean seed?"),
    ("output: ''", "output", "''", "a path of letters, digits"),
    ("output: 'a{b}'", "output", "'a{b}'", "a path of letters, digits"),
    ("figures: cooling", "figures", "'cooling'", "the word all or a list of names"),
    ("figures: []", "figures", "[]", "the word all or a list of names"),
    ("figures: [coolign]", "figures", "'coolign'", "did you mean cooling? allowed are cooling, study_scan"),
    ("figures: [elsewhere]", "figures", "'elsewhere'", "another_study is not"),
    ("figures: [cooling, cooling]", "figures", "'cooling'", "stands twice"),
]


@pytest.mark.parametrize(("overlay", "key", "value", "allowed"), WRONG, ids=[case[0] for case in WRONG])
def test_message_names_key_value_and_what_is_allowed(overlay: str, key: str, value: str, allowed: str) -> None:
    config = copy.deepcopy(GOOD)
    update_config(config, yaml.safe_load(overlay))
    with pytest.raises(ConfigError) as caught:
        studies.load(config, SCHEMA, FIGURES)
    message = str(caught.value)
    assert message.startswith(f"{key} = {value}")
    assert allowed in message
    assert "\n" not in message


def test_the_table_starts_from_a_good_configuration() -> None:
    assert len(studies.load(GOOD, SCHEMA, FIGURES).runs()) == 8


def test_a_duplicate_key_is_found_in_the_file(tmp_path: Path) -> None:
    file = tmp_path / "mine.yaml"
    file.write_text("studies:\n  scan:\n    grid: {restitution: 0.8, area_fraction: 0.2,\n      restitution: [0.4]}\n")
    with pytest.raises(ConfigError, match=r"^studies.scan.grid.restitution = '\[0.4\]': .*lines 3 and 4.* allowed is once"):
        refuse_duplicate_keys([file])


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (GRID % "restitution: 1.2", "studies.scan.grid.restitution = 1.2: allowed is a number >= 0 and <= 1"),
        (GRID % "contact_time: 1e-5", "studies.scan.grid.contact_time = '1e-5': allowed is a number >= 0 s"),
        (STUDY % "untill: {time: 2}", "did you mean until?"),
        ("seed: 7\nseed: 8", "seed = '8': this key stands twice"),
        ("figures: [coolign]", "figures = 'coolign': unknown figure"),
    ],
)
def test_the_command_says_it_in_one_line_and_writes_nothing(project: Project, text: str, said: str) -> None:
    project.configure(**GOOD)
    (project.folder / "mine.yaml").write_text(text)
    done = project.snakemake("--configfile", "mine.yaml")
    assert done.returncode == 1
    assert [line for line in done.stdout.splitlines() if line.startswith("configuration: ") and said in line]
    assert "Traceback" not in done.stdout
    assert not (project.folder / "results").exists()


def test_numbers_of_the_command_line_that_arrive_as_text_are_told_as_such(project: Project) -> None:
    project.configure(**GOOD)
    done = project.snakemake("--dry-run", "--config", "studies={scan: {realizations: 3}}")
    assert done.returncode == 1
    assert "studies.scan.realizations = '3': allowed is an integer >= 1 and <= 10000 ('3' is text" in done.stdout
