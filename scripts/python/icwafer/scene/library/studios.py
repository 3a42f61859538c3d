# SPDX-License-Identifier: GPL-2.0-or-later
"""The library's whole scenes, from the project's pictures: wafer, lamps, table and camera.

A picture is in millimetres; an asset is `LARGE` units of the scene. Everything is made smaller
together, the lamps' power with the square of that, so that it looks the same.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from pathlib import Path

import bpy
from mathutils import Matrix

from icwafer.chips.presets import PRESETS
from icwafer.pictures import PICTURES, Light, Picture, Vector
from icwafer.scene.camera import camera_object
from icwafer.scene.lamps import lamp
from icwafer.scene.library.asset import LARGE, Asset
from icwafer.scene.library.stage import LAMPS
from icwafer.scene.picture import add_subject
from icwafer.scene.studio import table_object

#: The pictures, and what their scenes are called.
SCENES = {
    "photograph": "After a Photograph",
    "wafer_studio": "Wafer Studio",
    "wafer_fluorescent": "Fluorescent Studio",
    "die_studio": "Die Studio",
}


def assets(_sources: Path, _wires_rad: float) -> Iterator[Asset]:
    """A collection for each scene."""
    for name, title in SCENES.items():
        picture = PICTURES[name]
        collection = bpy.data.collections.new(title)
        thing = add_subject(picture, collection)
        scale = LARGE / max(side_mm(picture))
        thing.matrix_world = Matrix.Scale(scale, 4)
        small = smaller(picture, scale)
        if small.table.size_mm:
            collection.objects.link(table_object(small.table))
        for light in small.lights:
            collection.objects.link(lamp(light))
        camera = camera_object(small.camera)
        collection.objects.link(camera)
        text = f"{picture.caption} Append it to have its camera, too"
        yield Asset(collection, "Studios", text, partial(_show, collection, camera))


def side_mm(picture: Picture) -> tuple[float, float]:
    """Extent of what a picture shows along x and y."""
    if picture.wafer:
        diameter_mm = PRESETS[picture.wafer].wafer.diameter_mm
        return diameter_mm, diameter_mm
    return picture.die.width_mm, picture.die.height_mm


def smaller(picture: Picture, scale: float) -> Picture:
    """The same picture of smaller things."""

    def scaled(length: Vector) -> Vector:
        return tuple(scale * part for part in length)

    def light(light: Light) -> Light:
        return replace(
            light,
            position_mm=scaled(light.position_mm),
            target_mm=scaled(light.target_mm),
            size_mm=scaled(light.size_mm),
            radius_mm=scale * light.radius_mm,
            power_w=scale**2 * light.power_w,
        )

    table, camera = picture.table, picture.camera
    return replace(
        picture,
        lights=tuple(map(light, picture.lights)),
        table=replace(table, size_mm=scale * table.size_mm, depth_mm=scale * table.depth_mm),
        camera=replace(
            camera,
            position_mm=scaled(camera.position_mm),
            target_mm=scaled(camera.target_mm),
            f_stop=camera.f_stop / scale,
        ),
    )


def _show(
    collection: bpy.types.Collection, camera: bpy.types.Object, scene: bpy.types.Scene
) -> None:
    scene.collection.children.unlink(bpy.data.collections[LAMPS])
    scene.collection.children.link(collection)
    scene.camera = camera
