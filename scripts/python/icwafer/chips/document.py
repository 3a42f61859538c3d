# SPDX-License-Identifier: GPL-2.0-or-later
"""Layout files, `NAME.layout.toml`: reading and writing.

A file is TOML and holds what the dataclasses of `icwafer.chips.model` and `.wafer` declare, under
the same names: `format`, `version`, a table `[[dies]]` for each die with its `[[dies.groups]]`, and
`[wafer]`. A field that is left out has its default. A die may name a `preset` to start from; then
its groups change those of the preset that have the same name. A spread is a number, or a table with
`mean` and `deviation`, `low` and `high`, or `centres` and `deviation`.

Blocks listed one by one stand in `[dies.blocks]`, up to 1000 as readable `rows` of
`[x0, y0, x1, y1, "group"]` in micrometres, more in `packed` columns (`icwafer.chips.packing`): one
file, and it is complete or not there.

Writing is canonical: every field, in the order of declaration, so that reading and writing a
written file gives the same bytes.
"""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

from icwafer.chips.check import check_layout, problems
from icwafer.chips.model import Layout
from icwafer.chips.reading import Unreadable, layout_of
from icwafer.chips.writing import lines_of_layout
from icwafer.errors import IcwaferError
from icwafer.files import replacing
from icwafer.toml_lines import key_name, line_of

FORMAT = "icwafer-layout"
VERSION = 1
ENDING = ".layout.toml"


def read_layout(path: Path) -> Layout:
    """Reads and checks a layout file.

    Raises IcwaferError with the file, line, field, value and allowed range, or OSError.
    """
    try:
        text = path.read_text(encoding="utf-8")
    except UnicodeDecodeError:
        raise IcwaferError(f"{path}: not a text file; a layout is TOML in UTF-8") from None
    return parse_layout(text, str(path))


def parse_layout(text: str, name: str) -> Layout:
    """Reads and checks the text of a layout file; `name` is what messages call it."""
    try:
        document = tomllib.loads(text)
    except RecursionError:
        raise IcwaferError(f"{name}: not valid TOML: nested too deeply; correct it") from None
    except ValueError as error:  # of the syntax, or of a number with thousands of digits
        place = re.search(r" \(at line (\d+), column (\d+)\)$", str(error))
        line, at = (place[1], f" at column {place[2]}") if place else (text.count("\n") + 1, "")
        reason = re.sub(r" \(at .*\)$", "", str(error)) + at
        raise IcwaferError(f"{name}:{line}: not valid TOML: {reason}; correct it") from None
    found = document.pop("format", None)
    if found != FORMAT:
        raise IcwaferError(f'{name}:1: no layout file: it must begin with format = "{FORMAT}"')
    version = document.pop("version", None)
    if version != VERSION or isinstance(version, bool):
        raise IcwaferError(
            f"{name}:{line_of(text, ('version',))}: version is {version!r:.60}, but this program "
            f"reads {VERSION} only"
        )
    try:
        layout = layout_of(document)
        problem = next(problems(layout), None)
    except Unreadable as error:
        problem = error.problem
    if problem:
        line = line_of(text, problem.path)
        raise IcwaferError(f"{name}:{line}: {key_name(problem.path)}: {problem.text}")
    return layout


def write_layout(path: Path, layout: Layout) -> None:
    """Writes a layout file: complete, or not at all.

    The same layout gives the same bytes, and reading the file gives an equal layout. Raises
    IcwaferError where the layout is not valid, or OSError.
    """
    check_layout(layout)
    with replacing(path) as unfinished:
        unfinished.write_text(layout_text(layout), encoding="utf-8")


def layout_text(layout: Layout) -> str:
    """The text of a layout file."""
    header = (f'format = "{FORMAT}"', f"version = {VERSION}")
    return "\n".join((*header, *lines_of_layout(layout))) + "\n"
