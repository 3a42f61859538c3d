# SPDX-License-Identifier: GPL-2.0-or-later
"""The asset browser with the library, as a user finds it: a picture of Blender's window.

Parameters: `png`; `pause_s`, the time for each step, in which previews are loaded.
"""

from __future__ import annotations

import bpy
from exchange import parameters, report
from window import area_of, in_window


def open_browser() -> None:
    """The asset browser instead of the view of the scene, with the library chosen."""
    area_of("VIEW_3D").ui_type = "ASSETS"


def choose() -> None:
    space = area_of("FILE_BROWSER").spaces.active
    space.params.asset_library_ref = "IC Wafer"
    space.show_region_toolbar = True


def shoot() -> None:
    bpy.ops.screen.screenshot(filepath=parameters()["png"])
    area = area_of("FILE_BROWSER")
    regions = {
        region.type: [region.x, region.y, region.x + region.width, region.y + region.height]
        for region in area.regions
    }
    window = bpy.context.window_manager.windows[0]
    report({"window": [window.width, window.height], "regions": regions})


in_window(open_browser, choose, shoot, pause_s=parameters()["pause_s"])
