"""cluster1999 section 3: small systems, N = 784, five contact times (Fig. 2)."""

import numpy as np

from granugas.analysis.comparison import log_mean
from granugas.analysis.statistics import jackknife, mean_and_error
from granugas.analysis.theory import elastic_collision_fraction
from granugas.claims import at_least, at_most, claim, claims_in
from granugas.measured import (
    NotMeasured,
    at_times,
    common,
    elastic_share,
    enough_runs,
    last_common,
    nearest,
    runs,
    series,
    side_by_side,
)

STUDIES = ("cluster1999_contact_times",)
EXPERIMENTS = ()

CONTACT_TIMES = (1e-3, 1e-5, 1e-6, 1e-8, 1e-10)

SYMBOL = 1.0
"""A factor 2 is the height of a symbol on axes that show K over ten decades: agreement as far as the paper's figures tell."""


def of_time(data, contact_time):
    found = runs(data, "cluster1999_contact_times", n_particles=784, restitution=0.6, contact_time=contact_time)
    return found.isel(time=slice(1, None))


def for_all_times(data, name, contact_times=CONTACT_TIMES):
    """A quantity of (realization, contact time, sample), and C/N of the samples."""
    found = [of_time(data, t_c) for t_c in contact_times]
    return np.stack([series(one[name]) for one in found], axis=1), common(found[0]["collisions_per_particle"])


def widest(data, contact_times):
    """The largest factors between K, and between t, of two of these contact times for C/N = 1 ... 10."""
    found = []
    for name in ("kinetic_energy", "sampling_time"):
        values, count = for_all_times(data, name, contact_times)
        shown = (count >= 1) & (count <= 10)
        found.append(jackknife(lambda v: np.exp(np.ptp(log_mean(v), axis=0).max()), values[:, :, shown]))
    return side_by_side(found)


@claim(
    "B-3-18",
    figure="cluster1999_fig2",
    quantity="c_e over the whole run at t_c = 1e-10 s, r = .6 < r_c",
    expected=at_least(1e-3),
    why="mean field gives 5e-8; a share of 1e-3 comes from collisions that would go on without end",
    remark="No collision of any run was elastic: r = .6 is nowhere near a collapse up to C/N = 1000. Eq. 5 is an estimate; "
    "at r = .2 and t_c = 1e-5 s a fifth of the collisions is elastic, forty times mean field.",
)
def collapse_below(data):
    """For r < r_c the collision frequency would diverge; the TC model cuts that off."""
    return mean_and_error(elastic_share(of_time(data, 1e-10)))


@claim(
    "B-3-28",
    figure="cluster1999_fig2",
    quantity="largest factor between K, and between t, of two t_c at the same C/N = 1 ... 10, all five t_c",
    expected=at_most(1, absolute=SYMBOL),
    why="a symbol's height; Eq. 21 of the other paper has 40 % of the collisions elastic at first for t_c = 1e-3 s",
)
def small_times_alike(data):
    """The behaviour does not depend on t_c for small C/N and short times."""
    return widest(data, CONTACT_TIMES)


@claim(
    "B-3-29",
    figure="cluster1999_fig2",
    quantity="largest factor between K, and between t, of two t_c <= 1e-5 s at the same C/N = 1 ... 10",
    expected=at_most(1, absolute=0.1),
    why="where c_e is half a per cent the agreement must be better than the paper's axes show: 10 %",
)
def small_times_the_same(data):
    """That holds for t_c <= 1e-5 s in particular."""
    return widest(data, CONTACT_TIMES[1:])


@claim(
    "B-3-30",
    figure="cluster1999_fig2",
    quantity="rms of ln K_a/K_b from 1 s to the last common time, on a logarithmic axis, largest of the pairs of t_c < 1e-5 s",
    expected=at_most(np.log(1 + SYMBOL)),
    why="a symbol's height",
)
def energy_independent_of_tc(data):
    """The energy is almost independent of t_c for large times, as long as t_c < 1e-5 s."""
    found = [of_time(data, t_c) for t_c in CONTACT_TIMES[2:]]
    times = np.geomspace(1, last_common(found), 40)
    values = np.stack([at_times(one, "kinetic_energy", times) for one in found], axis=1)

    def apart(v):
        logs = log_mean(v)
        return max(np.sqrt(((logs[a] - logs[b]) ** 2).mean()) for a, b in ((0, 1), (0, 2), (1, 2)))

    return jackknife(apart, values)


