"""cluster1999 section 5: number, mean and largest size of clusters; the sentences on them of the abstract and section 6."""

import numpy as np

from granugas.analysis.comparison import interpolated, log_mean, smallest_step
from granugas.analysis.growth import growth_regime, local_exponent
from granugas.analysis.statistics import fit_power_law, jackknife, mean_and_error
from granugas.claims import at_least, at_most, between, claim, claims_in, value
from granugas.measured import NotMeasured, runs

STUDIES = ("cluster1999_large",)
EXPERIMENTS = ()

COUNT, MEAN, LARGEST = "cluster_count", "mean_cluster_size", "largest_cluster_size"
N, END = 79524, 446.6
"""Particles, and the last time of the paper in s."""

PRINTED = (1.05, 1.1, 1.2, 1.3, 1.4)
SMALL = (1.05, 1.1, 1.2)
"""S_c of Fig. 7, and those up to 1.2."""

WINDOW = (1.0, 40.0)
"""The cluster growth regime of the paper, in s."""

OCTAVES = (0.4 * 2.0 ** np.arange(11)).round(1)
"""Times in s at which growth is looked at: .4 to 409.6; a factor of two is far beyond the fluctuations of one second."""


def curves(data, name, factors):
    """t without 0, and a quantity of clusters of (realization, S_c, time)."""
    found = runs(data, "cluster1999_large", n_particles=N, restitution=0.8, contact_time=1e-5).isel(time=slice(1, None))
    if name not in found:
        raise NotMeasured("no clusters")
    missing = set(factors) - set(found["distance_factor"].values)
    if missing:
        raise NotMeasured(f"no clusters for S_c = {', '.join(map(str, sorted(missing)))}")
    if found["time"].values[-1] < END * (1 - 1e-9):
        raise NotMeasured(f"the runs end before {END:g} s")
    values = found[name].sel(distance_factor=list(factors)).transpose("realization", "distance_factor", "time").values
    return found["time"].values, values


def sizes(data, name, factors, times):
    """A quantity of clusters at some times: (realization, S_c, times)."""
    t, values = curves(data, name, factors)
    return np.stack([interpolated(np.broadcast_to(t, one.shape), one, times) for one in values.swapaxes(0, 1)], axis=1)


def exponents(data, name, factors, window=WINDOW):
    """Powers of t in a window: (realization, S_c)."""
    t, values = curves(data, name, factors)
    return np.stack([fit_power_law(t, one, window).exponents for one in values.swapaxes(0, 1)], axis=1)


def regime(data, statistic):
    """A statistic of beginning and end of the growth of <M> in s, S_c = 1.1; infinite where the runs do not reach the end."""
    t, values = curves(data, MEAN, (1.1,))
    found, error = jackknife(lambda v: statistic(*growth_regime(t, v.mean(axis=0))), local_exponent(t, values[:, 0]))
    return np.where(np.isnan(found), np.inf, found), error


@claim(
    "B-0-02",
    figure="cluster1999_fig7",
    quantity="M_max/N at .1 s, S_c = 1.05, 1.1, 1.2",
    expected=at_most(1e-3),
    why="'tiny': one in a thousand of the particles",
)
def tiny(data):
    """In the homogeneous cooling state clusters are tiny."""
    return mean_and_error(sizes(data, LARGEST, SMALL, [0.1])[..., 0] / N)


@claim(
    "B-0-03",
    figure="cluster1999_fig7",
    quantity="power of t of <M> up to .1 s, S_c = 1.05 ... 1.4",
    expected=at_most(0.03),
    why="'very slowly': a tenth of the .3 of the growth regime",
)
def slowly(data):
    """In the homogeneous cooling state clusters grow very slowly."""
    t, _ = curves(data, MEAN, PRINTED)
    return mean_and_error(exponents(data, MEAN, PRINTED, (t[0], 0.1)))


@claim(
    "B-0-04",
    figure="cluster1999_fig7",
    quantity="M_max/N at 446.6 s, S_c = 1.05, 1.1, 1.2",
    expected=at_least(0.5),
    why="'most' is more than half",
    remark="In some runs two large clusters touch at this instant for S_c = 1.2 and not for 1.05; the print has one run.",
)
def one_huge_cluster(data):
    """In the third regime most particles are collected in one huge cluster."""
    return mean_and_error(sizes(data, LARGEST, SMALL, [END])[..., 0] / N)


