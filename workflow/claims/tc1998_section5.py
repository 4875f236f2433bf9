"""tc1998 section 5: elastic systems."""

import numpy as np
import xarray as xr

from granugas.analysis.comparison import onset
from granugas.analysis.elastic import whole_runs
from granugas.analysis.statistics import jackknife, mean_and_error
from granugas.analysis.theory import elastic_collision_fraction, elastic_particle_fraction, prefactor_rate, reduced_pressure
from granugas.claims import at_least, at_most, between, claim, claims_in, value
from granugas.geometry import CLOSE_PACKING
from granugas.measured import NotMeasured, experiment, runs

STUDIES = ("tc1998_elastic_n1435", "tc1998_elastic_n42", "tc1998_elastic_n16680")
EXPERIMENTS = ("volumes",)

FLUID = 0.65
"""Area fractions up to this are well below the transition at about .7."""

SYMBOL = 0.05
"""Half the height of a symbol on the four decades of the paper's plots, as a part: what 'perfect' means there."""


def elastic(data, n, low=0.0, high=1.0):
    """Means over whole runs of N disks between two area fractions; contact times ascend."""
    study = f"tc1998_elastic_n{n}"
    runs(data, study, n_particles=n)
    if "elastic_particle_time_fraction" not in data[study]:
        raise NotMeasured(f"{study} has no time average of n_e")
    found = whole_runs(data[study])
    found = found.sel(area_fraction=(found["area_fraction"] >= low) & (found["area_fraction"] <= high))
    if not found.sizes["area_fraction"]:
        raise NotMeasured(f"{study} has no area fraction from {low:g} to {high:g}")
    return found.sortby("contact_time")


def largest_deviation(ratio):
    """The value of a ratio (area_fraction, realization) that is farthest from 1, and its error."""
    mean, error = mean_and_error(ratio.transpose("realization", ...).values)
    worst = np.nanargmax(abs(mean - 1))
    return np.ravel(mean)[worst], np.ravel(error)[worst]


def pressure_ratio(found):
    """P_0 - 1 by that of Eqs. 16 and 17."""
    return (found["reduced_pressure"] - 1) / (xr.apply_ufunc(reduced_pressure, found["area_fraction"]) - 1)


def rate_ratio(found):
    """C_r by the Enskog rate."""
    return found["collision_rate"] / found["enskog_rate"]


def mean_field(found, fraction):
    """Eq. 20 or 21 at the Enskog rate of Eq. 19."""
    return fraction(*np.broadcast_arrays(found["contact_time"].values[:, np.newaxis, np.newaxis], found["enskog_rate"].values))


def quality(found, variable, fraction):
    """A measured fraction by that of mean field."""
    measured = found[variable].transpose("contact_time", "area_fraction", "realization")
    return measured / mean_field(found.transpose(..., "area_fraction", "realization"), fraction)


def at(found, contact_times):
    there = [time for time in contact_times if np.isclose(found["contact_time"], time, rtol=1e-9).any()]
    if len(there) < len(contact_times):
        raise NotMeasured(f"of the contact times {contact_times} there are {there} only")
    return found.sel(contact_time=there, method="nearest")


@claim(
    "A-5-01",
    quantity="largest |E(t)/E(0) - 1| at r = 1, N = 1435",
    expected=at_most(0, absolute=1e-9),
    why="rounding over 1e7 collisions",
)
def energy_is_conserved(data):
    """At r = 1 all collisions are elastic in fact, whatever t_c calls them."""
    return float(abs(runs(data, "tc1998_elastic_n1435", n_particles=1435)["kinetic_energy"] - 1).max())


@claim(
    "A-5.1-01",
    quantity="collisional part of the pressure, (P_0 - 1) / P_0, at the least area fraction, N = 1435",
    expected=at_most(0.03),
    why="2 nu at nu = .01, with room",
)
def dilute_stress(data):
    """In a dilute system without lasting contacts the first term of the stress tensor is negligible."""
    found = elastic(data, 1435, high=0.01)["reduced_pressure"].isel(area_fraction=0)
    return mean_and_error(1 - 1 / found.values)


@claim(
    "A-5.1-02",
    quantity="difference of the eigenvalues of the collisional stress by their sum, nu = .227, N = 1435, over whole runs",
    expected=value(0, absolute=0.02),
    why="a fluid has no direction; 2 % is the scatter of some 1e7 collisions, with the difference of two eigenvalues positive",
)
def isotropic_stress(data):
    """In equilibrium the stress tensor of the whole box is a pressure alone."""
    found = runs(data, "tc1998_elastic_n1435", n_particles=1435, area_fraction=0.226725).isel(contact_time=0)
    duration = found["sampling_time"].diff("time")
    tensor = [
        [found[f"collisional_stress_{a}{b}"].isel(time=slice(1, None)).weighted(duration).mean("time") for b in "xy"]
        for a in "xy"
    ]
    tensor = np.moveaxis(np.array(tensor), -1, 0)
    eigenvalues = np.linalg.eigvalsh((tensor + tensor.transpose(0, 2, 1)) / 2)
    return mean_and_error((eigenvalues[:, 1] - eigenvalues[:, 0]) / eigenvalues.sum(axis=1))


