"""Configurations become runs; their addresses follow from physics and from nothing else."""

import copy
import math
import os
import subprocess
import sys
from dataclasses import fields
from pathlib import Path

import pytest
import yaml
from hypothesis import given, settings
from hypothesis import strategies as st

from granugas import studies
from granugas.configuration import ConfigError
from granugas.runs import GRID_KEYS, Run, digest_of
from granugas.scene import SCENE_KEYS, Scene
from granugas.studies import load

ROOT = Path(__file__).resolve().parents[2]
SCHEMA = yaml.safe_load((ROOT / "workflow/schemas/config.schema.yaml").read_text())
STUDY = {
    "grid": {"n_particles": [42, 100], "area_fraction": 0.2, "restitution": [0.8, 0.4], "contact_time": 1.0e-5},
    "realizations": 2,
    "until": {"time": 5.0},
}


def load_study(**changes: object) -> studies.Study:
    grid = STUDY["grid"] | changes.pop("grid", {})
    seed = changes.pop("seed", 7)
    return load({"seed": seed, "studies": {"scan": STUDY | {"grid": grid} | changes}}, SCHEMA).studies["scan"]


def addresses(**changes: object) -> set[str]:
    return {run.address for run in load_study(**changes).runs}


def states(**changes: object) -> set[str]:
    return {run.state_address for run in load_study(**changes).runs}


def test_a_study_is_the_product_of_its_lists_and_realizations() -> None:
    study = load_study()
    assert study.grid_keys == ("n_particles", "area_fraction", "restitution", "contact_time")
    points = [(run.scene.n_particles, run.scene.restitution, *run.realizations) for run in study.runs]
    assert points == [(n, r, k) for n in (42, 100) for r in (0.8, 0.4) for k in (0, 1)]
    assert len(addresses()) == 8
    assert len(states()) == 4


def test_realizations_in_chunks_that_do_not_move_when_some_are_added() -> None:
    def chunks(realizations: int) -> dict[tuple[int, ...], str]:
        block = {"until": {"time": 1.0}, "realizations": realizations, "realizations_per_job": 3}
        runs = load({"studies": {"scan": block}}, SCHEMA).studies["scan"].runs
        return {run.realizations: run.address for run in runs}

    assert list(chunks(7)) == [(0, 1, 2), (3, 4, 5), (6,)]
    assert chunks(7).items() <= chunks(10).items() | {((6,), chunks(7)[6,])}
    assert "_s3-5_" in chunks(7)[3, 4, 5]


def test_a_study_names_only_what_it_varies() -> None:
    (run,) = load({"studies": {"bare": {"until": {"collisions_per_particle": 10}}}}, SCHEMA).studies["bare"].runs
    assert run.scene == Scene()
    assert (run.seed, run.realizations, run.equilibration, run.snapshots) == (1998, (0,), 100.0, ())
    assert run.samples == {"spacing": "log", "count": 100, "first": 1e-3, "axis": "collisions"}


def test_an_address_is_readable_and_names_the_values() -> None:
    run = load_study().runs[0]
    assert run.address.startswith("n42_nu0.2_r0.8_tc1e-05_s0_")
    assert run.state_address.startswith("n42_nu0.2_s0_")


@pytest.mark.parametrize(
    "changes",
    [
        {"seed": 8},
        {"grid": {"diameter": 2.0e-3}},
        {"grid": {"velocity_half_width": 0.25}},
        {"grid": {"lattice": "square", "n_particles": [36, 100]}},
        {"scene": {"aspect_ratio": 2.0}},
        {"equilibration": {"collisions_per_particle": 50}},
    ],
)
def test_what_decides_the_start_state_is_in_both_addresses(changes: dict) -> None:
    assert not addresses(**copy.deepcopy(changes)) & addresses()
    assert not states(**changes) & states()


@pytest.mark.parametrize(
    "changes",
    [
        {"grid": {"restitution": 0.5}},
        {"grid": {"contact_time": 1.0e-6}},
        {"until": {"time": 6.0}},
        {"until": {"time": 5.0, "collisions_per_particle": 100}},
        {"samples": {"count": 101}},
        {"samples": {"first": 1.0e-2}},
        {"samples": {"spacing": "linear"}},
        {"snapshots": [1.0]},
        {"distance_factors": [1.1]},
    ],
)
def test_what_decides_a_run_alone_leaves_the_start_state(changes: dict) -> None:
    assert not addresses(**copy.deepcopy(changes)) & addresses()
    assert states(**changes) == states()


