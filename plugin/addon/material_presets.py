# SPDX-License-Identifier: GPL-2.0-or-later
"""Material presets, by process and by metal: Properties > Material > IC Wafer, and the menu of the
material slots.

They are the materials of the asset library; one table is the source of both.
"""

from __future__ import annotations

import functools
from itertools import groupby
from typing import TYPE_CHECKING

import bpy
from bpy.props import EnumProperty

from . import asset_library
from .errors import reported

if TYPE_CHECKING:
    from icwafer.assets.materials import MaterialPreset


@functools.cache
def _presets() -> dict[str, MaterialPreset]:
    """The presets by name. Raises IcwaferError where their table is missing or damaged."""
    from icwafer.assets.materials import FILE_NAME, read_materials

    return {preset.name: preset for preset in read_materials(asset_library.folder() / FILE_NAME)}


@functools.cache
def _items() -> list[tuple[str, str, str]]:
    """Kept, because Blender needs the texts as long as it shows them."""
    return [(name, name, preset.description) for name, preset in _presets().items()]


def _preset_items(_owner: object, _context: object) -> list[tuple[str, str, str]]:
    return _items()


class MATERIAL_OT_ic_wafer_preset(bpy.types.Operator):
    """Set the IC Wafer BSDF of the active material, wherever it is used; or make a new one"""

    bl_idname = "material.ic_wafer_preset"
    bl_label = "IC Wafer Preset"
    bl_options = {"REGISTER", "UNDO"}

    preset: EnumProperty(name="Preset", description="Material to take over", items=_preset_items)

    @classmethod
    def description(
        cls, _context: bpy.types.Context, properties: MATERIAL_OT_ic_wafer_preset
    ) -> str:
        preset = _presets().get(properties.preset)
        return f"{preset.description}.\n\nSource: {preset.source}" if preset else cls.__doc__

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        thing = context.object
        return bool(thing and hasattr(thing.data, "materials") and thing.data.library is None)

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        from icwafer.scene.presets import apply_preset, preset_material

        preset, thing = _presets()[self.preset], context.object
        material = thing.active_material
        if material is None or preset.from_attributes:
            thing.active_material = preset_material(preset)
        elif material.library:
            self.report({"ERROR"}, f"{material.name} is linked from another file: append it")
            return {"CANCELLED"}
        else:
            apply_preset(material, preset)
        return {"FINISHED"}


class MATERIAL_MT_ic_wafer_presets(bpy.types.Menu):
    """Materials of chips, by kind, metal and process"""

    bl_label = "IC Wafer Presets"

    def draw(self, _context: bpy.types.Context) -> None:
        if not asset_library.folder().is_dir():
            self.layout.label(text=f"{asset_library.folder()} is missing: install Blender again")
            return
        columns = self.layout.row()
        for _, kind in groupby(_presets().values(), lambda preset: preset.catalog.split("/")[1]):
            column = columns.column()
            for number, (catalog, presets) in enumerate(groupby(kind, lambda p: p.catalog)):
                if number:
                    column.label()
                column.label(text=catalog.rpartition("/")[2])
                column.separator()
                for preset in presets:
                    operator = MATERIAL_OT_ic_wafer_preset.bl_idname
                    column.operator(operator, text=preset.name).preset = preset.name


class MATERIAL_PT_ic_wafer(bpy.types.Panel):
    bl_label = "IC Wafer"
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "material"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return MATERIAL_OT_ic_wafer_preset.poll(context)

    def draw(self, _context: bpy.types.Context) -> None:
        self.layout.menu(MATERIAL_MT_ic_wafer_presets.__name__, text="Presets", icon="PRESET")


def _draw_entry(self: bpy.types.Menu, _context: bpy.types.Context) -> None:
    self.layout.separator()
    self.layout.menu(MATERIAL_MT_ic_wafer_presets.__name__, icon="PRESET")


def register() -> None:
    bpy.types.MATERIAL_MT_context_menu.append(_draw_entry)


def unregister() -> None:
    bpy.types.MATERIAL_MT_context_menu.remove(_draw_entry)


CLASSES = (MATERIAL_OT_ic_wafer_preset, MATERIAL_MT_ic_wafer_presets, MATERIAL_PT_ic_wafer)
