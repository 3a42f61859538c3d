# SPDX-License-Identifier: GPL-2.0-or-later
"""`icwafer compare`: what it says and its exit status, for good, odd and unusable images."""

from __future__ import annotations

import math
import unittest
from pathlib import Path

import numpy as np
import PyOpenColorIO as ocio
from compare_support import CompareCase

from icwafer.compare import colour, images, metrics

RAMP = np.stack(
    [*np.meshgrid(np.linspace(0, 1, 32), np.linspace(0, 1, 24)), np.full((24, 32), 0.5)], axis=-1
)


def acescg_config(path: Path) -> Path:
    """A configuration of another working space, with a display that only encodes."""
    config = ocio.Config()
    config.setMajorVersion(2)
    config.addColorSpace(ocio.ColorSpace(name="ACES2065-1", encoding="scene-linear"))
    # Academy S-2014-004, ACES2065-1 to ACEScg.
    matrix = np.eye(4)
    matrix[:3, :3] = [
        [1.4514393161, -0.2365107469, -0.2149285693],
        [-0.0765537734, 1.1762296998, -0.0996759264],
        [0.0083161484, -0.0060324498, 0.9977163014],
    ]
    working = ocio.ColorSpace(name="ACEScg", encoding="scene-linear")
    working.setTransform(
        ocio.MatrixTransform(matrix=list(matrix.flat)), ocio.COLORSPACE_DIR_FROM_REFERENCE
    )
    config.addColorSpace(working)
    for role, name in (("scene_linear", "ACEScg"), ("aces_interchange", "ACES2065-1"),
                       ("default", "ACEScg")):  # fmt: skip
        config.setRole(role, name)
    config.addDisplayView("Plain", "Working", "ACEScg")
    path.write_text(config.serialize(), encoding="utf-8")
    return path


class Status(CompareCase):
    def test_equal(self) -> None:
        a, b = self.image("a.exr", RAMP), self.image("b.exr", RAMP)
        out = self.compare(0, a, b, "--flip")
        self.assertTrue(out.endswith("equal\n"))
        self.assertIn("psnr      inf", out)
        found = self.result(0, a, b, "--fail-psnr", "40")
        self.assertIsNone(found["values"]["psnr"])
        self.assertEqual(found["failures"], [])

    def test_different(self) -> None:
        a, b = self.image("a.exr", RAMP), self.image("b.exr", RAMP + 0.01)
        self.assertIn("different: the images are not equal", self.compare(1, a, b))
        self.compare(0, a, b, "--fail-rms", "0.011")
        out = self.compare(1, a, b, "--fail-rms", "0.009", "--fail-psnr", "50", "--fail-flip", "1")
        self.assertIn("different: rms 0.01 > 0.009", out)
        self.assertIn("different: psnr 40 < 50", out)
        self.assertNotIn("flip 0.0", out.split("different")[1])

    def test_thresholds_of_every_measure(self) -> None:
        a, b = self.image("a.exr", RAMP), self.image("b.exr", RAMP[::-1])
        for name in ("mean", "rms", "max", "yee", "flip", "hdr-flip"):
            self.assertIn(f"different: {name}", self.compare(1, a, b, f"--fail-{name}", "1e-4"))
            self.compare(0, a, b, f"--fail-{name}", "10")

    def test_noise(self) -> None:
        random = np.random.default_rng(1)
        names = ("a.exr", "b.exr", "a2.exr", "b2.exr")
        a, b, a2, b2 = (self.image(n, RAMP + random.normal(0, 0.1, RAMP.shape)) for n in names)
        other = self.image("c.exr", RAMP * 1.1 + random.normal(0, 0.1, RAMP.shape))
        self.assertIn("nothing beyond it", self.compare(0, a, b, "--noise"))
        self.assertIn("of it noise", self.compare(0, a, b, "--second", a2, b2))
        self.assertIn("different beyond noise", self.compare(1, a, other, "--noise"))

    def merged(self, name: str, truth: np.ndarray, count: int, seed: int) -> str:
        random = np.random.default_rng(seed)
        renders = [
            self.image(f"{name}{i}.exr", truth + random.normal(0, 0.1, RAMP.shape))
            for i in range(count)
        ]
        path = str(self.folder / f"{name}.exr")
        status, _, err = self.icwafer("merge", *renders, "-o", path)
        self.assertEqual(status, 0, err)
        return path

    def test_noise_of_merged_renders(self) -> None:
        """Of unequal numbers of samples; the variance is a layer of the merged files."""
        a, b = self.merged("a", RAMP, 4, seed=5), self.merged("b", RAMP, 16, seed=6)
        other = self.merged("c", RAMP * 1.1, 16, seed=7)
        self.assertIn("nothing beyond it", self.compare(0, a, b, "--variance", a, b))
        out = self.result(0, a, b, "--variance", a, b)
        expected = 0.1 * np.sqrt(1 / 4 + 1 / 16)
        self.assertAlmostEqual(out["noise"]["rms_noise"], expected, delta=0.1 * expected)
        self.assertIn("different beyond", self.compare(1, a, other, "--variance", a, other))

    def test_variances_that_are_none(self) -> None:
        a, b = self.image("a.exr", RAMP), self.image("b.exr", RAMP)
        negative = self.image("n.exr", -RAMP - 1)
        small, encoded = self.image("s.exr", RAMP[:4]), self.image("e.png", RAMP)
        for variance, words in (
            (negative, "negative values"), (small, "another size"), (encoded, "scene-linear"),
        ):  # fmt: skip
            with self.subTest(words):
                self.expect_error(["compare", a, b, "--variance", a, variance], 2, words)
        self.expect_error(
            ["compare", a, b, "--variance", a, b, "--second", a, b], 2, "give one of them"
        )
        self.expect_error(["merge", a, "-o", a], 2, "two or more")


