"""Make the start states that all runs of the same realizations share."""

from granugas.jobs import logged

with logged(snakemake.log[0]):
    from granugas.execute import start_states
    from granugas.storage.dataset import write

    write(start_states(snakemake.params.run), snakemake.output[0])