@claim(
    "B-5-01",
    figure="cluster1999_fig7",
    quantity="largest growth of I_c from one octave of t to the next, .4 to 409.6 s, S_c = 1.05 ... 1.4",
    expected=at_most(1, absolute=0.02),
    why="'decreases'; 2 % for the fluctuations of some ten thousand clusters, single particles among them",
)
def fewer_clusters(data):
    """The number of clusters decreases with time, for every S_c."""
    return jackknife(
        lambda v: np.exp(np.diff(log_mean(v), axis=-1).max()),
        sizes(data, COUNT, PRINTED, OCTAVES),
    )


@claim(
    "B-5-02",
    figure="cluster1999_fig7",
    quantity="least growth of <M> from one octave of t to the next, .4 to 409.6 s, S_c = 1.05 ... 1.4",
    expected=at_least(1, absolute=0.02),
    why="as for I_c (B-5-01), of which it is the inverse",
)
def larger_clusters(data):
    """The mean cluster size grows correspondingly, for every S_c."""
    return jackknife(
        lambda v: np.exp(smallest_step(log_mean(v))),
        sizes(data, MEAN, PRINTED, OCTAVES),
    )


@claim(
    "B-5-03",
    figure="cluster1999_fig7",
    quantity="least growth of M_max from one octave of t to the next, .4 to 409.6 s, S_c = 1.05 ... 1.4",
    expected=at_least(1, absolute=0.2),
    why="'grows'; a fifth for one cluster out of thousands, which may break into pieces (section 4)",
    remark="The largest cluster can break into pieces (section 4) and does so now and then late in a run.",
)
def largest_grows(data):
    """The largest cluster also grows in size during the simulation, for every S_c."""
    return jackknife(
        lambda v: np.exp(smallest_step(log_mean(v))),
        sizes(data, LARGEST, PRINTED, OCTAVES),
    )


@claim(
    "B-5-04",
    figure="cluster1999_growth",
    quantity="least power of t from 1 to 40 s of <M>, and of M_max, S_c = 1.05 ... 1.4",
    expected=at_least(0.1),
    why="growth that is seen: a third of .3",
)
def alike_for_every_factor(data):
    """The qualitative behaviour is independent of S_c."""
    values = np.stack([exponents(data, name, PRINTED) for name in (MEAN, LARGEST)], axis=1)
    return jackknife(lambda v: v.mean(axis=0).min(axis=-1), values)


@claim(
    "B-5-05",
    figure="cluster1999_fig7",
    quantity="<M>(1 s) by <M> at the first sample, S_c = 1.05 ... 1.4",
    expected=at_most(1.25),
    why="'very weak': a quarter is what one just sees on the axis of Fig. 7b",
)
def weak_change_of_the_mean(data):
    """For t < 1 s the change of I_c and <M> with time is very weak."""
    t, _ = curves(data, MEAN, PRINTED)
    found = sizes(data, MEAN, PRINTED, [t[0], 1])
    return mean_and_error(found[..., 1] / found[..., 0])


@claim(
    "B-5-06",
    figure="cluster1999_fig7",
    quantity="M_max(1 s) by M_max at the first sample, S_c = 1.05, 1.1, 1.2",
    expected=at_most(2),
    why="'very weak' on an axis of five decades: less than a factor of two",
    remark="One cluster out of thousands: it grows tenfold while the mean hardly changes, and thousandfold afterwards.",
)
def weak_change_of_the_largest(data):
    """For t < 1 s the change of M_max with time is very weak."""
    t, _ = curves(data, LARGEST, SMALL)
    return jackknife(lambda v: np.exp(np.diff(log_mean(v))[:, 0]), sizes(data, LARGEST, SMALL, [t[0], 1]))


@claim(
    "B-5-07",
    figure="cluster1999_growth",
    quantity="t at which d ln<M>/d ln t rises to half of its maximum, S_c = 1.1, in s",
    expected=between(0.5, 2),
    why="'t < 1 s', one figure: within a factor of two; half of the maximum is our criterion",
)
def growth_begins(data):
    """The growth regime begins at 1 s."""
    return regime(data, lambda begin, end: begin)


