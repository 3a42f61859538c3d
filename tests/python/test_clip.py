# SPDX-License-Identifier: GPL-2.0-or-later
"""What the rim of a wafer leaves of rectangles."""

from __future__ import annotations

import math
import sys
import unittest
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts" / "python"))

from icwafer.chips.clip import Pieces, cut_to_usable  # noqa: E402
from icwafer.chips.outline import flats  # noqa: E402
from icwafer.chips.wafer import Wafer  # noqa: E402


def tiling(side_mm: float, reach_mm: float) -> np.ndarray:
    """Squares that cover a square around the origin."""
    low = np.arange(-reach_mm, reach_mm, side_mm)
    x, y = (grid.ravel() for grid in np.meshgrid(low, low))
    return np.stack([x, y, x + side_mm, y + side_mm], axis=1)


def area_mm2(polygon: np.ndarray) -> float:
    x, y = polygon.T
    return float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2


def total_mm2(rects: np.ndarray, pieces: Pieces) -> float:
    sides = rects[pieces.whole, 2:] - rects[pieces.whole, :2]
    return float(sides.prod(axis=1).sum()) + sum(area_mm2(part) for _, part in pieces.cut)


class ClipTest(unittest.TestCase):
    def test_a_tiling_becomes_the_usable_disc(self) -> None:
        wafer = Wafer(diameter_mm=300, mark="none", edge_exclusion_mm=3.0)
        for side_mm in (20.0, 3.0):
            with self.subTest(side_mm):
                rects = tiling(side_mm, 160.0)
                pieces = cut_to_usable(rects, wafer)
                # Tangents a quarter of a degree apart enclose 1.6e-6 more than the circle, and
                # small squares have one tangent each.
                disc = math.pi * wafer.usable_radius_mm**2
                self.assertAlmostEqual(total_mm2(rects, pieces) / disc, 1.0, delta=2e-5)

    def test_pieces_are_inside_their_rectangles_and_the_circle(self) -> None:
        wafer = Wafer(diameter_mm=200, mark="notch")
        rects = tiling(7.0, 105.0)
        for index, part in cut_to_usable(rects, wafer).cut:
            self.assertGreater(area_mm2(part), 0.0)
            self.assertTrue((part >= rects[index, :2] - 1e-9).all())
            self.assertTrue((part <= rects[index, 2:] + 1e-9).all())
            self.assertLess(np.hypot(*part.T).max(), wafer.usable_radius_mm + 0.001)

    def test_flats_keep_their_distance(self) -> None:
        wafer = Wafer(diameter_mm=100, mark="flats", edge_exclusion_mm=2.0)
        rects = tiling(4.0, 52.0)
        pieces = cut_to_usable(rects, wafer)
        points = np.concatenate([part for _, part in pieces.cut] + [rects[pieces.whole, :2]])
        for flat in flats(wafer):
            reach = (points @ np.array(flat.normal)).max()
            self.assertAlmostEqual(reach, flat.distance_mm - 2.0, places=6)

    def test_nothing_comes_near_a_notch(self) -> None:
        wafer = Wafer(diameter_mm=300, mark="notch", edge_exclusion_mm=1.0)
        rects = tiling(0.5, 150.0)[: 600 * 8]
        near = np.abs(rects[:, 0]) < 0.4
        kept = rects[cut_to_usable(rects, wafer).whole]
        self.assertTrue(near.any())
        self.assertTrue((np.hypot(kept[:, 0], kept[:, 3] + 149.0) > 0.5).all())


if __name__ == "__main__":
    unittest.main()
