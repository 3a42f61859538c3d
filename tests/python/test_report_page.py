# SPDX-License-Identifier: GPL-2.0-or-later
"""The report in a real Chromium: every control does what it says, nothing leaves the machine."""

from __future__ import annotations

import tempfile
import unittest
from pathlib import Path
from unittest import mock

import numpy as np
from browser import Browser
from compare_support import write_image
from report_fixture import REFERENCE, SIZE, picture, write_study
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.keys import Keys

from icwafer.compare import colour, srgb
from icwafer.report import study
from icwafer.report.page import write

OTHER = "spacing900-lobe0.01"


def shown(spacing: float, lobe: float, exposure: float = 0.0) -> np.ndarray:
    """A render as the screen shows it, 0 to 255."""
    halves = picture(spacing, lobe).astype(np.float16).astype(np.float64)
    return colour.SRGB_CURVE.encode(halves * 2.0**exposure) * 255


class PageCase(unittest.TestCase):
    width, height, scheme = 1400, 900, "dark"

    @classmethod
    def setUpClass(cls) -> None:
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        cls.page = cls.folder / "report.html"
        with (
            mock.patch.object(colour, "CONFIGURATIONS", ()),
            mock.patch.dict("os.environ", {"OCIO": ""}),
        ):
            write(study.load(write_study(cls.folder / "study")), cls.page, ppd=67.0, processes=1)
        cls.browser = Browser(cls.page, cls.width, cls.height, cls.scheme)
        cls.addClassCleanup(cls.browser.close)

    def setUp(self) -> None:
        self.browser.open()

    def tearDown(self) -> None:
        self.assertEqual(self.browser.complaints(), [])
        self.assertEqual(self.browser.requests(), [])

    def assert_colour(self, canvas: str, place: tuple[float, float], truth: np.ndarray) -> None:
        """The canvas shows the whole picture: the colour at a place, in shares, within 2.

        The place must be the middle of a pixel.
        """
        found = self.browser.colour(canvas, *place)
        column, row = int(place[0] * SIZE[0]), int(place[1] * SIZE[1])
        np.testing.assert_allclose(found, truth[row, column], atol=2.5)


#: Middles of pixels, in shares of the picture.
LEFT, RIGHT = ((8.5 / 48, 9.5 / 30), (40.5 / 48, 9.5 / 30))
PLACES = (LEFT, RIGHT, (20.5 / 48, 4.5 / 30), (30.5 / 48, 20.5 / 30))


