# SPDX-License-Identifier: GPL-2.0-or-later
"""How large a new thing is in the scene, what it is made of, and where it stands.

Meshes are in millimetres, whatever the scene's unit; the object's scale makes them as large as the
scene wants them. The colours do not depend on it.
"""

from __future__ import annotations

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty
from bpy_extras.object_utils import AddObjectHelper, object_data_add
from mathutils import Matrix

NODE = "ShaderNodeBsdfICWafer"


def _items_of(name: str) -> list[tuple[str, str, str]]:
    """The choices of a property of the node; none in a Blender without it."""
    node = getattr(bpy.types, NODE, None)
    if node is None:
        return [("NONE", "None", "This Blender has no IC Wafer BSDF")]
    items = node.bl_rna.properties[name].enum_items
    return [(item.identifier, item.name, item.description) for item in items]


class PlacingOptions(AddObjectHelper):
    """Properties of an operator that adds a thing with the node's material."""

    size: FloatProperty(
        name="Size",
        description="Longest side in the scene. The colours do not depend on it",
        default=2.0,
        min=1e-4,
        max=1e5,
        soft_min=0.1,
        soft_max=20.0,
        unit="LENGTH",
    )
    true_scale: BoolProperty(
        name="True Scale",
        description="As large as in reality, by the scene's unit of length, instead of Size",
    )
    model: EnumProperty(name="Model", items=_items_of("model"), default=_items_of("model")[0][0])
    metal: EnumProperty(
        name="Metal",
        description="What the wires are made of",
        items=_items_of("metal"),
    )
    illuminant: EnumProperty(
        name="Illuminant",
        description="Spectrum of the lamps that light it",
        items=_items_of("illuminant"),
    )

    def material(self, name: str) -> bpy.types.Material:
        """A new material that takes its wires from the attributes of the mesh."""
        from icwafer.scene.material import wafer_material

        values = {"model": self.model}
        if self.model == "PHYSICAL":
            values |= {"metal": self.metal, "illuminant": self.illuminant}
        material = wafer_material(values)
        material.name = name
        return material

    def scale_for(self, context: bpy.types.Context, longest_mm: float) -> float:
        """Units of the scene for a millimetre."""
        if self.true_scale:
            return 1e-3 / context.scene.unit_settings.scale_length
        return self.size / longest_mm

    def add(
        self, context: bpy.types.Context, mesh: bpy.types.Mesh, scale: float
    ) -> bpy.types.Object | None:
        """Puts a mesh where Blender's own Add operators would, and selects it.

        In edit mode it becomes a part of the mesh that is edited; then there is no new object.
        """
        if context.mode == "EDIT_MESH":
            mesh.transform(Matrix.Scale(scale, 4))
            object_data_add(context, mesh, operator=self)
            return None
        thing = object_data_add(context, mesh, operator=self)
        thing.scale = (scale, scale, scale)
        return thing

    def draw_look(self, layout: bpy.types.UILayout) -> None:
        """The panel's part on the material."""
        layout.prop(self, "model")
        if self.model == "PHYSICAL":
            layout.prop(self, "metal")
            layout.prop(self, "illuminant")

    def draw_place(self, layout: bpy.types.UILayout) -> None:
        """The panel's part on size and place."""
        column = layout.column(align=True)
        row = column.row()
        row.active = not self.true_scale
        row.prop(self, "size")
        column.prop(self, "true_scale")
        layout.prop(self, "align")
        layout.prop(self, "location")
        layout.prop(self, "rotation")
