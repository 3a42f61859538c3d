# SPDX-License-Identifier: GPL-2.0-or-later
"""Materials from the table of presets (icwafer.assets.materials)."""

from __future__ import annotations

import bpy

from icwafer.assets.materials import MaterialPreset
from icwafer.scene.material import NODE, expect_node, set_node, wafer_material


def preset_material(preset: MaterialPreset, direction_rad: float = 0.0) -> bpy.types.Material:
    """A new material with the values of a preset, and the node's own where it names none.

    direction_rad: the node's Direction, where the preset does not decide it.
    """
    expect_node()
    if preset.from_attributes:
        material = wafer_material(preset.node)
        material.name = preset.name
        return material
    material = bpy.data.materials.new(preset.name)
    material.use_nodes = True
    add_node(material.node_tree, preset, direction_rad)
    return material


def add_node(
    tree: bpy.types.NodeTree, preset: MaterialPreset, direction_rad: float = 0.0
) -> bpy.types.Node:
    """Puts an IC Wafer BSDF in the place of all nodes of a tree. Returns it."""
    tree.nodes.clear()
    wafer = tree.nodes.new(NODE)
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    output.location.x = 300
    tree.links.new(wafer.outputs["BSDF"], output.inputs["Surface"])
    wafer.inputs["Direction"].default_value = direction_rad
    apply_preset(tree, wafer, preset)
    return wafer


def apply_preset(tree: bpy.types.NodeTree, wafer: bpy.types.Node, preset: MaterialPreset) -> None:
    """Gives a node of a tree what a preset names; its other inputs and their links stay."""
    set_node(tree, wafer, preset.node)
    if preset.round_tracks:
        set_node(tree, wafer, {"Direction": 0.0})
        tangent = tree.nodes.new("ShaderNodeTangent")
        tangent.direction_type, tangent.axis = "RADIAL", "Z"
        tangent.location = (wafer.location.x - 200, wafer.location.y - 400)
        tree.links.new(tangent.outputs["Tangent"], wafer.inputs["Tangent"])
