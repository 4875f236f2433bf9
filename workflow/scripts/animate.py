"""Film a run at its sampling times."""

from granugas.jobs import logged

with logged(snakemake.log[0]):
    from granugas.plotting.animation import render
    from granugas.storage.positions import read_positions

    with read_positions(snakemake.input.positions) as run:
        render(run, snakemake.output[0], snakemake.params.colour)
