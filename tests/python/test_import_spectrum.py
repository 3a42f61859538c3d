# SPDX-License-Identifier: GPL-2.0-or-later
"""The search for gratings against gratings of which everything is known.

Required: period to 0.1 %, duty cycle to 1 %, direction to 0.1 degrees.
"""

from __future__ import annotations

import unittest

import numpy as np
from import_support import Corners, box, outline, wires

from icwafer.layout_import.fourier import transform
from icwafer.layout_import.outline import Outline, rasterise
from icwafer.layout_import.spectrum import Grating, find_gratings


def turn_deg(one_rad: float, other_deg: float) -> float:
    """Angle between two directions of wires."""
    return abs((np.degrees(one_rad) - other_deg + 90) % 180 - 90)


class GratingCase(unittest.TestCase):
    def expect(self, found: Grating, period: float, duty: float, angle_deg: float) -> None:
        self.assertLess(abs(found.period_um / period - 1), 1e-3, found)
        self.assertLess(abs(found.duty / duty - 1), 1e-2, found)
        self.assertLess(turn_deg(found.direction_rad, angle_deg), 0.1, found)


class CleanGratings(GratingCase):
    def test_any_period_duty_and_direction_in_any_window(self) -> None:
        """Windows hold 5 to 250 periods, and no whole number of them."""
        rng = np.random.default_rng(11)
        for index in range(90):
            period, duty = 10 ** rng.uniform(np.log10(0.2), np.log10(30)), rng.uniform(0.15, 0.85)
            angle = (0.0, 90.0, 45.0, rng.uniform(0, 180))[index % 4]
            side = max(period * rng.uniform(5.1, 9.0), rng.uniform(20, 50))
            tile = outline(wires(period, duty, angle, side / 2, rng.uniform()), side)
            with self.subTest(period=period, duty=duty, angle=angle, side=side):
                found = find_gratings(tile)
                self.assertEqual(len(found), 1)
                self.expect(found[0], period, duty, angle)
                self.assertAlmostEqual(found[0].presence, 1.0, delta=0.01)
                self.assertAlmostEqual(
                    found[0].amplitude, np.sin(np.pi * duty) / np.pi, delta=0.002
                )

    def test_presence_is_the_share_of_tracks_with_a_wire(self) -> None:
        rng = np.random.default_rng(3)
        taken = [w for w in wires(0.46, 0.3, 0.0, 25.0) if rng.random() < 0.6]
        found = find_gratings(outline(taken, 50.0))
        self.expect(found[0], 0.46, 0.3, 0.0)
        self.assertAlmostEqual(found[0].presence, 0.6, delta=0.08)  # of 108 tracks: 1.7 sigma


class SeveralGratings(GratingCase):
    def test_two_in_one_tile(self) -> None:
        left = [clip_x(w, -25, -1) for w in wires(0.68, 0.44, 0.0, 25.0)]
        right = [box(1 + i * 0.92, -25, 1.3 + i * 0.92, 25) for i in range(26)]
        found = find_gratings(outline(left + right, 50.0))
        self.assertEqual(len(found), 2)
        by_period = sorted(found, key=lambda grating: grating.period_um)
        self.expect(by_period[0], 0.68, 0.44, 0.0)
        self.expect(by_period[1], 0.92, 0.3 / 0.92, 90.0)

    def test_a_mesh_is_two_families_across_and_no_diagonal_one(self) -> None:
        rows = [box(-30, -30 + 3.4 * i, 30, -28.4 + 3.4 * i) for i in range(18)]
        gaps = [(-28.4 + 3.4 * i, -30 + 3.4 * (i + 1)) for i in range(17)]
        columns = [
            box(-30 + 2.7 * j, low, -29 + 2.7 * j, high) for j in range(22) for low, high in gaps
        ]
        found = find_gratings(outline(rows + columns, 58.0))
        self.assertEqual(len(found), 2, found)
        by_period = sorted(found, key=lambda grating: grating.period_um)
        self.expect(by_period[0], 2.7, 1.0 / 2.7, 90.0)
        self.expect(by_period[1], 3.4, 1.6 / 3.4, 0.0)

    def test_random_shapes_beside_do_not_move_it(self) -> None:
        rng = np.random.default_rng(5)
        lower = [clip_y(w, -25, 5) for w in wires(0.68, 0.44, 90.0, 25.0)]
        for shapes in (50, 400):
            noise = scattered(rng, shapes, (-25, 6, 25, 25))
            found = find_gratings(outline(lower + noise, 50.0))
            self.expect(found[0], 0.68, 0.44, 90.0)


