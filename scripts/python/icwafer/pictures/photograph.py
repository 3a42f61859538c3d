# SPDX-License-Identifier: GPL-2.0-or-later
"""A scene after a photograph of a wafer: "Si wafer" by Enrique Jimenez (CC BY-SA 2.0).

The camera is solved from the lattice of the dies in the photograph: a pinhole camera whose middle
is the middle of the photograph, and whose lens is such that the rim becomes a circle, fits the
lattice with 0.5 pixels (RMS, of 1024 x 682). The lamp, the wires and the film were searched with
the model itself: the colours of 201 dies in OKLab. The photograph shows only u d, 980 to 1590 nm
over the wafer (orders 2 and 3); of the periods of 1300 to 1700 nm, each with the lamp that goes
with it, the one here fits best.
"""

from __future__ import annotations

from icwafer.chips.presets.bar_memory import PRODUCT
from icwafer.pictures.model import (
    Camera,
    Dust,
    Irregular,
    Light,
    Picture,
    Render,
    Response,
    View,
)

PHOTOGRAPH = Picture(
    "A wafer of memories, lit and seen as in a photograph.",
    PRODUCT,
    (
        # LAMPS
        Light(
            "AREA",
            (-163.4, 63.0, 583.9),
            5.85e+06,
            size_mm=(183.4, 65.2),
            fade=0.7,
            turn_deg=97.5,
        ),
        Light(
            "AREA",
            (-242.7, 257.2, 600.8),
            1.95e+06,
            size_mm=(328.1, 79.7),
            fade=0.7,
            turn_deg=125.4,
        ),
        Light(
            "AREA",
            (-175.1, -186.9, 570.5),
            4.23e+06,
            size_mm=(204.9, 221.5),
            fade=0.7,
            turn_deg=82.2,
        ),
        Light(
            "AREA",
            (-24.7, 171.4, 477.4),
            1.96e+05,
            size_mm=(188.2, 183.3),
            fade=0.7,
            turn_deg=81.1,
        ),
        # RIM
        # Low at the left: only the rounded rim sends its light on to the camera.
        Light("CARD", (-420.0, 40.0, 110.0), 8e5, size_mm=(680.0, 180.0), fade=0.2),
        # Low behind: the far rim.
        Light("CARD", (-120.0, 620.0, 60.0), 1.5e5, size_mm=(800.0, 90.0), fade=0.5),
        # What the bare silicon of the near rim mirrors: a dim window.
        Light(
            "CARD",
            (-190.0, 390.0, 380.0),
            8e3,
            (0.25, 0.42, 1.0),
            size_mm=(300.0, 160.0),
            fade=0.6,
        ),
    ),
    Camera(
        position_mm=(4.01, -319.82, 204.83),
        target_mm=(-37.65, -23.53, 8.25),
        lens_mm=93.16,
        roll_deg=2.136,
        f_stop=45.0,
    ),
    {
        "model": "PHYSICAL",
        "metal": "TUNGSTEN",
        "Coherence Width": 45.1,
        "Wire Length": 3.44,
        "Roughness": 0.071,
    },
    wafer="bar-memory",
    irregular=Irregular((0.2, 0.19, 0.17), 0.6),
    dust=Dust(260, 80.0),
    response=Response(saturation=1.36, glow=0.03),
    view=View("Filmic", "Very High Contrast", exposure=-1.08, gamma=1.45),
    render=Render((1620, 1079), 144, noise=0.015, bounces=1),
)
