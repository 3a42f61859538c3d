# SPDX-License-Identifier: GPL-2.0-or-later
"""A plane with the node, a lamp and a camera: what most scripts about the node render."""

from __future__ import annotations

import bpy
from mathutils import Matrix, Vector

NODE = "ShaderNodeBsdfICWafer"


def empty_scene() -> None:
    """Nothing but a black world, which is what an empty scene without one shows."""
    bpy.ops.wm.read_factory_settings(use_empty=True)


def wafer_material(name: str = "Wafer") -> tuple[bpy.types.Material, bpy.types.ShaderNode]:
    """A new material whose surface is a new node, as the Add menu makes it, and that node."""
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.remove(tree.nodes["Principled BSDF"])
    node = tree.nodes.new(NODE)
    tree.links.new(node.outputs["BSDF"], tree.nodes["Material Output"].inputs["Surface"])
    return material, node


def add_plane(material: bpy.types.Material, size: float = 40.0) -> bpy.types.Object:
    """A square in the plane z = 0 around the origin."""
    bpy.ops.mesh.primitive_plane_add(size=size)
    # Unlike bpy.context.object, this is there without a window in the context, in a timer too.
    plane = bpy.context.view_layer.objects.active
    plane.data.materials.append(material)
    return plane


def add_lamp(location: tuple[float, float, float], energy_w: float = 30.0) -> bpy.types.Object:
    """A point lamp without size: sharp and free of noise."""
    light = bpy.data.lights.new("Lamp", "POINT")
    light.shadow_soft_size = 0.0
    light.energy = energy_w
    lamp = bpy.data.objects.new("Lamp", light)
    lamp.location = location
    bpy.context.collection.objects.link(lamp)
    return lamp


def add_camera(
    location: tuple[float, float, float],
    axes: tuple[tuple[float, float, float], ...] = ((1, 0, 0), (0, 1, 0), (0, 0, -1)),
) -> bpy.types.Camera:
    """The scene's camera; `axes` point right, to the top and forward (here: looking down)."""
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    right, top, forward = map(Vector, axes)
    turn = Matrix((right, top, -forward)).transposed()
    camera.matrix_world = Matrix.Translation(location) @ turn.to_4x4()
    bpy.context.collection.objects.link(camera)
    bpy.context.scene.camera = camera
    return camera.data
