# SPDX-License-Identifier: GPL-2.0-or-later
"""Portraits without Blender: the wires of a chip, where the lamps stand, and wrong input."""

from __future__ import annotations

import contextlib
import gzip
import io
import math
import sys
import unittest
from pathlib import Path

import numpy as np
from import_support import box, write_layouts
from support import CommandCase, write

from icwafer import cli
from icwafer.chips.die import generate
from icwafer.chips.presets import PRESETS
from icwafer.layout_import.importer import import_layout
from icwafer.layout_import.process import read_process
from icwafer.layout_import.reader import Request
from icwafer.pictures import Camera
from icwafer.portrait.order import Order
from icwafer.portrait.rig import Pose, direction_to_lamp, rig, spacings_nm
from icwafer.portrait.wires import Wires, read_wires

#: 60 x 40 um: met1 wires along x every 1 um, and a wide met4 strap and a met4 triangle over them.
CHIP = {
    "cells": {
        "chip": {
            "68/20": [box(0, 1000 * y, 60_000, 1000 * y + 400) for y in range(40)],
            "71/20": [
                box(10_000, 0, 14_000, 40_000),
                [(30_000, 0), (30_000, 9_000), (39_000, 0)],
            ],
        }
    }
}


class WiresTest(CommandCase):
    def setUp(self) -> None:
        super().setUp()
        path = self.folder / "chip.gds"
        write_layouts({path: CHIP})
        request = Request(path, read_process("sky130"))
        self.wires = read_wires(request, import_layout(request))

    def test_every_shape_is_there_at_its_height(self) -> None:
        # 40 wires, strap, triangle, and what lies between them.
        self.assertEqual(len(self.wires.corners_um), 43)
        area = np.zeros(43)
        for index, (x, y) in enumerate(self.wires.corners_um.transpose(0, 2, 1)):
            area[index] = (y @ np.roll(x, -1) - x @ np.roll(y, -1)) / 2  # clockwise
        high = self.wires.bottom_um > 1.0
        self.assertAlmostEqual(area[high].sum(), 4 * 40 + 9 * 9 / 2)
        self.assertAlmostEqual(area[~high][:-1].sum(), 40 * 60 * 0.4)
        # sky130's stack: bottoms of met4 and met1, and a thickness.
        self.assertAlmostEqual(self.wires.bottom_um.max(), 4.0211 - 1.3761)
        self.assertAlmostEqual((self.wires.top_um - self.wires.bottom_um)[high].min(), 0.845)

    def test_wires_are_of_the_grating_and_straps_are_not(self) -> None:
        spacing, share = (self.wires.attributes[n] for n in ("spacing_nm", "diffraction"))
        narrow = (self.wires.top_um - self.wires.bottom_um > 0.3) & (self.wires.bottom_um == 0)
        self.assertEqual(narrow.sum(), 40)
        np.testing.assert_allclose(spacing[narrow], 1000.0, rtol=1e-3)
        np.testing.assert_allclose(share[narrow], 1.0, atol=0.05)
        self.assertTrue((share[self.wires.bottom_um > 1.0] == 0.0).all())

    def test_a_file_keeps_everything(self) -> None:
        path = self.folder / "wires.npz"
        self.wires.write(path)
        again = Wires.read(path)
        np.testing.assert_array_equal(again.corners_um, self.wires.corners_um)
        np.testing.assert_array_equal(again.top_um, self.wires.top_um)
        self.assertEqual(again.attributes.keys(), self.wires.attributes.keys())

    def test_an_order_keeps_everything(self) -> None:
        order = Order("a", "b", True, (640, 360), 8, "c.png", "", {"metal": "COPPER"})
        order.write(self.folder / "order.json")
        self.assertEqual(Order.read(self.folder / "order.json"), order)