class OddImages(CompareCase):
    def test_sizes(self) -> None:
        a = self.image("a.exr", RAMP)
        b = self.image("b.exr", np.repeat(np.repeat(RAMP, 2, 0), 2, 1))
        self.expect_error(["compare", a, b], 2, "32x24", "64x48", "--fit")
        self.assertIn("was resampled from 64x48 to 32x24", self.compare(1, a, b, "--fit"))
        self.expect_error(["compare", a, b, "--fit", "--html", "x.html"], 2, "--html needs")
        c = self.image("c.exr", RAMP[:, :20])
        self.expect_error(["compare", a, c, "--fit"], 2, "another shape")

    def test_not_finite(self) -> None:
        broken = RAMP.copy()
        broken[3, 7, 1], broken[4, 8] = math.nan, math.inf
        a, b = self.image("a.exr", RAMP), self.image("b.exr", broken)
        out = self.compare(1, a, b, "--flip", "--fail-max", "1")
        self.assertIn("0 pixels of A and 2 of B are NaN or infinite, the first at 7,3", out)
        found = self.result(1, a, b)
        self.assertEqual(found["bad_pixels"], 2)
        self.assertEqual(found["values"]["max"], 0.0)

    def test_channels(self) -> None:
        a = self.image("a.exr", RAMP)
        alpha = self.image("b.exr", np.dstack([RAMP, np.ones(RAMP.shape[:2])]), "R", "G", "B", "A")
        self.compare(0, a, alpha)
        grey = self.image("c.exr", RAMP[..., :1], "Y")
        self.assertIn("one channel; it counts as grey", self.compare(1, a, grey))
        depth = self.image("d.exr", RAMP[..., :2], "u", "v")
        self.expect_error(["compare", a, depth], 2, "no channels R, G, B, only u, v")

    def test_the_order_of_channels_in_the_file(self) -> None:
        """OpenEXR sorts them: B, G, R."""
        a = self.image("a.exr", RAMP)
        b = self.image("b.exr", RAMP[..., ::-1], "B", "G", "R")
        self.compare(0, a, b)

    def test_layers(self) -> None:
        names = [f"{layer}.{c}" for layer in ("View.Combined", "View.Diffuse") for c in "RGB"]
        both = self.image("a.exr", np.dstack([RAMP, 0.5 * RAMP]), *names)
        plain, half = self.image("b.exr", RAMP), self.image("c.exr", 0.5 * RAMP)
        self.assertIn("layer 'View.Combined' of 2", self.compare(0, both, plain))
        self.expect_error(
            ["compare", both, half, "--layer", "View.Difuse"], 2, "did you mean 'View.Diffuse'"
        )
        layers = [images.read(Path(both), layer).pixels for layer in ("View.Diffuse", None)]
        np.testing.assert_allclose(layers[0], 0.5 * layers[1], atol=1e-6)

    def test_encoded_images(self) -> None:
        a, b = self.image("a.png", RAMP), self.image("b.png", np.clip(RAMP + 0.1, 0, 1))
        found = self.result(1, a, b)
        self.assertEqual(found["compared"], "values as a screen shows them")
        self.expect_error(["compare", a, b, "--fail-hdr-flip", "0.1"], 2, "scene-linear")

    def test_linear_against_encoded(self) -> None:
        """The EXR goes through the view transform first."""
        linear = self.image("a.exr", 0.2140411 * np.ones_like(RAMP))
        encoded = self.image("b.png", 0.5 * np.ones_like(RAMP))
        found = self.result(1, linear, encoded)
        self.assertLess(found["values"]["max"], 0.5 / 255 + 1e-4)
        self.assertIn("sRGB", found["view_transform"])

    def test_unusable_files(self) -> None:
        a = self.image("a.exr", RAMP)
        self.expect_error(["compare", a, "nowhere.exr"], 2, "nowhere.exr: no such file")
        text = self.folder / "text.exr"
        text.write_text("no image")
        self.expect_error(["compare", a, str(text)], 2, "text.exr: not an image")
        cut = self.folder / "cut.exr"
        cut.write_bytes(Path(a).read_bytes()[:-900])
        self.expect_error(["compare", a, str(cut)], 2, "cut.exr", "end of file")
        self.expect_error(["compare", a], 2, "1 images; compare two")

    def test_values_out_of_range(self) -> None:
        a = self.image("a.exr", RAMP)
        self.expect_error(["compare", a, a, "--ppd", "0"], 2, "--ppd 0", "1 to 1000")
        self.expect_error(["compare", a, a, "--level", "2"], 2, "--level 2")


