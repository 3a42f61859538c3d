# SPDX-License-Identifier: GPL-2.0-or-later
"""The scene after the photograph "Si wafer" (Enrique Jimenez): its geometry as measured."""

from __future__ import annotations

import unittest

import numpy as np

from icwafer.chips.check import check_layout
from icwafer.chips.die import generate
from icwafer.chips.model import MM, Kind
from icwafer.chips.placement import place_dies, reticle_field
from icwafer.chips.presets import PRESETS
from icwafer.compare.overlay import Plane, deflection
from icwafer.pictures import PICTURES

#: Measured in the photograph, 1024 x 682: from the index of a cell, i to the right and j down from
#: the upper left corner of the lower test field, to pixels; residual 2 pixels.
HOMOGRAPHY = np.array(
    [
        [30.341612, -10.43113, 333.730218],
        [0.848635, 16.501999, 462.957108],
        [-0.001086, -0.011685, 1.0],
    ]
)
#: Where the pattern ends at the rim, in pixels, read off by hand.
RIM = ((115, 432), (140, 495), (200, 572), (285, 635), (112, 317), (162, 225), (215, 175))
#: Corners of fields that hold test dies and of those that are bare, in cells.
TEST_FIELDS = ((0, 0), (3, 0), (3, 5), (-3, -20), (0, -20), (0, -25))
BLANK_FIELDS = ((-9, -20), (-9, 0), (-3, 5), (21, -30), (3, -30))

#: Where the two bars of cells of a die begin and end, in cells: half of their brightness, in the
#: mean of 130 near dies of the photograph.
BARS = ((0.125, 0.445), (0.55, 0.88))

PICTURE = PICTURES["photograph"]
LAYOUT = PRESETS[PICTURE.wafer]


def pitch_mm() -> np.ndarray:
    return reticle_field(LAYOUT.dies[0], LAYOUT.wafer).pitch_mm


def cell_mm(cells: np.ndarray) -> np.ndarray:
    """Where corners of cells (n, 2) are: the middle of cell (14, -9) is the wafer's centre."""
    return (cells - (14.5, -8.5)) * (1, -1) * pitch_mm()


def pixels_of(places_mm: np.ndarray) -> np.ndarray:
    """The picture's camera by its definition: a pinhole, rolled, with a sensor of 36 mm."""
    camera = PICTURE.camera
    width, height = PICTURE.render.size
    forward = np.subtract(camera.target_mm, camera.position_mm)
    forward /= np.linalg.norm(forward)
    level = np.cross(forward, (0, 0, 1))
    level /= np.linalg.norm(level)
    upright = np.cross(level, forward)
    roll = np.radians(camera.roll_deg)
    right = np.cos(roll) * level - np.sin(roll) * upright
    up = np.cos(roll) * upright + np.sin(roll) * level
    ray = np.insert(places_mm, 2, 0.0, axis=1) - camera.position_mm
    scale = camera.lens_mm / 36 * width / (ray @ forward)
    return np.stack([width / 2 + scale * (ray @ right), height / 2 - scale * (ray @ up)], axis=1)


def in_photograph(cells: np.ndarray) -> np.ndarray:
    """Pixels of corners of cells by the measured homography."""
    homogeneous = np.insert(cells.astype(float), 2, 1.0, axis=1) @ HOMOGRAPHY.T
    return homogeneous[:, :2] / homogeneous[:, 2:]


class Geometry(unittest.TestCase):
    def test_the_lattice_of_dies_falls_onto_that_of_the_photograph(self) -> None:
        cells = np.stack(np.mgrid[-8:27, -26:12], axis=-1).reshape(-1, 2)
        seen = in_photograph(cells)
        inside = ((seen > 0) & (seen < (1024, 682))).all(axis=1)
        self.assertGreater(inside.sum(), 700)
        scale = np.array(PICTURE.render.size) / (1024, 682)
        missed = np.hypot(*(pixels_of(cell_mm(cells[inside])) / scale - seen[inside]).T)
        self.assertLess(np.sqrt((missed**2).mean()), 1.0)
        self.assertLess(missed.max(), 3.0)

    def test_dies_stand_on_the_lattice(self) -> None:
        places = place_dies(LAYOUT)
        middle = places.centre_mm[places.die == 0] / pitch_mm()
        np.testing.assert_allclose(middle, np.rint(middle), atol=1e-9)

    def test_the_pattern_ends_where_that_of_the_photograph_does(self) -> None:
        x, y = np.array(RIM, dtype=float).T
        usable = LAYOUT.wafer.usable_radius_mm
        angle = np.radians(np.arange(0, 360, 0.1))
        rim = pixels_of(usable * np.stack([np.cos(angle), np.sin(angle)], axis=1))
        rim *= np.array((1024, 682)) / PICTURE.render.size
        nearest = np.hypot(x[:, None] - rim[:, 0], y[:, None] - rim[:, 1]).min(axis=1)
        self.assertLess(nearest.max(), 5.0)

    def test_fields_are_those_of_the_photograph(self) -> None:
        check_layout(LAYOUT)
        places = place_dies(LAYOUT)
        tests = places.centre_mm[places.die == 1]
        expected = cell_mm(np.array(TEST_FIELDS) + (1.5, 2.5))
        np.testing.assert_allclose(
            tests[np.lexsort(tests.T)], expected[np.lexsort(expected.T)], atol=1e-6
        )
        for field in (*TEST_FIELDS, *BLANK_FIELDS):
            offset = np.stack(np.mgrid[0:3, 0:5], axis=-1).reshape(-1, 2) + 0.5
            for middle in cell_mm(np.array(field) + offset):
                distance = np.hypot(*(places.centre_mm[places.die == 0] - middle).T)
                self.assertGreater(distance.min(), 1.0)

    def test_bars_are_as_wide_as_in_the_photograph(self) -> None:
        # A hundredth of a die is a third of a pixel of the photograph.
        die = generate(LAYOUT.dies[0])
        kinds = np.array([group.kind for group in die.spec.groups])
        cells = die.rect_nm[kinds[die.group] == Kind.PIXEL]
        edges = np.unique(cells[:, [0, 2]], axis=0) / MM
        lane_mm = LAYOUT.wafer.scribe_um / 1000
        np.testing.assert_allclose((edges + lane_mm / 2) / pitch_mm()[0], BARS, atol=0.01)


class Colours(unittest.TestCase):
    def test_orders_two_and_three_share_the_wafer(self) -> None:
        """Read in the photograph: blue of order 2 (490 nm) near, green of order 3 (530 nm) far."""
        spacing_nm = LAYOUT.dies[0].groups[0].spacing_nm.mean
        lamp = PICTURE.lights[0].position_mm
        size = PICTURE.render.size
        x, y = np.array([600.0, 560.0]), np.array([640.0, 80.0])
        scale = np.array(size) / (1024, 682)
        u, _ = deflection(size, PICTURE.camera, lamp, Plane(), 0.0, x * scale[0], y * scale[1])
        near_nm, far_nm = np.abs(u) * spacing_nm
        self.assertAlmostEqual(near_nm / 2, 490, delta=40)
        self.assertAlmostEqual(far_nm / 3, 530, delta=40)


if __name__ == "__main__":
    unittest.main()
