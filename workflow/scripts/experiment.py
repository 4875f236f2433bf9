"""Make one experiment: a module of granugas.experiments with a function measure(), and perhaps a SMALL plan for it."""

from granugas.jobs import logged

with logged(snakemake.log[0]):
    from importlib import import_module

    from granugas.storage.dataset import write

    name, small = snakemake.wildcards.experiment, snakemake.params.small
    experiment = import_module(f"granugas.experiments.{name}")
    plan = [experiment.SMALL] if small and hasattr(experiment, "SMALL") else []
    write(experiment.measure(*plan), snakemake.output[0], parameters={"experiment": name, "small": bool(plan)})
