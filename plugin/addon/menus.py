# SPDX-License-Identifier: GPL-2.0-or-later
"""Where the operators stand in Blender's menus."""

from __future__ import annotations

import bpy


def _draw_add(self: bpy.types.Menu, context: bpy.types.Context) -> None:
    self.layout.separator()
    self.layout.operator("mesh.ic_die_add", icon="MESH_GRID")
    if context.mode == "OBJECT":
        self.layout.operator("mesh.ic_wafer_add", icon="MESH_CIRCLE")


def _draw_import(self: bpy.types.Menu, _context: bpy.types.Context) -> None:
    self.layout.operator(
        "import_scene.ic_chip", text="Chip Layout (.gds/.oas/.def/.layout.toml)"
    )


def register() -> None:
    bpy.types.VIEW3D_MT_mesh_add.append(_draw_add)
    bpy.types.TOPBAR_MT_file_import.append(_draw_import)


def unregister() -> None:
    bpy.types.TOPBAR_MT_file_import.remove(_draw_import)
    bpy.types.VIEW3D_MT_mesh_add.remove(_draw_add)
