# SPDX-License-Identifier: GPL-2.0-or-later
"""What the redo panels of IC Die and IC Wafer have in common: a preset, and changes of its die.

A new preset fills the panel with its numbers; a number that is changed after that stays until the
next preset. The ranges are those of `icwafer.chips.model`, written out here because that is not
imported when Blender starts.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import bpy
from bpy.props import (
    BoolProperty,
    CollectionProperty,
    EnumProperty,
    FloatProperty,
    IntProperty,
    StringProperty,
)

from .busy import all_or_nothing
from .errors import reported
from .placing import PlacingOptions, items_of

if TYPE_CHECKING:
    from icwafer.chips.model import DieSpec, Group, Layout
    from icwafer.chips.wafer import Wafer

#: More would make Blender wait: so many take about three seconds of computing.
MOST_BLOCKS = 1_000_000

#: Blender needs the texts of an enumeration's items to live as long as they are shown.
_preset_items: list[tuple[str, str, str]] = []


def preset_items(_owner: object, _context: object) -> list[tuple[str, str, str]]:
    """The presets as items of a menu."""
    if not _preset_items:
        from icwafer.chips.presets import PRESETS, TITLES

        _preset_items.extend((name, *TITLES[name]) for name in PRESETS)
    return _preset_items


def side_mm(name: str) -> FloatProperty:
    """A property for the real width or height of a die."""
    return FloatProperty(
        name=f"{name} (mm)",
        description=f"Real {name.lower()} of the die in mm: a larger one has more blocks",
        min=0.1,
        max=300.0,
        soft_min=1.0,
        soft_max=33.0,
        precision=2,
        step=10,
    )


class IC_PG_group(bpy.types.PropertyGroup):
    """Numbers of one group of blocks; its name is that of the group."""

    spacing_nm: FloatProperty(
        name="Spacing",
        description="Mean distance from wire to wire in nm. Decides where which colour goes; "
        "the wires keep their share of it",
        min=50.0,
        max=200_000.0,
        soft_min=300.0,
        soft_max=4000.0,
        precision=1,
        step=500,
    )
    deviation_nm: FloatProperty(
        name="Deviation",
        description="Standard deviation of the spacing from block to block, in nm. More makes "
        "neighbours differ in colour",
        min=0.0,
        max=50_000.0,
        soft_max=100.0,
        precision=1,
        step=50,
    )
    oxide_nm: FloatProperty(
        name="Oxide",
        description="Mean thickness of the oxide above the wires in nm. Tints everything, and "
        "differently at each angle",
        min=0.0,
        max=20_000.0,
        soft_max=2000.0,
        precision=0,
        step=500,
    )
    diffraction: FloatProperty(
        name="Strength",
        description="Share of the diffracted light that is there: 0 is dark, 1 what unbroken "
        "wires give",
        min=0.0,
        max=1.0,
        subtype="FACTOR",
    )
    turned: FloatProperty(
        name="Turned",
        description="Share of its blocks whose wires run the other way",
        min=0.0,
        max=1.0,
        subtype="FACTOR",
    )


class ChipOptions(PlacingOptions):
    """Properties of an operator that makes chips from a preset."""

    preset: EnumProperty(name="Chip", description="Kind of chip", items=preset_items)
    filled_from: StringProperty(options={"HIDDEN"})
    seed: IntProperty(
        name="Seed",
        description="Start of the random numbers: other blocks of the same kind",
        min=0,
        max=2**31 - 1,
    )
    width_mm: side_mm("Width")
    height_mm: side_mm("Height")
    block_um: FloatProperty(
        name="Block (µm)",
        description="Usual side of a block of logic in µm. Smaller ones make more blocks: four "
        "times as many at half the side",
        min=1.0,
        max=5000.0,
        soft_min=10.0,
        soft_max=500.0,
        precision=1,
        step=100,
    )
    metal: EnumProperty(
        name="Metal",
        description="What the wires are made of",
        items=items_of("metal"),
    )
    groups: CollectionProperty(type=IC_PG_group)
    show_groups: BoolProperty(
        name="Groups", description="Show the wires of each group of blocks", default=False
    )

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        from icwafer.chips.presets import PRESETS

        self.fill_from_preset()
        preset = PRESETS[self.preset]
        with all_or_nothing():
            dies = (self.adjusted(preset.dies[0]), *preset.dies[1:])
            self.add(context, dies, preset.wafer)
        return {"FINISHED"}

    def add(
        self, context: bpy.types.Context, dies: tuple[DieSpec, ...], wafer: Wafer | None
    ) -> None:
        """Adds what the operator is for. dies, wafer: of the preset, with the panel's numbers."""
        raise NotImplementedError

    def fill_from_preset(self) -> None:
        """Takes the numbers of a new preset; from a script's first call only what it left out."""
        if self.filled_from == self.preset:
            return
        from icwafer.chips.presets import PRESETS

        preset = PRESETS[self.preset]
        for name, value in self.numbers_of(preset).items():
            if self.filled_from or not self.properties.is_property_set(name):
                setattr(self, name, value)
        if self.filled_from or not self.groups:
            self.groups.clear()
            for group in _main_groups(preset.dies[0]):
                _show(self.groups.add(), group)
        self.filled_from = self.preset

    def numbers_of(self, preset: Layout) -> dict[str, Any]:
        """The panel's numbers that a preset says, but for the groups."""
        names = ("seed", "width_mm", "height_mm", "block_um")
        return {name: getattr(preset.dies[0], name) for name in names}

    def node_values(self) -> dict[str, Any]:
        return super().node_values() | {"metal": self.metal}

    def adjusted(self, spec: DieSpec) -> DieSpec:
        """The die of the preset with the panel's numbers."""
        from icwafer.chips.adjust import GroupChange, adjusted_die

        return adjusted_die(
            spec,
            seed=self.seed,
            width_mm=self.width_mm,
            height_mm=self.height_mm,
            block_um=self.block_um,
            groups=[
                GroupChange(
                    item.name,
                    item.spacing_nm,
                    item.deviation_nm,
                    item.oxide_nm,
                    item.diffraction,
                    item.turned,
                )
                for item in self.groups
            ],
            most_blocks=MOST_BLOCKS,
        )

    def draw(self, context: bpy.types.Context) -> None:
        super().draw(context)
        self.draw_groups(self.layout.column())

    def draw_thing(self, layout: bpy.types.UILayout) -> None:
        layout.prop(self, "preset")
        layout.prop(self, "seed")
        column = layout.column(align=True)
        column.prop(self, "width_mm")
        column.prop(self, "height_mm")
        layout.prop(self, "block_um")
        layout.prop(self, "metal")

    def draw_groups(self, layout: bpy.types.UILayout) -> None:
        """The panel's part on the groups, folded or not."""
        layout.use_property_split = False
        icon = "TRIA_DOWN" if self.show_groups else "TRIA_RIGHT"
        row = layout.row()
        row.alignment = "LEFT"
        row.prop(self, "show_groups", icon=icon, emboss=False)
        if not self.show_groups:
            return
        for group in self.groups:
            column = layout.column(align=True)
            column.label(text=group.name.capitalize())
            row = column.row(align=True)
            row.prop(group, "spacing_nm")
            row.prop(group, "deviation_nm")
            row = column.row(align=True)
            row.prop(group, "oxide_nm")
            row.prop(group, "diffraction")
            row.prop(group, "turned")


def _main_groups(spec: DieSpec) -> list[Group]:
    """Those with wires worth a setting."""
    from icwafer.chips.model import Kind

    return [group for group in spec.groups if group.kind not in (Kind.STRIP, Kind.SEAL)]


def _show(item: IC_PG_group, group: Group) -> None:
    from icwafer.chips.adjust import GroupChange

    for name, value in vars(GroupChange.none(group)).items():
        setattr(item, name, value)
