# SPDX-License-Identifier: GPL-2.0-or-later
"""A field-programmable gate array.

Columns of one kind each over the whole height, cut into rows of clock regions, as Xilinx makes
them since Virtex-4 (7 Series configurable logic block user guide, UG474); Virtex-5 was a 65 nm
chip, so the wiring is that of Intel's 65 nm process. Every tile is a copy of its neighbour.
"""

from __future__ import annotations

from icwafer.chips.model import DieSpec, Kind, Layout
from icwafer.chips.presets import test_chip
from icwafer.chips.presets.metals import INTEL65_M6, INTEL65_M7, INTEL65_M8
from icwafer.chips.presets.parts import (
    chip,
    dark_groups,
    drifting_wafer,
    group,
)
from icwafer.chips.tree import Cut, Macro, Part, Region, Tiles, Twins

_LOGIC_TILE = Cut(0, (Part(Macro(Kind.LOGIC), 0.62), Part(Macro(Kind.BUS), 0.38)))
_COLUMNS = Cut(
    0,
    (
        Part(Tiles(_LOGIC_TILE, columns=6, rows=10, mirror="x"), 6.0),
        Part(Tiles(Macro(Kind.MEMORY), columns=1, rows=5, mirror="y"), 1.3),
        Part(Tiles(_LOGIC_TILE, columns=4, rows=10, mirror="x"), 4.0),
        Part(Tiles(Region(130.0, ((Kind.LOGIC, 1.0),)), columns=1, rows=5), 1.0),
        Part(Tiles(_LOGIC_TILE, columns=4, rows=10, mirror="x"), 4.0),
        Part(Tiles(Macro(Kind.MEMORY), columns=1, rows=5, mirror="y"), 1.3),
    ),
)
_CLOCK_REGION = Cut(
    1,
    (
        Part(_COLUMNS, 0.49),
        Part(Macro(Kind.BUS), 0.02),
        Part(_COLUMNS, 0.49),
    ),
)
_FABRIC = Tiles(_CLOCK_REGION, columns=1, rows=6, mirror="y")
_IO_COLUMN = Tiles(Region(150.0, ((Kind.ANALOG, 0.6), (Kind.LOGIC, 0.4))), columns=1, rows=6)
_CLOCK_COLUMN = Cut(
    1,
    (
        Part(Tiles(Macro(Kind.ANALOG), columns=1, rows=4), (0.30, 0.36)),
        Part(Region(300.0, ((Kind.LOGIC, 0.7), (Kind.MEMORY, 0.3))), (0.28, 0.36)),
        Part(Tiles(Macro(Kind.ANALOG), columns=1, rows=4), (0.30, 0.36)),
    ),
)
_TRANSCEIVERS = Tiles(Region(240.0, ((Kind.ANALOG, 0.7), (Kind.LOGIC, 0.3))), columns=1, rows=5)

TREE = chip(
    Cut(
        0,
        (
            Part(_IO_COLUMN, um=260.0),
            Part(Twins(0, _FABRIC, Part(_CLOCK_COLUMN, um=420.0))),
            Part(_IO_COLUMN, um=260.0),
            Part(_TRANSCEIVERS, um=620.0),
        ),
    )
)

LAYOUT = Layout(
    dies=(
        DieSpec(
            name="fpga",
            floorplan="fpga",
            seed=6,
            width_mm=12.4,
            height_mm=11.6,
            block_um=75.0,
            groups=(
                group("logic", Kind.LOGIC, INTEL65_M8, variation=0.004, across=INTEL65_M7),
                group("routing", Kind.BUS, INTEL65_M7, variation=0.001, turned=1.0),
                group("memory", Kind.MEMORY, INTEL65_M6, variation=0.002, diffraction=0.6),
                group("interfaces", Kind.ANALOG, INTEL65_M7, variation=0.02, turned=0.5),
                *dark_groups(INTEL65_M8),
            ),
        ),
        test_chip.DIE,
    ),
    wafer=drifting_wafer(test_fields=((-2, -2), (1, 2))),
)