class RigTest(unittest.TestCase):
    def test_a_lamp_shows_an_order_by_the_grating_law(self) -> None:
        for polar in (0.0, 30.0, 50.0):
            for turn in (-20.0, 0.0, 74.0):
                for spacing_nm in (460.0, 920.0, 1080.0, 2720.0):
                    with self.subTest(polar=polar, turn=turn, spacing_nm=spacing_nm):
                        self.check(math.radians(polar), math.radians(turn), spacing_nm)

    def check(self, polar: float, turn: float, spacing_nm: float) -> None:
        to_camera = np.array([0.0, -math.sin(polar), math.cos(polar)])
        along = np.array([math.cos(turn), math.sin(turn), 0.0])
        to_lamp = direction_to_lamp(to_camera, along, spacing_nm)
        self.assertAlmostEqual(float(np.linalg.norm(to_lamp)), 1.0)
        self.assertGreater(to_lamp[2], 0.3)
        q = to_lamp + to_camera
        self.assertAlmostEqual(float(q @ along), 0.0)
        u_nm = abs(float(q @ np.cross([0, 0, 1], along))) * spacing_nm
        # A whole order of visible light: of 550 nm unless that leaves at more than u = 0.8.
        order = max(1, round(u_nm / 550))
        self.assertTrue(math.isclose(u_nm, order * 550) or 0.65 * 550 < u_nm < 550, u_nm)

    def test_the_subject_fills_the_picture_and_stays_inside(self) -> None:
        for extent in ((10.0, 7.0), (10.0, 2.5)):
            for turn in (-16.0, 74.0):
                pose = Pose(turn_deg=turn, polar_deg=42.0, fill=0.9)
                camera = rig(extent, (1000.0, 1000.0), pose, 16 / 9).camera
                seen = np.abs(self.projected(camera, extent, turn) * [1.0, 16 / 9])
                self.assertLess(seen.max(), 0.9001)
                self.assertGreater(seen.max(), 0.89)

    @staticmethod
    def projected(camera: Camera, extent: tuple[float, float], turn_deg: float) -> np.ndarray:
        """Corners (4, 2) as seen: 1 at the sides of a sensor 36 mm wide."""
        turn = math.radians(turn_deg)
        x, y = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)]).T * np.array(extent)[:, None] / 2
        points = np.stack(
            [x * math.cos(turn) - y * math.sin(turn), x * math.sin(turn) + y * math.cos(turn)]
        ).T
        place = np.array(camera.position_mm)
        forward = np.array(camera.target_mm) - place
        forward /= np.linalg.norm(forward)
        right = np.cross(forward, [0, 0, 1])
        right /= np.linalg.norm(right)
        away = np.insert(points, 2, 0.0, axis=1) - place
        flat = np.stack([away @ right, away @ np.cross(right, forward)], axis=1)
        return flat / (away @ forward)[:, None] * camera.lens_mm / 18.0

    def test_lamps_show_a_narrow_band_and_what_is_mirrored_takes_no_samples(self) -> None:
        pose = Pose(turn_deg=-16.0, polar_deg=42.0, fill=0.9)
        *lamps, card = rig((10.0, 7.0), (460.0, 2720.0), pose, 16 / 9).lights
        self.assertEqual([lamp.kind for lamp in lamps], ["AREA", "AREA"])
        self.assertEqual(card.kind, "CARD")
        for lamp, spacing_nm in zip(lamps, (460.0, 2720.0)):
            distance = math.hypot(*lamp.position_mm)
            # du = d lambda / spacing; 100 nm is about what one colour has of the spectrum.
            self.assertLess(lamp.size_mm[1] / distance * spacing_nm, 100.0)
            self.assertGreater(lamp.size_mm[0], lamp.size_mm[1])

    def test_spacings_are_those_of_the_main_groups(self) -> None:
        # DRAM: one spacing for the cells, which are nearly all of the die.
        layout = PRESETS["dram"]
        cells = next(g for g in layout.dies[0].groups if g.kind.name == "MEMORY")
        found = spacings_nm(generate(layout.dies[0]))
        self.assertTrue(any(math.isclose(s, cells.spacing_nm.mean, rel_tol=0.01) for s in found))


class WrongInputTest(CommandCase):
    def setUp(self) -> None:
        super().setUp()
        self.blender = write(self.folder / "blender", "#!/bin/sh\nexit 1\n", 0o755)
        self.set_environment(ICWAFER_BLENDER=str(self.blender))
        self.good = self.folder / "good.gds"
        write_layouts({self.good: CHIP})

    def refused(self, *arguments: str | Path) -> str:
        error = io.StringIO()
        with contextlib.redirect_stderr(error), contextlib.redirect_stdout(io.StringIO()):
            status = cli.main(["portrait", *map(str, arguments)])
        self.assertNotEqual(status, 0)
        self.assertEqual(len(error.getvalue().splitlines()), 1, error.getvalue())
        return error.getvalue()

    def test_each_is_one_line_that_names_the_thing(self) -> None:
        output = self.folder / "out" / "chip.png"
        output.parent.mkdir()
        text = write(self.folder / "text.gds", "not a layout\n")
        half = self.folder / "half.gds.gz"
        half.write_bytes(gzip.compress(self.good.read_bytes())[:-40])
        wrong = write(self.folder / "x.layout.toml", 'format = "icwafer-layout"\nversion = 7\n')
        for arguments, words in (
            ((self.folder / "none.gds",), "none.gds: no such file"),
            ((text,), "text.gds"),
            ((half,), "half.gds.gz"),
            ((wrong,), "x.layout.toml:2"),
            ((write(self.folder / "chip.txt", ""),), "name such a file"),
            ((self.good, "--layers", "sky131"), "sky130"),
            ((self.good, "--top", "chop"), "'chip'"),
            ((self.good, "--size", "8x8"), "16 to 8192"),
            ((self.good, "--samples", "0"), "'0'"),
            ((self.good, "-o", self.folder / "a.gif"), ".png or .jpg"),
            ((self.good, "-o", self.folder / "b" / "a.png"), "no such folder"),
        ):
            with self.subTest(words):
                given = arguments if "-o" in arguments else (*arguments, "-o", output)
                self.assertIn(words, self.refused(*given))
        self.assertEqual(list(output.parent.iterdir()), [])

    def test_a_failing_blender_leaves_the_last_picture(self) -> None:
        output = write(self.folder / "chip.png", "last")
        self.assertIn("failed", self.refused(self.good, "-o", output))
        self.assertEqual(output.read_text(), "last")
        self.assertEqual([p.name for p in self.folder.glob(".portrait-*")], [])

    def test_no_blender(self) -> None:
        self.set_environment(ICWAFER_BLENDER=str(self.folder / "none"))
        self.assertIn("ICWAFER_BLENDER", self.refused(self.good, "-o", self.folder / "x.png"))


if __name__ == "__main__":
    sys.exit(unittest.main())
