# SPDX-License-Identifier: GPL-2.0-or-later
"""The floorplan of the README's pictures: a processor with graphics, drawn step by step.

It came before the trees of `icwafer.chips.tree`, and stays because the pictures show it: the same
seed gives the same blocks. Its block sizes do not depend on the die's size nor on `block_um`.

A die is cut into regions (a ring of pads, processor cores around a shared cache, an array of
graphics tiles, memory interfaces, the rest), a region into macros, and a macro into blocks. Like
on a real chip the cores are mirrored copies of one core and the graphics tiles copies of one tile.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from icwafer.chips.geometry import Rect, frame, grid, length, longer_axis, share, split
from icwafer.chips.model import MM, UM, Kind
from icwafer.chips.plan import Plan, concatenate, copy, join, plan
from icwafer.errors import IcwaferError


def pictures(rng: np.random.Generator, width_nm: int, height_nm: int, _: float) -> Plan:
    """Floorplan of a processor die with its lower left corner at (0, 0); several thousand blocks.

    Raises IcwaferError for a die below 5 mm on a side.
    """
    if min(width_nm, height_nm) < 5 * MM:
        raise IcwaferError(
            f"die of {width_nm / MM:g} x {height_nm / MM:g} mm is too small for the floorplan "
            "'pictures': make both sides at least 5 mm"
        )
    die = (0, 0, width_nm, height_nm)
    seal, ring = frame(die, 70 * UM)
    pads, inside = _pad_ring(ring, depth_nm=140 * UM, pitch_nm=150 * UM)
    moat, core = frame(inside, 60 * UM)

    cluster, channel, rest = split(core, 0, [rng.uniform(0.52, 0.58), share(core, 0, 70 * UM)])
    graphics, street, uncore, bank = split(
        rest, 1, [rng.uniform(0.42, 0.48), share(rest, 1, 50 * UM), rng.uniform(0.30, 0.34)]
    )
    whole = join(
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
    return copy(whole, die, die, flip_x=bool(rng.integers(2)), flip_y=bool(rng.integers(2)))


# Shares of the kinds among the macros of a region.
CORE = {Kind.LOGIC: 0.62, Kind.MEMORY: 0.33, Kind.ANALOG: 0.05}
GRAPHICS = {Kind.LOGIC: 0.55, Kind.MEMORY: 0.45}
UNCORE = {Kind.LOGIC: 0.70, Kind.MEMORY: 0.18, Kind.ANALOG: 0.12}
INTERFACE = {Kind.LOGIC: 0.35, Kind.MEMORY: 0.25, Kind.ANALOG: 0.40}


def _cores(rng: np.random.Generator, rect: Rect) -> Plan:
    """Four cores above and four below the cache that they share."""
    cache_share = rng.uniform(0.20, 0.25)
    lower, cache, upper = split(rect, 1, [(1 - cache_share) / 2, cache_share])
    core_rects = [*grid(lower, 4, 1), *grid(upper, 4, 1)]
    core = _macros(rng, core_rects[0], 0.22, CORE)
    copies = [
        copy(core, core_rects[0], target, flip_x=bool(index % 2), flip_y=index >= 4)
        for index, target in enumerate(core_rects)
    ]
    slices = _repeat(cache, 4, 2, lambda tile: _macro(rng, tile, Kind.MEMORY))
    return join([concatenate(copies), slices])


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
    return join([_macro(rng, r, kinds[k]) for r, k in zip(rects, rng.permutation(len(rects)))])


def _macro(rng: np.random.Generator, rect: Rect, kind: Kind) -> Plan:
    """One macro with the dark channel around it."""
    channel, inside = frame(rect, 9 * UM)
    fill = {Kind.LOGIC: _logic, Kind.MEMORY: _memory, Kind.ANALOG: _analog}[kind]
    return join([_strips(channel), fill(rng, inside)])


def _logic(rng: np.random.Generator, rect: Rect) -> Plan:
    rects = _slice(rng, rect, area_mm2=0.020, max_aspect=3.5)
    return plan(rects, Kind.LOGIC, range(len(rects)))


def _analog(rng: np.random.Generator, rect: Rect) -> Plan:
    rects = _slice(rng, rect, area_mm2=0.060, max_aspect=2.0)
    return plan(rects, Kind.ANALOG, range(len(rects)))


def _memory(rng: np.random.Generator, rect: Rect) -> Plan:
    """Rows of equal height in two halves; the spine between them holds decoders and is dark."""
    axis = longer_axis(rect)
    spine = share(rect, axis, 26 * UM)
    left, middle, right = split(rect, axis, [(1 - spine) / 2, spine])
    row_nm = int(rng.integers(50, 72)) * UM
    count = max(2, round(length(rect, 1 - axis) / row_nm))
    shape = (1, count) if axis == 0 else (count, 1)
    rows = [*grid(left, *shape), *grid(right, *shape)]
    return join([_one(middle, Kind.STRIP), plan(rows, Kind.MEMORY, [0] * len(rows))])


def _pad_ring(rect: Rect, depth_nm: int, pitch_nm: int) -> tuple[Plan, Rect]:
    """Pads along the four sides of `rect`, and what they leave free inside."""
    sides, inside = frame(rect, depth_nm)
    pads = []
    for side in sides:
        axis = longer_axis(side)
        count = max(1, round(length(side, axis) / pitch_nm))
        pads += grid(side, count, 1) if axis == 0 else grid(side, 1, count)
    return plan(pads, Kind.IO, [0] * len(pads)), inside


def _repeat(rect: Rect, columns: int, rows: int, fill: Callable[[Rect], Plan]) -> Plan:
    """Fills the first tile of a grid and copies it to the others, every second one mirrored."""
    tiles = grid(rect, columns, rows)
    first = fill(tiles[0])
    return concatenate(
        [
            copy(first, tiles[0], tile, flip_x=bool(index % columns % 2))
            for index, tile in enumerate(tiles)
        ]
    )


def _slice(rng: np.random.Generator, rect: Rect, area_mm2: float, max_aspect: float) -> list[Rect]:
    """Cuts a rectangle in two, again and again, until the parts have about the given area.

    The longer side is cut when the part is longer than `max_aspect`, else either side is.
    """
    width, height = length(rect, 0), length(rect, 1)
    if width * height < area_mm2 * MM * MM * rng.uniform(0.7, 2.0):
        return [rect]
    aspect = width / height
    if max(aspect, 1 / aspect) > max_aspect:
        axis = int(aspect < 1)
    else:
        axis = int(rng.random() * (1 + aspect) > aspect)
    first, second = split(rect, axis, [rng.uniform(0.3, 0.7)])
    return [
        *_slice(rng, first, area_mm2, max_aspect),
        *_slice(rng, second, area_mm2, max_aspect),
    ]


def _one(rect: Rect, kind: Kind) -> Plan:
    return plan([rect], kind, [0])


def _strips(rects: Sequence[Rect]) -> Plan:
    return plan(rects, Kind.STRIP, [0] * len(rects))
