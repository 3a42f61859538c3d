# SPDX-License-Identifier: GPL-2.0-or-later
"""Blender's real window, on a virtual screen, with the node in the shader editor."""

from __future__ import annotations

import unittest

import host
import numpy as np
import pixels


class Window(unittest.TestCase):
    facts: dict[str, list[float]]
    shot: np.ndarray

    @classmethod
    def setUpClass(cls) -> None:
        folder = host.fresh_folder("window")
        png = folder / "shader_editor.png"
        cls.facts = host.run_inside(
            host.built_blender(),
            "window_shot",
            {
                "png": str(png),
                "python": str(host.REPOSITORY / "scripts" / "python"),
                "picture": "clustered_groups",
                "pause_s": 4.0,
            },
            folder=folder,
            seconds=120,
            window=True,
        )
        cls.shot = pixels.read(png)

    def part(self, rectangle: list[float]) -> np.ndarray:
        """The pixels in left, bottom, right, top, counted from the window's lower left corner."""
        left, bottom, right, top = (round(edge) for edge in rectangle)
        height = self.shot.shape[0]
        return self.shot[height - top : height - bottom, left:right]

    def test_it_is_the_window(self) -> None:
        width, height = self.facts["window"]
        self.assertEqual(self.shot.shape, (height, width, 3))
        self.assertGreater(width * height, 1_000_000)
        colours = np.unique(np.round(self.shot.reshape(-1, 3) * 255.0), axis=0)
        self.assertGreater(len(colours), 1000, "a picture of hardly anything")

    def test_the_node_is_in_the_editor(self) -> None:
        """All of it, with the green title of a shader node, and with words on its body."""
        left, bottom, right, top = self.facts["node"]
        inside_left, inside_bottom, inside_right, inside_top = self.facts["editor"]
        self.assertTrue(inside_left <= left < right <= inside_right)
        self.assertTrue(inside_bottom <= bottom < top <= inside_top)
        red, green, blue = np.median(self.part([left + 8, top - 14, right - 8, top - 4]), (0, 1))
        self.assertGreater(green, 1.2 * max(red, blue), "the title is not green")
        body = self.part([left + 8, bottom + 8, right - 8, top - 30]).mean(axis=2)
        lit_rows = (np.ptp(body, axis=1) > 0.2).mean()
        self.assertGreater(float(lit_rows), 0.4, "few of its rows have words or sliders")


if __name__ == "__main__":
    unittest.main()
