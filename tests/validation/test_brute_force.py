"""The engine and brute force see the same collisions.

Disks are a chaotic system: a collision multiplies every error by about twice the free path over d, which is a factor of 100 at
an area fraction of .01 and less than 2 from .5 on. Positions are known to 1e-14 d, so double precision holds the times
of collisions to 1e-9 of the mean time between them for `STRETCH` collisions per particle, and no longer. Brute force
therefore starts afresh from the engine's state after each stretch.

Where partners hardly move towards each other between two collisions (`RESOLVED`), rounding decides what comes next. With
r = 0 that is the rule: as soon as three disks meet, they collapse. With t_c > 0 the collapse ends by itself and the
comparison goes on behind it; with t_c = 0 it ends there, and another start goes on.
"""

import math

import numpy as np
import pytest
from reference import RESOLVED, follow

from granugas.analysis.theory import enskog_rate
from granugas.dynamics.events.effects.recorder import recorder
from granugas.dynamics.events.engine import Engine
from granugas.scene import Scene

STRETCH = {0.01: 0.5, 0.05: 1.5, 0.25: 3.0, 0.45: 6.0, 0.5: 6.0, 0.6: 6.0, 0.7: 10.0, 0.85: 10.0}
"""Collisions per particle from one state on, by area fraction; for spheres and beads too."""

COLLISIONS_PER_PARTICLE = 10
TIMES, VELOCITIES = 1.0e-9, 1.0e-6
"""Tolerances, in mean times between collisions and in rms velocities."""

FRACTIONS = (0.01, 0.05, 0.25, 0.5, 0.7, 0.85)
RESTITUTIONS = (1.0, 0.8, 0.4, 0.0)
CONTACT_TIMES = (0.0, 1.0e-5, 1.0e-3)


def compare(scene, start, wanted):
    """Let engine and brute force collide side by side; how many collisions were seen, and whether a collapse ended it."""
    n, r, t_c = scene.n_particles, scene.restitution, scene.contact_time
    stretch = max(1, int(STRETCH[scene.area_fraction] * n / 2))
    rough = (scene.tangential_restitution, scene.friction) if scene.rough else None
    engine = Engine(scene, start, watch=recorder(wanted))
    done = 0
    while done < wanted:
        before = engine.state()
        expected = follow(before, scene.diameter, r, t_c, min(stretch, wanted - done), rough)
        times = []
        for _ in expected.time:
            engine.advance(math.inf, most_collisions=1)
            times.append(engine.time - before.time)
        after, seen = engine.state(), engine.watch.seen.rows[done:]
        done += len(times)

        np.testing.assert_array_equal(np.stack([seen["i"], seen["j"]], axis=1)[: len(times)], expected.pair)
        speed_2 = np.mean(np.sum(before.velocity**2, axis=1))
        rate = enskog_rate(scene.area_fraction, speed_2 / 2, scene.diameter, scene.dimensions)
        near = {"rtol": TIMES, "atol": TIMES / rate}
        resolved = expected.approach >= RESOLVED
        np.testing.assert_allclose(np.array(times)[resolved], expected.time[resolved], **near)
        if t_c > 0:
            assert engine.take_tally().elastic.tolist() == [expected.elastic.sum()]
        if resolved.all():
            tolerance = VELOCITIES * math.sqrt(speed_2)
            np.testing.assert_allclose(after.velocity, expected.velocity, rtol=0, atol=tolerance)
            if rough:
                spins = {"rtol": 0, "atol": 4 * tolerance / scene.diameter}
                np.testing.assert_allclose(after.more["spin"], expected.spin, **spins)
            np.testing.assert_allclose(after.last_collision_time, expected.last_collision_time, **near)
        elif t_c == 0:
            return done, True
    return done, False


def check(scene, start_of):
    """Compare for ten collisions per particle; with r = t_c = 0 in as many pieces as collapses make it."""
    wanted = math.ceil(COLLISIONS_PER_PARTICLE * scene.n_particles / 2)
    done, realization = 0, 0
    while done < wanted:
        more, collapsed = compare(scene, start_of(scene, realization), wanted - done)
        done, realization = done + more, realization + 1
        assert scene.restitution == 0 or not collapsed


@pytest.mark.parametrize("n_particles", [42, 64])
@pytest.mark.parametrize("contact_time", CONTACT_TIMES)
@pytest.mark.parametrize("restitution", RESTITUTIONS)
@pytest.mark.parametrize("area_fraction", FRACTIONS)
def test_many_disks(area_fraction, restitution, contact_time, n_particles, start_of):
    scene = Scene(n_particles, area_fraction, restitution, contact_time)
    check(scene, start_of)