class NoGrating(unittest.TestCase):
    def test_random_shapes_have_no_period(self) -> None:
        rng = np.random.default_rng(8)
        for index in range(24):
            shapes = int(10 ** rng.uniform(0.5, 3))
            tile = outline(scattered(rng, shapes, (-25, -25, 25, 25)), 50.0)
            self.assertEqual(find_gratings(tile), [], index)

    def test_random_parallel_wires_have_no_period(self) -> None:
        rng = np.random.default_rng(9)
        for index in range(24):
            count = int(10 ** rng.uniform(0.5, 2))
            gaps = rng.dirichlet(np.ones(count + 1)) * (50 - 0.2 * count)
            lefts = -25 + np.cumsum(gaps[:-1]) + 0.2 * np.arange(count)
            tile = outline([box(x, -25, x + 0.2, 25) for x in lefts], 50.0)
            self.assertEqual(find_gratings(tile), [], index)

    def test_nothing_and_everything(self) -> None:
        self.assertEqual(find_gratings(Outline(np.empty((0, 4)), (50.0, 50.0))), [])
        self.assertEqual(find_gratings(outline([box(-25, -25, 25, 25)], 50.0)), [])

    def test_finer_than_light(self) -> None:
        """No order of a period below half a wavelength leaves the chip."""
        for period in (0.045, 0.09, 0.15):
            self.assertEqual(find_gratings(outline(wires(period, 0.5, 0.0, 10.0), 20.0)), [])


class Exactness(unittest.TestCase):
    def setUp(self) -> None:
        rng = np.random.default_rng(2)
        slanted = [(2.0, -3.0), (7.3, 6.1), (9.1, -1.7)]
        self.tile = outline([*scattered(rng, 40, (-15, -15, 1, 15)), slanted], 30.0)

    def test_raster_holds_the_area(self) -> None:
        raster = rasterise(self.tile, 96, 64)
        self.assertGreaterEqual(raster.min(), -1e-5)
        self.assertLessEqual(raster.max(), 1 + 1e-5)
        area = raster.astype(np.float64).sum() * 30**2 / (96 * 64)
        self.assertAlmostEqual(area, self.tile.area_um2, delta=1e-3)

    def test_transform_agrees_with_a_sum_over_fine_pixels(self) -> None:
        side, count = 30.0, 3000
        place = ((np.arange(count) + 0.5) / count - 0.5) * side
        window = np.cos(np.pi * place / side) ** 2
        raster = rasterise(self.tile, count, count)
        for frequency in ((0, 0), (1 / 30, 0), (0.31, -0.2), (0, 1.3), (2.0, 0.1)):
            x, y = (window * np.exp(-2j * np.pi * f * place) for f in frequency)
            numeric = y @ raster @ x * (side / count) ** 2
            exact = transform(self.tile, np.array([frequency]))[0]
            # Pixels of 10 nm: their sinc at 2 cycles/um is 1 - 6e-4.
            self.assertLess(abs(numeric - exact), 1e-3 * abs(exact) + 2e-4, frequency)


def clip_x(corners: Corners, low: float, high: float) -> Corners:
    return [(min(max(x, low), high), y) for x, y in corners]


def clip_y(corners: Corners, low: float, high: float) -> Corners:
    return [(x, min(max(y, low), high)) for x, y in corners]


def scattered(
    rng: np.random.Generator, tries: int, within: tuple[float, float, float, float]
) -> list[Corners]:
    """Rectangles of 0.2 to 3 um at random places that do not touch one another."""
    x0, y0, x1, y1 = within
    placed: list[tuple[float, float, float, float]] = []
    for _ in range(tries):
        w, h = rng.uniform(0.2, 3.0, 2)
        x, y = rng.uniform(x0, x1 - w), rng.uniform(y0, y1 - h)
        if all(x + w < a or c < x or y + h < b or d < y for a, b, c, d in placed):
            placed.append((x, y, x + w, y + h))
    return [box(*rect) for rect in placed]


if __name__ == "__main__":
    unittest.main()
