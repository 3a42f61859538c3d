# SPDX-License-Identifier: GPL-2.0-or-later
"""The library's lamps and its empty studio, placed around a thing of two units in the middle of the scene."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from math import cos, pi, sin
from pathlib import Path

import bpy

from icwafer.pictures import Light, Table
from icwafer.scene.lamps import lamp
from icwafer.scene.library.asset import Asset
from icwafer.scene.library.dies import sample_die
from icwafer.scene.library.stage import LAMPS
from icwafer.scene.studio import table_object


@dataclass(frozen=True)
class Rig:
    """Lamps that belong together; lengths are in units of the scene."""

    name: str
    description: str
    lights: tuple[Light, ...]
    catalog: str = "Lights"
    table: Table = Table()


_TUBE = (0.15, 6.0)
RIGS = (
    Rig(
        "Small Lamp",
        "One small lamp: clear, separate bands of colour",
        (Light("POINT", (3.2, 0.8, 4.6), 1500, radius_mm=0.05),),
    ),
    Rig(
        "Softbox",
        "A large soft lamp from above and behind: washes of colour that pass into one another",
        (Light("AREA", (-1.0, 3.5, 4.0), 45, size_mm=(4.0, 2.5)),),
    ),
    Rig(
        "Strip Lamps",
        "Two narrow lamps at the sides: long streaks, and edges that shine",
        (
            Light("AREA", (-4.0, 1.0, 3.0), 160, size_mm=(0.4, 4.0)),
            Light("AREA", (4.0, 1.0, 3.0), 160, size_mm=(0.4, 4.0)),
        ),
    ),
    Rig(
        "Fluorescent Tubes",
        "Two tubes overhead. Set Illuminant of the materials to Fluorescent F11 for the separate "
        "coloured images that a real wafer shows",
        (
            Light("AREA", (-0.8, 1.0, 5.0), 200, size_mm=_TUBE),
            Light("AREA", (0.8, 1.0, 5.0), 200, size_mm=_TUBE),
        ),
    ),
    Rig(
        "Ring of Lamps",
        "Eight small lamps in a circle: colours whichever way the wires run",
        tuple(
            Light("POINT", (4 * cos(k * pi / 4), 4 * sin(k * pi / 4), 5.0), 120, radius_mm=0.1)
            for k in range(8)
        ),
    ),
    Rig(
        "Empty Studio",
        "A dark table, a softbox that mirrors in the wafer, strips for the edges and a small lamp "
        "for the colours; put a thing of three units on it",
        (
            Light("POINT", (3.2, 0.8, 4.6), 500, radius_mm=0.15),
            Light("AREA", (-1.5, 5.0, 3.5), 80, size_mm=(5.0, 2.5), fade=0.6),
            Light("AREA", (-4.5, -0.5, 1.5), 60, size_mm=(0.3, 4.0), fade=0.3),
            Light("AREA", (4.5, 1.0, 1.0), 40, size_mm=(0.3, 4.0), fade=0.3),
        ),
        catalog="Studios",
        table=Table(size_mm=12.0, depth_mm=0.03),
    ),
)


def assets(_sources: Path, wires_rad: float) -> Iterator[Asset]:
    """A collection for each rig.

    wires_rad: direction of wires that catches the light in a new scene.
    """
    subject = sample_die(wires_rad)
    for rig in RIGS:
        collection = bpy.data.collections.new(rig.name)
        for light in rig.lights:
            thing = lamp(light)
            thing.name = thing.data.name = rig.name
            collection.objects.link(thing)
        if rig.table.size_mm:
            collection.objects.link(table_object(rig.table))
        yield Asset(collection, rig.catalog, rig.description, partial(_show, subject, collection))


def _show(
    subject: bpy.types.Object, rig: bpy.types.Collection, scene: bpy.types.Scene
) -> None:
    """A die in the light of the rig alone."""
    scene.collection.children.unlink(bpy.data.collections[LAMPS])
    scene.collection.children.link(rig)
    scene.collection.objects.link(subject)
