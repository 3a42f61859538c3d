# SPDX-License-Identifier: GPL-2.0-or-later
"""Dust on a wafer or a die."""

from __future__ import annotations

import bmesh
import bpy
import numpy as np

from icwafer.pictures import Dust
from icwafer.scene.polygons import polygon_mesh

#: Sizes are log-normal, as those of most powders; ln of 2 is one standard deviation.
_SPREAD = np.log(2.0)
_COLOUR = (0.8, 0.8, 0.8, 1.0)


def dust_object(dust: Dust, radius_mm: float) -> bpy.types.Object:
    """Grains on the disc of that radius around the origin in z = 0, not yet in a collection."""
    rng = np.random.default_rng(dust.seed)
    shape = bmesh.new()
    bmesh.ops.create_icosphere(shape, subdivisions=1, radius=0.5)
    corners = np.array([vertex.co[:] for vertex in shape.verts])
    faces = np.array([[vertex.index for vertex in face.verts] for face in shape.faces])
    shape.free()
    size_mm = dust.size_um / 1000 * np.exp(_SPREAD * rng.standard_normal(dust.count))
    distance_mm = radius_mm * np.sqrt(rng.uniform(size=dust.count))  # as many on every area
    angle = rng.uniform(0.0, 2 * np.pi, dust.count)
    middle_mm = np.stack(
        [distance_mm * np.cos(angle), distance_mm * np.sin(angle), size_mm / 2], axis=1
    )
    points = middle_mm[:, None] + corners * size_mm[:, None, None]
    grains = faces + (len(corners) * np.arange(dust.count))[:, None, None]
    mesh = polygon_mesh("Dust", points.reshape(-1, 3), [grains.reshape(-1, 3)])
    material = bpy.data.materials.new("Dust")
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    diffuse = tree.nodes.new("ShaderNodeBsdfDiffuse")
    diffuse.inputs["Color"].default_value = _COLOUR
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    output.location.x = 200
    tree.links.new(diffuse.outputs["BSDF"], output.inputs["Surface"])
    mesh.materials.append(material)
    return bpy.data.objects.new("Dust", mesh)
