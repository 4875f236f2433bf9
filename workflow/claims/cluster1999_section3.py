"""cluster1999 section 3: small systems, N = 784, with seven coefficients of restitution and with five contact times."""

import numpy as np

from granugas.analysis.comparison import interpolated, log_mean, onset
from granugas.analysis.statistics import jackknife, mean_and_error
from granugas.analysis.theory import (
    collapse_restitution,
    elastic_collision_fraction,
    energy_after_collisions,
    homogeneous_cooling,
)
from granugas.claims import NotMeasured, at_least, at_most, between, claim, claims_in, runs, value

STUDIES = ("cluster1999_restitutions", "cluster1999_contact_times", "cluster1999_large")
EXPERIMENTS = ()

RESTITUTIONS = (0.99, 0.97, 0.95, 0.9, 0.8, 0.6, 0.2)
CONTACT_TIMES = (1e-3, 1e-5, 1e-6, 1e-8, 1e-10)

SYMBOL = 1.0
"""A factor 2 is the height of a symbol on axes that show K over ten decades: agreement as far as the paper's figures tell."""

BEGINNING = np.log(1.25)
"""Of a deviation: a quarter."""

ANISOTROPIC = 0.2
"""rms of (Kx - Kz)/K over runs; an isotropic gas of 784 disks has 1/sqrt(784) = .036."""

JUMP, COUNTED = 10, 10
"""A jump: C/N grows so many times faster than on average until then. Before this C/N samples hold too few collisions."""


def of(data, restitution):
    return runs(data, "cluster1999_restitutions", n_particles=784, restitution=restitution).isel(time=slice(1, None))


def of_time(data, contact_time):
    found = runs(data, "cluster1999_contact_times", n_particles=784, restitution=0.6, contact_time=contact_time)
    return found.isel(time=slice(1, None))


def series(found, name):
    """(realization, sample)."""
    return found[name].transpose("realization", "time").values


def collisions(found):
    """C/N of the samples, the same in all runs."""
    return found["collisions_per_particle"].mean("realization").values


def anisotropy(found):
    """(Kx - Kz)/K of (realization, sample)."""
    return (series(found, "kinetic_energy_x") - series(found, "kinetic_energy_y")) / series(found, "kinetic_energy")


def at_times(found, name, times):
    """A quantity of (realization, time)."""
    return interpolated(series(found, "sampling_time"), series(found, name), times)


def last_common(several):
    """The time in s that all runs reach."""
    return min(np.nanmax(series(found, "sampling_time"), axis=1).min() for found in several)


def above_eq_1(found, restitution):
    """ln of K by Eq. 1 at the same time, (realization, sample)."""
    return np.log(series(found, "kinetic_energy") / homogeneous_cooling(series(found, "tau"), restitution))


def above_eq_3(found, restitution):
    """ln of K by Eq. 3 at the same C/N, (realization, sample)."""
    return np.log(
        series(found, "kinetic_energy") / energy_after_collisions(series(found, "collisions_per_particle"), restitution)
    )


def slope_by_eq_3(found, restitution):
    """ln K by that of Eq. 3, (realization, sample)."""
    return np.log(series(found, "kinetic_energy")) / np.log(
        energy_after_collisions(series(found, "collisions_per_particle"), restitution)
    )


def columns(found):
    """Values and errors of several (value, error)."""
    values, errors = zip(*found, strict=True)
    return np.array(values), np.array(errors)


def at_least_runs(found, n=3):
    if found.sizes["realization"] < n:
        raise NotMeasured(f"fewer than {n} runs")


@claim(
    "B-3-01",
    figure="cluster1999_fig1",
    quantity="length of the box in diameters",
    expected=value(50, rounding=0.5),
    why="the figure in print",
)
def box(data):
    """N = 784 particles at an area fraction of about .25 are a system of L = 50."""
    found = of(data, 0.99)
    return float(found["box_x"].mean() / found["diameter"])


@claim(
    "B-3-02",
    figure="cluster1999_fig1",
    quantity="collisions of a particle in 1/s until C/N = 2, r = .99",
    expected=value(251.2, rounding=0.05, relative=0.03),
    why="the energy of 784 random start velocities scatters the rate of the paper's run by 1.1 %; the rate falls by 1 % "
    "until then. The unit of velocity was inferred from rates like this one, so agreement is none of the paper's merits",
)
def initial_rate(data):
    """The initial collision rate is 251.2 /s."""
    found = of(data, 0.99)
    early = found.isel(time=int(np.argmin(np.abs(collisions(found) - 2))))
    return mean_and_error((early["collisions_per_particle"] / early["sampling_time"]).values)


