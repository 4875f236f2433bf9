"""cluster1999 section 4: what the text says of the pictures of the large system, Figs. 4, 5 and 6."""

from itertools import pairwise

import numpy as np

from granugas.analysis.clusters import find_clusters
from granugas.analysis.inequality import share_of_largest
from granugas.analysis.mixing import differences_nearby, internal_energy_share
from granugas.analysis.statistics import mean_and_error
from granugas.analysis.structure import density_at, density_field, density_variance
from granugas.claims import at_least, claim, claims_in
from granugas.measured import NotMeasured, runs
from granugas.plotting.snapshots import relative_energy

STUDIES = ("cluster1999_large",)
EXPERIMENTS = ()

TIMES = (0.64, 2.56, 40.96, 446.6)
"""Of the snapshots in print, in s."""

LATE = TIMES[2:]
CONTACT = 1.1
"""S_c of the clusters here, in the middle of what the paper calls reasonable."""

COARSE, FINE = 50, 100
"""Cells along a side: of 10 and of 5 diameters, with 32 and 8 particles on average."""


def shots(data, time):
    """The snapshot of each realization at this time, all particles in memory only where they are used."""
    found = runs(data, "cluster1999_large", n_particles=79524, restitution=0.8, contact_time=1e-5)
    there = np.flatnonzero(np.isclose(found["snapshot"], time))
    if not there.size or not found.sizes["realization"]:
        raise NotMeasured(f"no snapshot at {time:g} s")
    return [found.isel(snapshot=there[0], realization=k) for k in range(found.sizes["realization"])]


def measured(data, times, quantity):
    """Mean and standard error over realizations of a number of a snapshot, at each of the times."""
    rows = [[quantity(shot) for shot in shots(data, time)] for time in times]
    return mean_and_error(np.transpose(rows))


def box(shot):
    return float(shot["box_x"]), float(shot["box_y"])


def places(shot):
    return shot["position"].values, box(shot)


def clusters(shot):
    """Label of the cluster of each particle, and sizes."""
    found = find_clusters(*places(shot), float(shot["diameter"]), [CONTACT])
    return found.labels[0], found.sizes[0]


def largest(shot):
    """Which particles are in the largest cluster."""
    labels, sizes = clusters(shot)
    return labels == sizes.argmax()


def origins(shot):
    """Mean and largest difference of the initial height to others in the same cell, by the height of the box."""
    height = box(shot)[1]
    return differences_nearby(shot["initial_y"].values, height, *places(shot), FINE) / height


def in_contact(shot):
    """Which particles Fig. 5 shows red: the time between their last two collisions is below t_c."""
    red = shot["last_collision_interval"].values < float(shot["contact_time"])
    if not red.any():
        raise NotMeasured("no particle with a time between collisions below t_c")
    return red


@claim(
    "B-4-31",
    figure="cluster1999_fig4",
    quantity="smallest ratio of the density's variance in cells of 10 d, from one of .64, 2.56, 40.96, 446.6 s to the next",
    expected=at_least(1),
    why="the order alone",
)
def density_varies_more(data):
    """Density variations increase with time."""
    variance = [[density_variance(*places(shot), COARSE) for shot in shots(data, time)] for time in TIMES]
    ratios, errors = mean_and_error([[b / a for a, b in pairwise(run)] for run in np.transpose(variance)])
    return ratios.min(), errors[ratios.argmin()]


@claim(
    "B-4-32",
    figure="cluster1999_fig4",
    quantity="share of the rows of 10 d, or columns if they are more, that the largest cluster (S_c = 1.1) reaches, 446.6 s",
    expected=at_least(0.5),
    why="half the box is of the order of its size",
)
def as_large_as_the_box(data):
    """At long times the size of the largest cluster is of the order of the system size."""

    def reach(shot):
        position, sides = places(shot)
        cells = np.floor(position[largest(shot)] / np.array(sides) * COARSE).astype(int) % COARSE
        return max(len(np.unique(along)) for along in cells.T) / COARSE

    (mean,), (error,) = measured(data, TIMES[-1:], reach)
    return mean, error


@claim(
    "B-4-33",
    figure="cluster1999_fig4",
    quantity="share of the box, in cells of 10 d, with less than a tenth of the mean density at 446.6 s",
    expected=at_least(0.1),
    why="a tenth of the area is a region that one sees; at random a cell has 32 +- 6 particles and none is as empty",
)
def dilute_regions(data):
    """With the clusters, dilute regions build up."""
    (mean,), (error,) = measured(data, TIMES[-1:], lambda shot: np.mean(density_field(*places(shot), COARSE) < 0.1))
    return mean, error


@claim(
    "B-4-34",
    figure="cluster1999_fig4",
    quantity="ratio of the 90 % and the 10 % quantile of the energy within the largest cluster (S_c = 1.1), 40.96 and 446.6 s",
    expected=at_least([2, 2]),
    why="a factor 2 is one step of the colours; a cluster that moves as one has 1",
)
def colours_within_a_cluster(data):
    """There are different colours inside a cluster."""

    def spread(shot):
        low, high = np.quantile(relative_energy(shot["velocity"].values)[largest(shot)], (0.1, 0.9))
        return high / low

    return measured(data, LATE, spread)


@claim(
    "B-4-35",
    figure="cluster1999_fig4",
    quantity="share of the energy of the largest cluster (S_c = 1.1) that no motion of a solid body has, 40.96 and 446.6 s",
    expected=at_least([0.1, 0.1]),
    why="a tenth of the energy is no noise: there are thousands of particles in it",
)
def internal_motion(data):
    """A cluster does not behave like a solid body, but has internal motion."""

    def inside(shot):
        members = largest(shot)
        return internal_energy_share(shot["velocity"].values[members], shot["position"].values[members], box(shot))

    return measured(data, LATE, inside)


