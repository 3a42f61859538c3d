# SPDX-License-Identifier: GPL-2.0-or-later
"""A real Chromium without a window, for the tests of pages, and what it complained about."""

from __future__ import annotations

import json
import time
from collections.abc import Callable
from pathlib import Path

from selenium import webdriver
from selenium.common.exceptions import WebDriverException
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.by import By
from selenium.webdriver.remote.webelement import WebElement

DRIVER, PROGRAM = Path("/usr/bin/chromedriver"), Path("/usr/bin/chromium")


class Browser:
    """Opens one page of a file; `width` below 500 makes it a telephone.

    draws: whether the page says when its scripts have drawn.
    """

    def __init__(
        self, page: Path, width: int, height: int, scheme: str = "dark", draws: bool = True
    ) -> None:
        if not DRIVER.is_file() or not PROGRAM.is_file():
            raise AssertionError("no Chromium: 'apt-get install chromium chromium-driver'")
        options = webdriver.ChromeOptions()
        options.binary_location = str(PROGRAM)
        for argument in ("--headless=new", "--no-sandbox", "--hide-scrollbars", "--disable-gpu"):
            options.add_argument(argument)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        self.driver = webdriver.Chrome(service=Service(str(DRIVER)), options=options)
        self.driver.set_script_timeout(30)
        self.driver.execute_cdp_cmd(
            "Emulation.setDeviceMetricsOverride",
            {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 500},
        )
        self.driver.execute_cdp_cmd(
            "Emulation.setEmulatedMedia",
            {"features": [{"name": "prefers-color-scheme", "value": scheme}]},
        )
        self.page, self.draws = page.as_uri(), draws
        self.open()

    def open(self) -> None:
        """Loads the page anew and waits until it has drawn."""
        self.driver.get(self.page)
        if self.draws:
            self.wait(lambda: self.js("return document.documentElement.dataset.drawn"))

    def close(self) -> None:
        self.driver.quit()

    def js(self, script: str, *arguments: object) -> object:
        return self.driver.execute_script(script, *arguments)

    def one(self, selector: str) -> WebElement:
        return self.driver.find_element(By.CSS_SELECTOR, selector)

    def all(self, selector: str) -> list[WebElement]:
        return self.driver.find_elements(By.CSS_SELECTOR, selector)

    def wait(self, condition: Callable[[], object], seconds: float = 20.0) -> object:
        """Until the condition is true; AssertionError if that takes too long."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            try:
                if found := condition():
                    return found
            except WebDriverException:
                pass
            time.sleep(0.03)
        raise AssertionError(f"the page did not get there within {seconds:g} s")

    def choose(self, name: str, value: str) -> None:
        """A radio button, by its label as a person would, then waits for the drawing."""
        self.drawn_after(
            lambda: self.one(f"label:has(input[name='{name}'][value='{value}'])").click()
        )

    def slide(self, id: str, value: float) -> None:
        """Moves a slider."""
        self.drawn_after(
            lambda: self.js(
                "const [id, value] = arguments; const slider = document.getElementById(id);"
                "slider.value = value; slider.dispatchEvent(new Event('input'));",
                id,
                value,
            )
        )

    def drawn_after(self, action: Callable[[], object]) -> None:
        """Does something that makes the page draw, and waits until it has."""
        before = self.js("return Number(document.documentElement.dataset.drawn)")
        action()
        self.wait(
            lambda: self.js("return Number(document.documentElement.dataset.drawn)") > before
        )

    def colour(self, canvas: str, x: float, y: float) -> list[int]:
        """Of a canvas at a place in shares of its size: red, green, blue."""
        return self.js(
            # From a copy: Chromium complains when a canvas that is drawn on is read.
            "const [id, x, y] = arguments; const c = document.getElementById(id);"
            "const copy = new OffscreenCanvas(1, 1);"
            "const context = copy.getContext('2d', {willReadFrequently: true});"
            "context.drawImage(c, -Math.floor(x * c.width), -Math.floor(y * c.height));"
            "return [...context.getImageData(0, 0, 1, 1).data].slice(0, 3);",
            canvas,
            x,
            y,
        )

    def complaints(self) -> list[str]:
        """What the page wrote to the console."""
        return [entry["message"] for entry in self.driver.get_log("browser")]

    def requests(self) -> list[str]:
        """Addresses that the page asked for, but for itself and data inside it."""
        messages = (json.loads(entry["message"]) for entry in self.driver.get_log("performance"))
        urls = [
            message["message"]["params"]["request"]["url"]
            for message in messages
            if message["message"]["method"] == "Network.requestWillBeSent"
        ]
        own = self.driver.current_url.split("#")[0]
        return [
            url
            for url in urls
            if not url.startswith(("data:", "blob:")) and url.split("#")[0] != own
        ]
