# SPDX-License-Identifier: GPL-2.0-or-later
"""The asset library that comes with this Blender, in the asset browser.

Blender 3.4 knows libraries from the user's preferences only. So the library is put on that list
whenever Blender has started or loaded a file, with the folder where this Blender stands now: it may
have been moved. The preferences do not count as changed by that; the user's own libraries stay.
"""

from __future__ import annotations

from pathlib import Path

import bpy
from bpy.app.handlers import persistent

NAME = "IC Wafer"


def folder() -> Path:
    """Where the library's files are, if it has been built."""
    return Path(bpy.utils.system_resource("DATAFILES")) / "icwafer"


def _ours() -> int:
    """The library's place on the list, of this Blender or of one that stood elsewhere; -1: none."""
    for index, entry in enumerate(bpy.context.preferences.filepaths.asset_libraries):
        if Path(entry.path).parts[-2:] == ("datafiles", "icwafer"):
            return index
    return -1


def _show() -> None:
    """Puts the library on the list, or corrects its folder there."""
    preferences = bpy.context.preferences
    changed, index = preferences.is_dirty, _ours()
    if index < 0:
        bpy.ops.preferences.asset_library_add(directory=str(folder()))
        preferences.filepaths.asset_libraries[-1].name = NAME
    else:
        preferences.filepaths.asset_libraries[index].path = str(folder())
    preferences.is_dirty = changed


@persistent
def _after_loading(*_: object) -> None:
    _show()


def register() -> None:
    # While an add-on is registered operators cannot be called yet.
    bpy.app.handlers.load_post.append(_after_loading)
    bpy.app.timers.register(_show)


def unregister() -> None:
    bpy.app.handlers.load_post.remove(_after_loading)
    if bpy.app.timers.is_registered(_show):
        bpy.app.timers.unregister(_show)
    preferences, index = bpy.context.preferences, _ours()
    if index >= 0:
        changed = preferences.is_dirty
        bpy.ops.preferences.asset_library_remove(index=index)
        preferences.is_dirty = changed
