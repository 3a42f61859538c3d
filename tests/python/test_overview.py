# SPDX-License-Identifier: GPL-2.0-or-later
"""Reports of many studies, their index and their picture."""

from __future__ import annotations

import html
import re
import shutil

import OpenImageIO as oiio
from browser import Browser
from compare_support import CompareCase
from report_fixture import write_study

NAMES = ("first", "second & last")


class OverviewTest(CompareCase):
    def setUp(self) -> None:
        super().setUp()
        for name in NAMES:
            folder = self.folder / name.split()[0]
            folder.mkdir()
            write_study(folder, name)

    def report(self, *arguments: str) -> str:
        status, out, err = self.icwafer(
            "report", str(self.folder), "--all", "--no-hdr-flip", *arguments
        )
        self.assertEqual(status, 0, err)
        return out

    def test_index_links_all_reports(self) -> None:
        self.assertIn("index.html", self.report())
        text = (self.folder / "index.html").read_text()
        links = re.findall(r'class="study" href="([^"]+)"', text)
        self.assertEqual(links, ["first/report.html", "second/report.html"])
        for name, link in zip(NAMES, links):
            self.assertIn(f"<h2>{html.escape(name)}</h2>", text)
            self.assertIn(html.escape(name), (self.folder / link).read_text())
        self.assertIn("6 renders, 2 failed over spacing, lobe", text)

    def test_the_picture_fits_a_page(self) -> None:
        self.report()
        picture = oiio.ImageBuf(str(self.folder / "studies.jpg"))
        self.assertEqual(picture.spec().width, 1200)
        self.assertGreater(picture.get_pixels(oiio.FLOAT).std(), 0.05)

    def test_in_a_browser_a_click_opens_a_report(self) -> None:
        self.report()
        browser = Browser(self.folder / "index.html", 390, 800, draws=False)
        self.addCleanup(browser.close)
        self.assertEqual(len(browser.all(".strip img")), 12)
        wide = browser.js("return document.documentElement.scrollWidth")
        self.assertLessEqual(wide, 390)
        browser.all("a.study")[1].click()
        browser.wait(lambda: browser.js("return document.documentElement.dataset.drawn"))
        self.assertEqual(browser.one("h1").text, NAMES[1])
        self.assertEqual(browser.complaints(), [])

    def test_what_is_no_folder_of_studies(self) -> None:
        shutil.rmtree(self.folder / "second")
        self.expect_error(
            ["report", str(self.folder / "first"), "--all"], 1, "no rendered studies"
        )
        self.expect_error(["report"], 1, "or give --all")
        self.expect_error(["report", str(self.folder), "--all", "-o", "x"], 1, "leave it out")
