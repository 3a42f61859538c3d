# SPDX-License-Identifier: GPL-2.0-or-later
"""Eight pictures of one die, each effect of CS348B alone and together."""

from __future__ import annotations

from icwafer.chips.model import DieSpec
from icwafer.chips.presets.spacing import (
    CLUSTERED_DIE,
    CLUSTERED_GROUPS,
    EVEN_GROUPS,
    NORMAL_DIE,
    UNIFORM_DIE,
    with_spacing,
)
from icwafer.chips.spread import Normal
from icwafer.pictures.model import Camera, Light, NodeValue, Picture, Render

WHOLE = Camera(position_mm=(-11.1, -24.7, 20.9), target_mm=(0.0, -0.7, 0.0), lens_mm=66)
NEAR = Camera(position_mm=(-6.4, -21.1, 14.5), target_mm=(-1.1, -0.55, 0.0), lens_mm=66)

KEY = Light("POINT", (6.0, -14.0, 26.0), 60000)
SPOT = Light("SPOT", (-16.0, -20.0, 16.0), 50000, cone_deg=35)
LEFT_PAIR = (
    Light("POINT", (-10.0, -6.0, 14.0), 26000),
    Light("POINT", (-16.0, -18.0, 20.0), 22000),
)

PROCESSOR = DieSpec(CLUSTERED_GROUPS, seed=17)
GRATING = DieSpec(with_spacing(EVEN_GROUPS, Normal(1000, 4)), seed=17)

MATERIAL: dict[str, NodeValue] = {
    "model": "CS348B",
    "Lobe Width": 0.02,
    "Specular Roughness": 0.15,
}
GRATING_ONLY = MATERIAL | {"use_thin_film": False, "use_wire_diffraction": False}

EFFECTS = {
    "grating_one_light": Picture(
        "Grating only, one point light: clear separate strips of colour, order after order.",
        GRATING,
        (Light("POINT", (1.0, -3.0, 9.0), 2500),),
        WHOLE,
        GRATING_ONLY | {"Lobe Width": 0.012},
    ),
    "grating_many_lights": Picture(
        "Grating only, three lights: the strips of all of them lie over one another.",
        GRATING,
        (
            Light("POINT", (1.0, -3.0, 9.0), 1100),
            Light("POINT", (-9.0, -14.0, 12.0), 2600),
            Light("POINT", (10.0, -9.0, 14.0), 2200),
        ),
        WHOLE,
        GRATING_ONLY | {"Lobe Width": 0.012},
    ),
    "thin_film": Picture(
        "Thin film only: colours pass into one another softly, with the angle and nothing else.",
        PROCESSOR,
        (Light("POINT", (-4.5, 0.4, 10.0), 5200),),
        WHOLE,
        MATERIAL | {"use_grating": False, "use_wire_diffraction": False},
    ),
    "wire_diffraction": Picture(
        "Diffraction within a wire only: no colour to speak of, as expected.",
        PROCESSOR,
        (Light("POINT", (-4.5, 0.4, 10.0), 5200),),
        WHOLE,
        MATERIAL | {"use_grating": False, "use_thin_film": False},
    ),
    "full": Picture(
        "The full model, one point and one spot light.",
        PROCESSOR,
        (KEY, SPOT),
        WHOLE,
        MATERIAL | {"Lobe Width": 0.035},
        render=Render((1920, 1080), 32),
    ),
    "random_spacing": Picture(
        "Spacing at random between 800 and 1200 nm: a disordered mess.",
        UNIFORM_DIE,
        LEFT_PAIR,
        NEAR,
        MATERIAL | {"Lobe Width": 0.04},
    ),
    "narrow_spacing": Picture(
        "Spacing 1000 nm within 50 everywhere: the blocks all but vanish, no texture.",
        NORMAL_DIE,
        LEFT_PAIR,
        NEAR,
        MATERIAL | {"Lobe Width": 0.04},
    ),
    "clustered_groups": Picture(
        "Clustered groups: the largest gives the background colours, the smaller ones texture.",
        CLUSTERED_DIE,
        LEFT_PAIR,
        NEAR,
        MATERIAL | {"Lobe Width": 0.04},
    ),
}
