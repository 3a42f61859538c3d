# SPDX-License-Identifier: GPL-2.0-or-later
"""What a portrait shows: a layout, and the wires of a chip that was imported for it."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from icwafer.chips.document import ENDING, read_layout
from icwafer.chips.model import BlockTable, DieSpec, Layout
from icwafer.chips.presets.parts import drifting_wafer
from icwafer.errors import IcwaferError
from icwafer.layout_import.importer import import_layout
from icwafer.layout_import.process import Process, read_process
from icwafer.layout_import.reader import Request
from icwafer.pictures import NodeValue
from icwafer.portrait.wires import Wires, read_wires

#: Endings of the files that are imported.
CHIPS = (".gds", ".gds.gz", ".oas", ".def")
#: The longer side of a wafer's dies: nothing could be seen of smaller ones.
_SMALLEST_MM = 6.0


@dataclass(frozen=True)
class Subject:
    """layout: with a wafer where one is wanted. wires: None to show the die as blocks. node: what
    the process says of the node's properties."""

    layout: Layout
    wires: Wires | None = None
    node: dict[str, NodeValue] = field(default_factory=dict)


def subject_of(
    path: Path,
    layers: str,
    lef: tuple[Path, ...],
    top: str | None,
    wafer: bool,
    tile_um: float | None = None,
    window_um: float | None = None,
    progress: Callable[[float], None] = lambda _: None,
) -> Subject:
    """Reads a layout file, or imports a chip; `layers` names its process or a layer map.

    top, tile_um, window_um: see `reader.Request`. progress is told how much is done, 0 to 1.
    Raises IcwaferError where the file cannot be read.
    """
    if path.name.endswith(ENDING):
        layout = read_layout(path)
        return Subject(with_wafer(layout) if wafer else layout)
    if not path.name.lower().endswith(CHIPS):
        raise IcwaferError(
            f"{path}: neither a layout ({ENDING}) nor a chip ({', '.join(CHIPS)}); "
            "name such a file"
        )
    process = read_process(layers)
    request = Request(path, process, tile_um, window_um, top, lef)
    imported = import_layout(request, progress)
    node = {"metal": _metal(process)}
    if wafer:
        return Subject(with_wafer(imported.layout), node=node)
    return Subject(imported.layout, read_wires(request, imported), node)


def _metal(process: Process) -> str:
    return process.layers[0].metal.upper()


def with_wafer(layout: Layout) -> Layout:
    """The layout, with a usual wafer if it has none; then small chips are shown enlarged."""
    if layout.wafer is not None:
        return layout
    die = layout.dies[0]
    if die.blocks is not None:
        die = _enlarged(die, die.blocks)
    return dataclasses.replace(layout, dies=(die,), wafer=drifting_wafer(partial_dies=True))


def _enlarged(die: DieSpec, blocks: BlockTable) -> DieSpec:
    """Of `_SMALLEST_MM` or more, the wires unchanged."""
    factor = math.ceil(_SMALLEST_MM / max(die.width_mm, die.height_mm))
    return dataclasses.replace(
        die,
        width_mm=die.width_mm * factor,
        height_mm=die.height_mm * factor,
        blocks=BlockTable(blocks.rect_nm * factor, blocks.group),
    )
