# SPDX-License-Identifier: GPL-2.0-or-later
"""The node in the shader editor beside a rendered die: a picture of Blender's window.

Parameters: `png`; `tooltip_png`, the same with the mouse on the last socket; `python`, the folder
of the package icwafer; `picture`, one of its pictures; `pause_s`, the time for each step, in which
the viewport renders and the tooltip appears.
"""

from __future__ import annotations

import sys

import bpy
from exchange import parameters, report
from wafer_scene import NODE
from window import area_of, context_of, in_window

sys.path.insert(0, parameters()["python"])

from icwafer.pictures import PICTURES  # noqa: E402
from icwafer.scene.picture import build  # noqa: E402


def wafer_tree() -> bpy.types.NodeTree:
    return bpy.data.materials["Wafer"].node_tree


def wafer_node() -> bpy.types.ShaderNode:
    return next(node for node in wafer_tree().nodes if node.bl_idname == NODE)


def tidy_tree() -> None:
    """Fold the nodes that feed the wafer, so that the editor has room for it in full size."""
    node = wafer_node()
    wafer_tree().nodes.active = node
    # No socket's name is cut off.
    node.width = 200.0
    output = wafer_tree().nodes["Material Output"]
    output.location = (node.location.x + node.width + 50.0, node.location.y)
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


def node_rectangle() -> tuple[float, float, float, float]:
    """Left, bottom, right and top of the node, in pixels of the window."""
    region, node = context_of(area_of("NODE_EDITOR"))["region"], wafer_node()
    scale = bpy.context.preferences.system.ui_scale
    size = node.dimensions / scale
    (left, top), (right, bottom) = (
        region.view2d.view_to_region(scale * x, scale * y, clip=False)
        for x, y in (node.location, (node.location.x + size.x, node.location.y - size.y))
    )
    return region.x + left, region.y + bottom, region.x + right, region.y + top


def shoot() -> None:
    bpy.ops.screen.screenshot(filepath=parameters()["png"])
    region, window = (context_of(area_of("NODE_EDITOR"))[name] for name in ("region", "window"))
    report(
        {
            "window": [window.width, window.height],
            "node": node_rectangle(),
            "editor": [region.x, region.y, region.x + region.width, region.y + region.height],
        }
    )


def hover() -> None:
    """Bring the mouse to the last input's socket, on the node's left edge close to its foot."""
    left, bottom, right, _ = node_rectangle()
    zoom = (right - left) / wafer_node().width
    window = bpy.context.window_manager.windows[0]
    for away in (30, 15, 0):
        window.event_simulate(
            type="MOUSEMOVE", value="NOTHING", x=round(left) - away, y=round(bottom + 18.5 * zoom)
        )


def shoot_tooltip() -> None:
    bpy.ops.screen.screenshot(filepath=parameters()["tooltip_png"])


scene = build(PICTURES[parameters()["picture"]])
# The shader editor shows the active object's material.
bpy.context.view_layer.objects.active = scene.objects["Die"]
# An upright view would show the die small.
scene.camera.data.lens *= 2.0
scene.cycles.preview_samples = 64
scene.cycles.use_preview_denoising = False
in_window(
    arrange,
    frame_nodes,
    come_closer,
    shoot,
    hover,
    shoot_tooltip,
    pause_s=parameters()["pause_s"],
)
