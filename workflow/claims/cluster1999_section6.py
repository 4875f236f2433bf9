"""cluster1999 section 6: why distance makes the clusters, what other criteria find, and the outlook. N = 79524."""

import numpy as np

from granugas.analysis.clusters import find_clusters
from granugas.analysis.criteria import busy, cluster_sizes, contacts, measures, near, neighbours, slow
from granugas.analysis.sizes import middle_sizes, octaves, scaling, size_distribution
from granugas.analysis.statistics import fit_power_law, mean_and_error
from granugas.analysis.structure import mean_wavelength, structure_factor
from granugas.claims import at_least, at_most, between, claim, claims_in, value
from granugas.measured import NotMeasured, runs, side_by_side

STUDIES = ("cluster1999_large",)
EXPERIMENTS = ()

N = 79524
REACH = 1.5
"""Of neighbours for the criteria that are not the distance, in d."""
SLOW, BUSY = 0.3, 1.0
"""Their thresholds: relative velocity by the rms velocity, collision frequency by its mean."""
HOT = 10.0
"""Factor to all velocities, for other initial conditions: all rates are as much higher."""


def large(data):
    return runs(data, "cluster1999_large", n_particles=N)


def at_factor(data, name, factor):
    """A cluster observable over (realization, time, ...) at one S_c, without t = 0, and the times."""
    found = large(data)
    if not np.isclose(found["distance_factor"], factor).any():
        raise NotMeasured(f"no S_c = {factor:g}")
    values = found[name].sel(distance_factor=factor, method="nearest").isel(time=slice(1, None))
    return values.transpose("realization", "time", ...).values, values["time"].values


def shots(data, time):
    """Of each realization at a snapshot: positions, velocities, collision frequencies, sides of the box and diameter."""
    found = large(data)
    if not np.isclose(found["snapshot"], time).any():
        raise NotMeasured(f"no snapshot at {time:g} s")
    found = found.sel(snapshot=time, method="nearest")
    for k in range(found.sizes["realization"]):
        shot = found.isel(realization=k)
        arrays = [shot[name].values for name in ("position", "velocity", "collision_frequency")]
        yield *arrays, np.array([shot["box_x"], shot["box_y"]]), float(shot["diameter"])


def by_velocity(bonds, velocity, frequency, hotter=1.0, fixed=None):
    """The bonds slower than SLOW rms velocities (or than `fixed`, in m/s) of velocities times `hotter`."""
    threshold = SLOW * np.sqrt(2 * np.square(hotter * velocity).mean()) if fixed is None else fixed
    return slow(bonds, hotter * velocity, threshold)


def by_frequency(bonds, velocity, frequency, hotter=1.0, fixed=None):
    """The bonds of those that collide more often than the mean (or than `fixed`, in 1/s), all rates times `hotter`."""
    return busy(bonds, hotter * frequency, BUSY * hotter * frequency.mean() if fixed is None else fixed)


def change(kept_by, data, time, fixed=lambda velocity, frequency: None):
    """(realizations,) number of clusters with velocities HOT times as large, by that with those of the run."""
    ratios = []
    for positions, velocity, frequency, box, d in shots(data, time):
        bonds, threshold = neighbours(positions, box, REACH * d), fixed(velocity, frequency)
        kept = [kept_by(bonds, velocity, frequency, hotter, threshold) for hotter in (HOT, 1.0)]
        ratios.append(np.divide(*(len(cluster_sizes(len(positions), one)) for one in kept)))
    return np.array(ratios)


def growth(data, quantity):
    """(realizations, 2) <M> or M_max at 40.96 s by that at 1.28 s: by relative velocity, by collision frequency."""
    sizes = []
    for time in (40.96, 1.28):
        found = []
        for positions, velocity, frequency, box, d in shots(data, time):
            bonds = neighbours(positions, box, REACH * d)
            kept = [kept_by(bonds, velocity, frequency) for kept_by in (by_velocity, by_frequency)]
            found.append([measures(len(positions), one)[quantity] for one in kept])
        sizes.append(np.array(found))
    return sizes[0] / sizes[1]


def triangular(spacing, columns=16, rows=16):
    """Centres of a triangular lattice in its periodic box, and the box."""
    row, column = np.divmod(np.arange(columns * rows), columns)
    unit = spacing * np.array([1, np.sqrt(0.75)])
    return np.column_stack([column + row % 2 / 2, row]) * unit, np.array([columns, rows]) * unit


