# SPDX-License-Identifier: GPL-2.0-or-later
"""Rectangles, cut and arranged.

All coordinates are whole nanometres, and every cut goes through a whole number, so that neighbours
share their edges exactly: no overlap, no gap, and areas add up without any tolerance.

Functions of one rectangle take and give tuples; those in the plural take arrays (m, 4) int64 of
x0, y0, x1, y1, and give for each part the index of the rectangle that it was cut from, ascending.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

Rect = tuple[int, int, int, int]  # x0, y0, x1, y1 in nm, x0 < x1 and y0 < y1


def length(rect: Rect, axis: int) -> int:
    """Extent along x (axis 0) or y (axis 1)."""
    return rect[axis + 2] - rect[axis]


def share(rect: Rect, axis: int, length_nm: int) -> float:
    """A length as a share of the rectangle's."""
    return length_nm / length(rect, axis)


def longer_axis(rect: Rect) -> int:
    """0 for a rectangle that lies or is square, 1 for one that stands."""
    return int(length(rect, 1) > length(rect, 0))


def split(rect: Rect, axis: int, shares: Sequence[float]) -> list[Rect]:
    """Cuts along an axis into parts of the given shares, and a last one of what is left."""
    low, high = rect[axis], rect[axis + 2]
    edges = [low, *(low + round(s * (high - low)) for s in np.cumsum(shares)), high]
    parts = []
    for start, end in zip(edges, edges[1:]):
        part = list(rect)
        part[axis], part[axis + 2] = start, end
        parts.append(tuple(part))
    return parts


def grid(rect: Rect, columns: int, rows: int) -> list[Rect]:
    """Tiles of equal size, to the nanometre; row by row from the lower left."""
    return [
        tile
        for row in split(rect, 1, [1 / rows] * (rows - 1))
        for tile in split(row, 0, [1 / columns] * (columns - 1))
    ]


def frame(rect: Rect, width_nm: int) -> tuple[list[Rect], Rect]:
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


def frames(rects: np.ndarray, width_nm: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Frames of the widths (m,) inside rectangles: sides, their rectangles, and the insides."""
    inside = rects + width_nm[:, None] * np.array([1, 1, -1, -1])
    x0, y0, x1, y1 = rects.T
    ix0, iy0, ix1, iy1 = inside.T
    sides = [(x0, y0, x1, iy0), (x0, iy1, x1, y1), (x0, iy0, ix0, iy1), (ix1, iy0, x1, iy1)]
    stacked = np.stack([np.stack(side, axis=1) for side in sides], axis=1)
    return stacked.reshape(-1, 4), np.repeat(np.arange(len(rects)), 4), inside


def grids(
    rects: np.ndarray, columns: np.ndarray, rows: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Tiles of equal size, to the nanometre: columns (m,) and rows (m,) of them in each."""
    counts = columns * rows
    parent = np.repeat(np.arange(len(rects)), counts)
    place = np.arange(len(parent)) - np.repeat(np.cumsum(counts) - counts, counts)
    tiles = np.empty((len(parent), 4), dtype=np.int64)
    for axis, (index, of) in enumerate(
        ((place % columns[parent], columns[parent]), (place // columns[parent], rows[parent]))
    ):
        low = rects[parent, axis]
        extent = rects[parent, axis + 2] - low
        tiles[:, axis] = low + extent * index // of
        tiles[:, axis + 2] = low + extent * (index + 1) // of
    return tiles, parent


def sliced(
    rng: np.random.Generator, rects: np.ndarray, area_nm2: np.ndarray, max_aspect: float
) -> tuple[np.ndarray, np.ndarray]:
    """Slicing structures: rectangles cut in two, again and again, at random places.

    A part is left alone below 0.7 to 2 times the area (m,); its longer side is cut when it is
    longer than `max_aspect`, else either side is. All parts of one depth are cut at once. The
    method: R. H. J. M. Otten, Automatic Floorplan Design, 19th Design Automation Conference, 1982.
    """
    done, parents = [], []
    parent = np.arange(len(rects))
    while len(rects):
        sides = rects[:, 2:] - rects[:, :2]
        small = sides.prod(axis=1) < area_nm2[parent] * rng.uniform(0.7, 2.0, len(rects))
        small |= sides.max(axis=1) < 2
        done.append(rects[small])
        parents.append(parent[small])
        rects, parent, sides = rects[~small], parent[~small], sides[~small]

        aspect = sides[:, 0] / sides[:, 1]
        either = rng.random(len(rects)) * (1 + aspect) > aspect
        long = np.maximum(aspect, 1 / aspect) > max_aspect
        axis = np.where(long, aspect < 1, either).astype(np.int64)
        axis = np.where(sides[np.arange(len(sides)), axis] < 2, 1 - axis, axis)
        index = np.arange(len(rects))
        extent = sides[index, axis]
        at = np.rint(extent * rng.uniform(0.3, 0.7, len(rects))).astype(np.int64)
        cut = rects[index, axis] + np.clip(at, 1, extent - 1)
        first, second = rects, rects.copy()
        first[index, axis + 2] = cut
        second[index, axis] = cut
        rects, parent = np.concatenate([first, second]), np.concatenate([parent, parent])
    parent = np.concatenate(parents) if parents else parent
    order = np.argsort(parent, kind="stable")
    return np.concatenate(done)[order] if done else rects, parent[order]
