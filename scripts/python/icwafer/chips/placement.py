# SPDX-License-Identifier: GPL-2.0-or-later
"""Where the dies of a wafer stand, and how each one differs from the mean.

A scanner prints fields of several dies side by side. A product die stands where its farthest
corner is within the usable radius (the wafer's less the edge exclusion), as far from flats and
notch; the lattice is shifted by half a die where that makes more of them, unless the wafer says
otherwise.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from icwafer.chips.model import DieSpec, Layout
from icwafer.chips.outline import flats, notch_bottom_mm
from icwafer.chips.wafer import Drift, Wafer

#: Largest field of a wafer scanner, either way round.
RETICLE_MM = (26.0, 33.0)


@dataclass(frozen=True)
class WaferMap:
    """The n dies of a wafer, row by row from the lower left; test dies after the products.

    centre_mm: (n, 2) float64, the middle of each die; the wafer's centre is the origin.
    die: (n,) int32, index into the layout's dies: 0 for a product.
    field: (n, 2) int32, the reticle field, counted from the one at the centre.
    partial: (n,) bool, whether the die reaches over the usable area.
    oxide_scale, groove_scale, width_scale: (n,) float32, near 1, to multiply the die's own with.
    """

    centre_mm: np.ndarray
    die: np.ndarray
    field: np.ndarray
    partial: np.ndarray
    oxide_scale: np.ndarray
    groove_scale: np.ndarray
    width_scale: np.ndarray

    def __len__(self) -> int:
        return len(self.centre_mm)


class Field(NamedTuple):
    """Dies of one reticle field, and the distance from field to field."""

    columns: int
    rows: int
    width_mm: float
    height_mm: float

    @property
    def size(self) -> np.ndarray:
        """Its dies along x and y: (2,) int64."""
        return np.array([self.columns, self.rows])

    @property
    def pitch_mm(self) -> np.ndarray:
        """Distance from die to die along x and y: (2,) float64."""
        return np.array([self.width_mm, self.height_mm]) / self.size


def reticle_field(spec: DieSpec, wafer: Wafer) -> Field | None:
    """The field of a product die; None if the dies do not fit into a reticle, either way round."""
    lane = wafer.scribe_um / 1000
    pitch = np.array([spec.width_mm + lane, spec.height_mm + lane])
    best = None
    for reticle in (RETICLE_MM, RETICLE_MM[::-1]):
        fit = np.floor((np.array(reticle) + lane) / pitch + 1e-9).astype(int)
        given = np.array([wafer.field_columns, wafer.field_rows])
        count = np.where(given > 0, given, fit)
        if (count >= 1).all() and (count <= fit).all():
            if best is None or count.prod() > best.columns * best.rows:
                best = Field(*count.tolist(), *(count * pitch).tolist())
    return best


def place_dies(layout: Layout) -> WaferMap:
    """All dies of a layout's wafer. The layout must be valid and have a wafer."""
    wafer, product = layout.wafer, layout.dies[0]
    field = reticle_field(product, wafer)
    centre, die_field, complete = _lattice(product, wafer, field)
    kept = complete | (wafer.partial_dies & _touches(centre, product, wafer))
    for place in (*wafer.test_fields, *wafer.blank_fields):
        kept &= (die_field != place).any(axis=1)
    centres, fields, partial = [centre[kept]], [die_field[kept]], [~complete[kept]]
    for place in wafer.test_fields:
        tests = test_field_dies_mm(layout, place)
        centres.append(tests)
        fields.append(np.tile(np.array(place, dtype=np.int32), (len(tests), 1)))
        partial.append(~_fits(tests, layout.dies[1], wafer))
    position = np.concatenate(centres)
    rng = np.random.default_rng(wafer.seed)
    scales = {
        f"{name}_scale": 1.0
        + drift_at(drift, position, wafer.radius_mm)
        + drift.noise * np.clip(rng.standard_normal(len(position)), -3.0, 3.0)
        for name, drift in (
            ("oxide", wafer.oxide),
            ("groove", wafer.groove),
            ("width", wafer.width),
        )
    }
    return WaferMap(
        centre_mm=position,
        die=np.repeat(np.int32([0, 1]), [len(centres[0]), len(position) - len(centres[0])]),
        field=np.concatenate(fields),
        partial=np.concatenate(partial),
        **{name: scale.astype(np.float32) for name, scale in scales.items()},
    )


def drift_at(drift: Drift, position_mm: np.ndarray, radius_mm: float) -> np.ndarray:
    """The relative change at places (n, 2) of a wafer, without noise: (n,) float64.

    For a drift that is continuous inside the dies, where a die's `*_scale` is a step.
    """
    x, y = (position_mm / radius_mm).T
    square = x * x + y * y
    towards = math.radians(drift.tilt_direction_deg)
    return (
        drift.bow * (2 * square - 1)
        + drift.ring * (6 * square * square - 6 * square + 1)
        + drift.tilt * (x * math.cos(towards) + y * math.sin(towards))
    )


