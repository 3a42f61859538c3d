# SPDX-License-Identifier: GPL-2.0-or-later
"""Render a scene that has nothing to do with the node, to a PNG and an EXR.

Parameters: `scene` ("default" or "rich"), `png`, `exr`.
"""

from __future__ import annotations

import bpy
from exchange import parameters, report
from rich_scene import build_rich_scene
from rendering import render_to, use_cycles

if parameters()["scene"] == "rich":
    build_rich_scene()
use_cycles(width=160, height=120, samples=32)
render_to(png=parameters()["png"], exr=parameters()["exr"])
report({"objects": sorted(o.name for o in bpy.context.scene.objects)})
