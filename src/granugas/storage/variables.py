"""The one table of everything that a dataset can hold.

A and B in `equation` are the papers: A = Luding & McNamara, Granular Matter 1 (1998) 113; B = Luding & Herrmann,
Chaos 9 (1999) 673. The dimensions are, as far as a variable has them: the grid keys and `realization` (in pooled data),
`time` or `snapshot`, `distance_factor`, `cluster_size`, `particle`, `axis`. In pooled data `<variable>_error` stands beside a
variable of the table (`variable_of`).
"""

from typing import NamedTuple

import xarray as xr


class Variable(NamedTuple):
    """What a variable means; all but an empty text becomes its attributes.

    Attributes:
        units: as CF writes them, "1" for a pure number, None for texts.
        long_name: in words.
        symbol: in the papers, or with their letters.
        equation: where it is defined.
    """

    units: str | None
    long_name: str
    symbol: str = ""
    equation: str = ""

    def attributes(self) -> dict[str, str]:
        """The attributes of such a variable in a dataset."""
        return {name: text for name, text in self._asdict().items() if text}


_INTERVAL = "over the interval since the sample before"

ERROR = "_error"
"""End of the name of a variable's standard error of the mean over realizations."""

VARIABLES = {
    # the grid of a study: what a scene is made of
    "n_particles": Variable("1", "number of particles", "N"),
    "area_fraction": Variable(
        "1", "area fraction of the particles, in 3D their volume fraction", "nu = N pi d^2 / (4 V)", "A Eq. 16, B section 3"
    ),
    "restitution": Variable("1", "coefficient of restitution", "r", "A Eq. 3"),
    "contact_time": Variable("s", "contact duration of the TC model", "t_c", "A Eq. 4"),
    "diameter": Variable("m", "diameter of the particles", "d = 2 a"),
    "velocity_half_width": Variable("m s-1", "half width of the start distribution of velocity components", "w"),
    "dynamics": Variable(None, "method that moves the particles"),
    "lattice": Variable(None, "start lattice"),
    "dimensions": Variable("1", "dimensions of space", "D"),
    "boundary": Variable(None, "boundary of the box"),
    "aspect_ratio": Variable("1", "ratio of the sides of the box", "L_x / L_y"),
    "tangential_restitution": Variable("1", "coefficient of tangential restitution", "beta"),
    "friction": Variable("1", "coefficient of Coulomb friction", "mu"),
    "sizes": Variable(None, "distribution of the diameters"),
    "size_ratio": Variable("1", "diameter of a large particle by that of a small one, bidisperse particles"),
    "size_share": Variable("1", "share of large particles in the number of all, bidisperse particles"),
    "size_spread": Variable("1", "half width (uniform) or standard deviation (log-normal) of the diameters by their mean"),
    "heating": Variable("m2 s-3", "energy by mass and time that random kicks put in"),
    "wall_restitution": Variable("1", "coefficient of restitution at the walls", "r", "A Eq. 3"),
    "wall_contact_time": Variable("s", "contact duration of the TC model at the walls", "t_c", "A Eq. 4"),
    "floor": Variable(None, "motion of the floor"),
    "floor_amplitude": Variable("m", "amplitude of the motion of the floor", "A"),
    "floor_frequency": Variable("s-1", "frequency of the motion of the floor", "f"),
    "material": Variable(None, "what decides the coefficient of restitution of two particles alone", "", "A section 3"),
    "viscosity": Variable("1", "viscosity of viscoelastic particles in (s/m)^(1/5)", "A", "A section 3"),
    "yield_velocity": Variable("m s-1", "normal relative velocity above which contacts are plastic", "u_y", "A section 3"),
    "contact_time_exponent": Variable("1", "exponent of a contact duration that depends on velocity", "alpha", "A section 3"),
    "contact_velocity": Variable("m s-1", "normal relative velocity at which it is the contact time", "v_0", "A section 3"),
    "critical_distance": Variable("m", "gap to a third particle below which collisions are elastic", "eps_c", "A section 3"),
    "rotation_angle": Variable("degree", "largest rotation of the relative velocity after a collision", "", "A section 3"),
    "kick_velocity": Variable("m s-1", "velocity of parting below which partners are kicked", "", "A section 3"),
    "kick_energy": Variable("m2 s-2", "largest energy of a kick by the mass of a particle", "", "A section 3"),
    "internal_modes": Variable("1", "number of internal modes of a particle", "n", "A section 3"),
    "mode_damping": Variable("s-1", "rate at which the energy of internal modes falls", "gamma", "A section 3"),
    "lrv_velocity": Variable("m s-1", "relative velocity below which contacts of beads merge into clusters", "", "A section 3"),
    "steps_per_contact": Variable("1", "steps of the integration in a contact of two soft spheres", "t_c / dt"),
    "particles_per_cell": Variable("1", "mean number of particles in a cell of direct simulation Monte Carlo"),
    # its start state
    "box_x": Variable("m", "side of the box along x", "L_x"),
    "box_y": Variable("m", "side of the box along y", "L_y"),
    "box_z": Variable("m", "side of the box along z", "L_z"),
    "lattice_kind": Variable(None, "start lattice that was taken"),
    "lattice_columns": Variable("1", "columns of the start lattice"),
    "lattice_rows": Variable("1", "rows of the start lattice"),
    "lattice_layers": Variable("1", "layers of the start lattice"),
    "branch": Variable(None, "branch of the equation of state: fluid, or the crystal that the start lattice was"),
    "equilibration_collisions_per_particle": Variable(
        "1", "collisions of a particle before t = 0, counted for both partners", "C/N", "A section 5.3"
    ),
    "equilibration_kurtosis": Variable(
        "1", "kurtosis of the velocity components at t = 0 by its value in equilibrium", "<v^4> / <v^2>^2"
    ),
    "equilibration_anisotropy": Variable(
        "1", "difference of the energies along x and y at t = 0, or of the two axes where it is the largest", "(E_x - E_y)/E"
    ),
    "equilibration_order": Variable("1", "what is left of the start lattice at t = 0", "|sum exp(ikr)|^2 / N"),
    "equilibration_reached": Variable("1", "whether the start state is in equilibrium: 1, or not: 0"),
    # coordinates
    "realization": Variable("1", "number of the realization"),
    "time": Variable("s", "time since dissipation began", "t"),
    "sampling_time": Variable("s", "time since dissipation began, at the samples of the run", "t"),
    "snapshot": Variable("s", "time of the snapshot", "t"),
    "axis": Variable(None, "axis of space"),
    "distance_factor": Variable("1", "distance factor of the cluster criterion", "S_c", "B Eq. 6"),
    "cluster_size": Variable("1", "number of particles in a cluster, lower edge of the bin", "M"),
    "cluster_size_upper": Variable("1", "upper edge of the bin of cluster sizes, itself outside"),
    # one number at each sample
    "tau": Variable("1", "time in units of the initial Enskog collision time", "tau = t / t_E(0)", "A Eq. 19, B Eq. 2"),
    "kinetic_energy": Variable("1", "kinetic energy by its initial value", "K = E/E(0) (A: T)", "A Eq. 23, B Eq. 1"),
    "kinetic_energy_x": Variable("1", "kinetic energy of motion along x by the initial energy", "K_x", "B section 3"),
    "kinetic_energy_y": Variable(
        "1", "kinetic energy of motion along y by the initial energy", "K_y (B: K_z), K = K_x + K_y", "B section 3"
    ),
    "kinetic_energy_z": Variable("1", "kinetic energy of motion along z by the initial energy", "K_z, K = K_x + K_y + K_z"),
    "collisions_per_particle": Variable(
        "1",
        "collisions of a particle since t = 0, counted for both partners",
        "C/N (A: C_t/N)",
        "A section 5.3, B Eq. 4",
    ),
    "elastic_collisions_per_particle": Variable(
        "1", "elastic collisions of a particle since t = 0, counted for both partners", "C_e/N", "A Eq. 4, B Fig. 3"
    ),
    "collision_rate": Variable("s-1", f"collision rate of a particle {_INTERVAL}", "C_r = 2 C / (N dt)", "A Eq. 18"),
    "elastic_collision_fraction": Variable(
        "1", f"fraction of collisions that are elastic {_INTERVAL}", "c_e = C_e/C", "A Eq. 21"
    ),
    "elastic_particle_fraction": Variable(
        "1", "fraction of particles whose last collision was no longer than t_c ago", "n_e = N_e/N", "A Eq. 20"
    ),
    "elastic_particle_time_fraction": Variable(
        "1", f"fraction of elastic particles, exact time average {_INTERVAL}", "<N_e>/N", "A section 5.4"
    ),
    "elastic_energy_fraction": Variable(
        "1", "fraction of the kinetic energy that elastic particles carry", "e_e = E_e/E", "A section 5.4"
    ),
    "reduced_pressure": Variable("1", f"reduced pressure {_INTERVAL}", "P_0 = P V/E = P V/(N k T)", "A Eq. 16"),
    "internal_energy": Variable("1", "energy of the internal modes by the initial kinetic energy", "E_int/E(0)", "A section 3"),
    **{
        f"collisional_stress_{a}{b}": Variable(
            "1",
            f"collisional stress, component {a}{b}, times V/E, {_INTERVAL}",
            f"sigma_{a}{b} V/E, P_0 = 1 + (sigma_xx + sigma_yy + sigma_zz) V/(2 E)",
            "A Eq. 15",
        )
        for a in "xyz"
        for b in "xyz"
    },
    "rotational_energy": Variable("1", "rotational energy by the initial kinetic energy", "E_rot/E(0)"),
    "temperature_ratio": Variable("1", "rotational by translational temperature", "R = T_rot/T_tr"),
    "species_temperature_ratio": Variable(
        "1",
        "mean kinetic energy of particles above the mean mass (bidisperse: the large ones) by that of the others",
        "T_l / T_s",
    ),
    "heating_power": Variable("m2 s-3", f"energy by mass and time that random kicks put in, {_INTERVAL}"),
    # where there are walls, gravity, or a floor in motion
    "wall_pressure": Variable("1", f"reduced pressure on the walls {_INTERVAL}", "P V / (N k T)", "A Eq. 16"),
    "wall_collisions_per_particle": Variable("1", "collisions of a particle with walls since t = 0"),
    "potential_energy": Variable(
        "1", "potential energy by the initial kinetic energy, 0 for particles on the floor", "E_p/E(0)", "A section 4.2.1"
    ),
    "elastic_energy": Variable("1", "elastic energy of the overlaps of soft spheres by the initial kinetic energy", "V/E(0)"),
    "floor_force": Variable("1", f"momentum that the floor takes up in unit time, by the weight, {_INTERVAL}", "f / (N m g)"),
    "floor_energy": Variable("1", "energy that the floor has given to the particles since t = 0, by E(0)"),
    "dissipated_energy": Variable("1", "energy that has been dissipated since t = 0, by E(0)"),
    # clusters
    "cluster_count": Variable("1", "number of clusters, single particles included", "I_c", "B Eq. 6"),
    "mean_cluster_size": Variable("1", "mean number of particles in a cluster", "<M> = N/I_c", "B Eq. 7"),
    "weighted_cluster_size": Variable("1", "mean size of the cluster that a particle is in", "sum M_i^2 / N"),
    "largest_cluster_size": Variable("1", "number of particles in the largest cluster", "M_max", "B section 5"),
    "cluster_size_distribution": Variable("1", "number of clusters in the bin of sizes", "n(M)", "B section 6"),
    # one value a particle
    "particle_diameter": Variable("m", "diameter of a particle", "d_i", "B Eq. 6"),
    "particle_mass": Variable("1", "mass of a particle by the mean mass", "m_i / m"),
    "position": Variable("m", "position of a particle in the box", "r_i"),
    "trajectory": Variable("m", "position of a particle in the box at the sampling times", "r_i"),
    "trajectory_velocity": Variable("m s-1", "velocity of a particle at the sampling times, rounded", "v_i"),
    "trajectory_collisions": Variable("1", "collisions of a particle since t = 0 at the sampling times, -1 after the end"),
    "velocity": Variable("m s-1", "velocity of a particle in the frame of the centre of mass", "v_i"),
    "spin": Variable("s-1", "angular velocity of a particle, in 2D out of the plane", "omega_i"),
    "initial_y": Variable("m", "position of a particle along y at t = 0", "y_i(0)", "B Fig. 6"),
    "last_collision_time": Variable(
        "s", "time of a particle's last collision, negative before dissipation began", "t_n^(i)", "A Eq. 4"
    ),
    "last_collision_interval": Variable("s", "time between the last two collisions of a particle", "t_n^(i)", "A Eq. 4"),
    "collision_frequency": Variable("s-1", "collision frequency of a particle", "C_r^(i)", "A Fig. 10, B Fig. 5"),
    # one value a run
    "enskog_rate": Variable("s-1", "Enskog collision rate at t = 0", "1/t_E(0)", "A Eq. 19, B Eq. 2"),
    "seed": Variable("1", "seed of the study's random numbers"),
    "wall_time": Variable("s", "time that the run took"),
    "cpu_time": Variable("s", "processor time that the run took, summed over its attempts"),
    "events": Variable("1", "collisions of pairs that were carried out since t = 0", "C"),
    "stop_reason": Variable(None, "what ended the run"),
    "stop_time": Variable("s", "time at which the run ended", "t"),
    "warnings": Variable(None, "what to doubt about the run, one line each"),
    # two particles that meet, and one ball on a plate; energies and forces per mass
    "experiment_time": Variable("s", "time since the experiment began", "t"),
    "soft_position": Variable("m", "positions of two soft particles in one dimension", "x_i", "A Fig. 1"),
    "hard_position": Variable("m", "positions of two hard particles in one dimension", "x_i", "A Fig. 1"),
    "contact_begin": Variable("s", "beginning of the soft contact", "t", "A Fig. 1"),
    "contact_end": Variable("s", "end of the soft contact", "t", "A Fig. 1"),
    "collision_time": Variable("s", "time of the hard collision", "t", "A Fig. 1"),
    "gravity": Variable("m s-2", "gravitational acceleration", "g"),
    "first_period": Variable("s", "flight that ends with the first hit", "t_1 = 2 v_1/g", "A Eq. 6"),
    "contact_ratio": Variable("1", "contact duration by the flight before the first hit", "t_c / t_1"),
    "hits_to_rest": Variable("1", "hits that dissipate, TC model", "n_s", "A Eq. 7"),
    "rest_time": Variable("s", "time from the first hit to the last that dissipates, TC model", "t_s", "A Eq. 9"),
    "rest_time_hard": Variable("s", "time from the first hit to the collapse, IHS model", "t_s", "A Eq. 8"),
    "rest_time_difference": Variable("s", "how much earlier the ball of the TC model rests", "Delta t_s", "A Eq. 10"),
    "hits_to_collapse": Variable("1", "hits until double precision resolves no flight, IHS model", "n"),
    "speed_at_collapse": Variable("m s-1", "speed after the last resolved hit, IHS model", "v"),
    "staying_period": Variable("s", "period of the ball at rest, TC model", "t_inf", "A section 4.2.1"),
    "window": Variable("1", "length of an average by the staying period", "Delta t / t_inf", "A Eq. 11"),
    "window_end": Variable("1", "phase at which an average ends, by the staying period", "t / t_inf", "A Eq. 11"),
    "mean_velocity": Variable("m s-1", "mean velocity of the ball at rest", "<v>", "A section 4.2.1"),
    "mean_square_velocity": Variable("m2 s-2", "mean square velocity of the ball at rest", "<v^2>", "A section 4.2.1"),
    "elastic_square_velocity": Variable(
        "m2 s-2", "the part of it within t_c after a hit", "2 E_e / m", "A sections 4.1 and 4.2.1"
    ),
    "mean_height": Variable("m", "mean height of the ball at rest", "<h>", "A section 4.2.1"),
    "plate_force": Variable("1", "momentum that the plate takes in unit time, by the weight", "f / (m g)", "A section 4.2.1"),
    "released_square_velocity": Variable(
        "m2 s-2", "mean square velocity after gravity is switched off at a random phase", "<v^2>_{g=0}", "A section 4.2.3"
    ),
    "height_hard": Variable("m", "height of the ball, IHS model", "h", "A Fig. 2"),
    "height_contact_time": Variable("m", "height of the ball, TC model", "h", "A Fig. 2"),
    "height_soft": Variable("m", "height of a soft ball, negative in contact", "h", "A section 4.2.2"),
    "soft_kinetic_energy": Variable("m2 s-2", "kinetic energy of the soft ball at rest", "E", "A table 1"),
    "soft_elastic_energy": Variable("m2 s-2", "elastic energy of the soft ball at rest", "E_el = V(h_0)", "A section 4.2.2"),
    "soft_potential_energy": Variable("m2 s-2", "potential energy of the soft ball at rest", "E_p = m g h", "A table 1"),
    "soft_force": Variable(
        "1", "force of the soft ball at rest on the plate, by the weight", "k h_0 / (m g)", "A section 4.2.2"
    ),
    "soft_contact_time": Variable("s", "contact duration of its spring without dashpot", "t_c^el", "A Eq. 12"),
    # pressure in test volumes
    "test_volumes": Variable("1", "number of equal test volumes that the box is cut into", "V / V_c", "A section 5.1"),
    "averaging_interval": Variable("1", "time of an average by the length of the record", "Delta t", "A Eq. 15"),
    "interval_collisions": Variable("1", "collisions of a particle in the time of an average", "C_r Delta t", "A Eq. 18"),
    "kinetic_pressure": Variable("1", "kinetic pressure of test volumes, mean, by E/V of the box", "P V/E", "A Eq. 14"),
    "streaming_pressure": Variable("1", "pressure of the mean motion of test volumes, by E/V of the box", "P V/E", "A Eq. 14"),
    "collisional_pressure": Variable("1", "collisional pressure of test volumes, mean, by E/V of the box", "P V/E", "A Eq. 15"),
    "tally_pressure": Variable("1", "collisional pressure of the box by the engine's own sums, by E/V", "P V/E", "A Eq. 15"),
    "pressure_spread": Variable("1", "standard deviation of the pressure over test volumes by its mean", "sigma_P / <P>"),
    "pressure_map": Variable("1", "pressure of each test volume, by E/V of the box", "P V/E", "A section 5.1"),
    "pressure_series": Variable("1", "pressure of one test volume in equal steps, by E/V of the box", "P V/E", "A section 5.1"),
    "record_begin": Variable("s", "time since t = 0 at which the record begins", "t"),
    "record_length": Variable("s", "length of the record"),
    # the last collisions before an inelastic collapse
    "collisions_left": Variable("1", "collisions of the disks that take part in the collapse, counted back from the last"),
    "time_left": Variable("s", "time that is left to the inelastic collapse", "t* - t", "A section 2.1"),
    "disks_involved": Variable("1", "number of disks that take part in the collapse"),
    # trajectories that begin alike
    "change": Variable(None, "what a copy differs in at the start: last bit of the positions, or order of the particles"),
    "copy": Variable("1", "number of the copy"),
    "stop": Variable("1", "number of the look"),
    "separation": Variable("1", "distance of a copy from its run, root mean square over the particles, by the diameter"),
    "copy_kinetic_energy": Variable("1", "kinetic energy of a copy by its initial value", "K = E/E(0)"),
    "copy_collisions_per_particle": Variable("1", "collisions of a particle in a copy since t = 0", "C/N"),
    # a column of beads that hits a wall
    "wall": Variable(None, "coefficient of restitution of the wall"),
    "critical_restitution": Variable("1", "coefficient of restitution below which a column collapses", "r_c", "A section 2.1"),
    "depth": Variable("1", "dissipation of a contact by the critical one", "(1 - r)/(1 - r_c)", "A section 2.1"),
    "column_collisions": Variable("1", "collisions of the beads of a column with each other until they have parted", "C"),
    "energy_left": Variable("1", "kinetic energy of a column after its impact by the one before", "E/E(0)"),
    "impact_interval": Variable("1", "time from impact to impact of the beads of a column by the contact time", "s/(v t_c)"),
    # every collision model from one start
    "model": Variable(None, "collision model"),
    "place": Variable(None, "where it is asked whether it collapses"),
    "collapse_time": Variable("s", "time of the inelastic collapse, infinite where there was none", "t*", "A section 2.1"),
    "place_collisions": Variable("1", "collisions of a particle until the end of the run", "C/N"),
    # effects and models, one by one
    "effect": Variable(None, "effect or model"),
    "scene_keys": Variable(None, "keys by which a scene names the effect, beyond elastic disks"),
    "check": Variable(None, "number that is compared with theory"),
    "momentum_drift": Variable("1", "change of the momentum along axes without walls, by N v_rms"),
    "energy_balance": Variable("1", "change of all energy, what was lost or put in included, by E(0)"),
    "measured": Variable("1", "number that was measured"),
    "expected": Variable("1", "what theory expects of it"),
    "allowed": Variable("1", "largest difference of the two that is in agreement"),
    "code_lines": Variable("1", "lines of code that are the effect, without comments and docstrings"),
    "repetition": Variable("1", "number of the repetition"),
    "cpu_per_collision": Variable("ns", "processor time of a collision"),
    "statistic": Variable("1", "statistic of the rounds that were timed"),
    "cpu_by_size": Variable("ns", "processor time of a collision of elastic disks"),
    "cpu_by_area_fraction": Variable("ns", "processor time of a collision of elastic disks"),
    "cpu_by_contact_time": Variable("ns", "processor time of a collision in a whole run"),
    "cpu_while_clustering": Variable("ns", "processor time of a collision since the time before"),
    "run_collisions": Variable("1", "collisions of a particle in a whole run", "C/N"),
    "cpu_added": Variable("ns", "processor time of a collision beyond that of elastic disks in the same repetition"),
    # what accuracy costs: a knob, its settings, and the error that each leaves
    "case": Variable(None, "gas, or way of measuring, in which the knob is turned"),
    "setting": Variable(None, "setting of the knob that the attribute `knob` names, in its unit"),
    "observable": Variable(None, "what is compared with the truth"),
    "measured_error": Variable("1", "standard error of the number that was measured"),
    "truth": Variable("1", "value that the number should have, as well as it is known"),
    "truth_error": Variable("1", "standard error of the truth"),
    "relative_error": Variable("1", "difference from the truth by the truth"),
    "relative_error_error": Variable("1", "standard error of the relative error, that of the truth included"),
    "measured_spread": Variable("1", "standard deviation of the number in one run"),
    "relative_spread": Variable("1", "standard deviation of one run by the truth"),
    "exponents": Variable("1", "exponent of <M>"),
    "window_shift": Variable("1", "factor by which both ends of a fit window are moved"),
    "cpu_seconds": Variable("s", "processor time of a run with this setting, median, compilation apart"),
    "first_difference": Variable("1", "collision of pairs at which the order first differs from that of strict arithmetic"),
    "smallest_gap": Variable("1", "least distance of two disks at their collision less the diameter, by the diameter"),
    "rms_gap": Variable("1", "distance of two disks at their collision less the diameter, root mean square, by the diameter"),
}


def variable_of(name: str) -> Variable:
    """The row of a variable; of `<variable>_error` what follows from the row of the variable itself.

    Raises:
        KeyError: a variable that is not in `VARIABLES`.
    """
    if name in VARIABLES:
        return VARIABLES[name]
    if name.endswith(ERROR) and name.removesuffix(ERROR) in VARIABLES:
        units, long_name, symbol, _ = VARIABLES[name.removesuffix(ERROR)]
        return Variable(units, f"standard error of the mean over realizations: {long_name}", symbol and f"error of {symbol}")
    raise KeyError(f"{name}: no such variable in the table of storage/variables.py")


def describe(dataset: xr.Dataset) -> xr.Dataset:
    """The dataset with `units`, `long_name`, `symbol` and `equation` on every variable; other attributes stay.

    Where `sampling_time` holds the times, `time` is described as an index.

    Raises:
        KeyError: a variable that is not in `VARIABLES`.
    """
    described = dataset.copy()
    for name in described.variables:
        variable = variable_of(str(name))
        if name == "time" and "sampling_time" in described:
            variable = Variable("1", "index of the sample")
        described[name].attrs.update(variable.attributes())
    return described
