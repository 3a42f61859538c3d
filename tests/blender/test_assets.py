# SPDX-License-Identifier: GPL-2.0-or-later
"""The asset library of the built Blender, and the material presets of the same table."""

from __future__ import annotations

import subprocess
import sys
import tempfile
import unittest
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import host
import numpy as np
import pixels

PACKAGE = host.REPOSITORY / "scripts" / "python"
SOURCES = host.REPOSITORY / "blend_assets" / "library"
sys.path.insert(0, str(PACKAGE))

from icwafer.assets.catalogs import read_catalogs  # noqa: E402
from icwafer.assets.materials import read_materials  # noqa: E402
from icwafer.assets.plan import KINDS  # noqa: E402
from icwafer.chips.presets import PRESETS  # noqa: E402

#: Materials without a grating, or one finer than light, or one that only a die's mesh has.
HARDLY_COLOURED = {"Bare Silicon", "Blu-ray Disc", "Oxide 300 nm", "Die Attributes"}


def library() -> Path:
    """The folder of the library in the built Blender."""
    folder = host.built_blender().resolve().parent / "3.4" / "datafiles" / "icwafer"
    missing = [kind for kind in KINDS if not (folder / f"{kind}.blend").is_file()]
    if missing:
        raise host.MissingProgram(f"{folder} has no {missing[0]}.blend: run 'scripts/icwafer assets'")
    return folder


def assets_of(blend: Path, folder: Path) -> list[dict[str, Any]]:
    """What `inside/append_assets.py` reports of a library file; its pictures go to a folder."""
    folder.mkdir(parents=True, exist_ok=True)
    given = {"blend": str(blend), "folder": str(folder), "width": 96, "height": 54, "samples": 4}
    report = host.run_inside(
        host.built_blender(), "append_assets", given, folder=folder, seconds=300
    )
    return report["assets"]


