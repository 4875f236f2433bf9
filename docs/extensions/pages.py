"""Pages that are written from the code: configuration, variables, command line, figures, scenes. Texts in Markdown."""

import argparse
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import fields
from pathlib import Path
from typing import Any, NamedTuple

import yaml

from granugas.__main__ import _parser
from granugas.scene import Scene, SceneError
from granugas.storage.variables import VARIABLES

ROOT = Path(__file__).parents[2]
SCHEMA = yaml.safe_load((ROOT / "workflow/schemas/config.schema.yaml").read_text(encoding="utf-8"))
DEFAULTS = {key.name: key.default for key in fields(Scene)}

BLOCKS = {
    "Top level": ("properties",),
    "An animation": ("$defs", "animation", "properties"),
    "A study": ("$defs", "study", "properties"),
    "grid": ("$defs", "study", "properties", "grid", "properties"),
    "until": ("$defs", "study", "properties", "until", "properties"),
    "samples": ("$defs", "study", "properties", "samples", "properties"),
    "equilibration": ("$defs", "study", "properties", "equilibration", "properties"),
}
"""Blocks of a configuration by the headings of config/README.md, and where the schema has their keys."""

TYPES = {"integer": "an integer", "number": "a number", "string": "a word", "boolean": "`true`, `false`", "object": "a block"}
BOUNDS = {"minimum": ">=", "exclusiveMinimum": ">", "maximum": "<="}


class Key(NamedTuple):
    """A row of the configuration's reference; symbol and unit of the keys of a grid alone."""

    key: str
    symbol: str
    unit: str
    default: str
    allowed: str
    meaning: str


def keys_of(block: str) -> list[Key]:
    """The keys of a block, as the schema has them; what a scene may hold is asked of `granugas.Scene`."""
    parent: Mapping[str, Any] = SCHEMA
    for step in BLOCKS[block][:-1]:
        parent = parent[step]
    found = parent[BLOCKS[block][-1]]
    if block == "grid":
        return [_of_grid(key, words["description"]) for key, words in found.items()]
    required = set(parent.get("required", ()))
    return [
        Key(key, "", "", _default(key, words, required), _allowed(words), words["description"]) for key, words in found.items()
    ]


def _of_grid(key: str, meaning: str) -> Key:
    with_unit = re.fullmatch(r"a number .*?(?:\d|inf) (\S+)", _refusal(key, object()))
    unit = with_unit[1] if with_unit else ""
    return Key(key, VARIABLES[key].symbol, unit, _text(DEFAULTS[key]), allowed_in_scene(key).removesuffix(f" {unit}"), meaning)


def allowed_in_scene(key: str) -> str:
    """What a key of a scene may hold, in the words with which it refuses what it may not; close packing depends on D."""
    said: dict[str, list[str]] = {}
    for dimensions in (1, 2, 3):
        words, of_large = _refusal(key, object(), dimensions), _refusal(key, 1e300, dimensions)
        words = of_large if of_large.startswith("a number from") else words
        said.setdefault(words, []).append(f"{dimensions}D")
    return "; ".join(words + (f" in {', '.join(where)}" if len(said) > 1 else "") for words, where in said.items())


def _refusal(key: str, value: Any, dimensions: int = 2) -> str:
    """What a scene says is allowed instead of this value; nothing where it takes it."""
    try:
        Scene(**{"dimensions": dimensions, key: value})
    except SceneError as error:
        return re.sub("^allowed (is|are) ", "", error.allowed)
    return ""


def _default(key: str, words: Mapping[str, Any], required: set[str]) -> str:
    if key in required:
        return "required"
    return _text(words["default"]) if "default" in words else "none"


def _text(value: Any) -> str:
    """As it is written in YAML."""
    return f"`{yaml.safe_dump(value).splitlines()[0]}`"


