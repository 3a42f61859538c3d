# SPDX-License-Identifier: GPL-2.0-or-later
"""Fills macros with blocks, after their kind. All macros of one kind are filled at once."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from icwafer.chips.geometry import frames, grids, sliced
from icwafer.chips.model import UM, Kind
from icwafer.chips.plan import Plan


class _Blocks(NamedTuple):
    """rect_nm (n, 4), the index (n,) of the macro, and whether the blocks of a macro are copies."""

    rect_nm: np.ndarray
    parent: np.ndarray
    kind: Kind
    alike: bool = True


_Fill = Callable[[np.random.Generator, np.ndarray, int], list[_Blocks]]


def fill(rng: np.random.Generator, rects: np.ndarray, kinds: np.ndarray, block_nm: int) -> Plan:
    """The blocks of m macros, sorted by macro.

    rects: (m, 4) int64, kinds: (m,). block_nm: usual side of a block of logic.
    """
    parts: list[tuple[_Blocks, np.ndarray]] = []  # and the macros that their parents stand for
    for kind in np.unique(kinds):
        members = np.flatnonzero(kinds == kind)
        inside = rects[members]
        if kind in _WITH_CHANNEL:
            sides = inside[:, 2:] - inside[:, :2]
            width = np.minimum(8 * UM, sides.min(axis=1) // 30)
            wide = width > 0
            channel, parent, framed = frames(inside[wide], width[wide])
            parts.append((_Blocks(channel, parent, Kind.STRIP), members[wide]))
            inside[wide] = framed
        parts += [(blocks, members) for blocks in _FILLS[kind](rng, inside, block_nm)]

    macro = np.concatenate([members[blocks.parent] for blocks, members in parts])
    cells, count = [], 0
    for blocks, members in parts:
        local = blocks.parent if blocks.alike else np.arange(len(blocks.parent))
        cells.append(local + count)
        count += len(members) if blocks.alike else len(local)
    order = np.argsort(macro.astype(np.int32), kind="stable")
    return Plan(
        np.concatenate([blocks.rect_nm for blocks, _ in parts])[order],
        np.repeat(
            np.array([blocks.kind for blocks, _ in parts], dtype=np.int8),
            [len(blocks.parent) for blocks, _ in parts],
        )[order],
        macro[order],
        np.concatenate(cells)[order],
    )


def _whole(kind: Kind) -> _Fill:
    """One block that is the macro."""
    return lambda rng, rects, block_nm: [_Blocks(rects, np.arange(len(rects)), kind)]


def _irregular(kind: Kind, blocks: float, max_aspect: float) -> _Fill:
    """Blocks of about `blocks` times the usual area, each with wires of its own."""

    def filled(rng: np.random.Generator, rects: np.ndarray, block_nm: int) -> list[_Blocks]:
        area = np.full(len(rects), blocks * block_nm**2)
        return [_Blocks(*sliced(rng, rects, area, max_aspect), kind, alike=False)]

    return filled


def _array(kind: Kind, along: float, across: float) -> _Fill:
    """Equal tiles, in usual sides along the macro's longer side and across it."""

    def filled(rng: np.random.Generator, rects: np.ndarray, block_nm: int) -> list[_Blocks]:
        lying, turned = _laid_down(rects)
        tiles, parent = grids(
            lying,
            _count(lying[:, 2] - lying[:, 0], along * block_nm),
            _count(lying[:, 3] - lying[:, 1], across * block_nm),
        )
        return [_Blocks(_stood_up(tiles, turned[parent]), parent, kind)]

    return filled


def _memory(rng: np.random.Generator, rects: np.ndarray, block_nm: int) -> list[_Blocks]:
    """Rows of cells in two halves; the spine between them holds decoders and is dark."""
    lying, turned = _laid_down(rects)
    width = lying[:, 2] - lying[:, 0]
    spine = np.maximum(1, np.minimum(26 * UM, width // 16))
    left, middle, right = lying.copy(), lying.copy(), lying.copy()
    left[:, 2] = middle[:, 0] = lying[:, 0] + (width - spine) // 2
    middle[:, 2] = right[:, 0] = middle[:, 0] + spine
    halves = np.stack([left, right], axis=1).reshape(-1, 4)
    tiles, half = grids(
        halves,
        _count(halves[:, 2] - halves[:, 0], 5 * block_nm),
        _count(halves[:, 3] - halves[:, 1], 0.45 * block_nm),
    )
    return [
        _Blocks(_stood_up(middle, turned), np.arange(len(rects)), Kind.STRIP),
        _Blocks(_stood_up(tiles, turned[half // 2]), half // 2, Kind.MEMORY),
    ]


def _count(extent_nm: np.ndarray, tile_nm: float) -> np.ndarray:
    return np.maximum(1, np.rint(extent_nm / tile_nm)).astype(np.int64)


def _laid_down(rects: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Rectangles with x and y exchanged where they stand, and where that is."""
    turned = rects[:, 3] - rects[:, 1] > rects[:, 2] - rects[:, 0]
    return _stood_up(rects, turned), turned


def _stood_up(rects: np.ndarray, turned: np.ndarray) -> np.ndarray:
    return np.where(turned[:, None], rects[:, [1, 0, 3, 2]], rects)


_FILLS: dict[Kind, _Fill] = {
    Kind.LOGIC: _irregular(Kind.LOGIC, blocks=1.0, max_aspect=3.5),
    Kind.MEMORY: _memory,
    Kind.ANALOG: _irregular(Kind.ANALOG, blocks=3.0, max_aspect=2.0),
    Kind.IO: _whole(Kind.IO),
    Kind.STRIP: _whole(Kind.STRIP),
    Kind.BUS: _array(Kind.BUS, along=8.0, across=0.25),
    Kind.PIXEL: _array(Kind.PIXEL, along=2.0, across=2.0),
    Kind.FILL: _array(Kind.FILL, along=0.5, across=0.5),
    Kind.SEAL: _whole(Kind.SEAL),
}

_WITH_CHANNEL = {Kind.LOGIC, Kind.MEMORY, Kind.ANALOG}
