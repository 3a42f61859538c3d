# SPDX-License-Identifier: GPL-2.0-or-later
"""Where a flat grating's orders appear in a picture, from geometry alone, to be drawn over it.

With q = w_i + w_o, the unit vectors to lamp and eye, and nu across the wires, order m of a
wavelength lambda lies where q . nu = m lambda / d, exactly, also when the light comes from the
side (conical mount). Along the wires q . tau = 0 is the middle of every order.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from icwafer.pictures import Camera, Vector

_SENSOR_MM = 36.0


@dataclass(frozen=True)
class Plane:
    """The plane of the wafer; wires at direction 0 run along `x_axis`, which lies in it."""

    point: Vector = (0.0, 0.0, 0.0)
    normal: Vector = (0.0, 0.0, 1.0)
    x_axis: Vector = (1.0, 0.0, 0.0)


@dataclass(frozen=True)
class Curve:
    """Line segments in a picture, n x 4: x, y of both ends in pixels from the top left corner.

    order and wavelength_nm are None for the line q . tau = 0.
    """

    order: int | None
    wavelength_nm: float | None
    segments: np.ndarray


def grating_overlay(
    size: tuple[int, int],
    camera: Camera,
    light: Vector,
    plane: Plane,
    spacing_nm: float,
    direction_rad: float,
    wavelengths_nm: Sequence[float] = (450.0, 550.0, 650.0),
    step_px: int = 8,
) -> list[Curve]:
    """Curves of all orders that the picture of `size` (width, height) contains.

    light: the place of a small lamp. camera: its longer side is 36 mm of sensor, as in Blender. direction_rad: from the x axis to the wires, counter-clockwise seen from outside.
    The wafer may end before a curve does.
    """
    columns = np.append(np.arange(0, size[0], step_px), size[0]).astype(float)
    rows = np.append(np.arange(0, size[1], step_px), size[1]).astype(float)
    u, v = deflection(size, camera, light, plane, direction_rad, *np.meshgrid(columns, rows))
    curves = [Curve(None, None, _level_set(v, 0.0, columns, rows))]
    for wavelength_nm in wavelengths_nm:
        step = wavelength_nm / spacing_nm
        for order in range(-math.floor(2 / step), math.floor(2 / step) + 1):
            if order:
                curves.append(
                    Curve(order, wavelength_nm, _level_set(u, order * step, columns, rows))
                )
    mirror = Curve(0, None, _level_set(u, 0.0, columns, rows))
    return [curve for curve in (mirror, *curves) if curve.segments.size]


def deflection(
    size: tuple[int, int],
    camera: Camera,
    light: Vector,
    plane: Plane,
    direction_rad: float,
    x: np.ndarray,
    y: np.ndarray,
) -> tuple[np.ndarray, np.ndarray]:
    """u = q . nu and v = q . tau at places in a picture; NaN where the plane is not seen."""
    eye = np.asarray(camera.position_mm)
    forward = np.asarray(camera.target_mm) - eye
    forward = forward / np.linalg.norm(forward)
    right = np.cross(forward, (0.0, 0.0, 1.0))
    if np.linalg.norm(right) < 1e-6:  # straight down: the y axis is up
        right = np.cross(forward, (0.0, 1.0, 0.0))
    right /= np.linalg.norm(right)
    up = np.cross(right, forward)
    roll = math.radians(camera.roll_deg)
    right, up = (
        math.cos(roll) * right - math.sin(roll) * up,
        math.sin(roll) * right + math.cos(roll) * up,
    )

    scale = _SENSOR_MM / camera.lens_mm / max(size)
    ray = (
        forward
        + ((x - size[0] / 2) * scale)[..., None] * right
        + ((size[1] / 2 - y) * scale)[..., None] * up
    )
    normal = np.asarray(plane.normal) / np.linalg.norm(plane.normal)
    facing = ray @ normal
    with np.errstate(divide="ignore", invalid="ignore"):
        distance = ((np.asarray(plane.point) - eye) @ normal) / facing
        distance = np.where(distance > 0, distance, np.nan)
        to_light = np.asarray(light) - (eye + distance[..., None] * ray)
        q = _unit(to_light) - _unit(ray)
    along0 = _unit(np.asarray(plane.x_axis, dtype=float))
    across0 = np.cross(normal, along0)
    along = math.cos(direction_rad) * along0 + math.sin(direction_rad) * across0
    across = math.cos(direction_rad) * across0 - math.sin(direction_rad) * along0
    return q @ across, q @ along


def _unit(vector: np.ndarray) -> np.ndarray:
    return vector / np.linalg.norm(vector, axis=-1, keepdims=True)


def _level_set(
    field: np.ndarray, level: float, columns: np.ndarray, rows: np.ndarray
) -> np.ndarray:
    """Segments where a smooth field on a grid has a value: each cell's two crossings joined."""
    x, y = np.meshgrid(columns, rows)
    corners = [np.s_[:-1, :-1], np.s_[:-1, 1:], np.s_[1:, 1:], np.s_[1:, :-1]]
    crossings = []
    for first, second in zip(corners, corners[1:] + corners[:1]):
        a, b = field[first] - level, field[second] - level
        crosses = (a >= 0) != (b >= 0)
        crosses &= np.isfinite(a) & np.isfinite(b)
        share = np.divide(a, a - b, out=np.zeros_like(a), where=crosses)
        place = np.stack(
            [
                x[first] + share * (x[second] - x[first]),
                y[first] + share * (y[second] - y[first]),
            ],
            axis=-1,
        )
        crossings.append(np.where(crosses[..., None], place, np.nan))
    sides = np.stack(crossings, axis=2)  # rows x columns x 4 sides x 2
    crossed = np.isfinite(sides[..., 0])
    # A smooth field crosses two sides of a small cell; saddles, with four, are left out.
    return sides[crossed.sum(axis=-1) == 2][crossed[crossed.sum(axis=-1) == 2]].reshape(-1, 4)
