# SPDX-License-Identifier: GPL-2.0-or-later
"""Turns a picture's description into a Blender scene. Runs inside Blender only."""

from __future__ import annotations

import math

import bpy
import numpy as np
from mathutils import Vector

from icwafer.chips.die import generate
from icwafer.chips.model import MM, UM, Die
from icwafer.errors import IcwaferError
from icwafer.pictures import Camera, Light, Picture

NODE = "ShaderNodeBsdfICWafer"
GAP_NM = 8 * UM  # the dark line between two blocks: one pixel in a picture of a whole die

# The face attributes that a die's mesh carries, and the sockets that each one drives.
SOCKET_OF_ATTRIBUTE = {
    "ic_spacing_nm": "Wire Spacing",
    "ic_width_nm": "Wire Width",
    "ic_oxide_nm": "Oxide Thickness",
    "ic_direction_rad": "Direction",
    "ic_diffraction": "Diffraction",
}


def build(picture: Picture) -> bpy.types.Scene:
    """An otherwise empty scene with the picture's die, lamps and camera, ready to render.

    Raises IcwaferError in a Blender without the node.
    """
    if not hasattr(bpy.types, NODE):
        raise IcwaferError(
            "this Blender has no IC Wafer BSDF node: build one that has, "
            "with scripts/icwafer build blender"
        )
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    die = bpy.data.objects.new("Die", die_mesh(generate(picture.die)))
    die.data.materials.append(wafer_material(picture))
    scene.collection.objects.link(die)
    for light in picture.lights:
        scene.collection.objects.link(_lamp(light))
    scene.camera = _camera(picture.camera)
    scene.collection.objects.link(scene.camera)
    _prepare_render(scene, picture)
    return scene


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


def wafer_material(picture: Picture) -> bpy.types.Material:
    """A material whose IC Wafer BSDF takes its wires from the attributes of the mesh."""
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
    wafer.inputs["Lobe Width"].default_value = picture.lobe_width
    wafer.inputs["Specular Roughness"].default_value = picture.specular_roughness
    wafer.use_grating = picture.effects.grating
    wafer.use_thin_film = picture.effects.thin_film
    wafer.use_wire_diffraction = picture.effects.wire_diffraction
    return material


def _lamp(light: Light) -> bpy.types.Object:
    data = bpy.data.lights.new(light.kind.title(), light.kind)
    data.energy = light.power_w
    data.color = light.colour
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


def _prepare_render(scene: bpy.types.Scene, picture: Picture) -> None:
    scene.world = bpy.data.worlds.new("Black")
    scene.world.color = (0.0, 0.0, 0.0)
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = picture.samples
    scene.cycles.seed = 0
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.use_denoising = False
    # A flat die under lamps: light that has met it once never meets it again.
    scene.cycles.max_bounces = 0
    scene.render.resolution_x, scene.render.resolution_y = picture.size
    scene.render.resolution_percentage = 100
    scene.render.dither_intensity = 0.0  # black stays black
    # The colours of a grating are so saturated that the plain curve clips them one channel after
    # the other, and the bands turn into flat stripes; Filmic lets them run into white softly.
    scene.view_settings.view_transform = "Filmic"
    scene.view_settings.look = picture.look
