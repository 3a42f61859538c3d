# SPDX-License-Identifier: GPL-2.0-or-later
"""A layout file of a real chip in, a layout of blocks and groups out."""

from __future__ import annotations

import os
import signal
from collections import deque
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from icwafer.chips.model import BlockTable, DieSpec, Layout
from icwafer.errors import IcwaferError
from icwafer.layout_import.groups import group_looks, layout_group, rectangles
from icwafer.layout_import.optics import Finding, Look, look_of
from icwafer.layout_import.reader import Chip, Cutout, Request, cut_out
from icwafer.layout_import.spectrum import find_gratings


@dataclass(frozen=True)
class Imported:
    """What came of a file.

    findings: the gratings of each tile, by column and row. looks: the same tiles as the node shows
    them.
    """

    layout: Layout
    chip: Chip
    findings: dict[tuple[int, int], tuple[Finding, ...]]
    looks: dict[tuple[int, int], Look]


def import_layout(
    request: Request, progress: Callable[[float], None] = lambda _: None
) -> Imported:
    """Reads a chip and finds what it is made of; one tile after the other, on all processors.

    progress is told how much of the tiles is done, 0 to 1. Raises IcwaferError where the file
    cannot be read.
    """
    parts = cut_out(request)
    chip = next(parts)
    found: dict[tuple[int, int], list[Finding]] = {
        (column, row): [] for row in range(chip.tiles[1]) for column in range(chip.tiles[0])
    }
    any_metal = False
    cutouts = len(found) * len(request.process.layers)
    for number, (cutout, gratings) in enumerate(_examined(parts)):
        progress(number / cutouts)
        any_metal |= len(cutout.outline.edges_um) > 0
        found[cutout.tile] += [Finding(cutout.layer, cutout.visible, g) for g in gratings]
    if not any_metal:
        raise IcwaferError(
            f"{request.path}: its cell '{chip.top}' has no shapes on the metal layers of process "
            f"'{request.process.name}'; choose another cell with --top, or give its own layer map "
            "with --layers"
        )
    findings = {tile: tuple(gratings) for tile, gratings in found.items()}
    looks = {tile: look_of(gratings, request.process) for tile, gratings in findings.items()}
    return Imported(_layout(request, chip, list(looks.values())), chip, findings, looks)


def _examined(parts: Iterator[Cutout]) -> Iterator[tuple[Cutout, list]]:
    """The gratings of each cutout, in order; never many cutouts at once."""
    # Not above: multiprocessing keeps a reference to the main module, and Blender, which also
    # imports this one, frees that of a script on its command line and crashes when it ends.
    from concurrent.futures import Future, ProcessPoolExecutor

    jobs = len(os.sched_getaffinity(0))
    with ProcessPoolExecutor(jobs, initializer=_leave_interrupts_to_the_parent) as pool:
        waiting: deque[tuple[Cutout, Future]] = deque()
        try:
            for cutout in parts:
                waiting.append((cutout, pool.submit(find_gratings, cutout.outline)))
                if len(waiting) > 4 * jobs:
                    done, future = waiting.popleft()
                    yield done, future.result()
            for done, future in waiting:
                yield done, future.result()
        finally:
            for _, future in waiting:
                future.cancel()


def _leave_interrupts_to_the_parent() -> None:
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.SIG_IGN)


def _layout(request: Request, chip: Chip, looks: list[Look]) -> Layout:
    """looks: row by row from the bottom."""
    members, group_of = group_looks(looks)
    groups = tuple(
        layout_group([looks[i] for i in indices], number + 1, request.process)
        for number, indices in enumerate(members)
    )
    columns, rows = chip.tiles
    cuts = [
        np.arange(count + 1) * round(1000 * side) // count
        for count, side in zip(chip.tiles, chip.size_um)
    ]
    blocks = np.array(
        [
            (cuts[0][x0], cuts[1][y0], cuts[0][x1], cuts[1][y1], group)
            for x0, y0, x1, y1, group in rectangles(group_of.reshape(rows, columns))
        ],
        dtype=np.int64,
    )
    die = DieSpec(
        groups=groups,
        name=chip.top[:60],
        width_mm=cuts[0][-1] / 1e6,
        height_mm=cuts[1][-1] / 1e6,
        blocks=BlockTable(blocks[:, :4], blocks[:, 4].astype(np.int32)),
    )
    return Layout(dies=(die,))
