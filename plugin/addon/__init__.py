# SPDX-License-Identifier: GPL-2.0-or-later
"""The add-on: chips and wafers from Blender's menus.

It is thin over the package `icwafer`, which is installed beside Blender's own modules. Nothing of
that package is imported before it is needed, so that Blender starts as fast as without the add-on,
and a script that brings its own copy of the package gets that one.

A further part of the add-on is a module with `register` and `unregister`, named in `_PARTS`.
"""

from . import add_die, asset_library

bl_info = {
    "name": "IC Wafer",
    "description": "Chips and wafers with the colours of diffraction, made up or from layout files",
    "version": (1, 0, 0),
    "blender": (3, 4, 0),
    "location": "Add > Mesh; File > Import; Properties > Object Data",
    "category": "Add Mesh",
}

_PARTS = (add_die, asset_library)


def register():
    for part in _PARTS:
        part.register()


def unregister():
    for part in reversed(_PARTS):
        part.unregister()
