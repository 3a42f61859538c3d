# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes without the node look the same in the built Blender and in Debian's own."""

from __future__ import annotations

import unittest

import host
import numpy as np
import pixels


class UnharmedPixels(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        cls.folder = host.fresh_folder("unharmed_pixels")

    def render(self, role: str, scene: str) -> tuple[np.ndarray, np.ndarray]:
        """Render a scene in one of the Blenders; the PNG's and the EXR's pixels."""
        blender = {"built": host.built_blender, "stock": host.stock_blender}[role]()
        png, exr = (self.folder / f"{scene}.{role}.{suffix}" for suffix in ("png", "exr"))
        host.run_inside(
            blender,
            "render_scene",
            {"scene": scene, "png": str(png), "exr": str(exr)},
            folder=self.folder,
            seconds=120,
        )
        return pixels.read(png), pixels.read(exr)

    def assert_same_pixels(self, scene: str) -> None:
        stock_png, stock_exr = self.render("stock", scene)
        built_png, built_exr = self.render("built", scene)
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
