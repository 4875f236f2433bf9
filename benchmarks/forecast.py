"""What the plan foretold of studies against what happened: a table for each study that was built, from cost.csv.

    snakemake --cores 1 results/studies/tc1998_n22960.nc results/studies/growth_rough.nc
    python benchmarks/forecast.py tc1998_n22960 growth_rough

Options --configfile as for snakemake. Foretold is as before anything was there; happened is processor time without compilation.
"""

import argparse
from dataclasses import replace
from pathlib import Path

import pandas as pd
import yaml

from granugas import studies
from granugas.configuration import merged
from granugas.planning.calibration import calibration
from granugas.planning.plan import forecast

ROOT = Path(__file__).parents[1]
WORK = ("equilibrate", "simulate", "clusters", "pool")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("studies", nargs="*", help="all that were built unless named")
    parser.add_argument("--configfile", nargs="+", default=[])
    options = parser.parse_args()
    schema = yaml.safe_load((ROOT / "workflow/schemas/config.schema.yaml").read_text())
    asked = studies.load(merged([ROOT / "config/config.yaml", *options.configfile]), schema)
    costs = pd.read_csv(Path(asked.output) / "cost.csv")
    costs = costs[costs["rule"].isin(WORK)].assign(seconds=costs["cpu_seconds"] - costs["compile_seconds"])
    happened = costs.groupby("study")[["collisions", "seconds"]].sum()
    built = {*costs.loc[costs["rule"] == "pool", "study"]}
    foretold = forecast(replace(asked, output="nothing is here"), calibration())
    rows = [
        (name, one.collisions, happened.loc[name, "collisions"], one.seconds, happened.loc[name, "seconds"])
        for name, one in foretold.items()
        if name in built and (not options.studies or name in options.studies)
    ]
    table = pd.DataFrame(rows, columns=["study", "collisions", "happened", "s", "happened s"])
    table.loc[len(table)] = ["all", *table.iloc[:, 1:].sum()]
    table.insert(3, "ratio", table["collisions"] / table["happened"])
    table["ratio s"] = table["s"] / table["happened s"]
    formats = {name: "{:.3g}".format for name in table.columns[1:]}
    print(table.to_string(index=False, formatters=formats))


if __name__ == "__main__":
    main()
