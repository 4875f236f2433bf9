"""The pressure in test volumes, of one realization of the experiment."""

import numpy as np
import pytest

from granugas.experiments import volumes
from granugas.storage.variables import describe


@pytest.fixture(scope="module")
def measured():
    return describe(volumes.measure(realizations=1)).isel(realization=0)


def test_volumes_add_up_to_the_box(measured):
    """Kinetic and streaming parts make up all energy, and collisions are the engine's, however the box is cut."""
    np.testing.assert_allclose(measured["kinetic_pressure"] + measured["streaming_pressure"], 1, rtol=1e-12)
    own, given = measured["tally_pressure"].broadcast_like(measured["collisional_pressure"]), measured["collisional_pressure"]
    np.testing.assert_allclose(given, own, rtol=1e-9)


def test_clusters_move_as_a_whole_and_particles_in_equilibrium_do_not(measured):
    """In equilibrium streaming is one particle's share, V/V_c by N; among clusters it becomes most of the energy."""
    elastic, clusters = measured.sel(restitution=1.0), measured.sel(restitution=0.4)
    share = (measured["test_volumes"] - 1) / measured.attrs["n_particles"]  # the box as a whole is at rest
    np.testing.assert_allclose(elastic["streaming_pressure"], share, atol=2e-3)
    assert np.all(np.diff(clusters["streaming_pressure"]) > 0)
    assert clusters["streaming_pressure"][-1] > 0.5


def test_averages_level_noise_but_not_clusters(measured):
    """Spread over V/64 in averages over the whole record by that in single steps."""
    ratio = measured["pressure_spread"].sel(test_volumes=64)
    ratio = ratio.isel(averaging_interval=-1) / ratio.isel(averaging_interval=0)
    assert ratio.sel(restitution=1.0) < 0.4
    assert ratio.sel(restitution=0.4) > 0.7
    assert np.isnan(measured["pressure_spread"].sel(test_volumes=1)).all()


def test_map_and_series_are_of_the_same_pressure(measured):
    total = measured["kinetic_pressure"] + measured["collisional_pressure"]
    clusters = measured.sel(restitution=0.4)
    assert clusters["pressure_series"].mean() > 3 * float(total.sel(restitution=0.4, test_volumes=64))
    mapped = measured["pressure_map"].mean(("map_row", "map_column")).sel(restitution=1.0)
    assert float(mapped) == pytest.approx(float(total.sel(restitution=1.0, test_volumes=256)), rel=0.02)
    sides = [measured.attrs["box_x"], measured.attrs["box_y"]]
    assert ((clusters["position"] >= 0) & (clusters["position"] < sides)).all()


def test_spread():
    """Two volumes: 1 and 3, then 2 and 4; averages over both times are 1.5 and 3.5."""
    values = np.array([[1.0, 3.0], [2.0, 4.0]])
    assert volumes.spread(values, 1) == pytest.approx(np.sqrt(((1 / 2) ** 2 + (1 / 3) ** 2) / 2))
    assert volumes.spread(values, 2) == pytest.approx(1 / 2.5)
