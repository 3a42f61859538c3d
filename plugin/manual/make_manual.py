#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Write ic_wafer_bsdf.html, the page that F1 opens on the node, from the table of its inputs.

The inputs come from shaders/icwafer/node_inputs.h, the same table that Blender's sockets and
tooltips are made of, their pictures from sweeps.py, the attributes of meshes from
icwafer.attributes, as those in the add-on's panel. With --check nothing is written; the exit status
says whether the page is up to date.
"""

import html
import math
import re
import string
import sys
from dataclasses import dataclass
from pathlib import Path

from sweeps import SWEEPS, Sweep

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "scripts" / "python"))

from icwafer.attributes import OF_FACES, OF_INSTANCES  # noqa: E402

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
        inputs.append(
            FloatInput(
                identifier,
                name,
                float(initial),
                float(minimum),
                float(maximum),
                kind,
                model,
                "".join(re.findall(r'"([^"]*)"', tooltip)),
            )
        )
    return inputs


def _entry(name: str, initial: str, meaning: str, limits: str = "") -> str:
    """An input or menu with its pictures."""
    identity = name.lower().replace(" ", "-")
    facts = f"default {initial}" + (f", {limits}" if limits else "")
    return (
        f'<section class=input id="{identity}">\n<h3>{html.escape(name)} '
        f"<small>{facts}</small></h3>\n<p>{meaning}.</p>\n{_pictures(SWEEPS[name])}</section>"
    )


def _pictures(sweep: Sweep) -> str:
    note = (
        f"<p class=note>In these pictures: {html.escape(sweep.note)}.</p>\n" if sweep.note else ""
    )
    figures = "".join(
        f'<figure><img src="{sweep.file(panel).relative_to(HERE)}" width=200 height=200 loading=lazy '
        f'alt="{html.escape(f"{sweep.name}: {panel.label}")}">'
        f"<figcaption>{html.escape(panel.label)}</figcaption></figure>\n"
        for panel in sweep.panels
    )
    return f"<div class=panels>\n{figures}</div>\n{note}"


def _floats(model: str) -> str:
    """The inputs that only this model has, or those that both have."""
    return "\n".join(
        _entry(i.name, _number(i, i.initial), html.escape(i.tooltip),
               f"{_number(i, i.minimum)} to {_number(i, i.maximum)}")
        for i in float_inputs() if i.model == model
    )  # fmt: skip


def _number(of: FloatInput, value: float) -> str:
    """As Blender shows it."""
    text = f"{math.degrees(value):.4g}°" if of.kind == "ANGLE" else f"{value:.6g}"
    return text.replace("-", "−")


#: Inputs and menus that are not in the table, by where they stand: default and meaning, as HTML.
_OTHERS = {
    "first": {
        "Color": ("white", "Tint of everything that is reflected. White: the colours of physics"),
    },
    "frame": {
        "Normal": (
            "the geometry's own",
            "Direction of the surface, as from a Bump or Normal Map node. Small slopes move the "
            "colours far: a hundredth is enough for the waviness of a wafer",
        ),
        "Tangent": (
            "the object's X axis",
            "Direction from which <b>Direction</b> is counted, as from a Tangent node. Around the "
            "axis of an object, with Direction 0: an optical disc",
        ),
    },
    "menus": {
        "Metal": (
            "Copper",
            "Copper (Johnson and Christy 1972), Aluminium (Rakić 1995), Tungsten (Werner et al. "
            "2009), Silicon (Green 2008), or your own by <b>Metal n</b> and <b>Metal k</b>",
        ),
        "Metal n": (
            "0.27, 0.68, 1.3",
            "Index of refraction of a custom metal in red, green and blue light (612, 549, "
            "464&nbsp;nm). Gold: 0.2, 0.4, 1.4",
        ),
        "Metal k": (
            "3.4, 2.62, 2.4",
            "Extinction of a custom metal in red, green and blue light. Larger is more "
            "mirror-like. Gold: 3.1, 2.4, 1.9",
        ),
        "Oxide": (
            "Silicon Dioxide",
            "Silicon dioxide (Malitson 1965), silicon nitride (Philipp 1973), both with "
            "dispersion, or your own: then <b>Oxide IOR</b> counts",
        ),
        "Illuminant": (
            "Equal Energy",
            "Spectrum of the lamps that light the material. Equal energy and daylight give smooth "
            "rainbows, a three-band fluorescent tube (F11) separate images of the tube in its own "
            "colours, sodium one sharp image. A white surface stays white under all of them; the "
            "colour of the lamp itself is set at the lamp",
        ),
    },
    "effects": {
        "Effects": (
            "all on",
            "<b>Grating</b>: interference between the wires, the separate bands; off: wires at "
            "random distances. <b>Thin Film</b>: interference in the oxide. <b>Wire "
            "Diffraction</b>: diffraction within a single wire",
        ),
    },
}


def _row(name: str, *cells: str) -> str:
    """Of a table of attributes."""
    return f"<tr><td><code>{name}</code>" + "".join(f"<td>{html.escape(cell)}" for cell in cells)


def page_text() -> str:
    """The whole page."""
    others = {
        place: "\n".join(_entry(name, *facts) for name, facts in entries.items())
        for place, entries in _OTHERS.items()
    }
    return string.Template(TEMPLATE.read_text()).substitute(
        both="\n".join([others["first"], _floats("BOTH"), others["frame"]]),
        physical="\n".join([_floats("PHYSICAL"), others["menus"]]),
        cs348b="\n".join([_floats("CS348B"), others["effects"]]),
        faces="\n".join(_row(a.name, a.unit, a.meaning, a.socket) for a in OF_FACES),
        instances="\n".join(_row(a.name, a.meaning) for a in OF_INSTANCES),
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
