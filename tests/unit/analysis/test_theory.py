"""The closed formulas against the numbers that the papers print and against each other."""

import numpy as np
import pytest

from granugas.analysis import theory

AREA_FRACTION_A = np.pi / (8 * np.sqrt(3))
ENERGY_PER_MASS = 0.5**2 / 3


def test_printed_restitutions_of_collapse():
    n_particles = np.array([97776, 22960, 5740, 1435, 378, 42])
    np.testing.assert_allclose(
        theory.collapse_restitution(n_particles, 0.227), [0.976, 0.952, 0.906, 0.821, 0.680, 0.296], atol=5e-4
    )


def test_units_of_the_papers_give_their_printed_rates():
    assert theory.enskog_rate(AREA_FRACTION_A, ENERGY_PER_MASS, 1e-3) == pytest.approx(445, abs=0.5)
    assert theory.prefactor_rate(ENERGY_PER_MASS, 1e-3) == pytest.approx(651.5, abs=0.05)
    np.testing.assert_allclose(theory.enskog_rate([0.2463, 0.2498], ENERGY_PER_MASS, 2e-3), [252, 258], rtol=2e-3)


def test_both_forms_of_the_enskog_rate_agree():
    nu, d = np.array([0.01, 0.25, 0.6]), 1e-3
    number_density = 4 * nu / (np.pi * d**2)
    by_density = 2 * d * number_density * np.sqrt(np.pi * ENERGY_PER_MASS) * theory.contact_value(nu)
    np.testing.assert_allclose(theory.enskog_rate(nu, ENERGY_PER_MASS, d), by_density, rtol=1e-13)


def test_contact_values():
    """g is within .02 % of g_4 at .227 and above it by .2 to 2.5 % up to .65."""
    excess = theory.contact_value([0.227, 0.4, 0.6, 0.65]) / theory.contact_value_dense([0.227, 0.4, 0.6, 0.65]) - 1
    np.testing.assert_allclose(excess, [2e-4, 2e-3, 1.4e-2, 2.5e-2], rtol=0.2)


def test_dilute_pressure_is_the_virial_series():
    nu = np.array([1e-3, 1e-2, 0.05])
    np.testing.assert_allclose(theory.reduced_pressure(nu) - 1, theory.virial_pressure(nu) - 1, rtol=1e-4)


def test_printed_elastic_fractions():
    rate = theory.enskog_rate(AREA_FRACTION_A, ENERGY_PER_MASS, 1e-3)
    contact_times = np.array([1e-3, 1e-4, 1e-2, 1e-5])
    np.testing.assert_allclose(theory.elastic_collision_fraction(contact_times, rate), [0.59, 0.085, 0.9999, 8.8e-3], rtol=0.01)
    n_e = theory.elastic_particle_fraction(contact_times, rate)
    np.testing.assert_allclose(n_e**2 + 2 * n_e * (1 - n_e), theory.elastic_collision_fraction(contact_times, rate))


@pytest.mark.parametrize("restitution", [0.0, 0.4, 0.99])
def test_cooling_laws_agree(restitution):
    """K(tau), K(C/N) and C/N(tau) are one law, and C/N is the integral of the rate sqrt(K)."""
    tau = np.linspace(0, 2000, 200001)
    energy = theory.homogeneous_cooling(tau, restitution)
    collisions = theory.collisions_until(tau, restitution)
    np.testing.assert_allclose(theory.energy_after_collisions(collisions, restitution), energy, rtol=1e-10)
    np.testing.assert_allclose(np.trapezoid(np.sqrt(energy), tau), collisions[-1], rtol=1e-5)


def test_nothing_cools_without_dissipation():
    tau = np.array([0.0, 1.0, 1e4])
    np.testing.assert_array_equal(theory.homogeneous_cooling(tau, 1), np.ones(3))
    np.testing.assert_array_equal(theory.collisions_until(tau, 1), tau)


def test_sonine_coefficient():
    assert theory.sonine_coefficient(1) == 0
    assert theory.sonine_coefficient(np.sqrt(0.5)) == pytest.approx(0)
    assert theory.sonine_coefficient(0) == pytest.approx(16 / 73)


