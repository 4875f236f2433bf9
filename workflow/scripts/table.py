"""Make one table: its file has a function table(data) that takes the datasets by the names of studies and experiments."""

from granugas.jobs import logged

with logged(snakemake.log[0]):
    import runpy

    from granugas.storage.dataset import read_by_name
    from granugas.storage.files import replacing

    table = runpy.run_path(snakemake.input.table)["table"](read_by_name(snakemake.input.data))
    with replacing(snakemake.output[0]) as path:
        table.to_csv(path, index=False)
