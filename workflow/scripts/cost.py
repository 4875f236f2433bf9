"""Make the table of what every job took, from the records that jobs leave beside their logs."""

from granugas.jobs import logged

with logged(snakemake.log[0]):
    from granugas.cost import entries, write_table

    write_table(snakemake.output[0], entries(snakemake.params.results), snakemake.params.studies)
