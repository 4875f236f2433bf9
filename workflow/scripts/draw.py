"""Draw one figure: its file has a function draw(data) that takes the datasets by the names of their studies."""

from granugas.jobs import logged

with logged(snakemake.log[0]):
    import runpy

    from granugas.plotting import save
    from granugas.storage.dataset import read

    data = dict(zip(snakemake.params.names, map(read, snakemake.input.studies), strict=True))
    figure = runpy.run_path(snakemake.input.drawing)["draw"](data)
    save(figure, snakemake.output.png, snakemake.output.pdf)
