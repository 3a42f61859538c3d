# SPDX-License-Identifier: GPL-2.0-or-later
"""Use the add-on's operators without a window, each time in a new scene; report what they make.

Parameters: `steps`, each with `operator` ("mesh.ic_die_add"), `options` for it, and if wanted
`before`, statements that prepare the scene; `exr`, to where Blender's default scene is rendered
with the new thing in place of its cube; and `blend`, to where the file is saved.
"""

from __future__ import annotations

import contextlib
import io
import sys

import bpy
from exchange import parameters, report
from rendering import render_to, use_cycles
from thing_facts import thing_facts


def operator(path: str) -> object:
    """The operator of a name such as "mesh.ic_die_add"."""
    module, name = path.split(".")
    return getattr(getattr(bpy.ops, module), name)


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
    if "blend" in step:
        bpy.ops.wm.save_as_mainfile(filepath=step["blend"], copy=True)
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
