# SPDX-License-Identifier: GPL-2.0-or-later
"""The eight pictures as data: which die, which effects, lit and seen how, and what each one shows.

Lengths are in millimetres, and so is the scene: 1 Blender unit is 1 mm. The die lies in the plane
z = 0 with its centre at the origin.
"""

from __future__ import annotations

from dataclasses import dataclass

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

Vector = tuple[float, float, float]


@dataclass(frozen=True)
class Light:
    """A lamp. `power_w` is Blender's radiant power for a point in all directions.

    colour: linear Rec.709, each channel 0 to 1.
    radius_mm: of the glowing ball; a larger one gives softer colours.
    cone_deg, blend, target_mm: only of a spot.
    """

    kind: str  # POINT or SPOT, as Blender calls them
    position_mm: Vector
    power_w: float
    colour: Vector = (1.0, 1.0, 1.0)
    radius_mm: float = 0.3
    cone_deg: float = 40.0
    blend: float = 1.0
    target_mm: Vector = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Camera:
    """A camera with a sensor 36 mm wide, upright."""

    position_mm: Vector
    target_mm: Vector
    lens_mm: float = 50.0


@dataclass(frozen=True)
class Effects:
    """Which of the three diffraction effects of the model are on."""

    grating: bool = True
    thin_film: bool = True
    wire_diffraction: bool = True


@dataclass(frozen=True)
class Picture:
    """One picture: `caption` says what it shows, `lobe_width` is the node's socket.

    look: of Blender's Filmic view transform. size: width and height in pixels.
    """

    caption: str
    die: DieSpec
    lights: tuple[Light, ...]
    camera: Camera
    effects: Effects = Effects()
    lobe_width: float = 0.02
    specular_roughness: float = 0.15
    look: str = "Medium High Contrast"
    size: tuple[int, int] = (960, 540)
    samples: int = 48


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

PICTURES = {
    "grating_one_light": Picture(
        "Grating only, one point light: clear separate strips of colour, order after order.",
        GRATING,
        (Light("POINT", (1.0, -3.0, 9.0), 2500),),
        WHOLE,
        Effects(thin_film=False, wire_diffraction=False),
        lobe_width=0.012,
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
        Effects(thin_film=False, wire_diffraction=False),
        lobe_width=0.012,
    ),
    "thin_film": Picture(
        "Thin film only: colours pass into one another softly, with the angle and nothing else.",
        PROCESSOR,
        (Light("POINT", (-4.5, 0.4, 10.0), 5200),),
        WHOLE,
        Effects(grating=False, wire_diffraction=False),
    ),
    "wire_diffraction": Picture(
        "Diffraction within a wire only: no colour to speak of, as expected.",
        PROCESSOR,
        (Light("POINT", (-4.5, 0.4, 10.0), 5200),),
        WHOLE,
        Effects(grating=False, thin_film=False),
    ),
    "full": Picture(
        "The full model, one point and one spot light.",
        PROCESSOR,
        (KEY, SPOT),
        WHOLE,
        lobe_width=0.035,
        size=(1920, 1080),
        samples=32,
    ),
    "random_spacing": Picture(
        "Spacing at random between 800 and 1200 nm: a disordered mess.",
        UNIFORM_DIE,
        LEFT_PAIR,
        NEAR,
        lobe_width=0.04,
    ),
    "narrow_spacing": Picture(
        "Spacing 1000 nm within 50 everywhere: the blocks all but vanish, no texture.",
        NORMAL_DIE,
        LEFT_PAIR,
        NEAR,
        lobe_width=0.04,
    ),
    "clustered_groups": Picture(
        "Clustered groups: the largest gives the background colours, the smaller ones texture.",
        CLUSTERED_DIE,
        LEFT_PAIR,
        NEAR,
        lobe_width=0.04,
    ),
}
