"""Scenes are checked when they are made; a wrong value is named with what is allowed."""

import math
from dataclasses import FrozenInstanceError

import numpy as np
import pytest

from granugas.diameters import diameters
from granugas.geometry import CLOSE_PACKING
from granugas.scene import SCENE_KEYS, START_KEYS, Scene, SceneError, scene_from


def test_the_defaults_are_the_central_case_of_paper_a():
    scene = Scene()
    assert (scene.n_particles, scene.area_fraction, scene.restitution, scene.contact_time) == (5740, 0.2267, 0.4, 1e-5)
    assert (scene.diameter, scene.velocity_half_width) == (1e-3, 0.5)


def test_the_area_follows_from_the_area_fraction():
    scene = Scene(n_particles=100, area_fraction=0.3, diameter=2e-3)
    assert 100 * math.pi * 1e-6 / scene.volume == pytest.approx(0.3)


def test_a_scene_is_a_value():
    assert Scene(n_particles=7) == Scene(n_particles=7) != Scene(n_particles=8)
    assert len({Scene(n_particles=7), Scene(n_particles=7)}) == 1
    with pytest.raises(FrozenInstanceError):
        Scene().n_particles = 8


def test_keys_and_values_come_back():
    scene = Scene(n_particles=7, restitution=1.0, contact_time=(1e-5, 1e-3), aspect_ratio=2.0)
    assert tuple(scene.as_dict()) == SCENE_KEYS
    assert scene_from(scene.as_dict()) == scene
    assert scene.contact_times == (1e-5, 1e-3)
    assert Scene(contact_time=1e-4).contact_times == (1e-4,)
    assert Scene(restitution=1, contact_time=[0, 1e-3]).contact_time == (0.0, 1e-3)


def test_the_edges_are_allowed():
    for values in ({"n_particles": 1}, {"area_fraction": CLOSE_PACKING[2]}, {"restitution": 0}, {"restitution": 1}):
        Scene(**values)
    Scene(contact_time=0, n_particles=10_000_000)


SHAKEN = {"boundary": "periodic wall", "floor": "harmonic", "floor_amplitude": 1e-4, "floor_frequency": 50.0}

