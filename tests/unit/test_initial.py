"""Start lattices hold their disks without an overlap or say what would fit; start velocities have the papers' energy."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy import stats
from scipy.spatial import cKDTree

from granugas.geometry import CLOSE_PACKING
from granugas.initial import check_lattice, random_stream, rescaled, sites, start_lattice, start_velocities
from granugas.scene import Scene, SceneError

RNG = np.random.default_rng
OTHER_DISSIPATION = [{"restitution": 0.9}, {"contact_time": 0.0}, {"restitution": 1.0, "contact_time": (1e-3, 1e-5)}]


def least_distance(position, box):
    """Of two disks, or of a disk and its own image."""
    if len(position) == 1:
        return min(box)
    near = cKDTree(position, boxsize=box).query(position, 2)[0][:, 1]
    return min(*box, near.min())


def check_start(scene):
    """All particles inside of a box of the right volume, no two overlap."""
    lattice = start_lattice(scene)
    position = sites(lattice, scene.n_particles, RNG(0))
    assert position.shape == (scene.n_particles, scene.dimensions)
    assert np.all((position >= 0) & (position < lattice.box))
    assert math.prod(lattice.box) == pytest.approx(scene.volume)
    assert least_distance(position, lattice.box) >= scene.diameter
    assert least_distance(position, lattice.box) == pytest.approx(lattice.spacing) or scene.n_particles < lattice.n_sites
    return lattice


@pytest.mark.parametrize("area_fraction", [0.001, 0.2267, 0.5, 0.7, 0.75])
@pytest.mark.parametrize("n_particles", [*range(6, 31), 42, 64, 97, 378, 1009, 1435, 5740])
def test_any_number_of_disks(n_particles, area_fraction):
    scene = Scene(n_particles=n_particles, area_fraction=area_fraction)
    try:
        lattice = check_start(scene)
    except SceneError as error:
        assert n_particles < 31, error
        assert area_fraction >= 0.7, error
        return
    assert lattice.box[0] * lattice.box[1] == pytest.approx(scene.volume)


@pytest.mark.parametrize("n_particles", [64, 378, 1009, 5740, 10_000])
@pytest.mark.parametrize("area_fraction", [0.8, 0.85])
def test_dense_starts(n_particles, area_fraction):
    assert check_start(Scene(n_particles=n_particles, area_fraction=area_fraction)).kind == "triangular"


@pytest.mark.parametrize("n_particles", [1, 2, 3, 4, 5])
@pytest.mark.parametrize("area_fraction", [0.001, 0.1, 0.3, 0.4])
def test_few_disks(n_particles, area_fraction):
    check_start(Scene(n_particles=n_particles, area_fraction=area_fraction))


@pytest.mark.parametrize("aspect_ratio", [0.1, 0.5, 4.0, 10.0])
@pytest.mark.parametrize("area_fraction", [0.05, 0.5, 0.7])
def test_elongated_boxes_are_as_asked(aspect_ratio, area_fraction):
    lattice = check_start(Scene(n_particles=200, area_fraction=area_fraction, aspect_ratio=aspect_ratio))
    assert lattice.box[0] / lattice.box[1] == pytest.approx(aspect_ratio)


@pytest.mark.parametrize(
    ("n_particles", "columns", "rows"),
    [(42, 6, 7), (378, 18, 21), (1435, 35, 41), (5740, 70, 82), (22960, 140, 164), (97776, 291, 336), (16680, 120, 139)],
)
def test_the_triangular_lattices_of_paper_a(n_particles, columns, rows):
    """Spacing 2 d, nu = pi / (8 sqrt 3); odd numbers of rows leave a seam."""
    scene = Scene(n_particles=n_particles, area_fraction=math.pi / (8 * math.sqrt(3)), lattice="triangular")
    lattice = check_start(scene)
    assert (lattice.kind, lattice.nx, lattice.ny) == ("triangular", columns, rows)
    assert lattice.box[0] == pytest.approx(columns * 2e-3)
    assert lattice.box[1] == pytest.approx(rows * 2e-3 * math.sqrt(3) / 2)


def test_the_square_lattice_of_paper_b():
    lattice = check_start(Scene(n_particles=784, area_fraction=784 * math.pi / 4 / 50**2, lattice="square", diameter=2e-3))
    assert (lattice.nx, lattice.ny) == (28, 28)
    assert lattice.box == pytest.approx((0.1, 0.1))


@pytest.mark.parametrize("n_particles", [1, 2, 42, 1009])
@pytest.mark.parametrize("area_fraction", [0.001, 0.5, 0.95])
def test_any_number_of_beads(n_particles, area_fraction):
    scene = Scene(n_particles, area_fraction, dimensions=1)
    assert check_start(scene).box == pytest.approx((n_particles * 1e-3 / area_fraction,))


@pytest.mark.parametrize("area_fraction", [0.001, 0.15, 0.3, 0.45, 0.49])
@pytest.mark.parametrize("n_particles", [*range(27, 41), 64, 97, 500, 1009, 4097])
def test_any_number_of_spheres(n_particles, area_fraction):
    lattice = check_start(Scene(n_particles, area_fraction, dimensions=3))
    assert math.prod(lattice.counts) * (4 if lattice.kind == "fcc" else 1) == lattice.n_sites >= n_particles


@pytest.mark.parametrize("n_particles", [1, 2, 3, 4, 5])
@pytest.mark.parametrize("area_fraction", [0.001, 0.1, 0.2])
def test_few_spheres(n_particles, area_fraction):
    check_start(Scene(n_particles, area_fraction, dimensions=3))


@pytest.mark.parametrize(("n_particles", "kind", "counts"), [(1000, "cubic", (10, 10, 10)), (500, "fcc", (5, 5, 5))])
def test_regular_lattices_of_spheres(n_particles, kind, counts):
    lattice = check_start(Scene(n_particles, 0.4, dimensions=3, lattice=kind))
    assert (lattice.kind, lattice.counts) == (kind, counts)
    assert lattice.box == pytest.approx((lattice.box[0],) * 3)
    cell = lattice.box[0] / counts[0]
    assert lattice.spacing == pytest.approx(cell if kind == "cubic" else cell / math.sqrt(2))


def test_dense_spheres_start_as_the_crystal():
    assert check_start(Scene(500, 0.7, dimensions=3)).kind == "fcc"
    assert check_start(Scene(1000, 0.55, dimensions=3)).kind == "fcc"
    assert check_start(Scene(1000, 0.15, dimensions=3)).kind == "cubic"


@pytest.mark.parametrize("aspect_ratio", [0.25, 4.0])
def test_elongated_boxes_of_spheres(aspect_ratio):
    x, y, z = check_start(Scene(1000, 0.3, dimensions=3, aspect_ratio=aspect_ratio)).box
    assert x / y == pytest.approx(aspect_ratio)
    assert z == pytest.approx(math.sqrt(x * y))


def test_spheres_that_do_not_fit_are_refused():
    with pytest.raises(SceneError, match=r"area_fraction = 0\.73: 33 spheres fit on a lattice up to 0\."):
        check_lattice(Scene(33, 0.73, dimensions=3))
    with pytest.raises(SceneError, match=r"n_particles = 501: .*the nearest that fits is 500;"):
        check_lattice(Scene(501, 0.6, dimensions=3, lattice="fcc"))
    with pytest.raises(SceneError, match=r"a cubic lattice holds less than 0\.5236"):
        check_lattice(Scene(1000, 0.53, dimensions=3, lattice="cubic"))


def test_a_box_has_room_for_two_of_the_largest():
    few = {"sizes": "bidisperse", "size_ratio": 5.0, "size_share": 0.5, "area_fraction": 0.6}
    with pytest.raises(
        SceneError, match=r"n_particles = 2: allowed are so many that the box is 2 of the largest diameters wide"
    ):
        start_lattice(Scene(n_particles=2, **few))
    start_lattice(Scene(n_particles=20, **few))


def test_walls_do_not_squeeze_rows_into_each_other():
    dense = {"n_particles": 100, "area_fraction": 0.85}
    with pytest.raises(
        SceneError, match=r"area_fraction = 0\.85: 100 particles do not fit between walls on a triangular lattice"
    ):
        start_lattice(Scene(boundary="wall", **dense))
    start_lattice(Scene(**dense))


@pytest.mark.parametrize("n_particles", [5, 7, 42, 1435])
@pytest.mark.parametrize("area_fraction", [0.88, 0.9])
def test_a_refusal_names_the_largest_area_fraction(n_particles, area_fraction):
    scene = Scene(n_particles=n_particles, area_fraction=area_fraction)
    try:
        check_start(scene)
    except SceneError as error:
        assert error.key == "area_fraction"
        assert str(n_particles) in error.allowed
        largest = float(error.allowed.split()[-1])
        assert largest < area_fraction
        check_lattice(replace(scene, area_fraction=largest - 1e-4))


@pytest.mark.parametrize(("n_particles", "area_fraction"), [(5, 0.8), (7, 0.85), (23, 0.89)])
def test_what_does_not_fit_is_refused(n_particles, area_fraction):
    with pytest.raises(SceneError, match=f"area_fraction = {area_fraction}: {n_particles} disks fit on a lattice up to 0\\."):
        check_lattice(Scene(n_particles=n_particles, area_fraction=area_fraction))


@pytest.mark.parametrize(("lattice", "n_particles", "area_fraction"), [("square", 97, 0.5), ("triangular", 1009, 0.7)])
def test_a_refused_number_comes_with_the_nearest_that_fits(lattice, n_particles, area_fraction):
    scene = Scene(n_particles=n_particles, area_fraction=area_fraction, lattice=lattice)
    with pytest.raises(SceneError, match=f"n_particles = {n_particles}: .*lattice = 'auto' takes any number") as raised:
        check_lattice(scene)
    nearest = int(raised.value.allowed.split("nearest that fits is ")[1].split(";")[0])
    check_start(replace(scene, n_particles=nearest))
    for between in range(1, abs(nearest - n_particles)):
        for n in (n_particles - between, n_particles + between):
            with pytest.raises(SceneError):
                check_lattice(replace(scene, n_particles=n))


@pytest.mark.parametrize(
    ("lattice", "largest", "said"), [("square", math.pi / 4, "0.7854"), ("triangular", CLOSE_PACKING[2], "0.9069")]
)
def test_no_number_fits_on_touching_sites(lattice, largest, said):
    with pytest.raises(SceneError, match=f"a {lattice} lattice holds less than {said}"):
        check_lattice(Scene(n_particles=100, area_fraction=largest, lattice=lattice))


def test_empty_sites_lie_anywhere():
    lattice = start_lattice(Scene(n_particles=97, area_fraction=0.2))
    places = {tuple(map(tuple, sites(lattice, 97, RNG(seed)))) for seed in range(5)}
    assert lattice.nx * lattice.ny > 97
    assert len(places) == 5


@pytest.mark.parametrize("dimensions", [1, 2, 3])
@pytest.mark.parametrize("n_particles", [2, 3, 42, 5740])
def test_velocities(n_particles, dimensions):
    scene = Scene(n_particles=n_particles, velocity_half_width=0.3, area_fraction=0.1, dimensions=dimensions)
    velocity = start_velocities(scene, RNG(1))
    energy = 0.5 * np.sum(velocity**2)
    assert energy == pytest.approx(n_particles * dimensions * 0.3**2 / 6, rel=1e-14)
    assert energy == pytest.approx(n_particles * scene.energy_per_mass, rel=1e-14)
    np.testing.assert_allclose(velocity.sum(axis=0), 0, atol=1e-13 * n_particles)


def test_velocity_components_are_uniform():
    components = np.sort(start_velocities(Scene(n_particles=20_000), RNG(2)), axis=0) / 0.5
    np.testing.assert_allclose(components, np.linspace(-1, 1, 20_000)[:, None].repeat(2, axis=1), atol=0.02)


def test_velocities_of_beads_are_normal():
    velocity = start_velocities(Scene(20_000, 0.5, dimensions=1), RNG(2))[:, 0]
    assert stats.kstest(velocity / velocity.std(), "norm").pvalue > 1e-3


def test_a_single_disk_keeps_its_momentum():
    velocity = start_velocities(Scene(n_particles=1), RNG(3))
    assert np.hypot(*velocity[0]) == pytest.approx(0.5 * math.sqrt(2 / 3))


def test_rescaling_keeps_directions():
    velocity = RNG(4).normal(size=(50, 2))
    scaled = rescaled(velocity, 0.5)
    assert 0.5 * np.sum(scaled**2) == pytest.approx(50 * 0.25 / 3, rel=1e-14)
    assert np.ptp(scaled / velocity) < 1e-14


def drawn(scene=Scene(), seed=1, realization=0):  # noqa: B008
    return random_stream(scene, seed, realization).random(4).tolist()


@pytest.mark.parametrize("other", OTHER_DISSIPATION)
def test_the_random_stream_does_not_depend_on_the_dissipation(other):
    assert drawn(Scene(**other)) == drawn()


@pytest.mark.parametrize(
    "other",
    [
        {"seed": 2},
        {"realization": 1},
        {"scene": Scene(n_particles=5741)},
        {"scene": Scene(area_fraction=0.2268)},
        {"scene": Scene(lattice="triangular")},
    ],
)
def test_the_random_stream_depends_on_the_start(other):
    assert drawn(**other) != drawn()
