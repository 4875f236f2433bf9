"""Put the configuration and the versions of everything on a page of the report."""

from granugas.jobs import logged

with logged(snakemake.log[0]):
    import json
    from importlib.metadata import version

    from granugas.report import configuration_page
    from granugas.storage.dataset import read_by_name
    from granugas.storage.files import replacing

    origins = [json.loads(data.attrs["provenance"]) for data in read_by_name(snakemake.input.data).values()]
    used = ("granugas", "numpy", "xarray", "pandas", "matplotlib", "snakemake")
    page = configuration_page(snakemake.params.config, origins, {name: version(name) for name in used})
    with replacing(snakemake.output[0]) as path:
        path.write_text(page, encoding="utf-8")
