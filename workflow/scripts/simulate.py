"""Let one run cool; its positions at the sampling times go to a file of their own."""

from granugas.jobs import logged

with logged(snakemake.log[0]):
    from dataclasses import asdict

    from granugas.simulate import simulate
    from granugas.storage.dataset import read, write, write_positions

    run, output = snakemake.params.run, snakemake.output
    data = simulate(
        run.scene,
        run.until,
        seed=run.seed,
        realization=run.realization,
        samples=run.samples,
        snapshots=run.snapshots,
        state=read(snakemake.input.state),
        keep_positions=run.keep_positions,
    )
    if run.keep_positions:
        write_positions(data, output.positions)
    write(data.drop_vars("trajectory", errors="ignore"), output.run, parameters=asdict(run))
