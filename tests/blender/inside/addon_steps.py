# SPDX-License-Identifier: GPL-2.0-or-later
"""Use the add-on's operators without a window, each time in a new scene, and report what they made.

Parameters: `steps`, each with `operator` ("mesh.ic_die_add"), `options` for it, and if wanted
`before`, statements that prepare the scene, and `exr`, to where Blender's default scene is rendered
with the new thing in place of its cube.
"""

from __future__ import annotations

import contextlib
import io
import sys

import bpy
import numpy as np
from exchange import parameters, report
from rendering import render_to, use_cycles


def operator(path: str) -> object:
    """The operator of a name such as "mesh.ic_die_add"."""
    module, name = path.split(".")
    return getattr(getattr(bpy.ops, module), name)


def values_of(attribute: bpy.types.Attribute) -> list[float]:
    values = np.empty(len(attribute.data), dtype=np.float32)
    attribute.data.foreach_get("value", values)
    return [float(values.min()), float(values.max()), float(values.astype(np.float64).sum())]


def instances_of(thing: bpy.types.Object) -> int:
    """How many instances an object has after its modifiers."""
    depsgraph = bpy.context.evaluated_depsgraph_get()
    return sum(
        instance.is_instance and instance.parent.original == thing
        for instance in depsgraph.object_instances
    )


def thing_facts(thing: bpy.types.Object) -> dict[str, object]:
    """What an object is: place, size, faces, materials and attributes."""
    mode = thing.mode
    bpy.ops.object.mode_set(mode="OBJECT")  # else its mesh is not up to date
    return {
        "name": thing.name,
        "mode": mode,
        "selected": [other.name for other in bpy.context.view_layer.objects.selected],
        "location": list(thing.location),
        "rotation": list(thing.rotation_euler),
        "scale": list(thing.scale),
        "dimensions": list(thing.dimensions),
        "faces": len(thing.data.polygons),
        "materials": [slot.material.name for slot in thing.material_slots],
        "instances": instances_of(thing),
        "attributes": {
            attribute.name: values_of(attribute)
            for attribute in thing.data.attributes
            if attribute.name.startswith("ic_") and attribute.data_type == "FLOAT"
        },
    }


def data_count() -> dict[str, int]:
    """How many things of each kind the file has."""
    kinds = ("objects", "meshes", "materials", "collections", "node_groups")
    return {kind: len(getattr(bpy.data, kind)) for kind in kinds}


def take(step: dict[str, object]) -> dict[str, object]:
    """Do one step in a new scene."""
    bpy.ops.wm.read_factory_settings()
    bpy.data.objects.remove(bpy.data.objects["Cube"])
    exec(step.get("before", ""))
    before = data_count()
    try:
        with contextlib.redirect_stdout(io.StringIO()):
            result = operator(step["operator"])(**step["options"])
    except RuntimeError as error:  # how Blender passes reports on to Python
        return {"error": str(error), "left": data_count() != before}
    if "exr" in step:
        use_cycles(width=96, height=54, samples=8)
        render_to(exr=step["exr"])
    return {"result": list(result)} | thing_facts(bpy.context.view_layer.objects.active)


def addon_facts() -> dict[str, object]:
    """How the add-on is there: before anything has used it."""
    loaded = [name for name in sys.modules if name.split(".")[0] == "icwafer"]
    listed = "ic_wafer" in bpy.context.preferences.addons
    bpy.ops.preferences.addon_disable(module="ic_wafer")
    off = not hasattr(bpy.types, "MESH_OT_ic_die_add")
    bpy.ops.preferences.addon_enable(module="ic_wafer")
    on_again = hasattr(bpy.types, "MESH_OT_ic_die_add")
    bpy.ops.mesh.ic_die_add()
    import icwafer

    return {
        "loaded": loaded,
        "listed": listed,
        "off": off,
        "on again": on_again,
        "package": icwafer.__file__,
    }


report({"addon": addon_facts(), "steps": [take(step) for step in parameters()["steps"]]})