@claim(
    "B-3-34",
    figure="cluster1999_fig2",
    quantity="largest difference of Kx at C/N = .1 between the t_c of a start state, by K, t_c <= 1e-6 s, where no collision "
    "was elastic yet",
    expected=at_most(1e-9),
    why="the same 39 collisions to the last digits, none of which has t_c at work",
)
def identical_start(data):
    """The initial conditions are identical for all t_c."""
    values, _ = for_all_times(data, "kinetic_energy_x", CONTACT_TIMES[2:])
    elastic, _ = for_all_times(data, "elastic_collisions_per_particle", CONTACT_TIMES[2:])
    chosen = values[~elastic[:, :, 0].any(axis=1), :, 0]
    if not len(chosen):
        raise NotMeasured("every start state has an elastic collision before C/N = .1")
    return np.ptp(chosen, axis=1).max()


@claim(
    "B-3-35",
    figure="cluster1999_fig2",
    quantity="d ln K / d log10 t_c at 10 s, least squares over the five t_c",
    expected=at_least(0),
    why="'the tendency': the sign alone",
)
def weaker_dissipation(data):
    """Larger t_c lead to a weaker dissipation during time."""
    values = np.concatenate([at_times(of_time(data, t_c), "kinetic_energy", [10.0]) for t_c in CONTACT_TIMES], axis=1)
    return jackknife(lambda v: np.polyfit(np.log10(CONTACT_TIMES), log_mean(v), 1)[0], values)


@claim(
    "B-3-36",
    figure="cluster1999_fig2",
    quantity="smallest K of t_c = 1e-3 s by that of any smaller t_c at the same time, t = .1, 1, 10 s",
    expected=at_least(1),
    why="the order alone",
)
def weakest_for_the_largest(data):
    """In particular those of t_c = 1e-3 s."""
    times = [0.1, 1.0, 10.0]
    values = np.stack([at_times(of_time(data, t_c), "kinetic_energy", times) for t_c in CONTACT_TIMES], axis=1)
    return jackknife(lambda v: np.exp((log_mean(v)[0] - log_mean(v)[1:]).min(axis=0)), values)


@claim(
    "B-3-37",
    figure="cluster1999_fig2",
    quantity="difference of ln K, and of ln t, at C/N = 1000 between t_c = 1e-8 s and the mean of 1e-5, 1e-6, 1e-10 s, in "
    "standard deviations of one run",
    expected=at_least(2),
    why="what deviates strongly lies outside of the scatter of single runs",
    remark="On average t_c = 1e-8 s is like its neighbours: the difference is a fraction of the scatter. The paper has "
    "one run of each t_c, and single runs scatter widely once there is a shear mode (B-3-13, B-3-33).",
)
def one_deviates(data):
    """The simulation with t_c = 1e-8 s deviates strongly from the other ones in K and t against C/N."""
    found = []
    enough_runs(of_time(data, 1e-8))
    for name in ("kinetic_energy", "sampling_time"):
        values, _ = for_all_times(data, name, (1e-8, 1e-5, 1e-6, 1e-10))

        def apart(v):
            return np.abs(v[:, 0].mean() - v[:, 1:].mean()) / np.sqrt(v.var(axis=0, ddof=1).mean())

        found.append(jackknife(apart, np.log(values[:, :, -1])))
    return side_by_side(found)


@claim(
    "B-3-38",
    figure="cluster1999_fig2",
    quantity="c_e from C/N = 100 on by Eq. 21 of the other paper at t = 0, t_c = 1e-6, 1e-8, 1e-10 s",
    expected=at_least(10),
    why="'comparatively large': a decade above the homogeneous gas at its hottest",
    remark="The gas is cold by then. Compared with the mean field at the rates of that time c_e is some 50 times "
    "larger (1e-6 s), but not with that of the hot start; for 1e-8 s it is few collisions, for 1e-10 s hardly any.",
)
def many_affected(data):
    """Once there are strong fluctuations in density a comparatively large number of particles is affected by the TC model."""
    found = []
    for t_c in CONTACT_TIMES[2:]:
        one = of_time(data, t_c)
        theory = elastic_collision_fraction(t_c, float(one["enskog_rate"].mean()))
        found.append(mean_and_error(elastic_share(one, nearest(common(one["collisions_per_particle"]), 100)) / theory))
    return side_by_side(found)


CLAIMS = claims_in(globals())
