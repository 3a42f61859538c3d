# SPDX-License-Identifier: GPL-2.0-or-later
"""`icwafer layout import` from files to layouts, with files that KLayout writes for the test."""

from __future__ import annotations

import unittest
from pathlib import Path

import numpy as np
from import_support import TRACKS_DEF, TRACKS_LEF, box, wires, write_layouts
from matplotlib.image import imread
from support import REPOSITORY, CommandCase, write

from icwafer.chips.document import read_layout
from icwafer.layout_import.importer import Imported, import_layout
from icwafer.layout_import.process import read_process
from icwafer.layout_import.reader import Request

#: A real chip, where the data is at hand.
REAL_CHIP = REPOSITORY.parent / "shared" / "data" / "gds" / "gatecat_fpga_top.gds.gz"


def nm(polygons: list) -> list:
    """Micrometres to whole nanometres."""
    return [[(round(1000 * x), round(1000 * y)) for x, y in corners] for corners in polygons]


def imported(path: Path, **request: object) -> Imported:
    return import_layout(Request(path, read_process("sky130"), **request))


class ImportCase(CommandCase):
    def write(self, name: str, layers: dict[str, list], **file: object) -> Path:
        """A file with one cell, TOP; polygons in micrometres."""
        path = self.folder / name
        cells = {"TOP": {layer: nm(polygons) for layer, polygons in layers.items()}}
        write_layouts({path: {"cells": cells, **file}})
        return path


class Gratings(ImportCase):
    def test_every_format_gives_the_same(self) -> None:
        # The wires stick out of the square; the other layer keeps the chip's centre at 0.
        layers = {"69/20": wires(0.8, 0.4, 30.0, 20.0)}
        for name in ("chip.gds", "chip.gds.gz", "chip.oas"):
            path = self.write(name, layers)
            (finding,) = imported(path, tile_um=100, window_um=28).findings[0, 0]
            self.assertEqual(finding.layer, 3)  # of met5, met4, met3, met2, met1
            grating = finding.grating
            self.assertLess(abs(grating.period_um / 0.8 - 1), 1e-3)
            self.assertLess(abs(grating.duty / 0.4 - 1), 1e-2)
            self.assertLess(abs(np.degrees(grating.direction_rad) - 30), 0.1)

    def test_overlaps_count_once(self) -> None:
        single = [box(0, i * 0.68, 40, i * 0.68 + 0.3) for i in range(59)]
        doubled = single + [box(5, i * 0.68, 25, i * 0.68 + 0.3) for i in range(59)]
        one, two = (
            imported(self.write(f"{index}.gds", {"70/20": polygons})).findings[0, 0]
            for index, polygons in enumerate((single, doubled))
        )
        self.assertEqual(one, two)
        self.assertLess(abs(one[0].grating.duty * 0.68 - 0.3), 3e-3)

    def test_what_lies_under_a_plate_is_not_seen(self) -> None:
        lines = [box(0, i * 0.68, 40, i * 0.68 + 0.3) for i in range(59)]
        path = self.write("chip.gds", {"70/20": lines, "72/20": [box(0, 0, 30, 40)]})
        (finding,) = imported(path, tile_um=40).findings[0, 0]
        self.assertAlmostEqual(finding.visible, 0.25, delta=1e-3)

    def test_def_with_its_lef(self) -> None:
        design = write(self.folder / "chip.def", TRACKS_DEF)
        lef = write(self.folder / "tech.lef", TRACKS_LEF)
        (finding,) = imported(design, lef=(lef,)).findings[0, 0]
        self.assertLess(abs(finding.grating.period_um / 0.46 - 1), 1e-3)
        self.assertLess(abs(finding.grating.duty * 0.46 / 0.14 - 1), 1e-2)

    def test_another_process(self) -> None:
        path = self.write("chip.gds", {"8/0": [box(0, i, 40, i + 0.4) for i in range(40)]})
        layers = write(
            self.folder / "mine.toml",
            'format = "icwafer-process"\nversion = 1\nname = "mine"\noxide_top_um = 2.0\n'
            '[[layers]]\nname = "m1"\ngds = ["8/0"]\nbottom_um = 1.0\nthickness_um = 0.5\n'
            'metal = "copper"\n',
        )
        output = self.folder / "chip.layout.toml"
        status, _, error = self.icwafer(
            "layout", "import", str(path), "--layers", str(layers), "-o", str(output)
        )
        self.assertEqual(status, 0, error)
        (group,) = read_layout(output).dies[0].groups
        self.assertAlmostEqual(group.spacing_nm.mean, 1000, delta=1)
        self.assertAlmostEqual(group.width_nm.mean, 400, delta=4)
        self.assertAlmostEqual(group.oxide_nm.mean, 500, delta=1e-6)
        self.assertAlmostEqual(group.groove_nm.mean, 500, delta=1e-6)
        self.assertAlmostEqual(group.diffraction.mean, 1, delta=0.02)


