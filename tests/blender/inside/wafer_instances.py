# SPDX-License-Identifier: GPL-2.0-or-later
"""Build wafers from layout files, report what they are made of, and render them.

Parameters: `package`, the folder to import icwafer from; `wafers`, a list of `layout` and `exr`.
Reports of each wafer: `instances`, the places (x, y, z) of the instances; `parents`, the names of
the objects that they belong to; `objects`, all objects of the scene but lamp and camera; `valid`,
whether all meshes are; `reach_mm`, the farthest point of the disc; `areas_mm2`, of what lies on
it, by the names of materials.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import bpy
from exchange import parameters, report
from rendering import render_to, use_cycles

given = parameters()
sys.path.insert(0, given["package"])

from icwafer.chips.document import read_layout  # noqa: E402
from icwafer.pictures import Camera, Light  # noqa: E402
from icwafer.scene.camera import camera_object  # noqa: E402
from icwafer.scene.lamps import lamp  # noqa: E402
from icwafer.scene.parts import parts  # noqa: E402
from icwafer.scene.picture import empty_scene  # noqa: E402
from icwafer.scene.wafer import add_wafer  # noqa: E402


def build(layout: str, exr: str) -> dict[str, Any]:
    scene = empty_scene()
    wafer = add_wafer(read_layout(Path(layout)), scene.collection, parts({"Roughness": 0.2}))
    facts = {
        "objects": [thing.name for thing in scene.objects],
        "valid": not any(mesh.validate() for mesh in bpy.data.meshes),
        "reach_mm": max(v.co.xy.length for p in wafer.data.polygons[:1]
                        for v in (wafer.data.vertices[i] for i in range(360))),
        "instances": [], "parents": [], "areas_mm2": {},
    }  # fmt: skip
    for polygon in wafer.data.polygons:
        name = wafer.data.materials[polygon.material_index].name.partition(".")[0]
        facts["areas_mm2"][name] = facts["areas_mm2"].get(name, 0.0) + polygon.area
    for instance in bpy.context.evaluated_depsgraph_get().object_instances:
        if instance.is_instance and not instance.object.hide_render:
            facts["instances"].append(list(instance.matrix_world.translation))
            facts["parents"].append(instance.parent.name)
    scene.collection.objects.link(lamp(Light("AREA", (0, 150, 250), 5e5, size_mm=(150, 100))))
    scene.camera = camera_object(Camera((0, -150, 250), (0, 0, 0), 70))
    scene.collection.objects.link(scene.camera)
    use_cycles(width=96, height=54, samples=8)
    render_to(exr=exr)
    return facts


report({"wafers": [build(**wafer) for wafer in given["wafers"]]})
