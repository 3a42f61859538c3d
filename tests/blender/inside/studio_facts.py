# SPDX-License-Identifier: GPL-2.0-or-later
"""Cameras, softboxes, cards and tables as Blender has them; inside Blender.

Parameters: package (the folder of the Python package), folder (for images), lattice (places on the
wafer's plane, in mm). Answers with where the photograph's camera sees them, in shares of the
picture from its lower left corner. Writes an image of 64 x 36 pixels for each scene below.
"""

from __future__ import annotations

import dataclasses
import sys
from pathlib import Path

import exchange

PARAMETERS = exchange.parameters()
sys.path.insert(0, PARAMETERS["package"])

import bpy  # noqa: E402
import numpy as np  # noqa: E402
from bpy_extras.object_utils import world_to_camera_view  # noqa: E402
from mathutils import Vector  # noqa: E402

from icwafer.pictures import (  # noqa: E402
    PICTURES,
    Camera,
    Dust,
    Light,
    Render,
    Response,
    Table,
    View,
)
from icwafer.scene.camera import camera_object  # noqa: E402
from icwafer.scene.dust import dust_object  # noqa: E402
from icwafer.scene.lamps import lamp  # noqa: E402
from icwafer.scene.parts import metal_material  # noqa: E402
from icwafer.scene.picture import empty_scene  # noqa: E402
from icwafer.scene.polygons import polygon_mesh  # noqa: E402
from icwafer.scene.render import set_render, set_view  # noqa: E402
from icwafer.scene.response import set_response  # noqa: E402
from icwafer.scene.studio import table_object  # noqa: E402

#: Straight above; a mirror below it shows what hangs beside it.
ABOVE = Camera((0.0, 0.0, 100.0), (0.0, 0.0, 0.0), lens_mm=36.0)
SOFTBOX = Light("AREA", (0.0, 0.0, 101.0), 1e5, size_mm=(80.0, 40.0))
CARD = dataclasses.replace(SOFTBOX, kind="CARD")
COLOUR = (0.9, 0.3, 0.1)
#: Where its own light falls on the camera's side of what it sees.
FACING = Camera((0.0, 0.0, -100.0), (0.0, 0.0, 101.0), lens_mm=36.0)


def metal(roughness: float, colour: tuple[float, ...] = (1.0, 1.0, 1.0)) -> bpy.types.Object:
    corners = np.array([(-90, -90, 0), (90, -90, 0), (90, 90, 0), (-90, 90, 0)])
    mesh = polygon_mesh("Plane", corners, [np.arange(4)[None]])
    mesh.materials.append(metal_material("Metal", colour, roughness))
    return bpy.data.objects.new("Plane", mesh)


def faded(light: Light) -> Light:
    return dataclasses.replace(light, fade=1.0)


#: What stands in each scene, made after the last one was cleared, and who sees it.
SCENES = {
    "softbox": (lambda: (metal(0.0), lamp(SOFTBOX)), ABOVE),
    "softbox_faded": (lambda: (metal(0.0), lamp(faded(SOFTBOX))), ABOVE),
    "card": (lambda: (metal(0.0), lamp(CARD)), ABOVE),
    "card_faded": (lambda: (metal(0.0), lamp(faded(CARD))), ABOVE),
    "card_turned": (lambda: (metal(0.0), lamp(dataclasses.replace(CARD, turn_deg=90.0))), ABOVE),
    "card_itself": (lambda: (lamp(CARD),), FACING),
    "table": (
        lambda: (table_object(Table(60.0, (1.0, 1.0, 1.0), 0.5, 0.0)), lamp(SOFTBOX)),
        ABOVE,
    ),
    "dust": (lambda: (dust_object(Dust(200, 500.0), 20.0), lamp(SOFTBOX)), ABOVE),
    "coloured": (lambda: (metal(0.0, COLOUR), lamp(SOFTBOX)), ABOVE),
    "richer": (lambda: (metal(0.0, COLOUR), lamp(SOFTBOX)), ABOVE),
    "glowing": (lambda: (metal(0.0, COLOUR), lamp(SOFTBOX)), ABOVE),
}
RESPONSES = {"richer": Response(saturation=2.0), "glowing": Response(glow=0.1)}


def render(name: str) -> None:
    make, camera = SCENES[name]
    scene = empty_scene()
    for thing in make():
        scene.collection.objects.link(thing)
    scene.camera = camera_object(camera)
    scene.collection.objects.link(scene.camera)
    set_render(scene, Render((64, 36), 64, bounces=1))
    set_response(scene, RESPONSES.get(name, Response()))
    set_view(scene, View("Standard", "None"))
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.filepath = str(Path(PARAMETERS["folder"]) / name)
    bpy.ops.render.render(write_still=True)


def seen() -> list[list[float]]:
    picture = PICTURES["photograph"]
    scene = empty_scene()
    scene.camera = camera_object(picture.camera)
    scene.collection.objects.link(scene.camera)
    set_render(scene, picture.render)
    bpy.context.view_layer.update()
    return [
        list(world_to_camera_view(scene, scene.camera, Vector((*place, 0.0))))[:2]
        for place in PARAMETERS["lattice"]
    ]


places = seen()
for scene_name in SCENES:
    render(scene_name)
exchange.report({"seen": places})
