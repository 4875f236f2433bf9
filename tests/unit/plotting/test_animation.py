"""Films: they play, they show the disks where they are, and equal runs give equal files."""

from itertools import pairwise

import imageio_ffmpeg
import numpy as np
import pytest
import xarray as xr

from granugas.plotting.animation import COLOURINGS, STRIP, render, splat

N, FRAMES, BOX = 300, 8, np.array([1.0, 0.6])


@pytest.fixture(scope="module")
def run():
    """Disks that stream to the right, the upper ones faster and more often hit."""
    rng = np.random.default_rng(1)
    start, time = rng.random((N, 2)) * BOX, np.concatenate([[0], np.geomspace(0.01, 10, FRAMES - 1)])
    velocity = np.stack([start[:, 1], 0 * start[:, 1]], axis=1)
    steps = np.arange(FRAMES)[:, np.newaxis, np.newaxis]
    return xr.Dataset(
        {
            "trajectory": (("time", "particle", "axis"), (start + 0.05 * steps * velocity) % BOX),
            "trajectory_velocity": (("time", "particle", "axis"), np.broadcast_to(velocity, (FRAMES, N, 2))),
            "trajectory_collisions": (("time", "particle"), (time[:, np.newaxis] * 100 * start[:, 1] / 0.6).astype(int)),
        },
        {"time": time, "axis": ["x", "y"]},
        {
            "box_x": BOX[0],
            "box_y": BOX[1],
            "diameter": 0.02,
            "n_particles": N,
            "restitution": 0.8,
            "contact_time": 1e-5,
        },
    )


def film_of(path):
    """Its metadata and its frames (time, height, width, 3)."""
    frames = imageio_ffmpeg.read_frames(str(path))
    about = next(frames)
    width, height = about["size"]
    return about, np.stack([np.frombuffer(frame, np.uint8).reshape(height, width, 3) for frame in frames])


@pytest.fixture(scope="module")
def films(run, tmp_path_factory):
    folder = tmp_path_factory.mktemp("films")
    for colour in COLOURINGS:
        render(run, folder / f"{colour}.mp4", colour)
    return folder


def test_a_film_plays(films):
    about, frames = film_of(films / "energy.mp4")
    assert (about["codec"], about["pix_fmt"][:7]) == ("h264", "yuv420p")
    assert frames.shape == (FRAMES, 480 + STRIP, 800, 3)
    assert [path.name for path in sorted(films.iterdir())] == ["collision_frequency.mp4", "energy.mp4", "initial_height.mp4"]


def test_disks_and_clock_move(films):
    _, frames = film_of(films / "energy.mp4")
    for before, after in pairwise(frames[1:]):
        moved = abs(after.astype(int) - before).max(axis=-1) > 60
        assert moved[:480].mean() > 0.02
        assert moved[480:, :450].sum() > 100
        assert not moved[480:, 500:].any()  # the bar of colours stays


def test_the_picture_is_the_run(films, run):
    """The first frame beside the disks as they are: their places, and the colours of their heights."""
    _, frames = film_of(films / "initial_height.mp4")
    height = run["trajectory"][0, :, 1].values / BOX[1]
    for place, share in zip(run["trajectory"][0].values, height, strict=True):
        dot = frames[0][int(480 - place[1] * 800), int(place[0] * 800)].astype(int)
        assert dot.min() < 140, "no disk here"
        if share > 0.9 or share < 0.1:
            assert dot.argmax() == (0 if share > 0.5 else 2)


def test_colourings_differ(films):
    one, two, three = (film_of(films / f"{colour}.mp4")[1][4, :480].astype(int) for colour in COLOURINGS)
    for first, second in ((one, two), (two, three), (one, three)):
        assert abs(first - second).mean() > 2


def test_contacts_are_red(run, tmp_path):
    """Where the mean time between collisions since the frame before is below t_c."""
    counts = run["trajectory_collisions"].values * 0
    counts[3:, :20] = 10**6
    render(run.assign(trajectory_collisions=(("time", "particle"), counts)), tmp_path / "a.mp4", "collision_frequency")
    _, frames = film_of(tmp_path / "a.mp4")
    red = ((frames[..., 0].astype(int) - frames[..., 2] > 60) & (frames[..., 1] < 120))[:, :480].sum(axis=(1, 2))
    area = np.pi * 8**2 * 20
    assert 0.4 * area < red[3] < 1.2 * area
    assert (np.delete(red, 3) < 0.02 * area).all()


def test_equal_runs_give_equal_files(films, run, tmp_path):
    render(run, tmp_path / "again.mp4", "energy")
    again = (tmp_path / "again.mp4").read_bytes()
    assert again == (films / "energy.mp4").read_bytes()
    assert b" threads=1 " in again  # on any number of cores


def test_a_run_that_ended_early_makes_a_shorter_film(run, tmp_path):
    ended = run.copy()
    ended["trajectory"] = run["trajectory"].where(run["time"] < 1)
    render(ended, tmp_path / "short.mp4", "initial_height")
    assert len(film_of(tmp_path / "short.mp4")[1]) == int((run["time"] < 1).sum()) < FRAMES


def test_unknown_colours_are_refused(run, tmp_path):
    with pytest.raises(ValueError, match="colour = 'speed': allowed are energy, collision_frequency, initial_height"):
        render(run, tmp_path / "a.mp4", "speed")
    assert not any(tmp_path.iterdir())


def test_what_breaks_leaves_no_half_film(run, tmp_path):
    with pytest.raises(KeyError, match="trajectory_velocity"):
        render(run.drop_vars("trajectory_velocity"), tmp_path / "a.mp4", "energy")
    assert not any(tmp_path.iterdir())


def test_disks_cover_their_area_and_keep_their_colours():
    dots = np.array([400, 240])
    rng = np.random.default_rng(2)
    places = (np.stack(np.meshgrid(np.arange(20), np.arange(12)), axis=-1).reshape(-1, 2) + 0.5 * rng.random((240, 2))) / 20
    picture = splat(places, BOX, 0.02, np.tile([0.0, 0.0, 0.0], (240, 1)), dots)
    assert picture.shape == (240, 400, 3)
    assert 1 - picture.mean() / 255 == pytest.approx(240 * np.pi * 0.01**2 / 0.6, rel=0.03)
    red = splat(places[:1], BOX, 0.02, np.array([[1.0, 0.0, 0.0]]), dots)
    assert (red[..., 0] == 255).all() and red[..., 1].min() == 0


def test_disks_go_across_the_edges_and_up_is_up():
    dots = np.array([100, 60])
    corner = splat(np.array([[0.0, 0.0]]), BOX, 0.1, np.zeros((1, 3)), dots)
    assert all(corner[row, column, 0] == 0 for row in (0, -1) for column in (0, -1))
    low = splat(np.array([[0.25, 0.1]]), BOX, 0.1, np.zeros((1, 3)), dots)
    assert low[49, 25, 0] == 0 and low[10, 25, 0] == 255
    np.testing.assert_array_equal(low, splat(np.array([[1.25, -0.5]]), BOX, 0.1, np.zeros((1, 3)), dots))
