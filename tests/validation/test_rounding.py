"""Does the answer depend on rounding? Trajectories do, means do not."""

from dataclasses import replace

import numpy as np
import pytest

from granugas.analysis.divergence import growth_rate
from granugas.analysis.statistics import mean_and_error
from granugas.analysis.theory import enskog_rate
from granugas.equilibrate import equilibrate, state_of
from granugas.experiments.rounding import SCENES, follow, last_bit, separation, stops

RUNS, N = 12, SCENES[0].n_particles
RATE = float(enskog_rate(SCENES[0].area_fraction, SCENES[0].velocity_half_width ** 2 / 3, SCENES[0].diameter))


def moved(start, rng):
    """Every coordinate by up to 1e-8 d, 1e7 times as far as the last bit."""
    place = start.position + 1e-8 * SCENES[0].diameter * rng.uniform(-0.5, 0.5, start.position.shape)
    return replace(start, position=np.mod(place, start.box))


@pytest.fixture(scope="module", params=[1.0, 0.9])
def runs(request):
    """Of each start: the run, a copy with other last bits, one moved further; and where they are looked at."""
    (scene,) = (scene for scene in SCENES if scene.restitution == request.param)
    times, found = stops(request.param) / RATE, []
    for k in range(RUNS):
        start, rng = state_of(equilibrate(scene, seed=2024, realization=k)), np.random.default_rng(k)
        found.append([follow(scene, state, times) for state in (start, last_bit(start, rng), moved(start, rng))])
        found[-1].append(start.box)
    return scene, found


def test_they_part_at_one_rate_however_small_the_difference(runs):
    """Exponents per collision from 1e-12 to 1e-7 d, and from 1e-7 to 1e-2 d, of copies 1e-15 and 1e-8 d away."""
    scene, found = runs
    rates = {name: [] for name in ("early", "late", "moved")}
    for run, near, far, box in found:
        apart, further = (separation(run, copy, scene, box) for copy in (near, far))
        rates["early"].append(growth_rate(run.collisions, apart, (1e-12, 1e-7)))
        rates["late"].append(growth_rate(run.collisions, apart, (1e-7, 1e-2)))
        rates["moved"].append(growth_rate(run.collisions, further, (1e-7, 1e-2)))
    (early, late, further), errors = mean_and_error(np.transpose(list(rates.values())))
    assert errors.max() < 0.1 * early
    assert abs(early - late) < 4 * np.hypot(errors[0], errors[1])
    assert abs(late - further) < 4 * np.hypot(errors[1], errors[2])
    # What began a last bit apart is a diameter apart after ln(1e15) collisions by the exponent.
    reached = [run.collisions[(separation(run, near, scene, box) > 0.1).argmax()] for run, near, _, box in found]
    assert np.mean(reached) == pytest.approx(np.log(1e14) / early, rel=0.25)


def test_means_do_not_depend_on_it(runs):
    """Collisions and energy of copies that have parted long ago, against those of the runs and against their spread."""
    scene, found = runs
    at = [120, 180, 240]
    quantities = ["collisions"] + (["energy"] if scene.restitution < 1 else [])
    for name in quantities:
        run, copy = (np.log([getattr(paths[k], name)[at] for paths in found]) for k in (0, 1))
        spread = run.std(axis=0, ddof=1)
        assert np.all(np.abs(run - copy) > 0)
        assert np.all(np.abs(copy - run.mean(axis=0)) < 5 * spread)
        mean, error = mean_and_error(copy - run)
        assert np.all(np.abs(mean) < 5 * error)
        assert np.all((copy - run).std(axis=0, ddof=1) < 2.5 * spread)
