# SPDX-License-Identifier: GPL-2.0-or-later
"""A report of many renders stays within its size and is drawn at once; the rest on demand.

Thousands are measured by tests/benchmarks/report_scale.py.
"""

from __future__ import annotations

import json
import tempfile
import time
import unittest
from pathlib import Path

import numpy as np
from browser import Browser
from compare_support import write_image
from report_fixture import GRATING, add_job

from icwafer.report import study
from icwafer.report.page import write

ROWS, COLUMNS = 21, 12
MEGABYTES = 2.0


class LongReport(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        place = Path(folder.name)
        random = np.random.default_rng(1)
        for row in range(ROWS):
            for column in range(COLUMNS):
                id = f"r{row}c{column}"
                add_job(
                    place, id, {"settings": {"row": row, "column": column}, "grating": GRATING}
                )
                pixels = random.random((36, 64, 3)) * [row / ROWS, column / COLUMNS, 0.2]
                write_image(place / "jobs" / id / "image.exr", pixels)
        axes = [
            {"name": name, "values": list(range(count))}
            for name, count in (("row", ROWS), ("column", COLUMNS))
        ]
        (place / "study.json").write_text(json.dumps({"name": "Long", "axes": axes}))
        cls.page = place / "report.html"
        write(study.load(place), cls.page, ppd=67.0, hdr=False, processes=1, largest_mb=MEGABYTES)
        start = time.monotonic()
        cls.browser = Browser(cls.page, 1280, 900)
        cls.seconds = time.monotonic() - start
        cls.addClassCleanup(cls.browser.close)

    def test_it_is_small_and_opens_soon(self) -> None:
        """Noise does not compress: without a limit it would be 5 MB."""
        self.assertLess(self.page.stat().st_size, 1.5 * MEGABYTES * 1e6)
        self.assertLess(self.seconds, 20.0)
        self.assertEqual(self.browser.complaints(), [])

    def test_the_contact_sheet_has_every_render(self) -> None:
        cells = [cell.get_attribute("data-job") for cell in self.browser.all("#sheet-grid .cell")]
        self.assertEqual(len(cells), ROWS * COLUMNS)
        self.assertEqual(len(set(cells)), ROWS * COLUMNS)
        self.assertEqual(cells[1], "r1c0")  # the longer axis runs to the right

    def test_the_table_grows_on_demand_and_sorts_all(self) -> None:
        rows = "#jobs tbody tr"
        self.assertEqual(len(self.browser.all(rows)), 200)
        self.assertEqual(
            self.browser.one("#filter-count").text, f"{ROWS * COLUMNS} of {ROWS * COLUMNS}"
        )
        column = self.browser.all("#jobs thead button")[1]
        for _ in range(2):
            self.browser.js("arguments[0].click()", column)
        first = self.browser.one(rows).get_attribute("data-job")
        self.assertTrue(first.startswith("r20"), first)
        self.browser.js("document.getElementById('more').click()")
        self.assertEqual(len(self.browser.all(rows)), ROWS * COLUMNS)
        self.assertFalse(self.browser.one("#more").is_displayed())

    def test_orders_are_unpacked_when_they_are_wanted(self) -> None:
        before = self.browser.js("return document.getElementById('first').toDataURL()")
        self.browser.drawn_after(self.browser.one("#orders").click)
        after = self.browser.js("return document.getElementById('first').toDataURL()")
        self.assertNotEqual(before, after)


if __name__ == "__main__":
    unittest.main()
