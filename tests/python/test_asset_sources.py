# SPDX-License-Identifier: GPL-2.0-or-later
"""The asset library's sources: the table of materials and the catalogs."""

from __future__ import annotations

import tempfile
import unittest
from pathlib import Path

from icwafer.assets import catalogs, materials
from icwafer.assets.build import SOURCES, check_sources
from icwafer.chips.presets import metals
from icwafer.errors import IcwaferError
from icwafer.layout_import.process import read_process
from icwafer.study.fields import check

TABLE = """format = "icwafer-materials"
version = 1
[[materials]]
name = "One"
catalog = "Materials/Metals"
description = "What it is"
source = "Where from"
[materials.node]
metal = "COPPER"
"Wire Spacing" = 1000
"""


def error_of(text: str) -> str:
    """What reading a table says, without the file's name."""
    with tempfile.TemporaryDirectory() as name:
        path = Path(name) / "materials.toml"
        path.write_text(text)
        try:
            materials.read_materials(path, check)
        except IcwaferError as error:
            return str(error).removeprefix(str(path))
    raise AssertionError("no error")


class TheTable(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        cls.presets = {
            preset.name: preset
            for preset in materials.read_materials(SOURCES / materials.FILE_NAME, check)
        }

    def test_the_sources_are_consistent(self) -> None:
        check_sources(SOURCES)

    def test_every_kind_that_is_promised_is_there(self) -> None:
        for name in (
            "Fine Logic", "Standard Cells", "SRAM Cells", "DRAM Cells", "Power Mesh", "Copper", "Aluminium",
            "Tungsten", "Bare Silicon", "Oxide 300 nm", "Passivated", "Sensor Pixels",
        ):  # fmt: skip
            self.assertIn(name, self.presets)

    def test_names_are_read_below_a_small_picture(self) -> None:
        for name in self.presets:
            self.assertLessEqual(len(name), 17)

    def test_wires_are_narrower_than_their_spacing(self) -> None:
        for name, preset in self.presets.items():
            for wires in ("Wire", "Cross"):
                spacing = preset.node.get(f"{wires} Spacing", 0)
                if spacing:
                    with self.subTest(name, wires=wires):
                        self.assertLess(preset.node[f"{wires} Width"], spacing)

    def test_discs_have_the_track_pitch_of_their_standards(self) -> None:
        for name, pitch_nm in (("Compact Disc", 1600), ("DVD", 740), ("Blu-ray Disc", 320)):
            self.assertEqual(self.presets[name].node["Wire Spacing"], pitch_nm)
            self.assertTrue(self.presets[name].round_tracks)

    def test_films_are_those_of_the_processes(self) -> None:
        for process_name, title, layers in (
            ("sky130", "sky130", ("met2", "met3", "met4", "met5")),
            ("sg13g2", "SG13G2", ("TopMetal1", "TopMetal2")),
        ):
            process = read_process(process_name)
            for layer in process.layers:
                if layer.name not in layers:
                    continue
                node = self.presets[f"{title} {layer.name}"].node
                with self.subTest(title, layer=layer.name):
                    self.assertAlmostEqual(
                        node["Oxide Thickness"], process.oxide_nm(layer), delta=1.0
                    )
                    # The node's grooves are 2000 nm deep at most.
                    depth_nm = min(1000 * layer.thickness_um, 2000.0)
                    self.assertAlmostEqual(node["Groove Depth"], depth_nm, delta=1.0)
                    self.assertEqual(node["metal"], layer.metal.upper())

    def test_wires_are_those_of_the_dies(self) -> None:
        """The presets of dies have the same layers from the same sources."""
        for name, metal in (
            ("sky130 met2", metals.SKY130_MET2),
            ("sky130 met3", metals.SKY130_MET3),
            ("sky130 met4", metals.SKY130_MET4),
            ("sky130 met5", metals.SKY130_MET5),
            ("SRAM Cells", metals.SKY130_SRAM),
            ("Standard Cells", metals.SKY130_ROW),
            ("SG13G2 TopMetal1", metals.IHP_TOP1),
            ("SG13G2 TopMetal2", metals.IHP_TOP2),
            ("Intel 65 nm M6", metals.INTEL65_M6),
            ("Intel 65 nm M7", metals.INTEL65_M7),
            ("Intel 65 nm M8", metals.INTEL65_M8),
            ("Intel 45 nm M6", metals.INTEL45_M6),
            ("Intel 45 nm M7", metals.INTEL45_M7),
            ("Intel 45 nm M8", metals.INTEL45_M8),
        ):
            node = self.presets[name].node
            with self.subTest(name):
                self.assertEqual(node["Wire Spacing"], metal.spacing_nm)
                self.assertEqual(node["Wire Width"], metal.width_nm)


class Mistakes(unittest.TestCase):
    def test_each_names_line_and_field_and_what_is_allowed(self) -> None:
        for old, new, words in (
            ("version = 1", "version = 2", (":1:", "version = 1")),
            ('metal = "COPPER"', 'metal = "COPER"', (":9:", "node.metal", "'COPPER'")),
            ("= 1000", "= 10", (":10:", "Wire Spacing", "50 to 200000")),
            ('"Wire Spacing"', '"Wire Spacin"', (":10:", "'Wire Spacing'")),
            ("catalog =", "catalogue =", (":5:", "catalogue", "'catalog'")),
            ('source = "Where from"\n', "", (":3:", "has no source")),
            ('"What it is"', "3", (":6:", "description", "write a text")),
        ):
            with self.subTest(new):
                self.assertIn(old, TABLE)
                message = error_of(TABLE.replace(old, new))
                for word in words:
                    self.assertIn(word, message)
                self.assertEqual(len(message.splitlines()), 1)

    def test_a_name_is_there_once(self) -> None:
        again = TABLE[TABLE.index("[[") :]
        self.assertIn(":12: materials[2].name is 'One' twice", error_of(TABLE + again))

    def test_a_catalog_that_does_not_exist(self) -> None:
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            (folder / "materials.toml").write_text(TABLE)
            (folder / "blender_assets.cats.txt").write_text("VERSION 1\n")
            with self.assertRaisesRegex(IcwaferError, "no catalog 'Materials/Metals'.*'One'"):
                check_sources(folder)

    def test_a_line_that_is_no_catalog(self) -> None:
        good = "daffdfd0-5ff0-540f-91eb-eaf3ed37ae9c:Dies:Dies\n"
        with tempfile.TemporaryDirectory() as name:
            path = Path(name) / "cats.txt"
            for text, words in ((f"VERSION 1\n{good}Dies\n", ":3: write"), (good * 2, ":2:.*twice")):
                path.write_text(text)
                with self.assertRaisesRegex(IcwaferError, words):
                    catalogs.read_catalogs(path)


if __name__ == "__main__":
    unittest.main()
