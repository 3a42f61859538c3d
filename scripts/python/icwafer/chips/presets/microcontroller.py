# SPDX-License-Identifier: GPL-2.0-or-later
"""A small microcontroller in SkyWater's open 130 nm process.

As large as the user's area of the Caravel frame (2.92 x 3.52 mm) in which most chips of that
process are made; flash memory and RAM take about half of it, as in most such chips.
"""

from __future__ import annotations

from icwafer.chips.model import DieSpec, Kind, Layout
from icwafer.chips.presets.metals import (
    SKY130_MET3,
    SKY130_MET4,
    SKY130_MET5,
    SKY130_ROW,
    SKY130_SRAM,
)
from icwafer.chips.presets.parts import (
    STRIP,
    chip,
    dark_groups,
    drifting_wafer,
    group,
)
from icwafer.chips.tree import Cut, Macro, Part, Region, Ring, Slices, Tiles

_LOGIC = Region(420.0, ((Kind.LOGIC, 1.0),))
_FLASH = Cut(
    1,
    (
        Part(Tiles(Macro(Kind.MEMORY, "flash"), columns=2, rows=2, mirror="xy"), 0.85),
        Part(Macro(Kind.ANALOG), 0.15),
    ),
)
_RAM = Tiles(Macro(Kind.MEMORY, "memory"), columns=2, rows=2, mirror="xy")


def _apart(*parts: Part) -> Slices:
    """Units with a gap around each."""
    return Slices(tuple(Part(Ring(8.0, STRIP, part.node), part.share) for part in parts))


TREE = chip(
    _apart(
        Part(_FLASH, (0.24, 0.30)),
        Part(_RAM, (0.18, 0.24)),
        Part(_LOGIC, (0.20, 0.28)),
        Part(Region(240.0, ((Kind.LOGIC, 0.8), (Kind.MEMORY, 0.2))), (0.14, 0.20)),
        Part(Region(220.0, ((Kind.ANALOG, 1.0),)), (0.08, 0.12)),
        Part(Macro(Kind.FILL), (0.02, 0.04)),
    ),
    pad_um=75.0,
)

LAYOUT = Layout(
    dies=(
        DieSpec(
            name="microcontroller",
            floorplan="microcontroller",
            seed=2,
            width_mm=2.92,
            height_mm=3.52,
            block_um=32.0,
            groups=(
                group("logic", Kind.LOGIC, SKY130_MET4, weight=3.0, across=SKY130_ROW),
                group("dense logic", Kind.LOGIC, SKY130_MET3, turned=1.0, diffraction=0.4),
                group("memory", Kind.MEMORY, SKY130_SRAM, variation=0.001, diffraction=0.6),
                group("flash", Kind.MEMORY, SKY130_MET3, variation=0.001, weight=0.0),
                group("analog", Kind.ANALOG, SKY130_MET5, variation=0.05, turned=0.5),
                group("fill", Kind.FILL, SKY130_MET5, variation=0.0, diffraction=0.3),
                *dark_groups(SKY130_MET5),
            ),
        ),
    ),
    wafer=drifting_wafer(diameter_mm=200),
)
