"""cluster1999 section 3: small systems, N = 784, numbers of collisions, their jumps, and collapse (Fig. 1)."""

import numpy as np

from granugas.analysis.comparison import log_mean
from granugas.analysis.statistics import jackknife, mean_and_error
from granugas.analysis.theory import collapse_restitution
from granugas.claims import at_least, at_most, between, claim, claims_in
from granugas.measured import at_times, common, elastic_share, nearest, runs, series, side_by_side

STUDIES = ("cluster1999_restitutions",)
EXPERIMENTS = ()

RESTITUTIONS = (0.99, 0.97, 0.95, 0.9, 0.8, 0.6, 0.2)

JUMP, COUNTED = 10, 10
"""A jump: C/N grows so many times faster than on average until then. Before this C/N samples hold too few collisions."""


def of(data, restitution):
    return runs(data, "cluster1999_restitutions", n_particles=784, restitution=restitution).isel(time=slice(1, None))


def order_of_collisions(data, times):
    """Smallest ratio of C/N from one r to the next larger at these times."""
    values = np.stack([at_times(of(data, r), "collisions_per_particle", times) for r in RESTITUTIONS], axis=1)
    return jackknife(lambda v: np.exp(-np.diff(log_mean(v), axis=0).max(axis=0)), values)


@claim(
    "B-3-15",
    figure="cluster1999_fig1",
    quantity="smallest ratio of C/N from one r to the next larger, at t = .02 and .1 s",
    expected=at_least(1),
    why="the order alone",
    remark="At .02 s all is as the paper says, within errors; at .1 s for r = .99 ... .6. At r = .2 there are clusters by "
    "then, which collide more often than the gas of r = .6.",
)
def more_collisions_at_first(data):
    """C/N grows faster for weaker dissipation: before there are clusters."""
    return order_of_collisions(data, [0.02, 0.1])


@claim(
    "B-3-16",
    figure="cluster1999_fig1",
    quantity="smallest ratio of C/N from one r to the next larger, at t = 1 and 10 s",
    expected=at_least(1),
    why="the order alone",
    remark="The reason that the paper gives, a rate that falls with the energy, is one of homogeneous cooling. Clusters "
    "turn the order round: C/N is least at r = .6 (1 s) and r = .8 (10 s) and grows from there towards r = .2, which "
    "leads at 10 s.",
)
def more_collisions_later(data):
    """C/N grows faster for weaker dissipation: later on as well."""
    return order_of_collisions(data, [1.0, 10.0])


@claim(
    "B-3-17",
    quantity="r_c of Eq. 5 for the measured N and area fraction",
    expected=between(0.6, 0.8),
    why="no number in print; between the r = .6 of Fig. 2, where t_c is at work, and the r = .8 of the large system",
)
def critical_restitution(data):
    """Inelastic collapse can be expected for r below r_c, so for r = .6 and .2."""
    found = of(data, 0.6)
    sides = found["box_x"] * found["box_y"] / found["diameter"] ** 2
    return float(collapse_restitution(784, 784 * np.pi / 4 / sides.mean()))


@claim(
    "B-3-19",
    figure="cluster1999_fig1",
    quantity="c_e from C/N = 500 to 1000 at t_c = 1e-5 s, r = .95, .9, .8 > r_c",
    expected=at_most(5e-3),
    why="2 t_c/t_E(0): no more than in the homogeneous gas at its hottest",
)
def no_collapse_above(data):
    """In the intermediate regime, r > r_c, density variations do not in general lead to a divergence."""
    found = [of(data, r) for r in RESTITUTIONS[2:5]]
    half = nearest(common(found[0]["collisions_per_particle"]), 500)
    return side_by_side([mean_and_error(elastic_share(one, half)) for one in found])


