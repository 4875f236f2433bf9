"""Pool the runs of a study, each with its clusters, into one dataset."""

from granugas.jobs import logged

with logged(snakemake.log[0]):
    import xarray as xr

    from granugas.storage.dataset import pool, read, tell_stops, with_errors, write

    runs = [read(path) for path in snakemake.input.runs]
    clusters = [read(path) for path in snakemake.input.clusters] or [xr.Dataset()] * len(runs)
    parts = [run.merge(found, combine_attrs="override") for run, found in zip(runs, clusters, strict=True)]
    pooled = pool(parts, snakemake.params.grid_keys)
    tell_stops(pooled)
    write(with_errors(pooled), snakemake.output[0])
