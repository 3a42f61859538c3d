# SPDX-License-Identifier: GPL-2.0-or-later
"""Properties > Object Data > IC Attributes: what of a chip a node tree can use, and how."""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy
from bpy.props import StringProperty

from .errors import reported

if TYPE_CHECKING:
    from icwafer.attributes import Attribute


def _known() -> dict[str, Attribute]:
    from icwafer.attributes import OF_FACES, OF_INSTANCES

    return {attribute.name: attribute for attribute in (*OF_FACES, *OF_INSTANCES)}


class WM_OT_ic_attribute_copy(bpy.types.Operator):
    """Copy the name of an attribute"""

    bl_idname = "wm.ic_attribute_copy"
    bl_label = "Copy Name"
    bl_options = {"INTERNAL"}

    name: StringProperty(name="Name")

    @classmethod
    def description(
        cls, _context: bpy.types.Context, properties: bpy.types.OperatorProperties
    ) -> str:
        from icwafer.attributes import OF_INSTANCES

        attribute = _known()[properties.name]
        kind = "Instancer" if attribute in OF_INSTANCES else "Geometry"
        drives = "" if kind == "Instancer" else f". Drives {attribute.socket}"
        unit = f", in {attribute.unit}" if attribute.unit else ""
        meaning = attribute.meaning[0].upper() + attribute.meaning[1:]
        return (
            f"{meaning}{unit}{drives}.\nClick to copy the name for an Attribute node of type "
            f"{kind}"
        )

    def execute(self, context: bpy.types.Context) -> set[str]:
        context.window_manager.clipboard = self.name
        self.report({"INFO"}, f"{self.name} is on the clipboard")
        return {"FINISHED"}


class OBJECT_OT_ic_material_add(bpy.types.Operator):
    """Give the active object a new material whose IC Wafer BSDF takes its wires from here"""

    bl_idname = "object.ic_material_add"
    bl_label = "New Material from Attributes"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        thing = context.object
        return thing is not None and thing.type == "MESH" and not thing.data.library

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        from icwafer.scene.material import chip_material, expect_node

        expect_node()
        thing, material = context.object, chip_material("Chip")
        if thing.material_slots:
            thing.material_slots[thing.active_material_index].material = material
        else:
            thing.data.materials.append(material)
        return {"FINISHED"}


class DATA_PT_ic_attributes(bpy.types.Panel):
    """The attributes of a chip's faces, or of the places of dies on a wafer."""

    bl_label = "IC Attributes"
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "data"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return context.mesh is not None and any(
            attribute.name.startswith("ic_") for attribute in context.mesh.attributes
        )

    def draw(self, context: bpy.types.Context) -> None:
        column = self.layout.column(align=True)
        for attribute in _known().values():
            if attribute.name in context.mesh.attributes:
                row = column.row(align=True).split(factor=0.45, align=True)
                copy = row.operator(WM_OT_ic_attribute_copy.bl_idname, text=attribute.name)
                copy.name = attribute.name
                row.label(text=f" {attribute.meaning}")
        if context.object is not None and context.object.data == context.mesh:
            self.layout.operator(OBJECT_OT_ic_material_add.bl_idname, icon="MATERIAL")
