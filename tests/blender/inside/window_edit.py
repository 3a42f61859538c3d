# SPDX-License-Identifier: GPL-2.0-or-later
"""Add, change, undo, redo, copy and paste the node as a user does, in the shader editor.

Parameters: `png`, from a viewport shading ("SOLID", "MATERIAL") to where its picture goes.
"""

from __future__ import annotations

import bpy
import nodeitems_utils
from exchange import parameters, report
from wafer_scene import NODE, add_camera, add_lamp, add_plane, empty_scene, wafer_material
from window import area_of, context_of, in_window

SPACING = "Wire Spacing"


def shader_editor() -> bpy.types.Area:
    """Turn the window's largest area into a shader editor."""
    area = area_of("VIEW_3D")
    area.ui_type = "ShaderNodeTree"
    return area


def wafers(tree: bpy.types.NodeTree) -> list[bpy.types.Node]:
    return [node for node in tree.nodes if node.bl_idname == NODE]


def edit() -> dict[str, object]:
    material, _ = wafer_material()
    add_plane(material, size=2.0)
    add_lamp((0.25, -0.2, 1.0))
    add_camera((0.0, 0.0, 3.0)).type = "ORTHO"
    tree = material.node_tree
    facts: dict[str, object] = {}
    with bpy.context.temp_override(**context_of(shader_editor())):
        bpy.context.space_data.node_tree = tree
        facts["search"] = [
            item.label
            for item in nodeitems_utils.node_items_iter(bpy.context)
            if getattr(item, "nodetype", "") == NODE
        ]
        bpy.ops.ed.undo_push(message="Before")
        bpy.ops.node.add_node(type=NODE, use_transform=False)
        bpy.ops.ed.undo_push(message="Added")
        wafers(tree)[1].inputs[SPACING].default_value = 777.0
        wafers(tree)[1].use_grating = False
        bpy.ops.ed.undo_push(message="Changed")

        # Undo replaces the data, so everything is looked up again.
        def states() -> list[tuple[float, bool]]:
            nodes = wafers(bpy.data.materials["Wafer"].node_tree)
            return [(node.inputs[SPACING].default_value, node.use_grating) for node in nodes]

        facts["changed"] = states()
        bpy.ops.ed.undo()
        facts["undone"] = states()
        bpy.ops.ed.undo()
        facts["undone twice"] = states()
        bpy.ops.ed.redo()
        bpy.ops.ed.redo()
        facts["redone"] = states()

    with bpy.context.temp_override(**context_of(area_of("NODE_EDITOR"))):
        bpy.context.space_data.node_tree = bpy.data.materials["Wafer"].node_tree
        bpy.ops.node.select_all(action="SELECT")
        bpy.ops.node.clipboard_copy()
        bpy.ops.node.clipboard_paste()
        facts["pasted"] = states()
    return facts


def look(shading: str, png: str) -> None:
    """Save what the viewport shows of the plane with the node."""
    area = area_of("NODE_EDITOR")
    area.ui_type = "VIEW_3D"
    area.spaces.active.shading.type = shading
    area.spaces.active.overlay.show_overlays = False
    area.spaces.active.region_3d.view_perspective = "CAMERA"
    scene = bpy.context.scene
    scene.camera.data.ortho_scale = 1.5
    scene.render.resolution_x = scene.render.resolution_y = 96
    scene.render.resolution_percentage = 100
    scene.render.filepath = png
    with bpy.context.temp_override(**context_of(area)):
        bpy.ops.render.opengl(write_still=True)
    area.ui_type = "ShaderNodeTree"


def work() -> None:
    facts = edit()
    for shading, png in parameters()["png"].items():
        look(shading, png)
    report(facts)


empty_scene()
in_window(work)
