# SPDX-License-Identifier: GPL-2.0-or-later
"""A power-management chip: four switching regulators and what controls them.

Half of such a chip is output transistors under thick metal; the wires are those of the two thick
layers of IHP's open 130 nm process SG13G2, 3.28 and 4 um apart, so its colours are many fine
orders close together.
"""

from __future__ import annotations

from icwafer.chips.model import DieSpec, Kind, Layout
from icwafer.chips.presets.metals import IHP_METAL5, IHP_TOP1, IHP_TOP2
from icwafer.chips.presets.parts import (
    STRIP,
    chip,
    dark_groups,
    drifting_wafer,
    group,
)
from icwafer.chips.tree import Cut, Macro, Part, Region, Ring, Slices, Tiles

_PADS = Tiles(Ring(12.0, STRIP, Macro(Kind.IO)), pitch_um=150.0)
_TRANSISTOR = Ring(6.0, STRIP, Macro(Kind.BUS))
_REGULATOR = Ring(
    10.0,
    STRIP,
    Cut(
        1,
        (
            Part(_PADS, um=150.0),
            Part(Tiles(_TRANSISTOR, columns=2, rows=1), (0.36, 0.42)),
            Part(Tiles(_TRANSISTOR, columns=3, rows=1), (0.22, 0.28)),
            Part(Region(150.0, ((Kind.ANALOG, 0.7), (Kind.LOGIC, 0.3))), (0.26, 0.32)),
        ),
    ),
)
_CONTROL = Slices(
    (
        Part(Region(240.0, ((Kind.LOGIC, 1.0),)), (0.28, 0.36)),
        Part(Macro(Kind.MEMORY), (0.10, 0.14)),
        Part(Region(210.0, ((Kind.ANALOG, 1.0),)), (0.36, 0.44)),
        Part(Macro(Kind.FILL), (0.06, 0.10)),
    )
)

TREE = chip(
    Cut(
        1,
        (
            Part(Tiles(_REGULATOR, columns=4, rows=1, mirror="x"), (0.56, 0.64)),
            Part(STRIP, um=15.0),
            Part(_CONTROL, (0.36, 0.44)),
        ),
    )
)

LAYOUT = Layout(
    dies=(
        DieSpec(
            name="power",
            floorplan="power",
            seed=7,
            width_mm=3.6,
            height_mm=3.1,
            block_um=42.0,
            groups=(
                group("transistors", Kind.BUS, IHP_TOP2, variation=0.001, diffraction=0.6),
                group("analog", Kind.ANALOG, IHP_TOP1, variation=0.03, turned=0.5),
                group("logic", Kind.LOGIC, IHP_METAL5, diffraction=0.4),
                group("memory", Kind.MEMORY, IHP_METAL5, variation=0.002, turned=1.0),
                group("fill", Kind.FILL, IHP_TOP1, variation=0.0, diffraction=0.3),
                *dark_groups(IHP_TOP2),
            ),
        ),
    ),
    wafer=drifting_wafer(diameter_mm=200),
)
