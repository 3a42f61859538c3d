# SPDX-License-Identifier: GPL-2.0-or-later
"""`icwafer report` without a browser: what it reads, computes, embeds and writes."""

from __future__ import annotations

import base64
import csv
import json
import unittest
import zlib
from unittest import mock

import numpy as np
import OpenImageIO as oiio
from compare_support import CompareCase, write_image
from report_fixture import REFERENCE, SIZE, add_job, picture, write_study

from icwafer.compare import colour, flip, metrics
from icwafer.report import encode, study
from icwafer.report.contact_sheet import contact_sheet
from icwafer.report.page import write


def unpacked(text: str) -> bytes:
    return zlib.decompress(base64.b64decode(text))


class Encode(unittest.TestCase):
    def test_half_floats(self) -> None:
        pixels = np.random.default_rng(1).random((7, 9, 3)) * np.array([1e-4, 1, 900])
        raw = np.frombuffer(unpacked(encode.half_floats(pixels)), np.uint8).astype(np.uint16)
        high, low = raw.reshape(2, 3, 7, 9)
        bits = np.cumsum((high << 8) + low, axis=-1, dtype=np.uint16)
        decoded = np.moveaxis(bits.view(np.float16), 0, -1)
        np.testing.assert_array_equal(decoded, pixels.astype(np.float16))

    def test_half_floats_hold_no_infinity(self) -> None:
        raw = unpacked(encode.half_floats(np.array([[[1e9, -1.0, 0.0]]])))
        np.testing.assert_array_equal(
            np.frombuffer(raw, np.uint8).reshape(2, 3)[0].astype(int) >> 2, [30, 0, 0]
        )

    def test_unit_map(self) -> None:
        values = np.random.default_rng(2).random((5, 6))
        steps = np.frombuffer(unpacked(encode.unit_map(values)), np.uint8).reshape(5, 6)
        levels = np.cumsum(steps, axis=-1, dtype=np.uint8)
        np.testing.assert_allclose(levels / 255, values, atol=0.5 / 255 + 1e-9)

    def test_curve(self) -> None:
        """The sRGB curve treats channels alone: exact between points, too."""
        points = encode.CURVE_POINTS
        inputs = encode.table_inputs(points)
        self.assertEqual(inputs[0], 0)
        self.assertAlmostEqual(inputs[-1], 128, delta=0.01)
        values = np.frombuffer(unpacked(encode.view_table(colour.SRGB_CURVE)), "<u2")
        values = values.reshape(points, 3) / 65535
        between = np.sqrt(inputs[1:-1] * inputs[2:])
        np.testing.assert_allclose(
            (values[1:-1, 0] + values[2:, 0]) / 2, colour.SRGB_CURVE.encode(between), atol=2e-3
        )

    def test_cube(self) -> None:
        """A view transform that mixes channels: red fastest."""
        mixing = mock.Mock()
        mixing.encode = lambda x: np.clip(x @ [[0.7, 0.2, 0.1], [0, 1, 0], [0.3, 0, 0.7]], 0, 1)
        n = encode.CUBE_POINTS
        values = np.frombuffer(unpacked(encode.view_table(mixing)), "<u2").reshape(n, n, n, 3)
        side = encode.table_inputs(n)
        for red, green, blue in ((27, 3, 9), (0, 25, 2), (5, 5, 20)):
            np.testing.assert_allclose(
                values[blue, green, red] / 65535,
                mixing.encode(np.array([side[red], side[green], side[blue]])),
                atol=1e-5,
            )


