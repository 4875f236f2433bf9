import numpy as np
import pytest
from bands import made_up_run
from matplotlib.colors import to_rgb

from granugas.explorer.colours import LEVELS, SCALES, values_of


@pytest.mark.parametrize("name", SCALES)
def test_scales_go_from_dark_to_light(name):
    """So they read without hues; what is beyond is white, lighter than all."""
    scale = SCALES[name]
    light = [0.2126 * red + 0.7152 * green + 0.0722 * blue for red, green, blue in map(to_rgb, scale.colours)]
    assert len(light) == LEVELS and light == sorted(light) and light[-1] - light[0] > 0.35 and light[-1] < 0.95
    assert all(scale.low <= tick <= scale.high for tick in scale.ticks)


@pytest.mark.parametrize("name", SCALES)
def test_levels_are_equal_steps(name):
    scale = SCALES[name]
    space = np.geomspace if scale.logarithmic else np.linspace
    edges = space(scale.low, scale.high, LEVELS + 1)
    middles = np.sqrt(edges[1:] * edges[:-1]) if scale.logarithmic else (edges[1:] + edges[:-1]) / 2
    assert scale.levels(middles).tolist() == [*range(LEVELS)]
    assert scale.levels(np.array([scale.low - 1, scale.high + 1, np.inf])).tolist() == [0, LEVELS - 1, LEVELS]


def test_values_are_those_of_the_run():
    run = made_up_run(10, [0, 0.1, 0.3])
    run["trajectory_collisions"][2, 5] = run["trajectory_collisions"][1, 5] + 10**6
    values = values_of(run, run["time"].values)
    height = run["trajectory"][0, :, 1].values / run.attrs["box_y"]
    assert values["initial_height"](2).tolist() == (height * LEVELS).astype(int).tolist()
    energy = np.square(run["trajectory_velocity"][2].values).sum(axis=1)
    np.testing.assert_array_equal(values["energy"](2), SCALES["energy"].levels(energy / energy.mean()))
    rates = np.diff(run["trajectory_collisions"].values, axis=0)[1] / 0.2
    np.testing.assert_array_equal(
        np.delete(values["collision_frequency"](2), 5),
        np.delete(SCALES["collision_frequency"].levels(np.maximum(rates, 0.3)), 5),
    )
    assert values["collision_frequency"](2)[5] == LEVELS  # in contact
    assert not values["collision_frequency"](0).any()


def test_only_what_the_data_allow():
    run = made_up_run(5, [0, 1.0])
    assert [*values_of(run, run["time"].values)] == ["energy", "collision_frequency", "initial_height"]
    still = run.drop_vars(["trajectory_velocity", "trajectory_collisions"])
    assert [*values_of(still, run["time"].values)] == ["initial_height"]
