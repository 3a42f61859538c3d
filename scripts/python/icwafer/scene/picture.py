# SPDX-License-Identifier: GPL-2.0-or-later
"""Turns a picture's description into a scene."""

from __future__ import annotations

import dataclasses

import bpy

from icwafer.chips.die import generate
from icwafer.chips.presets import PRESETS
from icwafer.pictures import Picture
from icwafer.scene.camera import camera_object
from icwafer.scene.dust import dust_object
from icwafer.scene.lamps import lamp
from icwafer.scene.material import expect_node, wafer_material
from icwafer.scene.mesh import die_mesh
from icwafer.scene.parts import parts
from icwafer.scene.render import set_render, set_view
from icwafer.scene.response import set_response
from icwafer.scene.studio import table_object
from icwafer.scene.wafer import add_wafer
from icwafer.scene.world import world


def build(picture: Picture) -> bpy.types.Scene:
    """An otherwise empty scene with the picture's die or wafer, lamps and camera, ready to render.

    Raises IcwaferError in a Blender without the node.
    """
    scene = empty_scene()
    add_subject(picture, scene.collection)
    if picture.table.size_mm:
        scene.collection.objects.link(table_object(picture.table))
    for light in picture.lights:
        scene.collection.objects.link(lamp(light))
    scene.camera = camera_object(picture.camera)
    scene.collection.objects.link(scene.camera)
    scene.world = world(picture.environment)
    set_render(scene, picture.render)
    set_response(scene, picture.response)
    set_view(scene, picture.view)
    return scene


def add_subject(picture: Picture, collection: bpy.types.Collection) -> bpy.types.Object:
    """Links the picture's wafer or die, in mm around the origin, to a collection."""
    if picture.wafer:
        ready = PRESETS[picture.wafer]
        layout = dataclasses.replace(ready, dies=(picture.die, *ready.dies[1:]))
        wafer = add_wafer(layout, collection, parts(picture.node, picture.irregular))
        if picture.dust.count:
            dust = dust_object(picture.dust, layout.wafer.usable_radius_mm)
            dust.parent = wafer
            collection.objects.link(dust)
        return wafer
    # On a table a die has the ground between its blocks.
    on_table = picture.table.size_mm > 0
    die = bpy.data.objects.new("Die", die_mesh(generate(picture.die), ground=on_table))
    if on_table:
        materials = parts(picture.node, picture.irregular)
        die.data.materials.append(materials.blocks)
        die.data.materials.append(materials.ground)
    else:
        die.data.materials.append(wafer_material(picture.node))
    collection.objects.link(die)
    return die


def check(picture: Picture) -> None:
    """Tries what depends on this Blender, without building the scene.

    Raises SettingError for the first setting that it refuses.
    """
    scene = empty_scene()
    wafer_material(picture.node)
    set_view(scene, picture.view)


def empty_scene() -> bpy.types.Scene:
    """A scene without anything in it. Raises IcwaferError in a Blender without the node."""
    expect_node()
    bpy.ops.wm.read_factory_settings(use_empty=True)
    return bpy.context.scene
