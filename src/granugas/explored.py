"""The runs that the explorer shows; light, for the workflow reads it at every call."""

from dataclasses import dataclass

from granugas.runs import Run
from granugas.studies import Studies


@dataclass(frozen=True)
class Shown:
    """A run in the explorer.

    Attributes:
        label: its study, and what sets it apart there.
        run: which keeps its positions.
        clusters: the address of its cluster analysis; None where there is none.
    """

    label: str
    run: Run
    clusters: str | None


def explored(studies: Studies) -> list[Shown]:
    """First realizations in two dimensions that keep their positions, each once, the filmed ones first."""
    found: dict[str, Shown] = {}
    for study in studies.studies.values():
        analyses = {run.address: clusters for clusters, run in study.clusters().items()}
        firsts = [run for run in study.runs if run.keep_positions and run.scene.dimensions == 2 and 0 in run.realizations]
        scenes = [run.scene.as_dict() for run in firsts]
        varied = [key for key in study.grid_keys if len({str(scene[key]) for scene in scenes}) > 1]
        for run, scene in zip(firsts, scenes, strict=True):
            label = ", ".join([study.name, *(f"{key} = {scene[key]}" for key in varied)])
            if run.address not in found or found[run.address].clusters is None:
                found[run.address] = Shown(label, run, analyses.get(run.address))
    return sorted(found.values(), key=lambda shown: not shown.run.keep_motion)