def test_disks_that_have_just_collided_by_monte_carlo():
    """Pairs drawn with the rate at which they collide: their energy, and their next partners, in the shadow and outside."""
    rng = np.random.default_rng(7)
    own, others, tangential, third = rng.normal(size=(4, 2_000_000))
    angle = rng.uniform(0, np.pi, own.size)
    meet = np.maximum(own - others, 0)  # along the direction to the partner, whose speed the disk takes over
    energy = np.average((others**2 + tangential**2) / 2, weights=meet)
    assert energy == pytest.approx(theory.ENERGY_OF_ELASTIC_PARTICLES, rel=3e-3)
    mean_disk = np.maximum(own - third, 0).mean()
    again = np.maximum(others * np.cos(angle) + tangential * np.sin(angle) - third, 0) / mean_disk
    assert np.average(again, weights=meet) == pytest.approx(1.0635, rel=4e-3)
    outside = angle > np.pi / 3
    assert np.average(again * outside, weights=meet) == pytest.approx(theory.shielding(), rel=4e-3)
    places = np.array([0.5, 1.5, 2.5])
    harder = again**3 * mean_disk**3 / (np.maximum(own - third, 0) ** 3).mean()
    assert np.average(harder * outside, weights=meet) == pytest.approx(theory.loss_shielding(), rel=8e-3)
    by_angle = [np.average(again[near], weights=meet[near]) for near in (abs(angle - place) < 0.1 for place in places)]
    np.testing.assert_allclose(theory.rate_after_collision(places), by_angle, rtol=0.02)


def test_third_disks_in_touch_by_monte_carlo():
    """The room that a fourth disk gains where the surroundings of two others overlap, by points in a square."""
    rng = np.random.default_rng(7)
    points = rng.uniform(-1, 2, (1_000_000, 2))
    for angle in (np.pi / 3, 1.4, 1.8, 2.2):
        i, j, k = (np.hypot(*(points - place).T) < 1 for place in ((0, 0), (1, 0), (np.cos(angle), np.sin(angle))))
        room = 9 * np.mean(j & k & ~i)
        assert theory.triplet_excess(angle) == pytest.approx(4 / np.pi * room, abs=6e-3)


def test_shielding():
    """Its integral by small steps; 7 % of the elastic collisions of mean field are missing in the papers' gas."""
    angle = np.linspace(np.pi / 3, np.pi, 100_001)
    crowd = 1 + 0.3 * theory.triplet_excess(angle)
    by_steps = np.trapezoid(theory.rate_after_collision(angle) * crowd, angle) / np.pi
    np.testing.assert_allclose(theory.shielding([0, 0.3]), [0.916753, by_steps], rtol=1e-6)
    assert theory.shielding(AREA_FRACTION_A) == pytest.approx(0.93, abs=0.003)
    by_loss = np.trapezoid(theory.loss_after_collision(angle) * crowd, angle) / np.pi
    np.testing.assert_allclose(theory.loss_shielding([0, 0.3]), [1.089068, by_loss], rtol=1e-6)


def test_shielded_fraction_of_elastic_collisions():
    contact_time, rate = np.array([1e-9, 1.0]), 445.0
    shielded = theory.elastic_collision_fraction_shielded(contact_time, rate, 0.2)
    mean_field = theory.elastic_collision_fraction(contact_time, rate)
    np.testing.assert_allclose(shielded / mean_field, [theory.shielding(0.2), 1], rtol=1e-6)
    left = theory.dissipation_factor(contact_time, rate, 0.2)
    np.testing.assert_allclose((1 - left) / mean_field, [theory.loss_shielding(0.2), 1], rtol=1e-6)