WRONG = [
    ("n_particles", 0, "an integer from 1 to 10000000"),
    ("n_particles", 10_000_001, "an integer from 1 to 10000000"),
    ("n_particles", 100.0, "an integer"),
    ("n_particles", True, "an integer"),
    ("n_particles", "100", "an integer"),
    ("area_fraction", 0.0, "a number > 0 and <= 0.9069 (close packing)"),
    ("area_fraction", 0.91, "a number > 0 and <= 0.9069 (close packing)"),
    ("area_fraction", math.nan, "a number > 0"),
    ("area_fraction", "0.5", "a number > 0"),
    ("area_fraction", None, "a number > 0"),
    ("restitution", -0.1, "a number >= 0 and <= 1"),
    ("restitution", 1.0000001, "a number >= 0 and <= 1"),
    ("restitution", math.nan, "a number >= 0 and <= 1"),
    ("restitution", False, "a number >= 0 and <= 1"),
    ("contact_time", -1e-9, "a number >= 0 s"),
    ("contact_time", math.inf, "a number >= 0 s"),
    ("contact_time", "1e-5", "a number >= 0 s"),
    ("contact_time", (1e-5, 1e-4), "restitution = 1 only"),
    ("diameter", 0, "a number > 0 m"),
    ("velocity_half_width", -0.5, "a number > 0 m/s"),
    ("aspect_ratio", 0.0, "a number > 0"),
    ("aspect_ratio", math.inf, "a number > 0"),
    ("tangential_restitution", -1.1, "a number >= -1 and <= 1"),
    ("tangential_restitution", 1.1, "a number >= -1 and <= 1"),
    ("friction", -0.1, "a number >= 0, or .inf"),
    ("friction", math.nan, "a number >= 0, or .inf"),
    ("friction", -math.inf, "a number >= 0, or .inf"),
    ("dynamics", "monte_carlo", "events, soft_spheres, dsmc"),
    ("steps_per_contact", 9, "an integer from 10 to 1000"),
    ("steps_per_contact", 50.0, "an integer from 10 to 1000"),
    ("steps_per_contact", 100, "50 unless dynamics = soft_spheres"),
    ("lattice", "hexagonal", "auto, triangular, square, cubic, fcc"),
    ("lattice", "cubic", "in 2 dimensions allowed are auto, triangular, square"),
    ("dimensions", 4, "2, 1, 3"),
    ("dimensions", 0, "2, 1, 3"),
    ("dimensions", "2", "2"),
    ("sizes", "gamma", "equal, bidisperse, uniform, log_normal"),
    ("size_ratio", 0.5, "a number >= 1 and <= 10"),
    ("size_share", 1.1, "a number >= 0 and <= 1"),
    ("size_spread", 0.95, "a number >= 0 and <= 0.9"),
    ("heating", -1.0, "a number >= 0"),
    ("heating", math.inf, "a number >= 0"),
    ("boundary", "open", "periodic, wall"),
    ("boundary", "", "periodic, wall"),
    ("boundary", True, "periodic, wall"),
    ("boundary", "wall wall periodic", "one for each of the 2"),
    ("wall_restitution", 1.1, "a number >= 0 and <= 1"),
    ("wall_restitution", 0.9, "without a wall of the box (boundary = periodic)"),
    ("wall_contact_time", -1.0, "a number >= 0 s"),
    ("wall_contact_time", 1e-5, "without a wall of the box (boundary = periodic)"),
    ("gravity", -9.81, "a number >= 0 m/s^2"),
    ("gravity", 9.81, "without a wall along the last axis (boundary = periodic)"),
    ("floor", "shaken", "still, harmonic, sawtooth"),
    ("floor", "harmonic", "without a wall along the last axis"),
    ("floor_amplitude", 1e-3, "where the floor moves (floor), and 0 where it does not"),
    ("floor_frequency", 50.0, "where the floor moves (floor), and 0 where it does not"),
    ("floor_frequency", math.nan, "a number >= 0 1/s"),
    ("material", "rubber", "constant, viscoelastic, plastic"),
    ("viscosity", -0.1, "a number >= 0 (s/m)^(1/5)"),
    ("viscosity", 0.5, "a number > 0 with material = viscoelastic, and 0 without"),
    ("yield_velocity", 0.5, "a number > 0 with material = plastic, and 0 without"),
    ("contact_time_exponent", 11, "a number >= 0 and <= 10"),
    ("contact_velocity", 0.1, "a number > 0 with a contact_time_exponent > 0, and 0 without"),
    ("critical_distance", 1.1e-3, "at most the diameter, 0.001 m"),
    ("critical_distance", -1e-6, "a number >= 0 m"),
    ("rotation_angle", 5.1, "a number >= 0 and <= 5 degrees"),
    ("kick_energy", 1e-3, "with a kick_velocity > 0"),
    ("kick_velocity", -1e-3, "a number >= 0 m/s"),
    ("internal_modes", 101, "an integer from 0 to 100"),
    ("mode_damping", 1.0, "0 without internal_modes"),
    ("lrv_velocity", -0.1, "a number >= 0 and <= 1e+50 m/s"),
    ("lrv_velocity", math.inf, "a number >= 0 and <= 1e+50 m/s"),
    ("lrv_velocity", 0.1, "0 unless dimensions = 1"),
]


@pytest.mark.parametrize(("key", "value", "allowed"), WRONG, ids=[f"{key}={value!r}" for key, value, _ in WRONG])
def test_a_wrong_value_is_named(key, value, allowed):
    with pytest.raises(SceneError) as raised:
        Scene(**{key: value})
    assert str(raised.value).startswith(f"{key} = {value!r}: ")
    assert allowed in str(raised.value)
    assert (raised.value.key, raised.value.value) == (key, value)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"dimensions": 3, "area_fraction": 0.75}, r"area_fraction = 0\.75: allowed is a number > 0 and <= 0\.74048 "),
        ({"dimensions": 1, "area_fraction": 1.01}, r"area_fraction = 1\.01: allowed is a number > 0 and <= 1 "),
        ({"dimensions": 3, "lattice": "square"}, "lattice = 'square': in 3 dimensions allowed are auto, cubic, fcc"),
        ({"dimensions": 1, "lattice": "square"}, "lattice = 'square': in 1 dimensions allowed are auto"),
        ({"dimensions": 1, "aspect_ratio": 2.0}, "aspect_ratio = 2.0: allowed is 1 in one dimension"),
        ({"dimensions": 1, "tangential_restitution": 0.5}, "tangential_restitution = 0.5: beads on a line touch head on"),
    ],
)
def test_what_depends_on_the_dimensions(values, message):
    with pytest.raises(SceneError, match=message):
        Scene(**values)


