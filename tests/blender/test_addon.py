# SPDX-License-Identifier: GPL-2.0-or-later
"""The add-on's operators in a Blender without a window: what they make, and what they refuse."""

from __future__ import annotations

import dataclasses
import math
import sys
import unittest
from pathlib import Path
from typing import Any

import host
import numpy as np
import pixels

sys.path[:0] = [str(host.REPOSITORY / name) for name in ("scripts/python", "tests/python")]

from import_support import TRACKS_DEF, TRACKS_LEF, box, write_layouts  # noqa: E402

from icwafer.attributes import DRIFTING, OF_FACES, OF_INSTANCES  # noqa: E402
from icwafer.chips.die import generate, main_direction_rad  # noqa: E402
from icwafer.chips.document import write_layout  # noqa: E402
from icwafer.chips.placement import place_dies  # noqa: E402
from icwafer.chips.presets import PRESETS  # noqa: E402
from icwafer.dependencies import PACKAGE, imported  # noqa: E402

DIE, WAFER, IMPORT = "mesh.ic_die_add", "mesh.ic_wafer_add", "import_scene.ic_chip"

#: From Blender's default scene: where its lamp and its camera are.
LAMP, CAMERA = (4.0762, 1.0055, 5.9039), (7.3589, -6.9258, 4.9583)

LAYER_MAP = """format = "icwafer-process"
version = 1
name = "mine"
oxide_top_um = 2.0
[[layers]]
name = "m1"
gds = ["8/0"]
bottom_um = 1.0
thickness_um = 0.5
metal = "copper"
"""


def lines(layer: str, period_nm: int, width_nm: int, side_nm: int) -> dict:
    """A cell TOP, a square full of wires along x."""
    starts = range(0, side_nm - period_nm, period_nm)
    return {"TOP": {layer: [box(0, y, side_nm, y + width_nm) for y in starts]}}


def write_chips(folder: Path) -> None:
    """The same chip as GDSII, compressed GDSII and OASIS, one as DEF, one of another process."""
    tracks = {"cells": lines("70/20", 680, 300, 40_000)}
    write_layouts(
        {
            folder / "chip.gds": tracks,
            folder / "chip.gds.gz": tracks,
            folder / "chip.oas": tracks,
            folder / "other.gds": {"cells": lines("8/0", 1000, 400, 40_000)},
        }
    )
    (folder / "chip.def").write_text(TRACKS_DEF)
    (folder / "tech.lef").write_text(TRACKS_LEF)
    (folder / "mine.toml").write_text(LAYER_MAP)
    (folder / "text.gds").write_text("This is not a chip.\n")
    (folder / "wrong.layout.toml").write_text(
        'format = "icwafer-layout"\nversion = 1\n[[dies]]\npreset = "dram"\nwidth_mm = -3\n'
    )
    write_layout(folder / "preset.layout.toml", PRESETS["power"])


