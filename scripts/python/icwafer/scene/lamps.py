# SPDX-License-Identifier: GPL-2.0-or-later
"""Lamps."""

from __future__ import annotations

import math

import bpy

from icwafer.pictures import Light
from icwafer.scene.aim import aimed


def lamp(light: Light) -> bpy.types.Object:
    """An object with the lamp, not yet in a collection."""
    data = bpy.data.lights.new(light.kind.title(), light.kind)
    data.energy = light.power_w
    data.color = light.colour
    if light.kind == "AREA":
        data.shape = "RECTANGLE"
        data.size, data.size_y = light.size_mm
        if light.fade:
            _fade_out(data, light.fade)
    else:
        data.shadow_soft_size = light.radius_mm
    if light.kind == "SPOT":
        data.spot_size = math.radians(light.cone_deg)
        data.spot_blend = light.blend
    thing = aimed(bpy.data.objects.new(data.name, data), light.position_mm, light.target_mm)
    thing.rotation_euler.rotate_axis("Z", math.radians(light.turn_deg))
    return thing


def _fade_out(data: bpy.types.Light, share: float) -> None:
    """Lets an area fade smoothly towards its edges, over a share of its half width and height.

    Its power counts as if it did not.
    """
    data.use_nodes = True
    tree = data.node_tree
    emission = tree.nodes["Emission"]
    place = tree.nodes.new("ShaderNodeNewGeometry")
    parts = tree.nodes.new("ShaderNodeSeparateXYZ")
    tree.links.new(place.outputs["Parametric"], parts.inputs["Vector"])
    both = tree.nodes.new("ShaderNodeMath")
    both.operation = "MULTIPLY"
    for index, axis in enumerate("XY"):
        # 0 at both edges, 1 in the middle.
        inside = tree.nodes.new("ShaderNodeMath")
        inside.operation = "PINGPONG"
        inside.inputs[1].default_value = 0.5
        step = tree.nodes.new("ShaderNodeMapRange")
        step.interpolation_type = "SMOOTHSTEP"
        step.inputs["From Max"].default_value = 0.5 * share
        tree.links.new(parts.outputs[axis], inside.inputs[0])
        tree.links.new(inside.outputs[0], step.inputs["Value"])
        tree.links.new(step.outputs["Result"], both.inputs[index])
    tree.links.new(both.outputs[0], emission.inputs["Strength"])
