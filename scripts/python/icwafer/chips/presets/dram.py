# SPDX-License-Identifier: GPL-2.0-or-later
"""A memory: dynamic RAM of sixteen banks, with its pads in a line through the middle.

Banks as in JEDEC's DDR4 (JESD79-4: four groups of four); pads in the middle as in all such chips
for packages with wires to the centre. A bank is an array of mats between sense amplifiers, with
its row decoder at one side and its column decoder towards the middle. What is seen of it is the
metal above: one main word line for eight word lines (K. Itoh, VLSI Memory Chip Design, 2001). With
cells of 2F x 3F and F = 65 nm they are 16 F = 1040 nm apart; two fifths of that are taken as wire.
"""

from __future__ import annotations

from icwafer.chips.model import DieSpec, Kind, Layout
from icwafer.chips.presets import test_chip
from icwafer.chips.presets.metals import SKY130_MET2, SKY130_MET4, Metal
from icwafer.chips.presets.parts import (
    STRIP,
    dark_groups,
    drifting_wafer,
    group,
)
from icwafer.chips.tree import Cut, Macro, Part, Region, Ring, Tiles, Twins

_WORD_LINES = Metal(1040, 416, 300)

_BANK = Cut(
    1,
    (
        Part(
            Cut(
                0,
                (
                    Part(Tiles(Macro(Kind.MEMORY), columns=4, rows=2, mirror="x"), 0.93),
                    Part(Macro(Kind.LOGIC), 0.07),
                ),
            ),
            0.92,
        ),
        Part(Macro(Kind.BUS), 0.08),
    ),
)
_BANKS = Tiles(Ring(9.0, STRIP, _BANK), columns=4, rows=2, mirror="x")
_PADS = Tiles(Macro(Kind.IO), pitch_um=100.0)
_MIDDLE = Cut(
    1,
    (
        Part(Region(170.0, ((Kind.LOGIC, 0.7), (Kind.ANALOG, 0.3))), 0.35),
        Part(STRIP, um=12.0),
        Part(_PADS, um=90.0),
        Part(STRIP, um=12.0),
        Part(Region(170.0, ((Kind.LOGIC, 0.7), (Kind.ANALOG, 0.3))), 0.35),
    ),
)

TREE = Ring(30.0, Macro(Kind.SEAL), Ring(20.0, STRIP, Twins(1, _BANKS, Part(_MIDDLE, um=460.0))))

LAYOUT = Layout(
    dies=(
        DieSpec(
            name="dram",
            floorplan="dram",
            seed=4,
            width_mm=8.9,
            height_mm=6.1,
            block_um=90.0,
            groups=(
                group("cells", Kind.MEMORY, _WORD_LINES, variation=0.002, diffraction=0.65),
                group("row decoders", Kind.LOGIC, SKY130_MET4, turned=1.0, diffraction=0.4),
                group("column lines", Kind.BUS, SKY130_MET2, variation=0.002, turned=1.0),
                group("charge pumps", Kind.ANALOG, SKY130_MET4, variation=0.02, diffraction=0.3),
                *dark_groups(SKY130_MET4),
            ),
        ),
        test_chip.DIE,
    ),
    wafer=drifting_wafer(test_fields=((-3, 1), (-3, -2)), partial_dies=True),
)
