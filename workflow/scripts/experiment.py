"""Make one experiment: a module of granugas.experiments with a function measure()."""

from granugas.jobs import logged

with logged(snakemake.log[0]):
    from importlib import import_module

    from granugas.storage.dataset import write

    name = snakemake.wildcards.experiment
    write(import_module(f"granugas.experiments.{name}").measure(), snakemake.output[0], parameters={"experiment": name})
