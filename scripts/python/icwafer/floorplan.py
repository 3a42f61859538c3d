# SPDX-License-Identifier: GPL-2.0-or-later
"""The floorplan of a processor: where the blocks of a die lie and what kind each one is.

A die is cut into regions (a ring of pads, processor cores around a shared cache, an array of
graphics tiles, memory interfaces, the rest), a region into macros, and a macro into blocks. Like
on a real chip the cores are mirrored copies of one core and the graphics tiles copies of one tile.

All coordinates are whole nanometres, and every cut goes through a whole number, so that neighbours
share their edges exactly: no overlap, no gap, and areas add up without any tolerance.
"""

from __future__ import annotations

import enum
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

UM = 1000  # nm
MM = 1000 * UM

Rect = tuple[int, int, int, int]  # x0, y0, x1, y1 in nm, x0 < x1 and y0 < y1


class Kind(enum.IntEnum):
    """What a block is, which decides how its macro is filled."""

    LOGIC = 0  # many small irregular blocks
    MEMORY = 1  # a regular array of rows, two halves beside a dark spine
    ANALOG = 2  # few large blocks
    IO = 3  # pads and their drivers
    STRIP = 4  # a channel without a regular pattern of wires: dark


@dataclass(frozen=True)
class Plan:
    """Blocks of a floorplan.

    rect_nm: (n, 4) int64, x0, y0, x1, y1 of each block.
    kind: (n,) int8, a `Kind`.
    macro: (n,) int64; blocks of one macro belong to one group of wires.
    cell: (n,) int64; blocks of one cell are copies of each other and share their wires.
    """

    rect_nm: np.ndarray
    kind: np.ndarray
    macro: np.ndarray
    cell: np.ndarray

    def __len__(self) -> int:
        return len(self.rect_nm)


def processor(rng: np.random.Generator, width_nm: int, height_nm: int) -> Plan:
    """Floorplan of a processor die with its lower left corner at (0, 0); several thousand blocks.

    Sizes are meant for dies of 5 mm and more on each side; block sizes do not scale with the die.
    """
    die = (0, 0, width_nm, height_nm)
    seal, ring = _frame(die, 70 * UM)
    pads, inside = _pad_ring(ring, depth_nm=140 * UM, pitch_nm=150 * UM)
    moat, core = _frame(inside, 60 * UM)

    cluster, channel, rest = _split(core, 0, [rng.uniform(0.52, 0.58), _share(core, 0, 70 * UM)])
    graphics, street, uncore, bank = _split(
        rest, 1, [rng.uniform(0.42, 0.48), _share(rest, 1, 50 * UM), rng.uniform(0.30, 0.34)]
    )
    plan = _join(
        [
            *(_one(rect, Kind.STRIP) for rect in (*seal, *moat, channel, street)),
            pads,
            _cores(rng, cluster),
            _repeat(graphics, 6, 4, lambda tile: _macros(rng, tile, 0.16, GRAPHICS)),
            _macros(rng, uncore, 0.45, UNCORE),
            _repeat(bank, 4, 1, lambda tile: _macros(rng, tile, 0.20, INTERFACE)),
        ]
    )
    # Half of all seeds have their cores on the other side.
    return _copy(plan, die, die, flip_x=bool(rng.integers(2)), flip_y=bool(rng.integers(2)))


# Shares of the kinds among the macros of a region.
CORE = {Kind.LOGIC: 0.62, Kind.MEMORY: 0.33, Kind.ANALOG: 0.05}
GRAPHICS = {Kind.LOGIC: 0.55, Kind.MEMORY: 0.45}
UNCORE = {Kind.LOGIC: 0.70, Kind.MEMORY: 0.18, Kind.ANALOG: 0.12}
INTERFACE = {Kind.LOGIC: 0.35, Kind.MEMORY: 0.25, Kind.ANALOG: 0.40}