def _allowed(words: Mapping[str, Any]) -> str:
    if "enum" in words:
        return ", ".join(map(_text, words["enum"]))
    if "allowed" in words:
        return re.sub("^allowed (is|are) ", "", words["allowed"])
    if words.get("type") == "array":
        return f"a list, each {_bounds(words['items']) or TYPES[words['items']['type']]}"
    return " ".join(filter(None, (TYPES.get(words.get("type", ""), "a block"), _bounds(words))))


def _bounds(words: Mapping[str, Any]) -> str:
    return " and ".join(f"{sign} {words[name]}" for name, sign in BOUNDS.items() if name in words)


def configuration() -> str:
    """All keys of all blocks."""
    return "\n\n".join(f"## {_heading(block)}\n\n{_table(keys_of(block))}" for block in BLOCKS)


def _heading(block: str) -> str:
    return block if " " in block else f"`{block}`"


def _table(rows: Iterable[NamedTuple]) -> str:
    """A table, without the columns in which nothing stands."""
    rows = list(rows)
    names = [name for name in rows[0]._fields if any(getattr(row, name) for row in rows)]
    cells = [[_cell(name, getattr(row, name)) for name in names] for row in rows]
    return "\n".join(f"| {' | '.join(row)} |" for row in [names, ["---"] * len(names), *cells])


def _cell(name: str, text: str) -> str:
    """What is not code between two backticks is plain text."""
    if name in ("key", "name"):
        return f"`{text}`"
    return "`".join(part if k % 2 else re.sub(r"([|*<\\_])", r"\\\1", part) for k, part in enumerate(text.split("`")))


class Row(NamedTuple):
    """A row of the table of variables."""

    name: str
    meaning: str
    symbol: str
    units: str
    defined: str


def variables() -> str:
    """Everything that a dataset can hold."""
    return _table(Row(name, v.long_name, v.symbol, v.units or "text", v.equation) for name, v in VARIABLES.items())


def command_line() -> str:
    """The help of each command."""
    return "\n\n".join(f"## `{name}`\n\n```text\n{parser.format_help()}```" for name, parser in commands())


def commands() -> Iterator[tuple[str, argparse.ArgumentParser]]:
    """Names and parsers of the commands of `python -m granugas`."""
    (choices,) = (action for action in _parser()._actions if isinstance(action, argparse._SubParsersAction))
    yield from choices.choices.items()


GROUPS = {
    "tc1998": "The TC model (Luding & McNamara 1998)",
    "cluster1999": "The growth of clusters (Luding & Herrmann 1999)",
    "": "Beyond the papers",
}
"""Headings of the gallery, by the beginning of the names of figures."""


def gallery() -> str:
    """All figures of a full run with their captions."""
    parts = []
    names = sorted(path.stem for path in (ROOT / "results/gallery").glob("*.png"))
    for start, heading in GROUPS.items():
        taken = [name for name in names if name.startswith(start)]
        names = [name for name in names if name not in taken]
        parts += [f"## {heading}", *(_figure(name) for name in taken)]
    return "\n\n".join(parts)


def _figure(name: str) -> str:
    caption = "overview" if name.startswith("study_") else name
    return (
        f"### {name}\n\n![{name}](/../results/gallery/{name}.png)\n\n"
        f"```{{eval-rst}}\n.. include:: /../workflow/report/{caption}.rst\n```\n\n"
        f"{{download}}`PDF </../results/gallery/{name}.pdf>`"
    )


def scenes() -> str:
    """The examples, each with what it is and its text."""
    parts = []
    for path in sorted((ROOT / "examples").glob("*.yaml")):
        comment, _, text = path.read_text(encoding="utf-8").partition("\n")
        parts.append(f"## {path.stem.replace('_', ' ').capitalize()}\n\n{comment.lstrip('# ')}\n\n```yaml\n{text}```")
    return "\n\n".join(parts)


PAGES = {page.__name__: page for page in (configuration, variables, command_line, gallery, scenes)}
