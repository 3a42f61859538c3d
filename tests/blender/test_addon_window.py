# SPDX-License-Identifier: GPL-2.0-or-later
"""The add-on in Blender's window: search, redo panel, undo, a refused number, the file browser."""

from __future__ import annotations

import sys
import unittest
from pathlib import Path
from typing import Any

import host
import numpy as np
import pixels

sys.path[:0] = [str(host.REPOSITORY / name) for name in ("scripts/python", "tests/python")]

from import_support import box, write_layouts  # noqa: E402

from icwafer.chips.die import generate  # noqa: E402
from icwafer.chips.presets import PRESETS  # noqa: E402

#: The meshes of Blender's default scene: number of faces, and largest side.
CUBE = {"Cube": [6, 2.0]}


class AddOnWindow(unittest.TestCase):
    folder: Path
    facts: dict[str, Any]

    @classmethod
    def setUpClass(cls) -> None:
        cls.folder = host.fresh_folder("addon_window")
        wires = [box(0, i * 680, 40_000, i * 680 + 300) for i in range(58)]
        write_layouts({cls.folder / "chip.gds": {"cells": {"TOP": {"70/20": wires}}}})
        (cls.folder / "bad.gds").write_text("This is not a chip.\n")
        cls.facts = host.run_inside(
            host.built_blender(),
            "addon_window",
            {
                "folder": str(cls.folder),
                "chip": [str(cls.folder), "chip.gds"],
                "bad_chip": str(cls.folder / "bad.gds"),
                "pause_s": 0.3,
            },
            folder=cls.folder,
            seconds=600,
            window=True,
        )

    def shot(self, name: str) -> np.ndarray:
        return pixels.read(self.folder / f"{name}.png")

    def faces(self, name: str) -> dict[str, int]:
        return {thing: faces for thing, (faces, _) in self.facts[name].items() if thing != "Cube"}

    def test_search_finds_it_and_makes_a_die(self) -> None:
        """Search knows what stands in menus, and only that."""
        blocks = len(generate(PRESETS["eight-core"].dies[0]))
        self.assertEqual(self.faces("die"), {"IC Die": blocks + 1})
        self.assertAlmostEqual(self.facts["die"]["IC Die"][1], 2.0, places=3)

    def test_the_menu_opens(self) -> None:
        menu, later = self.shot("add_menu"), self.shot("folded")
        changed = np.abs(menu - later).max(axis=2) > 0.1
        self.assertGreater(int(changed.sum()), 20_000)

    def test_the_redo_panel(self) -> None:
        """Unfolded it is a column of many rows, each with a word or a number on it."""
        left, bottom, right, top = self.facts["panel"]
        self.assertGreater(top - bottom, 300)
        shot = self.shot("unfolded")
        height = shot.shape[0]
        panel = shot[height - top : height - bottom, left:right].mean(axis=2)
        lit_rows = np.ptp(panel, axis=1) > 0.4
        self.assertGreater(int(np.diff(lit_rows.astype(int)).clip(0).sum()), 10)

    def test_redo_with_other_numbers(self) -> None:
        seed, preset = self.faces("other seed"), self.faces("other preset")
        self.assertNotEqual(seed, self.faces("die"))
        self.assertEqual(preset, {"IC Die": len(generate(PRESETS["dram"].dies[0])) + 1})

    def test_redo_of_one_die_leaves_the_other_as_it_is(self) -> None:
        first, second = self.facts["two dies"].items()
        self.assertEqual(first[1], second[1], "they share their material")
        changed = self.facts["other metal"]
        self.assertEqual(changed[first[0]], first[1])
        self.assertEqual((first[1][1], changed[second[0]][1]), ("COPPER", "ALUMINIUM"))

    def test_a_refused_number_leaves_what_was_there(self) -> None:
        self.assertEqual(self.facts["refused"], self.facts["other preset"])

    def test_undo_and_redo(self) -> None:
        self.assertEqual(self.facts["undone"], CUBE)
        self.assertEqual(self.facts["redone"], self.facts["other preset"])

    def test_a_wafer(self) -> None:
        self.assertEqual(list(self.faces("wafer")), ["IC Wafer"])
        self.assertAlmostEqual(self.facts["wafer"]["IC Wafer"][1], 2.0, delta=0.05)

    def test_import_through_the_file_browser(self) -> None:
        self.assertEqual(list(self.faces("imported")), ["chip"])
        self.assertAlmostEqual(self.facts["imported"]["chip"][1], 2.0, places=3)
        self.assertEqual(self.facts["place"], [1.0, 2.0, 3.0], "not at the 3D cursor")
        width, height = self.facts["options"]
        self.assertTrue(width > 150 and height > 300, "no room for its options")
        self.assertEqual(self.facts["import undone"], CUBE)

    def test_the_window_lives_while_a_chip_is_read(self) -> None:
        reading = self.facts["reading"]
        self.assertRegex(reading["status"], r"^Reading chip\.gds: \d+% Cancel$")
        self.assertEqual((reading["readers"], reading["things"]), (1, CUBE))
        self.assertEqual(reading["selected"], 3, "select all did not reach the view")

    def test_escape_leaves_nothing_of_an_import(self) -> None:
        cancelled = self.facts["cancelled"]
        self.assertEqual((cancelled["status"], cancelled["readers"]), ("", 0))
        self.assertEqual(cancelled["things"], CUBE)
        self.assertEqual(cancelled["data"], self.facts["reading"]["data"])

    def test_a_chip_that_cannot_be_read(self) -> None:
        bad = self.facts["bad chip"]
        self.assertEqual((bad["things"], bad["readers"]), (CUBE, 0))
        self.assertEqual(bad["data"], self.facts["cancelled"]["data"])
        report = np.abs(self.shot("bad_chip") - self.shot("reading")).max(axis=2) > 0.1
        self.assertGreater(int(report[300:-300].sum()), 3000, "no report over the view")

    def test_an_import_waits_for_object_mode(self) -> None:
        waiting = self.facts["in edit mode"]
        self.assertIn("waits for Object Mode", waiting["status"])
        self.assertEqual((waiting["things"], waiting["readers"]), (CUBE, 0))
        self.assertEqual(sorted(self.facts["after edit mode"]["things"]), ["Cube", "chip"])


if __name__ == "__main__":
    unittest.main()
