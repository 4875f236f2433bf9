"""A wrong configuration ends before any job, with one line that names the key, the value and what is allowed."""

import copy
import resource
from collections.abc import Iterator
from pathlib import Path

import pytest
import yaml
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
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
    (GRID % "contact_time: [[1.0e-5]]", "studies.scan.grid.contact_time", "[1e-05]", "a number >= 0 s"),
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
        STUDY % "scene: {gravitation: 9.81}",
        "studies.scan.scene.gravitation",
        "9.81",
        "unknown key, did you mean gravity? allowed are aspect_ratio, boundary, ",
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
    ("figures: [1]", "figures", "[1]", "the word all or a list of names"),
    ("figures: [[cooling]]", "figures", "[['cooling']]", "the word all or a list of names"),
    ("figures: All", "figures", "'All'", "the word all or a list of names"),
    # misspelt at every level
    ("outptu: results", "outptu", "'results'", "did you mean output?"),
    ("studys: {}", "studys", "{}", "did you mean studies?"),
    ("allow_larg: true", "allow_larg", "True", "did you mean allow_large?"),
    (STUDY % "snapshot: [0.1]", "studies.scan.snapshot", "[0.1]", "did you mean snapshots?"),
    (STUDY % "samples: {coutn: 20}", "studies.scan.samples.coutn", "20", "did you mean count?"),
    (STUDY % "scene: {aspectratio: 2}", "studies.scan.scene.aspectratio", "2", "did you mean aspect_ratio?"),
    (
        STUDY % "equilibration: {collisions: 50}",
        "studies.scan.equilibration.collisions",
        "50",
        "did you mean collisions_per_particle?",
    ),
    ("animations: {film: {study: scan, sceen: 1}}", "animations.film.sceen", "1", "unknown key"),
    # types
    ("seed: true", "seed", "True", "an integer >= 0"),
    ("seed: null", "seed", "None", "an integer >= 0"),
    ("seed: .nan", "seed", "nan", "an integer >= 0"),
    ("seed: 4294967296", "seed", "4294967296", "<= 4294967295"),
    ("output: 3", "output", "3", "a path of letters"),
    ("output: [results]", "output", "['results']", "a path of letters"),
    ("studies: [scan]", "studies", "['scan']", "one or more studies"),
    ("studies: null", "studies", "None", "one or more studies"),
    ("animations: film", "animations", "'film'", "blocks of keys"),
    ("allow_large: 1", "allow_large", "1", "true or false"),
    ("allow_large: 'true'", "allow_large", "'true'", "true or false"),
    (GRID % "n_particles: true", "studies.scan.grid.n_particles", "True", "an integer from 1"),
    (GRID % "n_particles: {from: 1, to: 9}", "studies.scan.grid.n_particles", "{'from': 1, 'to': 9}", "an integer from 1"),
    (GRID % "n_particles: [42, null]", "studies.scan.grid.n_particles", "None", "an integer from 1"),
    (GRID % "n_particles: 1_0.5", "studies.scan.grid.n_particles", "10.5", "an integer from 1"),
    (GRID % "restitution: '0.8'", "studies.scan.grid.restitution", "'0.8'", "as a number write 0.8"),
    (GRID % "area_fraction: [0.2, .inf]", "studies.scan.grid.area_fraction", "inf", "> 0 and <= 0.9069"),
    (GRID % "area_fraction: .nan", "studies.scan.grid.area_fraction", "nan", "> 0 and <= 0.9069"),
    (GRID % "diameter: 1.0e+200", "studies.scan.grid.diameter", "1e+200", "from 1e-50 to 1e+50"),
    (GRID % "velocity_half_width: 1.0e-300", "studies.scan.grid.velocity_half_width", "1e-300", "from 1e-50 to 1e+50"),
    (STUDY % "scene: {aspect_ratio: 1.0e+12}", "studies.scan.scene.aspect_ratio", "1000000000000.0", "from 0.0001 to 10000"),
    (GRID % "diameter: 1e-3", "studies.scan.grid.diameter", "'1e-3'", "as a number write 0.001"),
    (GRID % "velocity_half_width: false", "studies.scan.grid.velocity_half_width", "False", "> 0 m/s"),
    (GRID % "lattice: [[auto]]", "studies.scan.grid.lattice", "['auto']", "auto, triangular, square"),
    (GRID % "lattice: 2024-01-01", "studies.scan.grid.lattice", "datetime.date(2024, 1, 1)", "auto, triangular, square"),
    (GRID % "lattice: []", "studies.scan.grid.lattice", "[]", "at least one value"),
    (STUDY % "until: [1.0]", "studies.scan.until", "[1.0]", "a block with the keys time, collisions_per_particle"),
    (STUDY % "until: {collisions_per_particle: .nan}", "studies.scan.until.collisions_per_particle", "nan", "a number > 0"),
    (STUDY % "snapshots: [true]", "studies.scan.snapshots", "True", "a number >= 0"),
    (STUDY % "snapshots: [.nan]", "studies.scan.snapshots", "nan", "a number >= 0"),
    (STUDY % "snapshots: [1e-1]", "studies.scan.snapshots", "'1e-1'", "as a number write 0.1"),
    (STUDY % "distance_factors: []", "studies.scan.distance_factors", "[]", "a list with at least one value"),
    (STUDY % "distance_factors: [1.1, 1.10]", "studies.scan.distance_factors", "1.1", "stands twice"),
    (STUDY % "distance_factors: [20]", "studies.scan.distance_factors", "20", "<= 10"),
    (STUDY % "checkpoint_seconds: .inf", "studies.scan.checkpoint_seconds", "inf", "a number > 0"),
    (STUDY % "max_seconds: 0", "studies.scan.max_seconds", "0", "a number > 0"),
    (STUDY % "max_seconds: '60'", "studies.scan.max_seconds", "'60'", "as a number write 60"),
    (STUDY % "max_collisions: 1.0e+6", "studies.scan.max_collisions", "1000000.0", "an integer >= 1"),
    (STUDY % "max_collisions: 0", "studies.scan.max_collisions", "0", "an integer >= 1"),
    (STUDY % "realizations_per_job: 0", "studies.scan.realizations_per_job", "0", "an integer >= 1"),
    # what contradicts something else
    (STUDY % "realizations_per_job: 2", "studies.scan.realizations_per_job", "2", "1 where clusters are analysed"),
    (STUDY % "samples: {first: 5.0}", "studies.scan.samples.first", "5.0", "> 0 and < 0.2 (until.time)"),
    (
        STUDY % "until: {collisions_per_particle: 9}, samples: {axis: collisions, first: 10}",
        "studies.scan.samples.first",
        "10.0",
        "> 0 and < 9 (until.collisions_per_particle)",
    ),
    (
        "studies: {one: {grid: {n_particles: 1}, until: {collisions_per_particle: 5}}}",
        "studies.one.until.time",
        "(missing)",
        "a single disk never collides",
    ),
    (
        "studies: {one: {until: {collisions_per_particle: 5}, samples: {axis: time}}}",
        "studies.one.samples.axis",
        "'time'",
        "until.time",
    ),
    # what does not fit: into a box, into memory, into a week
    (GRID % "{n_particles: 5, area_fraction: 0.6}"[1:-1], "studies.scan.grid.area_fraction", "0.6", "5 disks fit"),
    (GRID % "{n_particles: 43, area_fraction: 0.9}"[1:-1], "studies.scan.grid.area_fraction", "0.9", "43 disks fit"),
    (GRID % "{lattice: triangular, n_particles: 41}"[1:-1], "studies.scan.grid.n_particles", "41", "the nearest that fits"),
    (
        STUDY % "grid: {n_particles: 10000000}, samples: {count: 100000}",
        "studies.scan.grid.n_particles",
        "10000000",
        "need 1.6e+13 bytes",
    ),
    (GRID % "n_particles: 1000000000", "studies.scan.grid.n_particles", "1000000000", "an integer from 1 to 10000000"),
    (STUDY % "realizations: 10000", "studies.scan", "40000 runs of 40000 in all", "allow_large: true"),
    (
        STUDY % f"grid: {{diameter: [{', '.join(f'1.{k:04}' for k in range(1250, 2501))}]}}",
        "studies.scan",
        "10008 runs of 10008 in all",
        "allow_large: true",
    ),
    # nothing is evaluated, nothing reaches a shell
    ("studies: {'$(touch hacked)': {until: {time: 1}}}", "studies.$(touch hacked)", "{'until'", "a name of a-z"),
    ("studies: {'a; touch hacked': {until: {time: 1}}}", "studies.a; touch hacked", "{'until'", "a name of a-z"),
    ("studies: {../up: {until: {time: 1}}}", "studies.../up", "{'until'", "a name of a-z"),
    ("studies: {a/b: {until: {time: 1}}}", "studies.a/b", "{'until'", "a name of a-z"),
    ("studies: {a b: {until: {time: 1}}}", "studies.a b", "{'until'", "a name of a-z"),
    ("studies: {a.b: {until: {time: 1}}}", "studies.a.b", "{'until'", "a name of a-z"),
    ("studies: {'': {until: {time: 1}}}", "studies.", "{'until'", "a name of a-z"),
    ("studies: {'{wildcard}': {until: {time: 1}}}", "studies.{wildcard}", "{'until'", "a name of a-z"),
    ('studies: {"q\'\\"": {until: {time: 1}}}', "studies.q'\"", "{'until'", "a name of a-z"),
    ('studies: {"two\\nlines": {until: {time: 1}}}', "studies.'two\\nlines'", "{'until'", "a name of a-z"),
    ('studies: {"ends\\n": {until: {time: 1}}}', "studies.'ends\\n'", "{'until'", "a name of a-z"),
    ('animations: {"film\\n": {study: scan}}', "animations.'film\\n'", "{'study'", "names of a-z"),
    ("animations: {film: {study: '$(touch hacked)'}}", "animations.film.study", "'$(touch hacked)'", "allowed are scan"),
    ("output: $(touch hacked)", "output", "'$(touch hacked)'", "a path of letters"),
    ("output: a;b", "output", "'a;b'", "a path of letters"),
    ('output: "results\\n"', "output", "'results\\n'", "a path of letters"),
    ("output: -rf", "output", "'-rf'", "a path of letters"),
    ("figures: ['$(touch hacked)']", "figures", "'$(touch hacked)'", "unknown figure"),
    ('figures: ["../../etc\\n"]', "figures", "'../../etc\\n'", "unknown figure"),
    (GRID % "lattice: '__import__(\"os\")'", "studies.scan.grid.lattice", "'__import__(\"os\")'", "auto, triangular"),
    (GRID % "n_particles: 42; touch hacked", "studies.scan.grid.n_particles", "'42; touch hacked'", "an integer from 1"),
    ('seed: "$(id)"', "seed", "'$(id)'", "an integer"),
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
    assert message.isprintable()