class Library(unittest.TestCase):
    assets: dict[str, list[dict[str, Any]]]

    @classmethod
    def setUpClass(cls) -> None:
        cls.folder = host.fresh_folder("assets")
        files = [library() / f"{kind}.blend" for kind in KINDS]
        with ThreadPoolExecutor(2) as pool:
            found = pool.map(lambda file: assets_of(file, cls.folder / file.stem), files)
            cls.assets = dict(zip(KINDS, found))
        cls.all = [asset for found in cls.assets.values() for asset in found]

    def test_all_that_is_promised_is_there(self) -> None:
        count = {kind: len(found) for kind, found in self.assets.items()}
        self.assertEqual(count["materials"], len(read_materials(SOURCES / "materials.toml")))
        self.assertEqual(count["dies"], len(PRESETS))
        sizes = {asset["name"].split()[0] for asset in self.assets["wafers"]}
        self.assertLessEqual({"300", "200", "150"}, sizes)
        self.assertGreaterEqual(count["lights"], 6)
        self.assertGreaterEqual(count["studios"], 1)

    def test_every_asset_is_in_a_catalog_that_exists(self) -> None:
        known = {identifier: path for path, identifier in self.catalogs().items()}
        used = set()
        for asset in self.all:
            with self.subTest(asset["name"]):
                self.assertIn(asset["catalog"], known)
                self.assertGreater(len(asset["description"]), 20)
            used.add(known[asset["catalog"]])
        above = {path.rsplit("/", n)[0] for path in used for n in range(path.count("/") + 1)}
        self.assertEqual(above, set(known.values()), "catalogs without assets")

    def catalogs(self) -> dict[str, str]:
        return read_catalogs(library() / "blender_assets.cats.txt")

    def test_materials_are_in_the_catalogs_of_the_table(self) -> None:
        catalogs = self.catalogs()
        wanted = {p.name: catalogs[p.catalog] for p in read_materials(SOURCES / "materials.toml")}
        found = {asset["name"]: asset["catalog"] for asset in self.assets["materials"]}
        self.assertEqual(found, wanted)

    def test_every_preview_shows_something(self) -> None:
        for asset in self.all:
            with self.subTest(asset["name"]):
                self.assertEqual(asset["preview"]["size"], [128, 128])
                self.assertGreater(asset["preview"]["brightest"], 0.4)
                self.assertGreater(asset["preview"]["deviation"], 0.03)

    def test_none_is_black_or_uniform_in_a_new_scene(self) -> None:
        """What differs from the new scene's grey is bright somewhere, and not the same all over."""
        for asset in self.all:
            image = pixels.read(Path(asset["png"]))
            subject = np.abs(image - image[0, 0]).max(axis=2) > 0.03
            with self.subTest(asset["name"]):
                self.assertGreater(subject.mean(), 0.01)
                self.assertGreater(image[subject].max(), 0.35)
                self.assertGreater(image[subject].std(), 0.03)

    def test_they_have_colours_in_a_new_scene(self) -> None:
        for asset in (*self.assets["materials"], *self.assets["dies"], *self.assets["wafers"]):
            if asset["name"] in HARDLY_COLOURED:
                continue
            image = pixels.read(Path(asset["png"]))
            with self.subTest(asset["name"]):
                self.assertGreater(np.ptp(image, axis=2).max(), 0.15)

    def test_built_again_it_is_the_same(self) -> None:
        blend = self.folder / "again" / "lights.blend"
        blend.parent.mkdir(parents=True)
        script = PACKAGE / "icwafer" / "scene" / "library" / "write.py"
        command = [host.built_blender(), "-b", "--factory-startup", "--python-exit-code", "1"]
        done = subprocess.run(
            [*command, "-P", script, "--", "lights", SOURCES, blend],
            capture_output=True,
            text=True,
            timeout=300,
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        again = assets_of(blend, blend.parent)
        for first, second in zip(self.assets["lights"], again, strict=True):
            with self.subTest(first["name"]):
                images = [pixels.read(Path(asset.pop("png"))) for asset in (first.copy(), second)]
                np.testing.assert_array_equal(*images)
                self.assertEqual({k: v for k, v in first.items() if k != "png"}, second)


class Registration(unittest.TestCase):
    def test_it_is_listed_and_the_users_own_libraries_stay(self) -> None:
        with tempfile.TemporaryDirectory() as own:
            facts = host.run_inside(
                host.built_blender(),
                "asset_library_facts",
                {"own": own},
                folder=host.fresh_folder("asset_registration"),
                seconds=60,
            )
            self.assertEqual(facts["start"]["IC Wafer"], str(library()))
            self.assertEqual(facts["later"]["IC Wafer"], str(library()), "the folder has moved")
            self.assertIn(own, facts["later"].values())
            self.assertFalse(facts["changed"], "the preferences would be saved on exit")
            self.assertNotIn("IC Wafer", facts["without"])
            self.assertIn(own, facts["without"].values())
        self.assertEqual(facts["factory"]["IC Wafer"], str(library()))


class Presets(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        cls.table = read_materials(SOURCES / "materials.toml")
        cls.facts = host.run_inside(
            host.built_blender(),
            "material_presets",
            {"presets": [preset.name for preset in cls.table]},
            folder=host.fresh_folder("material_presets"),
            seconds=60,
        )

    def test_each_sets_what_it_names(self) -> None:
        for preset in self.table:
            found = self.facts["values"][preset.name]
            for name, value in preset.node.items():
                with self.subTest(preset.name, input=name):
                    if isinstance(value, str):
                        self.assertEqual(found[name], value)
                    else:
                        self.assertAlmostEqual(found[name], value, delta=1e-5 * abs(value))

    def test_other_nodes_stay_and_a_missing_material_is_made(self) -> None:
        self.assertTrue(self.facts["nodes kept"])
        self.assertEqual(self.facts["surface"], "ShaderNodeBsdfICWafer")
        self.assertEqual(self.facts["new material"], "Compact Disc")

    def test_a_metal_leaves_the_wires_alone(self) -> None:
        self.assertEqual(self.facts["round tracks"], [True, True, False])
        self.assertTrue(self.facts["links after a metal"])
        self.assertEqual(self.facts["links after wires"], [False, True])


class Window(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        folder = host.fresh_folder("asset_window")
        browser, menu = folder / "browser.png", folder / "menu.png"
        cls.facts = host.run_inside(
            host.built_blender(),
            "asset_window",
            {"browser_png": str(browser), "menu_png": str(menu), "pause_s": 2.0},
            folder=folder,
            seconds=400,
            window=True,
        )
        cls.browser, cls.menu = pixels.read(browser), pixels.read(menu)

    def test_the_browser_shows_coloured_previews(self) -> None:
        left, bottom, right, top = self.facts["assets"]
        height = self.browser.shape[0]
        region = self.browser[height - top : height - bottom, left:right]
        coloured = np.ptp(region, axis=2) > 0.25
        self.assertGreater(coloured.mean(), 0.005)
        # They stand in several columns and rows.
        self.assertGreater(coloured.any(axis=0).mean(), 0.3)
        self.assertGreater(coloured.any(axis=1).mean(), 0.3)

    def test_presets_are_undone_and_redone(self) -> None:
        self.assertEqual(self.facts["spacings"], [[], [1580], [920], [1580], [], [1580]])

    def test_the_menu_opens_over_the_window(self) -> None:
        changed = np.abs(self.menu - self.browser).max(axis=2) > 0.02
        self.assertGreater(changed.mean(), 0.1)

    def test_a_die_is_dragged_into_the_scene_with_its_turn(self) -> None:
        name, turn_deg = self.facts["dropped"]
        self.assertEqual(name, "FPGA")
        # The wires' 0 degrees become those that catch the light, minus those of the die's own.
        self.assertGreater(abs(turn_deg), 10.0)


if __name__ == "__main__":
    unittest.main()