@claim(
    "B-4-36",
    figure="cluster1999_fig4",
    quantity="share of the second largest part, at 446.6 s, of a cluster of 40.96 s (S_c = 1.1), the most of the ten largest",
    expected=at_least(0.1),
    why="a tenth of a cluster is a piece and not a loss of single particles",
)
def breaks_into_pieces(data):
    """A cluster can break into pieces after some time."""
    found = []
    for early, late in zip(shots(data, TIMES[2]), shots(data, TIMES[3]), strict=True):
        labels, sizes = clusters(early)
        later, _ = clusters(late)
        parts = [np.sort(np.bincount(later[labels == one])) for one in np.argsort(sizes)[-10:]]
        found.append(max(part[-2] / part.sum() if len(part) > 1 else 0.0 for part in parts))
    return mean_and_error(found)


@claim(
    "B-4-37",
    figure="cluster1999_fig5",
    quantity="share of the particles with a time between collisions below t_c that are among the half with the larger "
    "density around them (cells of 5 d), 446.6 s",
    expected=at_least(0.75),
    why="'mainly': three of four; one half if they were anywhere",
)
def contacts_in_clusters(data):
    """Particles with a time between collisions below t_c are mainly in the centres of the clusters."""

    def dense(shot):
        density = density_at(*places(shot), FINE)
        return np.mean(density[in_contact(shot)] > np.median(density))

    (mean,), (error,) = measured(data, TIMES[-1:], dense)
    return mean, error


@claim(
    "B-4-38",
    figure="cluster1999_cost",
    quantity="share of the collisions of the tenth of the particles with the largest collision frequencies, 446.6 s",
    expected=at_least(0.5),
    why="'the major part' is more than half; a tenth is few",
)
def costly_particles(data):
    """Few particles, those with the largest collision frequencies, require the major part of the resources."""
    (mean,), (error,) = measured(data, TIMES[-1:], lambda shot: share_of_largest(shot["collision_frequency"].values, 0.1))
    return mean, error


@claim(
    "B-4-39",
    figure="cluster1999_fig5",
    quantity="share of the collisions in the tenth of the box with most of them, cells of 10 d, 446.6 s",
    expected=at_least(0.5),
    why="as for the particles: more than half, in a region of a tenth",
)
def costly_regions(data):
    """The regions with the largest collision frequencies require the major part of the computational resources."""

    def of_the_tenth(shot):
        column, row = (np.floor(shot["position"].values / np.array(box(shot)) * COARSE).astype(int) % COARSE).T
        counts = np.bincount(column * COARSE + row, shot["collision_frequency"].values, COARSE**2)
        return share_of_largest(counts, 0.1)

    (mean,), (error,) = measured(data, TIMES[-1:], of_the_tenth)
    return mean, error


@claim(
    "B-4-40",
    figure="cluster1999_fig6",
    quantity="particles of the lowest tenth of the box that began in the upper half, 40.96 s, as a share",
    expected=at_least(0.01),
    why="one in a hundred is 80 dots in the picture of that stripe, which one sees",
)
def across_the_boundary(data):
    """At the lower and upper boundary, particles of the other side penetrate because the box is periodic."""

    def others(shot):
        height = box(shot)[1]
        low = shot["position"].sel(axis="y").values < 0.1 * height
        return np.mean(shot["initial_y"].values[low] > 0.5 * height)

    (mean,), (error,) = measured(data, LATE[:1], others)
    return mean, error


@claim(
    "B-4-41",
    figure="cluster1999_fig6",
    quantity="share of the particles in the middle tenth of the box that began in its lowest or highest tenth, 446.6 s",
    expected=at_least(0.02),
    why="one in fifty is what one sees; .2 if all were mixed, 0 at the beginning",
)
def at_the_centre(data):
    """At sufficiently large times red and blue particles have travelled to the centre of the system."""

    def strangers(shot):
        height = box(shot)[1]
        middle = abs(shot["position"].sel(axis="y").values / height - 0.5) < 0.05
        return np.mean(abs(shot["initial_y"].values[middle] / height - 0.5) > 0.4)

    (mean,), (error,) = measured(data, TIMES[-1:], strangers)
    return mean, error


@claim(
    "B-4-42",
    figure="cluster1999_fig6",
    quantity="smallest ratio of the mean difference of initial heights within 5 d, from one time of the print to the next",
    expected=at_least(1),
    why="the order alone",
)
def mixing_grows(data):
    """Particles of different origin come closer together as time goes on."""
    rows = [[np.nanmean(origins(shot)[0]) for shot in shots(data, time)] for time in TIMES]
    ratios, errors = mean_and_error([[b / a for a, b in pairwise(run)] for run in np.transpose(rows)])
    return ratios.min(), errors[ratios.argmin()]


@claim(
    "B-4-43",
    figure="cluster1999_fig6",
    quantity="share of the particles with one in their cell of 5 d that began more than a quarter of the box away, 446.6 s",
    expected=at_least(0.5),
    why="'at any point in the system': for most particles, by a distance that the colours show",
)
def origins_nearby(data):
    """At the final stage, particles of different origin can be very close together at any point in the system."""
    (mean,), (error,) = measured(data, TIMES[-1:], lambda shot: np.mean(np.nan_to_num(origins(shot)[1]) > 0.25))
    return mean, error


CLAIMS = claims_in(globals())