@pytest.mark.parametrize("n_particles", [2, 3, 5])
@pytest.mark.parametrize("contact_time", CONTACT_TIMES)
@pytest.mark.parametrize("restitution", RESTITUTIONS)
@pytest.mark.parametrize("area_fraction", FRACTIONS[:4])
def test_few_disks(area_fraction, restitution, contact_time, n_particles, start_of):
    """The box is so small that a disk meets several images of another, and flies around the box in between."""
    scene = Scene(n_particles, area_fraction, restitution, contact_time)
    check(scene, start_of)


@pytest.mark.parametrize(("n_particles", "aspect_ratio"), [(64, 4.0), (96, 10.0)])
@pytest.mark.parametrize(("restitution", "contact_time"), [(1.0, 0.0), (0.4, 1.0e-5)])
@pytest.mark.parametrize("area_fraction", FRACTIONS)
def test_elongated_boxes(area_fraction, restitution, contact_time, n_particles, aspect_ratio, start_of):
    scene = Scene(n_particles, area_fraction, restitution, contact_time, aspect_ratio=aspect_ratio)
    box = start_of(scene).box
    assert box[0] / box[1] == pytest.approx(aspect_ratio, rel=0.5)
    check(scene, start_of)


@pytest.mark.parametrize(
    ("restitution", "contact_time", "beta", "mu"),
    [(1.0, 0.0, 1.0, math.inf), (0.8, 0.0, 0.0, math.inf), (0.8, 1.0e-4, 0.5, 0.2), (0.4, 1.0e-5, -0.5, 0.1)],
)
@pytest.mark.parametrize("area_fraction", [0.05, 0.25, 0.7])
def test_rough_disks(area_fraction, restitution, contact_time, beta, mu, start_of):
    """The start has collided with rough surfaces already: its disks spin."""
    scene = Scene(42, area_fraction, restitution, contact_time, tangential_restitution=beta, friction=mu)
    assert np.all(start_of(scene).more["spin"] != 0)
    check(scene, start_of)


@pytest.mark.parametrize(("sizes", "spread"), [("bidisperse", 0.2), ("uniform", 0.5), ("log_normal", 0.15)])
@pytest.mark.parametrize(("restitution", "contact_time"), [(1.0, 0.0), (0.8, 0.0), (0.4, 1.0e-5)])
@pytest.mark.parametrize("area_fraction", [0.05, 0.25])
def test_disks_of_different_sizes(area_fraction, restitution, contact_time, sizes, spread, start_of):
    scene = Scene(42, area_fraction, restitution, contact_time, sizes=sizes, size_share=0.3, size_spread=spread)
    check(scene, start_of)


@pytest.mark.parametrize("n_particles", [2, 3, 5, 32])
@pytest.mark.parametrize(("restitution", "contact_time"), [(1.0, 0.0), (0.9, 0.0), (0.4, 1.0e-5), (0.0, 1.0e-3)])
@pytest.mark.parametrize("area_fraction", [0.01, 0.05, 0.25, 0.45, 0.6])
def test_spheres(area_fraction, restitution, contact_time, n_particles, start_of):
    """Few ones where they fit, crystals above .49."""
    if n_particles > 5 or area_fraction <= 0.25:
        check(Scene(n_particles, area_fraction, restitution, contact_time, dimensions=3), start_of)


@pytest.mark.parametrize("area_fraction", [0.05, 0.45])
def test_spheres_in_an_elongated_box(area_fraction, start_of):
    scene = Scene(48, area_fraction, 0.4, 1.0e-5, dimensions=3, aspect_ratio=4.0)
    x, y, z = start_of(scene).box
    assert x / y == pytest.approx(4.0, rel=0.5)
    assert z == pytest.approx(math.sqrt(x * y), rel=0.5)
    check(scene, start_of)


@pytest.mark.parametrize("n_particles", [2, 3, 5, 42])
@pytest.mark.parametrize(("restitution", "contact_time"), [(1.0, 0.0), (0.99, 0.0), (0.8, 1.0e-5), (0.5, 1.0e-3)])
@pytest.mark.parametrize("area_fraction", [0.01, 0.25, 0.5, 0.85])
def test_beads(area_fraction, restitution, contact_time, n_particles, start_of):
    """Not with small r: beads in touch pass on a hit in no time, and nothing but rounding orders the collisions."""
    check(Scene(n_particles, area_fraction, restitution, contact_time, dimensions=1), start_of)
