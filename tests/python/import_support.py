# SPDX-License-Identifier: GPL-2.0-or-later
"""What the tests of the import share: layout files made through KLayout, and outlines."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts" / "python"))

from icwafer.layout_import.outline import Outline  # noqa: E402
from icwafer.layout_import.reader import KLAYOUT  # noqa: E402

#: Writes files as KLayout does: a dictionary of names to cells as JSON on stdin, a cell being a
#: dictionary of layers ("68/20") to polygons, lists of corners in nanometres.
_WRITER = """
import json, sys
import klayout.db as db
for name, file in json.load(sys.stdin).items():
    layout = db.Layout()
    layout.dbu = file.get("dbu", 0.001)
    for cell_name, layers in file["cells"].items():
        cell = layout.create_cell(cell_name)
        for layer, polygons in layers.items():
            number, datatype = map(int, layer.split("/"))
            shapes = cell.shapes(layout.layer(number, datatype))
            for corners in polygons:
                shapes.insert(db.Polygon([db.Point(*corner) for corner in corners]))
    for parent, child, columns, rows, dx, dy in file.get("arrays", []):
        layout.cell(parent).insert(db.CellInstArray(
            layout.cell(child).cell_index(), db.Trans(), db.Vector(dx, 0), db.Vector(0, dy),
            columns, rows))
    layout.write(name)
"""

#: A chip of 30 x 30 um, full of wires of met2 in every track, 460 nm apart and 140 nm wide.
TRACKS_DEF = (
    "VERSION 5.8 ;\nDESIGN chip ;\nUNITS DISTANCE MICRONS 1000 ;\n"
    "DIEAREA ( 0 0 ) ( 30000 30000 ) ;\nNETS 1 ;\n- n + ROUTED met2 ( 230 0 ) ( * 30000 )\n"
    + "".join(f"  NEW met2 ( {230 + 460 * i} 0 ) ( * 30000 )\n" for i in range(1, 64))
    + " ;\nEND NETS\nEND DESIGN\n"
)
TRACKS_LEF = """VERSION 5.7 ;
UNITS
  DATABASE MICRONS 1000 ;
END UNITS
LAYER met2
  TYPE ROUTING ;
  DIRECTION VERTICAL ;
  PITCH 0.46 ;
  WIDTH 0.14 ;
END met2
MACRO cell
  CLASS CORE ;
  SIZE 2 BY 2 ;
END cell
END LIBRARY
"""

Corners = list[tuple[float, float]]


def write_layouts(files: dict[Path, dict]) -> None:
    """Writes layout files of any format that KLayout takes from the name's ending."""
    environment = os.environ | {
        "PYTHONPATH": str(KLAYOUT / "pymod"),
        "LD_LIBRARY_PATH": str(KLAYOUT),
    }
    subprocess.run(
        ["/usr/bin/python3", "-c", _WRITER],
        input=json.dumps({str(path): file for path, file in files.items()}).encode(),
        env=environment,
        check=True,
    )


def box(x0: float, y0: float, x1: float, y1: float) -> Corners:
    """Clockwise, as an outline wants it."""
    return [(x0, y0), (x0, y1), (x1, y1), (x1, y0)]


def wires(
    period: float, duty: float, angle_deg: float, reach: float, shift: float = 0.0
) -> list[Corners]:
    """Parallel wires that cover a square from -reach to reach about the origin, and more."""
    c, s = np.cos(np.radians(angle_deg)), np.sin(np.radians(angle_deg))
    count, length = int(1.5 * reach / period) + 2, 1.5 * reach
    middles = (np.arange(-count, count + 1) + shift) * period
    half = duty * period / 2
    return [
        [(c * x - s * y, s * x + c * y) for x, y in box(-length, v - half, length, v + half)]
        for v in middles
    ]


def outline(polygons: list[Corners], side: float) -> Outline:
    """Polygons that do not overlap, clipped to a window."""
    edges = []
    for corners in polygons:
        clipped = _clip(corners, side / 2)
        edges += [(*a, *b) for a, b in zip(clipped, clipped[1:] + clipped[:1])]
    return Outline(np.array(edges, dtype=np.float64).reshape(-1, 4), (side, side))


def _clip(corners: Corners, half: float) -> Corners:
    """A convex polygon inside the window, by Sutherland and Hodgman's method."""
    for axis in (0, 1):
        for sign in (1, -1):
            kept: Corners = []
            for a, b in zip(corners, corners[1:] + corners[:1]):
                room_a, room_b = half - sign * a[axis], half - sign * b[axis]
                if room_a >= 0:
                    kept.append(a)
                if room_a * room_b < 0:
                    t = room_a / (room_a - room_b)
                    kept.append((a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])))
            corners = kept
    return corners
