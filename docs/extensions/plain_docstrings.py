"""Docstrings of the package are plain text: |v|, a*b and v_ are no markup; `x` is code. Types of arrays go by their names."""

import re
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from sphinx.application import Sphinx
from sphinx.util.typing import stringify_annotation

NAMES = {ArrayLike: "ArrayLike"} | {NDArray[kind]: f"NDArray[{kind.__name__}]" for kind in (np.float64, np.int64, np.int32)}
SHORT = {stringify_annotation(kind, "smart"): name for kind, name in NAMES.items()}
"""What Sphinx writes for a type of arrays, and its name."""


def plain(line: str) -> str:
    """The line with what reStructuredText would take for markup taken literally."""
    return re.sub(r"([\\*|])|_(?!\w)", lambda found: "\\" + found[0], line)


def take_literally(app: Sphinx, what: str, name: str, obj: Any, options: Any, lines: list[str]) -> None:
    """Of every docstring, before its sections (Args, Returns, Raises) are looked for."""
    first = ["\\ "] if what in ("attribute", "data", "property") else []  # or a colon in it would end a type
    lines[:] = first + [plain(line) for line in lines]


def shorten(app: Sphinx, what: str, name: str, obj: Any, options: Any, *texts: str | None) -> tuple[str | None, ...]:
    """Arguments and what is returned, with the names of types for what they stand for."""
    return tuple(text and _shortened(text) for text in texts)


def _shortened(text: str) -> str:
    for long, short in SHORT.items():
        text = text.replace(long, short)
    return text


def setup(app: Sphinx) -> dict[str, Any]:
    """Look at docstrings first."""
    app.connect("autodoc-process-docstring", take_literally, priority=100)
    app.connect("autodoc-process-signature", shorten)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