def blank_fields_mm(layout: Layout) -> np.ndarray:
    """The fields that were not exposed, (k, 4) as x0, y0, x1, y1."""
    wafer, product = layout.wafer, layout.dies[0]
    field = reticle_field(product, wafer)
    centres = [_field_centre(product, wafer, field, place) for place in wafer.blank_fields]
    middle = np.array(centres).reshape(-1, 2)
    half = np.array([field.width_mm, field.height_mm]) / 2
    return np.concatenate([middle - half, middle + half], axis=1)


def test_field_dies_mm(layout: Layout, place: tuple[int, int]) -> np.ndarray:
    """Middles (k, 2) of the test dies that fill a field.

    k is 0 where they do not fit into the field, or reach over the usable area of a wafer without
    partial dies.
    """
    wafer, product, test = layout.wafer, layout.dies[0], layout.dies[1]
    field, lane = reticle_field(product, wafer), wafer.scribe_um / 1000
    die_pitch = np.array([test.width_mm + lane, test.height_mm + lane])
    count = np.floor(np.array([field.width_mm, field.height_mm]) / die_pitch + 1e-9).astype(int)
    steps = np.stack(np.meshgrid(*(np.arange(c) - (c - 1) / 2 for c in count)), axis=-1)
    found = _field_centre(product, wafer, field, place) + steps.reshape(-1, 2) * die_pitch
    if wafer.partial_dies:
        return found[_touches(found, test, wafer)]
    return found if _fits(found, test, wafer).all() else np.empty((0, 2))


def _lattice(
    spec: DieSpec, wafer: Wafer, field: Field
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Middles (n, 2), fields (n, 2), and completeness (n,) of all dies around the wafer."""
    index = _indices(wafer, field)
    centre = (index + _offset(spec, wafer, field)) * field.pitch_mm
    die_field = (index - _first_index(wafer, field)) // field.size
    return centre, die_field.astype(np.int32), _fits(centre, spec, wafer)


def _indices(wafer: Wafer, field: Field) -> np.ndarray:
    """All dies around the wafer by column and row (n, 2), counted from the one at the centre."""
    reach = np.ceil(wafer.radius_mm / field.pitch_mm).astype(int) + 1
    return np.stack(np.meshgrid(*(np.arange(-r, r + 1) for r in reach)), axis=-1).reshape(-1, 2)


def _first_index(wafer: Wafer, field: Field) -> np.ndarray:
    """Column and row of the first die of the field at the centre."""
    return -(field.size // 2) - (wafer.field_shift_columns, wafer.field_shift_rows)


def _offset(spec: DieSpec, wafer: Wafer, field: Field) -> np.ndarray:
    """The shift of the lattice, 0 or half a die each way: as given, or with the most dies."""
    index = _indices(wafer, field)
    allowed = {"most": (0.0, 0.5), "die": (0.0,), "lane": (0.5,)}
    offsets = [
        np.array([x, y]) for x in allowed[wafer.centre_x] for y in allowed[wafer.centre_y]
    ]
    return max(
        offsets, key=lambda shift: _fits((index + shift) * field.pitch_mm, spec, wafer).sum()
    )


def _field_centre(spec: DieSpec, wafer: Wafer, field: Field, place: tuple[int, int]) -> np.ndarray:
    first = _first_index(wafer, field) + field.size * place
    return (first + (field.size - 1) / 2 + _offset(spec, wafer, field)) * field.pitch_mm


def _fits(centre_mm: np.ndarray, spec: DieSpec, wafer: Wafer) -> np.ndarray:
    """Whether dies (n, 2) stand on the usable area with all of their corners."""
    half = np.array([spec.width_mm, spec.height_mm]) / 2
    farthest = np.abs(centre_mm) + half
    fits = (farthest**2).sum(axis=1) <= wafer.usable_radius_mm**2
    for flat in flats(wafer):
        out = centre_mm @ np.array(flat.normal) + np.abs(flat.normal) @ half
        fits &= out <= flat.distance_mm - wafer.edge_exclusion_mm
    notch = notch_bottom_mm(wafer)
    if notch:
        gap = np.maximum(np.abs(centre_mm - notch) - half, 0.0)
        fits &= (gap**2).sum(axis=1) >= wafer.edge_exclusion_mm**2
    return fits


def _touches(centre_mm: np.ndarray, spec: DieSpec, wafer: Wafer) -> np.ndarray:
    """Whether any part of dies (n, 2) stands on the usable area."""
    half = np.array([spec.width_mm, spec.height_mm]) / 2
    nearest = np.maximum(np.abs(centre_mm) - half, 0.0)
    touches = (nearest**2).sum(axis=1) < wafer.usable_radius_mm**2
    for flat in flats(wafer):
        out = centre_mm @ np.array(flat.normal) - np.abs(flat.normal) @ half
        touches &= out < flat.distance_mm - wafer.edge_exclusion_mm
    return touches