def face_centred(spacing, cells=5):
    """Centres of a face-centred cubic lattice with this distance of neighbours in its periodic box, and the box."""
    corners = np.stack(np.meshgrid(*[np.arange(cells)] * 3, indexing="ij"), axis=-1).reshape(-1, 1, 3)
    basis = np.array([[0, 0, 0], [0.5, 0.5, 0], [0.5, 0, 0.5], [0, 0.5, 0.5]])
    side = spacing * np.sqrt(2)
    return (corners + basis).reshape(-1, 3) * side, np.full(3, cells * side)


def contacts_in_largest(data, factors):
    """Most frequent number of contacts at each S_c, over the particles of the largest clusters (S_c = 1.1) at 446.6 s."""
    counts = np.zeros((len(factors), 64))
    for positions, _, _, box, d in shots(data, 446.6):
        labels = find_clusters(positions, box, d, [1.1]).labels[0]
        inside = labels == np.bincount(labels).argmax()
        bonds = neighbours(positions, box, max(factors) * d)
        for row, factor in zip(counts, factors, strict=True):
            row += np.bincount(contacts(len(positions), near(bonds, positions, box, factor * d))[inside], minlength=64)
    return counts.argmax(axis=1)


@claim(
    "B-6-01",
    quantity="contacts in a close packing of disks and of spheres, each at S_c = 1.01 and 1.2",
    expected=value([6, 6, 12, 12]),
    why="the numbers of nearest neighbours; the next ones stand at sqrt(3) d and sqrt(2) d",
)
def nearest_neighbours(data):
    """(i) For 1.01 <= S_c <= 1.2 the criterion accounts for nearest neighbours in a close packing."""
    d = float(large(data)["diameter"])
    packings = (triangular(d), face_centred(d))
    return [contacts(len(x), neighbours(x, box, factor * d)).mean() for x, box in packings for factor in (1.01, 1.2)]


@claim(
    "B-6-02",
    quantity="most frequent number of contacts in the largest cluster (of S_c = 1.1) at 446.6 s, S_c = 1.05, 1.1, 1.2",
    expected=value([6, 6, 6]),
    why="inside a close packing each particle has six; fewer at the surface, which is the smaller part",
    remark="The clusters still move inside and are no close packing: within 1.2 d five contacts and six are about equally "
    "frequent, the sixth neighbour of many stands at 1.2 to 1.5 d; within 1.5 d six are the rule, for three in four particles.",
)
def contacts_inside(data):
    """(i) So it does in the clusters of the simulation."""
    return contacts_in_largest(data, (1.05, 1.1, 1.2))


@claim(
    "B-6-03",
    quantity="most frequent number of contacts in the largest cluster (of S_c = 1.1) at 446.6 s, S_c = 1.01",
    expected=value(6),
    why="1.01 is the lower end of what the paper calls reasonable",
    remark="Three or four, fewer than at 1.05: a third or more of the gaps between neighbours in the cluster are wider than "
    ".01 d.",
)
def contacts_at_the_lower_end(data):
    """(i) And at S_c = 1.01."""
    return contacts_in_largest(data, (1.01,))


@claim(
    "B-6-04",
    quantity="share of the particles with more than six contacts at S_c = 1.2 and 446.6 s",
    expected=at_most(0.01),
    why="seven have room within 1.2 d only if hardly any of them touch: an exception",
)
def nobody_else(data):
    """(i) For S_c <= 1.2 nobody but the nearest neighbours is counted."""
    shares = [(contacts(len(x), neighbours(x, box, 1.2 * d)) > 6).mean() for x, _, _, box, d in shots(data, 446.6)]
    return mean_and_error(shares)


@claim(
    "B-6-05",
    quantity="largest S_c at which rows of a triangular lattice of spacing S_c d cannot pass each other",
    expected=at_least(1.2, rounding=0.05),
    why="1.2 stands for 1.15 to 1.25",
)
def dilation(data):
    """(i) For S_c <= 1.2 a shear displacement would need a dilation of neighbouring layers."""
    d = float(large(data)["diameter"])
    rows, _ = triangular(d, columns=1, rows=2)
    return d / np.diff(rows[:, 1])[0]  # they pass where their distance is d


@claim(
    "B-6-06",
    quantity="number of clusters in packings of disks and of spheres with gaps of .005 d and .25 d, S_c = 1.01 and 1.2",
    expected=value([1, 1, 256, 256, 1, 1, 500, 500]),
    why="all particles touch, or none",
)
def any_dimension(data):
    """(ii) The criterion is independent of the dimension."""
    d = float(large(data)["diameter"])
    packings = [lattice(spacing * d) for lattice in (triangular, face_centred) for spacing in (1.005, 1.25)]
    return np.concatenate([find_clusters(x, box, d, [1.01, 1.2]).counts for x, box in packings])


