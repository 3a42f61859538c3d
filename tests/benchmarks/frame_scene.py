# SPDX-License-Identifier: GPL-2.0-or-later
"""What the benchmarks of whole frames have in common: a plane under a sky and an area lamp."""

from __future__ import annotations

from collections.abc import Mapping

import bpy
import numpy as np
from mathutils import Vector

NODE = "ShaderNodeBsdfICWafer"
LUMINANCE = np.array([0.2126, 0.7152, 0.0722])  # of linear Rec.709


def scene(size: tuple[int, int], samples: int) -> tuple[bpy.types.Scene, bpy.types.Object]:
    """The scene and its plane, which fills the frame and has no material."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    made = bpy.context.scene
    bpy.ops.mesh.primitive_plane_add(size=20)
    plane = bpy.context.object
    plane.data.materials.append(None)
    lamp = bpy.data.lights.new("Lamp", "AREA")
    lamp.energy, lamp.size = 400, 1
    _add(lamp, (1.2, 1.0, 2.2))
    made.camera = _add(bpy.data.cameras.new("Camera"), (-1.0, -2.2, 2.4))
    made.world = bpy.data.worlds.new("Sky")
    made.world.use_nodes = True
    tree = made.world.node_tree
    sky = tree.nodes.new("ShaderNodeTexSky")
    sky.sky_type = "HOSEK_WILKIE"
    tree.links.new(sky.outputs["Color"], tree.nodes["Background"].inputs["Color"])
    made.render.engine = "CYCLES"
    made.cycles.samples = samples
    made.cycles.use_denoising = made.cycles.use_adaptive_sampling = False
    made.render.resolution_x, made.render.resolution_y = size
    made.render.use_persistent_data = True
    return made, plane


def _add(data: bpy.types.ID, place: tuple[float, float, float]) -> bpy.types.Object:
    """An object at a place, looking at the origin."""
    thing = bpy.data.objects.new("Thing", data)
    thing.location = place
    thing.rotation_euler = (-Vector(place)).to_track_quat("-Z", "Y").to_euler()
    bpy.context.scene.collection.objects.link(thing)
    return thing


def material(kind: str, values: Mapping[str, float | str]) -> bpy.types.Material:
    """A material of one node: its type, and values of inputs by name or of properties."""
    made = bpy.data.materials.new(kind)
    made.use_nodes = True
    tree = made.node_tree
    tree.nodes.remove(tree.nodes["Principled BSDF"])
    node = tree.nodes.new(kind)
    tree.links.new(node.outputs[0], tree.nodes["Material Output"].inputs["Surface"])
    for name, value in values.items():
        if name in node.inputs:
            node.inputs[name].default_value = value
        else:
            setattr(node, name, value)
    return made
