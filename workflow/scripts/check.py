"""Check the physics of every study; what is broken fails the job and stands in its log."""

from granugas.jobs import logged

with logged(snakemake.log[0]):
    from pathlib import Path

    from granugas.checks import findings
    from granugas.storage.dataset import read
    from granugas.storage.files import replacing

    found = [f"{Path(path).stem}: {line}" for path in snakemake.input for line in findings(read(path))]
    if found:
        raise ValueError("; ".join(found))
    with replacing(snakemake.output[0]) as path:
        path.write_text(f"{len(snakemake.input)} studies, no finding\n")
