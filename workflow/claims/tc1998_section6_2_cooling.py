"""tc1998 section 6.2: nine contact times, N = 5740, r = .4, energy and clusters (Fig. 11, 12)."""

from itertools import combinations

import numpy as np

from granugas.analysis.clusters import find_clusters
from granugas.analysis.comparison import largest_factor, log_mean
from granugas.analysis.statistics import jackknife, mean_and_error
from granugas.analysis.structure import density_field, density_variance
from granugas.analysis.theory import homogeneous_cooling
from granugas.claims import at_least, at_most, between, claim, claims_in, value
from granugas.measured import NotMeasured, common, runs, series, side_by_side

STUDIES = ("tc1998_contact_times", "tc1998_collapse")
EXPERIMENTS = ()

TIMES = (1e-12, 1e-10, 1e-8, 1e-6, 1e-5, 1e-4, 5e-4, 1e-3, 1e-2)
SMALL = TIMES[:6]
"""Contact times below 5e-4 s."""


def of_time(data, contact_time):
    return runs(data, "tc1998_contact_times", n_particles=5740, contact_time=contact_time)


def energies(data, contact_times):
    """tau, and T of (realization, contact time, tau), without t = 0."""
    found = [of_time(data, time).isel(time=slice(1, None)) for time in contact_times]
    values = [series(one["kinetic_energy"]) for one in found]
    return common(found[0]["tau"]), np.stack(values, axis=1)


def evenly(tau, low, high, count=40):
    """Numbers of samples that lie evenly on a logarithmic axis of tau."""
    inside = np.flatnonzero((tau >= low) & (tau <= high))
    return np.unique(inside[np.searchsorted(tau[inside], np.geomspace(tau[inside[0]], tau[inside[-1]], count))])


def snapshot(data, contact_time, realization=0):
    """Positions and velocities of a realization at 5 s, and the box."""
    found = of_time(data, contact_time).isel(realization=realization)
    if 5.0 not in found["snapshot"]:
        raise NotMeasured("no snapshot at 5 s")
    found = found.sel(snapshot=5.0)
    return found["position"].values, found["velocity"].values, [float(found["box_x"]), float(found["box_y"])]


@claim(
    "A-6.2-01",
    figure="tc1998_fig11",
    quantity="tau at t = 5 s",
    expected=value(0.222, rounding=5e-4, relative=0.01, corrected=2220),
    why="1 % for the scatter of the paper's start energy",
    remark="5 s times 444 /s is 2220: a factor 1e4 is lost in the caption of Fig. 11, or in our copy of it.",
)
def end_of_the_runs(data):
    """The snapshots at t = 5 s show tau = .222."""
    return float(of_time(data, 1e-5)["tau"].isel(time=-1).mean())


@claim(
    "A-6.2-02",
    figure="tc1998_fig11",
    quantity="mean speed of the start state in m/s, N = 5740",
    expected=value(0.3615, rounding=5e-5, relative=0.01),
    why="the energy of 5740 random start velocities scatters by .8 %, the speed by .4 %",
)
def initial_speed(data):
    """The initial mean velocity is v_0 = .3615 m/s."""
    found = runs(data, "tc1998_collapse", n_particles=5740, restitution=0.4)
    if 0.0 not in found["snapshot"]:
        raise NotMeasured("no snapshot at t = 0")
    velocity = found["velocity"].sel(snapshot=0.0)
    return mean_and_error(np.sqrt((velocity**2).sum("axis", skipna=False)).mean("particle").values)


@claim(
    "A-6.2-03",
    figure="tc1998_fig12",
    quantity="T at 5 s for t_c = 1e-2 s",
    expected=at_least(0.5),
    why="'almost hindered': most of the energy is left where T of the others falls by four decades or more",
)
def cooling_is_hindered(data):
    """For t_c = 1e-2 s cooling is almost hindered."""
    return mean_and_error(of_time(data, 1e-2)["kinetic_energy"].isel(time=-1).values)


@claim(
    "A-6.2-04",
    figure="tc1998_fig11",
    quantity="variance of the density at 5 s (16 x 16 cells) by that for t_c = 1e-2 s, t_c = 1e-12 ... 1e-3 s",
    expected=at_least(3),
    why="clusters against a fluid without: three times the variance is beyond all scatter of 256 cells",
)
def clusters_for_small_tc(data):
    """For t_c <= 1e-3 s there are density instabilities and clusters."""
    variances = [density_variance(positions, box, 16) for positions, _, box in (snapshot(data, time) for time in TIMES)]
    return np.array(variances[:-1]) / variances[-1]


def likeness(data, *pairs):
    """Correlation of the densities at 5 s, in 16 x 16 cells, of pairs of contact times: means over the runs, and errors."""

    def field(contact_time, realization):
        positions, _, box = snapshot(data, contact_time, realization)
        return density_field(positions, box, 16).ravel()

    number = range(of_time(data, pairs[0][0]).sizes["realization"])
    found = [mean_and_error([np.corrcoef(field(a, k), field(b, k))[0, 1] for k in number]) for a, b in pairs]
    return side_by_side(found)


@claim(
    "A-6.2-05",
    figure="tc1998_fig11",
    quantity="correlation of the densities at 5 s (16 x 16 cells) of t_c = 1e-3 and 1e-5 s, 1e-5 and 1e-8 s",
    expected=at_most(0.8),
    why="pictures whose densities correlate by less than .8 are plainly different",
)
def pictures_differ(data):
    """The snapshots of different t_c differ in details."""
    return likeness(data, (1e-3, 1e-5), (1e-5, 1e-8))


