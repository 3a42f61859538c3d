# SPDX-License-Identifier: GPL-2.0-or-later
"""Turning lamps and cameras."""

from __future__ import annotations

import bpy
from mathutils import Vector


def aimed(
    thing: bpy.types.Object,
    position_mm: tuple[float, float, float],
    target_mm: tuple[float, float, float],
) -> bpy.types.Object:
    """Puts a lamp or camera at a place and turns its axis (its local -Z) to a target."""
    thing.location = position_mm
    axis = Vector(target_mm) - Vector(position_mm)
    thing.rotation_euler = axis.to_track_quat("-Z", "Y").to_euler()
    return thing