def jumps(found):
    """How many times faster than on average until then C/N grows between two samples, and changes of C/N, C_e/N and ln K.

    Four of (realization, interval), from C/N = COUNTED on.
    """
    shown = found.isel(time=slice(int((common(found["collisions_per_particle"]) >= COUNTED).argmax()), None))
    time, count = series(shown["sampling_time"]), series(shown["collisions_per_particle"])
    change = np.diff(count, axis=1)
    faster = change / np.diff(time, axis=1) / (count / time)[:, :-1]
    elastic = np.diff(series(shown["elastic_collisions_per_particle"]), axis=1)
    return faster, change, elastic, np.diff(np.log(series(shown["kinetic_energy"])), axis=1)


@claim(
    "B-3-21",
    figure="cluster1999_fig1",
    quantity="largest rate of collisions between two samples by the mean rate until then, mean of ln over the runs, r = .6 "
    "and .2",
    expected=at_least(JUMP),
    why="a step ten times as steep as the curve about it is a jump",
    remark="The largest rates are 2 and 3 to 4 times the mean: at r = .2 C/N grows fast, but steadily. Shorter bursts, of a "
    "collision per particle or less, fall between the samples, which are 2 % of C/N apart, and are no jumps at the "
    "scale of the figure. The paper does not say how far apart its data points are.",
)
def horizontal_jumps(data):
    """Many collisions occur within a short time, which are horizontal jumps in Fig. 1(b-d)."""
    found = [jackknife(lambda v: np.exp(v.mean(axis=0)), np.log(jumps(of(data, r))[0].max(axis=1))) for r in (0.6, 0.2)]
    return side_by_side(found)


@claim(
    "B-3-22",
    figure="cluster1999_fig1",
    quantity="largest rate of collisions between two samples by the mean rate until then, all runs, r = .99",
    expected=at_most(2),
    why="in homogeneous cooling the rate falls, so 1 and some noise of 90 collisions",
)
def none_without_clusters(data):
    """Jumps indicate clusters: in the homogeneous state there are none."""
    return jumps(of(data, 0.99))[0].max()


def fastest(data, restitution):
    """C/N, C_e/N and -ln K of the interval with the largest rate, C/N and C_e/N of all others, (realization, 5)."""
    faster, change, elastic, log_energy = jumps(of(data, restitution))
    there = np.arange(faster.shape[1]) == faster.argmax(axis=1)[:, np.newaxis]
    parts = (there * change, there * elastic, -log_energy * there, ~there * change, ~there * elastic)
    return np.stack([part.sum(axis=1) for part in parts], axis=1)


@claim(
    "B-3-23",
    figure="cluster1999_fig1",
    quantity="-ln K by (1 - r^2)/2 C/N in the interval of each run that has the largest rate of collisions, r = .6 and .2",
    expected=at_most(0.1),
    why="a tenth of what the same collisions would cost if they were those of all particles",
)
def energy_does_not_jump(data):
    """The energy is not affected in the same way as C/N, since only a few particles carry out the collisions of a jump."""

    def loss(v, r):
        total = v.sum(axis=0)
        return total[2] / total[0] / ((1 - r**2) / 2)

    return side_by_side([jackknife(lambda v, r=r: loss(v, r), fastest(data, r)) for r in (0.6, 0.2)])


@claim(
    "B-3-24",
    figure="cluster1999_fig1",
    quantity="c_e in the interval of each run that has the largest rate of collisions by c_e of all others after C/N = 10, "
    "r = .6, .2",
    expected=at_least(2),
    why="'activated': twice as much as elsewhere at least",
    remark="At r = .6 it is so, more than tenfold. At r = .2 a fifth of all collisions is elastic, whether the rate is large "
    "or not.",
)
def tc_model_in_jumps(data):
    """The TC model is activated when the few particles of a jump collide more than once within t_c."""

    def ratio(v):
        total = v.sum(axis=0)
        return (total[1] / total[0]) / (total[4] / total[3])

    return side_by_side([jackknife(ratio, fastest(data, r)) for r in (0.6, 0.2)])


CLAIMS = claims_in(globals())