@claim(
    "B-6-07",
    quantity="I_c at 446.6 s from the positions of the snapshot by I_c of the run, S_c = 1.1",
    expected=value(1, relative=1e-3),
    why="positions of the run are kept with fewer digits",
)
def snapshots_are_enough(data):
    """(iii) The distance criterion can be applied to snapshots of a simulation."""
    counts, _ = at_factor(data, "cluster_count", 1.1)
    found = [find_clusters(x, box, d, [1.1]).counts[0] for x, _, _, box, d in shots(data, 446.6)]
    return mean_and_error(np.array(found) / counts[:, -1])


@claim(
    "B-6-08",
    quantity=f"I_c by relative velocity, velocities {HOT:g} times as large by those of the run, 2.56 s, threshold fixed in m/s",
    expected=at_least(1.1),
    why="a tenth more clusters is no accident among tens of thousands",
)
def velocity_and_temperature(data):
    """(iv) A criterion based on the relative velocity depends on the temperature."""
    return mean_and_error(change(by_velocity, data, 2.56, lambda velocity, _: SLOW * np.sqrt(2 * np.square(velocity).mean())))


@claim(
    "B-6-09",
    quantity=f"I_c by collision frequency, rates {HOT:g} times as high by those of the run, 2.56 s, threshold fixed in 1/s",
    expected=at_most(0.9),
    why="as for the velocity, the other way",
)
def frequency_and_temperature(data):
    """(iv) So does one based on the collision frequency."""
    return mean_and_error(change(by_frequency, data, 2.56, lambda _, frequency: BUSY * frequency.mean()))


@claim(
    "B-6-10",
    quantity=f"|I_c ratio - 1| as in B-6-08 and B-6-09, thresholds {SLOW:g} rms velocity and {BUSY:g} mean frequency then",
    expected=at_least([0.1, 0.1]),
    why="as there",
    remark="With thresholds that follow the temperature the same particles are chosen: hard particles have no velocity scale. "
    "The reason is against fixed thresholds, not against these criteria; what remains is (iii).",
)
def no_choice_helps(data):
    """(iv) Whichever way their thresholds are chosen."""
    ratios = np.stack([abs(change(bonds_of, data, 2.56) - 1) for bonds_of in (by_velocity, by_frequency)], axis=1)
    return mean_and_error(ratios)


@claim(
    "B-6-11",
    figure="cluster1999_outlook_criteria",
    quantity="M_max at 40.96 s by that at 1.28 s: by relative velocity, by collision frequency",
    expected=at_least([2, 2]),
    why="as alternatives they must show the growth from about 1 s to 40 s; a factor 2 is beyond the scatter",
)
def others_grow(data):
    """Alternatives would involve the collision frequency or the relative velocity: largest clusters grow by them too."""
    return mean_and_error(growth(data, 2))


@claim(
    "B-6-12",
    figure="cluster1999_outlook_criteria",
    quantity="<M> at 40.96 s by that at 1.28 s: by relative velocity, by collision frequency",
    expected=at_least([1.5, 1.5]),
    why="<M> ~ t^.3 is a factor 2.8; half of its growth on a logarithmic axis would be 1.7",
    remark="By relative velocity it grows fivefold, by collision frequency it even falls by a sixth: collisions "
    "concentrate on few particles in the centres of clusters, and the many below the mean rate are all single.",
)
def others_grow_in_the_mean(data):
    """And so does the mean cluster size."""
    return mean_and_error(growth(data, 0))


@claim(
    "B-6-13",
    figure="cluster1999_outlook_criteria",
    quantity="length 2 pi/<k> of the structure factor at 40.96 s by that at 1.28 s",
    expected=at_least(2),
    why="lead paragraph: structure factors are what clusters are an alternative to; a factor 2 is beyond their scatter",
)
def structure_grows(data):
    """The length from the structure factor grows with the clusters."""
    late, early = (
        np.array([mean_wavelength(*structure_factor(x / d, box / d, 512), 5) for x, _, _, box, d in shots(data, time)])
        for time in (40.96, 1.28)
    )
    return mean_and_error(late / early)


@claim(
    "B-6-14",
    figure="cluster1999_fig7",
    quantity="I_c at 446.6 s by that of the first sample, S_c = 1.01, 1.05, 1.1, 1.2, 1.3, 1.4",
    expected=at_most(0.5),
    why="<M> grows as much as I_c decreases; a factor 2 is the least that one calls a growth",
)
def fewer_clusters(data):
    """During the evolution of the system the number of clusters decreases, for every S_c."""
    ratios = [
        counts[:, -1] / counts[:, 0]
        for counts, _ in (at_factor(data, "cluster_count", s) for s in (1.01, 1.05, 1.1, 1.2, 1.3, 1.4))
    ]
    return mean_and_error(np.stack(ratios, axis=1))


