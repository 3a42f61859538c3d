# SPDX-License-Identifier: GPL-2.0-or-later
"""The asset library and the material presets as a user finds them in Blender's window.

Parameters: `browser_png` and `menu_png`, where pictures of the window go; `pause_s`, the time for
each step, in which previews are loaded.
"""

from __future__ import annotations

import math
from typing import Any

import bpy
import numpy as np
from exchange import parameters, report
from wafer_scene import NODE
from window import area_of, context_of, in_window

facts: dict[str, Any] = {}
last_shot = [np.empty(0, dtype=np.float32)]


def open_browser() -> None:
    """The asset browser instead of the view of the scene."""
    area_of("VIEW_3D").ui_type = "ASSETS"


def choose_library() -> None:
    area_of("FILE_BROWSER").spaces.active.params.asset_library_ref = "IC Wafer"


def shoot_browser() -> bool:
    """Takes a picture; returns whether it still changes or is grey: previews are loaded aside."""
    region = context_of(area_of("FILE_BROWSER"))["region"]
    png = parameters()["browser_png"]
    bpy.ops.screen.screenshot(filepath=png)
    facts["assets"] = [region.x, region.y, region.x + region.width, region.y + region.height]
    picture = bpy.data.images.load(png)
    width, height = picture.size
    pixels = np.empty(4 * width * height, dtype=np.float32)
    picture.pixels.foreach_get(pixels)
    bpy.data.images.remove(picture)
    left, bottom, right, top = facts["assets"]
    assets = pixels.reshape(height, width, 4)[bottom:top, left:right, :3].copy()
    changed = not np.array_equal(assets, last_shot[0])
    last_shot[:] = [assets]
    return changed or (np.ptp(assets, axis=2) > 0.25).mean() < 0.01


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
        for preset in ("SRAM Cells", "sky130 met4"):
            bpy.ops.material.ic_wafer_preset("EXEC_DEFAULT", True, preset=preset)
            states.append(spacings())
        for step in (bpy.ops.ed.undo, bpy.ops.ed.undo, bpy.ops.ed.redo):
            step()
            states.append(spacings())
    facts["spacings"] = states


def open_menu() -> None:
    area = area_of("PROPERTIES")
    mouse("MOUSEMOVE", "NOTHING", area.x - 100, area.y + area.height // 2)
    with bpy.context.temp_override(**context_of(area)):
        bpy.ops.wm.call_menu(name="MATERIAL_MT_ic_wafer_presets")


def shoot_menu() -> None:
    bpy.ops.screen.screenshot(filepath=parameters()["menu_png"])


def close_menu() -> None:
    mouse("ESC", "PRESS", 0, 0)
    mouse("ESC", "RELEASE", 0, 0)


def beside_the_view() -> None:
    """A new scene without its cube, above the asset browser, which shows one die."""
    bpy.data.objects.remove(bpy.data.objects["Cube"])
    with bpy.context.temp_override(**context_of(area_of("VIEW_3D"))):
        bpy.ops.screen.area_split(direction="HORIZONTAL", factor=0.4)
    areas = [a for a in bpy.context.window_manager.windows[0].screen.areas if a.type == "VIEW_3D"]
    min(areas, key=lambda area: area.y).ui_type = "ASSETS"


def search_die() -> None:
    params = area_of("FILE_BROWSER").spaces.active.params
    params.asset_library_ref = "IC Wafer"
    params.filter_search = "FPGA"


def mouse(kind: str, value: str, x: int, y: int) -> None:
    bpy.context.window_manager.windows[0].event_simulate(type=kind, value=value, x=x, y=y)


def first_asset() -> tuple[int, int]:
    region = context_of(area_of("FILE_BROWSER"))["region"]
    return region.x + 60, region.y + region.height - 60


def middle_of_view() -> tuple[int, int]:
    region = context_of(area_of("VIEW_3D"))["region"]
    return region.x + region.width // 2, region.y + region.height // 2


def press() -> None:
    mouse("MOUSEMOVE", "NOTHING", *first_asset())
    mouse("LEFTMOUSE", "PRESS", *first_asset())


def drag() -> None:
    x, y = first_asset()
    for step in range(1, 8):
        mouse("MOUSEMOVE", "NOTHING", x + 4 * step, y + 4 * step)


def into_view() -> None:
    for step in range(3):
        x, y = middle_of_view()
        mouse("MOUSEMOVE", "NOTHING", x + step, y)


def drop() -> None:
    mouse("LEFTMOUSE", "RELEASE", *middle_of_view())


def tell() -> None:
    thing = bpy.context.view_layer.objects.active
    collection = thing.instance_collection if thing else None
    facts["dropped"] = collection and [
        collection.name,
        *(math.degrees(part.rotation_euler.z) for part in collection.objects),
    ]
    report(facts)


in_window(
    open_browser,
    choose_library,
    shoot_browser,
    take_presets,
    open_menu,
    shoot_menu,
    close_menu,
    beside_the_view,
    search_die,
    press,
    drag,
    into_view,
    drop,
    tell,
    pause_s=parameters()["pause_s"],
)
