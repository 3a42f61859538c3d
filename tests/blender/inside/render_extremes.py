# SPDX-License-Identifier: GPL-2.0-or-later
"""Render a plane of many squares, each with its own values of the node's inputs.

Parameters: `attributes`, from an input's name to one number per square (row by row), `side`, the
number of squares along an edge, `inputs` and `properties`, values for the others, and `exr`: one
pixel per square.
"""

from __future__ import annotations

import bmesh
import bpy
from exchange import parameters, report
from rendering import render_to, use_cycles
from wafer_scene import add_camera, add_lamp, empty_scene, wafer_material


def squares(side: int, attributes: dict[str, list[float]]) -> bpy.types.Mesh:
    """A grid of side x side faces of size 1 with float attributes."""
    shape = bmesh.new()
    bmesh.ops.create_grid(shape, x_segments=side, y_segments=side, size=0.5 * side)
    mesh = bpy.data.meshes.new("Squares")
    shape.to_mesh(mesh)
    shape.free()
    for name, numbers in attributes.items():
        mesh.attributes.new(name, "FLOAT", "FACE").data.foreach_set("value", numbers)
    return mesh


given = parameters()
side = given["side"]
empty_scene()
material, node = wafer_material()
for name, value in given["properties"].items():
    setattr(node, name, value)
for name, value in given["inputs"].items():
    node.inputs[name].default_value = value
# A matt part beside it, which shows a pixel that has lost its light.
tree = node.id_data
matt, both = tree.nodes.new("ShaderNodeBsdfDiffuse"), tree.nodes.new("ShaderNodeAddShader")
matt.inputs["Color"].default_value = (0.5, 0.5, 0.5, 1.0)
tree.links.new(node.outputs["BSDF"], both.inputs[0])
tree.links.new(matt.outputs["BSDF"], both.inputs[1])
tree.links.new(both.outputs["Shader"], tree.nodes["Material Output"].inputs["Surface"])
for name in given["attributes"]:
    attribute = node.id_data.nodes.new("ShaderNodeAttribute")
    attribute.attribute_name = name
    node.id_data.links.new(attribute.outputs["Fac"], node.inputs[name])
mesh = squares(side, given["attributes"])
mesh.materials.append(material)
bpy.context.collection.objects.link(bpy.data.objects.new("Squares", mesh))
add_lamp((0.1 * side, 0.05 * side, 0.4 * side), energy_w=40.0 * side**2)
camera = add_camera((0.0, 0.0, 10.0))
camera.type = "ORTHO"
camera.ortho_scale = side
use_cycles(width=side, height=side, samples=4)
bpy.context.scene.cycles.pixel_filter_type = "BOX"
bpy.context.scene.cycles.filter_width = 1.0
render_to(exr=given["exr"])
report({})
