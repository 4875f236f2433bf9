"""Judge the claims of the papers: each file of workflow/claims has a list CLAIMS."""

from granugas.jobs import logged

with logged(snakemake.log[0]):
    import runpy

    from granugas.claims import judge, page
    from granugas.storage.dataset import read_by_name
    from granugas.storage.files import replacing

    claims = [claim for path in snakemake.input.claims for claim in runpy.run_path(path)["CLAIMS"]]
    verdicts = judge(claims, read_by_name(snakemake.input.data))
    with replacing(snakemake.output.table) as path:
        verdicts.to_csv(path, index=False)
    with replacing(snakemake.output.page) as path:
        path.write_text(page(verdicts))
