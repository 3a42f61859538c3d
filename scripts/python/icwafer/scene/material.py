# SPDX-License-Identifier: GPL-2.0-or-later
"""The material of dies: the node IC Wafer BSDF, driven by the attributes of the mesh."""

from __future__ import annotations

from collections.abc import Mapping

import bpy

from icwafer.errors import IcwaferError
from icwafer.pictures import NodeValue
from icwafer.scene.mesh import SOCKET_OF_ATTRIBUTE
from icwafer.scene.properties import assign

NODE = "ShaderNodeBsdfICWafer"


def expect_node() -> None:
    """Raises IcwaferError in a Blender without the node."""
    if not hasattr(bpy.types, NODE):
        raise IcwaferError(
            "this Blender has no IC Wafer BSDF node: build one that has, "
            "with scripts/icwafer build blender"
        )


def wafer_material(values: Mapping[str, NodeValue]) -> bpy.types.Material:
    """A material whose IC Wafer BSDF takes its wires from the attributes of the mesh.

    values: of the node's inputs and properties; an input that is named here takes no attribute.
    """
    material = bpy.data.materials.new("Wafer")
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    wafer = tree.nodes.new(NODE)
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    output.location.x = 300
    tree.links.new(wafer.outputs["BSDF"], output.inputs["Surface"])
    for row, (attribute, socket) in enumerate(SOCKET_OF_ATTRIBUTE.items()):
        source = tree.nodes.new("ShaderNodeAttribute")
        source.attribute_name = attribute
        source.location = (-300, -200 * row)
        tree.links.new(source.outputs["Fac"], wafer.inputs[socket])
    set_node(tree, wafer, values)
    return material


def set_node(
    tree: bpy.types.NodeTree, wafer: bpy.types.Node, values: Mapping[str, NodeValue]
) -> None:
    """Gives inputs (by name) and properties of an IC Wafer BSDF a value, linked or not."""
    for name, value in values.items():
        if name in wafer.inputs:
            for link in wafer.inputs[name].links:
                tree.links.remove(link)
            opaque = wafer.inputs[name].type == "RGBA"
            wafer.inputs[name].default_value = (*value, 1.0) if opaque else value
        else:
            assign(wafer, name, value, f"node.{name}")
