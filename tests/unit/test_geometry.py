"""Volumes in one, two and three dimensions."""

import math

import pytest

from granugas.geometry import CLOSE_PACKING, box_volume


def test_particles_fill_their_share_of_the_box():
    for dimensions, ball in ((1, 2e-3), (2, math.pi * 1e-6), (3, 4 / 3 * math.pi * 1e-9)):
        assert 7 * ball / box_volume(7, 0.2, 2e-3, dimensions) == pytest.approx(0.2, rel=1e-14)


def test_the_densest_packings():
    """A bead to its diameter, a disk to its hexagon, a sphere to its rhombic dodecahedron."""
    assert CLOSE_PACKING[1] == 1
    assert CLOSE_PACKING[2] == pytest.approx(math.pi / 4 / (math.sqrt(3) / 2), rel=1e-15)
    assert CLOSE_PACKING[3] == pytest.approx(math.pi / 6 / (math.sqrt(2) / 2), rel=1e-15)