@claim(
    "A-5.1-03",
    figure="tc1998_stress",
    quantity="smallest fall of the pressure's spread over test volumes in equilibrium, for 4 times V_c, 4 times the interval",
    expected=at_least([0, 0]),
    why="the order alone",
)
def large_enough(data):
    """Volume and interval have to be large enough for averages over enough particles and collisions."""
    spread = experiment(data, "volumes")["pressure_spread"].sel(restitution=1.0).mean("realization")
    spread = spread.isel(test_volumes=slice(1, None)).transpose("test_volumes", "averaging_interval").values
    return [np.diff(spread, axis=0).min(), -np.diff(spread, axis=1).max()]


@claim(
    "A-5.1-04",
    figure="tc1998_stress",
    quantity="spread of the pressure over 256 test volumes, whole record, among clusters by that in equilibrium",
    expected=at_least(3),
    why="densities that differ by factors among clusters, the rest of the scatter in equilibrium",
)
def small_enough(data):
    """Volume and interval have to be small enough to resolve inhomogeneities."""
    spread = experiment(data, "volumes")["pressure_spread"].isel(test_volumes=-1, averaging_interval=-1)
    groups = [spread.sel(restitution=r).values for r in (0.4, 1.0)]
    return jackknife(lambda clusters, fluid: clusters.mean() / fluid.mean(), *groups)


@claim(
    "A-5.1-05",
    figure="tc1998_stress",
    quantity="mean pressure of 256 test volumes by that of the whole box, among clusters",
    expected=at_most(0.95),
    why="motion that is shared inside of a volume is no pressure there; 5 % is more than scatter",
)
def depends_on_the_volume(data):
    """The result may depend on the choice of the volume."""
    found = experiment(data, "volumes").sel(restitution=0.4)
    both = found["kinetic_pressure"] + found["collisional_pressure"]
    return mean_and_error((both.isel(test_volumes=-1) / both.isel(test_volumes=0)).values)


@claim(
    "A-5.1-06",
    figure="tc1998_stress",
    quantity="collisional pressure of Eq. 15, summed over recorded collisions, by the engine's own sum: least and largest",
    expected=value(1, rounding=1e-9),
    why="the same collisions, so up to rounding",
)
def stress_of_collisions(data):
    """For hard disks the stress of contacts is the sum over collisions of momentum change times lever arm (Eq. 15)."""
    found = experiment(data, "volumes")
    ratio = found["collisional_pressure"].sel(test_volumes=1) / found["tally_pressure"]
    return [float(ratio.min()), float(ratio.max())]


@claim(
    "A-5.2-01",
    figure="tc1998_fig03",
    quantity=f"P_0 - 1 by Eqs. 16, 17 where it is farthest from 1, nu <= {FLUID}, N = 1435",
    expected=value(1, absolute=SYMBOL),
    why="the height of a symbol in the paper's plot",
)
def equation_of_state(data):
    """The equation of state agrees perfectly with theory in the fluid."""
    return largest_deviation(pressure_ratio(elastic(data, 1435, high=FLUID)))


@claim(
    "A-5.2-02",
    figure="tc1998_fig03",
    quantity=f"P_0 - 1 by Eqs. 16, 17 where it is farthest from 1, nu <= {FLUID}, N = 42",
    expected=value(1, absolute=SYMBOL),
    why="the height of a symbol in the paper's plot",
)
def tiny_system(data):
    """The agreement is perfect already for a tiny system of 42 particles."""
    return largest_deviation(pressure_ratio(elastic(data, 42, high=FLUID)))


@claim(
    "A-5.2-03",
    figure="tc1998_fig03",
    quantity="least area fraction at which P_0 - 1 is 10 % off Eqs. 16, 17, N = 1435",
    expected=between(0.67, 0.73),
    why="'about .7' is .7 give or take .03; 10 % is what one sees in the plot",
)
def onset_of_the_solid(data):
    """Simulations deviate from theory only for area fractions above about .7."""
    found = elastic(data, 1435)
    nu = found["area_fraction"].values
    ratios = pressure_ratio(found).transpose("realization", "area_fraction").values
    return jackknife(lambda ratio: onset(nu, abs(ratio.mean(axis=0) - 1), 0.1), ratios)


