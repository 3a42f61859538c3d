# SPDX-License-Identifier: GPL-2.0-or-later
"""Through real Cycles, the grating's colours appear where the exact grating law says."""

from __future__ import annotations

import math
import unittest
from dataclasses import asdict, replace
from pathlib import Path

import cycles_xml
import dispersion
import host
import numpy as np
import pixels
from dispersion import Mount, Peak

ABOVE = (0.0, 0.0, 3.0)

MOUNTS = (
    Mount("along x", 1000.0, 0.0, lamp=(0.0, 0.0, 1.0), camera=ABOVE),
    Mount("along y", 1000.0, 90.0, lamp=(0.0, 0.0, 1.0), camera=ABOVE),
    Mount("slanting wires", 1300.0, 37.0, lamp=(0.0, 0.0, 1.0), camera=ABOVE),
    Mount("oblique light", 1600.0, 37.0, lamp=(0.6, -0.4, 1.0), camera=ABOVE),
    Mount("turned object", 1300.0, -8.0, lamp=(-0.3, 0.2, 1.0), camera=ABOVE, turn_deg=45.0),
    Mount("coarse wires", 2400.0, 0.0, lamp=(0.5, 0.3, 1.0), camera=ABOVE, lobe_width=0.002),
    Mount(
        "perspective and conical",
        1000.0,
        90.0,
        lamp=(0.2, 0.5, 1.0),
        camera=(0.0, -0.9, 1.2),
        perspective=True,
        view=1.6,
    ),
    Mount(
        "grazing perspective",
        2000.0,
        20.0,
        lamp=(0.7, 0.9, 0.6),
        camera=(-0.5, -1.0, 0.7),
        perspective=True,
        view=1.4,
    ),
)


def distance_px(one: Peak, other: Peak) -> float:
    return math.hypot(one.column - other.column, one.row - other.row)


class GratingLaw(unittest.TestCase):
    folder: Path

    @classmethod
    def setUpClass(cls) -> None:
        cls.folder = host.fresh_folder("grating_law")

    def picture_path(self, mount: Mount) -> Path:
        return self.folder / f"{mount.name.replace(' ', '_')}.exr"

    def assert_peaks_where_predicted(self, mount: Mount, rendered: np.ndarray) -> None:
        expected = dispersion.peaks(mount, dispersion.picture(mount))
        self.assertGreaterEqual(len(expected), 3, "fewer peaks than one order has")
        for predicted, found in zip(expected, dispersion.peaks(mount, rendered), strict=True):
            self.assertLess(
                distance_px(predicted, found),
                1.0,
                f"{mount.name}: expected {predicted}, found {found}",
            )

    def test_blender(self) -> None:
        jobs = [
            asdict(mount)
            | {
                "axes": [axis.tolist() for axis in dispersion.camera_axes(mount)],
                "exr": str(self.picture_path(mount)),
            }
            for mount in MOUNTS
        ]
        host.run_inside(
            host.built_blender(),
            "render_mounts",
            {"mounts": jobs},
            folder=self.folder,
            seconds=300,
        )
        for mount in MOUNTS:
            with self.subTest(mount.name):
                self.assert_peaks_where_predicted(mount, pixels.read(self.picture_path(mount)))

    def test_standalone_cycles(self) -> None:
        for mount in MOUNTS:
            with self.subTest(mount.name):
                xml = self.picture_path(mount).with_suffix(".xml")
                exr = self.picture_path(mount).with_suffix(".standalone.exr")
                xml.write_text(cycles_xml.scene(mount))
                size = ("--width", str(mount.size_px), "--height", str(mount.size_px))
                ended = host.run(
                    host.built_cycles(),
                    *("--background", "--quiet", "--samples", "16", *size, "--output", exr, xml),
                    folder=self.folder,
                    seconds=60,
                )
                self.assertTrue(exr.exists(), ended.tail())
                self.assert_peaks_where_predicted(mount, pixels.read(exr))

    def test_a_slight_error_would_show(self) -> None:
        """2 % in the spacing, or 2 degrees in the wires' direction, move peaks by over a pixel."""
        for mount in MOUNTS:
            expected = dispersion.peaks(mount, dispersion.picture(mount))
            for wrong in (
                replace(mount, spacing_nm=1.02 * mount.spacing_nm),
                replace(mount, direction_deg=mount.direction_deg + 2.0),
            ):
                moved = dispersion.peaks(mount, dispersion.picture(wrong))
                with self.subTest(mount.name, spacing_nm=wrong.spacing_nm):
                    self.assertGreater(max(map(distance_px, expected, moved)), 1.0)


if __name__ == "__main__":
    unittest.main()