@claim(
    "B-3-03",
    figure="cluster1999_fig1",
    quantity="C/N at the end, all runs of the seven r: least and largest",
    expected=value(1000, relative=1e-3),
    why="one collision of a pair is 2/784",
)
def until_a_thousand(data):
    """Until 1000 collisions per particle the runs go, r = .2 included."""
    ends = np.concatenate([series(of(data, r), "collisions_per_particle")[:, -1] for r in RESTITUTIONS])
    return [ends.min(), ends.max()]


@claim(
    "B-3-04",
    figure="cluster1999_fig1",
    quantity="largest factor between K and Eq. 1 over the whole run, r = .99",
    expected=at_most(1, absolute=SYMBOL),
    why="a symbol's height",
)
def nearly_elastic(data):
    """At r = .99 the energy is described well by homogeneous cooling."""
    return jackknife(lambda v: np.exp(np.abs(v.mean(axis=0)).max()), above_eq_1(of(data, 0.99), 0.99))


@claim(
    "B-3-05",
    figure="cluster1999_fig1",
    quantity="largest factor between K and Eq. 1 over the whole run, r = .97",
    expected=at_most(1, absolute=SYMBOL),
    why="a symbol's height",
)
def nearly_elastic_too(data):
    """At r = .97 as well."""
    return jackknife(lambda v: np.exp(np.abs(v.mean(axis=0)).max()), above_eq_1(of(data, 0.97), 0.97))


@claim(
    "B-3-06",
    figure="cluster1999_fig1",
    quantity="K by Eq. 1 at C/N = 1000, r = .95, .9, .8, .6, .2",
    expected=at_least(1 + SYMBOL),
    why="more than a symbol's height above",
)
def others_cool_slower(data):
    """At no smaller r it is: the simulations cool more slowly than predicted."""
    found = [jackknife(lambda v: np.exp(v.mean(axis=0)), above_eq_1(of(data, r), r)[:, -1]) for r in RESTITUTIONS[2:]]
    return columns(found)


@claim(
    "B-3-07",
    figure="cluster1999_fig1",
    quantity="ln K by that of Eq. 3 at C/N = 1000, r = .99 (Eq. 3: K = 4.8e-5)",
    expected=value(1, absolute=0.05),
    why="5 % for the departure of the velocities from Maxwell's, as for the same law in the other paper",
)
def straight_line(data):
    """For large r the energy is exp[-(1 - r^2)/2 C/N], a straight line in Fig. 1(b)."""
    return mean_and_error(slope_by_eq_3(of(data, 0.99), 0.99)[:, -1])


@claim(
    "B-3-08",
    figure="cluster1999_fig1",
    quantity="ln K by that of Eq. 3 at C/N = 5, the seven r",
    expected=value(1, absolute=0.1),
    why="the velocities' departure from Maxwell's makes up to 5 % at r = .2; as much again for the beginning of the deviation",
    remark="So it is for r >= .6. At r = .2 the first collisions already leave correlations: the loss is 12 % below Eq. 3 "
    "at C/N = 1 and 29 % at C/N = 5.",
)
def straight_at_first(data):
    """For small C/N all r follow Eq. 3."""
    found = []
    for r in RESTITUTIONS:
        one = of(data, r)
        found.append(mean_and_error(slope_by_eq_3(one, r)[:, np.argmin(np.abs(collisions(one) - 5))]))
    return columns(found)


@claim(
    "B-3-09",
    figure="cluster1999_fig1",
    quantity="ln K by that of Eq. 3 at C/N = 1000, r = .95, .9, .8, .6, .2",
    expected=at_most(0.95),
    why="deviates by more than the 5 % allowed for at r = .99",
)
def already_different(data):
    """Already for r <= .95 the simulations deviate from Eq. 3."""
    return columns([mean_and_error(slope_by_eq_3(of(data, r), r)[:, -1]) for r in RESTITUTIONS[2:]])


@claim(
    "B-3-10",
    figure="cluster1999_fig1",
    quantity="smallest ratio of K at tau = 2 from one r to the next larger",
    expected=at_least(1),
    why="the order alone",
)
def decay_at_first(data):
    """For small times, the smaller r, the stronger is the decay of energy."""
    found = [of(data, r) for r in RESTITUTIONS]
    values = np.stack([interpolated(series(one, "tau"), series(one, "kinetic_energy"), [2.0])[:, 0] for one in found], axis=1)
    return jackknife(lambda v: np.exp(-np.diff(log_mean(v)).max()), values)


