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
    # Not ImageBuf: that remembers files by name, and shows an old one when it was written again.
    file = oiio.ImageInput.open(str(path))
    if file is None:
        raise AssertionError(f"{path} cannot be read: {oiio.geterror()}")
    try:
        return np.asarray(file.read_image(format=oiio.FLOAT))[:, :, :3]
    finally:
        file.close()
