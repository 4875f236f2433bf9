# One rule a figure, made from the files of workflow/figures: each names the studies that it draws.
for name, needed in STUDIES.figures.items():
    drawing = name if name in DRAWINGS else declared.OVERVIEW

    rule:
        name:
            f"figure_{name}"
        input:
            data=datasets(needed, DRAWINGS.get(drawing, ())) + [f"{OUTPUT}/{table}.csv" for table in DRAWN_TABLES.get(drawing, ())],
            drawing=f"{HERE}/workflow/figures/{drawing}.py",
            style=STYLE,
        output:
            png=report(
                f"{OUTPUT}/figures/{name}.png",
                caption=f"../report/{drawing}.rst",
                **placed(f"workflow/figures/{drawing}.py", name),
            ),
            pdf=f"{OUTPUT}/figures/{name}.pdf",
        log:
            f"{OUTPUT}/logs/figures/{name}.log",
        params:
            formulas=FORMULAS,
        group:
            None if draws_costs(name) else with_figures
        script:
            "../scripts/draw.py"


# One realization of a study as a film.
rule animate:
    input:
        positions=lambda wildcards: f"{OUTPUT}/positions/{STUDIES.animations[wildcards.animation].run.address}.nc",
    output:
        report(
            f"{OUTPUT}/figures/{{animation}}.mp4",
            caption="../report/animation.rst",
            category="Studies",
            labels=labelled("{animation}", "One realization as a film"),
        ),
    log:
        f"{OUTPUT}/logs/animations/{{animation}}.log",
    params:
        colour=lambda wildcards: STUDIES.animations[wildcards.animation].colour,
        drawing=digest.digest(["granugas.plotting.animation", "granugas.plotting.snapshots"]),
    wildcard_constraints:
        animation="|".join(STUDIES.animations),
    script:
        "../scripts/animate.py"


# Runs whose positions are kept, as a page to explore.
rule explorer:
    input:
        positions=[f"{OUTPUT}/positions/{shown.run.address}.nc" for shown in EXPLORED],
        runs=[f"{OUTPUT}/runs/{shown.run.address}.nc" for shown in EXPLORED],
        clusters=[f"{OUTPUT}/clusters/{shown.clusters}.nc" for shown in EXPLORED if shown.clusters],
        page=sorted((digest.SOURCES / "explorer/page").iterdir()),
    output:
        f"{OUTPUT}/explorer.html",
    log:
        f"{OUTPUT}/logs/explorer.log",
    params:
        labels=[shown.label for shown in EXPLORED],
        clusters=[shown.clusters and f"{OUTPUT}/clusters/{shown.clusters}.nc" for shown in EXPLORED],
        drawing=digest.digest(["granugas.explorer.*", "granugas.plotting.snapshots", *digest.ANALYSIS]),
    script:
        "../scripts/explorer.py"


# Tables, each from a file of workflow/tables.
for name, needed in TABLES.items():

    rule:
        name:
            f"table_{name}"
        input:
            data=datasets(needed, MEASURED["tables"][name]),
            table=f"{HERE}/workflow/tables/{name}.py",
        output:
            f"{OUTPUT}/{name}.csv",
        log:
            f"{OUTPUT}/logs/tables/{name}.log",
        params:
            formulas=FORMULAS,
        script:
            "../scripts/table.py"


# What the papers claim, judged: all files of workflow/claims in one table, and a page to read.
rule claims:
    input:
        data=sorted({path for name, needed in CLAIMS.items() for path in datasets(needed, MEASURED["claims"][name])}),
        claims=[f"{HERE}/workflow/claims/{name}.py" for name in CLAIMS],
    output:
        table=f"{OUTPUT}/claims.csv",
        page=f"{OUTPUT}/claims.md",
    log:
        f"{OUTPUT}/logs/claims.log",
    params:
        formulas=digest.digest(["granugas.analysis.*", "granugas.claims", "granugas.measured"]),
    script:
        "../scripts/claims.py"


# What every job took: the last of all, but for the figures that draw it. A build ends with an up-to-date one in any case.
rule cost:
    input:
        datasets(STUDIES.studies, ()),
        figures(with_costs=False),
        tables(),
        animations(),
    output:
        f"{OUTPUT}/cost.csv",
    log:
        f"{OUTPUT}/logs/cost.log",
    params:
        studies=FIRST_TO_ASK,
    script:
        "../scripts/cost.py"