def test_the_table_starts_from_a_good_configuration() -> None:
    assert len(studies.load(GOOD, SCHEMA, FIGURES).runs()) == 8


def test_many_runs_are_allowed_to_who_asks_for_them(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(studies, "MOST_RUNS", 7)
    with pytest.raises(ConfigError, match=r"studies\.scan = 8 runs of 8 in all: allowed are 7 runs"):
        studies.load(GOOD, SCHEMA)
    assert len(studies.load(GOOD | {"allow_large": True}, SCHEMA).runs()) == 8


def test_a_run_of_elastic_disks_serves_all_contact_times_and_counts_once(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(studies, "MOST_RUNS", 5)
    grid = {"n_particles": 42, "restitution": [1, 0.9], "contact_time": [1e-3, 1e-4, 1e-5]}
    block = {"grid": grid, "until": {"time": 1.0}}
    with pytest.raises(ConfigError, match="allowed are 5 runs"):
        studies.load({"studies": {"b": block | {"grid": grid | {"restitution": [0.8, 0.9]}}}}, SCHEMA)
    assert len(studies.load({"studies": {"a": block}}, SCHEMA).runs()) == 4


def test_memory_that_is_not_there(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(studies, "memory_at_hand", lambda: 20_000)
    with pytest.raises(ConfigError, match="n_particles = 42: allowed is what fits into the memory at hand, 2e") as caught:
        studies.load(GOOD, SCHEMA)
    assert "42 disks and positions at 20 samples need" in str(caught.value)


JUNK = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(),
    st.floats(),
    st.text(max_size=8),
    st.sampled_from([1e-300, 1e300, 1e-5, 0.5, 1.0, 42, 1, "1e-5", "all", "time", "scan", "$(id)", "a\n", [], {}, {1: 2}]),
)
KEYS = ["grid", "until", "samples", "snapshots", "restitution", "n_particles", "area_fraction", "contact_time", "lattice"]
KEYS += ["scene", "aspect_ratio", "time", "first", "count", "axis", "realizations", "diameter", "scan", "studies", "seed"]
KEYS += ["distance_factors", "equilibration", "collisions_per_particle", "figures", "output", "animations", "study", "x\n"]


def _places(block: dict, path: tuple = ()) -> Iterator[tuple]:
    for key, value in block.items():
        yield (*path, key)
        if isinstance(value, dict):
            yield from _places(value, (*path, key))


def _taken_or_refused_in_one_line(place: tuple, key: str | None, value: object) -> None:
    """Any value in any place: the configuration is good, or one line says why not; nothing else happens."""
    config = copy.deepcopy(GOOD)
    block = config
    for name in place[:-1]:
        block = block[name]
    block[place[-1] if key is None else key] = value
    try:
        for run in studies.load(config, SCHEMA, FIGURES).runs().values():
            assert run.address.isprintable() and "/" not in run.address and run.cost > 0
    except ConfigError as error:
        assert str(error).isprintable()


ANYTHING = {
    "place": st.sampled_from(list(_places(GOOD))),
    "key": st.none() | st.sampled_from(KEYS),
    "value": JUNK | st.lists(JUNK, max_size=3) | st.dictionaries(st.sampled_from(KEYS), JUNK, max_size=3),
}
PATIENT = settings(deadline=None, print_blob=True, suppress_health_check=[HealthCheck.too_slow])  # on a busy machine
test_anything_at_all = settings(PATIENT, max_examples=100)(given(**ANYTHING)(_taken_or_refused_in_one_line))
test_anything_at_all_often = pytest.mark.full(
    settings(PATIENT, max_examples=2000)(given(**ANYTHING)(_taken_or_refused_in_one_line))
)


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
        (STUDY % "realizations: 10000", "studies.scan = 40000 runs of 40000 in all: allowed are 10000 runs"),
        (STUDY % "grid: {n_particles: 10000000}, samples: {count: 100000}", "need 1.6e+13 bytes"),
        (GRID % "{n_particles: 5, area_fraction: 0.6}"[1:-1], "5 disks fit on a lattice up to"),
        ("studies: {'$(touch hacked)': {until: {time: 1}}}", "studies.$(touch hacked) = "),
        ("output: '; touch hacked'", "output = '; touch hacked': allowed is a path"),
        ('studies: {"ends\\n": {until: {time: 1}}}', "studies.'ends\\n' = "),
    ],
)
def test_the_command_says_it_in_one_line_and_writes_nothing(project: Project, text: str, said: str) -> None:
    project.configure(**GOOD)
    (project.folder / "mine.yaml").write_text(text)
    before, used = sorted(project.folder.rglob("*")), _processor_time()
    done = project.snakemake("--configfile", "mine.yaml")
    assert done.returncode == 1
    assert [line for line in done.stdout.splitlines() if line.startswith("configuration: ") and said in line]
    assert "Traceback" not in done.stdout
    assert [path for path in sorted(project.folder.rglob("*")) if ".snakemake" not in path.parts] == before
    assert _processor_time() - used < 5


def _processor_time() -> float:
    """s of all children that have ended; the clock on the wall depends on who else computes."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def test_numbers_of_the_command_line_that_arrive_as_text_are_told_as_such(project: Project) -> None:
    project.configure(**GOOD)
    done = project.snakemake("--dry-run", "--config", "studies={scan: {realizations: 3}}")
    assert done.returncode == 1
    assert "studies.scan.realizations = '3': allowed is an integer >= 1 and <= 10000 ('3' is text" in done.stdout
