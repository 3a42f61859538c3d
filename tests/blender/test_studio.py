# SPDX-License-Identifier: GPL-2.0-or-later
"""Cameras, softboxes, cards and tables do in a real Blender what their descriptions say."""

from __future__ import annotations

import sys
import unittest

import host
import numpy as np
import OpenImageIO as oiio

PACKAGE = host.REPOSITORY / "scripts" / "python"
sys.path[:0] = [str(PACKAGE), str(host.REPOSITORY / "tests" / "python")]

from icwafer.pictures import PICTURES  # noqa: E402
from test_photograph import cell_mm, pixels_of  # noqa: E402

NAMES = (
    "softbox",
    "softbox_faded",
    "card",
    "card_faded",
    "card_turned",
    "card_itself",
    "table",
    "dust",
    "coloured",
    "richer",
    "glowing",
)


class Studio(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        folder = host.fresh_folder("studio")
        cells = np.stack(np.mgrid[-6:25:6, -24:10:6], axis=-1).reshape(-1, 2)
        cls.lattice = cell_mm(cells)
        cls.facts = host.run_inside(
            host.built_blender(),
            "studio_facts",
            {"package": str(PACKAGE), "folder": str(folder), "lattice": cls.lattice.tolist()},
            folder=folder,
            seconds=120,
        )
        cls.colours = {
            name: oiio.ImageBuf(str(folder / f"{name}.exr")).get_pixels(oiio.FLOAT)[..., :3]
            for name in NAMES
        }
        cls.images = {name: image[..., 1] for name, image in cls.colours.items()}

    def test_the_photographs_camera_sees_the_lattice_where_it_should(self) -> None:
        width, height = PICTURES["photograph"].render.size
        seen = np.array(self.facts["seen"])
        pixels = np.stack([seen[:, 0] * width, (1.0 - seen[:, 1]) * height], axis=1)
        np.testing.assert_allclose(pixels, pixels_of(self.lattice), atol=0.05)

    def test_a_mirror_shows_a_card_as_it_shows_a_softbox(self) -> None:
        box, card = self.images["softbox"], self.images["card"]
        self.assertGreater(card[18, 32], 0.0)
        np.testing.assert_allclose(card[18, 32], box[18, 32], rtol=0.01)
        np.testing.assert_array_equal(card > 0, box > 0)
        self.assertEqual(card[18, 2], 0.0)

    def test_a_camera_does_not_see_a_card(self) -> None:
        self.assertEqual(self.images["card_itself"].max(), 0.0)

    def test_light_fades_to_the_edges(self) -> None:
        for kind in ("softbox", "card"):
            with self.subTest(kind):
                plain, faded = self.images[kind], self.images[f"{kind}_faded"]
                self.assertAlmostEqual(faded[18, 32] / plain[18, 32], 1.0, delta=0.05)
                row, whole = faded[18], plain[18] > 0.5 * plain.max()
                left, right = np.flatnonzero(whole)[[1, -2]]
                self.assertLess(max(row[left], row[right]), 0.1 * faded.max())
                self.assertTrue((np.diff(row[left:32]) > -0.02 * faded.max()).all())

    def test_turning_exchanges_width_and_height(self) -> None:
        card, turned = self.images["card"] > 0, self.images["card_turned"] > 0
        self.assertGreater(card[18].sum(), 1.5 * turned[18].sum())
        self.assertGreater(turned[:, 32].sum(), 1.2 * card[:, 32].sum())

    def test_a_table_fades_into_the_dark(self) -> None:
        table = self.images["table"]
        self.assertGreater(table[18, 32], 0.0)
        self.assertLess(table[1, 1], 0.01 * table[18, 32])

    def test_dust_lies_inside_its_disc_and_is_bright(self) -> None:
        dust = self.images["dust"]
        row, column = np.nonzero(dust > 0.01 * dust.max())
        # 100 mm below a lens as long as its sensor is wide: 64 pixels are 100 mm.
        distance_mm = np.hypot(row + 0.5 - 18, column + 0.5 - 32) * 100 / 64
        self.assertLess(distance_mm.max(), 20 + 2.5)
        self.assertGreater(len(row), 100)
        self.assertGreater(np.median(distance_mm), 20 * 0.6)  # 0.71 for an even density

    def test_a_camera_may_make_colours_richer(self) -> None:
        plain, richer = self.colours["coloured"], self.colours["richer"]
        luminance = plain @ (0.2126, 0.7152, 0.0722)
        expected = np.maximum(2 * plain - luminance[..., None], 0.0)
        np.testing.assert_allclose(richer, expected, rtol=0.01, atol=0.002 * plain.max())
        self.assertTrue((richer[18, 32] == 0).any())

    def test_a_lens_scatters_light_around_and_keeps_it(self) -> None:
        plain, glowing = self.images["coloured"], self.images["glowing"]
        dark = plain == 0
        self.assertGreater(glowing[dark].max(), 0.001 * plain.max())
        self.assertLess(glowing[dark].max(), 0.1 * plain.max())
        self.assertAlmostEqual(glowing.sum() / plain.sum(), 1.0, delta=0.05)


if __name__ == "__main__":
    unittest.main()
