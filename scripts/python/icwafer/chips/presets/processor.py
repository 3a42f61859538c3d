# SPDX-License-Identifier: GPL-2.0-or-later
"""A processor of eight cores.

Size and arrangement after the core die of AMD's Zen 2 (10.32 x 7.34 mm; two complexes of four
cores, each core with its slice of the shared cache in the middle). The upper wiring layers of that
7 nm process are not published: those of Intel's 65 nm stand in.
"""

from __future__ import annotations

from icwafer.chips.model import DieSpec, Kind, Layout
from icwafer.chips.presets import test_chip
from icwafer.chips.presets.metals import INTEL65_M6, INTEL65_M7, INTEL65_M8
from icwafer.chips.presets.parts import (
    STRIP,
    chip,
    dark_groups,
    drifting_wafer,
    group,
)
from icwafer.chips.tree import Cut, Macro, Part, Region, Ring, Tiles, Twins

_L3_SLICE = Twins(
    1,
    Tiles(Macro(Kind.MEMORY, "shared cache"), columns=4, rows=1, mirror="x"),
    Part(Macro(Kind.LOGIC), 0.10),
)

_CORE = Ring(
    12.0,
    STRIP,
    Cut(
        0,
        (
            Part(Region(430.0, ((Kind.LOGIC, 0.76), (Kind.MEMORY, 0.24))), (0.72, 0.76)),
            Part(Tiles(Macro(Kind.MEMORY, "cache"), columns=1, rows=4, mirror="y"), (0.20, 0.24)),
        ),
    ),
)

# The caches of four mirrored tiles meet in the middle.
_COMPLEX = Tiles(
    Cut(
        1,
        (
            Part(_CORE, (0.60, 0.64)),
            Part(Ring(6.0, STRIP, _L3_SLICE), (0.36, 0.40)),
        ),
    ),
    columns=2,
    rows=2,
    mirror="xy",
)

_UNCORE = Cut(
    1,
    (
        Part(Region(330.0, ((Kind.ANALOG, 0.6), (Kind.LOGIC, 0.4))), 0.30),
        Part(Macro(Kind.BUS), 0.10),
        Part(Region(300.0, ((Kind.LOGIC, 0.7), (Kind.MEMORY, 0.2), (Kind.ANALOG, 0.1))), 0.30),
        Part(Region(330.0, ((Kind.ANALOG, 0.6), (Kind.LOGIC, 0.4))), 0.30),
    ),
)

TREE = chip(
    Twins(
        0,
        _COMPLEX,
        Part(Cut(0, (Part(Macro(Kind.BUS), um=80.0), Part(_UNCORE))), (0.10, 0.13)),
    )
)

LAYOUT = Layout(
    dies=(
        DieSpec(
            name="eight-core",
            floorplan="eight-core",
            seed=8,
            width_mm=10.32,
            height_mm=7.34,
            block_um=80.0,
            groups=(
                group("logic", Kind.LOGIC, INTEL65_M8, weight=4.0, across=INTEL65_M7),
                group("dense logic", Kind.LOGIC, INTEL65_M7, diffraction=0.4, turned=1.0),
                group("shared cache", Kind.MEMORY, INTEL65_M7, 0.001, diffraction=0.6, weight=0.0),
                group("cache", Kind.MEMORY, INTEL65_M6, variation=0.003, diffraction=0.6),
                group("register files", Kind.MEMORY, INTEL65_M6, turned=1.0, weight=2.0),
                group("interfaces", Kind.ANALOG, INTEL65_M8, variation=0.02, turned=0.5),
                group("interconnect", Kind.BUS, INTEL65_M8, variation=0.002, turned=1.0),
                *dark_groups(INTEL65_M8),
            ),
        ),
        test_chip.DIE,
    ),
    wafer=drifting_wafer(test_fields=((-2, 2), (2, -2))),
)
