# SPDX-License-Identifier: GPL-2.0-or-later
"""Render settings that the scripts share: Cycles on the CPU, repeatable, without denoising."""

from __future__ import annotations

import bpy


def use_cycles(*, width: int, height: int, samples: int) -> None:
    """Set the scene to small, repeatable Cycles renders."""
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.render.resolution_x = width
    scene.render.resolution_y = height
    scene.render.resolution_percentage = 100
    scene.cycles.device = "CPU"
    scene.cycles.samples = samples
    scene.cycles.seed = 7
    # Debian has no OpenImageDenoise, and a new scene asks for it.
    scene.cycles.use_denoising = False


def render_to(*, png: str | None = None, exr: str | None = None) -> None:
    """Render once; save as it is seen (8-bit PNG) and as it was computed (32-bit float EXR)."""
    bpy.ops.render.render()
    result = bpy.data.images["Render Result"]
    settings = bpy.context.scene.render.image_settings
    if png:
        settings.file_format = "PNG"
        settings.color_mode = "RGB"
        settings.color_depth = "8"
        result.save_render(png)
    if exr:
        settings.file_format = "OPEN_EXR"
        settings.color_mode = "RGB"
        settings.color_depth = "32"
        result.save_render(exr)
