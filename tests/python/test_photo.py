# SPDX-License-Identifier: GPL-2.0-or-later
"""Against a photograph: made-up ones, whose geometry and colours are known."""

from __future__ import annotations

import json
import unittest
from xml.etree import ElementTree

import numpy as np
from compare_support import CompareCase

from icwafer.compare import hues, rectify, srgb
from icwafer.errors import InputError

CORNERS = ((40.0, 30.0), (170.0, 42.0), (190.0, 140.0), (22.0, 128.0))
ARGUMENTS = [f"{x},{y}" for x, y in CORNERS]


def rainbow(t: np.ndarray) -> np.ndarray:
    """A smooth course of hues for places 0 to 1: linear light, no symmetry."""
    phases = np.array([0.0, 2.1, 4.2])
    return 0.3 + 0.25 * np.sin(5.0 * t[..., None] + phases)


def photograph(corners: tuple[rectify.Point, ...] = CORNERS, exposure: float = 1.0) -> np.ndarray:
    """A die of rainbow from top to bottom between the corners, on black; encoded."""
    y, x = np.mgrid[:160, :210] + 0.5
    back = np.linalg.inv(rectify.homography(corners))
    s, t, w = np.moveaxis(np.stack([x, y, np.ones_like(x)], axis=-1) @ back.T, -1, 0)
    s, t = s / w, t / w
    inside = (s > -0.02) & (s < 1.02) & (t > -0.02) & (t < 1.02)
    return srgb.encode(np.where(inside[..., None], rainbow(t) * exposure, 0.0))


def render(shift: float = 0.0) -> np.ndarray:
    t = (np.arange(120) + 0.5) / 120
    return srgb.encode(np.broadcast_to(rainbow(t - shift)[:, None], (120, 160, 3)))


class Rectify(unittest.TestCase):
    def test_homography(self) -> None:
        matrix = rectify.homography(CORNERS)
        for unit, corner in zip(((0, 0), (1, 0), (1, 1), (0, 1)), CORNERS):
            x, y, w = matrix @ [*unit, 1]
            np.testing.assert_allclose((x / w, y / w), corner, atol=1e-9)

    def test_straight_lines_stay_straight(self) -> None:
        """The middle of the rectangle is where the diagonals cross."""
        a, b, c, d = map(np.array, CORNERS)
        share = np.linalg.solve(np.stack([c - a, b - d], axis=1), b - a)[0]
        x, y, w = rectify.homography(CORNERS) @ [0.5, 0.5, 1]
        np.testing.assert_allclose((x / w, y / w), a + share * (c - a), atol=1e-9)

    def test_pixels(self) -> None:
        size = (64, 48)
        flat = rectify.rectify(srgb.decode(photograph()), CORNERS, size)
        expected = np.broadcast_to(rainbow((np.arange(48) + 0.5) / 48)[:, None], flat.shape)
        np.testing.assert_allclose(flat[2:-2, 2:-2], expected[2:-2, 2:-2], atol=0.01)

    def test_a_coarse_rectangle_misses_nothing(self) -> None:
        """Stripes of one pixel average to grey."""
        stripes = np.zeros((90, 120, 3))
        stripes[:, ::2] = 1.0
        whole = ((0, 0), (120, 0), (120, 90), (0, 90))
        np.testing.assert_allclose(rectify.rectify(stripes, whole, (10, 9)), 0.5, atol=0.06)

    def test_unusable_corners(self) -> None:
        a, b, c, d = CORNERS
        for corners in ((a, b, d, c), (b, a, d, c), (a, a, c, d), (a, b, (60, 50), d)):
            with self.assertRaisesRegex(InputError, "not in order around a convex shape"):
                rectify.homography(corners)
        with self.assertRaisesRegex(InputError, "corner 500,42 is outside the picture of 210x160"):
            rectify.rectify(photograph(), (a, (500, 42), (510, 140), d), (9, 9))


