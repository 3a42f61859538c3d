# SPDX-License-Identifier: GPL-2.0-or-later
"""`icwafer portrait` in the built Blender: files of each kind become pictures."""

from __future__ import annotations

import os
import subprocess
import sys
import unittest
from pathlib import Path

import host
import numpy as np
import pixels

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "scripts" / "python"), str(ROOT / "tests" / "python")]

from import_support import box, write_layouts  # noqa: E402

from icwafer.chips.document import write_layout  # noqa: E402
from icwafer.chips.presets import PRESETS  # noqa: E402

SIZE = (128, 72)
#: 60 x 40 um: met1 wires along x every 1 um, and met4 wires along y over half of them.
CHIP = {
    "cells": {
        "chip": {
            "68/20": [box(0, 1000 * y, 60_000, 1000 * y + 400) for y in range(40)],
            "71/20": [box(900 * x, 0, 900 * x + 300, 40_000) for x in range(33)],
        }
    }
}


class PortraitTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        cls.folder = host.fresh_folder("portrait")
        write_layouts({cls.folder / name: CHIP for name in ("chip.gds", "chip.oas")})
        write_layout(cls.folder / "power.layout.toml", PRESETS["power"])

    def portrait(self, name: str, *options: str) -> np.ndarray:
        """The picture of a file, as a screen shows it."""
        png = self.folder / "picture.png"
        png.unlink(missing_ok=True)
        done = subprocess.run(
            [ROOT / "scripts" / "icwafer", "portrait", self.folder / name, "-o", png]
            + ["--size", "{}x{}".format(*SIZE), "--samples", "8", *options],
            env=os.environ | {"ICWAFER_BLENDER": str(host.built_blender())},
            capture_output=True,
            text=True,
            timeout=300,
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual([p.name for p in self.folder.glob(".portrait-*")], [])
        return pixels.read(png)

    def check(self, image: np.ndarray) -> None:
        """Dark around a subject that fills the picture, is neither black nor burnt out, and has
        colours."""
        self.assertEqual(image.shape, (SIZE[1], SIZE[0], 3))
        self.assertLess(np.median(image[-4:, :10]), 0.3)
        value = image[18:-18, 32:-32].max(axis=-1)
        self.assertGreater(np.percentile(value, 75), 0.2)  # between wires it is dark
        self.assertGreater(value.std(), 0.05)
        self.assertLess((image.min(axis=-1) > 0.97).mean(), 0.1)
        lit = image[18:-18, 32:-32][value > 0.1]
        self.assertGreater((1 - lit.min(axis=-1) / lit.max(axis=-1)).mean(), 0.1)

    def test_a_chip_shows_its_wires_and_an_exr_its_light(self) -> None:
        self.check(self.portrait("chip.gds", "--exr"))
        light = pixels.read(self.folder / "picture.exr")
        self.assertEqual(light.shape, (SIZE[1], SIZE[0], 3))
        self.assertTrue(np.isfinite(light).all())

    def test_oasis_is_the_same_chip(self) -> None:
        np.testing.assert_array_equal(self.portrait("chip.oas"), self.portrait("chip.gds"))

    def test_a_layout_shows_its_die_and_its_wafer(self) -> None:
        die = self.portrait("power.layout.toml")
        self.check(die)
        wafer = self.portrait("power.layout.toml", "--wafer")
        self.check(wafer)
        self.assertGreater(np.abs(die - wafer).mean(), 0.05)

    def test_a_small_chip_fills_a_wafer(self) -> None:
        self.check(self.portrait("chip.gds", "--wafer"))


if __name__ == "__main__":
    unittest.main()
