# SPDX-License-Identifier: GPL-2.0-or-later
"""The eight pictures as data: which die, which effects, lit and seen how, and what each one shows.

Lengths are in millimetres, and so is the scene: 1 Blender unit is 1 mm. The die lies in the plane
z = 0 with its centre at the origin.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from icwafer.chips.model import DieSpec
from icwafer.chips.presets.spacing import (
    CLUSTERED_DIE,
    CLUSTERED_GROUPS,
    EVEN_GROUPS,
    NORMAL_DIE,
    UNIFORM_DIE,
    with_spacing,
)
from icwafer.chips.rules import ruled
from icwafer.chips.spread import Normal

Vector = tuple[float, float, float]
#: Value of an input or property of the node: `use_thin_film` is a flag, `model` a name, `Color`
#: and the like three numbers.
NodeValue = float | bool | str | tuple[float, ...] | list[float]

FAR_MM = 100_000.0


def light_kinds() -> tuple[str, ...]:
    """The lamps that there are, as Blender calls them."""
    return ("POINT", "SPOT", "AREA")


@dataclass(frozen=True)
class Light:
    """A lamp."""

    kind: str = ruled("shape of the lamp", choices=light_kinds)
    position_mm: Vector = ruled("where it stands", -FAR_MM, FAR_MM)
    power_w: float = ruled("radiant power; of a point in all directions", 0, 1e12)
    colour: Vector = ruled("linear Rec.709", 0, 1, default=(1.0, 1.0, 1.0))
    radius_mm: float = ruled(
        "of the glowing ball of a point or spot: larger, softer colours", 0, FAR_MM, default=0.3
    )
    cone_deg: float = ruled("full angle of a spot's cone", 1, 180, default=40.0)
    blend: float = ruled("share of a spot's cone that fades out", 0, 1, default=1.0)
    target_mm: Vector = ruled(
        "where a spot or an area points to", -FAR_MM, FAR_MM, default=(0.0, 0.0, 0.0)
    )
    size_mm: tuple[float, float] = ruled(
        "width and height of an area", 1e-3, FAR_MM, default=(10.0, 10.0)
    )


@dataclass(frozen=True)
class Environment:
    """What surrounds the scene: one colour, or a panorama tinted with it."""

    strength: float = ruled("its radiance, as a factor", 0, 1e6, default=0.0)
    colour: Vector = ruled("linear Rec.709", 0, 1, default=(1.0, 1.0, 1.0))
    image: str = ruled("file of an equirectangular panorama", default="")
    rotation_deg: float = ruled("of the panorama about the vertical", -360, 360, default=0.0)


@dataclass(frozen=True)
class Camera:
    """A camera with a sensor 36 mm wide, upright."""

    position_mm: Vector = ruled("where it stands", -FAR_MM, FAR_MM)
    target_mm: Vector = ruled("what is in the middle of the picture", -FAR_MM, FAR_MM)
    lens_mm: float = ruled("focal length", 1, 5000, default=50.0)


@dataclass(frozen=True)
class View:
    """How linear light becomes the colours of a screen.

    The colours of a grating are so saturated that the plain curve clips them one channel after the
    other, and the bands turn into flat stripes; Filmic lets them run into white softly.
    """

    transform: str = ruled("Blender's view transform", default="Filmic")
    look: str = ruled("Blender's look for that transform", default="Medium High Contrast")
    exposure: float = ruled("in stops", -32, 32, default=0.0)
    gamma: float = ruled("applied last", 0.01, 5, default=1.0)


@dataclass(frozen=True)
class Render:
    """How much is rendered.

    bounces: a flat die under lamps needs none, light that has met it once never meets it again.
    """

    size: tuple[int, int] = ruled("width and height in pixels", 1, 16384, default=(960, 540))
    samples: int = ruled("paths per pixel", 1, 1_000_000, default=48)
    seed: int = ruled("of the renderer's random numbers", 0, 2**31 - 1, default=0)
    bounces: int = ruled("reflections of light from one thing to another", 0, 1024, default=0)


@dataclass(frozen=True)
class Picture:
    """One picture: `caption` says what it shows.

    node: inputs of the node by their names, and its properties; one that is named here is not
    driven by the blocks' attributes.
    """

    caption: str
    die: DieSpec
    lights: tuple[Light, ...]
    camera: Camera
    node: Mapping[str, NodeValue] = field(default_factory=dict)
    environment: Environment = Environment()
    view: View = View()
    render: Render = Render()


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

PICTURES = {
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