def _cores(rng: np.random.Generator, rect: Rect) -> Plan:
    """Four cores above and four below the cache that they share."""
    cache_share = rng.uniform(0.20, 0.25)
    lower, cache, upper = _split(rect, 1, [(1 - cache_share) / 2, cache_share])
    core_rects = [*_grid(lower, 4, 1), *_grid(upper, 4, 1)]
    core = _macros(rng, core_rects[0], 0.22, CORE)
    copies = [
        _copy(core, core_rects[0], target, flip_x=bool(index % 2), flip_y=index >= 4)
        for index, target in enumerate(core_rects)
    ]
    slices = _repeat(cache, 4, 2, lambda tile: _macro(rng, tile, Kind.MEMORY))
    return _join([_concatenate(copies), slices])


def _macros(
    rng: np.random.Generator, rect: Rect, area_mm2: float, shares: dict[Kind, float]
) -> Plan:
    """Cuts a region into macros of about the given area and fills each after its kind.

    Every kind gets its share of the macros, to the nearest whole one, in random order: drawing
    each macro for itself would leave whole regions without memory for some seeds.
    """
    rects = _slice(rng, rect, area_mm2, max_aspect=2.5)
    bounds = np.round(np.cumsum(list(shares.values())) * len(rects))
    kinds = [list(shares)[np.searchsorted(bounds, place + 0.5)] for place in range(len(rects))]
    return _join([_macro(rng, r, kinds[k]) for r, k in zip(rects, rng.permutation(len(rects)))])


def _macro(rng: np.random.Generator, rect: Rect, kind: Kind) -> Plan:
    """One macro with the dark channel around it."""
    channel, inside = _frame(rect, 9 * UM)
    fill = {Kind.LOGIC: _logic, Kind.MEMORY: _memory, Kind.ANALOG: _analog}[kind]
    return _join([_strips(channel), fill(rng, inside)])


def _logic(rng: np.random.Generator, rect: Rect) -> Plan:
    rects = _slice(rng, rect, area_mm2=0.020, max_aspect=3.5)
    return _plan(rects, Kind.LOGIC, range(len(rects)))


def _analog(rng: np.random.Generator, rect: Rect) -> Plan:
    rects = _slice(rng, rect, area_mm2=0.060, max_aspect=2.0)
    return _plan(rects, Kind.ANALOG, range(len(rects)))


def _memory(rng: np.random.Generator, rect: Rect) -> Plan:
    """Rows of equal height in two halves; the spine between them holds decoders and is dark."""
    axis = int(_length(rect, 1) > _length(rect, 0))
    spine = _share(rect, axis, 26 * UM)
    left, middle, right = _split(rect, axis, [(1 - spine) / 2, spine])
    row_nm = int(rng.integers(50, 72)) * UM
    count = max(2, round(_length(rect, 1 - axis) / row_nm))
    shape = (1, count) if axis == 0 else (count, 1)
    rows = [*_grid(left, *shape), *_grid(right, *shape)]
    return _join([_one(middle, Kind.STRIP), _plan(rows, Kind.MEMORY, [0] * len(rows))])


def _pad_ring(rect: Rect, depth_nm: int, pitch_nm: int) -> tuple[Plan, Rect]:
    """Pads along the four sides of `rect`, and what they leave free inside."""
    sides, inside = _frame(rect, depth_nm)
    pads = []
    for side in sides:
        axis = int(_length(side, 1) > _length(side, 0))
        count = max(1, round(_length(side, axis) / pitch_nm))
        pads += _grid(side, count, 1) if axis == 0 else _grid(side, 1, count)
    return _plan(pads, Kind.IO, [0] * len(pads)), inside


def _repeat(rect: Rect, columns: int, rows: int, fill: Callable[[Rect], Plan]) -> Plan:
    """Fills the first tile of a grid and copies it to the others, every second one mirrored."""
    tiles = _grid(rect, columns, rows)
    first = fill(tiles[0])
    return _concatenate(
        [
            _copy(first, tiles[0], tile, flip_x=bool(index % columns % 2))
            for index, tile in enumerate(tiles)
        ]
    )


def _slice(
    rng: np.random.Generator, rect: Rect, area_mm2: float, max_aspect: float
) -> list[Rect]:
    """Cuts a rectangle in two, again and again, until the parts have about the given area.

    The longer side is cut when the part is longer than `max_aspect`, else either side is.
    """
    width, height = _length(rect, 0), _length(rect, 1)
    if width * height < area_mm2 * MM * MM * rng.uniform(0.7, 2.0):
        return [rect]
    aspect = width / height
    if max(aspect, 1 / aspect) > max_aspect:
        axis = int(aspect < 1)
    else:
        axis = int(rng.random() * (1 + aspect) > aspect)
    first, second = _split(rect, axis, [rng.uniform(0.3, 0.7)])
    return [
        *_slice(rng, first, area_mm2, max_aspect),
        *_slice(rng, second, area_mm2, max_aspect),
    ]


