# SPDX-License-Identifier: GPL-2.0-or-later
"""The add-on: chips and wafers from Blender's menus.

It is thin over the package `icwafer`, which is installed beside Blender's own modules. Nothing of
that package is imported before it is needed, so that Blender starts as fast as without the add-on,
and a script that brings its own copy of the package gets that one.

A further part is a module whose classes are named in `_CLASSES`, or that has `register` and
`unregister` and is named in `_PARTS`.
"""

import bpy

from . import (
    add_die,
    add_wafer,
    asset_library,
    attributes_panel,
    import_chip,
    material_presets,
    menus,
    options,
)

bl_info = {
    "name": "IC Wafer",
    "description": "Chips and wafers with the colours of diffraction, generated or imported",
    "version": (1, 0, 0),
    "blender": (3, 4, 0),
    "location": "Add > Mesh; File > Import; Properties > Object Data and Material",
    "category": "Add Mesh",
}

#: Classes in the order in which one needs the other, and parts that register more than a class.
_CLASSES = (
    options.IC_PG_group,
    add_die.MESH_OT_ic_die_add,
    add_wafer.MESH_OT_ic_wafer_add,
    import_chip.IMPORT_SCENE_OT_ic_chip,
    import_chip.IMPORT_SCENE_OT_ic_chip_choose,
    attributes_panel.WM_OT_ic_attribute_copy,
    attributes_panel.OBJECT_OT_ic_material_add,
    attributes_panel.DATA_PT_ic_attributes,
    *material_presets.CLASSES,
)
_PARTS = (menus, asset_library, material_presets)


def register():
    for cls in _CLASSES:
        bpy.utils.register_class(cls)
    for part in _PARTS:
        part.register()


def unregister():
    for part in reversed(_PARTS):
        part.unregister()
    for cls in reversed(_CLASSES):
        bpy.utils.unregister_class(cls)
