# SPDX-License-Identifier: GPL-2.0-or-later
"""Add > Mesh > IC Die."""

from __future__ import annotations

import bpy

from . import options
from .errors import reported
from .placing import PlacingOptions


class MESH_OT_ic_die_add(options.ChipOptions, PlacingOptions, bpy.types.Operator):
    """Add a chip: blocks of wires with the colours of diffraction"""

    bl_idname = "mesh.ic_die_add"
    bl_label = "IC Die"
    bl_options = {"REGISTER", "UNDO", "PRESET"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return super().poll(context) and context.mode in {"OBJECT", "EDIT_MESH"}

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        from icwafer.chips.die import generate
        from icwafer.chips.presets import PRESETS
        from icwafer.scene.mesh import die_mesh

        self.fill_from_preset()
        spec = self.adjusted(PRESETS[self.preset].dies[0])
        mesh = die_mesh(generate(spec))
        mesh.name = "IC Die"
        mesh.materials.append(self.material("IC Die"))
        self.add(context, mesh, self.scale_for(context, max(spec.width_mm, spec.height_mm)))
        return {"FINISHED"}

    def draw(self, _context: bpy.types.Context) -> None:
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        self.draw_chip(layout)
        self.draw_look(layout)
        self.draw_place(layout)
        self.draw_groups(layout.column())


def _draw_entry(self: bpy.types.Menu, _context: bpy.types.Context) -> None:
    self.layout.separator()
    self.layout.operator(MESH_OT_ic_die_add.bl_idname, icon="MESH_GRID")


def register() -> None:
    options.register()
    bpy.utils.register_class(MESH_OT_ic_die_add)
    bpy.types.VIEW3D_MT_mesh_add.append(_draw_entry)


def unregister() -> None:
    bpy.types.VIEW3D_MT_mesh_add.remove(_draw_entry)
    bpy.utils.unregister_class(MESH_OT_ic_die_add)
    options.unregister()
