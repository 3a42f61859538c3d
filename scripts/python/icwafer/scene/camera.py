# SPDX-License-Identifier: GPL-2.0-or-later
"""Cameras."""

from __future__ import annotations

import bpy

from icwafer.pictures import Camera
from icwafer.scene.aim import aimed


def camera_object(camera: Camera) -> bpy.types.Object:
    """An object with the camera, not yet in a collection."""
    data = bpy.data.cameras.new("Camera")
    data.lens = camera.lens_mm
    data.clip_end = 1000.0
    return aimed(bpy.data.objects.new("Camera", data), camera.position_mm, camera.target_mm)
