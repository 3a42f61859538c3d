# SPDX-License-Identifier: GPL-2.0-or-later
"""The material of dies: the node IC Wafer BSDF, driven by the attributes of the mesh."""

from __future__ import annotations

from collections.abc import Mapping

import bpy

from icwafer.attributes import DRIFT, DRIFTING
from icwafer.errors import IcwaferError
from icwafer.pictures import Irregular, NodeValue
from icwafer.scene.mesh import SOCKET_OF_ATTRIBUTE
from icwafer.scene.properties import assign

NODE = "ShaderNodeBsdfICWafer"

#: What each attribute of a block changes with on a wafer: value x (1 + drift).
DRIFT_OF_ATTRIBUTE = {
    "ic_oxide_nm": "oxide",
    "ic_groove_nm": "groove",
    "ic_width_nm": "width",
    "ic_cross_width_nm": "width",
}

#: Of chips in viewports without light and shade: their tint on average.
VIEWPORT_COLOUR = (0.30, 0.24, 0.38)


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
        source = _attribute(tree, attribute, (-300, -200 * row))
        tree.links.new(source.outputs["Fac"], wafer.inputs[socket])
    set_node(tree, wafer, values)
    return material


def chip_material(
    name: str,
    values: Mapping[str, NodeValue] | None = None,
    rest_colour: tuple[float, float, float] = Irregular.colour,
    rest_roughness: float = Irregular.roughness,
) -> bpy.types.Material:
    """A material for chips of the model PHYSICAL, driven by the attributes of mesh and instance.

    The share of a block that diffracts is its `ic_diffraction`; the rest is metal without a
    regular pattern, which reflects softly as a metal of the other arguments. Film, grooves and
    wires follow the drift of a wafer.
    values: of the node's inputs and properties; an input that is named here takes no attribute.
    """
    material = bpy.data.materials.new(name)
    material.diffuse_color = (*VIEWPORT_COLOUR, 1.0)
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    wafer = tree.nodes.new(NODE)
    rest = tree.nodes.new("ShaderNodeBsdfGlossy")
    rest.inputs["Color"].default_value = (*rest_colour, 1.0)
    rest.inputs["Roughness"].default_value = rest_roughness
    mix = tree.nodes.new("ShaderNodeMixShader")
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    for node, place in ((rest, (0, 150)), (wafer, (0, 0)), (mix, (300, 0)), (output, (500, 0))):
        node.location = place
    tree.links.new(rest.outputs["BSDF"], mix.inputs[1])
    tree.links.new(wafer.outputs["BSDF"], mix.inputs[2])
    tree.links.new(mix.outputs["Shader"], output.inputs["Surface"])
    # All of it is 0 where a die does not stand on a wafer.
    drifts = tree.nodes.new("ShaderNodeSeparateXYZ")
    drifts.location = (-500, 200)
    instance = _attribute(tree, DRIFT.name, (-700, 200), "INSTANCER")
    tree.links.new(instance.outputs["Vector"], drifts.inputs["Vector"])
    for row, (attribute, socket) in enumerate(SOCKET_OF_ATTRIBUTE.items()):
        value = _attribute(tree, attribute, (-500, -200 * row)).outputs["Fac"]
        if attribute in DRIFT_OF_ATTRIBUTE:
            drift = drifts.outputs[DRIFTING.index(DRIFT_OF_ATTRIBUTE[attribute])]
            value = _drifted(tree, value, drift, (-250, -200 * row))
        tree.links.new(
            value, mix.inputs["Fac"] if socket == "Diffraction" else wafer.inputs[socket]
        )
    set_node(tree, wafer, values or {})
    return material


def _attribute(
    tree: bpy.types.NodeTree, name: str, place: tuple[float, float], kind: str = "GEOMETRY"
) -> bpy.types.Node:
    node = tree.nodes.new("ShaderNodeAttribute")
    node.attribute_name, node.attribute_type, node.location = name, kind, place
    return node


def _drifted(
    tree: bpy.types.NodeTree,
    value: bpy.types.NodeSocket,
    drift: bpy.types.NodeSocket,
    place: tuple[float, float],
) -> bpy.types.NodeSocket:
    """value x (1 + drift), in one node."""
    node = tree.nodes.new("ShaderNodeMath")
    node.operation, node.location = "MULTIPLY_ADD", place
    for operand, socket in zip((value, drift, value), node.inputs):
        tree.links.new(operand, socket)
    return node.outputs[0]


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