@claim(
    "A-5.2-04",
    figure="tc1998_fig03",
    quantity="P_0 (1 - nu/nu_cp) / 2 at the largest nu >= .85, N = 16680: 1 in a crystal of free volume",
    expected=value(1, absolute=0.1),
    why="terms beyond free volume are a few per cent at nu = .86; a fluid (Eq. 16) is off by a factor 2",
)
def solid_branch(data):
    """Above .7 there is a solid, whose particles are hindered by their neighbours."""
    found = elastic(data, 16680, low=0.85).isel(area_fraction=-1)
    return mean_and_error((found["reduced_pressure"] * (1 - found["area_fraction"] / CLOSE_PACKING[2]) / 2).values)


@claim(
    "A-5.2-05",
    figure="tc1998_fig03",
    quantity="largest difference of P_0 - 1 of N = 42 from N = 16680, in parts, for nu >= .72",
    expected=between(0.005, 0.25),
    why="'slightly': visible, yet no other branch",
)
def finite_size_of_the_crystal(data):
    """The smallest system deviates slightly from the larger ones in the crystalline regime."""
    small, large = (
        elastic(data, n, low=0.72)["reduced_pressure"].transpose("realization", ...).values - 1 for n in (42, 16680)
    )
    return jackknife(lambda a, b: abs(a.mean(axis=0) / b.mean(axis=0) - 1).max(), small, large)


@claim(
    "A-5.2-06",
    figure="tc1998_fig03",
    quantity="area fraction at which the runs of N = 1435 scatter most in P_0 - 1",
    expected=between(0.66, 0.74),
    why="near .7, and there are points every .01 to .03",
)
def fluctuations(data):
    """The runs of one density scatter comparatively much at about .7."""
    found = elastic(data, 1435)
    scatter = pressure_ratio(found).std("realization", ddof=1)
    return float(found["area_fraction"].values[scatter.values.argmax()])


@claim(
    "A-5.3-01",
    figure="tc1998_fig04",
    quantity="w_0 = C_r / (P_0 - 1) in 1/s, measured at nu = .227, N = 1435",
    expected=value(656.03, rounding=0.005, relative=0.025),
    why="the energy of 1435 random start velocities scatters by 1.7 %, w_0 by .8 %: three times that",
)
def prefactor(data):
    """The prefactor of the collision rate is w_0 = 656.03 /s."""
    found = elastic(data, 1435, 0.2267, 0.2268).isel(area_fraction=0)
    return mean_and_error((found["collision_rate"] / (found["reduced_pressure"] - 1)).values)


@claim(
    "A-5.3-02",
    figure="tc1998_fig04",
    quantity=f"C_r by the Enskog rate where it is farthest from 1, nu <= {FLUID}, N = 1435",
    expected=value(1, absolute=SYMBOL),
    why="the height of a symbol in the paper's plot",
)
def enskog(data):
    """The collision rate agrees perfectly with Enskog's in the fluid."""
    return largest_deviation(rate_ratio(elastic(data, 1435, high=FLUID)))


@claim(
    "A-5.3-03",
    figure="tc1998_fig04",
    quantity="C_r / [w_0 (P_0 - 1)] where it is farthest from 1, over all area fractions, fluid and solid, N = 1435",
    expected=value(1, absolute=0.01),
    why="exact for many disks at equilibrium; 1 % for the scatter of the impulses at the least area fraction",
)
def one_prefactor(data):
    """Collision rate and pressure differ by the constant w_0 alone."""
    found = elastic(data, 1435)
    attributes = data["tc1998_elastic_n1435"].attrs
    w_0 = prefactor_rate(attributes["velocity_half_width"] ** 2 / 3, attributes["diameter"])
    return largest_deviation(found["collision_rate"] / (w_0 * (found["reduced_pressure"] - 1)))


@claim(
    "A-5.3-04",
    figure="tc1998_fig04",
    quantity="smallest ratio of the rate of elastic collisions from one t_c to the next larger, over all area fractions",
    expected=at_least(1.0),
    why="the order alone; equal where all collisions are elastic",
)
def smaller_tc_fewer_elastic(data):
    """The smaller t_c, the lower the rate of elastic collisions."""
    share = elastic(data, 1435)["elastic_collision_fraction"].mean("realization")
    ratio = share.isel(contact_time=slice(1, None)).values / share.isel(contact_time=slice(None, -1)).values
    return ratio[np.isfinite(ratio)].min()


@claim(
    "A-5.4-01",
    figure="tc1998_fig05",
    quantity=f"q_n (time average) where it is farthest from 1, nu <= {FLUID}, all t_c, N = 1435",
    expected=value(1, absolute=0.1),
    why="'reasonable' agreement: Eq. 20 takes one rate for fast and slow particles, which at t_c = t_E costs some per cent",
)
def elastic_particles(data):
    """The fraction of elastic particles agrees reasonably with Eq. 20: q_n is about 1."""
    found = elastic(data, 1435, high=FLUID)
    return largest_deviation(quality(found, "elastic_particle_time_fraction", elastic_particle_fraction))