@pytest.mark.parametrize(
    "changes",
    [
        {"until": {"time": 5}},
        {"grid": {"area_fraction": 0.1 + 0.1 + 1e-17}},
        {"grid": {"contact_time": 1.00000000000001e-5}},
        {"scene": {"dimensions": 2, "boundary": "periodic", "aspect_ratio": 1}},
        {"checkpoint_seconds": 5},
        {"max_seconds": 100},
        {"samples": {"spacing": "log", "count": 100, "axis": "time"}},
    ],
)
def test_the_same_physics_has_the_same_address(changes: dict) -> None:
    assert addresses(**changes) == addresses()


def test_the_distance_factors_are_in_the_address_of_the_analysis_only() -> None:
    few, many = load_study(distance_factors=[1.1]), load_study(distance_factors=[1.1, 1.2])
    assert few.runs == many.runs
    assert not set(few.clusters()) & set(many.clusters())
    assert set(load_study(distance_factors=[1.2, 1.1]).clusters()) == set(many.clusters())


def test_values_are_rounded_so_that_equal_addresses_are_equal_runs() -> None:
    one, other = (load_study(grid={"area_fraction": value}).runs for value in (0.3, 0.1 + 0.2))
    assert one == other


def test_beads_whose_slow_contacts_merge_are_one_grid_key() -> None:
    """At 0 hard beads; where the model does not hold the message says so."""
    line = {"scene": {"dimensions": 1}, "realizations": 1}
    grid = {"n_particles": 42, "restitution": 0.8, "contact_time": 0.0, "lrv_velocity": [0.0, 1.0e-3]}
    runs = load_study(grid=grid, **line).runs
    assert [run.scene.lrv_velocity for run in runs] == [0.0, 1e-3]
    assert len({run.address for run in runs}) == 2 and len({run.state_address for run in runs}) == 1
    with pytest.raises(ConfigError, match=r"lrv_velocity.*0\.001.*at restitution = 1, where no energy is lost"):
        load_study(grid=grid | {"restitution": 1.0}, **line)


def test_an_elastic_run_holds_all_contact_times() -> None:
    study = load_study(grid={"restitution": [1, 0.4], "contact_time": [1.0e-4, 1.0e-5], "n_particles": 42})
    elastic = [run for run in study.runs if run.scene.restitution == 1]
    assert [run.scene.contact_time for run in elastic] == [(1.0e-5, 1.0e-4)] * 2
    assert len(study.runs) == 2 + 4


def test_snapshots_and_factors_are_in_order() -> None:
    study = load_study(snapshots=[3, 1.0], distance_factors=[1.4, 1.05])
    assert study.runs[0].snapshots == (1.0, 3.0)
    assert study.distance_factors == (1.05, 1.4)
    assert study.runs[0].keep_positions


def test_runs_that_studies_share_are_there_once() -> None:
    config = {"studies": {"one": STUDY, "two": STUDY | {"realizations": 3}}}
    loaded = load(config, SCHEMA)
    assert len(loaded.runs()) == 12
    assert len(loaded.states()) == 6


def test_larger_and_longer_runs_are_expected_to_cost_more() -> None:
    small, large = (load_study(grid={"n_particles": n}).runs[0].cost for n in (100, 100_000))
    assert large > 10 * small
    assert load_study(until={"time": 50.0}).runs[0].cost > load_study().runs[0].cost


def test_soft_spheres_share_start_states_and_have_a_run_for_each_contact_time() -> None:
    grid = {"n_particles": 42, "contact_time": [1e-5, 1e-4], "restitution": 1.0, "dynamics": ["events", "soft_spheres"]}
    study = load_study(grid=grid, until={"time": 0.01}, realizations=1)
    assert [run.scene.contact_time for run in study.runs] == [(1e-5, 1e-4), 1e-5, 1e-4]
    assert len({run.state_address for run in study.runs}) == 1 and len({run.address for run in study.runs}) == 3
    hard, *soft = (run.cost for run in study.runs)
    assert hard < soft[1] < soft[0]
    by_collisions, longer = (
        load_study(grid={"n_particles": 42, "dynamics": "soft_spheres"}, until={"collisions_per_particle": c}).runs[0].cost
        for c in (10, 20)
    )
    assert longer - 2.0 > 3 * (by_collisions - 2.0)  # of which it takes 2 s to start


def test_soft_spheres_need_a_box_in_which_a_neighbour_has_one_image() -> None:
    grid = {"n_particles": 4, "area_fraction": 0.7, "dynamics": "soft_spheres"}
    with pytest.raises(ConfigError, match=r"n_particles.*4.*that the periodic box is 2\.2 diameters wide, with"):
        load_study(grid=grid)
    load_study(grid=grid | {"dynamics": "events"})


