# SPDX-License-Identifier: GPL-2.0-or-later
"""A scene after a photograph of a wafer: "Si wafer" by Enrique Jimenez (CC BY-SA 2.0).

The camera is solved from the lattice of the dies in the photograph: a pinhole camera whose middle
is the middle of the photograph, and whose lens is such that the rim becomes a circle, fits the
lattice with 0.5 pixels (RMS, of 1024 x 682).

The lamps, the wires, the film and the camera's response were found with the model itself, from the
colours of 295 dies. Where light must come from is a linear problem, solved first: of 672 places
above the wafer, which ones, how bright (non-negative least squares). They are three, one behind
the other and about one order apart, and a dim one; each became a softbox, and all of it was fitted
together (Levenberg and Marquardt; differences in OKLab, RMS 0.042, with one lamp 0.060). The
photograph shows only u d: 960 to 1580 nm over the wafer for the brightest lamp, orders 2 and 3.

A camera makes colours richer than they are and rolls bright ones off to white: `Response` and the
view do that here, and the gamut-mapped colours of the node, paler than spectral light is, need it
the more.
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
    Vector,
    View,
)


def _softbox(
    position_mm: Vector, power_w: float, size_mm: tuple[float, float], turn_deg: float
) -> Light:
    return Light("AREA", position_mm, power_w, size_mm=size_mm, fade=0.7, turn_deg=turn_deg)


PHOTOGRAPH = Picture(
    "A wafer of memories, lit and seen as in a photograph.",
    PRODUCT,
    (
        # Two tubes, the brighter one first, then a window in front of them, and what it lights up.
        _softbox((-163.4, 63.0, 583.9), 5.85e6, (183.4, 65.2), 97.5),
        _softbox((-242.7, 257.2, 600.8), 1.95e6, (328.1, 79.7), 125.4),
        _softbox((-175.1, -186.9, 570.5), 4.23e6, (204.9, 221.5), 82.2),
        _softbox((-24.7, 171.4, 477.4), 1.96e5, (188.2, 183.3), 81.1),
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
    render=Render((1620, 1079), 80, bounces=1),
)