class Load(CompareCase):
    def setUp(self) -> None:
        super().setUp()
        self.study = write_study(self.folder / "study")

    def test_jobs(self) -> None:
        loaded = study.load(self.study)
        self.assertTrue(loaded.name.startswith("Spacing & lobe <test>"))
        ids = [job.id for job in loaded.jobs if not job.error]
        self.assertEqual(ids[:3], ["spacing900-lobe0.01", "spacing900-lobe0.03", REFERENCE])
        self.assertEqual(len(ids), 6)
        errors = {job.id: job.error for job in loaded.jobs if job.error}
        self.assertEqual(errors["broken"], "Blender ended with signal 11")
        self.assertIn("not rendered yet", errors["unfinished"])
        self.assertEqual(loaded.command, f"icwafer render study.toml -o {self.study}")
        self.assertEqual(loaded.jobs[-1].gratings[0].spacing_nm, 2000)

    def test_only_the_jobs_of_the_study(self) -> None:
        """Others are left from before; those that are missing are named."""
        path = self.study / "study.json"
        given = json.loads(path.read_text())
        path.write_text(json.dumps(given | {"jobs": [REFERENCE, "later"]}))
        (self.study / "jobs" / ".part-1").mkdir()
        jobs = study.load(self.study).jobs
        self.assertEqual({job.id for job in jobs}, {REFERENCE, "later"})
        self.assertIn("not rendered yet", next(job.error for job in jobs if job.id == "later"))

    def test_a_bad_job_counts_as_failed(self) -> None:
        path = self.study / "jobs" / REFERENCE / "job.json"
        for text, part in (("{", "job.json:1:2"), ("[]", "not a JSON object"),
                           ('{"grating": {"spacing_nm": 1}}', "camera")):  # fmt: skip
            path.write_text(text)
            errors = {job.id: job.error for job in study.load(self.study).jobs}
            self.assertIn(part, errors[REFERENCE])

    def test_unusable_folders(self) -> None:
        self.expect_error(["report", str(self.folder)], 1, "study.json: no such file")
        path = self.study / "study.json"
        path.write_text('{"name": "x",\n "axes": [}')
        self.expect_error(["report", str(self.study)], 1, "study.json:2:11")
        path.write_text('{"name": "x", "axes": [{"unit": "nm"}]}')
        self.expect_error(["report", str(self.study)], 1, "without a good 'name'")
        path.write_text('{"name": "x", "reference": "none"}')
        self.expect_error(["report", str(self.study)], 1, "reference 'none'")
        empty = self.folder / "empty"
        empty.mkdir()
        (empty / "study.json").write_text('{"name": "x"}')
        self.expect_error(["report", str(empty)], 1, "no jobs")
        (empty / "jobs" / "a").mkdir(parents=True)
        self.expect_error(["report", str(empty)], 1, "no job has a picture", "not rendered yet")


