# SPDX-License-Identifier: GPL-2.0-or-later
"""Make or open a file with the node, copy it, save it, and report the node's state.

Parameters: `open` (a file, or null: a new one, with a node in which nothing is as it was),
`save` (a file or null), `copy` (report a copy of the material instead).
"""

from __future__ import annotations

import bpy
from exchange import parameters, report
from node_state import node_state
from wafer_scene import NODE, add_plane, empty_scene, wafer_material

MATERIAL = "Wafer"


def change_everything(node: bpy.types.ShaderNode) -> None:
    """Give each input its own value, switch the effects, and link what can only be linked."""
    for number, socket in enumerate(node.inputs):
        if socket.type == "VALUE":
            socket.default_value = 0.125 * number
    node.inputs["Color"].default_value = (0.25, 0.5, 0.75, 1.0)
    node.use_wire_diffraction = False
    node.use_thin_film = False
    node.metal, node.oxide, node.illuminant = "CUSTOM", "SI3N4", "SODIUM"
    tree = node.id_data
    for name, source in (
        ("Normal", "ShaderNodeBump"),
        ("Tangent", "ShaderNodeTangent"),
        ("Wire Spacing", "ShaderNodeAttribute"),
    ):
        other = tree.nodes.new(source)
        output = {"ShaderNodeAttribute": "Fac"}.get(source, 0)
        tree.links.new(other.outputs[output], node.inputs[name])


given = parameters()
if given["open"]:
    bpy.ops.wm.open_mainfile(filepath=given["open"])
    material = bpy.data.materials[MATERIAL]
else:
    empty_scene()
    material, new_node = wafer_material(MATERIAL)
    change_everything(new_node)
    add_plane(material)
if given["save"]:
    bpy.ops.wm.save_as_mainfile(filepath=given["save"], check_existing=False)
if given["copy"]:
    material = material.copy()
node = material.node_tree.nodes["IC Wafer BSDF"]
report({"known": hasattr(bpy.types, NODE), "state": node_state(node)})
