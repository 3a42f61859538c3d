#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Write ic_wafer_bsdf.html, the page that F1 opens on the node, from the table of its inputs.

The inputs come from shaders/icwafer/node_inputs.h, the same table that Blender's sockets and
tooltips are made of. With --check nothing is written; the exit status says whether the page is up
to date.
"""

import html
import re
import string
import sys
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).resolve().parent
TABLE = HERE.parents[1] / "shaders" / "icwafer" / "node_inputs.h"
TEMPLATE = HERE / "ic_wafer_bsdf.template.html"
PAGE = HERE / "ic_wafer_bsdf.html"

_ROW = re.compile(
    r'X\((\w+), "([^"]+)", ([-\d.]+)f, ([-\d.]+)f, ([-\d.]+)f, (\w+), (\w+),\s*(".*")\)\s*',
    re.DOTALL,
)


@dataclass(frozen=True)
class FloatInput:
    """One float input of the node.

    `kind` is NONE, FACTOR or ANGLE (radian); `model` the one that has it, or BOTH.
    """

    identifier: str
    name: str
    initial: float
    minimum: float
    maximum: float
    kind: str
    model: str
    tooltip: str


def float_inputs() -> list[FloatInput]:
    """The rows of ICWAFER_NODE_FLOATS, in order."""
    text = TABLE.read_text()
    text = text[text.index("#define ICWAFER_NODE_FLOATS") :].replace("\\\n", " ")
    text = text.split("(X)", 1)[1].split("// clang-format", 1)[0]
    inputs = []
    for row in re.split(r"\s(?=X\()", text):
        if not row.strip():
            continue
        match = _ROW.fullmatch(row)
        if match is None:
            raise SystemExit(f"{TABLE}: cannot read this row of the table: {row.strip()[:60]}")
        identifier, name, initial, minimum, maximum, kind, model, tooltip = match.groups()
        inputs.append(FloatInput(
            identifier, name, float(initial), float(minimum), float(maximum), kind, model,
            "".join(re.findall(r'"([^"]*)"', tooltip)),
        ))
    return inputs


def _row(name: str, initial: str, meaning: str) -> str:
    cells = (f"<th scope=row>{html.escape(name)}", f"<td>{initial}", f"<td>{html.escape(meaning)}.")
    return "<tr>" + "".join(cells)


def _rows(model: str) -> str:
    """The table rows of the inputs that only this model has, or of those that both have."""
    return "\n".join(
        _row(i.name, f"{i.initial:g}", i.tooltip) for i in float_inputs() if i.model == model
    )


def page_text() -> str:
    """The whole page."""
    color = _row("Color", "white", "Tint of everything that is reflected. White: the colours of "
                                   "physics")
    frame = [
        _row("Normal", "–", "Direction of the surface; the geometry's own where nothing is linked"),
        _row("Tangent", "–", "Direction from which Direction is counted; the object's X axis where "
                             "nothing is linked"),
    ]
    return string.Template(TEMPLATE.read_text()).substitute(
        both="\n".join([color, _rows("BOTH"), *frame]),
        physical=_rows("PHYSICAL"),
        cs348b=_rows("CS348B"),
    )


def main() -> int:
    text = page_text()
    if "--check" in sys.argv[1:]:
        if PAGE.read_text() != text:
            print(f"{PAGE.name} is out of date: run plugin/manual/make_manual.py", file=sys.stderr)
            return 1
        return 0
    PAGE.write_text(text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
