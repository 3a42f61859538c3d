# SPDX-License-Identifier: GPL-2.0-or-later
"""The wires of a real chip as a mesh of solids."""

from __future__ import annotations

import bpy
import numpy as np

from icwafer.portrait.wires import Wires
from icwafer.scene.mesh import SOCKET_OF_ATTRIBUTE
from icwafer.scene.polygons import add_attribute, polygon_mesh


def wires_mesh(wires: Wires) -> bpy.types.Mesh:
    """A solid for each wire, in mm; its top carries the attributes and the material of index 0, its
    sides have the one of index 1."""
    count = len(wires.corners_um)
    rings = np.zeros((2, count, 4, 3))
    rings[..., :2] = wires.corners_um[:, ::-1]
    rings[0, ..., 2], rings[1, ..., 2] = wires.top_um[:, None], wires.bottom_um[:, None]
    top = np.arange(4 * count).reshape(-1, 4)
    bottom, following = top + 4 * count, np.roll(top, -1, axis=1)
    sides = np.stack([top, bottom, np.roll(bottom, -1, axis=1), following], axis=2)
    mesh = polygon_mesh("Wires", rings.reshape(-1, 3) / 1000, [top, sides.reshape(-1, 4)])
    is_side = np.arange(5 * count) >= count
    mesh.polygons.foreach_set("material_index", is_side.astype(np.int32))
    for name in SOCKET_OF_ATTRIBUTE:
        values = np.zeros(5 * count, dtype=np.float32)
        values[:count] = wires.attributes.get(name.removeprefix("ic_"), 0.0)
        add_attribute(mesh, name, "FACE", values)
    return mesh
