# SPDX-License-Identifier: GPL-2.0-or-later
"""Takes presets for an object as the menu in the material's properties does.

Parameters: `presets`, their names. The report has after each preset the node's values; and what happens to a
material with other nodes, to one with links, and to an object without a material.
"""

from __future__ import annotations

from typing import Any

import bpy
from exchange import parameters, report
from wafer_scene import NODE


def cube() -> bpy.types.Object:
    return bpy.data.objects["Cube"]


def node() -> bpy.types.Node:
    """The IC Wafer BSDF of the cube's material."""
    return next(n for n in cube().active_material.node_tree.nodes if n.bl_idname == NODE)


def values(wafer: bpy.types.Node) -> dict[str, Any]:
    names = ("model", "metal", "oxide", "illuminant")
    found: dict[str, Any] = {name: getattr(wafer, name) for name in names}
    for socket in wafer.inputs:
        if socket.type == "VALUE":
            found[socket.name] = socket.default_value
    return found


def take(preset: str) -> None:
    bpy.ops.material.ic_wafer_preset(preset=preset)


def main() -> None:
    facts: dict[str, Any] = {"values": {}}
    before = {n.name for n in cube().active_material.node_tree.nodes}
    take("SRAM Cells")
    facts["nodes kept"] = before <= {n.name for n in cube().active_material.node_tree.nodes}
    output = cube().active_material.node_tree.get_output_node("CYCLES")
    facts["surface"] = output.inputs["Surface"].links[0].from_node.bl_idname
    for preset in parameters()["presets"]:
        take(preset)
        facts["values"][preset] = values(node())

    cube().data.materials.clear()
    take("Compact Disc")
    facts["new material"] = cube().active_material.name
    round_tracks = [bool(node().inputs["Tangent"].links)]
    for preset in ("Copper", "SRAM Cells"):
        take(preset)
        round_tracks.append(bool(node().inputs["Tangent"].links))
    facts["round tracks"] = round_tracks

    tree = cube().active_material.node_tree
    driver = tree.nodes.new("ShaderNodeValue")
    for socket in ("Wire Spacing", "Direction"):
        tree.links.new(driver.outputs[0], node().inputs[socket])
    take("Copper")
    facts["links after a metal"] = bool(node().inputs["Wire Spacing"].links)
    take("DRAM Cells")
    facts["links after wires"] = [
        bool(node().inputs[socket].links) for socket in ("Wire Spacing", "Direction")
    ]
    report(facts)


main()
