# Pages that only the report has: tables to sort and search, the configuration and the versions. `make report` asks for them.
PAGES = {name: placed(f"workflow/tables/{name}.py", f"{name}.csv") for name in TABLES}
PAGES["cost"] = {"category": "Cost", "labels": labelled("cost.csv", "What every job took")}
if CLAIMS:
    PAGES["claims"] = {"category": "Claims", "labels": labelled("claims.csv", "What the papers claim, and whether it holds")}


rule page:
    input:
        table=f"{OUTPUT}/{{table}}.csv",
    output:
        report(
            f"{OUTPUT}/report/{{table}}.html",
            caption="../report/table.rst",
            category=lambda wildcards: PAGES[wildcards.table]["category"],
            subcategory=lambda wildcards: PAGES[wildcards.table].get("subcategory"),
            labels=lambda wildcards: PAGES[wildcards.table]["labels"],
        ),
    log:
        f"{OUTPUT}/logs/report/{{table}}.log",
    params:
        title=lambda wildcards: PAGES[wildcards.table]["labels"]["shows"],
        layout=digest.digest(["granugas.report"]),
    wildcard_constraints:
        table="|".join(PAGES),
    script:
        "../scripts/page.py"


rule configuration:
    input:
        data=expand(f"{OUTPUT}/studies/{{study}}.nc", study=STUDIES.studies),
    output:
        report(
            f"{OUTPUT}/report/configuration.html",
            caption="../report/configuration.rst",
            category="Configuration",
            labels=labelled("configuration", "Every key that was set, and the versions of everything"),
        ),
    log:
        f"{OUTPUT}/logs/report/configuration.log",
    params:
        config=config,
        layout=digest.digest(["granugas.report"]),
    script:
        "../scripts/configuration.py"


rule pages:
    input:
        rules.all.input,
        expand(f"{OUTPUT}/report/{{page}}.html", page=[*PAGES, "configuration"] if STUDIES.all_wanted else ["configuration"]),
