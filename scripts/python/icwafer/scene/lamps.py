# SPDX-License-Identifier: GPL-2.0-or-later
"""Lamps."""

from __future__ import annotations

import math

import bpy

from icwafer.pictures import Light
from icwafer.scene.aim import aimed


def lamp(light: Light) -> bpy.types.Object:
    """An object with the lamp, not yet in a collection."""
    data = bpy.data.lights.new(light.kind.title(), light.kind)
    data.energy = light.power_w
    data.color = light.colour
    if light.kind == "AREA":
        data.shape = "RECTANGLE"
        data.size, data.size_y = light.size_mm
    else:
        data.shadow_soft_size = light.radius_mm
    if light.kind == "SPOT":
        data.spot_size = math.radians(light.cone_deg)
        data.spot_blend = light.blend
    return aimed(bpy.data.objects.new(data.name, data), light.position_mm, light.target_mm)
