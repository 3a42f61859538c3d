# SPDX-License-Identifier: GPL-2.0-or-later
"""The asset library and the material presets as a user finds them in Blender's window.

Parameters: `browser_png` and `menu_png`, where pictures of the window go; `pause_s`, the time for
each step, in which previews are loaded.
"""

from __future__ import annotations

from typing import Any

import bpy
from exchange import parameters, report
from wafer_scene import NODE
from window import area_of, context_of, in_window

facts: dict[str, Any] = {}


def open_browser() -> None:
    """The asset browser instead of the view of the scene."""
    area_of("VIEW_3D").ui_type = "ASSETS"


def choose_library() -> None:
    area_of("FILE_BROWSER").spaces.active.params.asset_library_ref = "IC Wafer"


def shoot_browser() -> None:
    bpy.ops.screen.screenshot(filepath=parameters()["browser_png"])
    region = context_of(area_of("FILE_BROWSER"))["region"]
    facts["assets"] = [region.x, region.y, region.x + region.width, region.y + region.height]


def spacings() -> list[float]:
    """Wire Spacing of the node in the cube's material; none without the node."""
    tree = bpy.data.objects["Cube"].active_material.node_tree
    return [n.inputs["Wire Spacing"].default_value for n in tree.nodes if n.bl_idname == NODE]


def take_presets() -> None:
    area_of("FILE_BROWSER").ui_type = "VIEW_3D"
    area_of("PROPERTIES").spaces.active.context = "MATERIAL"
    with bpy.context.temp_override(**context_of(area_of("VIEW_3D"))):
        states = [spacings()]
        bpy.ops.ed.undo_push(message="Before")
        for preset in ("SRAM", "sky130 met4"):
            bpy.ops.material.ic_wafer_preset("EXEC_DEFAULT", True, preset=preset)
            states.append(spacings())
        for step in (bpy.ops.ed.undo, bpy.ops.ed.undo, bpy.ops.ed.redo):
            step()
            states.append(spacings())
    facts["spacings"] = states


def open_menu() -> None:
    area = area_of("PROPERTIES")
    window = context_of(area)["window"]
    x, y = area.x - 100, area.y + area.height // 2
    window.event_simulate(type="MOUSEMOVE", value="NOTHING", x=x, y=y)
    with bpy.context.temp_override(**context_of(area)):
        bpy.ops.wm.call_menu(name="MATERIAL_MT_ic_wafer_presets")


def shoot_menu() -> None:
    bpy.ops.screen.screenshot(filepath=parameters()["menu_png"])
    report(facts)


in_window(
    open_browser,
    choose_library,
    shoot_browser,
    take_presets,
    open_menu,
    shoot_menu,
    pause_s=parameters()["pause_s"],
)
