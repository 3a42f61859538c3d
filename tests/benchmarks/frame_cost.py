# SPDX-License-Identifier: GPL-2.0-or-later
"""Processor time of a frame with the node, relative to the same one with Principled BSDF.

    scripts/icwafer blender -b --factory-startup -P tests/benchmarks/frame_cost.py

Two kinds of frame: a plane under a sky and an area lamp, which the material fills, and the wafer in
its studio, whose blocks drive the node by attributes: against a plain Principled BSDF, and against
one whose roughness reads the same attributes. All materials in one run, the best of three rounds.
A frame of the wafer begins with its meshes, for every material alike: kept from frame to frame,
they would be made again only where a material reads other attributes than the one before.
"""

from __future__ import annotations

import dataclasses
import resource
import sys
from collections.abc import Callable
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).resolve().parent))
import frame_scene  # noqa: E402

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts" / "python"))
from icwafer.pictures import PICTURES  # noqa: E402
from icwafer.scene import picture as picture_scene  # noqa: E402

SIZE, SAMPLES, ROUNDS = (480, 360), 64, 3
PRINCIPLED = {"Metallic": 1, "Roughness": 0.3, "Anisotropic": 0.8}


def processor_seconds() -> float:
    return resource.getrusage(resource.RUSAGE_SELF).ru_utime


def compare(frame: str, use: dict[str, Callable[[], None]]) -> None:
    """Prints the time of rendering after each of `use`, relative to the first."""
    best = dict.fromkeys(use, float("inf"))
    next(iter(use.values()))()
    bpy.ops.render.render()  # what is made once, before the clock starts
    for _ in range(ROUNDS):
        for name, change in use.items():
            change()
            start = processor_seconds()
            bpy.ops.render.render()
            best[name] = min(best[name], processor_seconds() - start)
    first = next(iter(best.values()))
    for name, seconds in best.items():
        print(f"{frame}, {name}: {seconds / first:.2f}")


def compare_plane() -> None:
    _, plane = frame_scene.scene(SIZE, SAMPLES)
    materials = {
        "Principled": frame_scene.material("ShaderNodeBsdfPrincipled", PRINCIPLED),
        "1 um": frame_scene.material(frame_scene.NODE, {}),
        "4 um": frame_scene.material(
            frame_scene.NODE, {"Wire Spacing": 4000, "Wire Width": 1000}
        ),
    }
    slots = plane.data.materials
    compare(
        "plane",
        {name: lambda made=made: slots.__setitem__(0, made) for name, made in materials.items()},
    )


def compare_wafer() -> None:
    studio = PICTURES["wafer_studio"]
    render = dataclasses.replace(studio.render, size=SIZE, samples=SAMPLES, noise=0.0)
    picture_scene.build(dataclasses.replace(studio, render=render))
    tree = bpy.data.materials["Chip"].node_tree
    wafer = next(node for node in tree.nodes if node.bl_idname == frame_scene.NODE)
    socket = wafer.outputs["BSDF"].links[0].to_socket
    driven = _principled(tree)
    _drive(tree, driven.inputs["Roughness"], [link for i in wafer.inputs for link in i.links])
    nodes = {
        "Principled": _principled(tree),
        "Principled that reads the attributes": driven,
        "IC Wafer": wafer,
    }
    compare(
        "wafer",
        {
            name: lambda node=node: tree.links.new(node.outputs["BSDF"], socket)
            for name, node in nodes.items()
        },
    )


def _principled(tree: bpy.types.NodeTree) -> bpy.types.Node:
    node = tree.nodes.new("ShaderNodeBsdfPrincipled")
    for name, value in PRINCIPLED.items():
        node.inputs[name].default_value = value
    return node


def _drive(
    tree: bpy.types.NodeTree, socket: bpy.types.NodeSocket, links: list[bpy.types.NodeLink]
) -> None:
    """Adds the values of links, made too small to be seen, to what a socket has."""
    output = None
    for link in links:
        add = tree.nodes.new("ShaderNodeMath")
        add.operation = "MULTIPLY_ADD"
        tree.links.new(link.from_socket, add.inputs[0])
        add.inputs[1].default_value = 1e-9
        add.inputs[2].default_value = socket.default_value
        if output:
            tree.links.new(output, add.inputs[2])
        output = add.outputs["Value"]
    tree.links.new(output, socket)


compare_plane()
compare_wafer()
sys.exit(0)
