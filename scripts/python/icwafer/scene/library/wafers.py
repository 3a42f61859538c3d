# SPDX-License-Identifier: GPL-2.0-or-later
"""The library's wafers."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from pathlib import Path

import bpy

from icwafer.chips.die import generate, main_direction_rad
from icwafer.chips.presets import PRESETS, TITLES
from icwafer.scene.library.asset import Asset, posed, show_at, show_collection
from icwafer.scene.parts import parts
from icwafer.scene.wafer import add_wafer

#: Presets whose wafers are in the library, of 300, 300, 200 and 150 mm, and what they are called.
WAFERS = {
    "eight-core": "Processor",
    "dram": "DRAM",
    "microcontroller": "Controller",
    "test-chip": "Test Chip",
}


def assets(_sources: Path, wires_rad: float) -> Iterator[Asset]:
    """A collection for each wafer; all of them share their materials.

    wires_rad: direction of wires that catches the light in a new scene.
    """
    materials = parts()
    for preset, name in WAFERS.items():
        layout = PRESETS[preset]
        diameter_mm = layout.wafer.diameter_mm
        title = f"{diameter_mm:g} mm {name}"
        # A wafer is made in a collection; it moves from there into its own.
        workshop = bpy.data.collections.new("Workshop")
        wafer = add_wafer(layout, workshop, materials, title)
        workshop.objects.unlink(wafer)
        bpy.data.collections.remove(workshop)
        show_at(wafer, diameter_mm, main_direction_rad(generate(layout.dies[0])), wires_rad)
        collection = posed(wafer, title)
        text = f"A wafer of {diameter_mm:g} mm full of dies: {TITLES[preset][1].lower()}"
        yield Asset(collection, "Wafers", text, partial(show_collection, collection))
