# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes of portraits: a die or a wafer on a dark table, lit for its colours."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from pathlib import Path

import bpy
import numpy as np

from icwafer.chips.die import generate
from icwafer.chips.document import read_layout
from icwafer.chips.model import Die, Layout
from icwafer.pictures import Light, Render, Table, View
from icwafer.portrait.order import Order
from icwafer.portrait.rig import SIZE_MM, Pose, rig, spacings_nm
from icwafer.portrait.wires import Wires
from icwafer.scene.camera import camera_object
from icwafer.scene.lamps import lamp
from icwafer.scene.material import chip_material
from icwafer.scene.mesh import GAP_NM, STEP_MM, die_mesh
from icwafer.scene.parts import metal_material, parts
from icwafer.scene.picture import empty_scene
from icwafer.scene.polygons import polygon_mesh
from icwafer.scene.render import set_render, set_view
from icwafer.scene.studio import table_object
from icwafer.scene.wafer import add_wafer
from icwafer.scene.wires import wires_mesh

#: Lobes of wires in logic, which run on undisturbed for a micrometre or two.
LOGIC = {"Coherence Width": 6.0, "Wire Length": 1.2, "Roughness": 0.05}
#: Wires that are seen one by one are plain metal where they belong to no grating.
WIRE_COLOUR = (0.45, 0.45, 0.44)
WIRE_ROUGHNESS = 0.22
#: Their sides stand in the shade of their neighbours.
SIDE_COLOUR = (0.12, 0.12, 0.12)
#: Pixels with less noise than this take no more samples: most of a picture is dark.
NOISE = 0.02
#: Thickness of a die that was cut out and ground, relative to its longer side.
BODY = 0.03
_LAMPS = "Lamps"


def build(order: Order) -> tuple[bpy.types.Scene, tuple[Light, ...]]:
    """The scene of an order without lamps, and the lamps, but for their power.

    Raises IcwaferError where the layout cannot be read.
    """
    scene = empty_scene()
    layout = read_layout(Path(order.layout))
    die = generate(layout.dies[0])
    aspect = order.size[0] / order.size[1]
    if order.wafer:
        extent_mm, pose = _add_wafer(scene, layout, order)
    else:
        extent_mm, pose = _add_die(scene, die, order)
    scale = SIZE_MM / max(extent_mm)
    found = rig((scale * extent_mm[0], scale * extent_mm[1]), spacings_nm(die), pose, aspect)
    scene.camera = camera_object(found.camera)
    scene.collection.objects.link(scene.camera)
    scene.world = bpy.data.worlds.new("Dark")
    scene.world.color = (0.002, 0.002, 0.0022)
    set_render(scene, Render(order.size, order.samples, noise=NOISE))
    # A pixel whose first samples miss a narrow band is not dark.
    scene.cycles.adaptive_min_samples = max(1, order.samples // 2)
    set_view(scene, View())
    return scene, found.lights


def light(scene: bpy.types.Scene, lights: Sequence[Light], factor: float) -> None:
    """Lights a scene by lamps and cards with a multiple of their power, and by nothing else."""
    lamps = bpy.data.collections.get(_LAMPS) or bpy.data.collections.new(_LAMPS)
    if lamps.name not in scene.collection.children:
        scene.collection.children.link(lamps)
    for thing in list(lamps.objects):
        bpy.data.objects.remove(thing)
    for given in lights:
        lamps.objects.link(lamp(dataclasses.replace(given, power_w=factor * given.power_w)))


def _add_wafer(
    scene: bpy.types.Scene, layout: Layout, order: Order
) -> tuple[tuple[float, float], Pose]:
    wafer = add_wafer(layout, scene.collection, parts(order.node))
    diameter = float(layout.wafer.diameter_mm)
    pose = Pose(turn_deg=0.0, polar_deg=50.0, fill=0.92, lens_mm=55.0)
    _place(wafer, diameter, pose)
    _add_table(scene, 0.003)
    return (diameter, diameter), pose


def _add_die(scene: bpy.types.Scene, die: Die, order: Order) -> tuple[tuple[float, float], Pose]:
    extent_mm = die.spec.width_mm, die.spec.height_mm
    longer = max(extent_mm)
    pose = Pose(
        turn_deg=(90.0 if extent_mm[1] > extent_mm[0] else 0.0) - 16.0,
        polar_deg=42.0,
        fill=0.95,
        f_stop=220.0,
    )
    made = parts(order.node)
    if order.wires:
        mesh = wires_mesh(Wires.read(Path(order.wires)))
        values = LOGIC | order.node
        mesh.materials.append(chip_material("Wires", values, WIRE_COLOUR, WIRE_ROUGHNESS))
        mesh.materials.append(metal_material("Wire Sides", SIDE_COLOUR, WIRE_ROUGHNESS))
        ground_mm = -0.0005
    else:
        mesh = die_mesh(die, min(GAP_NM, 1e6 * longer / 2000), ground=True)
        mesh.materials.append(made.blocks)
        mesh.materials.append(made.ground)
        ground_mm = -2 * STEP_MM
    body = _box_mesh("Body", extent_mm, ground_mm, BODY * longer)
    body.materials.append(made.ground if order.wires else made.silicon)
    for thing in (mesh, body):
        placed = bpy.data.objects.new(thing.name, thing)
        scene.collection.objects.link(placed)
        _place(placed, longer, pose)
    _add_table(scene, BODY)
    return extent_mm, pose


def _place(thing: bpy.types.Object, longer_mm: float, pose: Pose) -> None:
    thing.scale = [SIZE_MM / longer_mm] * 3
    thing.rotation_euler.z = np.radians(pose.turn_deg)


def _box_mesh(
    name: str, extent_mm: tuple[float, float], top_mm: float, height_mm: float
) -> bpy.types.Mesh:
    half = np.array(extent_mm) / 2
    ring = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)]) * half
    points = np.concatenate([np.insert(ring, 2, z, axis=1) for z in (top_mm, top_mm - height_mm)])
    around = np.arange(4)
    sides = np.stack([around, around + 4, (around + 1) % 4 + 4, (around + 1) % 4], axis=1)
    return polygon_mesh(name, points, [around[None], sides])


def _add_table(scene: bpy.types.Scene, depth: float) -> None:
    """depth: of the table below the subject's face, relative to `SIZE_MM`."""
    table = Table(1.1 * SIZE_MM, (0.02, 0.02, 0.022), 0.06, 1.02 * depth * SIZE_MM)
    scene.collection.objects.link(table_object(table))
