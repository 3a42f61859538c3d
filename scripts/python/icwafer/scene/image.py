# SPDX-License-Identifier: GPL-2.0-or-later
"""Writes what Blender has rendered: linear as EXR, as a screen shows it as PNG. Inside Blender."""

from __future__ import annotations

import shutil
from pathlib import Path

import bpy

from icwafer.errors import DiskFull


def expect_space(folder: Path, size: tuple[int, int]) -> None:
    """Raises DiskFull unless both files fit: Blender does not notice a cut-off EXR.

    size: width and height in pixels.
    """
    needed = 10 * size[0] * size[1] + 100_000  # 6 + 3 bytes a pixel and headers
    free = shutil.disk_usage(folder).free
    if free < needed:
        raise DiskFull(
            f"disk full: the picture needs {needed // 1000} kB in {folder}, {free // 1000} kB are "
            "free: free some space or choose another folder"
        )


def save(scene: bpy.types.Scene, path: Path) -> None:
    """Writes the image that was rendered last; the ending of `path` says how, .exr or .png.

    Raises RuntimeError where Blender cannot write it.
    """
    _write(scene, bpy.data.images["Render Result"], path)


def show(scene: bpy.types.Scene, linear: Path, path: Path) -> None:
    """Writes a scene-linear EXR as a PNG, through the scene's view transform.

    Raises RuntimeError where Blender cannot read or write it.
    """
    image = bpy.data.images.load(str(linear))
    try:
        _write(scene, image, path)
    finally:
        bpy.data.images.remove(image)


def _write(scene: bpy.types.Scene, image: bpy.types.Image, path: Path) -> None:
    settings = scene.render.image_settings
    if path.suffix == ".exr":
        settings.file_format, settings.color_depth = "OPEN_EXR", "16"
        settings.exr_codec = "ZIP"
    else:
        settings.file_format, settings.color_depth = "PNG", "8"
    settings.color_mode = "RGB"
    settings.compression = 100
    image.save_render(str(path), scene=scene)
