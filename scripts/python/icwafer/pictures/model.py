# SPDX-License-Identifier: GPL-2.0-or-later
"""What a picture is made of, as data: which die or wafer, which effects, lit and seen how.

Lengths are in millimetres, and so is the scene: 1 Blender unit is 1 mm. The die or the wafer's
front lies in the plane z = 0 with its centre at the origin.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from icwafer.chips.model import DieSpec
from icwafer.chips.rules import ruled

Vector = tuple[float, float, float]
#: Value of an input or property of the node: `use_thin_film` is a flag, `model` a name, `Color`
#: and the like three numbers.
NodeValue = float | bool | str | tuple[float, ...] | list[float]

FAR_MM = 100_000.0


def light_kinds() -> tuple[str, ...]:
    """The lamps that there are, as Blender calls them, and cards.

    A card is an area that only reflections show: it costs no samples where it is not mirrored, and
    throws no light that a grating could spread.
    """
    return ("POINT", "SPOT", "AREA", "CARD")


def wafer_names() -> tuple[str, ...]:
    """The ready layouts that have a wafer, and none."""
    from icwafer.chips.presets import PRESETS

    return ("", *(name for name, layout in PRESETS.items() if layout.wafer))


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
        "where a spot, an area or a card points to", -FAR_MM, FAR_MM, default=(0.0, 0.0, 0.0)
    )
    size_mm: tuple[float, float] = ruled(
        "width and height of an area or a card", 1e-3, FAR_MM, default=(10.0, 10.0)
    )
    fade: float = ruled(
        "share of an area or a card over which its light fades out to the edges, as in a softbox",
        0,
        1,
        default=0.0,
    )
    turn_deg: float = ruled("of an area or a card about its own axis", -360, 360, default=0.0)


@dataclass(frozen=True)
class Environment:
    """What surrounds the scene: one colour, or a panorama tinted with it."""

    strength: float = ruled("its radiance, as a factor", 0, 1e6, default=0.0)
    colour: Vector = ruled("linear Rec.709", 0, 1, default=(1.0, 1.0, 1.0))
    image: str = ruled("file of an equirectangular panorama", default="")
    rotation_deg: float = ruled("of the panorama about the vertical", -360, 360, default=0.0)


@dataclass(frozen=True)
class Table:
    """What a wafer lies on: a plane, fading into the dark with the distance from the middle."""

    size_mm: float = ruled("radius at which it is dark, 0 for no table", 0, FAR_MM, default=0.0)
    colour: Vector = ruled("linear Rec.709", 0, 1, default=(0.02, 0.02, 0.022))
    roughness: float = ruled("0 polished, 1 matt", 0, 1, default=0.3)
    depth_mm: float = ruled("how far below the front of the wafer", 0, FAR_MM, default=0.8)


@dataclass(frozen=True)
class Irregular:
    """Metal without a regular pattern: lanes, pads, and the share of a block that does not
    diffract. Edges at random spread light widely and hardly colour it."""

    colour: Vector = ruled("linear Rec.709", 0, 1, default=(0.10, 0.10, 0.11))
    roughness: float = ruled("0 polished, 1 matt", 0, 1, default=0.4)


@dataclass(frozen=True)
class Dust:
    """Grains that lie on a wafer, at random places."""

    count: int = ruled("how many", 0, 100_000, default=0)
    size_um: float = ruled("median diameter; one in six is twice as large", 1, 1000, default=60.0)
    seed: int = ruled("start of the random numbers", 0, 2**32 - 1, default=1)


@dataclass(frozen=True)
class Camera:
    """A camera with a sensor 36 mm wide."""

    position_mm: Vector = ruled("where it stands", -FAR_MM, FAR_MM)
    target_mm: Vector = ruled("what is in the middle of the picture", -FAR_MM, FAR_MM)
    lens_mm: float = ruled("focal length", 1, 5000, default=50.0)
    roll_deg: float = ruled("turned clockwise from upright", -360, 360, default=0.0)
    f_stop: float = ruled(
        "focal length over aperture; sharp is what is as far as the target, with 0 all is",
        0,
        1000,
        default=0.0,
    )


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
class Response:
    """What lens and camera make of the light, before the view; the saved picture has it."""

    saturation: float = ruled(
        "distance of colours from grey, as a factor, negative light cut off: cameras make colours "
        "richer, and lights of one wavelength are paler here than they are",
        0,
        4,
        default=1.0,
    )
    glow: float = ruled("share of light that the lens scatters around", 0, 1, default=0.0)


@dataclass(frozen=True)
class Render:
    """How much is rendered.

    bounces: a flat die under lamps needs none, light that has met it once never meets it again.
    """

    size: tuple[int, int] = ruled("width and height in pixels", 1, 16384, default=(960, 540))
    samples: int = ruled("paths per pixel", 1, 1_000_000, default=48)
    seed: int = ruled("of the renderer's random numbers", 0, 2**31 - 1, default=0)
    noise: float = ruled(
        "a pixel with less noise than this takes no more samples; 0: all take as many",
        0,
        1,
        default=0.0,
    )
    bounces: int = ruled("reflections of light from one thing to another", 0, 1024, default=0)


@dataclass(frozen=True)
class Picture:
    """One picture: `caption` says what it shows.

    wafer: the ready layout whose wafer is shown, full of `die`; none for the die alone.
    node: inputs of the node by their names, and its properties; one that is named here is not
    driven by the blocks' attributes.
    """

    caption: str
    die: DieSpec
    lights: tuple[Light, ...]
    camera: Camera
    node: Mapping[str, NodeValue] = field(default_factory=dict)
    wafer: str = ruled("wafer full of the die, none for one die", choices=wafer_names, default="")
    irregular: Irregular = Irregular()
    dust: Dust = Dust()
    table: Table = Table()
    environment: Environment = Environment()
    response: Response = Response()
    view: View = View()
    render: Render = Render()
