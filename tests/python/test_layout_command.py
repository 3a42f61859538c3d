# SPDX-License-Identifier: GPL-2.0-or-later
"""The command `icwafer layout`, as a user has it."""

from __future__ import annotations

import unittest
import xml.etree.ElementTree as ElementTree

from support import CommandCase, write

from icwafer import packages
from icwafer.chips.document import read_layout
from icwafer.chips.presets import PRESETS
from icwafer.chips.wafer import Wafer


class LayoutCommand(CommandCase):
    def setUp(self) -> None:
        super().setUp()
        self.installed: list[str] = []
        self.replace(packages, install=lambda *purposes: self.installed.extend(purposes))
        self.file = self.folder / "a.layout.toml"

    def new(self, *arguments: str) -> None:
        status, out, err = self.icwafer("layout", "new", *arguments, "-o", str(self.file))
        self.assertEqual((status, out, err), (0, f"{self.file}\n", ""))

    def test_new_writes_every_preset(self) -> None:
        status, out, _ = self.icwafer("layout", "new", "list")
        self.assertEqual((status, out.split()), (0, list(PRESETS)))
        for name, layout in PRESETS.items():
            self.new(name)
            self.assertEqual(read_layout(self.file), layout)
        self.assertEqual(set(self.installed), {"layout"})

    def test_new_takes_a_seed_and_settings(self) -> None:
        self.new(
            "dram", "--seed", "9", "--set", "width_mm=7.5", "--set", "wafer.diameter_mm=200",
            "--set", "dies[test-chip].groups[2].spacing_nm={low = 600, high = 700}",
            "--set", "groups[cells].turned=0.25", "--set", "wafer.test_fields=[]",
        )  # fmt: skip
        layout = read_layout(self.file)
        self.assertEqual((layout.dies[0].seed, layout.dies[0].width_mm), (9, 7.5))
        self.assertEqual(layout.wafer.diameter_mm, 200)
        self.assertEqual(layout.dies[1].groups[1].spacing_nm.low, 600)
        self.assertEqual(layout.dies[0].groups[0].turned, 0.25)

    def test_settings_can_add_a_wafer(self) -> None:
        self.new("spacing-normal", "--set", "wafer.diameter_mm=150", "--set", "wafer.mark=flats")
        self.assertEqual(read_layout(self.file).wafer, Wafer(diameter_mm=150, mark="flats"))

    def test_new_refuses_what_is_wrong_and_writes_nothing(self) -> None:
        for arguments, *parts in (
            (["drm"], "no preset 'drm': did you mean 'dram'?"),
            (["dram", "--seed", "x"], "dies[1].seed: 'x' is not a whole number"),
            (["dram", "--set", "width_mm"], "write KEY=VALUE"),
            (["dram", "--set", "width=3"], "no field 'width'"),
            (["dram", "--set", "wafr.mark=none"], "no field 'wafr': did you mean 'wafer'?"),
            (["dram", "--set", "wafer.mark=flat"], "did you mean 'flats'?"),
            (["dram", "--set", "groups[cell].turned=1"], "did you mean 'cells'?"),
            (["dram", "--set", "groups[99].turned=1"], "groups are 1 to"),
            (["dram", "--set", "groups[1].turned=7"], "dies[1].groups[1].turned: 7 is outside"),
            (["dram", "--set", "..=7"], "is no field"),
            (["dram", "--set", "seed.a.b=7"], "before 'a' has no fields"),
            (["power", "--set", "width_mm=0.2"], "the die is too small for its floorplan"),
        ):
            with self.subTest(arguments):
                command = ["layout", "new", *arguments, "-o", str(self.file)]
                self.expect_error(command, 1, *parts)
        self.expect_error(["layout", "new", "dram", "-o", "a.toml"], 1, "a.toml", ".layout.toml")
        self.expect_error(
            ["layout", "new", "dram", "-o", str(self.folder / "no" / "a.layout.toml")],
            1, "no/a.layout.toml: No such file",
        )  # fmt: skip
        self.assertEqual([p.name for p in self.folder.iterdir()], ["plugin"])

    def test_show_says_what_is_there(self) -> None:
        self.new("microcontroller")
        status, out, _ = self.icwafer("layout", "show", str(self.file))
        self.assertEqual(status, 0)
        for part in ("2.92 x 3.52 mm", "flash", "1580 +- 1.58 nm", "200 mm, notch", "oxide"):
            self.assertIn(part, out)
        shares = [float(word[:-1]) for word in out.split() if word.endswith("%") and word[0] != "+"
                  and word[0] != "-"]  # fmt: skip
        self.assertAlmostEqual(sum(shares), 100.0, delta=0.05 * len(shares))

    def test_show_plots_reproducibly(self) -> None:
        self.new("test-chip")
        for ending in ("svg", "png"):
            plots = [self.folder / f"{name}.{ending}" for name in "ab"]
            for plot in plots:
                status, out, err = self.icwafer(
                    "layout", "show", str(self.file), "--plot", str(plot)
                )
                self.assertEqual((status, err, out.splitlines()[-1]), (0, "", str(plot)))
            first, second = (plot.read_bytes() for plot in plots)
            self.assertEqual(first, second)
            self.assertGreater(len(first), 20_000)
        texts = ElementTree.parse(self.folder / "a.svg").getroot()
        self.assertTrue(texts.tag.endswith("svg"))

    def test_show_refuses_another_kind_of_picture(self) -> None:
        self.new("power")
        command = ["layout", "show", str(self.file), "--plot", str(self.folder / "a.gif")]
        self.expect_error(command, 1, "a.gif", ".png or .svg")
        self.assertFalse((self.folder / "a.gif").exists())

    def test_check_reads_all_files_up_to_a_bad_one(self) -> None:
        self.new("power")
        good = self.icwafer("layout", "check", str(self.file), str(self.file))
        self.assertEqual(good[0], 0)
        self.assertEqual(good[1].count(": good, 1 dies, "), 2)
        bad = write(self.folder / "b.layout.toml", self.file.read_text().replace("IO", "i"))
        text = self.file.read_text().replace("block_um = 42.0", "block_um = 0.0")
        write(bad, text)
        command = ["layout", "check", str(self.file), str(bad)]
        self.expect_error(command, 1, f"{bad}:11: dies[1].block_um: 0 is outside 1 to 5000")
        self.expect_error(["layout", "check", str(self.folder / "c")], 1, "c: No such file")
        self.expect_error(["layout", "check", str(self.folder)], 1, "Is a directory")


if __name__ == "__main__":
    unittest.main()
