# SPDX-License-Identifier: GPL-2.0-or-later
"""The pictures that the repository keeps: where, in which format, and unchanged."""

from __future__ import annotations

import sys
import unittest
from pathlib import Path

import numpy as np
import OpenImageIO as oiio
from support import CommandCase, write

from icwafer import build, paths, render
from icwafer.errors import IcwaferError
from icwafer.pictures import PICTURES
from icwafer.pictures.kept import copy_picture, kept_path


def wires_png(path: Path) -> np.ndarray:
    """Writes red and blue lines of one pixel, as a picture of wires has them, and returns them."""
    pixels = np.zeros((64, 96, 3), dtype=np.uint8)
    pixels[::2, :, 0], pixels[1::2, :, 2] = 200, 200
    picture = oiio.ImageBuf(oiio.ImageSpec(96, 64, 3, oiio.UINT8))
    picture.specmod().attribute("DateTime", "2026:01:01 00:00:00")
    picture.set_pixels(oiio.ROI(), pixels)
    picture.write(str(path))
    return pixels


class CopyTest(CommandCase):
    def setUp(self) -> None:
        super().setUp()
        self.png = self.folder / "wires.png"
        self.pixels = wires_png(self.png)

    def copied(self, name: str) -> np.ndarray:
        path = self.folder / "kept" / name
        path.parent.mkdir(exist_ok=True)
        copy_picture(self.png, path)
        self.assertEqual(list(path.parent.glob(".*")), [])
        return oiio.ImageBuf(str(path)).get_pixels(oiio.UINT8)

    def test_a_png_keeps_every_pixel(self) -> None:
        np.testing.assert_array_equal(self.copied("a.png"), self.pixels)

    def test_a_jpeg_keeps_lines_of_one_pixel_apart_by_colour(self) -> None:
        # With colours of half the resolution, which is usual, both would turn purple: 100 off.
        error = np.abs(self.copied("a.jpg").astype(int) - self.pixels)
        self.assertLess(error.mean(), 4.0)

    def test_the_same_picture_gives_the_same_file_whenever_it_was_rendered(self) -> None:
        for name in ("a.png", "a.jpg"):
            self.copied(name)
            self.assertNotIn(b"2026", (self.folder / "kept" / name).read_bytes())

    def test_a_picture_that_cannot_be_read_leaves_the_last_one(self) -> None:
        last = write(self.folder / "last.jpg", "last")
        with self.assertRaisesRegex(IcwaferError, "last.jpg"):
            copy_picture(write(self.folder / "broken.png", "no picture"), last)
        self.assertEqual(last.read_text(), "last")
        self.assertEqual(list(self.folder.glob(".*")), [])


class CommandTest(CommandCase):
    def setUp(self) -> None:
        super().setUp()
        png = self.folder / "x.png"
        wires_png(png)
        self.replace(paths, REPOSITORY=self.folder)
        self.replace(build, build=lambda _: None)
        self.replace(render, render=lambda name, _: (png, png.with_suffix(".exr")))
        self.kept = kept_path("die_studio", PICTURES["die_studio"])
        self.kept.parent.mkdir(parents=True)

    def test_only_keep_touches_the_repository(self) -> None:
        self.assertEqual(self.icwafer("pictures", "die_studio")[0], 0)
        self.assertFalse(self.kept.exists())
        self.assertEqual(self.icwafer("pictures", "die_studio", "--keep")[0], 0)
        self.assertTrue(self.kept.is_file())

    def test_an_unknown_name(self) -> None:
        self.expect_error(["pictures", "die_studo"], 2, "die_studo", "die_studio")


class RepositoryTest(unittest.TestCase):
    def test_each_picture_is_kept_once_and_in_its_own_size(self) -> None:
        for name, picture in PICTURES.items():
            with self.subTest(name):
                kept = kept_path(name, picture)
                found = sorted(kept.parent.glob(f"{name}.*"))
                self.assertEqual(found, [kept])
                spec = oiio.ImageBuf(str(kept)).spec()
                self.assertEqual((spec.width, spec.height), picture.render.size)


if __name__ == "__main__":
    sys.exit(unittest.main())
