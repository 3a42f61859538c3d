# SPDX-License-Identifier: GPL-2.0-or-later
"""A wafer in Blender is one object with an instance for each die, and its drift is seen."""

from __future__ import annotations

import dataclasses
import math
import sys
import unittest
from pathlib import Path

import host
import numpy as np
import pixels

PACKAGE = Path(__file__).resolve().parents[2] / "scripts" / "python"
sys.path.insert(0, str(PACKAGE))

from icwafer.chips.document import write_layout  # noqa: E402
from icwafer.chips.model import Layout  # noqa: E402
from icwafer.chips.placement import blank_fields_mm, place_dies  # noqa: E402
from icwafer.chips.presets import PRESETS  # noqa: E402
from icwafer.chips.wafer import Drift, Wafer  # noqa: E402


def layout(**fields: object) -> Layout:
    """A wafer of 100 mm full of test chips."""
    wafer = Wafer(**({"diameter_mm": 100, "mark": "flats"} | fields))
    return dataclasses.replace(PRESETS["test-chip"], wafer=wafer)


class WaferTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        folder = host.fresh_folder("wafer")
        cls.layouts = {
            "even": layout(partial_dies=True),
            # Four tenths more oxide and grooves on one side than on the other.
            "drift": layout(partial_dies=True, oxide=Drift(tilt=0.2), groove=Drift(tilt=0.2)),
            "complete": layout(),
            "blank": layout(blank_fields=((0, 0),), film_edge_mm=0.5, mark="none"),
        }
        wafers = []
        for name, made in cls.layouts.items():
            write_layout(folder / f"{name}.layout.toml", made)
            wafers.append(
                {"layout": str(folder / f"{name}.layout.toml"), "exr": str(folder / f"{name}.exr")}
            )
        answer = host.run_inside(
            host.built_blender(),
            "wafer_instances",
            {"package": str(PACKAGE), "wafers": wafers},
            folder=folder,
            seconds=300,
        )
        cls.facts = dict(zip(cls.layouts, answer["wafers"]))
        cls.images = {name: pixels.read(folder / f"{name}.exr") for name in cls.layouts}

    def test_it_is_one_object(self) -> None:
        for facts in self.facts.values():
            self.assertEqual(facts["objects"], ["Wafer"])
            self.assertEqual(set(facts["parents"]), {"Wafer"})
            self.assertTrue(facts["valid"])

    def test_every_die_stands_in_its_place(self) -> None:
        for name in ("even", "complete"):
            with self.subTest(name):
                expected = place_dies(self.layouts[name]).centre_mm
                found = np.array(self.facts[name]["instances"])
                self.assertEqual(len(found), len(expected))
                # Single precision at 50 mm.
                np.testing.assert_allclose(
                    found[np.lexsort(found.T)][:, :2],
                    expected[np.lexsort(found_order(expected))],
                    atol=1e-5,
                )
                np.testing.assert_array_equal(found[:, 2], 0.0)

    def test_partial_dies_are_more(self) -> None:
        self.assertGreater(
            len(self.facts["even"]["instances"]), len(self.facts["complete"]["instances"])
        )

    def test_the_disc_is_as_large_as_the_wafer(self) -> None:
        for facts in self.facts.values():
            self.assertAlmostEqual(facts["reach_mm"], 50.0, delta=0.4)  # less the bevel

    def test_films_cover_what_was_not_exposed_and_end_in_a_line(self) -> None:
        one = self.layouts["blank"]
        areas = self.facts["blank"]["areas_mm2"]
        x0, y0, x1, y1 = blank_fields_mm(one)[0]
        self.assertAlmostEqual(areas["Chip Ground"], (x1 - x0) * (y1 - y0), delta=1e-3)
        inner = one.wafer.usable_radius_mm
        ring = math.pi * ((inner + 0.5) ** 2 - inner**2)
        self.assertAlmostEqual(areas["Film Edge"], ring, delta=0.001 * ring)
        self.assertNotIn("Film Edge", self.facts["even"]["areas_mm2"])

    def test_no_picture_is_black_or_uniform(self) -> None:
        for name, image in self.images.items():
            with self.subTest(name):
                lit = image[image.max(axis=-1) > 0.02 * image.max()]
                self.assertGreater(len(lit), 0.2 * image.shape[0] * image.shape[1])
                colour = lit / lit.sum(axis=-1, keepdims=True)
                self.assertGreater(colour.std(axis=0).max(), 0.02)
                self.assertTrue(np.isfinite(image).all())

    def test_drift_reaches_the_pixels(self) -> None:
        """Where the drift is 0, in the middle, nothing changes; at the sides the colour does."""
        even, drift = (
            image / np.maximum(image.sum(axis=-1, keepdims=True), 1e-6)
            for image in (self.images["even"], self.images["drift"])
        )
        change = np.abs(even - drift).sum(axis=-1)[20:34]
        middle = change[:, 46:50].mean()
        sides = np.concatenate([change[:, 26:34], change[:, 62:70]], axis=1).mean()
        self.assertGreater(sides, 0.02)
        self.assertGreater(sides, 2 * middle)


def found_order(places: np.ndarray) -> np.ndarray:
    """Keys that sort places (n, 2) as those with a third column of 0 are sorted."""
    return np.insert(places, 2, 0.0, axis=1).T


if __name__ == "__main__":
    unittest.main()
