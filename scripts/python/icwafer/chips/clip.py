# SPDX-License-Identifier: GPL-2.0-or-later
"""Cuts what the rim of a wafer cuts: the blocks of partial dies."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from icwafer.chips.outline import NOTCH_DEPTH_MM, flats, notch_bottom_mm
from icwafer.chips.wafer import Wafer

#: The usable circle is cut by tangents this far apart: 0.4 um from the circle of a 300 mm wafer.
_TANGENT_STEP_RAD = math.radians(0.25)


class Pieces(NamedTuple):
    """What is left of n rectangles.

    whole: (m,) int64, those that stay as they are. cut: the others of which something is left, each
    with its convex polygon (k, 2) in mm, counter-clockwise.
    """

    whole: np.ndarray
    cut: tuple[tuple[int, np.ndarray], ...]


def cut_to_usable(rects_mm: np.ndarray, wafer: Wafer) -> Pieces:
    """What lies on a wafer's usable area: inside its edge exclusion, and as far from flats.

    rects_mm: (n, 4), x0, y0, x1, y1 from the wafer's centre. What comes closer to a notch than the
    edge exclusion is dropped.
    """
    radius = wafer.usable_radius_mm
    limits = [
        (np.array(flat.normal), flat.distance_mm - wafer.edge_exclusion_mm)
        for flat in flats(wafer)
    ]
    low, high = rects_mm[:, :2], rects_mm[:, 2:]
    farthest = np.maximum(np.abs(low), np.abs(high))
    nearest = np.maximum(np.maximum(low, -high), 0.0)
    whole = (farthest**2).sum(axis=1) <= radius**2
    gone = (nearest**2).sum(axis=1) >= radius**2
    for normal, distance in limits:
        along = np.where(normal > 0, high, low) @ normal, np.where(normal > 0, low, high) @ normal
        whole &= along[0] <= distance
        gone |= along[1] >= distance
    notch = notch_bottom_mm(wafer)
    if notch and wafer.edge_exclusion_mm < 2 * NOTCH_DEPTH_MM:
        gap = np.maximum(np.maximum(low - notch, notch - high), 0.0)
        gone |= (gap**2).sum(axis=1) < wafer.edge_exclusion_mm**2
    cut = []
    for index in np.flatnonzero(~whole & ~gone).tolist():
        x0, y0, x1, y1 = rects_mm[index].tolist()
        polygon = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
        for normal, distance in [*_tangents(polygon, radius), *limits]:
            polygon = _cut(polygon, normal[0], normal[1], distance)
        if len(polygon) > 2:
            cut.append((index, np.array(polygon)))
    return Pieces(np.flatnonzero(whole & ~gone), tuple(cut))


def _tangents(
    polygon: list[tuple[float, float]], radius: float
) -> Iterator[tuple[tuple[float, float], float]]:
    """Normals and distances of tangents all along the part of the circle that a polygon meets."""
    middle = math.atan2(sum(y for _, y in polygon), sum(x for x, _ in polygon))
    turns = [math.remainder(math.atan2(y, x) - middle, 2 * math.pi) for x, y in polygon]
    count = math.ceil((max(turns) - min(turns)) / _TANGENT_STEP_RAD)
    for turn in np.linspace(min(turns), max(turns), count + 1) if count > 1 else (0.0,):
        yield (math.cos(middle + turn), math.sin(middle + turn)), radius


def _cut(
    polygon: list[tuple[float, float]], normal_x: float, normal_y: float, distance: float
) -> list[tuple[float, float]]:
    """The part of a convex polygon on the inner side of a line.

    I. E. Sutherland and G. W. Hodgman, Reentrant polygon clipping, Communications of the ACM, 1974.
    """
    kept = []
    beyond = [x * normal_x + y * normal_y - distance for x, y in polygon]
    for (x, y), out, (px, py), before in zip(
        polygon, beyond, [polygon[-1], *polygon], [beyond[-1], *beyond]
    ):
        if (out > 0) != (before > 0):
            share = before / (before - out)
            kept.append((px + share * (x - px), py + share * (y - py)))
        if out <= 0:
            kept.append((x, y))
    return kept
