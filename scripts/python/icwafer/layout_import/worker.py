# SPDX-License-Identifier: GPL-2.0-or-later
"""Reads a layout file through KLayout and cuts out the metal of each tile: a program of its own.

A damaged or malicious file costs this process, whose memory and computing time are limited, and
nothing else. It gets a request as JSON on stdin and answers on stdout with messages: a line of
JSON each, and after that of a cutout its edges, `edges` x 4 int64, little-endian, in database
units; a request for solids is answered with `solids` x 8 int64 for each layer, the four corners of
trapezoids. `icwafer.layout_import.reader` is the other end.

KLayout must be importable here, and nowhere else.
"""

from __future__ import annotations

import itertools
import json
import os
import resource
import sys
import zlib
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np

from icwafer.layout_import.gds_arrays import array_without_pitch

#: Levels of cells in cells; real chips have ten to thirty.
MOST_LEVELS = 1000
#: Shapes of all tiles together, each instance of a cell counted.
MOST_SHAPES = 1_000_000_000
#: Edges of one layer in one window.
MOST_EDGES = 1_000_000
#: Shapes as drawn for one of the merged ones: cells overlap. And how many of these are turned into
#: numbers at once.
RAW = 4
CHUNK = 50_000
#: Without a wish: tiles of this side, or larger ones that are not more than so many, and of each
#: a window of at most this side.
USUAL_TILE_UM = 25.0
USUAL_TILES = 500
USUAL_WINDOW_UM = 50.0
SMALLEST_UM, LARGEST_UM = 1.0, 300_000.0

_SEPARATORS = str.maketrans("(),;", "    ")


class Refusal(Exception):
    """What is wrong with the file: the text goes to the user, after the file's name."""


def main() -> int:
    """Answers one request."""
    request = json.load(sys.stdin)
    for kind, limit in (("AS", request["limit_bytes"]), ("CPU", request["limit_seconds"])):
        number = getattr(resource, f"RLIMIT_{kind}")
        resource.setrlimit(number, (limit, resource.getrlimit(number)[1]))
    # What KLayout prints must not come between the messages.
    with os.fdopen(os.dup(1), "wb") as answer:
        os.dup2(2, 1)
        try:
            _answer(request, answer)
        except Refusal as refusal:
            _send(answer, error=str(refusal))
        except MemoryError:
            _send(answer, error="memory")
        except (RuntimeError, OSError, EOFError, zlib.error) as error:  # the first are KLayout's
            text = str(error).splitlines()[0].removesuffix(" in Layout.read")
            text = text.removesuffix(f": {request['path']}")
            advice = "write it anew with the program it is from, as GDSII, OASIS or DEF"
            broken = f"cannot be read: {text}; {advice}"
            _send(answer, error="memory" if "bad_alloc" in text else broken)
    return 0


def _send(answer: BinaryIO, **message: Any) -> None:
    answer.write(json.dumps(message).encode() + b"\n")
    answer.flush()


def _answer(request: dict[str, Any], answer: BinaryIO) -> None:
    import klayout.db as db

    flat = array_without_pitch(Path(request["path"]))
    if flat:
        raise Refusal(
            f"has an array of {flat[1]} times the cell '{flat[0]}' with a pitch of 0, all on one "
            "another: correct the array"
        )
    layout = db.Layout()
    options = db.LoadLayoutOptions()
    options.lefdef_config.lef_files = request["lef"]
    options.lefdef_config.read_lef_with_def = False
    layout.read(request["path"], options)
    top = _top_cell(layout, request["top"])
    layers = [_indices(layout, names) for names in request["layers"]]
    if not any(layers):
        found = sorted(info.to_s() for info in layout.layer_infos())
        raise Refusal(
            f"has none of the layers of process '{request['process']}'; it has "
            f"{', '.join(found[:12]) or 'none at all'}{', ...' if len(found) > 12 else ''}: "
            "give its own layer map with --layers"
        )
    _check_hierarchy(layout, top, {index for indices in layers for index in indices})
    size_um = (top.bbox().width() * layout.dbu, top.bbox().height() * layout.dbu)
    if not all(SMALLEST_UM <= side <= LARGEST_UM for side in size_um):
        raise Refusal(
            f"its cell '{top.name}' measures {size_um[0]:.4g} x {size_um[1]:.4g} um with units of "
            f"{layout.dbu:g} um, and a chip {SMALLEST_UM:g} to {LARGEST_UM:g} um: correct the "
            "units in the file"
        )
    if request["most_solids"]:
        _send(answer, top=top.name, size_um=size_um, tiles=[1, 1])
        _send_solids(db, answer, top, layers, layout.dbu, request["most_solids"])
        _send(answer, end=True)
        return
    usual_um = max(USUAL_TILE_UM, (size_um[0] * size_um[1] / USUAL_TILES) ** 0.5)
    tile_um = request["tile_um"] or usual_um
    window = (request["window_um"] or USUAL_WINDOW_UM) / layout.dbu
    tiles = [max(1, round(side / tile_um)) for side in size_um]
    _send(answer, top=top.name, size_um=size_um, tiles=tiles)
    for row in range(tiles[1]):
        for column in range(tiles[0]):
            box = _window(db, top.bbox(), tiles, (column, row), window)
            _send_tile(db, answer, top, layers, box, (column, row), layout.dbu)
    _send(answer, end=True)


