"""Find the clusters of a run at its sampling times, for all S_c at once."""

from granugas.jobs import logged

with logged(snakemake.log[0]):
    from granugas.analysis.clusters import clusters_of_run
    from granugas.storage.dataset import read_positions, write

    with read_positions(snakemake.input.positions) as run:
        write(clusters_of_run(run, snakemake.params.distance_factors), snakemake.output[0])
