# SPDX-License-Identifier: GPL-2.0-or-later
"""The attributes of meshes that the node's inputs take their values from.

A mesh from elsewhere may carry them, too, and a material may use them in its own way.
"""

from __future__ import annotations

from dataclasses import dataclass, fields

from icwafer.chips.model import Group
from icwafer.chips.rules import rule_of


@dataclass(frozen=True)
class Attribute:
    """A named quantity of each face, or of each instance: of each die on a wafer.

    unit: "nm", "radian", or empty for a number without one. socket: the node's input that it
    drives; empty where it changes several.
    """

    name: str
    unit: str
    meaning: str
    socket: str


def _of_group(field_name: str, socket: str) -> Attribute:
    """The attribute of what a group says about its blocks."""
    field = next(field for field in fields(Group) if field.name == field_name)
    unit = "nm" if field_name.endswith("_nm") else ""
    return Attribute(f"ic_{field_name}", unit, rule_of(field).help, socket)


#: Of each face: of each block of a die.
OF_FACES = (
    _of_group("spacing_nm", "Wire Spacing"),
    _of_group("width_nm", "Wire Width"),
    _of_group("oxide_nm", "Oxide Thickness"),
    Attribute(
        "ic_direction_rad",
        "radian",
        "direction of the wires, counter-clockwise from the object's x",
        "Direction",
    ),
    _of_group("diffraction", "Diffraction"),
    _of_group("spacing_variation", "Spacing Variation"),
    _of_group("cross_spacing_nm", "Cross Spacing"),
    _of_group("cross_width_nm", "Cross Width"),
    _of_group("groove_nm", "Groove Depth"),
)

#: What of a die drifts over a wafer: the components of `DRIFT`, in their order.
DRIFTING = ("oxide", "groove", "width")

#: Of each die on a wafer, as an attribute of the instance: a value is to be taken 1 + drift times.
#: A vector, and no number for each, because every attribute that a material reads takes time.
DRIFT = Attribute(
    "ic_drift",
    "",
    "how much thicker the oxide (x), deeper the grooves (y) and wider the wires (z) are here",
    "",
)
OF_INSTANCES = (DRIFT,)
