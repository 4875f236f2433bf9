"""Draw one figure: its file has a function draw(data) that takes the datasets by the names of studies and experiments."""

from granugas.jobs import logged

with logged(snakemake.log[0]):
    import runpy

    from granugas.plotting.style import save
    from granugas.storage.dataset import read_by_name

    figure = runpy.run_path(snakemake.input.drawing)["draw"](read_by_name(snakemake.input.data))
    save(figure, snakemake.output.png, snakemake.output.pdf)
