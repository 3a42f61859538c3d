# SPDX-License-Identifier: GPL-2.0-or-later
"""The stage on which previews of assets are photographed: one scene, whose subject changes.

One Blender unit is one unit here; the subjects are about three units large.
"""

from __future__ import annotations

import bmesh
import bpy
import numpy as np

from icwafer.pictures import Camera, Environment, Light, Render, View
from icwafer.scene.camera import camera_object
from icwafer.scene.lamps import lamp
from icwafer.scene.polygons import polygon_mesh
from icwafer.scene.render import set_render, set_view
from icwafer.scene.world import world

#: Wires that catch the light of Blender's new scene show their colours here, too: the camera stands
#: steeper, and the sum of the directions to it and to each of the two small lamps lies across them.
CAMERA = Camera((3.8, -4.38, 5.8), (0.0, 0.0, 0.0), lens_mm=86.0)
LIGHTS = (
    Light("POINT", (3.2, 0.8, 4.6), 600, radius_mm=0.5),
    Light("POINT", (0.15, 1.88, 5.2), 500, radius_mm=0.4),
    Light("AREA", (-2.8, -3.6, 2.2), 120, size_mm=(1.2, 4.0)),
)
LAMPS = "Lamps of the stage"
SURROUNDINGS = Environment(strength=0.08)


def stage(size: int, samples: int) -> bpy.types.Scene:
    """A scene with camera and lamps and nothing else, ready to render square pictures.

    size: side of the picture in pixels. The lamps are in a collection of their own.
    """
    scene = bpy.data.scenes.new("Stage")
    lamps = bpy.data.collections.new(LAMPS)
    scene.collection.children.link(lamps)
    for light in LIGHTS:
        lamps.objects.link(lamp(light))
    scene.camera = camera_object(CAMERA)
    scene.collection.objects.link(scene.camera)
    scene.world = world(SURROUNDINGS)
    set_render(scene, Render((size, size), samples, seed=1, bounces=2))
    set_view(scene, View())
    # The browser's own background is behind the subject.
    scene.render.film_transparent = True
    scene.render.image_settings.color_mode = "RGBA"
    return scene


def ball() -> bpy.types.Object:
    """A smooth ball that fills the picture."""
    mesh = bpy.data.meshes.new("Ball")
    shape = bmesh.new()
    bmesh.ops.create_uvsphere(shape, u_segments=64, v_segments=32, radius=1.4)
    shape.to_mesh(mesh)
    shape.free()
    mesh.polygons.foreach_set("use_smooth", np.ones(len(mesh.polygons), dtype=bool))
    return bpy.data.objects.new("Ball", mesh)


def disc(radius: float = 1.5, segments: int = 128) -> bpy.types.Object:
    """A flat disc with a hole, as a compact disc has it (15 mm in 120 mm)."""
    angle = np.linspace(0.0, 2 * np.pi, segments, endpoint=False)
    circle = radius * np.stack([np.cos(angle), np.sin(angle), np.zeros(segments)], axis=1)
    index = np.arange(segments)
    following = np.roll(index, -1)
    faces = np.stack([index, index + segments, following + segments, following], axis=1)
    mesh = polygon_mesh("Disc", np.concatenate([15 / 120 * circle, circle]), [faces])
    return bpy.data.objects.new("Disc", mesh)