class Write(CompareCase):
    def setUp(self) -> None:
        super().setUp()
        self.study = write_study(self.folder / "study")

    def test_products(self) -> None:
        status, out, err = self.icwafer("report", str(self.study))
        self.assertEqual(status, 0, err)
        written = sorted(path.name for path in self.study.iterdir() if path.is_file())
        self.assertEqual(
            written,
            ["report-sheet.png", "report.csv", "report.html", "report.json", "study.json"],
        )
        self.check_numbers(json.loads((self.study / "report.json").read_text()))
        with open(self.study / "report.csv", newline="") as file:
            rows = {row["id"]: row for row in csv.DictReader(file)}
        self.assertEqual(len(rows), 8)
        self.assertEqual(rows["broken"]["status"], "failed")
        self.assertEqual(float(rows[REFERENCE]["rms"]), 0)
        self.assertIn("--only", rows[REFERENCE]["command"])
        page = (self.study / "report.html").read_text()
        self.assertIn("<title>Spacing &amp; lobe &lt;test&gt; &lt;/script&gt;", page)
        self.assertNotIn("{{", page.split("<script")[0])
        self.assertNotIn("http", page.replace("http-equiv", "").replace("http://www.w3.org", ""))

    def check_numbers(self, found: dict) -> None:
        jobs = {job["id"]: job for job in found["jobs"]}
        other = jobs["spacing900-lobe0.03"]["measures"]
        a, b = (picture(*pair).astype(np.float32) for pair in ((1000, 0.01), (900, 0.03)))
        self.assertAlmostEqual(other["rms"], metrics.errors(a, b).rms, places=6)
        shown = [colour.SRGB_CURVE.encode(image) for image in (a, b)]
        expected = flip.ldr(*shown, flip.DEFAULT_PIXELS_PER_DEGREE).mean()
        self.assertAlmostEqual(other["flip"], expected, places=5)
        self.assertGreater(other["hdr_flip"], other["flip"])
        self.assertNotIn("psnr", jobs[REFERENCE]["measures"])
        self.assertEqual(found["reference"], REFERENCE)

    def test_pixels_in_the_page(self) -> None:
        page = self.folder / "out" / "page.html"
        loaded = study.load(self.study)
        write(loaded, page, ppd=67.0, hdr=False, processes=1)
        text = page.read_text()
        start = text.index(f'data-name="pixels:{REFERENCE}"')
        blob = text[text.index(">", start) + 1 : text.index("<", start)]
        self.assertEqual(blob, encode.half_floats(picture(1000, 0.01).astype(np.float32)))
        self.assertNotIn('data-name="hdr_flip', text)

    def test_the_page_can_be_kept_small(self) -> None:
        page = self.folder / "page.html"
        write(study.load(self.study), page, ppd=67.0, hdr=False, processes=1, largest_mb=0.02)
        text = page.read_text()
        start = text.index('id="study">') + len('id="study">')
        data = json.loads(text[start : text.index("</script>", start)])
        widths = {job["width"] for job in data["jobs"] if "width" in job}
        self.assertEqual(len(widths), 1)
        self.assertLess(widths.pop(), SIZE[0])

    def test_a_job_of_another_size(self) -> None:
        path = self.study / "jobs" / "spacing900-lobe0.01" / "image.exr"
        write_image(path, picture(900, 0.01)[:20])
        write(study.load(self.study), self.folder / "p.html", ppd=67.0, hdr=False, processes=1)
        found = json.loads((self.folder / "p.json").read_text())
        jobs = {job["id"]: job for job in found["jobs"]}
        self.assertEqual(jobs["spacing900-lobe0.01"]["status"], "failed")
        self.assertIn("48x20", jobs["spacing900-lobe0.01"]["error"])
        self.assertEqual(jobs["spacing900-lobe0.03"]["status"], "done")

    def test_contact_sheet(self) -> None:
        """The middle of every cell has the colour of its render."""
        status, _, err = self.icwafer("report", str(self.study), "--no-hdr-flip")
        self.assertEqual(status, 0, err)
        sheet = oiio.ImageBuf(str(self.study / "report-sheet.png")).get_pixels(oiio.FLOAT)
        height, width = sheet.shape[:2]
        cell = (320 + 6, round(320 * SIZE[1] / SIZE[0]) + 6)
        left, top = width - 6 - 3 * cell[0], height - 6 - 2 * cell[1]
        for column, spacing in enumerate((900, 1000, 1100)):
            for row, lobe in enumerate((0.01, 0.03)):
                x, y = left + column * cell[0] + 160, top + row * cell[1] + cell[1] // 2
                truth = picture(spacing, lobe)
                middle = truth[
                    SIZE[1] // 2 - 1 : SIZE[1] // 2 + 1, SIZE[0] // 2 - 1 : SIZE[0] // 2 + 1
                ]
                shown = colour.SRGB_CURVE.encode(middle).mean(axis=(0, 1))
                if (spacing, lobe) == (1100, 0.03):
                    shown = np.clip(middle, 0, 1).mean(axis=(0, 1))
                np.testing.assert_allclose(sheet[y, x], shown, atol=0.1)

    def test_a_long_axis_is_thinned_on_the_sheet(self) -> None:
        """Of 101 values 24, the first and the last among them: the sheet stays a picture."""
        folder = self.folder / "long"
        values = list(range(101))
        for value in values:
            add_job(folder, f"d{value}", {"settings": {"d": value}})
            grey = np.full((2, 4, 3), value / 50)
            write_image(folder / "jobs" / f"d{value}" / "image.exr", grey)
        axes = [{"name": "d", "values": values}]
        (folder / "study.json").write_text(json.dumps({"name": "x", "axes": axes}))
        write(study.load(folder), self.folder / "p.html", ppd=67.0, hdr=False, processes=1)
        sheet = oiio.ImageBuf(str(self.folder / "p-sheet.png")).get_pixels(oiio.FLOAT)
        self.assertEqual(sheet.shape[:2], (92 + 160 + 12, 12 + 24 * 326 + 6))
        row = sheet[-86, :, 0]
        self.assertLess(row[12 + 160], 0.05)
        self.assertGreater(row[-6 - 160], 0.95)

    def test_compare_writes_a_page(self) -> None:
        paths = [
            str(self.study / "jobs" / f"spacing{s}-lobe0.01" / "image.exr") for s in (900, 1000)
        ]
        page = self.folder / "compare.html"
        status, _, err = self.icwafer("compare", *paths, "--html", str(page))
        self.assertEqual(status, 1, err)
        self.assertIn(f'data-name="flip:B: {paths[1]}"', page.read_text())

    def test_no_sheet_without_axes(self) -> None:
        loaded = study.Study("x", "", (), None, "", {}, ())
        self.assertEqual(contact_sheet(loaded, {}, {}, None), [])


if __name__ == "__main__":
    unittest.main()
