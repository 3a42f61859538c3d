# SPDX-License-Identifier: GPL-2.0-or-later
"""What an import makes of gratings: the node's parameters, groups and blocks."""

from __future__ import annotations

import dataclasses
import unittest

import numpy as np
from import_support import box  # noqa: F401  (sets the path)

from icwafer.layout_import.groups import group_looks, layout_group, rectangles
from icwafer.layout_import.optics import Finding, Look, look_of
from icwafer.layout_import.process import built_in, read_process
from icwafer.layout_import.spectrum import Grating

SKY130 = read_process("sky130")
MET4, MET3 = 1, 2


def grating(period: float, duty: float, presence: float, degrees: float) -> Grating:
    amplitude = presence * np.sin(np.pi * duty) / np.pi
    return Grating(period, duty, float(np.radians(degrees)), float(amplitude))


class Looks(unittest.TestCase):
    def test_stack_of_sky130(self) -> None:
        """Heights from the metal stack of the process's manual, highest first."""
        self.assertEqual([x.name for x in SKY130.layers], ["met5", "met4", "met3", "met2", "met1"])
        # met4 ends at 4.8661 um, below 0.505 um of oxide and 0.42 um of nitride of index 2.02.
        oxide = SKY130.oxide_nm(SKY130.layers[MET4])
        self.assertAlmostEqual(oxide, 505 + 420 * 2.02 / 1.46, delta=0.5)
        # Aluminium in oxide: ((n - 1.46)^2 + k^2) / ((n + 1.46)^2 + k^2), 0.882.
        self.assertAlmostEqual(SKY130.layers[MET4].reflectance, 0.882, delta=0.002)

    def test_the_layer_with_more_visible_power_wins(self) -> None:
        upper = Finding(MET4, 1.0, grating(0.92, 0.33, 0.4, 90))
        lower = Finding(MET3, 0.5, grating(0.68, 0.44, 0.9, 0))
        for seen, expected in ((0.5, MET3), (0.3, MET4)):
            look = look_of([upper, dataclasses.replace(lower, visible=seen)], SKY130)
            self.assertEqual(look.layer, expected, seen)

    def test_parameters(self) -> None:
        look = look_of([Finding(MET3, 0.8, grating(0.68, 0.44, 0.5, 0))], SKY130)
        self.assertAlmostEqual(look.spacing_nm, 680)
        self.assertAlmostEqual(look.width_nm, 299.2)
        self.assertAlmostEqual(look.groove_nm, 845)
        self.assertAlmostEqual(look.diffraction, 0.16)
        self.assertEqual(look.cross_spacing_nm, 0)

    def test_cross_width_gives_the_cross_orders_their_power(self) -> None:
        first = Finding(MET4, 1.0, grating(0.92, 0.33, 0.8, 90))
        second = Finding(MET3, 0.6, grating(0.68, 0.44, 0.7, 0))
        look = look_of([first, second], SKY130)
        self.assertEqual(look.cross_layer, MET3)
        self.assertAlmostEqual(look.cross_spacing_nm, 680)
        shown = np.sin(np.pi * look.cross_width_nm / 680) / np.pi * np.sqrt(look.diffraction)
        self.assertAlmostEqual(shown, 0.6 * second.grating.amplitude, places=9)

    def test_parallel_and_faint_gratings_are_no_second_family(self) -> None:
        first = Finding(MET4, 1.0, grating(0.92, 0.33, 0.8, 90))
        for other in (grating(0.46, 0.3, 0.6, 90), grating(0.68, 0.44, 0.05, 0)):
            self.assertEqual(look_of([first, Finding(MET3, 1.0, other)], SKY130).cross_layer, -1)

    def test_dark(self) -> None:
        self.assertEqual(look_of([], SKY130), Look())
        self.assertEqual(look_of([Finding(MET4, 0.02, grating(1, 0.5, 1, 0))], SKY130), Look())


class Processes(unittest.TestCase):
    def test_all_that_come_with_it_make_sense(self) -> None:
        self.assertEqual(built_in(), ("sg13g2", "sky130"))
        for name in built_in():
            process = read_process(name)
            self.assertEqual(process.name, name)
            for upper, lower in zip(process.layers, process.layers[1:]):
                self.assertGreater(upper.bottom_um, lower.top_um)
                self.assertLessEqual(process.oxide_nm(upper), process.oxide_nm(lower))


class Groups(unittest.TestCase):
    def test_the_order_of_the_tiles_does_not_matter(self) -> None:
        rng = np.random.default_rng(6)
        base = look_of([Finding(MET3, 0.8, grating(0.68, 0.44, 0.5, 0))], SKY130)
        looks = [
            dataclasses.replace(
                base,
                spacing_nm=680 * (1 + 0.004 * rng.standard_normal()),
                diffraction=rng.uniform(0.05, 0.4),
            )
            for _ in range(60)
        ] + [Look()] * 5
        order = rng.permutation(len(looks))
        members, _ = group_looks(looks)
        mixed, _ = group_looks([looks[i] for i in order])
        self.assertEqual(
            [sorted(group) for group in members],
            [sorted(order[i] for i in group) for group in mixed],
        )
        self.assertEqual(sorted(i for group in members for i in group), list(range(len(looks))))

    def test_both_ends_of_the_circle_are_one_direction(self) -> None:
        base = look_of([Finding(MET3, 0.8, grating(0.68, 0.44, 0.5, 0))], SKY130)
        looks = [dataclasses.replace(base, direction_rad=x) for x in (0.001, np.pi - 0.001)]
        members, _ = group_looks(looks)
        self.assertEqual(len(members), 1)
        group = layout_group([looks[i] for i in members[0]], 1, SKY130)
        self.assertAlmostEqual((group.direction_deg + 90) % 180, 90, places=2)

    def test_spread_of_the_spacing(self) -> None:
        base = look_of([Finding(MET3, 0.8, grating(0.68, 0.44, 0.5, 0))], SKY130)
        looks = [dataclasses.replace(base, spacing_nm=x) for x in (679.0, 681.0)]
        group = layout_group(looks, 1, SKY130)
        self.assertAlmostEqual(group.spacing_nm.mean, 680.0)
        self.assertAlmostEqual(group.spacing_variation.mean, 1 / 680, places=6)

    def test_rectangles_cover_every_tile_once(self) -> None:
        rng = np.random.default_rng(7)
        for _ in range(30):
            grid = rng.integers(0, 3, rng.integers(1, 12, 2))
            count = np.zeros_like(grid)
            for x0, y0, x1, y1, group in rectangles(grid):
                count[y0:y1, x0:x1] += 1
                self.assertTrue((grid[y0:y1, x0:x1] == group).all())
            self.assertTrue((count == 1).all())


if __name__ == "__main__":
    unittest.main()
