"""From a configuration to checked values: a mistake ends in one line that names key, value and what is allowed."""

import difflib
import math
import sys
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any, cast

import yaml
from jsonschema import Draft202012Validator, ValidationError, validators


class Written:
    """A value that messages show as it is written here."""

    def __init__(self, text: str) -> None:
        self._text = text

    def __repr__(self) -> str:
        return self._text


MISSING = Written("(missing)")
"""The value of a key that is not there."""


class ConfigError(ValueError):
    """A configuration that cannot be built; str() is one line for people."""

    def __init__(self, key: str, value: Any, allowed: str) -> None:
        super().__init__(f"{key} = {_shown(value)}: {allowed}{_number_hint(value)}")
        self.key, self.value, self.allowed = key, value, allowed


def check_structure(config: Mapping[str, Any], schema: Mapping[str, Any]) -> None:
    """Compare keys, types and ranges of a configuration with the schema.

    Raises:
        ConfigError: the first mistake, misspelt keys before everything else.
    """
    for path, key in _keys(config):
        if not isinstance(key, str):
            raise ConfigError(_dotted([*path, str(key)]), key, "allowed as a key is text: write it in quotes")
    errors = list(Validator(schema).iter_errors(config))
    if errors:
        raise _in_our_words(min(errors, key=lambda error: error.validator != "additionalProperties"))


def with_defaults(block: Mapping[str, Any], schema: Mapping[str, Any]) -> dict[str, Any]:
    """A checked block with the schema's defaults where it names nothing, the blocks inside it too."""
    filled = dict(block)
    for key, piece in schema.get("properties", {}).items():
        if "default" in piece:
            filled.setdefault(key, piece["default"])
        if isinstance(filled.get(key), Mapping):
            filled[key] = with_defaults(filled[key], piece)
    return filled


def merged(files: Iterable[str | Path]) -> dict[str, Any]:
    """The configuration of several YAML files: later ones win, key by key, at every depth; lists are replaced.

    Raises:
        ConfigError: a key stands twice in one block, or a file is no YAML block.
        OSError: a file cannot be read.
    """
    whole: dict[str, Any] = {}
    for file in map(Path, files):
        try:
            refuse_duplicate_keys([file])
            block = yaml.safe_load(file.read_text(encoding="utf-8"))
        except (yaml.YAMLError, UnicodeDecodeError) as error:
            raise ConfigError(str(file), Written("(no YAML)"), " ".join(str(error).split())) from error
        if not isinstance(block, Mapping):
            raise ConfigError(str(file), block, "allowed is a block of keys")
        whole = _over(whole, block)
    return whole


def _over(below: Mapping[str, Any], above: Mapping[str, Any]) -> dict[str, Any]:
    both = {key: _over(below[key], above[key]) for key in below if _is_block(below[key]) and _is_block(above.get(key))}
    return {**below, **above, **both}


def _is_block(value: Any) -> bool:
    return isinstance(value, Mapping)


def refuse_duplicate_keys(files: Iterable[str | Path]) -> None:
    """YAML keeps the last of two equal keys without a word; here that is a mistake.

    Raises:
        ConfigError: a key stands twice in one block of a file.
    """
    for file in map(Path, files):
        if file.suffix in (".yaml", ".yml"):
            _refuse_duplicates(yaml.compose(file.read_text(encoding="utf-8"), Loader=yaml.SafeLoader), [], file)


def unknown(key: str, value: Any, name: str, known: Iterable[str], kind: str = "key") -> ConfigError:
    """The error for a name that does not exist, with the nearest one that does."""
    known = sorted(known)
    near = difflib.get_close_matches(name, known, n=1)
    meant = f", did you mean {near[0]}?" if near else ";"
    return ConfigError(key, value, f"unknown {kind}{meant} allowed are {', '.join(known)}")


