# SPDX-License-Identifier: GPL-2.0-or-later
"""What the tests of comparisons and reports share."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import OpenImageIO as oiio
from support import CommandCase

from icwafer import packages
from icwafer.compare import colour


def write_image(
    path: Path, pixels: np.ndarray, channels: tuple[str, ...] = ("R", "G", "B")
) -> Path:
    """PNG as 8 bit, EXR as float."""
    height, width = pixels.shape[:2]
    kind = oiio.FLOAT if path.suffix == ".exr" else oiio.UINT8
    spec = oiio.ImageSpec(width, height, len(channels), kind)
    spec.channelnames = channels
    file = oiio.ImageOutput.create(str(path))
    assert file.open(str(path), spec), file.geterror()
    assert file.write_image(np.ascontiguousarray(pixels, dtype=np.float32)), file.geterror()
    file.close()
    return path


class CompareCase(CommandCase):
    def setUp(self) -> None:
        super().setUp()
        self.replace(packages, install=lambda *purposes: None)
        # The same without a configuration on every machine.
        self.replace(colour, CONFIGURATIONS=())
        self.set_environment(OCIO="")

    def image(self, name: str, pixels: np.ndarray, *channels: str) -> str:
        return str(write_image(self.folder / name, pixels, channels or ("R", "G", "B")))

    def compare(self, status: int, *arguments: str) -> str:
        actual, out, err = self.icwafer("compare", *arguments)
        self.assertEqual(actual, status, out + err)
        return out

    def result(self, status: int, *arguments: str) -> dict:
        path = self.folder / "result.json"
        self.compare(status, *arguments, "--json", str(path))
        return json.loads(path.read_text())
