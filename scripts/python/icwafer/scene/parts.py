# SPDX-License-Identifier: GPL-2.0-or-later
"""What the parts of dies and wafers are made of."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import bpy

from icwafer.pictures import Irregular, NodeValue
from icwafer.scene.material import chip_material

#: Polished silicon, from the index of M. A. Green (2008) at 612, 549 and 464 nm: ((n-1)/(n+1))^2.
SILICON_COLOUR = (0.353, 0.367, 0.407)
#: What lies between blocks, and the scribe lanes: etched and filled at random, so pale and matt.
GROUND_COLOUR = (0.02, 0.02, 0.022)
LANE_COLOUR = (0.25, 0.24, 0.22)
#: Where films and resist end, in steps and crumbs.
FILM_EDGE_COLOUR = (0.45, 0.47, 0.45)


@dataclass(frozen=True)
class Parts:
    """blocks: the wires; ground: what lies between blocks; lane: the scribe lanes between dies;
    film_edge: the line along which the films end; silicon: the bare rim and the back; edge: round,
    ground and etched."""

    blocks: bpy.types.Material
    ground: bpy.types.Material
    lane: bpy.types.Material
    film_edge: bpy.types.Material
    silicon: bpy.types.Material
    edge: bpy.types.Material


def parts(
    values: Mapping[str, NodeValue] | None = None, irregular: Irregular = Irregular()
) -> Parts:
    """New materials for a chip or wafer. values: of the blocks' node, see `chip_material`."""
    return Parts(
        blocks=chip_material("Chip", values, irregular.colour, irregular.roughness),
        ground=metal_material("Chip Ground", GROUND_COLOUR, 0.35),
        lane=metal_material("Scribe Lane", LANE_COLOUR, 0.45),
        film_edge=metal_material("Film Edge", FILM_EDGE_COLOUR, 0.6),
        silicon=metal_material("Polished Silicon", SILICON_COLOUR, 0.03),
        edge=metal_material("Wafer Edge", SILICON_COLOUR, 0.25),
    )


def metal_material(name: str, colour: tuple[float, ...], roughness: float) -> bpy.types.Material:
    """A plain reflecting material. colour: linear Rec.709 reflectance at normal incidence."""
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    principled = material.node_tree.nodes["Principled BSDF"]
    principled.inputs["Base Color"].default_value = (*colour, 1.0)
    principled.inputs["Metallic"].default_value = 1.0
    principled.inputs["Roughness"].default_value = roughness
    material.diffuse_color = (*colour, 1.0)
    return material
