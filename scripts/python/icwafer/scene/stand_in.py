# SPDX-License-Identifier: GPL-2.0-or-later
"""What viewports show in place of a wafer's dies: millions of blocks take them seconds to draw.

It is a disc with a plate for each die, in front of the dies, whose own outlines it hides. Renders
do not show it, and Cycles does not in the viewport either, where all blocks are seen.
"""

from __future__ import annotations

import bpy
import numpy as np

from icwafer.chips.outline import edge_profile_mm, outline_mm
from icwafer.chips.wafer import Wafer
from icwafer.scene.mesh import SOCKET_OF_ATTRIBUTE
from icwafer.scene.parts import Parts
from icwafer.scene.polygons import add_face_attributes, at_height, loose_faces, polygon_mesh

#: How far disc and plates are in front of the dies, in shares of the diameter: enough for the depth
#: buffer of a view of the whole wafer.
DISC, PLATES = 0.006, 0.007
_RAYS = ("camera", "diffuse", "glossy", "transmission", "volume_scatter", "shadow")


def stand_in(
    name: str, wafer: Wafer, plates: list[np.ndarray], die: bpy.types.Mesh, parts: Parts
) -> bpy.types.Object:
    """An object for a wafer's modifier, not in a collection.

    plates: (k, 2) each, in mm from the wafer's centre. die: gives the plates its mean attributes.
    """
    rim = outline_mm(wafer, edge_profile_mm(wafer)[0][0])
    mesh = polygon_mesh(
        name,
        np.concatenate(
            [
                at_height([rim], DISC * wafer.diameter_mm),
                at_height(plates, PLATES * wafer.diameter_mm),
            ]
        ),
        loose_faces([rim, *plates]),
    )
    is_plate = np.arange(1 + len(plates)) > 0
    mesh.polygons.foreach_set("material_index", is_plate.astype(np.int32))
    for material in (parts.silicon, parts.blocks):
        mesh.materials.append(material)
    means = {}
    for attribute in [name for name in SOCKET_OF_ATTRIBUTE if name in die.attributes]:
        values = np.empty(len(die.polygons), dtype=np.float32)
        die.attributes[attribute].data.foreach_get("value", values)
        # The last face is the ground, which has no wires.
        means[attribute] = np.where(is_plate, values[:-1].mean(), 0.0)
    add_face_attributes(mesh, means)
    thing = bpy.data.objects.new(name, mesh)
    thing.hide_render = True
    for ray in _RAYS:
        setattr(thing, f"visible_{ray}", False)
    return thing