def _split(rect: Rect, axis: int, shares: Sequence[float]) -> list[Rect]:
    """Cuts along an axis (0: x, 1: y) into parts with these shares and one with the rest."""
    low, high = rect[axis], rect[axis + 2]
    edges = [low, *(low + round(s * (high - low)) for s in np.cumsum(shares)), high]
    parts = []
    for start, end in zip(edges, edges[1:]):
        part = list(rect)
        part[axis], part[axis + 2] = start, end
        parts.append(tuple(part))
    return parts


def _grid(rect: Rect, columns: int, rows: int) -> list[Rect]:
    """Tiles of equal size, to the nanometre; row by row from the lower left."""
    return [
        tile
        for row in _split(rect, 1, [1 / rows] * (rows - 1))
        for tile in _split(row, 0, [1 / columns] * (columns - 1))
    ]


def _frame(rect: Rect, width_nm: int) -> tuple[list[Rect], Rect]:
    """The four sides of a frame inside `rect` (bottom, top, left, right), and what it encloses."""
    x0, y0, x1, y1 = rect
    inside = (x0 + width_nm, y0 + width_nm, x1 - width_nm, y1 - width_nm)
    sides = [
        (x0, y0, x1, inside[1]),
        (x0, inside[3], x1, y1),
        (x0, inside[1], inside[0], inside[3]),
        (inside[2], inside[1], x1, inside[3]),
    ]
    return sides, inside


def _length(rect: Rect, axis: int) -> int:
    return rect[axis + 2] - rect[axis]


def _share(rect: Rect, axis: int, length_nm: int) -> float:
    return length_nm / _length(rect, axis)


def _plan(rects: Sequence[Rect], kind: Kind, cells: Sequence[int]) -> Plan:
    """One macro of blocks of one kind."""
    return Plan(
        rect_nm=np.array(rects, dtype=np.int64).reshape(-1, 4),
        kind=np.full(len(rects), kind, dtype=np.int8),
        macro=np.zeros(len(rects), dtype=np.int64),
        cell=np.array(cells, dtype=np.int64),
    )


def _one(rect: Rect, kind: Kind) -> Plan:
    return _plan([rect], kind, [0])


def _strips(rects: Sequence[Rect]) -> Plan:
    return _plan(rects, Kind.STRIP, [0] * len(rects))


def _copy(
    plan: Plan, source: Rect, target: Rect, flip_x: bool = False, flip_y: bool = False
) -> Plan:
    """The blocks of `source` moved, scaled and mirrored into `target`, wires unchanged.

    A coordinate that two blocks share is rounded once for both, so copies stay free of gaps.
    """
    rect = plan.rect_nm.copy()
    for axis, flip in enumerate((flip_x, flip_y)):
        share = (rect[:, axis::2] - source[axis]) / _length(source, axis)
        if flip:
            share = 1.0 - share[:, ::-1]
        rect[:, axis::2] = target[axis] + np.rint(share * _length(target, axis)).astype(np.int64)
    return Plan(rect, plan.kind, plan.macro, plan.cell)


def _concatenate(plans: Sequence[Plan]) -> Plan:
    """Plans that share their macros and cells: copies of one another."""
    return Plan(
        *(
            np.concatenate([getattr(plan, name) for plan in plans])
            for name in ("rect_nm", "kind", "macro", "cell")
        )
    )


def _join(plans: Sequence[Plan]) -> Plan:
    """Plans that have nothing in common: their macros and cells are numbered on."""
    renumbered, macros, cells = [], 0, 0
    for plan in plans:
        renumbered.append(Plan(plan.rect_nm, plan.kind, plan.macro + macros, plan.cell + cells))
        macros += int(plan.macro.max()) + 1
        cells += int(plan.cell.max()) + 1
    return _concatenate(renumbered)