def test_bouncing_ball_comes_to_rest():
    """v_1 = 3 m/s, g = 10 m/s^2: flights of .6, .3, .15, .075 s; t_c = .1 s."""
    np.testing.assert_allclose(theory.bounce_period(theory.bounce_speed([1, 2, 3], 0.5, 3.0), 10.0), [0.6, 0.3, 0.15])
    ratio = 0.1 / 0.6
    assert 0.5 ** theory.hits_to_rest(0.5, ratio) == pytest.approx(ratio)
    assert theory.whole_hits_to_rest(0.5, ratio) == 3
    assert theory.staying_period(0.5, ratio) * 0.6 == pytest.approx(0.075)
    assert theory.rest_time_hard(0.5) * 0.6 == pytest.approx(0.3 * 2)
    last = 0.3 + 0.15  # of the hits that dissipate
    assert theory.whole_rest_time_difference(0.5, ratio) * 0.6 == pytest.approx(0.6 - last)
    assert theory.rest_time(0.5, ratio) + theory.rest_time_difference(0.5, ratio) == pytest.approx(theory.rest_time_hard(0.5))
    assert theory.rest_time_difference(0.5, ratio) * 0.6 == pytest.approx(0.1)


@pytest.mark.parametrize("r", [0.2, 0.5, 0.9, 0.99])
def test_whole_hits_delay_rest_by_less_than_a_factor_of_r(r):
    ratio = np.geomspace(1e-8, 0.3, 500)
    by_equation_10 = theory.whole_rest_time_difference(r, ratio) / theory.rest_time_difference(r, ratio)
    assert np.all(by_equation_10 > 1 - 1e-12)
    assert np.all(by_equation_10 < 1 / r + 1e-12)
    assert np.ptp(by_equation_10) > 0.9 * (1 / r - 1)  # both bounds are reached


def test_spring_of_the_same_energy_at_rest():
    g, stiffness = 9.81, 4e4
    t_c = theory.spring_contact_time(stiffness)
    assert stiffness * (g / stiffness) ** 2 / 2 == pytest.approx(theory.spring_energy_at_rest(t_c, g))
    period = theory.PERIOD_OF_SPRING * t_c
    assert pytest.approx(1.103, abs=5e-4) == theory.PERIOD_OF_SPRING
    assert theory.resting_square_velocity(period, g) / 2 == pytest.approx(theory.spring_energy_at_rest(t_c, g))
    assert theory.resting_height(period, g) * g == pytest.approx(theory.resting_square_velocity(period, g))


def test_released_ball():
    """1 + r^2 for t_n = t_c, 2 for t_n << t_c, and for r = 1 all of the energy; in between by small steps."""
    unit = 9.81**2 / 24
    assert theory.released_square_velocity(1.0, 9.81, 0.6) == pytest.approx(1.36 * unit)
    assert theory.released_square_velocity(1.0, 9.81, 0.6, 1e-3) == pytest.approx(2 * unit)
    np.testing.assert_allclose(
        theory.released_square_velocity(1.0, 9.81, 1.0, [0.1, 1.0]), theory.resting_square_velocity(1.0, 9.81)
    )
    w = np.linspace(0, 1, 1_000_001)[1:]  # speed of the ball that falls
    r = np.where((1 + w) ** 2 / (4 * w) <= 1 / 0.9, 1, 0.6)
    by_steps = 12 * unit / 4 * np.mean(w**2 + (r * w) ** 2)
    assert theory.released_square_velocity(1.0, 9.81, 0.6, 0.9) == pytest.approx(by_steps, rel=1e-5)


