# SPDX-License-Identifier: GPL-2.0-or-later
"""Add > Mesh > IC Die."""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy

from .options import ChipOptions
from .placing import PlacingOptions

if TYPE_CHECKING:
    from icwafer.chips.model import DieSpec
    from icwafer.chips.wafer import Wafer
    from icwafer.portrait.wires import Wires


def gap_nm(spec: DieSpec) -> float:
    """The dark line between blocks; of blocks that are listed it is known where they end."""
    from icwafer.scene.mesh import GAP_NM

    return GAP_NM if spec.blocks is None else 0.0


def add_die(
    operator: PlacingOptions, context: bpy.types.Context, spec: DieSpec, name: str
) -> None:
    """Adds a chip, made of the operator's materials and placed by its options."""
    from icwafer.chips.die import generate, main_direction_rad
    from icwafer.scene.mesh import die_mesh

    die = generate(spec)
    mesh = die_mesh(die, gap_nm(spec), ground=True)
    mesh.name = name
    materials = operator.parts()
    for material in (materials.blocks, materials.ground):
        mesh.materials.append(material)
    longest_mm = max(spec.width_mm, spec.height_mm)
    operator.add_mesh(context, mesh, longest_mm, main_direction_rad(die))


def add_wires(
    operator: PlacingOptions, context: bpy.types.Context, spec: DieSpec, wires: Wires, name: str
) -> None:
    """Adds a chip with each of its wires. spec: the same chip as blocks."""
    from icwafer.chips.die import generate, main_direction_rad
    from icwafer.scene.material import chip_material
    from icwafer.scene.parts import metal_material
    from icwafer.scene.portrait import SIDE_COLOUR, WIRE_COLOUR, WIRE_ROUGHNESS
    from icwafer.scene.shared import shared
    from icwafer.scene.wires import wires_mesh

    mesh = wires_mesh(wires)
    mesh.name = name
    values = operator.node_values()
    mesh.materials.append(shared(chip_material("Wires", values, WIRE_COLOUR, WIRE_ROUGHNESS)))
    mesh.materials.append(shared(metal_material("Wire Sides", SIDE_COLOUR, WIRE_ROUGHNESS)))
    longest_mm = max(spec.width_mm, spec.height_mm)
    operator.add_mesh(context, mesh, longest_mm, main_direction_rad(generate(spec)))


class MESH_OT_ic_die_add(ChipOptions, bpy.types.Operator):
    """Add a chip: blocks of wires with the colours of diffraction"""

    bl_idname = "mesh.ic_die_add"
    bl_label = "IC Die"
    bl_options = {"REGISTER", "UNDO"}

    modes = frozenset({"OBJECT", "EDIT_MESH"})

    def add(
        self, context: bpy.types.Context, dies: tuple[DieSpec, ...], _wafer: Wafer | None
    ) -> None:
        add_die(self, context, dies[0], "IC Die")
