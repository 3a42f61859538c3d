# SPDX-License-Identifier: GPL-2.0-or-later
"""Merges tiles that look alike into groups, and neighbours of one group into larger rectangles."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable, Sequence

import numpy as np

from icwafer.chips.model import Group
from icwafer.chips.spread import Normal
from icwafer.layout_import.optics import Look
from icwafer.layout_import.process import Process

#: How far a tile may be from the strongest one of its group. Layers must be the same. Half a per
#: cent of the spacing moves a colour by 3 nm of wavelength, which nobody sees.
SPACING_TOLERANCE = 0.005
WIDTH_TOLERANCE = 0.03  # of the spacing
DIRECTION_TOLERANCE_RAD = np.radians(0.5)
DIFFRACTION_TOLERANCE = 0.2  # of the stronger one, and
DIFFRACTION_STEP = 0.02  # at least this


def group_looks(looks: Sequence[Look]) -> tuple[list[list[int]], np.ndarray]:
    """Which tiles look alike.

    The strongest tile that has no group yet starts a new one, and takes all that are within the
    tolerances of it: the order of the tiles does not matter. Returns the members of each group,
    and the group of each tile, (n,) int64.
    """
    order = sorted(range(len(looks)), key=lambda i: dataclasses.astuple(looks[i])[::-1])
    order.sort(key=lambda i: -looks[i].diffraction)
    groups: list[list[int]] = []
    group_of = np.zeros(len(looks), dtype=np.int64)
    for index in order:
        number = next(
            (n for n, members in enumerate(groups) if _alike(looks[members[0]], looks[index])),
            len(groups),
        )
        if number == len(groups):
            groups.append([])
        groups[number].append(index)
        group_of[index] = number
    return groups, group_of


def _alike(one: Look, other: Look) -> bool:
    if (one.layer, one.cross_layer) != (other.layer, other.cross_layer):
        return False
    if one.layer < 0:
        return True
    turn = abs((one.direction_rad - other.direction_rad + np.pi / 2) % np.pi - np.pi / 2)
    return (
        turn <= DIRECTION_TOLERANCE_RAD
        and _near(one.spacing_nm, other.spacing_nm, SPACING_TOLERANCE * one.spacing_nm)
        and _near(one.width_nm, other.width_nm, WIDTH_TOLERANCE * one.spacing_nm)
        and _near(
            one.cross_spacing_nm, other.cross_spacing_nm, SPACING_TOLERANCE * one.cross_spacing_nm
        )
        and _near(one.cross_width_nm, other.cross_width_nm, 0.1 * one.cross_spacing_nm)
        and _near(
            one.diffraction,
            other.diffraction,
            max(DIFFRACTION_STEP, DIFFRACTION_TOLERANCE * one.diffraction),
        )
    )


def _near(one: float, other: float, tolerance: float) -> bool:
    return abs(one - other) <= tolerance


def layout_group(looks: Sequence[Look], number: int, process: Process) -> Group:
    """The group of a layout for tiles that look alike: their means, and how the spacing varies."""
    first = looks[0]
    if first.layer < 0:
        return Group(
            name=f"{number} dark", kind="strip", spacing_nm=Normal(1000.0), diffraction=Normal(0.0)
        )

    def mean(field: str) -> Normal:
        return Normal(round(float(np.mean([getattr(look, field) for look in looks])), 4))

    # Around the first one, because 0 and pi are the same direction.
    turns = [(look.direction_rad - first.direction_rad + np.pi / 2) % np.pi for look in looks]
    direction = np.degrees(first.direction_rad + np.mean(turns) - np.pi / 2)
    spacings = np.array([look.spacing_nm for look in looks])
    names = [process.layers[i].name for i in (first.layer, first.cross_layer) if i >= 0]
    return Group(
        name=f"{number} {' x '.join(names)} {spacings.mean():.0f} nm",
        kind="logic",
        direction_deg=round(float(direction), 3) % 180.0,
        spacing_variation=Normal(round(float(spacings.std() / spacings.mean()), 6)),
        **{
            field: mean(field)
            for field in (
                "spacing_nm",
                "width_nm",
                "oxide_nm",
                "diffraction",
                "cross_spacing_nm",
                "cross_width_nm",
                "groove_nm",
            )
        },
    )


def rectangles(group_of: np.ndarray) -> Iterable[tuple[int, int, int, int, int]]:
    """Cuts a grid of tiles into rectangles of one group each.

    group_of: (rows, columns). From the lower left each rectangle grows to the right, then up, as
    far as it goes. Yields column, row, end column, end row, group; every tile is in one of them.
    """
    rows, columns = group_of.shape
    free = np.ones_like(group_of, dtype=bool)
    for row in range(rows):
        for column in range(columns):
            if not free[row, column]:
                continue
            group = group_of[row, column]
            fits = free & (group_of == group)
            end = column + 1
            while end < columns and fits[row, end]:
                end += 1
            top = row + 1
            while top < rows and fits[top, column:end].all():
                top += 1
            free[row:top, column:end] = False
            yield column, row, end, top, int(group)