@claim(
    "B-5-08",
    figure="cluster1999_growth",
    quantity="t at which d ln<M>/d ln t falls to half of its maximum, S_c = 1.1, in s",
    expected=between(20, 80),
    why="'until about 40 s': within a factor of two; half of the maximum is our criterion",
    remark="The single run of the print bends. The mean of several slows down from a local exponent of .31 at 5 s to .19 after "
    "80 s, which is not half of it, and does not stop: the clusters of some runs meet later than those of others.",
)
def growth_ends(data):
    """The growth regime lasts until about 40 s."""
    return regime(data, lambda begin, end: end)


@claim(
    "B-5-09",
    figure="cluster1999_fig7",
    quantity="power of t from 100 to 446.6 s by that from 1 to 40 s, of <M> and M_max, S_c = 1.1",
    expected=at_most(0.5),
    why="'again varying slowly': at most half of the power of the growth regime",
    remark="M_max varies slowly. <M> pauses from 100 to 200 s, with a local exponent of about .1, and grows again at the end.",
)
def slow_again(data):
    """At very long times I_c, <M> and M_max are again varying slowly."""
    values = np.stack(
        [[exponents(data, name, (1.1,), window)[:, 0] for window in ((100, END), WINDOW)] for name in (MEAN, LARGEST)]
    )
    return jackknife(lambda v: v.mean(axis=0)[:, 0] / v.mean(axis=0)[:, 1], values.transpose(2, 0, 1))


@claim(
    "B-5-10",
    figure="cluster1999_fig7",
    quantity="<M>(S_c = 1.4) by <M>(S_c = 1.05) at 40.96 s",
    expected=at_least(2),
    why="'strongly': at least a factor of two",
)
def strong_dependence(data):
    """Quantitatively the behaviour depends strongly on S_c."""
    found = sizes(data, MEAN, (1.05, 1.4), [40.96])[..., 0]
    return mean_and_error(found[:, 1] / found[:, 0])


@claim(
    "B-5-11",
    figure="cluster1999_fig7",
    quantity="least ratio of <M> from one S_c to the next larger, at all times",
    expected=at_least(1),
    why="sure by definition: every contact for one S_c is one for a larger S_c",
)
def larger_with_the_factor(data):
    """The larger S_c, the larger are the clusters."""
    _, values = curves(data, MEAN, PRINTED)
    return float((values[:, 1:] / values[:, :-1]).min())


@claim(
    "B-5-12",
    figure="cluster1999_fig7",
    quantity="M_max(S_c = 1.2) by M_max(S_c = 1.05) at 446.6 s",
    expected=at_most(1, absolute=0.25),
    why="'rather independent': lines of Fig. 7c that nearly touch",
    remark="In some runs two large clusters touch at this instant for S_c = 1.2 and not for 1.05; the print has one run.",
)
def largest_independent(data):
    """The largest size becomes rather independent of S_c at late times, for S_c <= 1.2."""
    return jackknife(lambda v: np.exp(np.diff(log_mean(v)))[0], sizes(data, LARGEST, (1.05, 1.2), [END])[..., 0])


@claim(
    "B-5-13",
    figure="cluster1999_fig7",
    quantity="M_max(S_c = 1.2) by M_max(S_c = 1.05) at 5.12 s",
    expected=at_least(1.5),
    why="'only at large times': earlier it is more than what 'rather independent' allows (B-5-12)",
)
def largest_dependent_before(data):
    """Only at late times it does."""
    return jackknife(lambda v: np.exp(np.diff(log_mean(v)))[0], sizes(data, LARGEST, (1.05, 1.2), [5.12])[..., 0])


@claim(
    "B-5-14",
    figure="cluster1999_fig7",
    quantity="M_max at 446.6 s by M_max at 163.84 s, S_c = 1.05, 1.1, 1.2",
    expected=at_least(1),
    why="the order alone",
    remark="The largest cluster can break into pieces (section 4) and does so now and then late in a run.",
)
def grows_on_and_on(data):
    """Particles that hit the largest cluster are absorbed, so that it grows on and on."""
    return jackknife(lambda v: np.exp(np.diff(log_mean(v))[:, 0]), sizes(data, LARGEST, SMALL, [163.84, END]))


