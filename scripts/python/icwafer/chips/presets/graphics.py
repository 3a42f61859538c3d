# SPDX-License-Identifier: GPL-2.0-or-later
"""A graphics chip as large as a reticle allows.

Size and arrangement after NVIDIA's H100 (814 mm2; architecture paper, 2022): eight clusters of
processors around the shared cache and its crossbar, memory interfaces on two sides, links on
another. Wiring as in Intel's 45 nm process.
"""

from __future__ import annotations

from icwafer.chips.model import DieSpec, Kind, Layout
from icwafer.chips.presets.metals import INTEL45_M6, INTEL45_M7, INTEL45_M8
from icwafer.chips.presets.parts import (
    STRIP,
    chip,
    dark_groups,
    drifting_wafer,
    group,
)
from icwafer.chips.tree import Cut, Macro, Part, Region, Ring, Tiles, Twins

# A pair of multiprocessors: two halves of arithmetic and register files, and their cache between.
_HALF = Cut(
    0,
    (
        Part(Region(480.0, ((Kind.LOGIC, 1.0),)), (0.70, 0.76)),
        Part(
            Tiles(Macro(Kind.MEMORY, "register files"), columns=1, rows=2, mirror="y"),
            (0.22, 0.28),
        ),
    ),
)
_PROCESSOR = Ring(14.0, STRIP, Twins(1, _HALF, Part(Macro(Kind.MEMORY, "cache"), (0.10, 0.14))))
_CLUSTER = Ring(
    45.0,
    STRIP,
    Cut(
        1,
        (
            Part(Tiles(_PROCESSOR, columns=3, rows=3, mirror="x"), 0.90),
            Part(Region(420.0, ((Kind.LOGIC, 0.7), (Kind.MEMORY, 0.3))), 0.10),
        ),
    ),
)
_CACHE = Twins(
    1,
    Tiles(Macro(Kind.MEMORY, "shared cache"), columns=24, rows=2, mirror="y"),
    Part(Macro(Kind.BUS), (0.16, 0.22)),
)
_CLUSTERS = Tiles(_CLUSTER, columns=4, rows=1, mirror="x")

_INTERFACE = Cut(
    0,
    (
        Part(Tiles(Macro(Kind.ANALOG), columns=1, rows=4), 0.6),
        Part(Region(450.0, ((Kind.LOGIC, 0.7), (Kind.MEMORY, 0.3))), 0.4),
    ),
)
_MEMORY_SIDE = Tiles(Ring(20.0, STRIP, _INTERFACE), columns=1, rows=3)

TREE = chip(
    Cut(
        1,
        (
            Part(Tiles(Macro(Kind.ANALOG), columns=18, rows=1), um=1150.0),
            Part(Macro(Kind.LOGIC), um=500.0),
            Part(
                Cut(
                    0,
                    (
                        Part(_MEMORY_SIDE, um=2300.0),
                        Part(STRIP, um=60.0),
                        Part(Twins(1, _CLUSTERS, Part(_CACHE, (0.13, 0.16)))),
                        Part(STRIP, um=60.0),
                        Part(_MEMORY_SIDE, um=2300.0),
                    ),
                )
            ),
        ),
    )
)

LAYOUT = Layout(
    dies=(
        DieSpec(
            name="graphics",
            floorplan="graphics",
            seed=5,
            width_mm=31.3,
            height_mm=26.0,
            block_um=190.0,
            groups=(
                group("logic", Kind.LOGIC, INTEL45_M8, weight=4.0, across=INTEL45_M7),
                group("dense logic", Kind.LOGIC, INTEL45_M7, diffraction=0.4, turned=1.0),
                group("shared cache", Kind.MEMORY, INTEL45_M7, 0.001, diffraction=0.6, weight=0.0),
                group("cache", Kind.MEMORY, INTEL45_M6, variation=0.003, turned=1.0),
                group("register files", Kind.MEMORY, INTEL45_M6, variation=0.003, diffraction=0.6),
                group("interfaces", Kind.ANALOG, INTEL45_M8, variation=0.02, turned=0.5),
                group("crossbar", Kind.BUS, INTEL45_M8, variation=0.002, turned=1.0),
                *dark_groups(INTEL45_M8),
            ),
        ),
    ),
    wafer=drifting_wafer(),
)
