# SPDX-License-Identifier: GPL-2.0-or-later
"""Render gratings under a lamp, without film, wire diffraction and mirror reflection.

Parameters: `mounts`, a list of the fields of dispersion.Mount with `axes`, the camera's, and
`exr`, where the picture goes.
"""

from __future__ import annotations

import math
from typing import Any

import bpy
from exchange import parameters, report
from rendering import render_to, use_cycles
from wafer_scene import add_camera, add_lamp, add_plane, empty_scene, wafer_material


def build(mount: dict[str, Any]) -> None:
    empty_scene()
    material, node = wafer_material()
    node.model = "CS348B"
    node.use_grating = True
    node.use_thin_film = False
    node.use_wire_diffraction = False
    node.inputs["Wire Spacing"].default_value = mount["spacing_nm"]
    node.inputs["Direction"].default_value = math.radians(mount["direction_deg"])
    node.inputs["Lobe Width"].default_value = mount["lobe_width"]
    node.inputs["Specular"].default_value = 0.0
    add_plane(material).rotation_euler[2] = math.radians(mount["turn_deg"])
    add_lamp(mount["lamp"])

    camera = add_camera(mount["camera"], mount["axes"])
    if mount["perspective"]:
        camera.angle = 2.0 * math.atan(0.5 * mount["view"])
    else:
        camera.type = "ORTHO"
        camera.ortho_scale = mount["view"]


for mount in parameters()["mounts"]:
    build(mount)
    use_cycles(width=mount["size_px"], height=mount["size_px"], samples=16)
    # A pixel is what falls into its square: nothing is smeared over its neighbours.
    bpy.context.scene.cycles.pixel_filter_type = "BOX"
    bpy.context.scene.cycles.filter_width = 1.0
    render_to(exr=mount["exr"])
report({})