def steps_in(folder: Path) -> dict[str, dict[str, Any]]:
    """What is done in Blender, by name."""

    def step(operator: str, **options: object) -> dict[str, Any]:
        return {"operator": operator, "options": options}

    def chip(*names: str, **options: object) -> dict[str, Any]:
        files = [{"name": name} for name in names]
        where = {"filepath": str(folder / names[0]), "directory": str(folder)}
        return step(IMPORT, files=files, **where, **options)

    def rendered(name: str, taken: dict[str, Any]) -> dict[str, Any]:
        return taken | {"exr": str(folder / f"{name}.exr")}

    in_edit_mode = "bpy.ops.mesh.primitive_plane_add(); bpy.ops.object.mode_set(mode='EDIT')"
    in_mm = "bpy.context.scene.unit_settings.scale_length = 0.001"
    at_cursor = "bpy.context.scene.cursor.location = (1, 2, 3)"
    wafer = "bpy.data.materials['Chip'].node_tree.nodes['IC Wafer BSDF']"
    change = f"{wafer}.inputs['Coherence Width'].default_value = 3"
    group = {"name": "logic", "spacing_nm": 1500.0, "deviation_nm": 5.0, "oxide_nm": 700.0}
    group |= {"diffraction": 0.9, "turned": 0.0}
    return {
        **{f"die {name}": rendered(f"die {name}", step(DIE, preset=name)) for name in PRESETS},
        "seed": step(DIE, preset="fpga", seed=5, width_mm=6.0, block_um=120.0),
        "group": step(DIE, preset="eight-core", groups=[group]),
        "true scale": step(DIE, preset="power", true_scale=True),
        "true scale in mm": step(DIE, preset="power", true_scale=True) | {"before": in_mm},
        "at cursor": step(DIE) | {"before": at_cursor},
        "edit mode": step(DIE, preset="dram") | {"before": in_edit_mode},
        "not turned": rendered("not turned", step(DIE, preset="dram", catch_light=False)),
        "new material": step("object.ic_material_add") | {"before": "bpy.ops.mesh.ic_die_add()"},
        "equal die": step(DIE, preset="dram") | {"before": "bpy.ops.mesh.ic_die_add()"},
        "other metal": step(DIE, metal="ALUMINIUM") | {"before": "bpy.ops.mesh.ic_die_add()"},
        "changed by hand": step(DIE)
        | {"before": f"bpy.ops.mesh.ic_die_add(); {change}"},
        "too small": step(DIE, preset="eight-core", width_mm=0.1, height_mm=0.1),
        "wafer": rendered("wafer", step(WAFER, preset="eight-core"))
        | {"blend": str(folder / "wafer.blend")},
        "wafer of blocks": rendered(
            "wafer of blocks", step(WAFER, preset="eight-core", viewport="BLOCKS")
        ),
        "wafer 100": step(WAFER, preset="power", diameter_mm="100", partial_dies=True, drift=0.0),
        "too large": step(WAFER, preset="power", width_mm=40.0, height_mm=40.0),
        "gds": chip("chip.gds"),
        "gds.gz": chip("chip.gds.gz"),
        "oas": chip("chip.oas"),
        "def": chip("chip.def", "tech.lef"),
        "layer map": chip("other.gds", "mine.toml"),
        "layer map by path": chip("other.gds", process="OWN", layer_map=str(folder / "mine.toml")),
        "layout": chip("preset.layout.toml"),
        "wafer of a layout": chip("preset.layout.toml", kind="WAFER"),
        "wires": chip("chip.gds", kind="WIRES"),
        "wafer of a small chip": chip("chip.gds", kind="WAFER", diameter_mm="100"),
        "missing": chip("missing.gds"),
        "text": chip("text.gds"),
        "other process": chip("other.gds"),
        "def alone": chip("chip.def"),
        "two chips": chip("chip.gds", "chip.oas"),
        "own process": chip("other.gds", process="OWN"),
        "wrong layout": chip("wrong.layout.toml"),
        "top cell": chip("chip.gds", top="BOTTOM"),
    }