class Hues(unittest.TestCase):
    def test_oklab(self) -> None:
        """White has lightness 1 and no chroma; the corners of the gamut have their known hues."""
        np.testing.assert_allclose(hues.to_oklab(np.ones(3)), [1, 0, 0], atol=1e-3)
        for name, colour in (("red", [1, 0, 0]), ("green", [0, 1, 0]), ("blue", [0, 0, 1])):
            _, a, b = hues.to_oklab(np.array(colour, dtype=float))
            self.assertAlmostEqual(
                np.degrees(np.arctan2(b, a)) % 360, hues.NAMED_HUES[name], delta=0.1
            )

    def test_exposure_does_not_count(self) -> None:
        picture = srgb.decode(render())
        found = hues.compare(picture, 0.13 * picture)
        self.assertAlmostEqual(found.hue_distance_deg, 0, places=6)
        self.assertAlmostEqual(found.saturation_distance, 0, places=6)
        self.assertAlmostEqual(found.profile_correlation, 1, places=6)

    def test_turned_hues(self) -> None:
        """Two pictures of one hue each are as far apart as the hues, also across 0 degrees."""

        def flat(hue_deg: float) -> np.ndarray:
            a, b = 0.1 * np.cos(np.radians(hue_deg)), 0.1 * np.sin(np.radians(hue_deg))
            return np.broadcast_to(hues.from_oklab(np.array([0.7, a, b])), (8, 8, 3))

        for first, second, apart in ((20, 90, 70), (350, 30, 40), (10, 190, 180)):
            found = hues.compare(flat(first), flat(second))
            self.assertAlmostEqual(found.hue_distance_deg, apart, delta=360 / hues.HUE_BINS)

    def test_moved_bands(self) -> None:
        still, moved = srgb.decode(render()), srgb.decode(render(shift=0.1))
        found = hues.compare(still, moved)
        self.assertLess(found.profile_correlation, 0.95)
        self.assertAlmostEqual(found.shift, -0.1, delta=0.011)
        self.assertAlmostEqual(found.stretch, 1.0, delta=0.06)
        self.assertGreater(found.best_correlation, 0.995)
        places = [{band.name: band.place for band in p.bands} for p in found.profiles]
        both = set(places[0]) & set(places[1])
        self.assertGreaterEqual(len(both), 2)
        for name in both:
            self.assertAlmostEqual(places[1][name] - places[0][name], 0.1, delta=0.02)


class Command(CompareCase):
    def compared(self, status: int, render_pixels: np.ndarray, *arguments: str) -> str:
        photo = self.image("photo.png", photograph(exposure=0.4))
        picture = self.image("render.png", render_pixels)
        return self.compare(status, "--photo", photo, picture, *arguments, "--corners", *ARGUMENTS)

    def test_equal(self) -> None:
        out = self.compared(0, render(), "--fail-hue", "3", "--fail-bands", "0.99",
                            "--json", str(self.folder / "r.json"))  # fmt: skip
        self.assertIn("rectified to 512x", out)
        found = json.loads((self.folder / "r.json").read_text())
        self.assertLess(found["hue_distance_deg"], 2)
        self.assertAlmostEqual(found["gain"], 0.4, delta=0.02)
        self.assertTrue(found["equal"])
        self.assertEqual(
            [band["name"] for band in found["photo"]["bands"]],
            [band["name"] for band in found["render"]["bands"]],
        )

    def test_page(self) -> None:
        """Both pictures, and a figure with the bands' names."""
        page = self.folder / "page.html"
        self.compared(0, render(), "--html", str(page))
        text = page.read_text()
        start = text.index('<svg class="chart"')
        figure = text[start : text.index("</svg>", start)]
        ElementTree.fromstring(figure + "</svg>")
        self.assertIn(">photo</text>", figure)
        self.assertGreaterEqual(figure.count('class="grid"'), 4)
        section = text[text.index('<div class="wholes">') : text.index('<svg class="chart"')]
        self.assertEqual(section.count("<polygon"), 2)
        self.assertIn("° apart on average", section)
        self.assertIn("without perspective", text)
        for name in ("photo", "render"):
            self.assertIn(f'data-name="pixels:{name}"', text)

    def test_other_bands(self) -> None:
        out = self.compared(1, render(shift=0.3), "--fail-bands", "0.9")
        self.assertIn("different: correlation", out)

    def test_bad_input(self) -> None:
        photo, picture = self.image("p.png", photograph()), self.image("r.png", render())
        self.expect_error(["compare", "--photo", photo, picture], 2, "--photo needs --corners")
        self.expect_error(
            ["compare", "--photo", photo, picture, "--corners", *ARGUMENTS[:3], "1;2"],
            2, "'1;2' is not X,Y",
        )  # fmt: skip
        black = self.image("b.png", np.zeros((20, 20, 3)))
        self.expect_error(
            ["compare", "--photo", photo, black, "--corners", *ARGUMENTS], 2, "b.png is black"
        )


if __name__ == "__main__":
    unittest.main()
