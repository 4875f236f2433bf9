"""cluster1999 section 3: small systems, N = 784, energies along the two axes (Fig. 1, 2)."""

import numpy as np

from granugas.analysis.comparison import onset
from granugas.analysis.statistics import jackknife, mean_and_error
from granugas.analysis.theory import energy_after_collisions
from granugas.claims import at_least, between, claim, claims_in, value
from granugas.measured import common, enough_runs, runs, series

STUDIES = ("cluster1999_restitutions", "cluster1999_contact_times")
EXPERIMENTS = ()

RESTITUTIONS = (0.99, 0.97, 0.95, 0.9, 0.8, 0.6, 0.2)
CONTACT_TIMES = (1e-3, 1e-5, 1e-6, 1e-8, 1e-10)

BEGINNING = np.log(1.25)
"""Of a deviation: a quarter."""

ANISOTROPIC = 0.2
"""rms of (Kx - Kz)/K over runs; an isotropic gas of 784 disks has 1/sqrt(784) = .036."""


def of(data, restitution):
    return runs(data, "cluster1999_restitutions", n_particles=784, restitution=restitution).isel(time=slice(1, None))


def of_time(data, contact_time):
    found = runs(data, "cluster1999_contact_times", n_particles=784, restitution=0.6, contact_time=contact_time)
    return found.isel(time=slice(1, None))


def anisotropy(found):
    """(Kx - Kz)/K of (realization, sample)."""
    return (series(found["kinetic_energy_x"]) - series(found["kinetic_energy_y"])) / series(found["kinetic_energy"])


def above_eq_3(found, restitution):
    """ln of K by Eq. 3 at the same C/N, (realization, sample)."""
    return np.log(
        series(found["kinetic_energy"]) / energy_after_collisions(series(found["collisions_per_particle"]), restitution)
    )


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
        places = [
            onset(common(one["collisions_per_particle"]), line, ANISOTROPIC) for one, line in zip(found, rms, strict=True)
        ]
        return np.divide(places[:-1], places[1:]).min()

    return jackknife(smallest_ratio, np.stack([anisotropy(one) for one in found], axis=1))


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
    count = common(found[0]["collisions_per_particle"])
    values = np.stack([anisotropy(one) for one in found], axis=1)
    return jackknife(lambda v: onset(count, np.sqrt((v**2).mean(axis=(0, 1))), ANISOTROPIC), values)


def anisotropies(data):
    """(Kx - Kz)/K at C/N = 1000 of (realization, contact time)."""
    return np.stack([anisotropy(of_time(data, t_c))[:, -1] for t_c in CONTACT_TIMES], axis=1)


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
    enough_runs(of_time(data, CONTACT_TIMES[0]))

    def ratio(v):  # variances within and between are half the mean squares of the differences
        return np.sqrt(v.var(axis=1, ddof=1).mean() / v.var(axis=0, ddof=1).mean())

    return jackknife(ratio, anisotropies(data))


CLAIMS = claims_in(globals())
