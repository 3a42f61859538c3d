# SPDX-License-Identifier: GPL-2.0-or-later
"""Render one of the project's pictures small, again and again, with other seeds of the renderer.

Parameters: `package`, the folder to import icwafer from; `picture`, its name; `size`; `samples`;
`renders`, a list of `seed`, `spacing_scale`, by which the wires' spacing is multiplied, and `exr`,
where it goes. Renders of one scale should follow one another.
"""

from __future__ import annotations

import dataclasses
import sys
from typing import Any

import bpy
import numpy as np
from exchange import parameters, report
from rendering import render_to

given = parameters()
sys.path.insert(0, given["package"])

from icwafer.pictures import PICTURES  # noqa: E402
from icwafer.scene import picture as picture_scene  # noqa: E402


def build(spacing_scale: float) -> None:
    picture = PICTURES[given["picture"]]
    render = dataclasses.replace(
        picture.render, size=tuple(given["size"]), samples=given["samples"]
    )
    picture = dataclasses.replace(picture, render=render)
    scene = picture_scene.build(picture)
    scene.render.use_persistent_data = True  # the die is the same from seed to seed
    spacing = bpy.data.meshes["Die"].attributes["ic_spacing_nm"].data
    values = np.empty(len(spacing), dtype=np.float32)
    spacing.foreach_get("value", values)
    spacing.foreach_set("value", values * np.float32(spacing_scale))


def render_all(renders: list[dict[str, Any]]) -> None:
    built = None
    for render in renders:
        if render["spacing_scale"] != built:
            built = render["spacing_scale"]
            build(built)
        bpy.context.scene.cycles.seed = render["seed"]
        render_to(exr=render["exr"])


render_all(given["renders"])
report({})
