# SPDX-License-Identifier: GPL-2.0-or-later
"""The pictures of the manual page as data: which values of each input are shown, side by side.

All show one watch glass, seen and lit from about the same place, so that its slope at a point
says how far light is deflected there: the mirror image of the lamp is in the middle, colours lie at both
sides of it, across the wires. `render_pictures.py` renders them.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

PICTURES = Path(__file__).resolve().parent / "pictures"

#: A value of an input or property of the node.
Value = float | str | bool | tuple[float, float, float]


@dataclass(frozen=True)
class Panel:
    """One render. values: of inputs by their names and of the node's properties, beside the
    sweep's own. bumps: strength of bumps that drive Normal. round: Tangent runs around the axis.
    """

    label: str
    values: Mapping[str, Value]
    bumps: float = 0.0
    round: bool = False


@dataclass(frozen=True)
class Sweep:
    """Renders side by side: `name` is the input or property that they show.

    base: what all panels have in common, beside the node's own defaults. note: what `base` means
    to the reader, if anything.
    """

    name: str
    panels: tuple[Panel, ...]
    base: Mapping[str, Value] = field(default_factory=dict)
    note: str = ""

    def file(self, panel: Panel) -> Path:
        """Where the picture of a panel is."""
        number = self.panels.index(panel) + 1
        return PICTURES / f"{self.name.lower().replace(' ', '_')}-{number}.jpg"

    def description(self, panel: Panel) -> str:
        """What a panel's picture follows from, but for the node's defaults and the scene."""
        return json.dumps({**vars(panel), "values": {**self.base, **panel.values}})


def _swept(
    name: str,
    unit: str,
    *values: float,
    base: Mapping[str, Value] | None = None,
    note: str = "",
) -> Sweep:
    """A float input at some values."""
    panels = (Panel(f"{value:g} {unit}".strip(), {name: float(value)}) for value in values)
    return Sweep(name, tuple(panels), base or {}, note)


def _choices(name: str, labels: Mapping[str, str], note: str = "", **base: Value) -> Sweep:
    """A menu at its entries, by the names that scripts use."""
    panels = (Panel(label, {name.lower(): key}) for key, label in labels.items())
    return Sweep(name, tuple(panels), base, note)


_RADIAN = 0.017453292519943295
_CS348B: dict[str, Value] = {"model": "CS348B"}
_CUSTOM_METAL: dict[str, Value] = {"metal": "CUSTOM"}

SWEEPS = {
    sweep.name: sweep
    for sweep in (
        Sweep(
            "Color",
            (
                Panel("white", {"Color": (1.0, 1.0, 1.0)}),
                Panel("gold", {"Color": (1.0, 0.7, 0.25)}),
                Panel("blue", {"Color": (0.25, 0.45, 1.0)}),
            ),
        ),
        _swept("Wire Spacing", "nm", 700, 1000, 2000),
        _swept("Wire Width", "nm", 100, 250, 500),
        _swept("Oxide Thickness", "nm", 0, 250, 530),
        _swept("Oxide IOR", "", 1.0, 1.544, 2.5, base={"oxide": "CUSTOM"}, note="Oxide: Custom"),
        Sweep(
            "Direction",
            tuple(Panel(f"{deg}°", {"Direction": deg * _RADIAN}) for deg in (0, 45, 90)),
        ),
        Sweep(
            "Normal",
            (
                Panel("nothing linked", {}),
                Panel("slight bumps", {}, bumps=0.04),
                Panel("strong bumps", {}, bumps=0.2),
            ),
        ),
        Sweep(
            "Tangent",
            (
                Panel("nothing linked", {}),
                Panel("around the axis", {}, round=True),
                Panel("the same, Direction 90°", {"Direction": 90 * _RADIAN}, round=True),
            ),
        ),
        _swept("Groove Depth", "nm", 50, 150, 300),
        _swept(
            "Cross Spacing", "nm", 0, 1000, 3000, base={"Cross Width": 400.0}, note="Cross Width 400"
        ),
        _swept(
            "Cross Width", "nm", 100, 400, 800,
            base={"Cross Spacing": 1200.0}, note="Cross Spacing 1200",
        ),
        _swept("Spacing Variation", "", 0, 0.05, 0.15),
        _swept("Coherence Width", "µm", 3, 10, 100, base={"Roughness": 0.0}, note="Roughness 0"),
        _swept("Wire Length", "µm", 0.5, 2, 50),
        _swept("Roughness", "", 0, 0.2, 0.4),
        _choices("Metal", {"COPPER": "Copper", "ALUMINIUM": "Aluminium", "TUNGSTEN": "Tungsten",
                           "SILICON": "Silicon"}),
        Sweep(
            "Metal n",
            tuple(
                Panel(f"{n[0]:g}, {n[1]:g}, {n[2]:g}", {"Metal n": n})
                for n in ((0.2, 0.4, 1.4), (0.27, 0.68, 1.3), (2.8, 2.8, 2.3))
            ),
            _CUSTOM_METAL,
            "Metal: Custom",
        ),
        Sweep(
            "Metal k",
            tuple(
                Panel(f"{k[0]:g}, {k[1]:g}, {k[2]:g}", {"Metal k": k})
                for k in ((1.0, 1.0, 1.0), (3.4, 2.62, 2.4), (7.0, 6.0, 5.0))
            ),
            _CUSTOM_METAL,
            "Metal: Custom",
        ),
        _choices("Oxide", {"SIO2": "Silicon Dioxide", "SI3N4": "Silicon Nitride",
                           "CUSTOM": "Custom, 1.544"}),
        _choices("Illuminant",
                 {"EQUAL_ENERGY": "Equal Energy", "D65": "D65", "A": "Tungsten A", "F2": "F2",
                  "F11": "F11", "WHITE_LED": "White LED", "SODIUM": "Sodium"},
                 "Coherence Width 60, Roughness 0",
                 **{"Coherence Width": 60.0, "Roughness": 0.0}),
        _swept("Diffraction", "", 0.1, 0.5, 1, base=_CS348B),
        _swept("Specular", "", 0, 0.3, 1, base=_CS348B),
        _swept("Specular Roughness", "", 0.05, 0.15, 0.4, base=_CS348B),
        _swept("Diffuse", "", 0, 0.2, 0.6, base=_CS348B),
        _swept("Lobe Width", "", 0.003, 0.015, 0.1, base=_CS348B),
        _swept("Anisotropy", "", 0, 1, 4, base=_CS348B),
        Sweep(
            "Effects",
            (
                Panel("Grating alone", {"use_thin_film": False, "use_wire_diffraction": False}),
                Panel("Thin Film alone", {"use_grating": False, "use_wire_diffraction": False}),
                Panel("Wire Diffraction alone", {"use_grating": False, "use_thin_film": False}),
                Panel("all three", {}),
            ),
            _CS348B | {"Wire Width": 500.0},
        ),
    )
}  # fmt: skip