@claim(
    "B-3-11",
    figure="cluster1999_fig1",
    quantity="smallest ratio, from one r to the next smaller, of the tau at which K is a quarter above Eq. 1, r = .97 ... .2",
    expected=at_least(1),
    why="the order alone; r = .99, described well to its end, has no such tau",
)
def earlier_with_dissipation(data):
    """The smaller r, the earlier the deviation from Eq. 1 starts."""
    grids, values = [], []
    for r in RESTITUTIONS[1:]:
        found = of(data, r)
        tau = series(found, "tau")
        grids.append(np.geomspace(1, np.nanmax(tau, axis=1).min() * (1 - 1e-12), 600))
        energy = interpolated(tau, series(found, "kinetic_energy"), grids[-1])
        values.append(np.log(energy / homogeneous_cooling(grids[-1], r)))

    def smallest_ratio(v):
        places = [onset(tau, above, BEGINNING) for tau, above in zip(grids, v.mean(axis=0), strict=True)]
        return np.divide(places[:-1], places[1:]).min()

    return jackknife(smallest_ratio, np.stack(values, axis=1))


@claim(
    "B-3-12",
    figure="cluster1999_fig1",
    quantity="d ln K / d ln t over the last decade of time that all runs have, r = .6 and .2 by r = .97",
    expected=at_most(1),
    why="the order alone",
)
def slower_in_the_end(data):
    """The system dissipates energy slower for small r and rather large times."""
    found = [of(data, r) for r in (0.97, 0.6, 0.2)]
    end = last_common(found) * (1 - 1e-12)
    slopes = [np.diff(np.log(at_times(one, "kinetic_energy", [end / 10, end])), axis=1)[:, 0] for one in found]
    return jackknife(lambda v: v.mean(axis=0)[1:] / v.mean(axis=0)[0], np.stack(slopes, axis=1))


@claim(
    "B-3-13",
    figure="cluster1999_fig1",
    quantity="standard deviation of ln K at 10 s over the runs, r = .8, .6, .2",
    expected=at_least(np.log(1.25)),
    why="a quarter is what one just sees on the paper's axes",
)
def large_fluctuations(data):
    """The fluctuations from one simulation to the other are quite large."""
    found = [of(data, r) for r in (0.8, 0.6, 0.2)]
    at_least_runs(found[0])
    values = np.concatenate([np.log(at_times(one, "kinetic_energy", [10.0])) for one in found], axis=1)
    return jackknife(lambda v: v.std(axis=0, ddof=1), values)


@claim(
    "B-3-14",
    quantity="standard deviation of ln K at 10 s over the runs, r = .8, N = 784 by N = 79524",
    expected=at_least(2),
    why="1/sqrt(N) would give 10; 2 is beyond the scatter of a deviation from a few runs",
)
def smaller_in_large_systems(data):
    """That is due to the small systems: in larger ones the variations become less important."""
    big = runs(data, "cluster1999_large", n_particles=79524, restitution=0.8).sel(time=10, method="nearest")
    few = of(data, 0.8)
    at_least_runs(few)
    at_least_runs(big)
    values = np.log(at_times(few, "kinetic_energy", [float(big["time"])])[:, 0])
    return jackknife(lambda v, w: v.std(ddof=1) / w.std(ddof=1), values, np.log(big["kinetic_energy"].values))


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


def elastic_share(found, first=0.0):
    """c_e of the collisions after C/N = first, of each realization."""
    begin = int(np.argmin(np.abs(collisions(found) - first))) if first else None
    sums = [series(found, name) for name in ("elastic_collisions_per_particle", "collisions_per_particle")]
    elastic, every = (s[:, -1] - (0 if begin is None else s[:, begin]) for s in sums)
    return elastic / every


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
    "B-3-19",
    figure="cluster1999_fig1",
    quantity="c_e from C/N = 500 to 1000 at t_c = 1e-5 s, r = .95, .9, .8 > r_c",
    expected=at_most(5e-3),
    why="2 t_c/t_E(0): no more than in the homogeneous gas at its hottest",
)
def no_collapse_above(data):
    """In the intermediate regime, r > r_c, density variations do not in general lead to a divergence."""
    return columns([mean_and_error(elastic_share(of(data, r), 500)) for r in RESTITUTIONS[2:5]])


