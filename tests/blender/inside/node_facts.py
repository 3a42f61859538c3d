# SPDX-License-Identifier: GPL-2.0-or-later
"""Report what an artist finds: the node's class, sockets, properties, menu entry and help page."""

from __future__ import annotations

from typing import Any

import bpy
import nodeitems_builtins
from bl_operators.wm import WM_OT_doc_view_manual
from exchange import report
from node_state import socket_value
from wafer_scene import NODE, wafer_material


def describe_socket(socket: bpy.types.NodeSocket) -> dict[str, Any]:
    return {"name": socket.name, "type": socket.type, "default": socket_value(socket)}


def describe_property(prop: bpy.types.Property) -> dict[str, Any]:
    facts = {"type": prop.type, "name": prop.name, "tooltip": prop.description}
    if prop.type == "ENUM":
        facts["items"] = {item.identifier: item.description for item in prop.enum_items}
    return facts


def menu_entries() -> list[tuple[str, str]]:
    """Category and label of each entry of the shader editor's Add menu that makes the node."""
    return [
        (category.name, item.label)
        for category in nodeitems_builtins.shader_node_categories
        for item in category.items(None)
        if getattr(item, "nodetype", "") == NODE
    ]


def inputs_of(**properties: str) -> list[dict[str, Any]]:
    """The inputs that a node with these properties shows."""
    _, node = wafer_material()
    for name, value in properties.items():
        setattr(node, name, value)
    return [describe_socket(s) for s in node.inputs if s.enabled and not s.is_unavailable]


_, node = wafer_material()
own = set(type(node).bl_rna.properties.keys()) - set(bpy.types.ShaderNode.bl_rna.properties.keys())
report(
    {
        "label": node.bl_label,
        "name": node.name,
        "description": type(node).bl_rna.description,
        "inputs": {
            "CS348B": inputs_of(model="CS348B"),
            "PHYSICAL": inputs_of(model="PHYSICAL", metal="CUSTOM", oxide="CUSTOM"),
        },
        "inputs at first": [s["name"] for s in inputs_of()],
        "outputs": [(s.name, s.type) for s in node.outputs],
        "properties": {
            name: describe_property(type(node).bl_rna.properties[name]) for name in own
        },
        "values": {name: getattr(node, name) for name in own},
        "menu": menu_entries(),
        "help": WM_OT_doc_view_manual._lookup_rna_url(f"bpy.types.{NODE}.{next(iter(own))}"),
    }
)
