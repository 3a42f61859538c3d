# SPDX-License-Identifier: GPL-2.0-or-later
"""The library's dies: one of each preset."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from pathlib import Path

import bpy

from icwafer.chips.die import generate, main_direction_rad
from icwafer.chips.model import Die
from icwafer.chips.presets import PRESETS, TITLES
from icwafer.scene.library.asset import Asset, posed, show_at, show_collection
from icwafer.scene.mesh import die_mesh
from icwafer.scene.parts import Parts, parts


def assets(_sources: Path, wires_rad: float) -> Iterator[Asset]:
    """A collection for each preset; all of them share their materials.

    wires_rad: direction of wires that catches the light in a new scene.
    """
    materials = parts()
    for preset, layout in PRESETS.items():
        title, text = TITLES[preset]
        spec = layout.dies[0]
        thing = _object(title, generate(spec), materials, wires_rad)
        collection = posed(thing, title)
        text += f". {spec.width_mm:g} x {spec.height_mm:g} mm"
        yield Asset(collection, "Dies", text, partial(show_collection, collection))


def sample_die(wires_rad: float) -> bpy.types.Object:
    """A die to show other assets on."""
    return _object("Die", generate(PRESETS["eight-core"].dies[0]), parts(), wires_rad)


def _object(name: str, die: Die, materials: Parts, wires_rad: float) -> bpy.types.Object:
    mesh = die_mesh(die, ground=True)
    mesh.name = name
    for material in (materials.blocks, materials.ground):
        mesh.materials.append(material)
    thing = bpy.data.objects.new(name, mesh)
    show_at(thing, max(die.spec.width_mm, die.spec.height_mm), main_direction_rad(die), wires_rad)
    return thing