class Wide(PageCase):
    def test_colours_are_those_of_the_view_transform(self) -> None:
        """A and B side by side: what the table gives, within 2 of 255 of OpenColorIO's way."""
        self.browser.choose("mode", "side")
        for place in PLACES:
            self.assert_colour("first", place, shown(1000, 0.01))
            self.assert_colour("second", place, shown(900, 0.01))

    def test_slider(self) -> None:
        self.assertTrue(self.browser.one("input[value='slider']").is_selected())
        self.assert_colour("first", LEFT, shown(1000, 0.01))
        self.assert_colour("first", RIGHT, shown(900, 0.01))
        self.browser.slide("split", 0.95)
        self.assert_colour("first", RIGHT, shown(1000, 0.01))
        canvas = self.browser.one("#first")
        width = canvas.size["width"]
        self.browser.drawn_after(
            lambda: ActionChains(self.browser.driver)
            .move_to_element_with_offset(canvas, round(0.45 * width), 0)
            .click_and_hold().move_by_offset(round(-0.9 * width), 0).release().perform()
        )  # fmt: skip
        self.browser.wait(
            lambda: abs(float(self.browser.one("#split").get_attribute("value")) - 0.05) < 0.02
        )
        self.browser.wait(
            lambda: np.abs(np.subtract(self.browser.colour("first", *LEFT),
                                       shown(900, 0.01)[9, 8])).max() < 3
        )  # fmt: skip

    def test_flicker(self) -> None:
        self.browser.choose("mode", "flicker")
        step = self.browser.one("#flicker-step")
        self.assert_colour("first", LEFT, shown(1000, 0.01))
        self.browser.drawn_after(step.click)
        self.assert_colour("first", LEFT, shown(900, 0.01))
        self.browser.drawn_after(step.click)
        self.assert_colour("first", LEFT, shown(1000, 0.01))
        tag = self.browser.one(".tag")
        self.browser.one("#flicker-run").click()
        seen = set()
        self.browser.wait(lambda: seen.add(tag.text[:1]) or len(seen) == 2, 10)
        self.browser.one("#flicker-run").click()
        self.assertEqual(self.browser.one("#flicker-run").text, "Start")

    def test_exposure_and_channels(self) -> None:
        self.browser.choose("mode", "side")
        self.browser.slide("exposure", -2)
        self.assertEqual(self.browser.one("#exposure-out").text, "-2 EV")
        for place in PLACES:
            self.assert_colour("first", place, shown(1000, 0.01, -2))
        self.browser.choose("channel", "g")
        for place in PLACES:
            green = shown(1000, 0.01, -2)[..., 1:2].repeat(3, axis=-1)
            self.assert_colour("first", place, green)
        self.browser.drawn_after(self.browser.one("#exposure-reset").click)
        self.assertEqual(self.browser.one("#exposure-out").text, "0 EV")

    def test_difference(self) -> None:
        """The scale ends at full scale: darkest where equal, lightest where beyond it."""
        self.browser.choose("mode", "difference")
        difference = np.abs(picture(1000, 0.01) - picture(900, 0.01)).max(axis=-1)
        self.browser.slide("full", -10)
        row, column = np.unravel_index(difference.argmax(), difference.shape)
        place = (column + 0.5) / SIZE[0], (row + 0.5) / SIZE[1]
        np.testing.assert_allclose(self.browser.colour("first", *place), [252, 253, 191], atol=3)
        top = 0.5, 0.5 / SIZE[1]  # the first row is black in both
        np.testing.assert_allclose(self.browser.colour("first", *top), [0, 0, 4], atol=3)
        ticks = [tick.text for tick in self.browser.all("#bar-ticks span")]
        self.assertEqual((ticks[0], ticks[-1]), ("0", "9.77e-4"))
        self.assertTrue(self.browser.one("#bar").is_displayed())
        self.browser.slide("full", 3)
        found = self.browser.colour("first", *place)
        self.assertLess(sum(found), 400)

    def test_flip(self) -> None:
        self.browser.choose("mode", "flip")
        self.assertIn("FLIP of B", self.browser.one(".tag").text)
        self.assertEqual(self.browser.all("#bar-ticks span")[-1].text, "1")
        worst = max(sum(self.browser.colour("first", x, y)) for x, y in PLACES)
        self.assertGreater(worst, 250)
        # The reference has no difference from itself.
        self.browser.drawn_after(
            lambda: self.browser.js(
                "const s = document.getElementById('pick-b'); s.value = arguments[0];"
                "s.dispatchEvent(new Event('change'))", REFERENCE
            )
        )  # fmt: skip
        for x, y in PLACES:
            np.testing.assert_allclose(self.browser.colour("first", x, y), [0, 0, 4], atol=2)

    def test_zoom_stays_in_step(self) -> None:
        self.browser.choose("mode", "side")
        same = self.browser.js("return document.getElementById('pick-a').value")
        self.browser.drawn_after(
            lambda: self.browser.js(
                "const s = document.getElementById('pick-b'); s.value = arguments[0];"
                "s.dispatchEvent(new Event('change'))", same
            )
        )  # fmt: skip
        pixels = "return ['first', 'second'].map((id) => document.getElementById(id).toDataURL())"
        fitted, _ = self.browser.js(pixels)
        first = self.browser.one("#first")
        self.browser.js("document.getElementById('viewer').scrollIntoView()")
        self.browser.drawn_after(
            lambda: self.browser.js(
                "const c = document.getElementById('first'), r = c.getBoundingClientRect();"
                "c.dispatchEvent(new WheelEvent('wheel', {deltaY: -480, bubbles: true,"
                " cancelable: true, clientX: r.left + 60, clientY: r.top + 40}))"
            )
        )
        zoomed, other = self.browser.js(pixels)
        self.assertNotEqual(zoomed, fitted)
        self.assertEqual(zoomed, other)
        self.browser.drawn_after(
            lambda: ActionChains(self.browser.driver)
            .drag_and_drop_by_offset(first, 50, 30).perform()
        )  # fmt: skip
        moved, other = self.browser.js(pixels)
        self.assertNotEqual(moved, zoomed)
        self.assertEqual(moved, other)
        self.browser.drawn_after(self.browser.one("#zoom-fit").click)
        self.assertEqual(self.browser.js(pixels), [fitted, fitted])

    def test_keys(self) -> None:
        a, b = (self.browser.one(f"#pick-{side}") for side in "ab")
        names = a.get_attribute("value"), b.get_attribute("value")
        canvas = self.browser.one("#first")
        self.browser.js("arguments[0].focus()", canvas)
        self.browser.drawn_after(
            lambda: self.browser.driver.switch_to.active_element.send_keys(" ")
        )
        self.assertEqual((b.get_attribute("value"), a.get_attribute("value")), names)
        before = self.browser.js("return document.getElementById('first').toDataURL()")
        for key, changes in (("+", True), (Keys.ARROW_LEFT, True), ("0", False)):
            self.browser.drawn_after(
                lambda key=key: self.browser.driver.switch_to.active_element.send_keys(key)
            )
            now = self.browser.js("return document.getElementById('first').toDataURL()")
            self.assertEqual(now != before, changes, key)

    def test_readout(self) -> None:
        canvas = self.browser.one("#first")
        ActionChains(self.browser.driver).move_to_element(canvas).perform()
        text = self.browser.wait(lambda: self.browser.one("#readout").text.strip())
        self.assertRegex(text, r"x 2[34] +y 1[45] +A [0-9.e -]+ B ")
        values = [float(word) for word in text.split("A ")[1].split()[:3]]
        column, row = (int(text.split()[i]) for i in (1, 3))
        np.testing.assert_allclose(values, picture(1000, 0.01)[row, column], rtol=0.01, atol=1e-3)

    def test_predicted_orders(self) -> None:
        self.browser.choose("mode", "side")
        before = self.browser.js("return document.getElementById('first').toDataURL()")
        self.browser.drawn_after(self.browser.one("#orders").click)
        self.assertNotEqual(
            self.browser.js("return document.getElementById('first').toDataURL()"), before
        )

    def test_table(self) -> None:
        def column(index: int) -> list[str]:
            return [cell.text for cell in self.browser.all(f"#jobs tbody td:nth-child({index})")]

        heads = [head.text for head in self.browser.all("#jobs th")]
        self.assertEqual(heads[:4], ["Picture", "Render", "spacing, nm", "lobe"])
        flip_column = heads.index("flip") + 1
        button = self.browser.one(f"#jobs th:nth-child({flip_column}) button")
        for order in ("ascending", "descending"):
            button.click()
            head = self.browser.one(f"#jobs th:nth-child({flip_column})")
            self.assertEqual(head.get_attribute("aria-sort"), order)
            texts = column(flip_column)
            values = [float(text) for text in texts if text]
            self.assertEqual(values, sorted(values, reverse=order == "descending"))
            self.assertEqual(texts[-2:], ["", ""])  # the failed ones
            self.assertEqual(len(values), 6)
        box = self.browser.one("#filter")
        for words, count in (("spacing=900", 2), ("spacing=900 lobe<0.02", 1), ("signal", 1),
                             ("nothing like it", 0), ("", 8)):  # fmt: skip
            box.clear()
            box.send_keys(words or " ")
            self.browser.wait(
                lambda count=count: self.browser.one("#filter-count").text == f"{count} of 8"
            )
            self.assertEqual(len(self.browser.all("#jobs tbody tr")), count)
        self.browser.drawn_after(self.browser.one(f"[aria-label='Make {OTHER} A']").click)
        self.assertEqual(self.browser.one("#pick-a").get_attribute("value"), OTHER)

    def test_settings_and_command(self) -> None:
        card = self.browser.one(".card.of-a")
        self.assertIn(f"{REFERENCE}", card.text)
        self.assertIn("1000 nm", card.text)
        command = card.find_element("css selector", "pre").text
        self.assertEqual(command, f"icwafer render study.toml --only {REFERENCE}")
        self.browser.driver.execute_cdp_cmd(
            "Browser.grantPermissions",
            {"permissions": ["clipboardReadWrite", "clipboardSanitizedWrite"]},
        )
        button = card.find_element("css selector", "button.copy")
        button.click()
        self.browser.wait(lambda: button.text.startswith(("Copied", "Selected")))
        if button.text.startswith("Copied"):
            pasted = self.browser.driver.execute_async_script(
                "navigator.clipboard.readText().then(arguments[0])"
            )
        else:
            pasted = self.browser.js("return getSelection().toString()")
        self.assertEqual(pasted, command)

    def test_contact_sheet_and_plot(self) -> None:
        cells = self.browser.all("#sheet-grid .cell")
        self.assertEqual(len(cells), 6)
        self.browser.drawn_after(cells[2].click)
        chosen = cells[2].get_attribute("data-job")
        self.assertEqual(self.browser.one("#pick-b").get_attribute("value"), chosen)
        self.assertIn("of-b", cells[2].get_attribute("class"))
        self.assertEqual(len(self.browser.all("#plot .mark")), 6)
        lines = [line.get_attribute("points") for line in self.browser.all("#plot polyline")]
        self.assertEqual(len(lines), 2)
        # The reference is one of the points, with no difference: the lowest mark of its line.
        heights = [float(point.split(",")[1]) for point in lines[0].split()]
        self.assertEqual(max(heights), heights[1])

    def test_corners_of_a_photograph(self) -> None:
        photo = write_image(self.folder / "photo it's.png", np.full((300, 400, 3), 0.4))
        self.browser.one("#photo-file").send_keys(str(photo))
        canvas = self.browser.one("#photo-canvas")
        self.browser.wait(canvas.is_displayed)
        self.browser.js("arguments[0].scrollIntoView({block: 'center'})", canvas)
        for x, y in ((-150, -100), (150, -90), (160, 110), (-170, 100)):
            ActionChains(self.browser.driver).move_to_element_with_offset(
                canvas, x, y
            ).click().perform()
        line = self.browser.one("#photo-line").text
        self.assertTrue(line.startswith("icwafer compare --photo 'photo it'\\''s.png' --corners "))
        corners = [tuple(map(float, word.split(","))) for word in line.split()[-5:-1]]
        np.testing.assert_allclose(corners, [(50, 50), (350, 60), (360, 260), (30, 250)], atol=1.5)

    def test_every_control_has_a_name(self) -> None:
        """What a screen reader says, from Chromium's own accessibility tree."""
        self.browser.driver.execute_cdp_cmd("Accessibility.enable", {})
        tree = self.browser.driver.execute_cdp_cmd("Accessibility.getFullAXTree", {})["nodes"]
        roles = {"button", "slider", "radio", "combobox", "searchbox", "checkbox", "link", "image"}
        nameless = [
            node
            for node in tree
            if not node.get("ignored")
            and node["role"]["value"] in roles
            and not node.get("name", {}).get("value", "").strip()
        ]
        self.assertEqual(nameless, [])


