# SPDX-License-Identifier: GPL-2.0-or-later
"""Every picture, rendered small by the real script in the real Blender, shows what it says."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np
import OpenImageIO as oiio

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "scripts" / "python"
BLENDER = Path(os.environ.get("ICWAFER_BLENDER", ROOT / "build" / "install" / "blender"))
sys.path.insert(0, str(PACKAGE))

from icwafer.pictures import PICTURES  # noqa: E402
from icwafer.pictures.effects import EFFECTS  # noqa: E402
from icwafer.pictures.kept import kept_path  # noqa: E402

WIDTH = 320
#: Paths per pixel. A camera that makes colours richer does so with noise, too.
SAMPLES, SAMPLES_RICHER = 16, 64


def run_script(*arguments: str) -> subprocess.CompletedProcess[str]:
    script = PACKAGE / "icwafer" / "render_picture.py"
    return subprocess.run(
        [BLENDER, "-b", "--factory-startup", "--python-exit-code", "1", "-P", script, "--"]
        + list(arguments),
        capture_output=True,
        text=True,
        timeout=300,
    )


def height(name: str) -> int:
    """Of the small picture, in the shape of the picture itself."""
    own = PICTURES[name].render.size
    return round(WIDTH * own[1] / own[0])


def read(path: Path) -> np.ndarray:
    """(height, width, 3) float32."""
    return oiio.ImageBuf(str(path)).get_pixels(oiio.FLOAT)[..., :3]


def render(folder: Path, name: str, *options: str) -> np.ndarray:
    """The picture as the EXR has it, linear."""
    size = f"{WIDTH}x{height(name)}"
    samples = SAMPLES_RICHER if PICTURES[name].response.saturation > 1 else SAMPLES
    done = run_script(
        name, "--output", str(folder / name), "--size", size, "--samples", str(samples), *options
    )
    if done.returncode:
        raise AssertionError(f"{name}: {done.stderr}")
    return read(folder / f"{name}.exr")


def lit(image: np.ndarray) -> np.ndarray:
    """Mask of the pixels on the die that are brighter than a tenth of the bright ones."""
    value = image.max(axis=-1)
    return value > 0.1 * np.percentile(value[value > 0], 90)


def saturation(image: np.ndarray) -> float:
    """Mean of 1 - min / max over the lit pixels."""
    pixels = image[lit(image)]
    return float((1 - pixels.min(axis=-1) / pixels.max(axis=-1)).mean())


def hues(image: np.ndarray) -> int:
    """How many of the twelve hues of the colour wheel cover 2 % of the lit pixels each or more."""
    red, green, blue = image[lit(image)].T
    angle = np.arctan2(3**0.5 * (green - blue), 2 * red - green - blue)
    share = np.histogram(angle, bins=12, range=(-np.pi, np.pi))[0] / len(red)
    return int((share >= 0.02).sum())


def texture(image: np.ndarray) -> float:
    """How much colour differs from one place to the next beyond what a smooth run explains.

    Mean size of the second difference of the chromaticity across 4 pixels, about a block, both
    ways, where all three places are lit.
    """
    mask = lit(image)
    total = np.maximum(image.sum(axis=-1, keepdims=True), 1e-9)
    colour = image / total
    step = 4
    sizes = []
    for c, m in ((colour, mask), (colour.swapaxes(0, 1), mask.T)):
        both = m[: -2 * step] & m[step:-step] & m[2 * step :]
        bend = c[: -2 * step] - 2 * c[step:-step] + c[2 * step :]
        sizes.append(np.abs(bend).sum(axis=-1)[both])
    return float(np.concatenate(sizes).mean())


class Pictures(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            cls.linear = {picture: render(folder, picture) for picture in PICTURES}
            cls.shown = {picture: read(folder / f"{picture}.png") for picture in PICTURES}
            cls.again = render(folder, "full")
            cls.other = render(folder, "full", "--seed", "7")
            cls.left_over = sorted(p.name for p in folder.iterdir())

    def test_nothing_else_is_written(self) -> None:
        self.assertEqual(
            self.left_over, sorted(f"{p}{ending}" for p in PICTURES for ending in (".exr", ".png"))
        )

    def test_none_is_black_or_uniform_or_burnt_out(self) -> None:
        for name, image in self.shown.items():
            with self.subTest(name):
                self.assertEqual(image.shape, (height(name), WIDTH, 3))
                value = image.max(axis=-1)
                self.assertGreater((value > 0.1).mean(), 0.25)
                self.assertGreater(value.std(), 0.1)
                self.assertLess((image.min(axis=-1) > 0.98).mean(), 0.02)

    def test_no_value_is_negative_or_not_a_number(self) -> None:
        for name, image in self.linear.items():
            with self.subTest(name):
                self.assertTrue(np.isfinite(image).all())
                self.assertGreaterEqual(image.min(), 0.0)

    def test_surroundings_are_black_but_for_a_table(self) -> None:
        for name, image in self.linear.items():
            with self.subTest(name):
                # A table fades out before the corners.
                table = PICTURES[name].table.size_mm > 0
                self.assertEqual(bool(((image[-1] if table else image[0, 0]) > 0).any()), table)

    def test_wafers_have_all_colours(self) -> None:
        for name in PICTURES.keys() - EFFECTS.keys():
            with self.subTest(name):
                self.assertGreaterEqual(hues(self.linear[name]), 6)

    def test_one_light_gives_strips_of_all_colours(self) -> None:
        image = self.linear["grating_one_light"]
        self.assertGreaterEqual(hues(image), 9)
        self.assertGreater(saturation(image), 0.6)

    def test_many_lights_mix_the_strips(self) -> None:
        one, many = self.linear["grating_one_light"], self.linear["grating_many_lights"]
        self.assertLess(saturation(many), saturation(one))
        self.assertGreater(saturation(many), 0.3)
        self.assertGreater(lit(many).mean(), lit(one).mean())

    def test_film_colours_are_softer_than_those_of_the_grating(self) -> None:
        film, grating = self.linear["thin_film"], self.linear["grating_one_light"]
        self.assertGreater(saturation(film), 0.1)
        self.assertLess(saturation(film), 0.8 * saturation(grating))
        self.assertLess(texture(film), 0.5 * texture(grating))

    def test_diffraction_within_a_wire_has_hardly_any_colour(self) -> None:
        wire, film = self.linear["wire_diffraction"], self.linear["thin_film"]
        self.assertLess(saturation(wire), 0.25)
        self.assertLess(saturation(wire), 0.6 * saturation(film))

    def test_the_full_model_has_all_colours(self) -> None:
        self.assertGreaterEqual(hues(self.linear["full"]), 8)

    def test_spread_of_spacings_is_texture(self) -> None:
        mess, smooth, groups = (
            texture(self.linear[name])
            for name in ("random_spacing", "narrow_spacing", "clustered_groups")
        )
        self.assertGreater(mess, 1.3 * groups)
        self.assertGreater(groups, 1.5 * smooth)

    def test_the_committed_pictures_are_these(self) -> None:
        # Three or six pixels of a committed picture are one here. What the pixel filter does to
        # lines of one pixel comes to 0.01 to 0.03, with the noise of wide lamps to 0.045; a die of
        # another seed to 0.08.
        for name, image in self.shown.items():
            with self.subTest(name):
                committed = oiio.ImageBuf(str(kept_path(name, PICTURES[name])))
                roi = oiio.ROI(0, WIDTH, 0, height(name), 0, 1, 0, 3)
                small = oiio.ImageBufAlgo.resize(committed, "box", roi=roi).get_pixels(oiio.FLOAT)
                self.assertLess(np.abs(small - image).mean(), 0.06)

    def test_rendering_again_gives_the_same_pixels(self) -> None:
        np.testing.assert_array_equal(self.linear["full"], self.again)
        self.assertGreater(np.abs(self.linear["full"] - self.other).mean(), 0.001)


class BadInput(unittest.TestCase):
    def test_each_is_one_line_that_names_the_thing(self) -> None:
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            (folder / "file").touch()
            (folder / "taken.exr").mkdir()
            good = ("full", "--output", str(folder / "x"), "--size", "8x8", "--samples", "1")
            for arguments, words in (
                (("fool", *good[1:]), "fool"),
                ((*good, "--size", "8"), "WIDTHxHEIGHT"),
                ((*good, "--samples", "0"), "'0'"),
                ((*good, "--shadows"), "--shadows"),
                ((*good, "--output", str(folder / "file" / "x")), "cannot make folder"),
                ((*good, "--output", str(folder / "taken")), "cannot write"),
                ((*good, "--output", "/proc/x"), "disk full"),  # nothing is ever free there
                (("full",), "--output"),
            ):
                with self.subTest(arguments):
                    done = run_script(*arguments)
                    self.assertEqual(done.returncode, 1)
                    self.assertIn(words, done.stderr)
                    self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
            self.assertEqual({p.name for p in folder.iterdir()}, {"file", "taken.exr"})


if __name__ == "__main__":
    unittest.main()