@claim(
    "B-3-20",
    figure="cluster1999_fig1",
    quantity="largest factor between K and Eq. 1 over the whole run, r = .95, .9, .8 > r_c",
    expected=at_most(1, absolute=SYMBOL),
    why="a symbol's height, as for r = .99",
    remark="The paper itself says that r <= .95 deviates (B-3-06) and speaks of an intermediate regime in the same "
    "sentence: Eq. 5 tells where collapse begins, not where clusters do.",
)
def homogeneous_above(data):
    """For r > r_c the system remains in the homogeneous cooling state."""
    found = [jackknife(lambda v: np.exp(np.abs(v.mean(axis=0)).max()), above_eq_1(of(data, r), r)) for r in RESTITUTIONS[2:5]]
    return columns(found)


def jumps(found):
    """How many times faster than on average until then C/N grows between two samples, and changes of C/N, C_e/N and ln K.

    Four of (realization, interval), from C/N = COUNTED on.
    """
    shown = found.isel(time=slice(int((collisions(found) >= COUNTED).argmax()), None))
    time, count = series(shown, "sampling_time"), series(shown, "collisions_per_particle")
    change = np.diff(count, axis=1)
    faster = change / np.diff(time, axis=1) / (count / time)[:, :-1]
    elastic = np.diff(series(shown, "elastic_collisions_per_particle"), axis=1)
    return faster, change, elastic, np.diff(np.log(series(shown, "kinetic_energy")), axis=1)


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
    return columns(found)


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

    return columns([jackknife(lambda v, r=r: loss(v, r), fastest(data, r)) for r in (0.6, 0.2)])


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

    return columns([jackknife(ratio, fastest(data, r)) for r in (0.6, 0.2)])


@claim(
    "B-3-25",
    figure="cluster1999_fig1",
    quantity="least and largest (Kx - Kz)/K of all samples, and the largest |Kx + Kz - K|/K",
    expected=between([-1, -1, 0], [1, 1, 1e-9]),
    why="an identity, as energies are positive; the last is rounding",
)
def two_contributions(data):
    """K = Kx + Kz, and (Kx - Kz)/K lies always between -1 and 1."""
    found = [of(data, r) for r in RESTITUTIONS]
    values = np.concatenate([anisotropy(one) for one in found])
    sums = [one["kinetic_energy_x"] + one["kinetic_energy_y"] - one["kinetic_energy"] for one in found]
    rest = max(float(np.abs(s / one["kinetic_energy"]).max()) for s, one in zip(sums, found, strict=True))
    return [values.min(), values.max(), rest]


@claim(
    "B-3-26",
    figure="cluster1999_fig1",
    quantity="rms of (Kx - Kz)/K of all runs and r where K is more than twice Eq. 3, by that where it is within a quarter "
    "of it",
    expected=at_least(3),
    why="anisotropy beyond the noise of 784 disks: three times it at least",
)
def deviation_and_anisotropy(data):
    """A deviation from homogeneous cooling is correlated to non-zero values of (Kx - Kz)/K."""
    sums = []
    for r in RESTITUTIONS:
        one = of(data, r)
        square, above = anisotropy(one) ** 2, above_eq_3(one, r)
        for there in (above > np.log(2), np.abs(above) < BEGINNING):
            sums += [(square * there).sum(axis=1), there.sum(axis=1)]

    def ratio(v):
        total = v.sum(axis=0).reshape(len(RESTITUTIONS), 2, 2).sum(axis=0)
        return np.sqrt((total[0, 0] / total[0, 1]) / (total[1, 0] / total[1, 1]))

    return jackknife(ratio, np.stack(sums, axis=1))


@claim(
    "B-3-27",
    figure="cluster1999_fig1",
    quantity="smallest ratio, from one r to the next smaller, of the C/N at which the rms of (Kx - Kz)/K is above .2 (or of "
    "the last)",
    expected=at_least(1),
    why="the order alone; .2 is more than five times the noise of 784 disks",
    remark="From r = .97 to .8 it is so. At r = .6 the shear mode is as early as at .8, and at r = .2 it comes at the same "
    "time t, but by then the particles, in clusters, have collided three times as often.",
)
def anisotropic_earlier(data):
    """The lower r is, the earlier the deviations in Fig. 1(d) begin."""
    found = [of(data, r) for r in RESTITUTIONS]

    def smallest_ratio(v):
        rms = np.sqrt((v**2).mean(axis=0))
        places = [onset(collisions(one), line, ANISOTROPIC) for one, line in zip(found, rms, strict=True)]
        return np.divide(places[:-1], places[1:]).min()

    return jackknife(smallest_ratio, np.stack([anisotropy(one) for one in found], axis=1))


