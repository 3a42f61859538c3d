# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes without the node look the same in the built Blender and in Debian's own."""

from __future__ import annotations

import unittest
from pathlib import Path

import host
import numpy as np
import pixels


class UnharmedPixels(unittest.TestCase):
    folder: Path

    @classmethod
    def setUpClass(cls) -> None:
        cls.folder = host.fresh_folder("unharmed_pixels")

    def assert_same_pixels(self, scene: str) -> None:
        def render(role: str, blender: Path) -> tuple[np.ndarray, np.ndarray]:
            png, exr = (self.folder / f"{scene}.{role}.{suffix}" for suffix in ("png", "exr"))
            host.run_inside(
                blender,
                "render_scene",
                {"scene": scene, "png": str(png), "exr": str(exr)},
                folder=self.folder / role,
                seconds=120,
            )
            return pixels.read(png), pixels.read(exr)

        (stock_png, stock_exr), (built_png, built_exr) = host.in_both(render)
        # A picture of nothing would be the same everywhere.
        self.assertGreater(float(np.ptp(stock_png)), 0.3, "the scene shows nothing")
        np.testing.assert_array_equal(built_png, stock_png)
        np.testing.assert_array_equal(built_exr, stock_exr)

    def test_default_scene(self) -> None:
        self.assert_same_pixels("default")

    def test_rich_scene(self) -> None:
        """Closures, hair, volume, subsurface, displacement of normals, subdivision, every lamp."""
        self.assert_same_pixels("rich")


if __name__ == "__main__":
    unittest.main()