class Colour(CompareCase):
    def test_names(self) -> None:
        config = str(acescg_config(self.folder / "config.ocio"))
        a = self.image("a.exr", RAMP)
        out = self.compare(0, a, a, "--ocio", config)
        self.assertIn(f"Working on Plain ({config})", out)
        self.expect_error(
            ["compare", a, a, "--ocio", config, "--view", "Worknig"], 2, "did you mean 'Working'"
        )
        self.expect_error(
            ["compare", a, a, "--ocio", a], 2, "a.exr: not an OpenColorIO configuration"
        )
        self.expect_error(["compare", a, a, "--view", "Filmic"], 2, "no OpenColorIO configuration")

    def test_working_space_to_rec709(self) -> None:
        """White stays white; ACEScg's green lies outside Rec.709 (its known coordinates there)."""
        config = acescg_config(self.folder / "config.ocio")
        view = colour.view_transform(config)
        white, green = view.to_rec709(np.array([[[1, 1, 1], [0, 1, 0]]], dtype=np.float32))[0]
        np.testing.assert_allclose(white, 1, atol=2e-3)
        # Published to four digits, with another adaptation to D65 than the matrix used here.
        np.testing.assert_allclose(green, [-0.6217, 1.1408, -0.1289], atol=5e-3)


class Measures(unittest.TestCase):
    def test_by_hand(self) -> None:
        second = RAMP.copy()
        second[5, 9, 2] += 0.25
        found = metrics.errors(RAMP, second)
        count = RAMP.size
        self.assertAlmostEqual(found.mean, 0.25 / count, places=9)
        self.assertAlmostEqual(found.rms, 0.25 / math.sqrt(count), places=7)
        self.assertAlmostEqual(found.psnr_db, 10 * math.log10(count / 0.0625), places=4)
        self.assertAlmostEqual(found.max, 0.25, places=6)
        self.assertEqual(found.max_place, (9, 5, 2))

    def test_yee(self) -> None:
        """A red square on grey is seen; one that is 1/1000 redder is not."""
        grey = np.full((64, 64, 3), 0.5)
        square, faint = grey.copy(), grey.copy()
        square[20:40, 20:40] = (1.0, 0.2, 0.2)
        faint[20:40, 20:40, 0] *= 1.001
        seen = metrics.yee(grey, square, 30)
        self.assertEqual(seen.pixels, 400)
        self.assertAlmostEqual(seen.share, 400 / 64**2)
        self.assertEqual(metrics.yee(grey, faint, 30).pixels, 0)


if __name__ == "__main__":
    unittest.main()
