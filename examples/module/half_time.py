"""When half of the energy is gone: a row for each coefficient of restitution."""

import granugas as gg

study = gg.load_study(snakemake.input[0])
energy = study["kinetic_energy"].mean("realization")
time = study["sampling_time"].mean("realization").where(energy <= 0.5).min("time")
time.rename("half_time").to_series().to_csv(snakemake.output[0])
