# SPDX-License-Identifier: GPL-2.0-or-later
"""Add > Mesh > IC Wafer."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty

from .add_die import gap_nm
from .busy import Steps, finished
from .options import ChipOptions

if TYPE_CHECKING:
    from icwafer.chips.model import DieSpec, Layout
    from icwafer.chips.wafer import Wafer


_DIAMETERS_MM = ("100", "125", "150", "200", "300")


class WaferOptions:
    """Properties of an operator that makes wafers."""

    diameter_mm: EnumProperty(
        name="Diameter",
        description="Size of the wafer, of those that SEMI M1 knows",
        items=[(size, f"{size} mm", f"A wafer of {size} mm") for size in _DIAMETERS_MM],
        default="300",
    )
    mark: EnumProperty(
        name="Mark",
        description="How its orientation is marked",
        items=[
            ("USUAL", "Usual", "As wafers of its size come: flats up to 150 mm, a notch above"),
            ("NONE", "None", "Round all the way"),
        ],
    )
    edge_exclusion_mm: FloatProperty(
        name="Edge Excl. (mm)",
        description="Edge exclusion: rim without dies, in mm",
        default=3.0,
        min=0.0,
        max=30.0,
        precision=1,
        step=10,
    )
    scribe_um: FloatProperty(
        name="Scribe Lane (µm)",
        description="Lane between dies in µm, where they are cut apart",
        default=80.0,
        min=0.0,
        max=1000.0,
        precision=0,
        step=500,
    )
    partial_dies: BoolProperty(
        name="Partial Dies", description="Also dies that the rim cuts, as many wafers have them"
    )
    test_dies: BoolProperty(
        name="Test Dies",
        description="A few places hold test chips with other colours, if the preset has some",
        default=True,
    )
    drift: FloatProperty(
        name="Drift",
        description="How much film, wires and grooves change over the wafer; 1 as usual, which "
        "shows as broad rings of colour, 0 makes all dies equal",
        default=1.0,
        min=0.0,
        max=10.0,
        soft_max=3.0,
    )
    wafer_seed: IntProperty(
        name="Wafer Seed",
        description="Start of the random differences from die to die",
        default=1,
        min=0,
        max=2**31 - 1,
    )
    viewport: EnumProperty(
        name="Viewport",
        description="What viewports show of the dies, unless they render with Cycles. Renders show "
        "all of it anyway",
        items=[
            ("PLATES", "Plates", "A plate for each die: quick on any machine"),
            ("BLOCKS", "Blocks", "All blocks of all dies, often millions: slow without a graphics "
             "card"),
        ],
    )

    def wafer_numbers_of(self, wafer: Wafer) -> dict[str, Any]:
        """The panel's numbers that a wafer says."""
        names = ("edge_exclusion_mm", "scribe_um", "partial_dies")
        return {
            "diameter_mm": str(wafer.diameter_mm),
            "mark": "NONE" if wafer.mark == "none" else "USUAL",
            "wafer_seed": wafer.seed,
            **{name: getattr(wafer, name) for name in names},
        }

    def wafer_in_steps(
        self, context: bpy.types.Context, dies: tuple[DieSpec, ...], wafer: Wafer, name: str
    ) -> Steps[None]:
        """Adds a wafer of these dies, with the panel's numbers."""
        from icwafer.chips.adjust import WaferChange, adjusted_wafer
        from icwafer.chips.die import generate, main_direction_rad
        from icwafer.scene.wafer import wafer_in_steps

        layout = adjusted_wafer(
            dies,
            wafer,
            WaferChange(
                diameter_mm=int(self.diameter_mm),
                marked=self.mark == "USUAL",
                edge_exclusion_mm=self.edge_exclusion_mm,
                scribe_um=self.scribe_um,
                partial_dies=self.partial_dies,
                test_dies=self.test_dies,
                drift=self.drift,
                seed=self.wafer_seed,
            ),
        )
        thing = yield from wafer_in_steps(
            layout,
            context.collection,
            self.parts(),
            name,
            gap_nm(dies[0]),
            plates=self.viewport == "PLATES",
        )
        self.place(context, thing, layout.wafer.diameter_mm, main_direction_rad(generate(dies[0])))

    def draw_wafer(self, layout: bpy.types.UILayout) -> None:
        """The panel's part on the wafer."""
        layout.prop(self, "diameter_mm")
        layout.prop(self, "mark")
        column = layout.column(align=True)
        column.prop(self, "edge_exclusion_mm")
        column.prop(self, "scribe_um")
        column = layout.column(align=True)
        column.prop(self, "partial_dies")
        column.prop(self, "test_dies")
        column = layout.column(align=True)
        column.prop(self, "drift")
        column.prop(self, "wafer_seed")
        layout.prop(self, "viewport")


class MESH_OT_ic_wafer_add(ChipOptions, WaferOptions, bpy.types.Operator):
    """Add a wafer full of chips, all of them copies of one die with the drift of their place"""

    bl_idname = "mesh.ic_wafer_add"
    bl_label = "IC Wafer"
    bl_options = {"REGISTER", "UNDO"}

    def add(
        self, context: bpy.types.Context, dies: tuple[DieSpec, ...], wafer: Wafer | None
    ) -> None:
        from icwafer.chips.presets.parts import drifting_wafer

        wafer = wafer or drifting_wafer()
        finished(context, self.wafer_in_steps(context, dies, wafer, "IC Wafer"))

    def numbers_of(self, preset: Layout) -> dict[str, Any]:
        from icwafer.chips.presets.parts import drifting_wafer

        return super().numbers_of(preset) | self.wafer_numbers_of(preset.wafer or drifting_wafer())

    def draw_thing(self, layout: bpy.types.UILayout) -> None:
        super().draw_thing(layout)
        self.draw_wafer(layout)
