# SPDX-License-Identifier: GPL-2.0-or-later
"""F1 on the node IC Wafer BSDF opens the manual page that lies beside this file."""

from pathlib import Path

import bpy


def _manual_map():
    prefix = Path(__file__).resolve().parent.as_uri() + "/"
    return prefix, (("bpy.types.shadernodebsdficwafer*", "ic_wafer_bsdf.html"),)


def register():
    bpy.utils.register_manual_map(_manual_map)


def unregister():
    bpy.utils.unregister_manual_map(_manual_map)
