# SPDX-License-Identifier: GPL-2.0-or-later
"""Wafers: their shape, where dies stand, and how these drift."""

from __future__ import annotations

import math
import sys
import unittest
from dataclasses import replace
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts" / "python"))

from icwafer.chips.check import check_layout  # noqa: E402
from icwafer.chips.model import DieSpec, Layout  # noqa: E402
from icwafer.chips.outline import (  # noqa: E402
    FLATS_MM,
    MARKS,
    THICKNESS_MM,
    edge_profile_mm,
    flats,
    outline_mm,
)
from icwafer.chips.placement import (  # noqa: E402
    WaferMap,
    blank_fields_mm,
    drift_at,
    place_dies,
    reticle_field,
)
from icwafer.chips.presets import PRESETS  # noqa: E402
from icwafer.chips.wafer import Drift, Wafer  # noqa: E402
from icwafer.errors import IcwaferError  # noqa: E402

GROUPS = PRESETS["spacing-clustered"].dies[0].groups
WAFERS = [
    Wafer(diameter_mm=diameter, mark=mark)
    for diameter, marks in MARKS.items()
    for mark in (*marks, "none")
]


def layout(width_mm: float, height_mm: float, wafer: Wafer, *tests: DieSpec) -> Layout:
    return Layout((DieSpec(GROUPS, width_mm=width_mm, height_mm=height_mm), *tests), wafer)


def corners_mm(places: WaferMap, dies: tuple[DieSpec, ...]) -> np.ndarray:
    """(n, 4, 2), from the definition."""
    sizes = np.array([(die.width_mm, die.height_mm) for die in dies])[places.die]
    signs = np.array([(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)])
    return places.centre_mm[:, None] + signs * sizes[:, None]


def polygon_area(points: np.ndarray) -> float:
    x, y = points.T
    return float((x * np.roll(y, -1) - np.roll(x, -1) * y).sum() / 2)


def segment_area(radius: float, chord: float) -> float:
    """Of the piece that a chord cuts from a circle."""
    half = math.asin(chord / 2 / radius)
    return radius**2 * (half - math.sin(half) * math.cos(half))


