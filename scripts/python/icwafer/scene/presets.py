# SPDX-License-Identifier: GPL-2.0-or-later
"""Materials from the table of presets (icwafer.assets.materials)."""

from __future__ import annotations

import bpy

from icwafer.assets.materials import MaterialPreset
from icwafer.scene.material import NODE, chip_material, expect_node, set_node

TANGENT = "ShaderNodeTangent"


def preset_material(preset: MaterialPreset, direction_rad: float = 0.0) -> bpy.types.Material:
    """A new material with the values of a preset, and the node's own where it names none.

    direction_rad: the node's Direction, where the mesh or round tracks do not decide it. Raises
    IcwaferError in a Blender without the node.
    """
    expect_node()
    if preset.from_attributes:
        return chip_material(preset.name, preset.node)
    material = bpy.data.materials.new(preset.name)
    material.use_nodes = True
    material.node_tree.nodes.remove(material.node_tree.nodes["Principled BSDF"])
    wafer_node(material).inputs["Direction"].default_value = direction_rad
    apply_preset(material, preset)
    return material


def wafer_node(material: bpy.types.Material) -> bpy.types.Node:
    """The IC Wafer BSDF of a material, the active one if there are several.

    Where there is none, a new one becomes its surface; all other nodes stay.
    """
    material.use_nodes = True
    tree = material.node_tree
    there = [node for node in (tree.nodes.active, *tree.nodes) if node and node.bl_idname == NODE]
    if there:
        return there[0]
    output = tree.get_output_node("CYCLES") or tree.nodes.new("ShaderNodeOutputMaterial")
    wafer = tree.nodes.new(NODE)
    wafer.location = (output.location.x - 300, output.location.y)
    tree.links.new(wafer.outputs["BSDF"], output.inputs["Surface"])
    return wafer


def apply_preset(material: bpy.types.Material, preset: MaterialPreset) -> None:
    """Gives the node of a material what a preset names; its other inputs and their links stay."""
    wafer, tree = wafer_node(material), material.node_tree
    set_node(tree, wafer, preset.node)
    if "Wire Spacing" in preset.node:
        for link in wafer.inputs["Tangent"].links:
            if link.from_node.bl_idname == TANGENT and link.from_node.direction_type == "RADIAL":
                tree.nodes.remove(link.from_node)
    if preset.round_tracks:
        set_node(tree, wafer, {"Direction": 0.0})
        tangent = tree.nodes.new(TANGENT)
        tangent.direction_type, tangent.axis = "RADIAL", "Z"
        tangent.location = (wafer.location.x - 200, wafer.location.y - 400)
        tree.links.new(tangent.outputs["Tangent"], wafer.inputs["Tangent"])
