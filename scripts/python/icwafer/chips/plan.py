# SPDX-License-Identifier: GPL-2.0-or-later
"""Plans: the blocks of a floorplan before they have wires, and how plans are put together."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from icwafer.chips.geometry import Rect, length
from icwafer.chips.model import Kind


@dataclass(frozen=True)
class Plan:
    """Blocks of a floorplan.

    rect_nm: (n, 4) int64, x0, y0, x1, y1 of each block.
    kind: (n,) int8, a `Kind`.
    macro: (n,) int64; blocks of one macro belong to one group of wires.
    cell: (n,) int64, every number from 0 up to the largest is there; blocks of one cell are copies
    of each other and share their wires.
    roles: for each macro, the name of the group that it asks for, or ""; no macro asks if empty.
    """

    rect_nm: np.ndarray
    kind: np.ndarray
    macro: np.ndarray
    cell: np.ndarray
    roles: tuple[str, ...] = ()

    def __len__(self) -> int:
        return len(self.rect_nm)


def plan(rects: Sequence[Rect], kind: Kind, cells: Sequence[int]) -> Plan:
    """One macro of blocks of one kind."""
    return Plan(
        rect_nm=np.array(rects, dtype=np.int64).reshape(-1, 4),
        kind=np.full(len(rects), kind, dtype=np.int8),
        macro=np.zeros(len(rects), dtype=np.int64),
        cell=np.array(cells, dtype=np.int64),
    )


def copied(
    rect_nm: np.ndarray, source: Rect, targets: np.ndarray, flips: np.ndarray
) -> np.ndarray:
    """Rectangles (n, 4) of `source` moved, scaled and mirrored into k targets: (k * n, 4).

    targets: (k, 4). flips: (k, 2) bool, whether x and y are mirrored. A coordinate that two blocks
    share is rounded once for both, so copies stay free of gaps.
    """
    rects = np.empty((len(targets), *rect_nm.shape), dtype=np.int64)
    for axis in (0, 1):
        offset, extent = rect_nm[:, axis::2] - source[axis], length(source, axis)
        low, high = targets[:, axis], targets[:, axis + 2]
        for flip in (False, True):
            of = np.flatnonzero(flips[:, axis] == flip)
            if len(of):
                of = slice(None) if len(of) == len(targets) else of
                placed = extent - offset[:, ::-1] if flip else offset
                if (high - low == extent).all():
                    rects[of, :, axis::2] = low[of, None, None] + placed
                else:
                    scaled = placed / extent * (high - low)[of, None, None]
                    rects[of, :, axis::2] = low[of, None, None] + np.rint(scaled).astype(np.int64)
    return rects.reshape(-1, 4)


def copy(
    original: Plan, source: Rect, target: Rect, flip_x: bool = False, flip_y: bool = False
) -> Plan:
    """A plan moved, scaled and mirrored, wires unchanged."""
    rect = copied(original.rect_nm, source, np.array([target]), np.array([[flip_x, flip_y]]))
    return Plan(rect, original.kind, original.macro, original.cell)


def concatenate(plans: Sequence[Plan]) -> Plan:
    """Plans that share their macros and cells: copies of one another."""
    return Plan(
        *(
            np.concatenate([getattr(plan, name) for plan in plans])
            for name in ("rect_nm", "kind", "macro", "cell")
        )
    )


def join(plans: Sequence[Plan]) -> Plan:
    """Plans that have nothing in common: their macros and cells are numbered on."""
    renumbered, macros, cells = [], 0, 0
    for part in plans:
        renumbered.append(Plan(part.rect_nm, part.kind, part.macro + macros, part.cell + cells))
        macros += int(part.macro.max()) + 1
        cells += int(part.cell.max()) + 1
    return concatenate(renumbered)
