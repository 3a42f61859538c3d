# SPDX-License-Identifier: GPL-2.0-or-later
"""Dies as meshes, with the attributes of their wires."""

from __future__ import annotations

import bpy
import numpy as np

from icwafer.chips.model import MM, UM, Die

GAP_NM = 8 * UM  # the dark line between two blocks: one pixel in a picture of a whole die

# The face attributes that a die's mesh carries, and the sockets that each one drives.
SOCKET_OF_ATTRIBUTE = {
    "ic_spacing_nm": "Wire Spacing",
    "ic_width_nm": "Wire Width",
    "ic_oxide_nm": "Oxide Thickness",
    "ic_direction_rad": "Direction",
    "ic_diffraction": "Diffraction",
    "ic_spacing_variation": "Spacing Variation",
    "ic_cross_spacing_nm": "Cross Spacing",
    "ic_cross_width_nm": "Cross Width",
    "ic_groove_nm": "Groove Depth",
}


def die_mesh(die: Die) -> bpy.types.Mesh:
    """One face per block in the plane z = 0, in mm around the origin; attributes hold the wires.

    The faces leave gaps between them, at most a fifth of a block on each side.
    """
    rect_nm = die.rect_nm.astype(np.float64)
    sides_nm = rect_nm[:, 2:] - rect_nm[:, :2]
    inset_nm = np.minimum(GAP_NM / 2, 0.2 * sides_nm)
    centre_mm = np.array([die.spec.width_mm, die.spec.height_mm]) / 2
    low = (rect_nm[:, :2] + inset_nm) / MM - centre_mm
    high = (rect_nm[:, 2:] - inset_nm) / MM - centre_mm

    corners = np.zeros((len(die), 4, 3), dtype=np.float32)
    corners[:, [0, 3], 0], corners[:, [1, 2], 0] = low[:, :1], high[:, :1]
    corners[:, [0, 1], 1], corners[:, [2, 3], 1] = low[:, 1:], high[:, 1:]

    mesh = bpy.data.meshes.new("Die")
    mesh.vertices.add(4 * len(die))
    mesh.vertices.foreach_set("co", corners.ravel())
    mesh.loops.add(4 * len(die))
    mesh.loops.foreach_set("vertex_index", np.arange(4 * len(die), dtype=np.int32))
    mesh.polygons.add(len(die))
    mesh.polygons.foreach_set("loop_start", np.arange(0, 4 * len(die), 4, dtype=np.int32))
    mesh.polygons.foreach_set("loop_total", np.full(len(die), 4, dtype=np.int32))
    mesh.update(calc_edges=True)
    for name in SOCKET_OF_ATTRIBUTE:
        values = getattr(die, name.removeprefix("ic_"))
        mesh.attributes.new(name, "FLOAT", "FACE").data.foreach_set("value", values)
    return mesh
