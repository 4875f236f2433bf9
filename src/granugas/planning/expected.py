"""What to expect of a run before it is done: how many collisions, and how far realizations scatter.

Planning, not physics: closed formulas where there are some (homogeneous cooling), and laws with fitted numbers for what follows
(clusters). They were fitted to runs of this engine: N = 42 ... 97776, r = .2 ... .99, t_c = 1e-12 ... 1e-3 s, area fraction
.2267 until 5 s and .2498 until 446.6 s, in two dimensions. There the collisions come out within 13 % (root mean square of 120
points, the worst by a factor 1.5); elsewhere by more. x = t_c / t_E(0) and tau = t / t_E(0) throughout.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from granugas.analysis import theory
from granugas.analysis.enskog import enskog_rate, reduced_pressure
from granugas.scene import Scene

Numbers = NDArray[np.float64]

STEPS = 4000
"""Of an integral over s = K^(-1/2)."""

EXTRA, LOSS_POWER = 690.0, 2.07
"""C/N in clusters at tau = 1000 in a large system as r -> 0 and at x = LATE_RATIO; it falls as (1 - r)^2.07."""

LATE_RATIO, RATIO_POWER, LATE = 4.45e-3, 0.31, 415.0
"""After tau of about LATE those are limited by t_c: as x^(-.31)."""

EARLY_POWER, STEADY = 1.39, 7400.0
"""They grow as tau^1.39 and after STEADY in proportion to tau (B section 4: C/N is linear for long times)."""

FULL_SIZE, SIZE_GROWTH, SIZE_POWER = 765.0, 0.63, 1.37
"""Particles at which a system has half the clusters of a large one, at tau = 1000; as tau^.63; how sharply."""

IN_SPACE = 0.03
"""Share of that in three dimensions (measured: N = 4000 until tau = 2600, 8000 and 262144 until 88000)."""

LEAST_RATIO = 1e-10
"""x below which nothing changes: runs without t_c end by their collapse."""

COLLAPSE, COLLAPSE_SLOPE, COLLAPSE_EDGE = 35.0, 12.5, (0.02, 0.049)
"""Collisions of a particle until the collapse at t_c = 0: 35 exp[12.5 (r - r_1)], r_1 = .02 + .049 ln N (collapse studies)."""

AT_REST = {1: 1.3, 2: 5.4, 3: 7.0}
"""Collisions of a particle in each t_c once gravity has brought a gas to rest (measured for 1 and 2 dimensions)."""

SHAKEN = 2.0
"""How many times as often as at t = 0 particles collide over a vibrated floor (measured 1 to 2.6)."""


MOST = 0.6
"""Relative standard deviation of K, and of <M>, among small systems long after clusters have filled them."""


@dataclass(frozen=True)
class Course:
    """What is expected of a scene in the course of time.

    Attributes:
        tau: (k,) ascending, from 0.
        homogeneous: (k,) C/N of the homogeneous gas.
        clustered: (k,) C/N in clusters besides.
    """

    tau: Numbers
    homogeneous: Numbers
    clustered: Numbers

    @property
    def collisions(self) -> Numbers:
        """(k,) C/N."""
        return self.homogeneous + self.clustered

    @property
    def share(self) -> Numbers:
        """(k,) How far clusters have taken over, from 0 to 1."""
        return np.minimum(1.0, 2.5 * self.clustered / np.maximum(self.homogeneous, 1e-12))


@dataclass(frozen=True)
class End:
    """Where a run is expected to end.

    Attributes:
        tau, collisions: t / t_E(0) and C/N there.
        share: how far clusters have taken over.
    """

    tau: float
    collisions: float
    share: float


def rate_of(scene: Scene) -> float:
    """1/t_E(0) in 1/s."""
    return float(enskog_rate(scene.area_fraction, scene.energy_per_mass, scene.diameter, scene.dimensions))


def end_of(scene: Scene, until: Mapping[str, float]) -> End:
    """The end of a run: a time, a number of collisions, or a collapse, whichever comes first."""
    most = min(until.get("collisions_per_particle", math.inf), collapse(scene))
    last = rate_of(scene) * until["time"] if "time" in until else 1e3
    course = course_of(scene, last)
    while "time" not in until and course.collisions[-1] < most and course.tau[-1] < 1e12:
        course = course_of(scene, 100 * course.tau[-1])
    if course.collisions[-1] > most:
        end = float(np.interp(most, course.collisions, course.tau))
        return End(end, most, float(np.interp(end, course.tau, course.share)))
    reached = course.collisions[-1] if "time" in until else most
    return End(float(course.tau[-1]), float(reached), float(course.share[-1]))


def course_of(scene: Scene, last: float) -> Course:
    """C/N from tau = 0 to `last`."""
    tau = np.concatenate([[0.0], np.geomspace(min(1e-3, last / 2), last, 400)])
    if scene.gravity > 0 or scene.floor != "still":
        return Course(tau, _of_a_fed_gas(scene, tau), np.zeros_like(tau))
    if scene.heating > 0 and scene.restitution < 1:
        steady = theory.steady_temperature(scene.heating, scene.restitution, rate_of(scene) / math.sqrt(_temperature(scene)))
        return Course(tau, tau * math.sqrt(float(steady) / _temperature(scene)), np.zeros_like(tau))
    if not scene.dissipates:
        return Course(tau, tau, np.zeros_like(tau))
    return Course(tau, cooling(scene, tau)[1], clustered(scene, tau))


def cooling(scene: Scene, tau: ArrayLike, contact_time: float | None = None) -> tuple[Numbers, Numbers]:
    """K and C/N of homogeneous cooling, which contacts within t_c slow down (A Eqs. 21 and 23, section 7).

    s = K^(-1/2) obeys ds/dtau = l(s) exp(-2 x/s), and C/N grows by dtau/s; l is (1 - r^2)/(2 D) of smooth particles
    (`loss_at`). `contact_time` (s) replaces the scene's.
    """
    tau = np.asarray(tau, dtype=float)
    ratio = rate_of(scene) * (max(scene.contact_times) if contact_time is None else contact_time)
    loss = loss_at(scene)
    s = np.geomspace(1.0, 1 + 1.1 * float(loss(np.ones(1))[0]) * tau.max(initial=1e-9), STEPS)
    passing = np.exp(np.minimum(2 * ratio / s, 600.0)) / loss(s)
    passed, collided = _integral(passing, s), _integral(passing / s, s)
    return np.interp(tau, passed, s) ** -2.0, np.interp(tau, passed, collided)


def clustered(scene: Scene, tau: ArrayLike) -> Numbers:
    """C/N in clusters, in addition to homogeneous cooling: the fitted law of this module."""
    tau = np.asarray(tau, dtype=float)
    if scene.dimensions == 1:
        return np.zeros_like(tau)
    at_last = float(loss_at(scene)(cooling(scene, tau.max(initial=1e-9))[0] ** -0.5))
    inelastic = 1 - math.sqrt(max(0.0, 1 - 2 * scene.dimensions * at_last))  # 1 - r of smooth particles that lose as much
    ratio = max(rate_of(scene) * max(scene.contact_times), LEAST_RATIO) / LATE_RATIO
    room = room_for_clusters(scene.n_particles, tau)
    limited = room / (1 + (LATE / np.maximum(tau, 1e-9)) ** 3)
    growth = (tau / 1000) ** EARLY_POWER / (1 + tau / STEADY) ** (EARLY_POWER - 1)
    whole = EXTRA * inelastic**LOSS_POWER * ratio ** (-RATIO_POWER * limited) * growth * room
    return whole * (IN_SPACE if scene.dimensions == 3 else 1.0)


def room_for_clusters(n: float, tau: ArrayLike) -> Numbers:
    """From 0 for systems too small for the clusters of that time to 1 for large ones."""
    needed = FULL_SIZE * (np.asarray(tau, dtype=float) / 1000) ** SIZE_GROWTH
    return 1 / (1 + (needed / n) ** SIZE_POWER)


def collapse(scene: Scene) -> float:
    """C/N at which a gas without contact duration is expected to collapse; infinite where something keeps it from that."""
    spared = scene.critical_distance or scene.internal_modes or scene.kick_energy or scene.lrv_velocity or scene.heating
    if max(scene.contact_times) > 0 or spared or not scene.dissipates or scene.material == "viscoelastic":
        return math.inf
    edge = COLLAPSE_EDGE[0] + COLLAPSE_EDGE[1] * math.log(scene.n_particles)
    return COLLAPSE * math.exp(min(COLLAPSE_SLOPE * (scene.restitution - edge), 100.0))


def loss_at(scene: Scene) -> Callable[[Numbers], Numbers]:
    """l as a function of s = K^(-1/2): of smooth particles, of rough ones (`_loss_of_rough`), of r(u) at the mean of u."""
    smooth = (1 - scene.restitution**2) / (2 * scene.dimensions)
    if scene.material != "constant":
        laws: dict[str, Callable[[Any], Any]] = {
            "viscoelastic": lambda u: theory.viscoelastic_restitution(u, scene.viscosity),
            "plastic": lambda u: theory.plastic_restitution(u, scene.restitution, scene.yield_velocity),
        }
        law = laws[scene.material]
        thermal = math.sqrt(math.pi * _temperature(scene))  # <u>, its square being distributed exponentially
        return lambda s: (1 - law(thermal / np.asarray(s)) ** 2) / (2 * scene.dimensions)
    whole = max(_loss_of_rough(scene) if scene.rough else smooth, 1e-12)
    return lambda s: np.full_like(np.asarray(s, dtype=float), whole)


# Standard deviations of one run, relative; the mean of n runs has them by sqrt(n).


def scatter(scene: Scene, end: End) -> dict[str, float]:
    """Relative standard deviations over realizations at the end of a run: kinetic_energy, pressure, mean_cluster_size.

    K: sqrt{[2 (1-r^2)]^2 + [min(.8 (1-r^2), .4)]^2 tau} / sqrt(N), the first part the chance of a start, the second the growth
    of shear and density, which small systems have no room for (N / (N + 150)). P over the last of 60 intervals in log t,
    over .13 C/N: .4 / sqrt(collisions), and with clusters .4 (P - 1)/P, which does not fall with N in what was measured
    (378 ... 5740): a few dense places have most of the collisions. <M>: .45 / sqrt(N), as of N independent bonds, and with
    clusters .25 sqrt(tau) / sqrt(N). K and <M> scatter by MOST at most. All measured with 5 to 24 runs at each of 12 points
    until tau = 2225; right within a factor 2, most of them.
    """
    n = scene.n_particles
    loss = 2 * scene.dimensions * float(loss_at(scene)(np.ones(1))[0]) if scene.dissipates else 0.0
    growth = min(0.8 * loss, 0.4) * n / (n + 150) * math.sqrt(end.tau)
    energy = math.hypot(2 * loss, 0.0 if scene.heating > 0 else growth) / math.sqrt(n)
    excess = float(reduced_pressure(scene.area_fraction, dimensions=scene.dimensions)) - 1
    excess += end.share * (0.2 - excess)
    in_interval = max(0.13 * end.collisions * n / 2, 1.0)
    return {
        "kinetic_energy": min(energy, MOST) if scene.dissipates else 0.0,
        "pressure": math.hypot(0.4 / math.sqrt(in_interval), 0.4 * end.share * excess / (1 + excess)),
        "mean_cluster_size": min(math.hypot(0.45, 0.25 * end.share * math.sqrt(end.tau)) / math.sqrt(n), MOST),
    }


def bias(scene: Scene, end: End) -> dict[str, float]:
    """How far K may be from that of a large system without contact duration, relative: of N, and of t_c.

    N: the share of clusters that has no room (`room_for_clusters`). At r = .4 and tau = 2225 that is 83, 46, 11, 2 % for N =
    378, 1435, 5740, 22960; measured are 79, 45, 25, 23 % less K than at 97776, the last two within their errors of 10 and 25 %.
    t_c: what it takes from homogeneous cooling; clusters are taken to follow (the papers see no influence on K up to t_c = 1e-5
    s, and neither do we). Numbers of collisions and elastic shares depend on t_c at any t_c: of these this says nothing.
    """
    if not scene.dissipates:
        return {"n_particles": 0.0, "contact_time": 0.0}
    of_size = end.share * (1 - float(room_for_clusters(scene.n_particles, end.tau)))
    slowed, free = (float(cooling(scene, end.tau, t)[0]) for t in (max(scene.contact_times), 0.0))
    return {"n_particles": of_size, "contact_time": 1 - min(slowed, free) / max(slowed, free)}


def _of_a_fed_gas(scene: Scene, tau: Numbers) -> Numbers:
    """A gas until it has fallen and come to rest, then so many collisions in each t_c; over a vibrated floor it never rests."""
    if scene.floor != "still" or max(scene.contact_times) == 0 or scene.restitution == 1 or scene.gravity == 0:
        return SHAKEN * tau if scene.floor != "still" else tau
    height = scene.volume ** (1 / scene.dimensions)
    speed = math.sqrt(_temperature(scene))
    settled = rate_of(scene) * (math.sqrt(height / scene.gravity) + 2 * speed / scene.gravity)
    resting = AT_REST[scene.dimensions] / (max(scene.contact_times) * rate_of(scene))
    return np.minimum(tau, settled) + resting * np.maximum(tau - settled, 0.0)


def _loss_of_rough(scene: Scene) -> float:
    """l of rough particles: A - B R (Huthmann & Zippelius 1997), or smooth ones' and that of friction."""
    r, beta = scene.restitution, scene.tangential_restitution
    if math.isinf(scene.friction):
        a, b, _ = theory.rough_rates(r, beta, scene.dimensions)
        return float(a - b * theory.rough_temperature_ratio(r, beta, scene.dimensions))
    return (1 - r**2) / (2 * scene.dimensions) + theory.friction_loss(beta, scene.friction, r) / 4


def _temperature(scene: Scene) -> float:
    """kT/m at t = 0 in (m/s)^2."""
    return 2 * scene.energy_per_mass / scene.dimensions


def _integral(values: Numbers, over: Numbers) -> Numbers:
    """By trapezia, from the first value on."""
    return np.concatenate([[0.0], np.cumsum(np.diff(over) * (values[1:] + values[:-1]) / 2)])
