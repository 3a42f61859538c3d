# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures of assets for the asset browser, rendered by Cycles and stored with the asset."""

from __future__ import annotations

import tempfile
from pathlib import Path

import bpy
import numpy as np

#: Side of a preview in pixels; the browser shows about 100 of them.
SIZE = 128


def render_preview(scene: bpy.types.Scene, asset: bpy.types.ID) -> None:
    """Renders a scene and makes the picture the preview of an asset."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "preview.png"
        scene.render.filepath = str(path)
        bpy.ops.render.render(write_still=True, scene=scene.name)
        image = bpy.data.images.load(str(path))
        pixels = np.empty(SIZE * SIZE * image.channels, dtype=np.float32)
        image.pixels.foreach_get(pixels)
        bpy.data.images.remove(image)
    preview = asset.preview_ensure()
    preview.image_size = (SIZE, SIZE)
    preview.image_pixels_float.foreach_set(pixels)
    # The small picture beside the name; else Blender would draw one of its own with EEVEE.
    side = 32
    step = SIZE // side
    small = pixels.reshape(side, step, side, step, -1).mean(axis=(1, 3))
    preview.icon_size = (side, side)
    preview.icon_pixels_float.foreach_set(small.astype(np.float32).ravel())
