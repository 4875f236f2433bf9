"""The examples are short, and the studies of the default configuration; a preview builds each of them, small."""

from pathlib import Path

import pytest
import yaml

from granugas import studies
from granugas.configuration import merged

ROOT = Path(__file__).parents[2]
EXAMPLES = sorted((ROOT / "examples").glob("*.yaml"))
SCHEMA = yaml.safe_load((ROOT / "workflow/schemas/config.schema.yaml").read_text())


def test_there_are_eight():
    assert len(EXAMPLES) == 8


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_an_example_is_a_study_of_a_few_lines(example):
    assert len(example.read_text().splitlines()) < 15
    block = yaml.safe_load(example.read_text())
    (name,) = block["studies"]
    assert name == f"scene_{example.stem}"
    assert merged([ROOT / "config/config.yaml"])["studies"][name] == block["studies"][name]
    assert name in merged([ROOT / "config/reduced.yaml"])["studies"]
    studies.load(block, SCHEMA)
