# SPDX-License-Identifier: GPL-2.0-or-later
"""Camera and lamps of a portrait, placed by the grating law.

Light of wavelength lambda leaves a grating of spacing d in order m where the directions to lamp
and eye add up to u = m lambda / d across the wires and to v = 0 along them. So for wires that run
along x, and for those that run along y, there is a softbox where the middle of the picture sees
the middle of an order. It is no larger than the lobes of the wires are wide: then nearly every
sample of its light meets a lobe, and the picture has little noise. The softness of the bands comes
from the lobes.
"""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass

import numpy as np

from icwafer.chips.model import Die
from icwafer.pictures import Camera, Light

#: Everything is scaled so that the longer side of a die, or a wafer, measures this.
SIZE_MM = 10.0
#: The middle of the picture sees this wavelength, in the order whose u is nearest to `_USUAL_U`.
_MIDDLE_NM = 550.0
_USUAL_U = 0.55
#: Sine of the largest angle between the surface's normal and a lamp.
_LOWEST_LAMP = 0.94
#: Wavelengths that a place of the picture sees at once in the first order, by the lamp's width.
_BAND_NM = 70.0
#: Length of a lamp in the direction of the wires, relative to its distance.
_LENGTH = 0.35
#: Lamps stand this many sizes away.
_DISTANCE = 5.0


@dataclass(frozen=True)
class Pose:
    """How the subject is seen.

    turn_deg: about its normal. polar_deg: of the camera from the normal. fill: share of the
    picture's width or height that it takes.
    """

    turn_deg: float
    polar_deg: float
    fill: float
    lens_mm: float = 100.0
    f_stop: float = 0.0


@dataclass(frozen=True)
class Rig:
    """A camera, and what it sees the subject by; lengths after scaling to `SIZE_MM`."""

    camera: Camera
    lights: tuple[Light, ...]


def spacings_nm(die: Die) -> tuple[float, float]:
    """What the wires along x and those along y have as spacing: medians by area and strength.

    Where a die has wires of one direction only, both are of these; 1000 if it has none.
    """
    weight = die.area_nm2 * die.diffraction.astype(np.float64)
    upright = np.abs(np.sin(die.direction_rad)) > math.sqrt(0.5)
    found = [_median(die.spacing_nm[of], weight[of]) for of in (~upright, upright)]
    along_x, along_y = found[0] or found[1] or 1000.0, found[1] or found[0] or 1000.0
    return along_x, along_y


def _median(values: np.ndarray, weights: np.ndarray) -> float | None:
    if not weights.sum() > 0:
        return None
    order = np.argsort(values, kind="stable")
    total = np.cumsum(weights[order])
    return float(values[order][np.searchsorted(total, total[-1] / 2)])


def rig(
    extent_mm: tuple[float, float],
    spacing_nm: tuple[float, float],
    pose: Pose,
    aspect: float,
) -> Rig:
    """For a subject in the plane z = 0 around the origin, turned by the pose.

    extent_mm: its sides, scaled. spacing_nm: of the wires along its x and along its y. aspect:
    width over height of the picture.
    """
    polar = math.radians(pose.polar_deg)
    to_camera = np.array([0.0, -math.sin(polar), math.cos(polar)])
    turn = math.radians(pose.turn_deg)
    along_x = np.array([math.cos(turn), math.sin(turn), 0.0])
    along_y = np.array([-math.sin(turn), math.cos(turn), 0.0])
    corners = np.array(
        [
            sx * extent_mm[0] / 2 * along_x + sy * extent_mm[1] / 2 * along_y
            for sx in (-1, 1)
            for sy in (-1, 1)
        ]
    )
    camera = _framed(corners, to_camera, pose, aspect)
    keys = [
        _key(to_camera, wires, spacing, power)
        for wires, spacing, power in (
            (along_x, spacing_nm[0], 9000.0),
            (along_y, spacing_nm[1], 6000.0),
        )
    ]
    return Rig(camera, (*keys, _sheen(to_camera)))


