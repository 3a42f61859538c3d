# SPDX-License-Identifier: GPL-2.0-or-later
"""A test chip: fields of wires of many periods, between rows of probe pads.

Such fields stand among the products of a wafer, and show other colours than these. The periods are
those of the layers of SkyWater's open 130 nm process, and steps between them.
"""

from __future__ import annotations

from icwafer.chips.model import DieSpec, Kind, Layout
from icwafer.chips.presets.metals import (
    SKY130_MET2,
    SKY130_MET3,
    SKY130_MET4,
    SKY130_MET5,
    SKY130_ROW,
    SKY130_SRAM,
    Metal,
)
from icwafer.chips.presets.parts import STRIP, dark_groups, drifting_wafer, group
from icwafer.chips.tree import Cut, Macro, Part, Region, Ring, Slices, Tiles

_PADS = Tiles(Ring(14.0, STRIP, Macro(Kind.IO)), pitch_um=120.0)
_CIRCUITS = Slices(
    (
        Part(Region(300.0, ((Kind.LOGIC, 1.0),)), 0.3),
        Part(Tiles(Macro(Kind.MEMORY), columns=2, rows=2, mirror="xy"), 0.3),
        Part(Region(250.0, ((Kind.ANALOG, 1.0),)), 0.2),
        Part(Macro(Kind.FILL), 0.2),
    )
)

_FIELDS = (
    ("met2", SKY130_MET2),
    ("met3", SKY130_MET3),
    ("met4", SKY130_MET4),
    ("step 1.1", Metal(1100, 400, 800)),
    ("step 1.3", Metal(1300, 500, 800)),
    ("bit cells", SKY130_SRAM),
    ("step 2.0", Metal(2000, 800, 800)),
    ("rows", SKY130_ROW),
    ("step 2.4", Metal(2400, 1000, 800)),
    ("step 1.7", Metal(1700, 700, 800)),
    ("step 0.8", Metal(800, 350, 800)),
    ("met5", SKY130_MET5),
)


def _row(first: int) -> Cut:
    """Pads, and four fields above them."""
    names = [name for name, _ in _FIELDS[first : first + 4]]
    fields = [Ring(25.0, STRIP, Macro(Kind.PIXEL, f"field {name}")) for name in names]
    return Cut(1, (Part(_PADS, um=120.0), Part(Cut(0, tuple(map(Part, fields))))))


TREE = Ring(
    30.0,
    Macro(Kind.SEAL),
    Ring(20.0, STRIP, Cut(1, (Part(_CIRCUITS, 0.9), *(Part(_row(at)) for at in (0, 4, 8))))),
)

DIE = DieSpec(
    name="test-chip",
    floorplan="test-chip",
    seed=1,
    width_mm=5.0,
    height_mm=5.0,
    block_um=90.0,
    groups=(
        *(
            group(
                f"field {name}", Kind.PIXEL, metal, 0.0, 0.6, turned=float(name.startswith("step"))
            )
            for name, metal in _FIELDS
        ),
        group("logic", Kind.LOGIC, SKY130_MET4, across=SKY130_ROW),
        group("memory", Kind.MEMORY, SKY130_SRAM, variation=0.001, diffraction=0.6),
        group("analog", Kind.ANALOG, SKY130_MET5, variation=0.05, turned=0.5),
        group("fill", Kind.FILL, SKY130_MET5, variation=0.0, diffraction=0.3),
        *dark_groups(SKY130_MET5),
    ),
)

LAYOUT = Layout(
    dies=(DIE,),
    wafer=drifting_wafer(diameter_mm=150, mark="flats"),
)
