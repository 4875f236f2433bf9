"""The example that uses this workflow as a module of its own, as it stands and with another configuration."""

import pandas as pd
import yaml
from workflow.project import ROOT, Project

import granugas as gg

EXAMPLE = ROOT / "examples/module"


def test_another_workflow_adds_a_rule_on_top_of_a_study(project: Project) -> None:
    config = yaml.safe_load((EXAMPLE / "config.yaml").read_text())
    config["granugas"]["studies"]["halving"] |= {"realizations": 1, "until": {"collisions_per_particle": 20}}
    config["granugas"]["studies"]["halving"]["grid"] |= {"n_particles": 100, "restitution": [0.9, 0.7, 0.5]}
    (project.folder / "config.yaml").write_text(yaml.safe_dump(config))
    said = project.build("--snakefile", EXAMPLE / "Snakefile", "half_time.csv", "granugas/figures/study_halving.png")
    times = pd.read_csv(project.folder / "half_time.csv").set_index("restitution")["half_time"]
    assert list(times.index) == [0.5, 0.7, 0.9]
    assert times.is_monotonic_increasing and times.iloc[0] > 0
    study = gg.load_study("halving", output=project.folder / "granugas")
    energy = study["kinetic_energy"].sel(restitution=0.7).squeeze(drop=True)
    before = energy.where(study["sampling_time"].sel(restitution=0.7).squeeze(drop=True) < times[0.7], drop=True)
    assert float(before.min()) > 0.5
    assert (project.folder / "granugas/figures/study_halving.png").exists()
    assert (project.folder / "granugas/logs/warm_up.log").exists()  # what stands under onstart was done
    assert "the datasets are in granugas/studies" in said


def test_the_example_as_it_stands(project: Project) -> None:
    jobs = project.jobs("--snakefile", EXAMPLE / "Snakefile", "half_time.csv", "granugas_all")
    assert jobs["granugas_simulate_without_positions"] == 4 and jobs["granugas_pool"] == jobs["half_time"] == 1
    assert jobs["granugas_figure_study_halving"] == 1
