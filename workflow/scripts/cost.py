"""Make the table of what every job took, from the records that jobs leave beside their logs."""

from granugas.jobs import logged

with logged(snakemake.log[0]):
    from pathlib import Path

    from granugas.cost import entries, write_table

    table = Path(snakemake.output[0])
    write_table(table, entries(table.parent), snakemake.params.studies)
