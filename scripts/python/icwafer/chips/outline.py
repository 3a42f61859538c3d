# SPDX-License-Identifier: GPL-2.0-or-later
"""The shape of a wafer: rim, notch or flats, thickness and bevelled edge, after SEMI M1.

SEMI M1 (Specification for Polished Single Crystal Silicon Wafers), nominal values. Notch: 1.00 mm
deep, its flanks at 90 degrees to each other; its bottom is rounded, here by 0.9 mm. Flats: lengths
of the primary and secondary one; the secondary one is where p-type (100) silicon has it, 90
degrees clockwise from the primary. Thickness by diameter.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from icwafer.chips.wafer import Wafer

#: Thickness by diameter.
THICKNESS_MM = {100: 0.525, 125: 0.625, 150: 0.675, 200: 0.725, 300: 0.775}

#: Lengths of the primary and the secondary flat by diameter.
FLATS_MM = {100: (32.5, 18.0), 125: (42.5, 27.5), 150: (57.5, 37.5)}

NOTCH_DEPTH_MM = 1.0
NOTCH_RADIUS_MM = 0.9

#: The marks that wafers of a diameter come with.
MARKS = {
    100: ("flats",),
    125: ("flats",),
    150: ("flats", "notch"),
    200: ("notch",),
    300: ("notch",),
}


#: Angles of the start and the end of an interruption of the rim, and the points between (k, 2).
_Mark = tuple[float, float, np.ndarray]


@dataclass(frozen=True)
class Flat:
    """A flat: its outward normal, a unit vector, and its distance from the wafer's centre."""

    normal: tuple[float, float]
    distance_mm: float


def flats(wafer: Wafer) -> tuple[Flat, ...]:
    """The flats of a wafer, the primary one first; none where it has no flats."""
    if wafer.mark != "flats":
        return ()
    normals = ((0.0, -1.0), (-1.0, 0.0))
    return tuple(
        Flat(normal, math.sqrt(wafer.radius_mm**2 - (length / 2) ** 2))
        for normal, length in zip(normals, FLATS_MM[wafer.diameter_mm])
    )


def notch_bottom_mm(wafer: Wafer) -> tuple[float, float] | None:
    """The point of the notch nearest to the centre, or None."""
    return (0.0, NOTCH_DEPTH_MM - wafer.radius_mm) if wafer.mark == "notch" else None


def outline_mm(wafer: Wafer, inset_mm: float = 0.0, segments: int = 360) -> np.ndarray:
    """The rim as a polygon (m, 2), counter-clockwise, with notch or flats.

    inset_mm: distance from the rim inwards, 0 to a few millimetres. segments: of a full circle.
    The polygon begins at the mark, and m does not depend on the inset: outlines of one wafer match
    point by point, as a bevelled edge needs.
    """
    radius = wafer.radius_mm - inset_mm
    marks = _marks(wafer, inset_mm)
    points: list[np.ndarray] = []
    for (_, end, mark), following, count in zip(
        marks, _next_starts(marks), _counts(wafer, segments)
    ):
        angles = np.linspace(end, following, count, endpoint=False)
        points += [mark, radius * np.stack([np.cos(angles), np.sin(angles)], axis=1)]
    return np.concatenate(points)


def _counts(wafer: Wafer, segments: int) -> list[int]:
    """Points of each arc between marks, from the rim itself."""
    marks = _marks(wafer, 0.0)
    arcs = [following - end for (_, end, _), following in zip(marks, _next_starts(marks))]
    return [max(2, math.ceil(arc / (2 * math.pi) * segments)) for arc in arcs]


def _next_starts(marks: list[_Mark]) -> list[float]:
    return [*(start for start, _, _ in marks[1:]), marks[0][0] + 2 * math.pi]


def edge_profile_mm(wafer: Wafer, steps: int = 4) -> np.ndarray:
    """The rounded edge, from the front face to the back: (2 steps + 1, 2) of inset and height.

    Half an ellipse, as wide as the bevel and as high as the wafer is thick; the front is at 0.
    """
    angle = np.linspace(0.0, math.pi, 2 * steps + 1)
    thickness = THICKNESS_MM[wafer.diameter_mm]
    inset = wafer.bevel_mm * (1.0 - np.sin(angle))
    return np.stack([inset, thickness / 2 * (np.cos(angle) - 1.0)], axis=1)


def _marks(wafer: Wafer, inset_mm: float) -> list[_Mark]:
    """Where marks interrupt the rim; the first is at the bottom, others follow counter-clockwise."""
    radius = wafer.radius_mm - inset_mm
    if wafer.mark == "notch":
        return [_notch(wafer, inset_mm, radius)]
    if wafer.mark == "none":
        return [(-math.pi / 2, -math.pi / 2, np.empty((0, 2)))]
    found = []
    for turn, flat in enumerate(flats(wafer)):
        middle = math.atan2(*reversed(flat.normal)) % (2 * math.pi) - 2 * math.pi * (turn == 0)
        half = math.acos((flat.distance_mm - inset_mm) / radius)
        start = radius * np.array([[math.cos(middle - half), math.sin(middle - half)]])
        found.append((middle - half, middle + half, start))
    return found


def _notch(wafer: Wafer, inset_mm: float, radius: float) -> _Mark:
    rounding = NOTCH_RADIUS_MM + inset_mm
    centre_y = NOTCH_DEPTH_MM - NOTCH_RADIUS_MM - wafer.radius_mm
    arc = np.linspace(0.75 * math.pi, 0.25 * math.pi, 9)
    x, y = rounding * np.cos(arc), centre_y + rounding * np.sin(arc)
    # The flank goes on at 45 degrees from the arc's last point down to the rim.
    along = math.sqrt(radius**2 - (x[-1] + y[-1]) ** 2 / 2) - (x[-1] - y[-1]) / math.sqrt(2)
    rim_x, rim_y = x[-1] + along / math.sqrt(2), y[-1] - along / math.sqrt(2)
    half = math.atan2(rim_x, -rim_y)
    points = np.stack([np.r_[-rim_x, x], np.r_[rim_y, y]], axis=1)
    return -math.pi / 2 - half, -math.pi / 2 + half, points
