# SPDX-License-Identifier: GPL-2.0-or-later
"""Processor time of a frame filled with the node, relative to one with Principled BSDF.

    scripts/icwafer blender -b --factory-startup -P tests/benchmarks/frame_cost.py

A plane under a sky and an area lamp, all materials in one run, the best of two rounds.
"""

from __future__ import annotations

import resource
import sys
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).resolve().parent))
import frame_scene  # noqa: E402

SIZE, SAMPLES, ROUNDS = (320, 240), 16, 2


def processor_seconds() -> float:
    return resource.getrusage(resource.RUSAGE_SELF).ru_utime


scene, plane = frame_scene.scene(SIZE, SAMPLES)
materials = {
    "principled": frame_scene.material(
        "ShaderNodeBsdfPrincipled", {"Metallic": 1, "Roughness": 0.3, "Anisotropic": 0.8}
    ),
    "1 um": frame_scene.material(frame_scene.NODE, {}),
    "4 um": frame_scene.material(frame_scene.NODE, {"Wire Spacing": 4000, "Wire Width": 1000}),
}
plane.data.materials[0] = materials["principled"]
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
