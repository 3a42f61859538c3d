# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures as arrays."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import OpenImageIO as oiio


def read(path: Path) -> np.ndarray:
    """The pixels of a PNG (0 to 1, as stored) or EXR (scene-linear): float32, height x width x 3.

    Row 0 is the top. AssertionError when the file cannot be read.
    """
    buffer = oiio.ImageBuf(str(path))
    pixels = buffer.get_pixels(oiio.FLOAT)
    if buffer.has_error or pixels is None:
        raise AssertionError(f"{path} cannot be read: {buffer.geterror()}")
    return np.asarray(pixels)[:, :, :3]
