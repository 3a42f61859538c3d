# SPDX-License-Identifier: GPL-2.0-or-later
"""An image sensor of 12 megapixels.

Pixels as in Sony's IMX477 (product brief: 4056 x 3040 of 1.55 um, 7.9 mm across). The pixels are
the grating, in both directions; converters above and below each column, row drivers at the sides.
"""

from __future__ import annotations

from icwafer.chips.model import DieSpec, Kind, Layout
from icwafer.chips.presets import test_chip
from icwafer.chips.presets.metals import SKY130_MET3, SKY130_MET4, Metal
from icwafer.chips.presets.parts import (
    STRIP,
    chip,
    dark_groups,
    drifting_wafer,
    group,
)
from icwafer.chips.tree import Cut, Macro, Part, Region, Ring

_PIXEL = Metal(1550, 400, 500)
_COLUMN = Metal(2 * 1550, 1000, 350)

_ROW_DRIVER = Macro(Kind.MEMORY)
_PIXELS = Ring(25.0, STRIP, Macro(Kind.PIXEL))
_MIDDLE = Cut(
    0,
    (
        Part(_ROW_DRIVER, um=190.0),
        Part(_PIXELS),
        Part(_ROW_DRIVER, um=190.0),
    ),
)
_LOGIC = Region(300.0, ((Kind.LOGIC, 0.6), (Kind.MEMORY, 0.2), (Kind.ANALOG, 0.2)))

TREE = chip(
    Cut(
        1,
        (
            Part(_LOGIC, um=420.0),
            Part(Macro(Kind.BUS), um=300.0),
            Part(_MIDDLE),
            Part(Macro(Kind.BUS), um=300.0),
            Part(Region(220.0, ((Kind.ANALOG, 0.7), (Kind.LOGIC, 0.3))), um=240.0),
        ),
    )
)

LAYOUT = Layout(
    dies=(
        DieSpec(
            name="image-sensor",
            floorplan="image-sensor",
            seed=3,
            width_mm=7.06,
            height_mm=6.36,
            block_um=70.0,
            groups=(
                group("pixels", Kind.PIXEL, _PIXEL, variation=0.0, diffraction=0.7, across=_PIXEL),
                group("converters", Kind.BUS, _COLUMN, variation=0.0),
                group("row drivers", Kind.MEMORY, _PIXEL, variation=0.001, turned=1.0),
                group("logic", Kind.LOGIC, SKY130_MET4, across=SKY130_MET3),
                group("analog", Kind.ANALOG, SKY130_MET4, variation=0.02, turned=0.5),
                *dark_groups(SKY130_MET4),
            ),
        ),
        test_chip.DIE,
    ),
    wafer=drifting_wafer(test_fields=((2, 2),)),
)