@pytest.mark.parametrize("dimensions", [2, 3])
@pytest.mark.parametrize("beta", [-0.9, -0.5, 0.0, 0.5, 1.0])
@pytest.mark.parametrize("r", [1.0, 0.9, 0.5])
def test_rough_rates_are_means_over_collisions(r, beta, dimensions):
    """Velocities along n weighted by the rate of collisions; d = m = 1, temperatures 1 and 0.7."""
    rng, q, n, t_rot = np.random.default_rng(1), {2: 0.5, 3: 0.4}[dimensions], 400_000, 0.7
    u_n = np.sqrt(2) * rng.rayleigh(size=n)
    u_t = np.sqrt(2) * rng.normal(size=(dimensions - 1, n))
    rolling = np.sqrt(2 * t_rot / q) * rng.normal(size=(dimensions - 1, n))  # a (w_i + w_j) x n
    passed = q * (1 + beta) / (1 + q) / 2 * (u_t - rolling)  # momentum
    linear = -(1 - r**2) / 4 * u_n**2 + np.sum(passed**2 - passed * u_t, axis=0)
    turning = np.sum(passed**2 / q + passed * rolling, axis=0)  # a^2/I = 1/q
    a, b, c = theory.rough_rates(r, beta, dimensions)
    change_tr, change_rot = -4 / dimensions * (a - b * t_rot), 4 / theory.ROTATIONS[dimensions] * (b - c * t_rot)
    assert change_tr == pytest.approx(linear.mean() / dimensions, abs=0.004)
    assert change_rot == pytest.approx(turning.mean() / theory.ROTATIONS[dimensions], abs=0.004)


@pytest.mark.parametrize("dimensions", [2, 3])
def test_rough_temperatures_end_at_their_ratio(dimensions):
    assert theory.rough_temperature_ratio(1.0, 1.0, dimensions) == pytest.approx(1.0)  # equipartition
    for r, beta in ((0.9, 0.0), (0.9, 0.5), (0.9, -0.5), (0.4, 0.9)):
        a, b, c = theory.rough_rates(r, beta, dimensions)
        ratio = 0.0
        for _ in range(20_000):
            ratio += 0.02 * (4 / theory.ROTATIONS[dimensions] * (b - c * ratio) + 4 / dimensions * ratio * (a - b * ratio))
        assert theory.rough_temperature_ratio(r, beta, dimensions) == pytest.approx(ratio, rel=1e-6)


def test_rough_temperatures_in_the_plane():
    """Roots of B R^2 + (2C - A) R - 2B = 0 at r = .9, worked out by hand at beta = 0: A = .1169, B = .0278, C = .1111."""
    np.testing.assert_allclose(theory.rough_rates(0.9, 0.0), (0.19 / 4 + 5 / 72, 1 / 36, 1 / 9), rtol=1e-12)
    np.testing.assert_allclose(theory.rough_temperature_ratio(0.9, [0.0, 0.5, -0.5]), [0.4695, 0.7904, 0.2528], atol=1e-4)


def test_columns_on_a_wall():
    """Two beads: 3 - 2 sqrt 2; many: chi_c = pi (ICW), and the cushion model's own equation."""
    assert theory.column_restitution(2) == pytest.approx(3 - 2 * np.sqrt(2), rel=1e-14)
    assert 1e6 * (1 - theory.column_restitution(1e6)) == pytest.approx(np.pi, rel=1e-5)
    n = np.array([2, 5, 20, 1000])
    loss = 1 - theory.cushion_restitution(n)
    np.testing.assert_allclose(n * loss, np.log(4 / loss), rtol=1e-13)


@pytest.mark.parametrize(
    ("dimensions", "rate"), [(1, 2 * 0.3 / 0.7), (2, 8 * 0.3 * 0.86875 / 0.49), (3, 24 * 0.3 * 0.85 / 0.343)]
)
def test_enskog_rate_in_all_dimensions(dimensions, rate):
    """D 2^D nu g / d sqrt(kT / (pi m)), kT/m = 2 E / (D M)."""
    expected = rate / 1e-3 * np.sqrt(2 * 0.1 / dimensions / np.pi)
    assert theory.enskog_rate(0.3, 0.1, 1e-3, dimensions) == pytest.approx(expected)


def test_pressures_of_beads_and_spheres():
    assert theory.reduced_pressure(0.3, dimensions=1) == pytest.approx(1 / 0.7)
    nu = np.array([0.1, 0.3, 0.45])
    np.testing.assert_allclose(theory.reduced_pressure(nu, dimensions=3), (1 + nu + nu**2 - nu**3) / (1 - nu) ** 3)
    np.testing.assert_allclose(theory.kolafa_pressure(nu), theory.reduced_pressure(nu, dimensions=3), rtol=4e-3)
    assert (theory.kolafa_pressure(1e-4) - 1) / 1e-4 == pytest.approx(4, rel=1e-3)


