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
