# SPDX-License-Identifier: GPL-2.0-or-later
"""Turns a picture's description into a Blender scene. Runs inside Blender only."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import bpy
import numpy as np
from mathutils import Vector

from icwafer.chips.die import generate
from icwafer.chips.model import MM, UM, Die
from icwafer.errors import IcwaferError, SettingError
from icwafer.pictures import Camera, Environment, Light, NodeValue, Picture, Render, View

NODE = "ShaderNodeBsdfICWafer"
GAP_NM = 8 * UM  # the dark line between two blocks: one pixel in a picture of a whole die

# The face attributes that a die's mesh carries, and the sockets that each one drives.
SOCKET_OF_ATTRIBUTE = {
    "ic_spacing_nm": "Wire Spacing",
    "ic_width_nm": "Wire Width",
    "ic_oxide_nm": "Oxide Thickness",
    "ic_direction_rad": "Direction",
    "ic_diffraction": "Diffraction",
    "ic_spacing_variation": "Spacing Variation",
    "ic_cross_spacing_nm": "Cross Spacing",
    "ic_cross_width_nm": "Cross Width",
    "ic_groove_nm": "Groove Depth",
}

#: Blender's names for the fields of a View, in the order in which they depend on each other.
VIEW_ATTRIBUTES = {
    "transform": "view_transform",
    "look": "look",
    "exposure": "exposure",
    "gamma": "gamma",
}


def build(picture: Picture) -> bpy.types.Scene:
    """An otherwise empty scene with the picture's die, lamps and camera, ready to render.

    Raises IcwaferError in a Blender without the node.
    """
    scene = _empty_scene()
    die = bpy.data.objects.new("Die", die_mesh(generate(picture.die)))
    die.data.materials.append(wafer_material(picture.node))
    scene.collection.objects.link(die)
    for light in picture.lights:
        scene.collection.objects.link(_lamp(light))
    scene.camera = _camera(picture.camera)
    scene.collection.objects.link(scene.camera)
    scene.world = _world(picture.environment)
    set_render(scene, picture.render)
    set_view(scene, picture.view)
    return scene


def check(picture: Picture) -> None:
    """Tries what depends on this Blender, without building the scene.

    Raises SettingError for the first setting that it refuses.
    """
    scene = _empty_scene()
    wafer_material(picture.node)
    set_view(scene, picture.view)


def expect_node() -> None:
    """Raises IcwaferError in a Blender without the node."""
    if not hasattr(bpy.types, NODE):
        raise IcwaferError(
            "this Blender has no IC Wafer BSDF node: build one that has, "
            "with scripts/icwafer build blender"
        )


def _empty_scene() -> bpy.types.Scene:
    expect_node()
    bpy.ops.wm.read_factory_settings(use_empty=True)
    return bpy.context.scene


def die_mesh(die: Die) -> bpy.types.Mesh:
    """One face per block in the plane z = 0, in mm around the origin; attributes hold the wires.

    The faces leave gaps between them, at most a fifth of a block on each side.
    """
    rect_nm = die.rect_nm.astype(np.float64)
    sides_nm = rect_nm[:, 2:] - rect_nm[:, :2]
    inset_nm = np.minimum(GAP_NM / 2, 0.2 * sides_nm)
    centre_mm = np.array([die.spec.width_mm, die.spec.height_mm]) / 2
    low = (rect_nm[:, :2] + inset_nm) / MM - centre_mm
    high = (rect_nm[:, 2:] - inset_nm) / MM - centre_mm

    corners = np.zeros((len(die), 4, 3), dtype=np.float32)
    corners[:, [0, 3], 0], corners[:, [1, 2], 0] = low[:, :1], high[:, :1]
    corners[:, [0, 1], 1], corners[:, [2, 3], 1] = low[:, 1:], high[:, 1:]

    mesh = bpy.data.meshes.new("Die")
    mesh.vertices.add(4 * len(die))
    mesh.vertices.foreach_set("co", corners.ravel())
    mesh.loops.add(4 * len(die))
    mesh.loops.foreach_set("vertex_index", np.arange(4 * len(die), dtype=np.int32))
    mesh.polygons.add(len(die))
    mesh.polygons.foreach_set("loop_start", np.arange(0, 4 * len(die), 4, dtype=np.int32))
    mesh.polygons.foreach_set("loop_total", np.full(len(die), 4, dtype=np.int32))
    mesh.update(calc_edges=True)
    for name in SOCKET_OF_ATTRIBUTE:
        values = getattr(die, name.removeprefix("ic_"))
        mesh.attributes.new(name, "FLOAT", "FACE").data.foreach_set("value", values)
    return mesh


def wafer_material(values: Mapping[str, NodeValue]) -> bpy.types.Material:
    """A material whose IC Wafer BSDF takes its wires from the attributes of the mesh.

    values: of the node's inputs and properties; an input that is named here takes no attribute.
    """
    material = bpy.data.materials.new("Wafer")
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    wafer = tree.nodes.new(NODE)
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    output.location.x = 300
    tree.links.new(wafer.outputs["BSDF"], output.inputs["Surface"])
    for row, (attribute, socket) in enumerate(SOCKET_OF_ATTRIBUTE.items()):
        source = tree.nodes.new("ShaderNodeAttribute")
        source.attribute_name = attribute
        source.location = (-300, -200 * row)
        tree.links.new(source.outputs["Fac"], wafer.inputs[socket])
    set_node(tree, wafer, values)
    return material


def set_node(
    tree: bpy.types.NodeTree, wafer: bpy.types.Node, values: Mapping[str, NodeValue]
) -> None:
    """Gives inputs (by name) and properties of an IC Wafer BSDF a value, linked or not."""
    for name, value in values.items():
        if name in wafer.inputs:
            for link in wafer.inputs[name].links:
                tree.links.remove(link)
            opaque = wafer.inputs[name].type == "RGBA"
            wafer.inputs[name].default_value = (*value, 1.0) if opaque else value
        else:
            assign(wafer, name, value, f"node.{name}")


def _lamp(light: Light) -> bpy.types.Object:
    data = bpy.data.lights.new(light.kind.title(), light.kind)
    data.energy = light.power_w
    data.color = light.colour
    if light.kind == "AREA":
        data.shape = "RECTANGLE"
        data.size, data.size_y = light.size_mm
    else:
        data.shadow_soft_size = light.radius_mm
    if light.kind == "SPOT":
        data.spot_size = math.radians(light.cone_deg)
        data.spot_blend = light.blend
    return _aimed(bpy.data.objects.new(data.name, data), light.position_mm, light.target_mm)


def _camera(camera: Camera) -> bpy.types.Object:
    data = bpy.data.cameras.new("Camera")
    data.lens = camera.lens_mm
    data.clip_end = 1000.0
    return _aimed(bpy.data.objects.new("Camera", data), camera.position_mm, camera.target_mm)


def _aimed(
    thing: bpy.types.Object,
    position_mm: tuple[float, float, float],
    target_mm: tuple[float, float, float],
) -> bpy.types.Object:
    """Puts a lamp or camera at a place and turns its axis (its local -Z) to a target."""
    thing.location = position_mm
    axis = Vector(target_mm) - Vector(position_mm)
    thing.rotation_euler = axis.to_track_quat("-Z", "Y").to_euler()
    return thing


def _world(environment: Environment) -> bpy.types.World:
    world = bpy.data.worlds.new("Surroundings")
    if environment.strength == 0.0:
        world.color = (0.0, 0.0, 0.0)
        return world
    world.use_nodes = True
    tree = world.node_tree
    background = tree.nodes["Background"]
    background.inputs["Color"].default_value = (*environment.colour, 1.0)
    background.inputs["Strength"].default_value = environment.strength
    if environment.image:
        _hang_panorama(tree, background, environment)
    return world


def _hang_panorama(
    tree: bpy.types.NodeTree, background: bpy.types.Node, environment: Environment
) -> None:
    """Lets the panorama, tinted and turned, colour the background."""
    panorama = tree.nodes.new("ShaderNodeTexEnvironment")
    panorama.image = bpy.data.images.load(environment.image)
    place = tree.nodes.new("ShaderNodeTexCoord")
    turn = tree.nodes.new("ShaderNodeMapping")
    turn.inputs["Rotation"].default_value[2] = math.radians(environment.rotation_deg)
    tint = tree.nodes.new("ShaderNodeVectorMath")
    tint.operation = "MULTIPLY"
    tint.inputs[1].default_value = environment.colour
    tree.links.new(place.outputs["Generated"], turn.inputs["Vector"])
    tree.links.new(turn.outputs["Vector"], panorama.inputs["Vector"])
    tree.links.new(panorama.outputs["Color"], tint.inputs[0])
    tree.links.new(tint.outputs["Vector"], background.inputs["Color"])


def set_render(scene: bpy.types.Scene, render: Render) -> None:
    """Cycles on the CPU, as many samples in every pixel, no denoising."""
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = render.samples
    scene.cycles.seed = render.seed
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.use_denoising = False
    scene.cycles.max_bounces = render.bounces
    scene.render.resolution_x, scene.render.resolution_y = render.size
    scene.render.resolution_percentage = 100
    scene.render.dither_intensity = 0.0  # black stays black


def set_view(scene: bpy.types.Scene, view: View) -> None:
    """The view transform of pictures for the screen."""
    for name, attribute in VIEW_ATTRIBUTES.items():
        assign(scene.view_settings, attribute, getattr(view, name), f"view.{name}")


def assign(owner: bpy.types.bpy_struct, attribute: str, value: Any, setting: str) -> None:
    """Sets a property. Raises SettingError where this Blender has none or refuses the value."""
    try:
        setattr(owner, attribute, value)
    except (AttributeError, TypeError, ValueError) as error:
        reason = str(error).split(": ", 1)[-1].split("= val: ")[-1]
        raise SettingError(f"is not possible here: {' '.join(reason.split())}", setting) from None