@claim(
    "B-5-15",
    figure="cluster1999_growth",
    quantity="power of t of <M> from 1 to 40 s, S_c = 1.1",
    expected=value(0.3, rounding=0.05),
    why="one figure in print",
)
def exponent_of_the_mean(data):
    """<M> grows as t^.3."""
    return mean_and_error(exponents(data, MEAN, (1.1,))[:, 0])


@claim(
    "B-5-16",
    figure="cluster1999_growth",
    quantity="power of t of <M> from 1 to 40 s, S_c = 1.05, 1.2, 1.3, 1.4",
    expected=value([0.3] * 4, rounding=0.05),
    why="the lines of Fig. 7 and the one number that they yield are for all S_c",
    remark="The power depends on S_c: largest at 1.2, smaller where most particles are single (1.05) or in clusters from the "
    "beginning (1.4).",
)
def exponent_for_every_factor(data):
    """One power of about .3 describes all S_c."""
    return mean_and_error(exponents(data, MEAN, (1.05, 1.2, 1.3, 1.4)))


@claim(
    "B-5-17",
    figure="cluster1999_growth",
    quantity="power of t of I_c from 1 to 40 s, S_c = 1.1",
    expected=value(-0.3, rounding=0.05),
    why="one figure in print",
)
def exponent_of_the_number(data):
    """I_c decreases as t^-.3."""
    return mean_and_error(exponents(data, COUNT, (1.1,))[:, 0])


@claim(
    "B-5-18",
    figure="cluster1999_growth",
    quantity="sum of the powers of I_c and <M>, S_c = 1.05 ... 1.4",
    expected=value(0, absolute=1e-9),
    why="<M> = N/I_c is an identity, so this is no evidence for the growth law; only rounding is left",
)
def opposite_sign(data):
    """I_c and <M> are described by one power with opposite sign."""
    return abs(exponents(data, COUNT, PRINTED) + exponents(data, MEAN, PRINTED)).max()


@claim(
    "B-5-19",
    figure="cluster1999_growth",
    quantity="decades of t between the beginning and the end of the growth of <M>, S_c = 1.1",
    expected=between(1, 1.7),
    why="'a little more than one'; the print's own 1 to 40 s are 1.6",
    remark="The growth lasts longer by our criterion (B-5-08).",
)
def range_of_the_fit(data):
    """The limited system size allows a reasonable fit over a little more than one order of magnitude in time only."""
    return regime(data, lambda begin, end: np.log10(end / begin))


@claim(
    "B-5-20",
    figure="cluster1999_growth",
    quantity="|difference of the powers of <M> from 1 to 6.3 s and from 6.3 to 40 s|, S_c = 1.1",
    expected=at_least(0.05),
    why="a difference that the rounding of .3 would show",
    remark="The halves agree by chance: the local exponent goes up and down between .2 and .35 in this window.",
)
def a_guess(data):
    """The power law is a guess rather than a reliable functional behaviour."""
    halves = [exponents(data, MEAN, (1.1,), window)[:, 0] for window in ((1, 6.3), (6.3, 40))]
    return jackknife(lambda v: abs(np.diff(v.mean(axis=0))[0]), np.transpose(halves))


@claim(
    "B-6-52",
    figure="cluster1999_fig7",
    quantity="M_max/N where the growth of <M> ends, or at 446.6 s, S_c = 1.1",
    expected=at_least(0.1),
    why="'the size of the system': a tenth of its particles in one cluster of a shape that spans it",
)
def not_enough_particles(data):
    """Even about 10^5 particles are not enough: growth ends when clusters reach the size of the system."""
    t, values = curves(data, MEAN, (1.1,))
    _, largest = curves(data, LARGEST, (1.1,))

    def at_the_end(v):
        end = np.nan_to_num(growth_regime(t, v[:, 0].mean(axis=0))[1], nan=END)
        return np.exp(np.interp(np.log(end), np.log(t), v[:, 1].mean(axis=0))) / N

    return jackknife(at_the_end, np.stack([local_exponent(t, values[:, 0]), np.log(largest[:, 0])], axis=1))


CLAIMS = claims_in(globals())
