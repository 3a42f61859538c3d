# SPDX-License-Identifier: GPL-2.0-or-later
"""The library's materials, from the table of presets."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from pathlib import Path

import bpy

from icwafer.assets.materials import FILE_NAME, read_materials
from icwafer.scene.library.asset import Asset
from icwafer.scene.library.dies import sample_die
from icwafer.scene.library.stage import ball, disc
from icwafer.scene.presets import preset_material


def assets(sources: Path, wires_rad: float) -> Iterator[Asset]:
    """All materials of the table in the folder of the library's sources.

    wires_rad: direction of wires that catches the light in a new scene.
    """
    for preset in read_materials(sources / FILE_NAME):
        material = preset_material(preset, wires_rad)
        if preset.from_attributes:
            subject = sample_die(wires_rad)
        elif preset.round_tracks:
            subject = disc()
        else:
            subject = ball()
        text = f"{preset.description}. Source: {preset.source}"
        yield Asset(material, preset.catalog, text, partial(_show, subject, material))


def _show(
    subject: bpy.types.Object, material: bpy.types.Material, scene: bpy.types.Scene
) -> None:
    subject.data.materials.clear()
    subject.data.materials.append(material)
    scene.collection.objects.link(subject)