@claim(
    "A-5.4-02",
    figure="tc1998_fig05",
    quantity="scatter of q_n by 30 snapshots over the runs, nu <= .05 by nu = .3 ... .6, t_c = 1e-5 s, N = 1435",
    expected=at_least(1.5),
    why="expected counts differ by a factor of more than 20, their relative scatter by more than 4; three runs tell it roughly",
)
def bad_statistics(data):
    """At small area fractions q_n deviates because of bad statistics."""

    def scatter(low, high):
        found = at(elastic(data, 1435, low, high), [1e-5])
        factors = quality(found, "elastic_particle_fraction", elastic_particle_fraction)
        return float(np.sqrt((factors.std("realization", ddof=1) ** 2).mean()))

    return scatter(0, 0.05) / scatter(0.3, 0.6)


@claim(
    "A-5.4-03",
    figure="tc1998_fig05",
    quantity="largest |q_n - 1| (time average) for nu >= .72, t_c = 1e-5 s, N = 1435",
    expected=at_least(0.1),
    why="as for the pressure, 10 % is what one sees in the plot",
)
def ordered_system(data):
    """Above .7 q_n deviates because of the transition to the ordered system."""
    found = at(elastic(data, 1435, low=0.72), [1e-5])
    mean, error = largest_deviation(quality(found, "elastic_particle_time_fraction", elastic_particle_fraction))
    return abs(mean - 1), error


@claim(
    "A-5.4-04",
    figure="tc1998_fig06",
    quantity=f"mean of 1 - q_c over nu <= {FLUID} and t_c = 1e-7, 1e-6, 1e-5 s, N = 1435",
    expected=value(0.05, absolute=0.03),
    why="'about 5 percent', read from a plot of scattered points",
)
def fewer_elastic_collisions(data):
    """There are about 5 per cent fewer elastic collisions than Eq. 21 expects."""
    found = at(elastic(data, 1435, high=FLUID), [1e-7, 1e-6, 1e-5])
    factors = quality(found, "elastic_collision_fraction", elastic_collision_fraction)
    return mean_and_error(1 - factors.mean(["contact_time", "area_fraction"]).values)


@claim(
    "A-5.4-05",
    figure="tc1998_fig06",
    quantity=f"largest q_c over nu <= {FLUID}, t_c = 1e-5, 1e-4, 1e-3 s, N = 1435",
    expected=at_most(1),
    why="the sign alone; smaller t_c have too few counts at single points",
)
def never_more(data):
    """Mean field overestimates the fraction of elastic collisions at every density and t_c."""
    found = at(elastic(data, 1435, high=FLUID), [1e-5, 1e-4, 1e-3])
    factors = quality(found, "elastic_collision_fraction", elastic_collision_fraction).transpose("realization", ...).values
    mean, error = mean_and_error(factors)
    worst = np.argmax(mean)
    return mean.ravel()[worst], error.ravel()[worst]


@claim(
    "A-5.4-06",
    figure="tc1998_fig07",
    quantity="q_e = e_e / (Eq. 20), mean over nu <= .4 at t_c = 1e-5 s, N = 16680",
    expected=value(1.25, absolute=0.03),
    why="5/4 is the limit of t_c -> 0, at t_c = .02 t_E it is a little less",
)
def elastic_energy(data):
    """Elastic particles carry 5/4 of the energy that mean field gives them."""
    found = at(elastic(data, 16680, high=0.4), [1e-5])
    factors = quality(found, "elastic_energy_fraction", elastic_particle_fraction)
    return mean_and_error(factors.mean(["contact_time", "area_fraction"]).values)


@claim(
    "A-5.4-07",
    figure="tc1998_fig07",
    quantity=f"least e_e / n_e over nu <= {FLUID} and t_c = 1e-5, 1e-4, 1e-3 s, N = 16680",
    expected=at_least(1),
    why="the sign alone; it is 1 where all particles are elastic",
)
def fast_particles_collide_more(data):
    """Fast particles collide more often, so elastic particles have more energy than the mean."""
    found = at(elastic(data, 16680, high=FLUID), [1e-5, 1e-4, 1e-3])
    ratio = found["elastic_energy_fraction"] / found["elastic_particle_fraction"]
    mean, error = mean_and_error(ratio.transpose("realization", ...).values)
    worst = np.argmin(mean)
    return mean.ravel()[worst], error.ravel()[worst]


CLAIMS = claims_in(globals())
