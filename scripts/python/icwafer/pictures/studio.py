# SPDX-License-Identifier: GPL-2.0-or-later
"""Wafers and a die in a studio, with the model PHYSICAL.

One small lamp makes the colours: no wider across the wires than a few hundredths of its distance,
so that each place sees a narrow band of the spectrum, and the bands are soft by the lobes of the
wires alone. Cards do the rest: the wall of light behind is where a wafer that lies flat mirrors it
to the camera and shows bare metal, those low beside it draw the rounded rim.
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
    "Roughness": 0.035,
}
_FULL = Render((1920, 1080), 64, noise=0.02, bounces=1)
#: Where the lamp is narrow next to the lobes, or they next to it, few samples are lost.
_EASY = dataclasses.replace(_FULL, samples=36)

WAFER = Picture(
    "A 300 mm wafer of memories in a studio.",
    PRESETS["dram"].dies[0],
    (
        Light("AREA", (-80.0, 50.0, 380.0), 0.65e6, size_mm=(110.0, 16.0), fade=0.5),
        Light("CARD", (150.0, 700.0, 330.0), 0.35e6, size_mm=(1100.0, 260.0), fade=1.0),
        Light("CARD", (-560.0, 60.0, 120.0), 1.0e6, size_mm=(500.0, 120.0), fade=1.0),
        Light("CARD", (320.0, -560.0, 130.0), 0.5e6, size_mm=(420.0, 90.0), fade=1.0),
    ),
    Camera((60.0, -520.0, 400.0), (0.0, -12.0, 0.0), lens_mm=58.0, f_stop=60.0),
    _METAL,
    wafer="dram",
    table=Table(1400.0, (0.045, 0.045, 0.05)),
    view=View(exposure=0.9),
    render=_FULL,
)

FRONT = Picture(
    "A 300 mm wafer seen from the front, under two lamps and a bluish ceiling.",
    PRESETS["dram"].dies[0],
    (
        # Its mirror image, drawn out along one axis, is the white band. A lamp longer than the
        # lobes of the wires that run across would speckle these: few of its samples meet them. It
        # stands so far aside that their own mirror image of it falls on the edge.
        Light("AREA", (335.0, 340.0, 690.0), 1.4e6, size_mm=(48.0, 16.0), fade=0.4),
        Light("AREA", (-310.0, -225.0, 690.0), 2.2e6, size_mm=(48.0, 60.0), fade=0.4),
        # The ceiling, which shows dies far from all bands, and the rim.
        Light(
            "CARD", (0.0, 300.0, 1000.0), 1.4e6, colour=(0.4, 0.6, 1.0), size_mm=(3000.0, 3000.0)
        ),
    ),
    Camera((0.0, -200.0, 690.0), (0.0, -4.0, 0.0), lens_mm=47.0),
    # Shorter wires carry the bands further across the wafer.
    _METAL | {"metal": "ALUMINIUM", "Wire Length": 0.9, "Roughness": 0.045},
    wafer="dram",
    view=View(exposure=0.5),
    render=dataclasses.replace(_FULL, samples=96),
)

TUBE = dataclasses.replace(
    WAFER,
    caption="The wafer under a fluorescent tube (F11): each line of its spectrum its own image.",
    # Before the wafer, where the camera sees the second order: its images of the lines lie twice
    # as far apart as those of the first, and are no wider.
    lights=(
        Light("AREA", (0.0, -145.0, 560.0), 1.2e7, size_mm=(500.0, 6.0), fade=0.1),
        *WAFER.lights[2:],
    ),
    view=View(exposure=0.5),
    render=_EASY,
    node=_METAL | {"illuminant": "F11", "Coherence Width": 60.0, "Roughness": 0.006},
)

DIE = Picture(
    "A processor die, close up.",
    PRESETS["eight-core"].dies[0],
    (
        Light("CARD", (4.0, 40.0, 20.0), 4e3, size_mm=(60.0, 20.0), fade=1.0),
        Light("AREA", (-5.0, 6.2, 26.0), 2.2e4, size_mm=(8.0, 2.0), fade=0.5),
    ),
    Camera((6.0, -21.0, 14.0), (0.2, -0.6, 0.0), lens_mm=75.0, f_stop=110.0),
    _METAL,
    table=Table(80.0),
    view=View(exposure=0.2),
    render=dataclasses.replace(_FULL, samples=48),
)

STUDIO = {
    "wafer_studio": WAFER,
    "wafer_front": FRONT,
    "wafer_fluorescent": TUBE,
    "die_studio": DIE,
}
