# SPDX-License-Identifier: GPL-2.0-or-later
"""A report of thousands of renders: how long it takes, how large it is, how soon it opens.

    PYTHONPATH=scripts/python /usr/bin/python3 tests/benchmarks/report_scale.py

The study is made up of small pictures of bands, swept over three axes, with the orders' places.
"""

from __future__ import annotations

import argparse
import json
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "scripts" / "python"), str(ROOT / "tests" / "python")]

from browser import Browser  # noqa: E402
from compare_support import write_image  # noqa: E402
from report_fixture import GRATING, add_job  # noqa: E402

from icwafer.report import page, study  # noqa: E402


def write_study(folder: Path, shape: tuple[int, int, int], size: tuple[int, int]) -> None:
    """One job for every combination of three axes' values."""
    names = ("spacing", "lobe", "seed")
    axes = [
        {"name": name, "unit": "", "values": list(range(count))}
        for name, count in zip(names, shape)
    ]
    across = np.linspace(0, 3, size[0])[None, :, None] * np.ones((size[1], 1, 1))
    for number, place in enumerate(np.ndindex(shape)):
        settings = dict(zip(names, place))
        id = "_".join(f"{name}-{value}" for name, value in settings.items())
        random = np.random.default_rng(number)
        phase = across * (1 + place[0] / shape[0]) + np.array([0.0, 0.33, 0.66])
        pixels = (0.5 + 0.5 * np.cos(2 * np.pi * phase)) ** 2 * random.gamma(9, 1 / 9, phase.shape)
        command = ["scripts/icwafer", "render", "study.toml", "-o", "results", "--only", id]
        add_job(folder, id, {
            "settings": settings, "command": command, "seconds": 1.5, "samples": 16, "seed": place[2],
            "grating": GRATING,
        })  # fmt: skip
        write_image(folder / "jobs" / id / "image.exr", pixels)
    (folder / "study.json").write_text(json.dumps({"name": "Thousands", "axes": axes}))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--shape", type=int, nargs=3, default=(25, 20, 10), metavar="N")
    parser.add_argument("--size", type=int, nargs=2, default=(64, 36), metavar="PX")
    parser.add_argument("--megabytes", type=float, default=64.0)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        write_study(folder, tuple(arguments.shape), tuple(arguments.size))
        start = time.monotonic()
        output, *_ = page.write(
            study.load(folder), folder / "report.html", ppd=67.0,
            largest_mb=arguments.megabytes,
        )  # fmt: skip
        count = int(np.prod(arguments.shape))
        print(
            f"{count} renders of {arguments.size[0]}x{arguments.size[1]}: "
            f"page in {time.monotonic() - start:.0f} s, {output.stat().st_size / 1e6:.1f} MB"
        )
        start = time.monotonic()
        browser = Browser(output, 1280, 900)
        print(f"drawn {time.monotonic() - start:.1f} s after Chromium's start")
        start = time.monotonic()
        browser.open()
        print(f"drawn again after {time.monotonic() - start:.1f} s")
        print(browser.complaints())
        browser.close()


if __name__ == "__main__":
    main()
