# SPDX-License-Identifier: GPL-2.0-or-later
"""Cameras."""

from __future__ import annotations

import math

import bpy

from icwafer.pictures import Camera
from icwafer.scene.aim import aimed


def camera_object(camera: Camera) -> bpy.types.Object:
    """An object with the camera, not yet in a collection."""
    data = bpy.data.cameras.new("Camera")
    data.lens = camera.lens_mm
    distance_mm = math.dist(camera.position_mm, camera.target_mm)
    data.clip_start, data.clip_end = distance_mm / 1000, distance_mm + 1000.0
    if camera.f_stop:
        data.dof.use_dof = True
        data.dof.focus_distance = distance_mm
        # Blender takes a lens in millimetres and a scene in metres; here both are millimetres.
        data.dof.aperture_fstop = camera.f_stop / 1000
    thing = aimed(bpy.data.objects.new("Camera", data), camera.position_mm, camera.target_mm)
    thing.rotation_euler.rotate_axis("Z", -math.radians(camera.roll_deg))
    return thing
