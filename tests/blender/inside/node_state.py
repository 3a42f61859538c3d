# SPDX-License-Identifier: GPL-2.0-or-later
"""All that a node knows, as plain data, to be compared before and after."""

from __future__ import annotations

from typing import Any

import bpy


def socket_value(socket: bpy.types.NodeSocket) -> float | list[float]:
    value = socket.default_value
    return value if isinstance(value, float) else list(value)


def node_state(node: bpy.types.ShaderNode) -> dict[str, Any]:
    """Values of the inputs and properties, and where links come from.

    In a Blender that does not know the node, the properties are missing and the rest is there.
    """
    return {
        "inputs": {s.name: socket_value(s) for s in node.inputs if not s.is_unavailable},
        "links": {s.name: s.links[0].from_node.bl_idname for s in node.inputs if s.is_linked},
        "outputs": [link.to_node.bl_idname for s in node.outputs for link in s.links],
        "properties": {
            name: getattr(node, name)
            for name in (
                "model", "metal", "oxide", "illuminant",
                "use_wire_diffraction", "use_grating", "use_thin_film",
            )
            if hasattr(node, name)
        },
    }
