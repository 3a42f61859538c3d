# SPDX-License-Identifier: GPL-2.0-or-later
"""The node in the shader editor beside a rendered die: a picture of Blender's window.

Parameters: `png`; `python`, the folder of the package icwafer; `picture`, one of its pictures;
`pause_s`, the time that the viewport gets to render.
"""

from __future__ import annotations

import sys

import bpy
from exchange import parameters, report
from wafer_scene import NODE
from window import area_of, context_of, in_window

sys.path.insert(0, parameters()["python"])

from icwafer.blender_scene import build  # noqa: E402
from icwafer.pictures import PICTURES  # noqa: E402


def wafer_tree() -> bpy.types.NodeTree:
    return bpy.data.materials["Wafer"].node_tree


def wafer_node() -> bpy.types.ShaderNode:
    return next(node for node in wafer_tree().nodes if node.bl_idname == NODE)


def tidy_tree() -> None:
    """Fold the nodes that feed the wafer, so that the editor has room for it in full size."""
    node = wafer_node()
    wafer_tree().nodes.active = node
    sources = [n for n in wafer_tree().nodes if n.bl_idname == "ShaderNodeAttribute"]
    for row, source in enumerate(sources):
        source.hide = True
        source.label = source.attribute_name
        source.location = (node.location.x - 220.0, node.location.y - 150.0 - 45.0 * row)


def arrange() -> None:
    """Viewport to the left, shader editor to the right."""
    tidy_tree()
    editor = area_of("VIEW_3D")
    with bpy.context.temp_override(**context_of(editor)):
        bpy.ops.screen.area_split(direction="VERTICAL", factor=0.5)
    editor.ui_type = "ShaderNodeTree"
    editor.spaces.active.show_region_ui = False

    area = area_of("VIEW_3D")
    view = area.spaces.active
    view.shading.type = "RENDERED"
    view.overlay.show_overlays = False
    view.show_gizmo = False
    view.show_region_toolbar = False
    view.region_3d.view_perspective = "CAMERA"
    # The camera's frame is the whole view.
    render = bpy.context.scene.render
    render.resolution_x, render.resolution_y = area.width, area.height
    view.region_3d.view_camera_zoom = 29.0


def frame_nodes() -> None:
    with bpy.context.temp_override(**context_of(area_of("NODE_EDITOR"))):
        bpy.ops.node.view_all()


def come_closer() -> None:
    """View All leaves a wide margin around the nodes."""
    with bpy.context.temp_override(**context_of(area_of("NODE_EDITOR"))):
        for _ in range(5):
            bpy.ops.view2d.zoom_in()


def shoot() -> None:
    bpy.ops.screen.screenshot(filepath=parameters()["png"])
    context = context_of(area_of("NODE_EDITOR"))
    region, window, node = context["region"], context["window"], wafer_node()
    scale = bpy.context.preferences.system.ui_scale
    size = node.dimensions / scale
    (left, top), (right, bottom) = (
        region.view2d.view_to_region(scale * x, scale * y, clip=False)
        for x, y in (node.location, (node.location.x + size.x, node.location.y - size.y))
    )
    report(
        {
            "window": [window.width, window.height],
            "node": [region.x + left, region.y + bottom, region.x + right, region.y + top],
            "editor": [region.x, region.y, region.x + region.width, region.y + region.height],
        }
    )


scene = build(PICTURES[parameters()["picture"]])
# The shader editor shows the active object's material.
bpy.context.view_layer.objects.active = scene.objects["Die"]
# An upright view would show the die small.
scene.camera.data.lens *= 1.7
scene.cycles.preview_samples = 64
scene.cycles.use_preview_denoising = False
in_window(arrange, frame_nodes, come_closer, shoot, pause_s=parameters()["pause_s"])
