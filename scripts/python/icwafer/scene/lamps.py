# SPDX-License-Identifier: GPL-2.0-or-later
"""Lamps, and cards that only reflections show."""

from __future__ import annotations

import math

import bpy
import numpy as np

from icwafer.pictures import Light
from icwafer.scene.aim import aimed
from icwafer.scene.polygons import polygon_mesh


def lamp(light: Light) -> bpy.types.Object:
    """An object with the lamp, not yet in a collection."""
    thing = _card(light) if light.kind == "CARD" else _lamp(light)
    aimed(thing, light.position_mm, light.target_mm)
    thing.rotation_euler.rotate_axis("Z", math.radians(light.turn_deg))
    return thing


def _lamp(light: Light) -> bpy.types.Object:
    data = bpy.data.lights.new(light.kind.title(), light.kind)
    data.energy = light.power_w
    data.color = light.colour
    if light.kind == "AREA":
        data.shape = "RECTANGLE"
        data.size, data.size_y = light.size_mm
        if light.fade:
            data.use_nodes = True
            emission = data.node_tree.nodes["Emission"]
            place = data.node_tree.nodes.new("ShaderNodeNewGeometry")
            _fade_out(data.node_tree, place.outputs["Parametric"], emission, light.fade, 1.0)
    else:
        data.shadow_soft_size = light.radius_mm
    if light.kind == "SPOT":
        data.spot_size = math.radians(light.cone_deg)
        data.spot_blend = light.blend
    return bpy.data.objects.new(data.name, data)


def _card(light: Light) -> bpy.types.Object:
    """A plane with the radiance of an area lamp of the same power."""
    half = np.array(light.size_mm) / 2
    corners = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)]) * half
    mesh = polygon_mesh("Card", np.insert(corners, 2, 0.0, axis=1), [np.arange(4)[None]])
    mesh.uv_layers.new().data.foreach_set("uv", (corners / (2 * half) + 0.5).ravel())
    material = bpy.data.materials.new("Card")
    material.use_nodes = True
    material.cycles.sample_as_light = False
    tree = material.node_tree
    tree.nodes.clear()
    emission = tree.nodes.new("ShaderNodeEmission")
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(emission.outputs[0], output.inputs["Surface"])
    emission.inputs["Color"].default_value = (*light.colour, 1.0)
    radiance = light.power_w / (4 * 4 * half.prod())  # as Blender has it, a quarter over the area
    emission.inputs["Strength"].default_value = radiance
    if light.fade:
        place = tree.nodes.new("ShaderNodeTexCoord")
        _fade_out(tree, place.outputs["UV"], emission, light.fade, radiance)
    mesh.materials.append(material)
    card = bpy.data.objects.new("Card", mesh)
    card.visible_camera = card.visible_shadow = card.visible_diffuse = False
    return card


def _fade_out(
    tree: bpy.types.NodeTree,
    place: bpy.types.NodeSocket,
    emission: bpy.types.Node,
    share: float,
    strength: float,
) -> None:
    """Lets an emission fade smoothly to the edges, over a share of half the width and height.

    place: 0 to 1 along width and height. strength: in the middle.
    """
    parts = tree.nodes.new("ShaderNodeSeparateXYZ")
    tree.links.new(place, parts.inputs["Vector"])
    both = tree.nodes.new("ShaderNodeMath")
    both.operation = "MULTIPLY"
    for index, axis in enumerate("XY"):
        inside = tree.nodes.new("ShaderNodeMath")
        inside.operation = "PINGPONG"  # 0 at both edges, a half in the middle
        inside.inputs[1].default_value = 0.5
        step = tree.nodes.new("ShaderNodeMapRange")
        step.interpolation_type = "SMOOTHSTEP"
        step.inputs["From Max"].default_value = 0.5 * share
        step.inputs["To Max"].default_value = strength if index == 0 else 1.0
        tree.links.new(parts.outputs[axis], inside.inputs[0])
        tree.links.new(inside.outputs[0], step.inputs["Value"])
        tree.links.new(step.outputs["Result"], both.inputs[index])
    tree.links.new(both.outputs[0], emission.inputs["Strength"])
