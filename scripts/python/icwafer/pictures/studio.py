# SPDX-License-Identifier: GPL-2.0-or-later
"""Wafers and a die in a studio, with the model PHYSICAL.

Softboxes behind and above. The one behind is where a wafer that lies flat mirrors it to the
camera, so it gives the white band; the one above gives wires that run across the picture their
first order.
"""

from __future__ import annotations

import dataclasses

from icwafer.chips.presets import PRESETS
from icwafer.pictures.model import Camera, Light, NodeValue, Picture, Render, Table, View

_METAL: dict[str, NodeValue] = {
    "model": "PHYSICAL",
    "metal": "COPPER",
    "Coherence Width": 14.0,
    "Wire Length": 1.2,
    "Roughness": 0.1,
}
_FULL = Render((1920, 1080), 40, noise=0.02, bounces=1)

WAFER = Picture(
    "A 300 mm wafer of memories in a studio.",
    PRESETS["dram"].dies[0],
    (
        Light("AREA", (-60.0, 560.0, 470.0), 0.6e6, size_mm=(520.0, 30.0), fade=0.6),
        Light("AREA", (-150.0, 110.0, 620.0), 3.6e6, size_mm=(200.0, 80.0), fade=0.6),
    ),
    Camera((60.0, -520.0, 400.0), (0.0, -12.0, 0.0), lens_mm=58.0, f_stop=60.0),
    _METAL,
    wafer="dram",
    table=Table(1400.0, (0.045, 0.045, 0.05)),
    view=View(exposure=0.5),
    render=_FULL,
)

FRONT = Picture(
    "A 300 mm wafer seen from the front, under a row of lamps.",
    PRESETS["dram"].dies[0],
    (
        Light("AREA", (0.0, 310.0, 690.0), 0.8e6, size_mm=(600.0, 16.0), fade=0.4),
        Light("AREA", (-300.0, -140.0, 690.0), 2.0e6, size_mm=(40.0, 60.0), fade=0.4),
    ),
    Camera((0.0, -200.0, 690.0), (0.0, -4.0, 0.0), lens_mm=47.0),
    _METAL | {"metal": "ALUMINIUM"},
    wafer="dram",
    view=View(exposure=0.5),
    render=_FULL,
)

TUBE = dataclasses.replace(
    WAFER,
    caption="The wafer under a fluorescent tube (F11): each line of its spectrum its own image.",
    lights=(Light("AREA", (0.0, 130.0, 620.0), 1.6e6, size_mm=(500.0, 12.0), fade=0.3),),
    node=_METAL | {"illuminant": "F11", "Coherence Width": 60.0, "Roughness": 0.03},
)

DIE = Picture(
    "A processor die, close up.",
    PRESETS["eight-core"].dies[0],
    (
        Light("AREA", (0.0, 30.0, 20.0), 3e3, size_mm=(30.0, 3.0), fade=0.5),
        Light("AREA", (-6.0, 6.0, 32.0), 1.5e4, size_mm=(12.0, 5.0), fade=0.6),
    ),
    Camera((6.0, -21.0, 14.0), (0.2, -0.6, 0.0), lens_mm=75.0, f_stop=60.0),
    _METAL,
    table=Table(80.0),
    view=View(exposure=0.2),
    render=_FULL,
)

STUDIO = {
    "wafer_studio": WAFER,
    "wafer_front": FRONT,
    "wafer_fluorescent": TUBE,
    "die_studio": DIE,
}
