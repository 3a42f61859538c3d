# SPDX-License-Identifier: GPL-2.0-or-later
"""Materials that are made again and again: equal ones are one."""

from __future__ import annotations

from typing import Any

import bpy

_PLAIN = {"BOOLEAN", "INT", "FLOAT", "STRING", "ENUM"}
_OF_EDITORS = {"name", "location", "select", "tag", "use_fake_user"}


def shared(material: bpy.types.Material) -> bpy.types.Material:
    """A material of the file that is equal to a new one, which is removed; else the new one.

    Equal is what has the same nodes with the same values and links, so one that was changed by hand
    since it was made stays as it is, and alone. Only materials of the same name, or with a number
    added to it, are looked at.
    """
    content = _content(material)
    for other in bpy.data.materials:
        if other == material or other.name.partition(".")[0] != material.name.partition(".")[0]:
            continue
        if _is_plain(other) and _content(other) == content:
            bpy.data.materials.remove(material)
            return other
    return material


def _is_plain(material: bpy.types.Material) -> bool:
    """Whether nothing but its nodes decides how it looks, and it belongs to this file."""
    if material.library or not material.use_nodes:
        return False
    return not material.animation_data and not material.node_tree.animation_data


def _content(material: bpy.types.Material) -> list[Any]:
    """All that decides how a material looks, in a form that can be compared."""
    tree = material.node_tree
    links = sorted(
        (
            link.from_node.name,
            link.from_socket.identifier,
            link.to_node.name,
            link.to_socket.identifier,
        )
        for link in tree.links
    )
    nodes = [
        (_values(node), [_values(socket) for socket in node.inputs])
        for node in sorted(tree.nodes, key=lambda node: node.name)
    ]
    return [_values(material), _values(material.cycles), nodes, links]


def _values(owner: bpy.types.bpy_struct) -> dict[str, Any]:
    """Its plain properties by name, but for those that only the editor uses."""
    values = {}
    for prop in owner.bl_rna.properties:
        if prop.type not in _PLAIN or prop.is_readonly or prop.identifier in _OF_EDITORS:
            continue
        value = getattr(owner, prop.identifier)
        values[prop.identifier] = tuple(value) if getattr(prop, "is_array", False) else value
    return values

