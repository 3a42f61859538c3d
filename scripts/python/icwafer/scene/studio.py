# SPDX-License-Identifier: GPL-2.0-or-later
"""What stands around a die or a wafer: tables."""

from __future__ import annotations

import bpy
import numpy as np

from icwafer.pictures import Table
from icwafer.scene.polygons import polygon_mesh


def table_object(table: Table) -> bpy.types.Object:
    """A square plane below the origin, not yet in a collection.

    Its reflectance falls to nothing at the table's size from the middle, so that it has no edge.
    """
    corners = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)]) * table.size_mm
    points = np.insert(corners, 2, -table.depth_mm, axis=1)
    mesh = polygon_mesh("Table", points, [np.arange(4)[None]])
    mesh.materials.append(_fading(table))
    return bpy.data.objects.new("Table", mesh)


def _fading(table: Table) -> bpy.types.Material:
    # Not a Principled BSDF, which mirrors lamps at grazing light however dark it is.
    material = bpy.data.materials.new("Table")
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    glossy = tree.nodes.new("ShaderNodeBsdfGlossy")
    glossy.inputs["Roughness"].default_value = table.roughness
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    output.location.x = 200
    place = tree.nodes.new("ShaderNodeTexCoord")
    distance = tree.nodes.new("ShaderNodeVectorMath")
    distance.operation = "LENGTH"
    near = tree.nodes.new("ShaderNodeMapRange")
    near.interpolation_type = "SMOOTHERSTEP"
    near.inputs["From Max"].default_value = table.size_mm
    near.inputs["To Min"].default_value = 1.0
    near.inputs["To Max"].default_value = 0.0
    colour = tree.nodes.new("ShaderNodeVectorMath")
    colour.operation = "SCALE"
    colour.inputs[0].default_value = table.colour
    for row, node in enumerate((place, distance, near, colour)):
        node.location = (200 * row - 1000, 0)
    tree.links.new(place.outputs["Object"], distance.inputs[0])
    tree.links.new(distance.outputs["Value"], near.inputs["Value"])
    tree.links.new(near.outputs["Result"], colour.inputs["Scale"])
    tree.links.new(colour.outputs["Vector"], glossy.inputs["Color"])
    tree.links.new(glossy.outputs["BSDF"], output.inputs["Surface"])
    return material