class Layouts(ImportCase):
    def test_equal_tiles_become_one_block_and_the_rest_is_dark(self) -> None:
        """Two thirds of the chip are lines along x, the upper third has one large plate."""
        lines = [box(0, i * 0.8, 90, i * 0.8 + 0.3) for i in range(75)]
        plate = [box(10, 62, 80, 89.9), box(0, 89, 90, 90)]
        path = self.write("chip.gds", {"70/20": lines + plate})
        output, picture = self.folder / "chip.layout.toml", self.folder / "chip.png"
        status, text, error = self.icwafer(
            "layout", "import", str(path), "--tile", "30", "-o", str(output), "--map", str(picture)
        )
        self.assertEqual(status, 0, error)
        self.assertEqual(text.split(), [str(output), str(picture)])
        (die,) = read_layout(output).dies
        self.assertEqual((die.name, die.width_mm, die.height_mm), ("TOP", 0.09, 0.09))
        self.assertEqual(len(die.blocks), 2)
        wired, dark = (die.groups[i] for i in die.blocks.group)
        self.assertEqual(
            die.blocks.rect_nm.tolist(), [[0, 0, 90000, 60000], [0, 60000, 90000, 90000]]
        )
        self.assertAlmostEqual(wired.spacing_nm.mean, 800, delta=0.8)
        self.assertEqual(dark.diffraction.mean, 0)
        pixels = imread(picture)[..., :3]
        self.assertEqual(pixels.shape[:2], (1024, 1024))
        self.assertGreater(pixels[400:].mean(), 5 * pixels[:300].mean())  # the dark third is above

    def test_same_file_same_bytes(self) -> None:
        rng = np.random.default_rng(4)
        lines = [w for w in wires(0.5, 0.4, 0.0, 40.0) if rng.random() < 0.7]
        path = self.write("chip.gds", {"69/20": lines})
        texts = []
        for name in ("a", "b"):
            output = self.folder / f"{name}.layout.toml"
            self.icwafer("layout", "import", str(path), "--tile", "40", "-o", str(output))
            texts.append(output.read_bytes())
        self.assertEqual(*texts)


@unittest.skipUnless(REAL_CHIP.exists(), "the real chip's layout is not at hand")
class RealChip(unittest.TestCase):
    """gatecat_fpga_top of Tiny Tapeout 03: the tracks and rows of sky130, from its manual."""

    def test_tracks_and_rows(self) -> None:
        process = read_process("sky130")
        found = imported(REAL_CHIP, tile_um=50)
        self.assertEqual(found.chip.size_um, (150.0, 170.0))
        middle = found.findings[1, 1]
        for name, period, width, angle in (
            ("met1", 2.72, None, 0),
            ("met2", 0.46, 0.14, 90),
            ("met3", 0.68, 0.30, 0),
            ("met4", 0.92, 0.30, 90),
        ):
            gratings = [f.grating for f in middle if process.layers[f.layer].name == name]
            grating = min(gratings, key=lambda g: abs(g.period_um - period))
            self.assertLess(abs(grating.period_um / period - 1), 1e-3, name)
            turn = (np.degrees(grating.direction_rad) - angle + 90) % 180 - 90
            self.assertLess(abs(turn), 0.1, name)
            if width:
                self.assertLess(abs(grating.duty * period / width - 1), 0.03, name)


if __name__ == "__main__":
    unittest.main()
