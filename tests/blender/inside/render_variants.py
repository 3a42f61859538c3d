# SPDX-License-Identifier: GPL-2.0-or-later
"""Render the node on a plane under a lamp, once for each set of values.

Parameters: `engine`, `variants`: a list of objects with
`exr`         where the picture goes,
`inputs`      values of inputs that are not as the Add menu makes them,
`linked`      names of inputs that get their value through a link instead of the socket,
`properties`  values of properties,
and, where the usual picture will not do, `lamp`: its place, `power_w`, `size`: pixels,
`view_width`, `exact_pixels`: whether all samples lie in the middle of their pixel.
"""

from __future__ import annotations

from typing import Any

import bpy
from exchange import parameters, report
from rendering import render_to, use_cycles
from wafer_scene import add_camera, add_lamp, add_plane, empty_scene, wafer_material


def link_value(socket: bpy.types.NodeSocket, value: float | list[float]) -> None:
    """Feed a socket from a node that gives `value`."""
    tree = socket.id_data
    if socket.type == "VALUE":
        source = tree.nodes.new("ShaderNodeValue")
        source.outputs[0].default_value = value
    elif socket.type == "RGBA":
        source = tree.nodes.new("ShaderNodeRGB")
        source.outputs[0].default_value = value
    else:
        source = tree.nodes.new("ShaderNodeCombineXYZ")
        for component, number in zip(source.inputs, value, strict=True):
            component.default_value = number
    tree.links.new(source.outputs[0], socket)


def build(variant: dict[str, Any]) -> None:
    empty_scene()
    material, node = wafer_material()
    for name, value in variant.get("properties", {}).items():
        setattr(node, name, value)
    for name, value in variant.get("inputs", {}).items():
        socket = node.inputs[name]
        if name in variant.get("linked", []):
            link_value(socket, value)
        else:
            socket.default_value = value
    add_plane(material)
    add_lamp(variant.get("lamp", (0.25, -0.2, 1.0)), variant.get("power_w", 30.0))
    camera = add_camera((0.0, 0.0, 3.0))
    camera.type = "ORTHO"
    camera.ortho_scale = variant.get("view_width", 2.2)


for variant in parameters()["variants"]:
    build(variant)
    width, height = variant.get("size", (48, 48))
    use_cycles(width=width, height=height, samples=4)
    if variant.get("exact_pixels"):
        # A box filter would be a pixel wide whatever is asked for.
        bpy.context.scene.cycles.pixel_filter_type = "GAUSSIAN"
        bpy.context.scene.cycles.filter_width = 0.01
    bpy.context.scene.render.engine = parameters()["engine"]
    render_to(exr=variant["exr"])
report({})
