# SPDX-License-Identifier: GPL-2.0-or-later
"""A sweep becomes a moving picture, and a jump in it is found."""

from __future__ import annotations

import json

import numpy as np
from compare_support import CompareCase, write_image
from PIL import Image
from report_fixture import add_job

from icwafer.report import animate

SIDES = ("left", "right")
STEPS = (1, 2, 3, 4, 5)


def brightness(side: str, step: int) -> float:
    """The left grows evenly; the right is above it, and meets it in the last frame."""
    return 0.1 * 1.2**step * (1.0 if side == "left" else 1.0 + 0.1 * (STEPS[-1] - step))


class AnimateTest(CompareCase):
    def setUp(self) -> None:
        super().setUp()
        for side in SIDES:
            for step in STEPS:
                id = f"{side}{step}"
                add_job(self.folder, id, {"settings": {"side": side, "step": step}})
                pixels = np.full((40, 60, 3), brightness(side, step))
                write_image(self.folder / "jobs" / id / "image.exr", pixels)
        axes = [{"name": "side", "values": SIDES}, {"name": "step", "values": STEPS, "unit": "mm"}]
        (self.folder / "study.json").write_text(json.dumps({"name": "Steps", "axes": axes}))
        self.output = self.folder / "moving.webp"

    def animate(self, *arguments: str) -> str:
        status, out, err = self.icwafer(
            "animate", str(self.folder), "-o", str(self.output), "--over", "step", *arguments
        )
        self.assertEqual(status, 0, err)
        return out

    def test_frames_there_and_back(self) -> None:
        self.animate("--beside", "side", "--quality", "95")
        with Image.open(self.output) as moving:
            self.assertEqual((moving.n_frames, moving.size), (8, (124, 40)))
            for frame, step in enumerate((1, 2, 3, 4, 5, 4, 3, 2)):
                moving.seek(frame)
                shown = np.asarray(moving.convert("RGB")) / 255.0
                # Below the text. The sRGB curve, as there is no configuration here.
                for side, x in (("left", 30), ("right", 94)):
                    linear = brightness(side, step)
                    expected = 1.055 * linear ** (1 / 2.4) - 0.055
                    np.testing.assert_allclose(shown[35, x], expected, atol=0.02)

    def test_how_smoothly_it_moves(self) -> None:
        out = self.animate("--beside", "side")
        self.assertIn(
            "mean luminance from frame to frame: 1.200 in the middle, 1.200 at most", out
        )
        self.assertIn("0.000 in the last", out)

    def test_a_jump_is_named(self) -> None:
        path = self.folder / "jobs" / "left4" / "image.exr"
        write_image(path, np.full((40, 60, 3), 0.35))
        self.assertRegex(self.animate(), r"luminance .* 2\.025 at most, to step 4 mm")

    def test_what_cannot_be_animated(self) -> None:
        (self.folder / "jobs" / "left2" / "image.exr").unlink()
        command = ["animate", str(self.folder), "-o", str(self.output), "--over"]
        self.expect_error([*command, "stp"], 1, "no axis 'stp': did you mean 'step'?")
        self.expect_error([*command, "step"], 1, "left2 has no picture")
        self.expect_error([*command[:3], "a.mp4", "--over", "step"], 1, ".webp or .gif")
        self.assertFalse(self.output.exists())

    def test_movement_of_the_first_panel(self) -> None:
        frames = [[np.full((8, 8, 3), value)] for value in (0.5, 0.5, 0.7)]
        found = animate.movement(frames)
        self.assertEqual((found.flip[0], found.beside), (0.0, ()))
        self.assertGreater(found.flip[1], 0.1)
