"""Make the start state that all runs of one realization share."""

from granugas.jobs import logged

with logged(snakemake.log[0]):
    from granugas.equilibrate import equilibrate
    from granugas.storage.dataset import write

    run = snakemake.params.run
    state = equilibrate(run.scene, seed=run.seed, realization=run.realization, collisions_per_particle=run.equilibration)
    write(state, snakemake.output[0])