class Telephone(PageCase):
    width, height, scheme = 390, 844, "light"

    def test_fits(self) -> None:
        for mode in ("side", "flicker", "difference", "flip", "slider"):
            self.browser.choose("mode", mode)
            self.assertLessEqual(
                self.browser.js("return document.documentElement.scrollWidth"), 390, mode
            )
        small = self.browser.js(
            "return [...document.querySelectorAll('main button, main select')]"
            ".filter((b) => b.checkVisibility() && b.getBoundingClientRect().height < 24)"
            ".map((b) => b.textContent)"
        )
        self.assertEqual(small, [])

    def test_contrast(self) -> None:
        """Text against its ground, WCAG 2.1: 4.5 to 1, in both schemes."""
        for scheme in ("light", "dark"):
            self.browser.driver.execute_cdp_cmd(
                "Emulation.setEmulatedMedia",
                {"features": [{"name": "prefers-color-scheme", "value": scheme}]},
            )
            names = ("ink", "quiet", "accent", "a", "b", "bad", "ground", "panel", "on-accent")
            values = {
                name: self.browser.js(
                    "return getComputedStyle(document.documentElement)"
                    ".getPropertyValue('--' + arguments[0]).trim()", name
                )
                for name in names
            }  # fmt: skip
            light = {name: _luminance(value) for name, value in values.items()}
            for text in ("ink", "quiet", "a", "b", "bad"):
                for ground in ("ground", "panel"):
                    self.assertGreaterEqual(
                        _contrast(light[text], light[ground]), 4.5, (scheme, text, ground)
                    )
            self.assertGreaterEqual(_contrast(light["on-accent"], light["accent"]), 4.5, scheme)


def _luminance(hex_colour: str) -> float:
    encoded = np.array([int(hex_colour[i : i + 2], 16) for i in (1, 3, 5)]) / 255
    return float(srgb.decode(encoded) @ srgb.LUMINANCE)


def _contrast(first: float, second: float) -> float:
    return (max(first, second) + 0.05) / (min(first, second) + 0.05)


if __name__ == "__main__":
    unittest.main()