class AddOn(unittest.TestCase):
    folder: Path
    addon: dict[str, Any]
    done: dict[str, dict[str, Any]]

    @classmethod
    def setUpClass(cls) -> None:
        cls.folder = host.fresh_folder("addon")
        write_chips(cls.folder)
        steps = steps_in(cls.folder)
        facts = host.run_inside(
            host.built_blender(),
            "addon_steps",
            {"steps": list(steps.values())},
            folder=cls.folder,
            seconds=180,
        )
        cls.addon = facts["addon"]
        cls.done = dict(zip(steps, facts["steps"]))

    def made(self, name: str) -> dict[str, Any]:
        done = self.done[name]
        self.assertEqual(done.get("result"), ["FINISHED"], done.get("error"))
        return done

    def spacing_nm(self, name: str) -> float:
        """The largest spacing: the ground of a die has none."""
        return self.made(name)["attributes"]["ic_spacing_nm"][1]

    def assert_refused(self, name: str, *parts: str) -> None:
        done = self.done[name]
        self.assertIn("error", done)
        line = done["error"].strip()
        self.assertNotIn("\n", line)
        self.assertNotIn("Traceback", line)
        for part in parts:
            self.assertIn(part, line)
        self.assertFalse(done["left"], "something was left in the file")

    # ---- The add-on itself ---------------------------------------------------------------------

    def test_it_is_on_by_default_and_can_be_switched_off(self) -> None:
        self.assertTrue(self.addon["listed"])
        self.assertTrue(self.addon["off"])
        self.assertTrue(self.addon["on again"])

    def test_it_needs_nothing_before_it_is_used(self) -> None:
        self.assertEqual(self.addon["loaded"], [])

    def test_it_needs_nothing_but_what_is_installed(self) -> None:
        package = Path(self.addon["package"]).parent
        self.assertTrue(package.is_relative_to(host.built_blender().resolve().parent))
        parts = sorted((host.REPOSITORY / "plugin" / "addon").glob("*.py"))
        needed = {file for part in parts for file in imported(part)} - set(parts)
        self.assertGreater(len(needed), 40)
        missing = [
            str(file.relative_to(PACKAGE))
            for file in needed
            if not (package / file.relative_to(PACKAGE)).is_file()
        ]
        self.assertEqual(missing, [])

    # ---- Dies ----------------------------------------------------------------------------------

    def test_every_preset_is_the_die_of_its_layout(self) -> None:
        for name, layout in PRESETS.items():
            with self.subTest(preset=name):
                done, die = self.made(f"die {name}"), generate(layout.dies[0])
                self.assertEqual(done["faces"], len(die) + 1)  # and the ground
                for attribute in OF_FACES:
                    values = getattr(die, attribute.name.removeprefix("ic_")).astype(np.float64)
                    # What a mesh has no attribute for reads as 0.
                    _, high, total = done["attributes"].get(attribute.name, (0.0, 0.0, 0.0))
                    self.assertEqual(high, values.max(), attribute.name)
                    self.assertAlmostEqual(total, values.sum(), delta=1e-6 * abs(values).sum())
                self.assertAlmostEqual(max(done["dimensions"]), 2.0, places=3)
                self.assertEqual(done["selected"], [done["name"]])

    def test_every_preset_shows_colours_in_the_default_scene(self) -> None:
        """Neither black nor uniform: brighter than the grey world, of colours it does not have."""
        for name in PRESETS:
            with self.subTest(preset=name):
                image = pixels.read(self.folder / f"die {name}.exr")
                colourful = np.ptp(image, axis=2) > 0.02
                self.assertGreater(int(colourful.sum()), 20)
                self.assertGreater(float(image[colourful].max()), 1.2 * float(image[0, 0].max()))

    def test_turning_to_the_light_makes_it_bright(self) -> None:
        turned = pixels.read(self.folder / "die dram.exr")
        other = pixels.read(self.folder / "not turned.exr")
        colour = [np.ptp(image, axis=2).sum() for image in (turned, other)]
        self.assertGreater(colour[0], 2 * colour[1])

    def test_the_turn_brings_the_wires_across_the_light(self) -> None:
        towards = [np.array(point) / np.linalg.norm(point) for point in (LAMP, CAMERA)]
        q = sum(towards)
        for name in ("die dram", "die eight-core"):
            wires = main_direction_rad(generate(PRESETS[name[4:]].dies[0]))
            angle = self.made(name)["rotation"][2] + wires
            along = q @ [math.cos(angle), math.sin(angle), 0.0]
            self.assertAlmostEqual(along, 0.0, places=3)

    def test_other_numbers(self) -> None:
        spec = dataclasses.replace(
            PRESETS["fpga"].dies[0], seed=5, width_mm=6.0, block_um=120.0
        )
        self.assertEqual(self.made("seed")["faces"], len(generate(spec)) + 1)
        self.assertNotEqual(self.done["seed"]["faces"], self.done["die fpga"]["faces"])

    def test_other_groups(self) -> None:
        attributes = self.made("group")["attributes"]
        self.assertGreater(attributes["ic_spacing_nm"][1], 1450.0)
        self.assertGreater(attributes["ic_oxide_nm"][1], 680.0)
        self.assertLess(self.spacing_nm("die eight-core"), 1200.0)

    def test_scale(self) -> None:
        width_mm = PRESETS["power"].dies[0].width_mm
        self.assertAlmostEqual(self.made("true scale")["dimensions"][0], width_mm / 1e3, places=5)
        in_mm = self.made("true scale in mm")
        self.assertAlmostEqual(in_mm["dimensions"][0], width_mm, places=3)
        np.testing.assert_allclose(in_mm["scale"], 1.0)

    def test_place(self) -> None:
        np.testing.assert_allclose(self.made("at cursor")["location"], (1, 2, 3))
        np.testing.assert_allclose(self.made("not turned")["rotation"], 0.0, atol=1e-6)

    def test_in_edit_mode_it_joins_the_mesh(self) -> None:
        done = self.made("edit mode")
        self.assertEqual((done["name"], done["mode"]), ("Plane", "EDIT"))

    def test_a_new_material_from_the_attributes(self) -> None:
        self.assertEqual(self.made("new material")["materials"], ["Chip.001", "Chip Ground"])

    def test_equal_materials_are_shared(self) -> None:
        self.assertEqual(self.made("equal die")["materials"], ["Chip", "Chip Ground"])
        for name in ("other metal", "changed by hand"):
            with self.subTest(name):
                self.assertEqual(self.made(name)["materials"], ["Chip.001", "Chip Ground"])

    def test_too_small(self) -> None:
        self.assert_refused("too small", "too small for its floorplan", "width_mm")

    # ---- Wafers --------------------------------------------------------------------------------

    def test_a_wafer_is_full_of_dies(self) -> None:
        done, places = self.made("wafer"), place_dies(PRESETS["eight-core"])
        self.assertEqual(done["instances"], len(places))
        self.assertEqual(set(done["attributes"]), {a.name for a in OF_INSTANCES})
        low, high, _ = done["attributes"]["ic_drift"]
        spread = [np.ptp(getattr(places, f"{quantity}_scale")) for quantity in DRIFTING]
        np.testing.assert_allclose(np.subtract(high, low), spread, atol=5e-6)
        self.assertAlmostEqual(max(done["dimensions"]), 2.0, delta=0.01)
        image = pixels.read(self.folder / "wafer.exr")
        self.assertGreater(int((np.ptp(image, axis=2) > 0.02).sum()), 40)

    def test_what_viewports_show_changes_no_render(self) -> None:
        self.assertEqual(self.made("wafer")["drawn faces"], 1 + self.done["wafer"]["instances"])
        self.assertGreater(self.made("wafer of blocks")["drawn faces"], 1_000_000)
        images = [self.folder / f"{name}.exr" for name in ("wafer", "wafer of blocks")]
        np.testing.assert_array_equal(*map(pixels.read, images))

    def test_another_wafer(self) -> None:
        layout = PRESETS["power"]
        wafer = dataclasses.replace(
            layout.wafer, diameter_mm=100, mark="flats", partial_dies=True
        )
        places = place_dies(dataclasses.replace(layout, wafer=wafer))
        done = self.made("wafer 100")
        # Of a partial die that only touches the usable area nothing may be left.
        self.assertLessEqual(done["instances"], len(places))
        self.assertGreater(done["instances"], int((~places.partial).sum()))
        self.assertEqual(done["attributes"]["ic_drift"][:2], [[0.0] * 3] * 2)

    def test_dies_larger_than_a_reticle(self) -> None:
        self.assert_refused("too large", "reticle", "40 x 40 mm")

    def test_a_saved_wafer_opens_in_a_blender_without_the_add_on(self) -> None:
        stock = host.run_inside(
            host.stock_blender(),
            "addon_file",
            {"blend": str(self.folder / "wafer.blend")},
            folder=self.folder / "stock",
            seconds=120,
        )
        made = self.made("wafer")
        for fact in ("name", "faces", "instances", "attributes", "materials", "scale"):
            self.assertEqual(stock[fact], made[fact])

    # ---- Import --------------------------------------------------------------------------------

    def test_kinds_of_files(self) -> None:
        """Periods as written, to the importer's own accuracy."""
        for name, spacing_nm, side_um in (
            ("gds", 680.0, 40.0),
            ("gds.gz", 680.0, 40.0),
            ("oas", 680.0, 40.0),
            ("def", 460.0, 30.0),
            ("layer map", 1000.0, 40.0),
            ("layer map by path", 1000.0, 40.0),
        ):
            with self.subTest(file=name):
                done = self.made(name)
                self.assertAlmostEqual(self.spacing_nm(name) / spacing_nm, 1.0, delta=1e-3)
                side = done["dimensions"][0] / done["scale"][0]
                self.assertAlmostEqual(1e3 * side, side_um, delta=1.0)

    def test_a_layout_file(self) -> None:
        self.assertEqual(self.made("layout")["faces"], self.made("die power")["faces"])
        self.assertEqual(self.done["layout"]["name"], "preset")
        places = place_dies(PRESETS["power"])
        self.assertEqual(self.made("wafer of a layout")["instances"], len(places))

    def test_wires_one_by_one(self) -> None:
        """A top and four sides of each."""
        self.assertGreaterEqual(self.made("wires")["faces"], 5 * (40_000 // 680))
        self.assertAlmostEqual(self.spacing_nm("wires") / 680.0, 1.0, delta=1e-3)

    def test_a_wafer_of_a_small_chip_shows_it_enlarged(self) -> None:
        self.assertLess(self.made("wafer of a small chip")["instances"], 1000)
        self.assertGreater(self.done["wafer of a small chip"]["instances"], 20)

    def test_bad_files(self) -> None:
        self.assert_refused("missing", "missing.gds", "no such file")
        self.assert_refused("text", "text.gds", "cannot be read")
        self.assert_refused("other process", "other.gds", "8/0", "as Process")
        self.assert_refused("def alone", "chip.def", "selecting them with it")
        self.assert_refused("two chips", "chip.gds, chip.oas")
        self.assert_refused("own process", "layer map")
        self.assert_refused("wrong layout", "wrong.layout.toml:5", "dies[1].width_mm", "0.001")
        self.assert_refused("top cell", "BOTTOM", "TOP")


if __name__ == "__main__":
    unittest.main()
