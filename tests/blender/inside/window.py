# SPDX-License-Identifier: GPL-2.0-or-later
"""Work in Blender's real window: when it is there, do something in it, and close it."""

from __future__ import annotations

import os
import traceback
from collections.abc import Callable

import bpy

# Until the window is drawn and its events are over.
PATIENCE_S = 3.0


def in_window(*steps: Callable[[], bool | None], pause_s: float = PATIENCE_S) -> None:
    """Call `steps` one after the other, the window being drawn before each, then leave Blender.

    A step that returns True is called again: what it waits for is not there yet. An error in a step is exit status 1.
    """
    left = list(steps)
    bpy.context.preferences.view.show_splash = False

    def next_step() -> float | None:
        try:
            if left:
                if not left[0]():
                    left.pop(0)
                return pause_s
            bpy.ops.wm.quit_blender()
        except BaseException:
            # Blender only prints what goes wrong in a timer, and stays.
            traceback.print_exc()
            os._exit(1)
        return None

    bpy.app.timers.register(next_step, first_interval=PATIENCE_S)


def area_of(kind: str) -> bpy.types.Area:
    """The largest area of the window with an editor of this kind."""
    areas = [a for a in bpy.context.window_manager.windows[0].screen.areas if a.type == kind]
    return max(areas, key=lambda area: area.width * area.height)


def context_of(area: bpy.types.Area) -> dict[str, object]:
    """What operators that a user starts in this area get as their context."""
    window = bpy.context.window_manager.windows[0]
    region = next(r for r in area.regions if r.type == "WINDOW")
    return {"window": window, "screen": window.screen, "area": area, "region": region}
