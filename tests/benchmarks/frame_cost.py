# SPDX-License-Identifier: GPL-2.0-or-later
"""Processor time of a frame filled with the node, relative to one with Principled BSDF.

    scripts/icwafer blender -b --factory-startup -P tests/benchmarks/frame_cost.py

A plane under a sky and an area lamp, all materials in one run, the best of two rounds.
"""

from __future__ import annotations

import resource

import bpy
from mathutils import Vector

SIZE, SAMPLES, ROUNDS = (320, 240), 16, 2


def material(name: str, inputs: dict[str, float]) -> bpy.types.Material:
    """A material whose Principled BSDF, or IC Wafer BSDF, has these inputs."""
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    tree = made.node_tree
    node = tree.nodes["Principled BSDF"]
    if name != "principled":
        node = tree.nodes.new("ShaderNodeBsdfICWafer")
        tree.links.new(node.outputs["BSDF"], tree.nodes["Material Output"].inputs["Surface"])
    for socket, value in inputs.items():
        node.inputs[socket].default_value = value
    return made


def add(data: bpy.types.ID, place: tuple[float, float, float]) -> bpy.types.Object:
    """An object at a place, looking at the origin."""
    thing = bpy.data.objects.new("Thing", data)
    thing.location = place
    thing.rotation_euler = (-Vector(place)).to_track_quat("-Z", "Y").to_euler()
    bpy.context.scene.collection.objects.link(thing)
    return thing


def processor_seconds() -> float:
    return resource.getrusage(resource.RUSAGE_SELF).ru_utime


bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
bpy.ops.mesh.primitive_plane_add(size=20)
plane = bpy.context.object
materials = {
    "principled": material("principled", {"Metallic": 1, "Roughness": 0.3, "Anisotropic": 0.8}),
    "1 um": material("1 um", {}),
    "4 um": material("4 um", {"Wire Spacing": 4000, "Wire Width": 1000}),
}
lamp = bpy.data.lights.new("Lamp", "AREA")
lamp.energy, lamp.size = 400, 1
add(lamp, (1.2, 1.0, 2.2))
scene.camera = add(bpy.data.cameras.new("Camera"), (-1.0, -2.2, 2.4))
scene.world = bpy.data.worlds.new("Sky")
scene.world.use_nodes = True
sky = scene.world.node_tree.nodes.new("ShaderNodeTexSky")
sky.sky_type = "HOSEK_WILKIE"
background = scene.world.node_tree.nodes["Background"]
scene.world.node_tree.links.new(sky.outputs["Color"], background.inputs["Color"])
scene.render.engine = "CYCLES"
scene.cycles.samples = SAMPLES
scene.cycles.use_denoising = scene.cycles.use_adaptive_sampling = False
scene.render.resolution_x, scene.render.resolution_y = SIZE
scene.render.use_persistent_data = True

plane.data.materials.append(materials["principled"])
bpy.ops.render.render()  # what is made once, before the clock starts
best = dict.fromkeys(materials, float("inf"))
for _ in range(ROUNDS):
    for name, made in materials.items():
        plane.data.materials[0] = made
        start = processor_seconds()
        bpy.ops.render.render()
        best[name] = min(best[name], processor_seconds() - start)
for name, seconds in best.items():
    print(f"{name}: {seconds / best['principled']:.2f}")
