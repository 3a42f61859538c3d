# SPDX-License-Identifier: GPL-2.0-or-later
"""Checks of a table of blocks, fast enough for a million of them."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from icwafer.chips.model import MAX_BLOCKS, UM, BlockTable, DieSpec, size_nm


def block_problems(blocks: BlockTable, spec: DieSpec) -> Iterator[str]:
    """What is wrong with the blocks of a die: shapes, groups, no area, outside the die."""
    rect, group = blocks.rect_nm, blocks.group
    if rect.shape != (len(group), 4) or group.ndim != 1:
        yield f"shapes {rect.shape} and {group.shape} are not (n, 4) and (n,)"
        return
    if not 0 < len(rect) <= MAX_BLOCKS:
        yield f"{len(rect)} blocks: there must be 1 to {MAX_BLOCKS}"
        return
    wrong = np.flatnonzero((group < 0) | (group >= len(spec.groups)))
    if len(wrong):
        yield (
            f"block {wrong[0] + 1} has group {group[wrong[0]] + 1}, "
            f"but there are groups 1 to {len(spec.groups)}"
        )
    empty = np.flatnonzero((rect[:, 2:] <= rect[:, :2]).any(axis=1))
    if len(empty):
        yield f"block {empty[0] + 1}, {_spelled(rect[empty[0]])}, has no area"
    outside = np.flatnonzero(
        (rect[:, :2] < 0).any(axis=1) | (rect[:, 2:] > size_nm(spec)).any(axis=1)
    )
    if len(outside):
        yield (
            f"block {outside[0] + 1}, {_spelled(rect[outside[0]])}, is not inside the die of "
            f"{spec.width_mm:g} x {spec.height_mm:g} mm"
        )


def overlap_problems(blocks: BlockTable) -> Iterator[str]:
    """Which blocks overlap. They must have no other problems."""
    pair = overlap(blocks.rect_nm)
    if pair:
        first, second = sorted(pair)
        yield f"blocks {first + 1}, {_spelled(blocks.rect_nm[first])}, and {second + 1} overlap"


def _spelled(rect: np.ndarray) -> str:
    return "[{:g}, {:g}, {:g}, {:g}] um".format(*(rect / UM))


def overlap(rect: np.ndarray) -> tuple[int, int] | None:
    """Two of n rectangles (n, 4) that overlap, or None.

    Every rectangle is noted in all cells that it touches of a grid whose cells are as large as the
    mean rectangle; only those of one cell are compared. Full cells are divided again.
    """
    if len(rect) < 2:
        return None
    low = rect[:, :2].min(axis=0)
    cell = np.maximum(1, np.ceil((rect[:, 2:] - rect[:, :2]).mean(axis=0))).astype(np.int64)
    first, last = (rect[:, :2] - low) // cell, (rect[:, 2:] - 1 - low) // cell
    spans = last - first + 1
    counts = spans.prod(axis=1)
    index = np.repeat(np.arange(len(rect)), counts)
    place = np.arange(len(index)) - np.repeat(np.cumsum(counts) - counts, counts)
    column = first[index, 0] + place % spans[index, 0]
    row = first[index, 1] + place // spans[index, 0]
    key = row * (int(last[:, 0].max()) + 1) + column
    order = np.argsort(key, kind="stable")
    key, index = key[order], index[order]

    starts = np.flatnonzero(np.r_[True, key[1:] != key[:-1]])
    sizes = np.diff(np.r_[starts, len(key)])
    full = (sizes > 64) & (sizes < len(rect))
    for start, size in zip(starts[full], sizes[full]):
        members = index[start : start + size]
        pair = overlap(rect[members])
        if pair:
            return int(members[pair[0]]), int(members[pair[1]])
    rest = ~np.repeat(full, sizes)
    return _overlap_in_cells(rect, key[rest], index[rest])


def _overlap_in_cells(
    rect: np.ndarray, key: np.ndarray, index: np.ndarray
) -> tuple[int, int] | None:
    """Compares each entry with the next ones of its cell, the keys being sorted."""
    for step in range(1, len(key)):
        same = key[step:] == key[:-step]
        if not same.any():
            return None
        a, b = index[:-step][same], index[step:][same]
        meet = (rect[a, :2] < rect[b, 2:]).all(axis=1) & (rect[b, :2] < rect[a, 2:]).all(axis=1)
        if meet.any():
            at = int(np.argmax(meet))
            return int(a[at]), int(b[at])
    return None
