"""Put runs into a page to explore."""

from granugas.jobs import logged

with logged(snakemake.log[0]):
    from granugas.explorer import Source, write_explorer

    files = zip(
        snakemake.params.labels, snakemake.input.positions, snakemake.input.runs, snakemake.params.clusters, strict=True
    )
    write_explorer([Source(*paths) for paths in files], snakemake.output[0])