def test_short_contact_times_are_expected_to_cost_more() -> None:
    rare, often, endless = (load_study(grid={"n_particles": 5740, "contact_time": t}).runs[0].cost for t in (1e-3, 1e-12, 0.0))
    assert rare < often / 5 and often <= endless < math.inf


@settings(deadline=None)
@given(st.floats(min_value=1e-12, max_value=1e12))
def test_a_digest_sees_twelve_digits(value: float) -> None:
    assert digest_of([value]) == digest_of([float(f"{value:.12g}")])
    assert digest_of([value]) != digest_of([value * (1 + 1e-10)])


def test_whole_numbers_have_one_digest() -> None:
    assert digest_of({"time": 5}) == digest_of({"time": 5.0})


@pytest.fixture
def figures() -> dict[str, tuple[str, ...]]:
    return {"cooling": ("scan",), "both": ("scan", "elsewhere")}


def test_all_figures_are_those_that_can_be_and_overviews_of_the_rest(figures: dict) -> None:
    loaded = load({"studies": {"scan": STUDY, "mine": STUDY}}, SCHEMA, figures)
    assert set(loaded.wanted) == {"cooling", "study_mine"}
    assert loaded.left_out == {"both": ("elsewhere",)}
    assert set(loaded.figures) == {"cooling", "study_mine", "study_scan"}


def test_a_list_of_figures_is_all_that_is_built(figures: dict) -> None:
    config = {"figures": ["study_scan"], "studies": {"scan": STUDY, "mine": STUDY}}
    assert load(config, SCHEMA, figures).wanted == ("study_scan",)


def test_the_schema_and_the_scene_have_the_same_keys() -> None:
    study = SCHEMA["$defs"]["study"]["properties"]
    assert tuple(study["grid"]["properties"]) == SCENE_KEYS
    assert set(study["scene"]["properties"]) == set(SCENE_KEYS) - set(GRID_KEYS)


def test_every_key_of_the_schema_is_described_in_the_readme() -> None:
    readme = (ROOT / "config/README.md").read_text()
    pieces = [SCHEMA, SCHEMA["$defs"]["study"]]
    while pieces:
        piece = pieces.pop()
        for key, inner in piece.get("properties", {}).items():
            assert inner["description"]
            assert f"`{key}`" in readme
            pieces.append(inner)


def test_everything_that_a_run_is_made_of_is_in_its_address() -> None:
    base = load_study().runs[0]
    other = {
        "scene": Scene(n_particles=3),
        "seed": 8,
        "realizations": (1,),
        "until": {"time": 4.0},
        "samples": base.samples | {"count": 5},
        "snapshots": (1.0,),
        "equilibration": 1.0,
        "keep_positions": True,
        "keep_motion": True,
        "max_collisions": 1000,
    }
    assert set(other) == {field.name for field in fields(Run)}
    for key, value in other.items():
        values = {name: getattr(base, name) for name in other} | {key: value}
        assert Run(**values).address != base.address, key


def test_an_animation_films_the_first_realization_and_costs_the_others_nothing() -> None:
    block = {"until": {"time": 1.0}, "realizations": 3, "distance_factors": [1.1]}
    config = {"studies": {"large": block}, "animations": {"film": {"study": "large"}}}
    alone, filmed = load({"studies": {"large": block}}, SCHEMA), load(config, SCHEMA)
    before, after = (list(found.studies["large"].runs) for found in (alone, filmed))
    assert [run.keep_motion for run in after] == [True, False, False]
    assert [run.address for run in after[1:]] == [run.address for run in before[1:]]
    assert after[0].address != before[0].address
    assert after[0].state_address == before[0].state_address
    assert filmed.animations["film"].run == after[0]
    assert filmed.animations["film"].colour == "energy"
    other = load(config | {"animations": {"film": {"study": "large", "colour": "initial_height"}}}, SCHEMA)
    assert other.runs().keys() == filmed.runs().keys()


def test_a_film_shows_disks() -> None:
    block = {"until": {"time": 1.0}, "scene": {"dimensions": 3}}
    with pytest.raises(ConfigError, match=r"animations\.film\.study = 'balls': allowed is a study in two dimensions"):
        load({"studies": {"balls": block}, "animations": {"film": {"study": "balls"}}}, SCHEMA)


def test_importing_is_light() -> None:
    code = "import sys, granugas.studies; print(*{'numpy', 'numba', 'xarray', 'matplotlib'} & set(sys.modules))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, env=os.environ, check=True)
    assert done.stdout.strip() == ""
