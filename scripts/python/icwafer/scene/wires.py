# SPDX-License-Identifier: GPL-2.0-or-later
"""The wires of a real chip as a mesh of solids."""

from __future__ import annotations

import bpy
import numpy as np

from icwafer.portrait.wires import Wires
from icwafer.scene.polygons import add_face_attributes, polygon_mesh

#: Of more wires nobody sees the sides: a picture is some 2000 pixels wide.
MOST_SIDES = 600_000


def wires_mesh(wires: Wires) -> bpy.types.Mesh:
    """A solid for each wire, in mm; of more than `MOST_SIDES` only the tops.

    The top carries the attributes and has the material of index 0, the sides the one of index 1.
    """
    count = len(wires.corners_um)
    heights = [wires.top_um, wires.bottom_um][: 2 if count <= MOST_SIDES else 1]
    rings = np.zeros((len(heights), count, 4, 3))
    rings[..., :2] = wires.corners_um[:, ::-1]
    rings[..., 2] = np.stack(heights)[..., None]
    top = np.arange(4 * count).reshape(-1, 4)
    polygons = [top]
    if len(heights) == 2:
        bottom, following = top + 4 * count, np.roll(top, -1, axis=1)
        sides = np.stack([top, bottom, np.roll(bottom, -1, axis=1), following], axis=2)
        polygons.append(sides.reshape(-1, 4))
    mesh = polygon_mesh("Wires", rings.reshape(-1, 3) / 1000, polygons)
    is_side = np.arange(len(mesh.polygons)) >= count
    mesh.polygons.foreach_set("material_index", is_side.astype(np.int32))
    of_sides = np.zeros(len(is_side) - count, dtype=np.float32)
    add_face_attributes(
        mesh,
        {
            f"ic_{name}": np.r_[of_tops.astype(np.float32), of_sides]
            for name, of_tops in wires.attributes.items()
        },
    )
    return mesh
