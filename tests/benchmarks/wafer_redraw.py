# SPDX-License-Identifier: GPL-2.0-or-later
"""How long the view takes to be drawn with a new wafer, as plates and as blocks, and with nothing.

Run in a window:
    scripts/icwafer blender --factory-startup -P tests/benchmarks/wafer_redraw.py
or on a virtual screen, where a processor draws:
    LIBGL_ALWAYS_SOFTWARE=1 xvfb-run -a scripts/icwafer blender --factory-startup \
        -P tests/benchmarks/wafer_redraw.py
"""

from __future__ import annotations

import time

import bpy

def view() -> dict[str, object]:
    window = bpy.context.window_manager.windows[0]
    area = next(area for area in window.screen.areas if area.type == "VIEW_3D")
    region = next(region for region in area.regions if region.type == "WINDOW")
    return {"window": window, "area": area, "region": region}


def redraw_s(**wafer: str) -> float:
    """Time for a redraw after the first one, with a wafer of these options if there are any."""
    with bpy.context.temp_override(**view()):
        if wafer:
            bpy.ops.mesh.ic_wafer_add("EXEC_DEFAULT", True, **wafer)
            bpy.ops.view3d.view_selected()
            thing = bpy.context.object
            thing.select_set(False)
        bpy.ops.wm.redraw_timer(type="DRAW", iterations=1)
        begin = time.monotonic()
        bpy.ops.wm.redraw_timer(type="DRAW", iterations=1)
        seconds = time.monotonic() - begin
        if wafer:
            bpy.data.objects.remove(thing)
    return seconds


def measure() -> None:
    bpy.data.objects.remove(bpy.data.objects["Cube"])
    nothing = redraw_s()
    plates, blocks = redraw_s(viewport="PLATES"), redraw_s(viewport="BLOCKS")
    print(
        f"no wafer {nothing:.3f} s, plates {plates:.3f} s, blocks {blocks:.3f} s "
        f"({blocks / plates:.0f} times as long)",
        flush=True,
    )
    bpy.ops.wm.quit_blender()


bpy.context.preferences.view.show_splash = False
# Else the view is drawn eight times after each change.
bpy.context.preferences.system.viewport_aa = "OFF"
bpy.app.timers.register(measure, first_interval=3.0)