def test_cooling_in_other_dimensions():
    assert theory.homogeneous_cooling(30.0, 0.5, 3) == pytest.approx((1 + 0.75 * 30 / 6) ** -2)
    for dimensions in (1, 3):
        collisions = theory.collisions_until(30.0, 0.5, dimensions)
        energy = theory.energy_after_collisions(collisions, 0.5, dimensions)
        assert energy == pytest.approx(float(theory.homogeneous_cooling(30.0, 0.5, dimensions)))
    assert [theory.energy_of_elastic_particles(d) for d in (1, 2, 3)] == [3 / 2, 5 / 4, 7 / 6]


def test_third_disks_that_are_near_by_monte_carlo():
    """Those next to one of the partners of a collision, outside the shadow of the other: all, and those that approach it."""
    rng = np.random.default_rng(7)
    own, others, tangential, third = rng.normal(size=(4, 2_000_000))
    angle = rng.uniform(0, np.pi, own.size)
    meet, outside = np.maximum(own - others, 0), angle > np.pi / 3
    nu, gap = 1e-4, 1e-3
    neighbours = 2 * (4 * nu / np.pi) * theory.contact_value(nu) * 2 * np.pi * gap  # 2 n g 2 pi d gap
    assert theory.elastic_in_company(nu, gap) / neighbours == pytest.approx(np.average(outside, weights=meet), rel=2e-3)
    approach = others * np.cos(angle) + tangential * np.sin(angle) > third
    assert theory.elastic_within(nu, gap) / neighbours == pytest.approx(np.average(approach & outside, weights=meet), rel=3e-3)
    assert theory.elastic_in_company(0.2, 10) == pytest.approx(1)


@pytest.mark.parametrize("mu", [0.2, 1e9])
def test_friction_loss_by_monte_carlo(mu):
    """Two disks that do not spin, hit by hit (Huthmann & Zippelius): energies of translation and rotation before and after."""
    rng = np.random.default_rng(7)
    u_n, u_t = 2 * np.sqrt(rng.exponential(size=1_000_000)), np.sqrt(2) * rng.normal(size=1_000_000)
    r, beta, q = 0.9, 0.5, 0.5
    impulse = np.clip(q * (1 + beta) / (2 * (1 + q)) * u_t, -mu * (1 + r) * u_n / 2, mu * (1 + r) * u_n / 2)
    after = u_t - 2 * impulse
    spin_energy = 2 * (impulse**2 / (2 * q))  # (impulse a)^2 / (2 q a^2) of each
    assert theory.friction_loss(beta, mu, r) == pytest.approx(np.mean((u_t**2 - after**2) / 4 - spin_energy), rel=5e-3)


def test_coefficients_that_depend_on_the_velocity():
    assert theory.viscoelastic_restitution(0.0, 0.3) == 1
    x = 5 / (6 * 1.15344)
    np.testing.assert_allclose(theory.viscoelastic_restitution([0.9, 1.0, 1.1], x).min(), 7 / 12, rtol=1e-12)
    np.testing.assert_allclose(theory.plastic_restitution([0.1, 0.2, 3.2], 0.8, 0.2), [0.8, 0.8, 0.4])


def test_cooling_by_velocity():
    """A constant coefficient cools by A Eq. 23; viscoelastic disks in the end as tau^(-5/3)."""
    tau = np.geomspace(0.1, 1e4, 20)
    constant = theory.cooling_by_velocity(tau, lambda speed: 0.9 + 0 * speed, 0.1)
    np.testing.assert_allclose(constant, theory.homogeneous_cooling(tau, 0.9), rtol=2e-5)
    late = theory.cooling_by_velocity([1e7, 1e8], lambda speed: theory.viscoelastic_restitution(speed, 0.1), 0.1)
    assert np.log10(late[0] / late[1]) == pytest.approx(5 / 3, abs=0.01)