def test_volumes_and_energies_in_other_dimensions():
    line, space = Scene(100, 0.95, dimensions=1), Scene(100, 0.3, dimensions=3)
    assert 100 * 1e-3 / line.volume == pytest.approx(0.95)
    assert 100 * math.pi * 1e-9 / 6 / space.volume == pytest.approx(0.3)
    assert [scene.energy_per_mass for scene in (line, Scene(), space)] == pytest.approx([0.25 / 6, 0.25 / 3, 0.25 / 2])


def test_surfaces_rub_unless_they_are_smooth_or_without_friction():
    assert Scene(restitution=1.0, tangential_restitution=0.5).dissipates
    assert not Scene(restitution=1.0, tangential_restitution=0.5, friction=0.0).dissipates
    assert not Scene(restitution=1.0, friction=0.5).dissipates
    assert Scene(friction=math.inf) == Scene()
    with pytest.raises(SceneError, match=r"contact_time = \(1e-05, 0\.0001\): .* and for smooth surfaces"):
        Scene(restitution=1.0, contact_time=(1e-5, 1e-4), tangential_restitution=0.5)


@pytest.mark.parametrize(
    ("key", "values"),
    [
        ("gravity", {"gravity": 9.81, "boundary": "wall periodic"}),
        ("wall_restitution", {"gravity": 9.81, "boundary": "wall", "wall_restitution": 0}),
        ("wall_restitution", {**SHAKEN, "wall_restitution": 0}),
        ("floor_amplitude", {**SHAKEN, "floor_amplitude": 0.0}),
        ("floor_frequency", {**SHAKEN, "floor_frequency": 0.0}),
    ],
)
def test_walls_and_floors_that_make_no_sense_together(key, values):
    with pytest.raises(SceneError) as raised:
        Scene(**values)
    assert raised.value.key == key


@pytest.mark.parametrize(
    ("boundary", "walled", "kept"),
    [
        ("periodic", (False, False), "periodic"),
        ("wall", (True, True), "wall"),
        ("periodic wall", (False, True), "periodic wall"),
        ("wall  wall", (True, True), "wall"),
    ],
)
def test_walls_stand_where_the_boundary_says(boundary, walled, kept):
    scene = Scene(boundary=boundary)
    assert scene.walled == walled
    assert scene.boundary == kept


@pytest.mark.parametrize("times", [(), (1e-5, -1.0), (1e-5, math.nan)])
def test_a_wrong_list_of_contact_times(times):
    with pytest.raises(SceneError, match="contact_time"):
        Scene(restitution=1.0, contact_time=times)


SOFT = {"dynamics": "soft_spheres"}
BEADS = {"dimensions": 1, "contact_time": 0.0, "lrv_velocity": 0.1}

