"""What the documentation writes from the code is complete, and config/README.md, written by hand, says the same."""

import math
import re

import pages
import pytest
import yaml

from granugas.scene import SCENE_KEYS
from granugas.storage.variables import VARIABLES

README = (pages.ROOT / "config/README.md").read_text(encoding="utf-8")
UNTOLD = 1e49
"""Bounds beyond this and its inverse are no physics: the hand-written page leaves them out."""


def by_hand(block):
    """The rows of a table of config/README.md by its key, each by the names of the columns."""
    heading = f"## {block}" if " " in block else f"### `{block}`"
    section = README.partition(f"\n{heading}\n")[2].partition("\n#")[0]
    table = [[cell.strip() for cell in line[1:-1].split("|")] for line in section.splitlines() if line.startswith("|")]
    return {row[0].strip("`"): dict(zip(table[0], row, strict=True)) for row in table[2:]}


def code_in(text):
    return re.findall(r"`([^`]*)`", text)


def numbers_in(text):
    return [float(number) for number in re.findall(r"(?<![\w.])-?\d+(?:\.\d+)?(?:e[+-]?\d+)?(?!\w)", text)]


@pytest.mark.parametrize("block", pages.BLOCKS)
def test_both_have_the_same_keys(block):
    assert list(by_hand(block)) == [row.key for row in pages.keys_of(block)]


@pytest.mark.parametrize("block", [name for name in pages.BLOCKS if name != "until"])
def test_both_have_the_same_defaults(block):
    hand = by_hand(block)
    for row in pages.keys_of(block):
        written = hand[row.key]["default"]
        if row.default in ("required", "none"):
            assert written.startswith(row.default) or row.key in ("first", "axis"), (row.key, written)
        elif row.default != "`{}`":
            assert yaml.safe_load(code_in(written)[0]) == yaml.safe_load(code_in(row.default)[0]), row.key


@pytest.mark.parametrize("block", pages.BLOCKS)
def test_every_bound_and_choice_of_the_code_is_told(block):
    hand = by_hand(block)
    for row in pages.keys_of(block):
        cells = hand[row.key]
        told = f"{cells.get('allowed')} {cells.get('meaning')}"
        for bound in numbers_in(row.allowed):
            if bound == 0 or 1 / UNTOLD < abs(bound) < UNTOLD:
                assert any(math.isclose(bound, number, rel_tol=1e-3) for number in numbers_in(told)), (row.key, bound)
        for word in code_in(row.allowed):
            assert word in code_in(told), (row.key, word)


def test_both_have_the_same_units():
    hand = by_hand("grid")
    assert {row.key: row.unit for row in pages.keys_of("grid")} == {key: row["unit"] for key, row in hand.items()}


def test_every_key_of_a_scene_says_what_is_allowed():
    rows = {row.key: row for row in pages.keys_of("grid")}
    assert set(rows) == set(SCENE_KEYS)
    assert all(row.allowed and row.meaning for row in rows.values())
    assert rows["aspect_ratio"].allowed == "a number from 0.0001 to 10000"
    assert rows["viscosity"][1:5] == ("A", "(s/m)^(1/5)", "`0.0`", "a number >= 0")
    assert re.findall(r"<= (\S+) \(close packing\) in (\dD)", rows["area_fraction"].allowed) == [
        ("1", "1D"),
        ("0.9069", "2D"),
        ("0.74048", "3D"),
    ]


def test_values_are_written_as_yaml_reads_them():
    rows = {row.key: row for row in pages.keys_of("grid")}
    assert yaml.safe_load(code_in(rows["contact_time"].default)[0]) == 1e-5
    assert rows["friction"].default == "`.inf`"
    assert {row.key: row.default for row in pages.keys_of("Top level")}["allow_large"] == "`false`"


def test_all_variables_are_listed():
    listed = re.findall(r"^\| `(\w+)` \|", pages.variables(), re.M)
    assert listed == list(VARIABLES)


def test_all_commands_and_options_are_listed():
    text = pages.command_line()
    names = [name for name, _ in pages.commands()]
    assert {"run", "bench", "compare", "prune"} <= set(names)
    for name, parser in pages.commands():
        assert f"## `{name}`" in text
        assert all(option in text for action in parser._actions for option in action.option_strings)


def test_the_gallery_has_every_figure_with_a_caption():
    shown = pages.gallery()
    for path in (pages.ROOT / "results/gallery").glob("*.png"):
        assert f"](/../results/gallery/{path.name})" in shown
    captions = re.findall(r"include:: /\.\./(\S+)", shown)
    assert captions and all((pages.ROOT / path).is_file() for path in captions)


def test_the_scenes_are_shown_as_they_are():
    shown = pages.scenes()
    blocks = re.findall(r"```yaml\n(.*?)```", shown, re.S)
    examples = sorted((pages.ROOT / "examples").glob("*.yaml"))
    assert [yaml.safe_load(text) for text in blocks] == [yaml.safe_load(path.read_text()) for path in examples]