def distance_to(polygon: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Of points (n, 2) from the nearest side of a polygon (m, 2)."""
    side = np.roll(polygon, -1, axis=0) - polygon
    offset = points[:, None] - polygon
    along = (offset * side).sum(axis=2) / (side * side).sum(axis=1)
    return np.hypot(*(offset - np.clip(along, 0, 1)[:, :, None] * side).T).min(axis=0)


class Outline(unittest.TestCase):
    def test_area_is_the_circle_less_its_marks(self) -> None:
        for wafer in WAFERS:
            radius = wafer.radius_mm
            missing = math.pi * radius**2 - polygon_area(outline_mm(wafer, segments=20_000))
            if wafer.mark == "none":
                self.assertAlmostEqual(missing, 0.0, delta=0.01)
            elif wafer.mark == "flats":
                lengths = FLATS_MM[wafer.diameter_mm]
                expected = sum(segment_area(radius, length) for length in lengths)
                self.assertAlmostEqual(missing, expected, delta=0.01)
            else:  # a triangle 1 mm high with a right angle has 1 mm2; rounding makes it wider
                self.assertTrue(1.0 < missing < 2.2, missing)

    def test_marks_are_as_deep_and_long_as_semi_m1_says(self) -> None:
        for wafer in WAFERS:
            points = outline_mm(wafer)
            radii = np.hypot(*points.T)
            self.assertAlmostEqual(radii.max(), wafer.radius_mm, places=9)
            if wafer.mark == "notch":
                self.assertAlmostEqual(radii.min(), wafer.radius_mm - 1.0, places=9)
                bottom = points[np.argmin(radii)]
                np.testing.assert_allclose(bottom, [0.0, 1.0 - wafer.radius_mm], atol=1e-9)
            if wafer.mark == "flats":
                primary = points[np.isclose(points[:, 1], points[:, 1].min())]
                secondary = points[np.isclose(points[:, 0], points[:, 0].min())]
                lengths = FLATS_MM[wafer.diameter_mm]
                self.assertAlmostEqual(np.ptp(primary[:, 0]), lengths[0], places=6)
                self.assertAlmostEqual(np.ptp(secondary[:, 1]), lengths[1], places=6)

    def test_insets_match_point_by_point_and_lie_inside(self) -> None:
        for wafer in WAFERS:
            rim = outline_mm(wafer)
            for inset in (0.05, 0.35, 1.0):
                inner = outline_mm(wafer, inset)
                self.assertEqual(inner.shape, rim.shape)
                self.assertGreater(polygon_area(inner), 0)
                # Chords of half a degree lie up to 6 um inside their arc.
                np.testing.assert_allclose(distance_to(rim, inner), inset, atol=0.007)

    def test_the_edge_is_as_thick_as_the_wafer(self) -> None:
        for wafer in WAFERS:
            inset, height = edge_profile_mm(wafer).T
            self.assertAlmostEqual(-height[-1], THICKNESS_MM[wafer.diameter_mm])
            self.assertTrue((np.diff(height) < 0).all())
            self.assertAlmostEqual(inset[0], wafer.bevel_mm)
            self.assertAlmostEqual(inset.min(), 0.0)


class Dies(unittest.TestCase):
    SIZES = ((10.0, 10.0), (7.3, 5.1), (25.0, 32.0), (2.0, 3.0))

    def test_complete_dies_are_inside_and_none_is_left_out(self) -> None:
        for wafer in WAFERS:
            for size in self.SIZES:
                one = layout(*size, wafer)
                places = place_dies(one)
                corners = corners_mm(places, one.dies)
                limit = wafer.radius_mm - wafer.edge_exclusion_mm
                self.assertLessEqual(np.hypot(*corners.T).max(initial=0), limit)
                for flat in flats(wafer):
                    out = corners @ np.array(flat.normal)
                    self.assertLessEqual(out.max(), flat.distance_mm - wafer.edge_exclusion_mm)
                self.assertFalse(places.partial.any())
                everything = place_dies(layout(*size, replace(wafer, partial_dies=True)))
                whole = everything.centre_mm[~everything.partial]
                np.testing.assert_array_equal(whole, places.centre_mm)
                edge = corners_mm(everything, one.dies)[everything.partial]
                if wafer.mark == "none":
                    self.assertTrue((np.hypot(*edge.T).max(axis=0) > limit).all())

    def test_partial_dies_leave_no_place_of_the_usable_area_free(self) -> None:
        wafer = Wafer(mark="none", partial_dies=True, scribe_um=0.0)
        one = layout(9.0, 7.0, wafer)
        corners = corners_mm(place_dies(one), one.dies)
        angle = np.linspace(0, 2 * np.pi, 700)
        rim = (wafer.usable_radius_mm - 1e-6) * np.stack([np.cos(angle), np.sin(angle)], axis=1)
        low, high = corners[:, 0], corners[:, 2]
        inside = (rim[:, None] >= low - 1e-9).all(axis=2) & (rim[:, None] <= high + 1e-9).all(2)
        self.assertTrue(inside.any(axis=1).all())

    def test_lanes_are_between_all_dies(self) -> None:
        for scribe_um in (0.0, 60.0, 120.0):
            one = layout(7.3, 5.1, Wafer(scribe_um=scribe_um))
            for axis, size in enumerate((7.3, 5.1)):
                at = np.unique(place_dies(one).centre_mm[:, axis].round(9))
                np.testing.assert_allclose(np.diff(at), size + scribe_um / 1000, atol=1e-8)

    def test_their_number_is_near_the_usual_estimate(self) -> None:
        # D. K. de Vries, IEEE Trans. Semicond. Manuf. 18, 2005: pi d^2 / 4 A exp(-2 sqrt(A) / d).
        for size in self.SIZES[:2]:
            area = size[0] * size[1]
            wafer = Wafer(mark="none", scribe_um=0.0, edge_exclusion_mm=0.0)
            estimate = math.pi * 300**2 / 4 / area * math.exp(-2 * math.sqrt(area) / 300)
            self.assertAlmostEqual(
                len(place_dies(layout(*size, wafer))), estimate, delta=0.02 * estimate
            )

    def test_fields_fit_a_reticle_and_hold_their_number_of_dies(self) -> None:
        for size in self.SIZES:
            one = layout(*size, Wafer())
            field = reticle_field(one.dies[0], one.wafer)
            extent = sorted((field.width_mm - 0.08, field.height_mm - 0.08))
            self.assertTrue(extent[0] <= 26 + 1e-9 and extent[1] <= 33 + 1e-9)
            places = place_dies(one)
            fields, counts = np.unique(places.field, axis=0, return_counts=True)
            self.assertEqual(counts.max(), field.columns * field.rows)
            middle = (fields == 0).all(axis=1)
            self.assertEqual(counts[middle].tolist(), [field.columns * field.rows])

    def test_test_fields_replace_products(self) -> None:
        test = DieSpec(GROUPS, name="test", width_mm=6.0, height_mm=6.0)
        wafer = Wafer(test_fields=((1, -1), (-2, 2)))
        one = layout(5.0, 4.0, wafer, test)
        check_layout(one)
        places, plain = place_dies(one), place_dies(replace(one, wafer=Wafer()))
        tests = places.die == 1
        self.assertEqual(
            {tuple(place) for place in places.field[tests].tolist()}, {(1, -1), (-2, 2)}
        )
        in_fields = np.isin(plain.field @ [100, 1], [99, -198])
        np.testing.assert_array_equal(places.centre_mm[~tests], plain.centre_mm[~in_fields])
        corners = corners_mm(places, one.dies)
        low, high = corners[:, 0], corners[:, 2]
        pairs = (low[:, None] < high - 1e-9).all(axis=2)
        self.assertFalse((pairs & pairs.T & ~np.eye(len(low), dtype=bool)).any())

    def test_fields_may_be_moved_and_left_bare(self) -> None:
        wafer = Wafer(field_columns=3, field_rows=5)
        one = layout(4.0, 4.8, wafer)
        plain = place_dies(one)
        moved = place_dies(
            replace(one, wafer=replace(wafer, field_shift_columns=1, field_shift_rows=2))
        )
        np.testing.assert_array_equal(moved.centre_mm, plain.centre_mm)
        pitch = np.array([4.08, 4.88])
        for places, shift in ((plain, (0, 0)), (moved, (1, 2))):
            middle = places.centre_mm[(places.field == 0).all(axis=1)].mean(axis=0)
            offset = np.abs(places.centre_mm / pitch % 1).min(axis=0).round(3)
            np.testing.assert_allclose(middle, (offset - shift) * pitch, atol=1e-9)
        bare = place_dies(replace(one, wafer=replace(wafer, blank_fields=((0, 0), (2, -1)))))
        self.assertEqual(len(plain) - len(bare), 2 * 15)
        self.assertFalse((bare.field == (2, -1)).all(axis=1).any())

    def test_blank_fields_lie_where_no_die_stands(self) -> None:
        wafer = Wafer(field_columns=3, field_rows=5, blank_fields=((0, 0), (2, -1)))
        one = layout(4.0, 4.8, wafer)
        blank = blank_fields_mm(one)
        np.testing.assert_allclose(blank[:, 2:] - blank[:, :2], [(12.24, 24.4)] * 2)
        whole = place_dies(replace(one, wafer=replace(wafer, blank_fields=())))
        for field, rect in zip(wafer.blank_fields, blank):
            inside = ((whole.centre_mm > rect[:2]) & (whole.centre_mm < rect[2:])).all(axis=1)
            np.testing.assert_array_equal(inside, (whole.field == field).all(axis=1))
            self.assertEqual(inside.sum(), 15)

    def test_a_die_or_a_lane_at_the_centre(self) -> None:
        for name, expected in (("die", 0.0), ("lane", 0.5)):
            wafer = Wafer(centre_x=name, centre_y="die")
            centre = place_dies(layout(5.0, 4.0, wafer)).centre_mm / (5.08, 4.08)
            columns = centre[:, 0] - expected
            np.testing.assert_allclose(columns, np.rint(columns), atol=1e-9)
            np.testing.assert_allclose(centre[:, 1], np.rint(centre[:, 1]), atol=1e-9)

    def test_the_rim_cuts_test_fields_where_it_cuts_dies(self) -> None:
        test = DieSpec(GROUPS, name="test", width_mm=6.0, height_mm=6.0)
        wafer = Wafer(test_fields=((5, 2),))
        with self.assertRaisesRegex(IcwaferError, "not wholly on the wafer"):
            check_layout(layout(5.0, 4.0, wafer, test))
        one = layout(5.0, 4.0, replace(wafer, partial_dies=True), test)
        check_layout(one)
        places = place_dies(one)
        tests = places.die == 1
        self.assertTrue(places.partial[tests].any())
        corners = np.hypot(*corners_mm(places, one.dies)[tests].T)
        cut = corners.max(axis=0) > wafer.usable_radius_mm
        np.testing.assert_array_equal(places.partial[tests], cut)

    def test_bad_wafers_are_refused(self) -> None:
        test = DieSpec(GROUPS, name="test", width_mm=6.0, height_mm=6.0)
        for wafer, words in (
            (Wafer(diameter_mm=250), "250 is not one of 100, 125, 150, 200, 300"),
            (Wafer(mark="flats"), "'flats' is not made on 300 mm: use notch or none"),
            (Wafer(field_columns=9), "9 x 1 dies of 5 x 4 mm are more than a reticle holds"),
            (Wafer(test_fields=((9, 0),)), r"field \[9, 0\] is not wholly on the wafer"),
            (Wafer(test_fields=((1, 0), (1, 0))), "twice"),
            (Wafer(edge_exclusion_mm=31), "31 is outside 0 to 30"),
            (Wafer(oxide=Drift(bow=math.inf)), "inf is outside -0.3 to 0.3"),
        ):
            with self.subTest(words), self.assertRaisesRegex(IcwaferError, words):
                check_layout(layout(5.0, 4.0, wafer, test))
        with self.assertRaisesRegex(IcwaferError, "more than 1000000 times on a wafer of 300 mm"):
            check_layout(layout(0.1, 0.1, Wafer()))
        with self.assertRaisesRegex(IcwaferError, "no second die"):
            check_layout(layout(5.0, 4.0, Wafer(test_fields=((0, 0),))))
        with self.assertRaisesRegex(IcwaferError, "27 x 27 mm are more than a reticle"):
            check_layout(layout(27.0, 27.0, Wafer()))


class Drifts(unittest.TestCase):
    DRIFT = Drift(bow=0.03, ring=0.02, tilt=0.01, tilt_direction_deg=90.0)

    def test_the_mean_over_the_wafer_is_zero(self) -> None:
        grid = (np.arange(600) + 0.5) / 300 - 1
        position = 150 * np.stack(np.meshgrid(grid, grid), axis=-1).reshape(-1, 2)
        position = position[np.hypot(*position.T) < 150]
        for name in ("bow", "ring", "tilt"):
            value = drift_at(Drift(**{name: 0.1}), position, 150.0)
            # A circle of pixels: its rim is wrong by a pixel in 300, here and there.
            self.assertAlmostEqual(value.mean(), 0.0, delta=0.1 / 300)
            self.assertAlmostEqual(np.abs(value).max(), 0.1, delta=0.002)

    def test_is_what_the_formula_says_at_centre_and_rim(self) -> None:
        places = np.array([[0.0, 0.0], [0.0, 100.0], [0.0, -100.0], [100.0, 0.0]])
        expected = [-0.03 + 0.02, 0.03 + 0.02 + 0.01, 0.03 + 0.02 - 0.01, 0.03 + 0.02]
        np.testing.assert_allclose(drift_at(self.DRIFT, places, 100.0), expected, atol=1e-12)

    def test_dies_have_it_and_the_noise_comes_from_the_seed(self) -> None:
        wafer = Wafer(oxide=replace(self.DRIFT, noise=0.004), groove=Drift(bow=0.01))
        one = layout(4.0, 4.0, wafer)
        places, again = place_dies(one), place_dies(one)
        other = place_dies(replace(one, wafer=replace(wafer, seed=2)))
        rest = places.oxide_scale - 1 - drift_at(self.DRIFT, places.centre_mm, 150.0)
        self.assertAlmostEqual(rest.std(), 0.004, delta=0.0004)
        self.assertTrue((places.width_scale == 1).all())
        self.assertEqual(places.oxide_scale.tobytes(), again.oxide_scale.tobytes())
        self.assertFalse(np.array_equal(places.oxide_scale, other.oxide_scale))
        np.testing.assert_array_equal(places.groove_scale, other.groove_scale)


if __name__ == "__main__":
    unittest.main()
