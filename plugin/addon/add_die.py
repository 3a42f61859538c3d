# SPDX-License-Identifier: GPL-2.0-or-later
"""Add > Mesh > IC Die."""

from __future__ import annotations

import bpy

from .errors import reported
from .options import ChipOptions
from .placing import PlacingOptions


class MESH_OT_ic_die_add(ChipOptions, PlacingOptions, bpy.types.Operator):
    """Add a chip: blocks of wires with the colours of diffraction"""

    bl_idname = "mesh.ic_die_add"
    bl_label = "IC Die"
    bl_options = {"REGISTER", "UNDO", "PRESET"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return super().poll(context) and context.mode in {"OBJECT", "EDIT_MESH"}

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        from icwafer.chips.die import generate, main_direction_rad
        from icwafer.chips.presets import PRESETS
        from icwafer.scene.mesh import die_mesh

        self.fill_from_preset()
        spec = self.adjusted(PRESETS[self.preset].dies[0])
        die = generate(spec)
        mesh = die_mesh(die, ground=True)
        mesh.name = "IC Die"
        materials = self.parts()
        for material in (materials.blocks, materials.ground):
            mesh.materials.append(material)
        longest_mm = max(spec.width_mm, spec.height_mm)
        self.add_mesh(context, mesh, longest_mm, main_direction_rad(die))
        return {"FINISHED"}

    def draw(self, _context: bpy.types.Context) -> None:
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        self.draw_chip(layout)
        self.draw_look(layout)
        self.draw_place(layout)
        self.draw_groups(layout.column())
