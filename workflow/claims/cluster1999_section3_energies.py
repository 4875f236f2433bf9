"""cluster1999 section 3: small systems, N = 784, seven coefficients of restitution, the energy (Fig. 1)."""

import numpy as np

from granugas.analysis.comparison import interpolated, log_mean, onset
from granugas.analysis.statistics import jackknife, mean_and_error
from granugas.analysis.theory import energy_after_collisions, homogeneous_cooling
from granugas.claims import at_least, at_most, claim, claims_in, value
from granugas.measured import at_times, common, enough_runs, last_common, nearest, runs, series, side_by_side

STUDIES = ("cluster1999_restitutions", "cluster1999_large")
EXPERIMENTS = ()

RESTITUTIONS = (0.99, 0.97, 0.95, 0.9, 0.8, 0.6, 0.2)

SYMBOL = 1.0
"""A factor 2 is the height of a symbol on axes that show K over ten decades: agreement as far as the paper's figures tell."""

BEGINNING = np.log(1.25)
"""Of a deviation: a quarter."""


def of(data, restitution):
    return runs(data, "cluster1999_restitutions", n_particles=784, restitution=restitution).isel(time=slice(1, None))


def above_eq_1(found, restitution):
    """ln of K by Eq. 1 at the same time, (realization, sample)."""
    return np.log(series(found["kinetic_energy"]) / homogeneous_cooling(series(found["tau"]), restitution))


def farthest_from_eq_1(data, restitution):
    """The largest factor between K and Eq. 1 over the whole run, and its error."""
    return jackknife(lambda v: np.exp(np.abs(v.mean(axis=0)).max()), above_eq_1(of(data, restitution), restitution))


def slope_by_eq_3(found, restitution):
    """ln K by that of Eq. 3, (realization, sample)."""
    return np.log(series(found["kinetic_energy"])) / np.log(
        energy_after_collisions(series(found["collisions_per_particle"]), restitution)
    )


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
    early = found.isel(time=nearest(common(found["collisions_per_particle"]), 2))
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
    ends = np.concatenate([series(of(data, r)["collisions_per_particle"])[:, -1] for r in RESTITUTIONS])
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
    return farthest_from_eq_1(data, 0.99)


@claim(
    "B-3-05",
    figure="cluster1999_fig1",
    quantity="largest factor between K and Eq. 1 over the whole run, r = .97",
    expected=at_most(1, absolute=SYMBOL),
    why="a symbol's height",
)
def nearly_elastic_too(data):
    """At r = .97 as well."""
    return farthest_from_eq_1(data, 0.97)


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
    return side_by_side(found)


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
        found.append(mean_and_error(slope_by_eq_3(one, r)[:, nearest(common(one["collisions_per_particle"]), 5)]))
    return side_by_side(found)


@claim(
    "B-3-09",
    figure="cluster1999_fig1",
    quantity="ln K by that of Eq. 3 at C/N = 1000, r = .95, .9, .8, .6, .2",
    expected=at_most(0.95),
    why="deviates by more than the 5 % allowed for at r = .99",
)
def already_different(data):
    """Already for r <= .95 the simulations deviate from Eq. 3."""
    return side_by_side([mean_and_error(slope_by_eq_3(of(data, r), r)[:, -1]) for r in RESTITUTIONS[2:]])


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
    values = np.stack([interpolated(series(one["tau"]), series(one["kinetic_energy"]), [2.0])[:, 0] for one in found], axis=1)
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
        grids.append(np.geomspace(1, last_common([found], "tau"), 600))
        energy = interpolated(series(found["tau"]), series(found["kinetic_energy"]), grids[-1])
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
    end = last_common(found)
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
    enough_runs(found[0])
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
    big = enough_runs(runs(data, "cluster1999_large", n_particles=79524, restitution=0.8)).sel(time=10, method="nearest")
    few = enough_runs(of(data, 0.8))
    values = np.log(at_times(few, "kinetic_energy", [float(big["time"])])[:, 0])
    return jackknife(lambda v, w: v.std(ddof=1) / w.std(ddof=1), values, np.log(big["kinetic_energy"].values))


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
    return side_by_side([farthest_from_eq_1(data, r) for r in RESTITUTIONS[2:5]])


CLAIMS = claims_in(globals())
