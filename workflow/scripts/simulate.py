"""Let one run cool; its positions at the sampling times go to a file of their own."""

from granugas.jobs import logged

with logged(snakemake.log[0]) as spent:
    from dataclasses import asdict

    from granugas.execute import perform, start_states
    from granugas.storage.checkpoint import checkpoints_of
    from granugas.storage.dataset import read_or_make, write, write_positions

    run, output, keeping = snakemake.params.run, snakemake.output, snakemake.params.keeping
    checkpoints = checkpoints_of(run, snakemake.params.checkpoints, snakemake.params.physics, keeping.checkpoint_seconds)
    states = read_or_make(snakemake.input.state, lambda: start_states(run))
    data = perform(run, states, checkpoints, keeping.max_seconds)
    spent.collisions = int(data["events"].sum())
    if run.keep_positions:
        write_positions(data, output.positions)
    of_the_run = data.drop_vars([name for name in data if name.startswith("trajectory")])
    write(of_the_run, output.run, parameters=asdict(run))
    if "max_seconds" not in data["stop_reason"].values:
        for checkpoint in checkpoints.values():
            checkpoint.remove()