def for_all_times(data, name, contact_times=CONTACT_TIMES):
    """A quantity of (realization, contact time, sample), and C/N of the samples."""
    found = [of_time(data, t_c) for t_c in contact_times]
    return np.stack([series(one, name) for one in found], axis=1), collisions(found[0])


def anisotropies(data):
    """(Kx - Kz)/K at C/N = 1000 of (realization, contact time)."""
    return np.stack([anisotropy(of_time(data, t_c))[:, -1] for t_c in CONTACT_TIMES], axis=1)


def widest(data, contact_times):
    """The largest factors between K, and between t, of two of these contact times for C/N = 1 ... 10."""
    found = []
    for name in ("kinetic_energy", "sampling_time"):
        values, count = for_all_times(data, name, contact_times)
        shown = (count >= 1) & (count <= 10)
        found.append(jackknife(lambda v: np.exp(np.ptp(log_mean(v), axis=0).max()), values[:, :, shown]))
    return columns(found)


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
    times = np.geomspace(1, last_common(found) * (1 - 1e-12), 40)
    values = np.stack([at_times(one, "kinetic_energy", times) for one in found], axis=1)

    def apart(v):
        logs = log_mean(v)
        return max(np.sqrt(((logs[a] - logs[b]) ** 2).mean()) for a, b in ((0, 1), (0, 2), (1, 2)))

    return jackknife(apart, values)


@claim(
    "B-3-31",
    figure="cluster1999_fig2",
    quantity="C/N at which the rms of (Kx - Kz)/K over the runs is above .2, t_c <= 1e-5 s",
    expected=between(20, 80),
    why="40 is read off a logarithmic axis: within a factor 2; .2 is more than five times the noise of 784 disks",
)
def shear_mode(data):
    """For C/N > 40 a shear mode builds up."""
    found = [of_time(data, t_c) for t_c in CONTACT_TIMES[1:]]
    count = collisions(found[0])
    values = np.stack([anisotropy(one) for one in found], axis=1)
    return jackknife(lambda v: onset(count, np.sqrt((v**2).mean(axis=(0, 1))), ANISOTROPIC), values)


@claim(
    "B-3-32",
    figure="cluster1999_fig2",
    quantity="share of the start states for which (Kx - Kz)/K at C/N = 1000 has both signs among the five t_c",
    expected=at_least(0.5),
    why="five random signs differ in 94 of 100 cases, signs that the start state decides in none",
)
def orientation_depends_on_tc(data):
    """The orientation of the shear mode depends strongly on t_c, even with identical initial conditions."""
    signs = np.sign(anisotropies(data))
    return mean_and_error((signs.min(axis=1) != signs.max(axis=1)).astype(float))


@claim(
    "B-3-33",
    figure="cluster1999_fig2",
    quantity="rms difference of (Kx - Kz)/K at C/N = 1000 between two t_c of one start state, by that between two start states",
    expected=value(1, absolute=0.25),
    why="1 if another t_c is as good as another start state, 0 if it changes nothing; a quarter of the way is near",
)
def tiny_changes(data):
    """Tiny changes lead to rather random situations from one realization to the next."""
    values = anisotropies(data)
    if len(values) < 3:
        raise NotMeasured("fewer than 3 runs")

    def ratio(v):  # variances within and between are half the mean squares of the differences
        return np.sqrt(v.var(axis=1, ddof=1).mean() / v.var(axis=0, ddof=1).mean())

    return jackknife(ratio, values)


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
    for name in ("kinetic_energy", "sampling_time"):
        values, _ = for_all_times(data, name, (1e-8, 1e-5, 1e-6, 1e-10))
        if len(values) < 3:
            raise NotMeasured("fewer than 3 runs")

        def apart(v):
            return np.abs(v[:, 0].mean() - v[:, 1:].mean()) / np.sqrt(v.var(axis=0, ddof=1).mean())

        found.append(jackknife(apart, np.log(values[:, :, -1])))
    return columns(found)


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
        found.append(mean_and_error(elastic_share(one, 100) / theory))
    return columns(found)


CLAIMS = claims_in(globals())