@claim(
    "A-6.2-06",
    figure="tc1998_fig11",
    quantity="correlation of the densities at 5 s (16 x 16 cells) of t_c = 1e-8 and 1e-10 s, 1e-10 and 1e-12 s",
    expected=at_least(0.8),
    why="pictures whose densities correlate by .8 look alike",
)
def very_small_tc_alike(data):
    """Only for very small t_c <= 1e-8 s the simulations lead to almost identical results."""
    return likeness(data, (1e-8, 1e-10), (1e-10, 1e-12))


@claim(
    "A-6.2-07",
    figure="tc1998_fig11",
    quantity="rms velocity inside of the largest cluster (S_c = 1.1) relative to its mean, by that of all, t_c = 1e-5 s at 5 s",
    expected=at_least(0.3),
    why="a block that moves as a whole has 0; independent velocities 1",
)
def liquid_clusters(data):
    """A large cluster is no block but an arrangement like a liquid, with strong shearing inside."""
    positions, velocities, box = snapshot(data, 1e-5)
    labels = find_clusters(positions, box, float(data["tc1998_contact_times"].attrs["diameter"]), [1.1]).labels[0]
    inside = velocities[labels == np.bincount(labels).argmax()]
    return np.sqrt(((inside - inside.mean(axis=0)) ** 2).sum(axis=1).mean() / (velocities**2).sum(axis=1).mean())


def widest(data, contact_times, first, last):
    """The largest factor between T of two of these contact times for tau = first ... last, and its error."""
    tau, values = energies(data, contact_times)
    shown = evenly(tau, first, last)
    return jackknife(lambda v: np.exp(np.ptp(log_mean(v), axis=0).max()), values[:, :, shown])


@claim(
    "A-6.2-08",
    figure="tc1998_fig12",
    quantity="largest factor between T of two t_c below 5e-4 s, for tau = 1 ... 200",
    expected=at_most(1, absolute=0.25),
    why="a quarter is what one just sees on the paper's axes",
)
def same_behaviour(data):
    """All t_c < 5e-4 s lead to the same functional behaviour of T."""
    return widest(data, SMALL, 1, 200)


@claim(
    "A-6.2-09",
    figure="tc1998_fig12",
    quantity="largest factor between T of two t_c below 5e-4 s, for tau = 200 ... 2220",
    expected=between(1.02, 2),
    why="deviations that are there and are small: a factor 2 is a tenth of the inset of the paper",
)
def small_deviations(data):
    """For large tau there are small deviations."""
    return widest(data, SMALL, 200, np.inf)


@claim(
    "A-6.2-10",
    figure="tc1998_fig12",
    quantity="rms of ln T_a/T_b, tau = 1 ... 2220 on a logarithmic axis, largest of the pairs of t_c = 1e-6 ... 1e-12 s",
    expected=at_most(0.1),
    why="10 % is the thickness of a line in the paper's plot",
)
def not_distinguished(data):
    """The data of t_c <= 1e-6 s cannot be distinguished."""
    tau, values = energies(data, TIMES[:4])
    shown = evenly(tau, 1, np.inf)

    def apart(v):
        logs = log_mean(v)
        return max(np.sqrt(((logs[a] - logs[b]) ** 2).mean()) for a, b in combinations(range(len(logs)), 2))

    return jackknife(apart, values[:, :, shown])


@claim(
    "A-6.2-11",
    figure="tc1998_fig12",
    quantity="largest factor between T and Eq. 23 for tau <= 5, t_c <= 1e-4 s",
    expected=at_most(1, absolute=0.1),
    why="10 % is the height of a symbol on six decades of T",
    remark="At r = .4 the energy leaves Eq. 23 gradually from tau of about 1 on; at tau = 5 it is some 15 % above, and t_c = "
    "1e-4 s with c_e = .08 adds a little. The paper's axes hardly show it.",
)
def homogeneous_at_first(data):
    """For tau < 5 the simulations agree with homogeneous cooling."""
    tau, values = energies(data, SMALL)
    early = tau <= 5
    theory = np.log(homogeneous_cooling(tau[early], 0.4))
    return jackknife(lambda v: largest_factor(log_mean(v), theory), values[:, :, early])


@claim(
    "A-6.2-12",
    figure="tc1998_fig12",
    quantity="smallest ratio of T from one t_c to the next larger, t_c = 1e-4, 5e-4, 1e-3, 1e-2 s, at tau = 5, 20, 200, 2220",
    expected=at_least(1),
    why="the order alone",
    remark="So it is at tau = 5 and 20. A larger t_c also delays clusters, in which cooling is slower, so at later times the "
    "curves of 1e-4 ... 1e-3 s come together and cross.",
)
def larger_tc_cool_slower(data):
    """The larger t_c, the slower the cooling."""
    tau, values = energies(data, TIMES[5:])
    places = [int(abs(tau - wanted).argmin()) for wanted in (5, 20, 200, tau[-1])]
    return jackknife(lambda v: np.exp(np.diff(log_mean(v), axis=0).min()), values[:, :, places])


@claim(
    "A-6.2-17",
    figure="tc1998_fig12",
    quantity="rms of ln T(1e-5 s)/T(1e-12 s), tau = 1 ... 2220 on a logarithmic axis",
    expected=at_most(0.2),
    why="'negligible' beside six decades of T",
)
def negligible_effect(data):
    """The effect of t_c is negligible up to about 1e-5 s."""
    tau, values = energies(data, (1e-12, 1e-5))
    shown = evenly(tau, 1, np.inf)
    return jackknife(lambda v: np.sqrt(((np.diff(log_mean(v), axis=0)) ** 2).mean()), values[:, :, shown])


CLAIMS = claims_in(globals())
