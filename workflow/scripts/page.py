"""Turn a table into a page of the report."""

from granugas.jobs import logged

with logged(snakemake.log[0]):
    import pandas as pd

    from granugas.report import table_page
    from granugas.storage.files import replacing

    page = table_page(pd.read_csv(snakemake.input.table), snakemake.params.title)
    with replacing(snakemake.output[0]) as path:
        path.write_text(page, encoding="utf-8")
