# SPDX-License-Identifier: GPL-2.0-or-later
"""The library's materials, from the table of presets."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial
from pathlib import Path

import bpy

from icwafer.assets.materials import FILE_NAME, read_materials
from icwafer.chips.die import generate
from icwafer.chips.presets import PRESETS
from icwafer.scene.library.asset import Asset
from icwafer.scene.library.stage import ball, disc
from icwafer.scene.mesh import die_mesh
from icwafer.scene.presets import preset_material

#: In Blender's new scene the bisector of lamp and camera, seen from above the middle of the grid,
#: points to -21.4 degrees. Wires across that line send their colours to the camera.
DIRECTION_RAD = math.radians(68.6)


def assets(sources: Path) -> Iterator[Asset]:
    """All materials of the table in the folder of the library's sources."""
    for preset in read_materials(sources / FILE_NAME):
        material = preset_material(preset, DIRECTION_RAD)
        if preset.from_attributes:
            subject = _die()
        elif preset.round_tracks:
            subject = disc()
        else:
            subject = ball()
        text = f"{preset.description}. Source: {preset.source}"
        yield Asset(material, preset.catalog, text, partial(_show, subject, material))


def _die() -> bpy.types.Object:
    spec = PRESETS["eight-core"].dies[0]
    die = bpy.data.objects.new("Die", die_mesh(generate(spec)))
    die.scale = (2.4 / spec.width_mm,) * 3
    return die


def _show(
    subject: bpy.types.Object, material: bpy.types.Material, scene: bpy.types.Scene
) -> None:
    subject.data.materials.append(material)
    scene.collection.objects.link(subject)