TOGETHER = [
    (BEADS | {"contact_time": 1e-5}, "lrv_velocity = 0.1: allowed is 0 with contact_time = 1e-05: slow contacts merge"),
    (BEADS | {"restitution": 1.0}, "lrv_velocity = 0.1: allowed is 0 at restitution = 1, where no energy is lost"),
    (BEADS | {"boundary": "wall"}, "lrv_velocity = 0.1: allowed is 0 with boundary: the model knows equal beads on a ring"),
    (BEADS | {"boundary": "wall", "gravity": 9.81}, "lrv_velocity = 0.1: allowed is 0 with boundary, gravity: the model"),
    (BEADS | {"sizes": "uniform", "heating": 1.0}, "lrv_velocity = 0.1: allowed is 0 with sizes, heating: the model"),
    (BEADS | {"material": "viscoelastic", "viscosity": 0.1}, "lrv_velocity = 0.1: allowed is 0 with material, viscosity: the"),
    (BEADS | {"critical_distance": 1e-4}, "lrv_velocity = 0.1: allowed is 0 with critical_distance: the model"),
    (BEADS | {"internal_modes": 1}, "lrv_velocity = 0.1: allowed is 0 with internal_modes: the model"),
    (SOFT | {"restitution": 0.0}, "restitution = 0.0: allowed is a number > 0 with dynamics = soft_spheres: no dashpot"),
    (SOFT | {"contact_time": 0.0}, "contact_time = 0.0: allowed is > 0 and < 0.001814 s with dynamics = soft_spheres"),
    (SOFT | {"contact_time": 2e-3}, "contact_time = 0.002: allowed is > 0 and < 0.001814 s with dynamics = soft_spheres"),
    (
        SOFT | {"contact_time": (1e-5, 1e-4), "restitution": 1.0},
        "contact_time = (1e-05, 0.0001): a list (not empty) is allowed",
    ),
    (SOFT | {"boundary": "wall", "wall_restitution": 0.0}, "wall_restitution = 0.0: allowed is a number > 0 with dynamics"),
    (SOFT | {"boundary": "wall", "wall_contact_time": 1.0}, "wall_contact_time = 1.0: allowed is > 0 and < 0.001814 s with"),
    (SOFT | {"restitution": 0.01, "steps_per_contact": 46}, "steps_per_contact = 46: allowed is at least 47 at restitution"),
    (SOFT | {"boundary": "wall", "wall_restitution": 1e-3}, "steps_per_contact = 50: allowed is at least 70 at wall_rest"),
    (SOFT | {"boundary": "wall", "gravity": 9.81}, "dynamics = 'soft_spheres': allowed is events with gravity: soft spheres"),
    (SOFT | {"sizes": "uniform", "friction": 0.5}, "dynamics = 'soft_spheres': allowed is events with friction, sizes: soft"),
    (SOFT | {"heating": 1.0}, "dynamics = 'soft_spheres': allowed is events with heating: soft spheres are equal"),
    (SOFT | {"critical_distance": 1e-5}, "dynamics = 'soft_spheres': allowed is events with critical_distance: soft"),
    (
        SOFT | {"dimensions": 1, "lrv_velocity": 0.1, "contact_time": 0.0},
        "dynamics = 'soft_spheres': allowed is events with lrv_velocity: soft spheres",
    ),
    ({"contact_time_exponent": 1.0}, "contact_velocity = 0.0: allowed is a number > 0"),
    ({"contact_time_exponent": 1.0, "contact_velocity": 0.1, "contact_time": 0.0}, "contact_time_exponent = 1.0: allowed is 0"),
    ({"material": "viscoelastic"}, "viscosity = 0.0: allowed is a number > 0"),
    (
        {"material": "viscoelastic", "viscosity": 0.65},
        "viscosity = 0.65: allowed is at most 0.6473, where r",
    ),
    ({"material": "viscoelastic", "viscosity": 0.1, "restitution": 1.0}, "restitution = 1.0: allowed is less than 1"),
    ({"material": "plastic"}, "yield_velocity = 0.0: allowed is a number > 0"),
    ({"kick_velocity": 0.1}, "kick_energy = 0.0: allowed is a number > 0"),
    ({"kick_velocity": 0.1, "kick_energy": 0.1, "restitution": 1.0}, "kick_energy = 0.1: allowed is 0 at restitution = 1"),
    ({"internal_modes": 1, "mode_damping": 1e5}, "mode_damping = 100000.0: allowed is less than 100000 1/s"),
]


@pytest.mark.parametrize(("values", "said"), TOGETHER, ids=[said.split(":")[0] for _, said in TOGETHER])
def test_what_does_not_go_together_is_named(values, said):
    with pytest.raises(SceneError) as raised:
        Scene(**values)
    assert said in str(raised.value)


def test_equilibration_knows_only_what_decides_the_start():
    scene = Scene(7, 0.3, restitution=0.2, contact_time=1e-3, diameter=2e-3, lattice="square", aspect_ratio=2.0)
    start = scene.at_start()
    assert (start.restitution, start.contact_time) == (1.0, 0.0)
    assert all(getattr(start, key) == getattr(scene, key) for key in START_KEYS)
    assert start.at_start() == start


def test_an_unknown_key_is_named():
    with pytest.raises(SceneError, match=r"restitutoin = 0\.4: unknown key; allowed are n_particles, area_fraction, "):
        scene_from({"n_particles": 5, "restitutoin": 0.4})


def test_a_single_particle_cannot_be_kicked():
    with pytest.raises(SceneError, match=r"heating = 1\.0: allowed at n_particles = 1 is 0"):
        Scene(1, 0.1, heating=1.0)


@pytest.mark.parametrize("sizes", ["bidisperse", "uniform", "log_normal"])
def test_the_area_fraction_counts_the_real_areas(sizes):
    scene = Scene(500, 0.3, sizes=sizes, size_spread=0.4)
    d = diameters(scene) * scene.diameter
    assert np.sum(np.pi / 4 * d**2) / scene.volume == pytest.approx(0.3)
    assert scene.volume > Scene(500, 0.3).volume
