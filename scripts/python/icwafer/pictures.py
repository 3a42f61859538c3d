# SPDX-License-Identifier: GPL-2.0-or-later
"""The eight pictures as data: which die, which effects, lit and seen how, and what each one shows.

Lengths are in millimetres, and so is the scene: 1 Blender unit is 1 mm. The die lies in the plane
z = 0 with its centre at the origin.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from icwafer.die import DieSpec, Group, Spread, with_spacing
from icwafer.floorplan import Kind

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
    caption: str
    die: DieSpec
    lights: tuple[Light, ...]
    camera: Camera
    effects: Effects = Effects()
    lobe_width: float = 0.02
    specular_roughness: float = 0.2
    exposure_stops: float = 0.0
    look: str = "Medium High Contrast"
    size: tuple[int, int] = (960, 540)
    samples: int = 64


CLUSTERED = (
    Group("core logic", Kind.LOGIC, Spread(1080, 7), diffraction=Spread(0.5, 0.04), weight=0.8),
    Group("wide logic", Kind.LOGIC, Spread(960, 14), diffraction=Spread(0.45, 0.06), weight=0.2, turned=1),
    Group("cache", Kind.MEMORY, Spread(1190, 6), diffraction=Spread(0.6, 0.03), weight=0.7),
    Group("register file", Kind.MEMORY, Spread(1000, 10), diffraction=Spread(0.6, 0.05), weight=0.3, turned=1),
    Group("analog", Kind.ANALOG, Spread(1270, 12), diffraction=Spread(0.35, 0.04), turned=0.5),
    Group("pads", Kind.IO, Spread(920, 15), diffraction=Spread(0.4, 0.05)),
    Group("channel", Kind.STRIP, Spread(1000), diffraction=Spread(0.0)),
)

OBLIQUE = Camera(position_mm=(1.5, -19.0, 15.0), target_mm=(0.0, -0.6, 0.0), lens_mm=58)

PICTURES = {
    "full": Picture(
        caption="",
        die=DieSpec(CLUSTERED, seed=1),
        lights=(
            Light("POINT", (-12.0, -9.0, 12.0), 9000),
            Light("SPOT", (10.0, 4.0, 22.0), 12000, colour=(1, 0.9, 0.8)),
        ),
        camera=OBLIQUE,
    ),
}
