"""The small parts; what they measure together is in validation/test_bouncing.py."""

import numpy as np
import pytest

from granugas.dynamics.events.effects.constant import Constant
from granugas.dynamics.events.effects.contact_time import ContactTime
from granugas.dynamics.plate import Ball, bounce
from granugas.experiments import bouncing


def test_phases_are_the_middles():
    np.testing.assert_allclose(bouncing._phases(4), [0.125, 0.375, 0.625, 0.875])


def test_a_ball_that_rises_keeps_its_velocity_and_one_that_falls_hits_once(monkeypatch):
    """t_n = t_c: every further hit comes later than t_c and dissipates."""
    monkeypatch.setattr(bouncing, "RELEASES", 4)
    period = 2 / bouncing.GRAVITY
    staying = bounce(ContactTime(Constant(0.5), period), Ball(0.0, -1.0, period), bouncing.GRAVITY, 3)
    released = list(bouncing._released(ContactTime(Constant(0.5), period), staying, period))
    np.testing.assert_allclose(released, [0.75, 0.25, 0.125, 0.375])
    patient = list(bouncing._released(ContactTime(Constant(0.5), 1.2 * period), staying, period))
    np.testing.assert_allclose(patient, [0.75, 0.25, 0.125, 0.75])  # (1 + w)^2 / (4 w) = 1.02 at w = .75, 1.56 at .25


def test_a_window_ends_at_its_phase():
    staying = bounce(ContactTime(Constant(0.5), 1.0), Ball(0.0, -1.0, 0.1), bouncing.GRAVITY, 4)
    period = staying.since[-1]
    first_half = bouncing._window(staying, period / 2, 0.5, 1.0)
    assert first_half.v == pytest.approx(0.5)
    assert first_half.force == 0
