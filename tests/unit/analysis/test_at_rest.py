import numpy as np
import pytest
import xarray as xr

from granugas.analysis.at_rest import energies_at_rest, shown


@pytest.fixture
def ball() -> xr.Dataset:
    """Round numbers: g t_c = 2 m/s; two balls, of which the second is shown."""
    dims = ("restitution", "contact_ratio", "window", "window_end")
    factor = np.array([[1.0, 1.0], [0.5, 1.5]])

    def both(value):
        return dims, np.array([7.0, value])[:, None, None, None] * factor

    return xr.Dataset(
        {
            "gravity": 10.0,
            "first_period": 2.0,
            "speed_at_collapse": ("restitution", [5.0, 4.0]),
            "mean_square_velocity": both(3.0),
            "elastic_square_velocity": both(2.0),
            "mean_height": both(0.4),
            "plate_force": both(1.0),
            "soft_kinetic_energy": 0.0,
            "soft_elastic_energy": 0.6,
            "soft_potential_energy": -1.2,
            "soft_force": 1.0,
        },
        {"restitution": [0.5, 0.8], "contact_ratio": [0.1], "window": [1.0, 10.5], "window_end": [0.25, 0.75]},
        {"restitution": 0.8, "contact_ratio": 0.1, "title": "something else"},
    )


def test_the_ball_that_is_shown(ball):
    assert shown(ball)["speed_at_collapse"] == 4


def test_energies_in_their_unit(ball):
    table = energies_at_rest(ball).set_index("quantity")
    assert table["real"].tolist()[:2] == [0, 0.15]
    assert table["real"].tolist()[3:] == [-0.3, 1]
    assert table["ihs"]["(free) kinetic energy"] == table["ihs"]["potential energy"] == 2
    assert table["tc"]["(free) kinetic energy"] == pytest.approx(0.125)
    assert table["tc"]["elastic, kinetic energy"] == 0.25
    assert table["tc"]["potential energy"] == 1
    np.testing.assert_allclose(table.loc["potential energy", ["tc_10.5_low", "tc_10.5_high"]].astype(float), [0.5, 1.5])
    assert table.loc["force on the plate", ["tc", "tc_10.5_low", "tc_10.5_high"]].tolist() == [1, 0.5, 1.5]


def test_a_model_has_a_number_where_it_has_a_symbol(ball):
    table = energies_at_rest(ball)
    for model in ("real", "ihs", "tc"):
        assert (table[model].isna() == (table[f"{model}_symbol"] == "")).all()
