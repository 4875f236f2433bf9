# Equilibration -> dissipative runs over grids -> cluster analysis -> figures.
# The configuration is described in config/README.md, the house in ARCHITECTURE.md.
import os

from snakemake.utils import min_version

min_version("9.0")


configfile: "config/config.yaml" if os.path.exists("config/config.yaml") else f"{workflow.basedir}/config/config.yaml"


report: "workflow/report/workflow.rst"


include: "workflow/rules/common.smk"


rule all:
    input:
        figures(with_costs=False),
        figures(with_costs=True),
        tables(),
        [f"{OUTPUT}/cost.csv"] if STUDIES.all_wanted else [],
        animations(),
        explorer(),
        REMOVED,


include: "workflow/rules/simulate.smk"
include: "workflow/rules/analyse.smk"
include: "workflow/rules/figures.smk"
include: "workflow/rules/report.smk"


onstart:
    begin(planned(workflow.dag))


onsuccess:
    print(f"Done: the datasets are in {OUTPUT}/studies, the figures in {OUTPUT}/figures.")
    print(costs())


onerror:
    print(failures(planned(workflow.dag), STARTED, finals=["figure", "table", "claims", "explorer", "pool", "check"]))
    print(costs())