def _is_number(checker: Any, value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and abs(value) <= sys.float_info.max


def _is_integer(checker: Any, value: Any) -> bool:
    return isinstance(value, int) and not isinstance(value, bool)


Validator = validators.extend(
    Draft202012Validator,
    type_checker=Draft202012Validator.TYPE_CHECKER.redefine_many({"number": _is_number, "integer": _is_integer}),
)
"""JSON schema, where 100.0 is no integer and NaN no number."""


def _in_our_words(error: ValidationError) -> ConfigError:
    path, value, schema = list(error.absolute_path), cast(Any, error.instance), cast(Any, error.schema)
    if error.validator == "additionalProperties":
        known = schema.get("properties", {})
        key = next(k for k in value if k not in known and not _matches(k, schema))
        where = _dotted([*path, key])
        return unknown(where, value[key], key, known) if known else ConfigError(where, value[key], schema["allowed"])
    if error.validator == "required":
        key = next(k for k in schema["required"] if k not in value)
        return ConfigError(_dotted([*path, key]), MISSING, _allowed(schema["properties"][key]))
    return ConfigError(_dotted(path), value, _allowed(schema))


def _allowed(schema: Mapping[str, Any]) -> str:
    """What a piece of the schema allows, in words."""
    if "allowed" in schema:
        return schema["allowed"]
    if "enum" in schema:
        return f"allowed are {', '.join(map(str, schema['enum']))}"
    kind = schema.get("type", "array")
    if kind == "object":
        return f"allowed is a block with the keys {', '.join(schema['properties'])}"
    if kind == "array":
        items = schema.get("items", {})
        each = f", each {_allowed(items).removeprefix('allowed is ')}" if "type" in items else ""
        return f"allowed is a list with at least one value{each}"
    bounds = {"minimum": ">=", "exclusiveMinimum": ">", "maximum": "<="}
    said = " and ".join(f"{sign} {schema[bound]}" for bound, sign in bounds.items() if bound in schema)
    noun = {"integer": "an integer", "number": "a number", "string": "text", "boolean": "true or false"}[kind]
    return f"allowed is {noun} {said}".rstrip()


def _matches(key: str, schema: Mapping[str, Any]) -> bool:
    return any(Validator({"pattern": pattern}).is_valid(key) for pattern in schema.get("patternProperties", {}))


def _keys(block: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[tuple[Any, ...], Any]]:
    if isinstance(block, Mapping):
        for key, value in block.items():
            yield path, key
            yield from _keys(value, (*path, key))


def _refuse_duplicates(node: yaml.Node | None, path: list[str], file: Path) -> None:
    if isinstance(node, yaml.SequenceNode):
        for item in node.value:
            _refuse_duplicates(item, path, file)
    if not isinstance(node, yaml.MappingNode):
        return
    lines: dict[str, int] = {}
    for key, value in node.value:
        name, line = str(key.value), key.start_mark.line + 1
        where = [*path, name]
        if name in lines:
            said = value.start_mark.buffer[value.start_mark.index : value.end_mark.index].strip()
            places = f"{file}, lines {lines[name]} and {line}"
            raise ConfigError(_dotted(where), said, f"this key stands twice ({places}); allowed is once")
        lines[name] = line
        _refuse_duplicates(value, where, file)


def _dotted(path: Iterable[Any]) -> str:
    """studies.x.snapshots; the place in a list is left out, the value says which."""
    parts = (str(part) for part in path if not isinstance(part, int))
    return ".".join(part if part.isprintable() else repr(part) for part in parts) or "configuration"


def _shown(value: Any, width: int = 90) -> str:
    text = repr(value)
    return text if len(text) <= width else text[: width - 3] + "..."


def _number_hint(value: Any) -> str:
    """YAML reads 1e-5 as text, and numbers of the command line stay text too."""
    try:
        number = float(value) if isinstance(value, str) else math.nan
    except ValueError:
        return ""
    if not math.isfinite(number):
        return ""
    mantissa, _, exponent = f"{number:.12g}".partition("e")
    written = f"{mantissa if '.' in mantissa else mantissa + '.0'}e{int(exponent)}" if exponent else mantissa
    return f" ({value!r} is text; as a number write {written})"
