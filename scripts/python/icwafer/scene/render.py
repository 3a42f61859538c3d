# SPDX-License-Identifier: GPL-2.0-or-later
"""Settings of the renderer, and how its light becomes the colours of a screen."""

from __future__ import annotations

import bpy

from icwafer.pictures import Render, View
from icwafer.scene.properties import assign

#: Blender's names for the fields of a View, in the order in which they depend on each other.
VIEW_ATTRIBUTES = {
    "transform": "view_transform",
    "look": "look",
    "exposure": "exposure",
    "gamma": "gamma",
}


def set_render(scene: bpy.types.Scene, render: Render) -> None:
    """Cycles on the CPU, no denoising."""
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = render.samples
    scene.cycles.seed = render.seed
    scene.cycles.use_adaptive_sampling = render.noise > 0.0
    scene.cycles.adaptive_threshold = render.noise
    scene.cycles.use_denoising = False
    scene.cycles.max_bounces = render.bounces
    scene.render.resolution_x, scene.render.resolution_y = render.size
    scene.render.resolution_percentage = 100
    scene.render.dither_intensity = 0.0  # black stays black


def set_view(scene: bpy.types.Scene, view: View) -> None:
    """The view transform of pictures for the screen."""
    for name, attribute in VIEW_ATTRIBUTES.items():
        assign(scene.view_settings, attribute, getattr(view, name), f"view.{name}")
