# SPDX-License-Identifier: GPL-2.0-or-later
"""What surrounds a scene."""

from __future__ import annotations

import math

import bpy

from icwafer.pictures import Environment


def world(environment: Environment) -> bpy.types.World:
    """A world of one colour, or with a panorama."""
    made = bpy.data.worlds.new("Surroundings")
    if environment.strength == 0.0:
        made.color = (0.0, 0.0, 0.0)
        return made
    made.use_nodes = True
    tree = made.node_tree
    background = tree.nodes["Background"]
    background.inputs["Color"].default_value = (*environment.colour, 1.0)
    background.inputs["Strength"].default_value = environment.strength
    if environment.image:
        _hang_panorama(tree, background, environment)
    return made


def _hang_panorama(
    tree: bpy.types.NodeTree, background: bpy.types.Node, environment: Environment
) -> None:
    """Lets the panorama, tinted and turned, colour the background."""
    panorama = tree.nodes.new("ShaderNodeTexEnvironment")
    panorama.image = bpy.data.images.load(environment.image)
    place = tree.nodes.new("ShaderNodeTexCoord")
    turn = tree.nodes.new("ShaderNodeMapping")
    turn.inputs["Rotation"].default_value[2] = math.radians(environment.rotation_deg)
    tint = tree.nodes.new("ShaderNodeVectorMath")
    tint.operation = "MULTIPLY"
    tint.inputs[1].default_value = environment.colour
    tree.links.new(place.outputs["Generated"], turn.inputs["Vector"])
    tree.links.new(turn.outputs["Vector"], panorama.inputs["Vector"])
    tree.links.new(panorama.outputs["Color"], tint.inputs[0])
    tree.links.new(tint.outputs["Vector"], background.inputs["Color"])
