# One rule a figure, made from the files of workflow/figures: each names the studies that it draws.
for name, needed in STUDIES.figures.items():
    drawing = name if name in DRAWINGS else studies.OVERVIEW

    rule:
        name:
            f"figure_{name}"
        input:
            studies=expand(f"{OUTPUT}/studies/{{study}}.nc", study=needed),
            drawing=f"{HERE}/workflow/figures/{drawing}.py",
            style=STYLE,
        output:
            png=report(f"{OUTPUT}/figures/{name}.png", caption=f"../report/{drawing}.rst", category="Figures"),
            pdf=f"{OUTPUT}/figures/{name}.pdf",
        log:
            f"{OUTPUT}/logs/figures/{name}.log",
        params:
            names=needed,
            formulas=FORMULAS,
        script:
            "../scripts/draw.py"