def _top_cell(layout: Any, name: str | None) -> Any:
    tops = [cell.name for cell in layout.top_cells()]
    if name is None:
        filled = [cell for cell in layout.top_cells() if not cell.bbox().empty()]
        if len(filled) > 1:
            names = ", ".join(sorted(cell.name for cell in filled)[:8])
            raise Refusal(f"has {len(filled)} top cells, {names}: choose one with --top")
        if not filled:
            raise Refusal("is empty: there is no shape in it")
        return filled[0]
    cell = layout.cell(name)
    if cell is None:
        import difflib

        near = difflib.get_close_matches(name, [c.name for c in layout.each_cell()], n=1)
        hint = f"did you mean '{near[0]}'?" if near else f"its top cells are {', '.join(tops[:8])}"
        raise Refusal(f"has no cell '{name}': {hint}")
    if cell.bbox().empty():
        raise Refusal(f"its cell '{name}' is empty: choose another one with --top")
    return cell


def _indices(layout: Any, names: list[str]) -> list[int]:
    """The file's layers of some names: "68/20" of GDSII and OASIS, "met1" of LEF and DEF."""
    return [
        index
        for index in layout.layer_indexes()
        if {f"{layout.get_info(index).layer}/{layout.get_info(index).datatype}",
            layout.get_info(index).name} & set(names)
    ]


def _check_hierarchy(layout: Any, top: Any, layers: set[int]) -> None:
    """Refuses what would take forever to flatten."""
    within = {top.cell_index(), *top.called_cells()}
    levels: dict[int, int] = {}
    shapes: dict[int, int] = {}
    for index in layout.each_cell_bottom_up():
        if index not in within:
            continue
        cell = layout.cell(index)
        levels[index] = 0
        shapes[index] = sum(cell.shapes(layer).size() for layer in layers)
        for instance in cell.each_inst():
            copies = max(instance.na, 1) * max(instance.nb, 1)
            shapes[index] += copies * shapes[instance.cell_index]
            levels[index] = max(levels[index], 1 + levels[instance.cell_index])
    if levels[top.cell_index()] > MOST_LEVELS:
        raise Refusal(
            f"its cells are nested {levels[top.cell_index()]} levels deep, and at most "
            f"{MOST_LEVELS} are read: flatten it, or choose an inner cell with --top"
        )
    if shapes[top.cell_index()] > MOST_SHAPES:
        raise Refusal(
            f"its cell '{top.name}' has {shapes[top.cell_index()]:.2g} shapes, and at most "
            f"{MOST_SHAPES:.2g} are read: choose an inner cell with --top"
        )


def _window(
    db: Any, chip: Any, tiles: list[int], place: tuple[int, int], most: float
) -> Any:
    """The window in the middle of a tile: a box in database units, no side above `most`."""
    corners = [
        (low + (high - low) * i // n, low + (high - low) * (i + 1) // n)
        for low, high, i, n in zip(
            (chip.left, chip.bottom), (chip.right, chip.top), place, tiles
        )
    ]
    spare = [max(0, int((end - begin - most) / 2)) for begin, end in corners]
    (x0, x1), (y0, y1) = [(b + s, e - s) for (b, e), s in zip(corners, spare)]
    return db.Box(x0, y0, x1, y1)


def _send_tile(
    db: Any,
    answer: BinaryIO,
    top: Any,
    layers: list[list[int]],
    window: Any,
    place: tuple[int, int],
    dbu: float,
) -> None:
    """The merged shapes of each layer, and how much of them is seen from above.

    layers: from the top down.
    """
    above = db.Region()
    for number, indices in enumerate(layers):
        shapes = db.Region()
        for index in indices:
            shapes += db.Region(top.begin_shapes_rec_touching(index, window))
        shapes &= db.Region(window)
        shapes.merge()
        edges = shapes.edges()
        count = edges.count()
        if count > MOST_EDGES:
            raise Refusal(
                f"has {count} edges in one window of {window.width() * dbu:g} x "
                f"{window.height() * dbu:g} um, and at most {MOST_EDGES} are looked at: choose a "
                "smaller --window"
            )
        area = shapes.area()
        visible = (shapes - above).area() / area if area else 0.0
        above += shapes
        text = edges.to_s(count).translate(_SEPARATORS)
        corners = np.fromstring(text, dtype=np.int64, sep=" ") if count else np.empty(0, np.int64)
        _send(
            answer,
            tile=place,
            layer=number,
            edges=count,
            visible=visible,
            centre=[(window.left + window.right) / 2, (window.bottom + window.top) / 2],
            size_um=[window.width() * dbu, window.height() * dbu],
            dbu=dbu,
        )
        answer.write(corners.astype("<i8").tobytes())


def _send_solids(
    db: Any, answer: BinaryIO, top: Any, layers: list[list[int]], dbu: float, most: int
) -> None:
    """The merged shapes of each layer as trapezoids, or nothing if they are more than `most`.

    layers: from the top down. Corners are counted from the chip's lower left one.
    """
    if sum(top.shapes(index).size() for indices in layers for index in indices) > RAW * most:
        return
    parts = []
    for indices in layers:
        shapes = db.Region()
        for index in indices:
            shapes += db.Region(top.begin_shapes_rec(index))
            if shapes.count() > RAW * most:
                return
        parts.append(shapes.decompose_trapezoids_to_region())
        if sum(part.count() for part in parts) > most:
            return
    chip = top.bbox()
    for number, part in enumerate(parts):
        _send(answer, layer=number, solids=part.count(), dbu=dbu)
        polygons = part.each()
        while chunk := list(itertools.islice(polygons, CHUNK)):
            corners = (
                [(point.x - chip.left, point.y - chip.bottom) for point in each.each_point_hull()]
                for each in chunk
            )
            # A triangle has its last corner twice.
            table = np.array([four + four[-1:] * (4 - len(four)) for four in corners], "<i8")
            answer.write(table.tobytes())


if __name__ == "__main__":
    sys.exit(main())