@claim(
    "B-6-15",
    figure="cluster1999_fig7",
    quantity="M_max/N at 446.6 s, S_c = 1.05, 1.1, 1.2",
    expected=at_least(0.5),
    why="'most'",
    remark="About half of them for S_c <= 1.1, more for larger S_c: the largest cluster of 1.2 is in pieces by smaller ones.",
)
def most_particles(data):
    """Finally most particles in the system belong to the largest cluster."""
    shares = [at_factor(data, "largest_cluster_size", factor)[0][:, -1] / N for factor in (1.05, 1.1, 1.2)]
    return mean_and_error(np.stack(shares, axis=1))


@claim(
    "B-6-16",
    figure="cluster1999_fig7",
    quantity="decades of t from 1 s until the largest cluster (S_c = 1.2) has a tenth of all particles",
    expected=between(1, 2),
    why="'a little more than one order of magnitude' (section 5); two decades would be enough for a power law",
    remark="It is less than one: the largest cluster feels the size of the system before the mean size does.",
)
def not_long_enough(data):
    """About 10^5 particles are not enough to examine cluster growth over long enough times."""
    sizes, times = at_factor(data, "largest_cluster_size", 1.2)
    reached = sizes >= N / 10
    if not reached.any(axis=1).all():
        raise NotMeasured("the largest cluster stays below a tenth of the particles")
    return mean_and_error(np.log10(times[reached.argmax(axis=1)]))


@claim(
    "B-6-17",
    quantity="two days of CPU time by that of a run here with ten times as many particles (N ln N)",
    expected=at_least(1),
    why="'several days' are two at least",
)
def ten_times_as_many(data):
    """On a faster computer a factor of at least 10 in the particle number should be possible in the same time."""
    cost = 10 * np.log(10 * N) / np.log(N)
    return mean_and_error(2 * 86400 / (cost * large(data)["cpu_time"].values))


def distribution(data, factor, times):
    """Clusters in octaves of sizes (realization, time, size), their edges, and M_w (realization, time), next to some times."""
    numbers, there = at_factor(data, "cluster_size_distribution", factor)
    weighted, _ = at_factor(data, "weighted_cluster_size", factor)
    chosen = [abs(np.log(there / time)).argmin() for time in times]
    numbers, lower, upper = octaves(numbers[:, chosen], large(data)["cluster_size"].values)
    return numbers, lower, upper, weighted[:, chosen]


@claim(
    "B-6-18",
    figure="cluster1999_outlook_sizes",
    quantity="clusters in all bins of sizes by I_c, largest difference from 1 over all times and S_c",
    expected=at_most(1e-9),
    why="counting",
)
def distribution_is_there(data):
    """The cluster-identification algorithm gives the cluster-size probability distribution."""
    found = large(data)[["cluster_size_distribution", "cluster_count"]].load()
    return float(abs(found["cluster_size_distribution"].sum("cluster_size") / found["cluster_count"] - 1).max())


@claim(
    "B-6-19",
    figure="cluster1999_outlook_sizes",
    quantity="mean squared distance of ln M^2 n(M) against M/M_w by that against M, M >= 2, 1.28 to 20.48 s, S_c = 1.05 to 1.2",
    expected=at_most(0.2),
    why="growth with a single length has one scaled curve; a fifth of the scatter is what one would call a collapse by eye",
    remark="The distribution has two parts. Small clusters in the dilute regions between fall off as about M^-3 at all times, "
    "where they stand; only the few large ones move with M_w. No single size scales both.",
)
def sizes_scale(data):
    """The cluster-size distribution, a perspective of the paper, has one scaled form while clusters grow."""
    found = []
    for factor in (1.05, 1.1, 1.2):
        numbers, lower, upper, weighted = distribution(data, factor, (1.28, 5.12, 20.48))
        found.append(scaling(numbers, weighted, lower, upper, N, 2))
    return side_by_side(found)


@claim(
    "B-6-20",
    figure="cluster1999_outlook_sizes",
    quantity="exponent of n(M) for 4 <= M < 32 (S_c = 1.1) at 5.12, 20.48, 81.92 s: largest less smallest",
    expected=at_most(0.3),
    why="exponents over one decade are not told apart more finely",
)
def small_clusters(data):
    """What is left of the distribution beside the large clusters is a power law that time does not change."""
    numbers, lower, upper, _ = distribution(data, 1.1, (5.12, 20.48, 81.92))
    sizes = middle_sizes(lower, upper)
    window = sizes[lower >= 4][0], sizes[upper <= 32][-1]
    density = size_distribution(numbers, lower, upper, N)
    exponents = np.array([[fit_power_law(sizes, one, window).exponent for one in run] for run in density])
    return mean_and_error(np.ptp(exponents, axis=1))


CLAIMS = claims_in(globals())
