# SPDX-License-Identifier: GPL-2.0-or-later
"""Which asset libraries Blender lists: after its start, after the factory settings, and without
the add-on; and whether a user's own library and the state of the preferences are left alone."""

from __future__ import annotations

import addon_utils
import bpy
from exchange import parameters, report


def libraries() -> dict[str, str]:
    return {entry.name: entry.path for entry in bpy.context.preferences.filepaths.asset_libraries}


def main() -> None:
    facts = {"start": libraries()}
    bpy.ops.preferences.asset_library_add(directory=parameters()["own"])
    bpy.context.preferences.filepaths.asset_libraries["IC Wafer"].path = "/away/datafiles/icwafer"
    bpy.context.preferences.is_dirty = False
    bpy.ops.wm.read_homefile(load_ui=False)
    facts["later"] = libraries()
    facts["changed"] = bpy.context.preferences.is_dirty
    addon_utils.disable("ic_wafer")
    facts["without"] = libraries()
    bpy.ops.wm.read_factory_settings()
    facts["factory"] = libraries()
    report(facts)


main()