def direction_to_lamp(
    to_camera: np.ndarray, along_wires: np.ndarray, spacing_nm: float
) -> np.ndarray:
    """Where a lamp stands so that the camera sees `_MIDDLE_NM` in the order next to `_USUAL_U`.

    Unit vectors (3,); the surface's normal is z. Of the two sides of the mirror direction it is
    the one nearer to the normal. Where it would have to stand lower than `_LOWEST_LAMP`, the
    middle of the picture sees a shorter wavelength.
    """
    across = np.cross([0.0, 0.0, 1.0], along_wires)
    order = max(1, round(_USUAL_U * spacing_nm / _MIDDLE_NM))
    u = min(order * _MIDDLE_NM / spacing_nm, 0.8)
    seen = float(to_camera @ across)
    sideways = min((u - seen, -u - seen), key=abs)
    behind = -float(to_camera @ along_wires)
    most = math.sqrt(_LOWEST_LAMP**2 - behind**2)
    flat = float(np.clip(sideways, -most, most)) * across + behind * along_wires
    return flat + [0.0, 0.0, math.sqrt(1.0 - flat @ flat)]


def _key(
    to_camera: np.ndarray, along_wires: np.ndarray, spacing_nm: float, power_w: float
) -> Light:
    """A softbox that shows the wires of one direction."""
    direction = direction_to_lamp(to_camera, along_wires, spacing_nm)
    distance = _DISTANCE * SIZE_MM
    across = distance * float(np.clip(_BAND_NM / spacing_nm, 0.02, 0.2))
    return _softbox(direction, along_wires, (_LENGTH * distance, across), power_w)


def _sheen(to_camera: np.ndarray) -> Light:
    """What bare metal and the table mirror: a dim, large wall of light behind the subject.

    A card: as a lamp it would take its share of the samples from those that make colours.
    """
    behind = to_camera * [-1.0, -1.0, 1.0] + [0.25, 0.0, -0.25]
    distance = _DISTANCE * SIZE_MM
    size = (1.6 * distance, 1.0 * distance)
    wall = _softbox(behind / np.linalg.norm(behind), np.array([1.0, 0.0, 0.0]), size, 400.0)
    return dataclasses.replace(wall, kind="CARD", fade=1.0)


def _softbox(
    direction: np.ndarray, along: np.ndarray, size_mm: tuple[float, float], power_w: float
) -> Light:
    """A softbox in a direction whose width lies along another one."""
    right = np.cross(-direction, [0.0, 0.0, 1.0])
    if np.linalg.norm(right) < 1e-6:
        right = np.array([1.0, 0.0, 0.0])
    right /= np.linalg.norm(right)
    top = np.cross(right, -direction)
    return Light(
        "AREA",
        tuple((_DISTANCE * SIZE_MM * direction).tolist()),
        power_w,
        size_mm=size_mm,
        fade=0.7,
        turn_deg=math.degrees(math.atan2(along @ top, along @ right)),
    )


def _framed(corners: np.ndarray, to_camera: np.ndarray, pose: Pose, aspect: float) -> Camera:
    """A camera so far away that the corners (n, 3) fill the picture, and in its middle."""
    up = np.array([0.0, to_camera[2], -to_camera[1]])
    half_width = 18.0 / pose.lens_mm  # of a sensor 36 mm wide, at distance 1
    half = np.array([half_width, half_width / aspect]) * pose.fill
    target = np.zeros(3)
    distance = 10.0 * SIZE_MM
    # The perspective changes with the distance: a few rounds settle both.
    for _ in range(30):
        away = distance - (corners - target) @ to_camera
        seen = (
            np.stack([(corners - target)[:, 0], (corners - target) @ up], axis=1) / away[:, None]
        )
        low, high = seen.min(axis=0), seen.max(axis=0)
        middle = (low + high) / 2 * distance
        target = target + [middle[0], middle[1] / max(to_camera[2], 0.2), 0.0]
        distance *= float(((high - low) / 2 / half).max())
    return Camera(
        tuple((target + distance * to_camera).tolist()),
        tuple(target.tolist()),
        pose.lens_mm,
        f_stop=pose.f_stop,
    )
