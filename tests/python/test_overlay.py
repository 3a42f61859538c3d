# SPDX-License-Identifier: GPL-2.0-or-later
"""The predicted orders: against the angles of the textbook, and that curves lie where they say."""

from __future__ import annotations

import math
import unittest

import numpy as np

from icwafer.compare import overlay
from icwafer.compare.overlay import Plane
from icwafer.pictures import Camera

SIZE = (640, 360)
ABOVE = Camera(position_mm=(0.0, 0.0, 1000.0), target_mm=(0.0, 0.0, 0.0), lens_mm=36.0)


def pixel_of(x_mm: float, y_mm: float) -> tuple[float, float]:
    """Of a point of the plane z = 0 under the camera ABOVE: 36 mm lens, 36 mm sensor."""
    return 320 + x_mm / 1000 * 640, 180 - y_mm / 1000 * 640


class Angles(unittest.TestCase):
    def test_first_order_at_normal_incidence(self) -> None:
        """Wires along x, lamp at the camera's place: at the angle theta both directions have the
        sine, so that 2 sin(theta) = m lambda / d; they point back to the middle."""
        curves = overlay.grating_overlay(SIZE, ABOVE, ABOVE.position_mm, Plane(), 2720.0, 0.0)
        for curve in curves:
            if not curve.order:
                continue
            sine = curve.order * curve.wavelength_nm / 2720 / 2
            expected = pixel_of(0.0, -1000 * math.tan(math.asin(sine)))[1]
            middle = curve.segments[np.abs(curve.segments[:, 0] - 320).argmin()]
            self.assertAlmostEqual(middle[1], expected, delta=0.2)
        self.assertGreater(len(curves), 6)

    def test_wires_turned_by_a_quarter(self) -> None:
        flat, turned = (
            overlay.deflection(SIZE, ABOVE, (0, 0, 500), Plane(), angle,
                               np.array([400.0]), np.array([100.0]))
            for angle in (0.0, math.pi / 2)
        )  # fmt: skip
        # Across becomes along, and along the opposite of across.
        self.assertAlmostEqual(turned[0][0], -flat[1][0])
        self.assertAlmostEqual(turned[1][0], flat[0][0])

    def test_conical(self) -> None:
        """q of one point by hand, light and eye outside the plane of incidence."""
        x, y = pixel_of(120.0, -70.0)
        light = np.array([300.0, 200.0, 400.0])
        u, v = overlay.deflection(
            SIZE, ABOVE, tuple(light), Plane(), math.radians(30), np.array([x]), np.array([y])
        )
        point = np.array([120.0, -70.0, 0.0])
        q = sum(
            (end - point) / np.linalg.norm(end - point)
            for end in (light, np.array([0, 0, 1000.0]))
        )
        self.assertAlmostEqual(u[0], q @ [-0.5, math.sqrt(0.75), 0], places=9)
        self.assertAlmostEqual(v[0], q @ [math.sqrt(0.75), 0.5, 0], places=9)

    def test_a_tilted_plane(self) -> None:
        """Turning everything together changes nothing."""
        angle = math.radians(40)
        turn = np.array(
            [
                [1, 0, 0],
                [0, math.cos(angle), -math.sin(angle)],
                [0, math.sin(angle), math.cos(angle)],
            ]
        )
        camera = Camera((50.0, -400.0, 500.0), (0.0, 0.0, 0.0))
        turned = Camera(tuple(turn @ camera.position_mm), (0.0, 0.0, 0.0))
        # The camera stays upright, so the middle of the picture is what both see alike.
        middle = np.array([320.0]), np.array([180.0])
        straight = overlay.deflection(SIZE, camera, (90, 80, 300), Plane(), 0.3, *middle)
        tilted = overlay.deflection(
            SIZE, turned, tuple(turn @ [90, 80, 300]), Plane(normal=tuple(turn @ [0, 0, 1])), 0.3,
            *middle,
        )  # fmt: skip
        np.testing.assert_allclose(straight, tilted, atol=1e-9)


class Curves(unittest.TestCase):
    def test_every_end_lies_on_its_order(self) -> None:
        camera = Camera((-11.1, -24.7, 20.9), (0.0, -0.7, 0.0), 66)
        light = (1.0, -3.0, 9.0)
        curves = overlay.grating_overlay(SIZE, camera, light, Plane(), 1000.0, 0.2)
        self.assertGreater(len(curves), 5)
        for curve in curves:
            ends = curve.segments.reshape(-1, 2)
            u, v = overlay.deflection(SIZE, camera, light, Plane(), 0.2, *ends.T)
            if curve.order is None:
                np.testing.assert_allclose(v, 0, atol=1e-3)
            else:
                wanted = curve.order * (curve.wavelength_nm or 0.0) / 1000
                # A chord of 8 pixels bends off the curve by less than a wavelength of 2 nm.
                np.testing.assert_allclose(u, wanted, atol=2e-3)

    def test_segments_join(self) -> None:
        curves = overlay.grating_overlay(SIZE, ABOVE, (0, 0, 600), Plane(), 2000.0, 0.0)
        for curve in curves:
            ends = np.sort(curve.segments.reshape(-1, 2).round(6).view("f8,f8").ravel())
            _, counts = np.unique(ends, return_counts=True)
            self.assertLessEqual(counts.max(), 2)
            self.assertLessEqual((counts == 1).sum(), 2)  # one open curve each

    def test_beyond_the_horizon(self) -> None:
        low = Camera((0.0, -100.0, 5.0), (0.0, 0.0, 5.0))
        u, _ = overlay.deflection(
            SIZE, low, (0, 0, 50), Plane(), 0.0, np.array([320.0, 320.0]), np.array([20.0, 340.0])
        )
        self.assertTrue(np.isnan(u[0]))
        self.assertTrue(np.isfinite(u[1]))


if __name__ == "__main__":
    unittest.main()
