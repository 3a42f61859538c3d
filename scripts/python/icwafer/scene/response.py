# SPDX-License-Identifier: GPL-2.0-or-later
"""What lens and camera make of the light, in the compositor."""

from __future__ import annotations

import math

import bpy

from icwafer.pictures import Response

#: Width of the lens's glow, as a share of the picture's.
_GLOW_WIDTH = 0.12


def set_response(scene: bpy.types.Scene, response: Response) -> None:
    """Lets the compositor finish the scene's picture; nothing where the response changes nothing.

    The scene must have its size already.
    """
    if response == Response():
        return
    scene.use_nodes = True
    tree = scene.node_tree
    tree.nodes.clear()
    rendered = tree.nodes.new("CompositorNodeRLayers")
    result = tree.nodes.new("CompositorNodeComposite")
    image = rendered.outputs["Image"]
    if response.glow:
        image = _glow(tree, image, response.glow, scene.render.resolution_x)
    if response.saturation != 1.0:
        image = _saturate(tree, image, response.saturation)
    tree.links.new(image, result.inputs["Image"])
    for column, node in enumerate(tree.nodes):
        node.location.x = 200 * column


def _glow(
    tree: bpy.types.NodeTree, image: bpy.types.NodeSocket, share: float, width: int
) -> bpy.types.NodeSocket:
    glare = tree.nodes.new("CompositorNodeGlare")
    glare.glare_type, glare.quality = "FOG_GLOW", "HIGH"
    glare.threshold = 0.0
    glare.size = min(max(round(math.log2(_GLOW_WIDTH * width)), 6), 9)  # of 2 to that many pixels
    glare.mix = 2.0 * share - 1.0
    tree.links.new(image, glare.inputs["Image"])
    # The node makes the whole brighter by twice the share.
    return _mixed(tree, "MULTIPLY", glare.outputs["Image"], (1.0 / (1.0 + 2.0 * share),) * 3)


def _saturate(
    tree: bpy.types.NodeTree, image: bpy.types.NodeSocket, factor: float
) -> bpy.types.NodeSocket:
    """Luminance + factor x (colour - luminance), and what is negative then is 0."""
    grey = tree.nodes.new("CompositorNodeRGBToBW")
    tree.links.new(image, grey.inputs["Image"])
    surplus = tree.nodes.new("CompositorNodeMath")
    surplus.operation = "MULTIPLY"
    surplus.inputs[1].default_value = factor - 1.0
    tree.links.new(grey.outputs["Val"], surplus.inputs[0])
    richer = _mixed(tree, "MULTIPLY", image, (factor,) * 3)
    signed = _mixed(tree, "SUBTRACT", richer, surplus.outputs["Value"])
    return _mixed(tree, "LIGHTEN", signed, (0.0, 0.0, 0.0))


def _mixed(
    tree: bpy.types.NodeTree,
    operation: str,
    image: bpy.types.NodeSocket,
    other: bpy.types.NodeSocket | tuple[float, float, float],
) -> bpy.types.NodeSocket:
    """An image and another, or a colour, by one of the operations of Blender's Mix node."""
    mix = tree.nodes.new("CompositorNodeMixRGB")
    mix.blend_type = operation
    tree.links.new(image, mix.inputs[1])
    if isinstance(other, tuple):
        mix.inputs[2].default_value = (*other, 1.0)
    else:
        tree.links.new(other, mix.inputs[2])
    return mix.outputs["Image"]
