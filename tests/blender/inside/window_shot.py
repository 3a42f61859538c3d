# SPDX-License-Identifier: GPL-2.0-or-later
"""The node in the shader editor beside a rendered viewport: a picture of Blender's window.

Parameters: `png`; `pause_s`, the time that the viewport gets to render.
"""

from __future__ import annotations

import math

import bpy
from exchange import parameters, report
from wafer_scene import add_camera, add_lamp, empty_scene, wafer_material
from window import area_of, context_of, in_window

WAFER_RADIUS_M = 1.0


def build_scene() -> bpy.types.Material:
    """A round wafer with a die pattern of two kinds of wires under three lamps."""
    material, node = wafer_material("Wafer")
    material.node_tree.nodes["Material Output"].location = (330.0, 0.0)
    node.location = (0.0, 0.0)
    material.node_tree.nodes.active = node
    bpy.ops.mesh.primitive_circle_add(vertices=128, radius=WAFER_RADIUS_M, fill_type="NGON")
    wafer = bpy.context.view_layer.objects.active
    wafer.data.materials.append(material)
    wafer.rotation_euler = (math.radians(-12.0), 0.0, math.radians(20.0))
    for location, energy_w in (
        ((0.5, 1.2, 1.6), 60.0),
        ((-1.4, -0.3, 1.4), 50.0),
        ((1.6, -0.9, 1.2), 40.0),
    ):
        add_lamp(location, energy_w)
    add_camera((0.0, 0.0, 3.4)).lens = 50.0
    return material


def prepare() -> None:
    material = build_scene()
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.preview_samples = 32
    scene.cycles.use_preview_denoising = False
    scene.render.resolution_x = scene.render.resolution_y = 1000

    editor = area_of("VIEW_3D")
    with bpy.context.temp_override(**context_of(editor)):
        bpy.ops.screen.area_split(direction="VERTICAL", factor=0.45)
    editor.ui_type = "ShaderNodeTree"
    editor.spaces.active.node_tree = material.node_tree
    editor.spaces.active.show_region_ui = False
    view = area_of("VIEW_3D").spaces.active
    view.shading.type = "RENDERED"
    view.overlay.show_overlays = False
    view.show_gizmo = False
    view.show_region_toolbar = False
    view.region_3d.view_perspective = "CAMERA"
    # The frame fills the view.
    view.region_3d.view_camera_zoom = 29.0


def frame_node() -> None:
    with bpy.context.temp_override(**context_of(area_of("NODE_EDITOR"))):
        bpy.ops.node.view_all()


def shoot() -> None:
    bpy.ops.screen.screenshot(filepath=parameters()["png"])
    context = context_of(area_of("NODE_EDITOR"))
    region, window = context["region"], context["window"]
    node = context["area"].spaces.active.node_tree.nodes.active
    scale = bpy.context.preferences.system.ui_scale
    corners = [
        region.view2d.view_to_region(scale * x, scale * y, clip=False)
        for x, y in (
            (node.location.x, node.location.y),
            (node.location.x + node.width, node.location.y - node.dimensions.y / scale),
        )
    ]
    (left, top), (right, bottom) = corners
    report(
        {
            "window": [window.width, window.height],
            "node": [region.x + left, region.y + bottom, region.x + right, region.y + top],
            "editor": [region.x, region.y, region.x + region.width, region.y + region.height],
        }
    )


empty_scene()
in_window(prepare, frame_node, shoot, pause_s=parameters()["pause_s"])
