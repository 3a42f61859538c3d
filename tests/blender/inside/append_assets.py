# SPDX-License-Identifier: GPL-2.0-or-later
"""Every asset of a library file in Blender's new scene, as an artist gets it, rendered.

Parameters: `blend`; `folder`, which gets a PNG for each asset; `width`, `height`, `samples`. The
report has for each asset its kind, name, catalog, description, picture and what its preview holds.

A material is put on a plane, with a ball and the new scene's cube behind it; a collection becomes
an instance in the middle, as the asset browser makes it, alone or, if it brings lamps, on the cube.
"""

from __future__ import annotations

import hashlib
from pathlib import Path
from typing import Any

import bpy
import numpy as np
from exchange import parameters, report
from rendering import render_to, use_cycles


def new_scene() -> None:
    given = parameters()
    bpy.ops.wm.read_factory_settings()
    use_cycles(width=given["width"], height=given["height"], samples=given["samples"])


def append(kind: str, name: str) -> bpy.types.ID:
    with bpy.data.libraries.load(parameters()["blend"], assets_only=True) as (_, wanted):
        setattr(wanted, kind, [name])
    return getattr(wanted, kind)[0]


def show_material(material: bpy.types.Material) -> None:
    cube = bpy.data.objects["Cube"]
    cube.location = (-1.6, 1.4, 0.0)
    bpy.ops.mesh.primitive_plane_add(size=2.4, location=(0.0, 0.0, -1.0))
    plane = bpy.context.object
    bpy.ops.mesh.primitive_uv_sphere_add(segments=64, ring_count=32, location=(1.5, 1.4, 0.0))
    ball = bpy.context.object
    bpy.ops.object.shade_smooth()
    for thing in (cube, plane, ball):
        thing.data.materials.clear()
        thing.data.materials.append(material)


def show_collection(collection: bpy.types.Collection) -> None:
    cube = bpy.data.objects["Cube"]
    if not any(thing.type == "LIGHT" for thing in collection.all_objects):
        bpy.data.objects.remove(cube)
    instance = bpy.data.objects.new(collection.name, None)
    instance.instance_type = "COLLECTION"
    instance.instance_collection = collection
    bpy.context.scene.collection.objects.link(instance)


def preview_facts(asset: bpy.types.ID) -> dict[str, Any]:
    preview = asset.preview
    pixels = np.array(preview.image_pixels_float, dtype=np.float32).reshape(-1, 4)
    shown = pixels[:, :3] * pixels[:, 3:]
    return {
        "size": list(preview.image_size),
        "brightest": float(shown.max()),
        "deviation": float(shown.std()),
        "digest": hashlib.sha256(pixels.tobytes()).hexdigest(),
    }


SHOW = {"materials": show_material, "collections": show_collection}


def main() -> None:
    with bpy.data.libraries.load(parameters()["blend"], assets_only=True) as (there, _):
        names = [(kind, name) for kind in SHOW for name in getattr(there, kind)]
    facts = []
    for number, (kind, name) in enumerate(sorted(names)):
        new_scene()
        asset = append(kind, name)
        SHOW[kind](asset)
        png = Path(parameters()["folder"]) / f"{number:02}.png"
        render_to(png=str(png))
        facts.append(
            {
                "kind": kind,
                "name": name,
                "catalog": asset.asset_data.catalog_id,
                "description": asset.asset_data.description,
                "png": str(png),
                "preview": preview_facts(asset),
            }
        )
    report({"assets": facts})


main()
