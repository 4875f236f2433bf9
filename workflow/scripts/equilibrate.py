"""Make the start states that all runs of the same realizations share."""

from granugas.jobs import logged

with logged(snakemake.log[0]) as spent:
    from granugas.execute import collisions_before, start_states
    from granugas.storage.dataset import write

    states = start_states(snakemake.params.run)
    spent.collisions = collisions_before(states)
    write(states, snakemake.output[0])
