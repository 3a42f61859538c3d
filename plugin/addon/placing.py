# SPDX-License-Identifier: GPL-2.0-or-later
"""How large a new thing is in the scene, what it is made of, and where it stands.

Meshes are in millimetres, whatever the scene's unit; the object's scale makes them as large as the
scene wants them. The colours do not depend on it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty
from bpy_extras.object_utils import AddObjectHelper, add_object_align_init, object_data_add
from mathutils import Matrix

if TYPE_CHECKING:
    from icwafer.scene.parts import Parts

NODE = "ShaderNodeBsdfICWafer"


def items_of(name: str) -> list[tuple[str, str, str]]:
    """The choices of a property of the node; only one in a Blender without it."""
    node = getattr(bpy.types, NODE, None)
    if node is None:
        return [("NONE", "None", "This Blender has no IC Wafer BSDF")]
    items = node.bl_rna.properties[name].enum_items
    return [(item.identifier, item.name, item.description) for item in items]


class PlacingOptions(AddObjectHelper):
    """Properties of an operator that adds a thing made of the node's material.

    modes: in which it can be called.
    """

    modes = frozenset({"OBJECT"})

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
    catch_light: BoolProperty(
        name="Catch the Light",
        description="Turn it about its own axis so that the colours of the brightest lamp reach "
        "the camera",
        default=True,
    )
    illuminant: EnumProperty(
        name="Illuminant",
        description="Spectrum of the lamps that light it",
        items=items_of("illuminant"),
    )

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return super().poll(context) and context.mode in cls.modes

    def node_values(self) -> dict[str, Any]:
        """Properties of the node of the materials."""
        return {"illuminant": self.illuminant}

    def parts(self) -> Parts:
        """Materials that take the wires from the attributes of the mesh; equal ones are shared."""
        from icwafer.scene.parts import Parts, parts
        from icwafer.scene.shared import shared

        made = parts(self.node_values())
        return Parts(**{part: shared(material) for part, material in vars(made).items()})

    def add_mesh(
        self, context: bpy.types.Context, mesh: bpy.types.Mesh, longest_mm: float, wires_rad: float
    ) -> None:
        """Puts a mesh where Blender's own Add operators would, and selects it.

        longest_mm: its longest side. wires_rad: direction of most of its wires. In edit mode it
        becomes a part of the mesh that is edited, at the angle that was asked for.
        """
        if context.mode == "EDIT_MESH":
            mesh.transform(Matrix.Scale(self._scale(context, longest_mm), 4))
            object_data_add(context, mesh, operator=self)
            return
        thing = object_data_add(context, mesh, operator=self)
        self._fit(context, thing, longest_mm, wires_rad)

    def place(
        self,
        context: bpy.types.Context,
        thing: bpy.types.Object,
        longest_mm: float,
        wires_rad: float,
    ) -> None:
        """The same for an object that is already in the scene."""
        for other in context.view_layer.objects:
            other.select_set(False)
        thing.matrix_world = add_object_align_init(context, self)
        self._fit(context, thing, longest_mm, wires_rad)
        view = context.space_data
        if view and view.type == "VIEW_3D" and view.local_view:
            thing.local_view_set(view, True)
        thing.select_set(True)
        context.view_layer.objects.active = thing

    def _fit(
        self,
        context: bpy.types.Context,
        thing: bpy.types.Object,
        longest_mm: float,
        wires_rad: float,
    ) -> None:
        from icwafer.scene.turn import turn_to_light_rad

        thing.scale = [self._scale(context, longest_mm)] * 3
        if self.catch_light:
            turn_rad = turn_to_light_rad(context.scene, thing, wires_rad)
            thing.rotation_euler.rotate_axis("Z", turn_rad)

    def _scale(self, context: bpy.types.Context, longest_mm: float) -> float:
        """Units of the scene for a millimetre."""
        if self.true_scale:
            return 1e-3 / context.scene.unit_settings.scale_length
        return self.size / longest_mm

    def draw(self, _context: bpy.types.Context) -> None:
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        self.draw_thing(layout)
        self.draw_place(layout)

    def draw_thing(self, layout: bpy.types.UILayout) -> None:
        """The panel's part on what is added."""
        raise NotImplementedError

    def draw_place(self, layout: bpy.types.UILayout) -> None:
        """The panel's part on light, size and place."""
        layout.prop(self, "illuminant")
        column = layout.column(align=True)
        row = column.row()
        row.active = not self.true_scale
        row.prop(self, "size")
        column.prop(self, "true_scale")
        column.prop(self, "catch_light")
        layout.prop(self, "align")
        layout.prop(self, "location")
        layout.prop(self, "rotation")
