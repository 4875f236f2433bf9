"""Snakemake's own linter has one complaint, which is meant to be: the environment is the project's."""

import re

from workflow.project import Project

ALLOWED = "Specify a conda environment or container for each rule.:"


def test_the_linter_has_no_other_complaint(project: Project) -> None:
    said = project.snakemake("--lint").stdout
    titles = set(re.findall(r"^ +\* (.+)$", said, re.M))
    assert titles == {ALLOWED}
