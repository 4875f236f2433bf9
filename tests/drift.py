"""What rounding adds up to in elastic disks: energy, momentum and the smallest gap against the number of collisions.

`python tests/drift.py 1e9 docs/reliability` measures as many collisions into drift.csv, and draws drift.png beside it.
"""

import math
import sys
from pathlib import Path

import numpy as np
import pandas as pd
from gaps import TOLERATED, smallest_gap
from gases import lattice_gas

from granugas.dynamics.events.engine import Engine
from granugas.scene import Scene

SCENE = Scene(1435, 0.7, restitution=1.0, contact_time=0.0)
LOOKS_PER_DECADE = 20
FIRST = 1000
COLUMNS = {
    "collisions": "collisions of pairs",
    "energy": "$|E/E(0) - 1|$",
    "momentum": r"$|\sum v - \sum v(0)| / (N v_{rms})$",
    "gap": "smallest gap $/ d$",
}


def measure(collisions: int, table: Path) -> pd.DataFrame:
    """Looks at a gas on its way, evenly in the logarithm of the collisions; the table is on disk after each of them.

    Returns:
        A row a look: collisions (of pairs), energy (E/E(0) - 1), momentum (largest component of the change of sum v, by
        N v_rms), gap (the smallest so far, in d), time (s).
    """
    engine = Engine(SCENE, lattice_gas(SCENE))
    start = engine.state().velocity
    scale, gap, rows = math.sqrt(math.fsum((start**2).ravel()) * len(start)), smallest_gap(engine), []
    table.parent.mkdir(parents=True, exist_ok=True)
    for stop in stops(collisions):
        engine.advance(math.inf, int(stop) - engine.collisions)
        v, gap = engine.state().velocity, min(gap, smallest_gap(engine))
        energy = math.fsum((v**2).ravel()) / math.fsum((start**2).ravel()) - 1
        momentum = max(abs(math.fsum(v[:, a]) - math.fsum(start[:, a])) for a in (0, 1)) / scale
        rows.append({"collisions": engine.collisions, "energy": energy, "momentum": momentum, "gap": gap, "time": engine.time})
        pd.DataFrame(rows).to_csv(table, index=False, float_format="%.6g")
    assert engine.backwards == 0
    return pd.DataFrame(rows)


def stops(collisions: int) -> np.ndarray:
    """Numbers of collisions at which to look, up to the last."""
    return np.unique(
        np.geomspace(FIRST, collisions, 1 + round(LOOKS_PER_DECADE * math.log10(collisions / FIRST))).round().astype(int)
    )


def draw(rows: pd.DataFrame, picture: Path) -> None:
    """Energy, momentum and smallest gap against collisions, each with what the tests allow."""
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(1, 3, figsize=(11, 3.4), layout="constrained")
    values = {"energy": abs(rows["energy"]), "momentum": rows["momentum"], "gap": rows["gap"]}
    for axis, (name, y) in zip(axes, values.items(), strict=True):
        axis.plot(rows["collisions"], y, ".-", lw=0.8, ms=4)
        axis.set(xscale="log", xlabel=COLUMNS["collisions"], ylabel=COLUMNS[name])
        if name != "gap":
            axis.set_yscale("log")
    axes[2].axhline(-TOLERATED, color="0.5", ls="--", lw=0.8)
    axes[2].set_yscale("symlog", linthresh=1e-15)
    figure.suptitle(f"elastic disks, N = {SCENE.n_particles}, area fraction {SCENE.area_fraction:g}", fontsize=10)
    figure.savefig(picture, dpi=130, metadata={"Software": None})
    plt.close(figure)


if __name__ == "__main__":
    folder = Path(sys.argv[2])
    draw(measure(int(float(sys.argv[1])), folder / "drift.csv"), folder / "drift.png")
