# SPDX-License-Identifier: GPL-2.0-or-later
"""Blocks smaller than a pixel: nothing jumps, and Spacing Variation stands for them."""

from __future__ import annotations

import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import host
import numpy as np

from icwafer.compare import hues, images

#: The pixel grows from half of a block's side to four of them.
DISTANCES_MM = [5, 10, 20, 40]
CASES = {
    "blocks": "spacing_nm = { mean = 1080, deviation = 65 }",
    "averaged": "spacing_nm = 1080, spacing_variation = 0.06",
    "mean only": "spacing_nm = 1080",
}
STUDY = """
version = 1
name = "Near to far"
[scene]
picture = "clustered_groups"
die.width_mm = 48
die.height_mm = 48
die.copies_alike = false
die.groups."*".turned = 0
die.groups."*".width_nm = 250
node = {{ model = "PHYSICAL", "Coherence Width" = 30, "Wire Length" = 1 }}
render = {{ size = [48, 27], samples = 64 }}
[[scene.lights]]
kind = "POINT"
position_mm = [0, 3600, 17600]
power_w = 9e9
radius_mm = 500
[[axis]]
name = "case"
{cases}
[[axis]]
name = "distance"
set = ["camera.position_mm", "camera.target_mm"]
values = {places}
"""


class NearToFar(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        cases = "".join(
            f'[[axis.case]]\nname = "{name}"\nscene.die.groups."*" = {{ {spacing} }}\n'
            for name, spacing in CASES.items()
        )
        places = [[[0, -0.7071 * mm, 0.7071 * mm], [0, 0, 0]] for mm in DISTANCES_MM]
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            study = folder / "study.toml"
            study.write_text(STUDY.format(cases=cases, places=places))
            subprocess.run(
                [host.REPOSITORY / "scripts" / "icwafer", "render", study, "-o", folder / "out"],
                env=os.environ | {"ICWAFER_BLENDER": str(host.built_blender())},
                check=True,
            )
            done = json.loads((folder / "out" / "study.json").read_text())["jobs"]
            found = [images.read(folder / "out" / "jobs" / id / "image.exr").pixels for id in done]
        count = len(DISTANCES_MM)
        cls.found = {
            case: np.array(found[i * count : (i + 1) * count]) for i, case in enumerate(CASES)
        }

    def test_the_pictures_have_colours(self) -> None:
        """Else the other tests would be true of anything: some hues, and blocks that differ."""
        near = self.found["blocks"][0]
        self.assertGreater(near.mean(), 0.05)
        self.assertGreater(near.mean(axis=0).std(), 0.1 * near.mean())
        relative = np.abs(near - self.found["averaged"][0]).mean() / near.mean()
        self.assertGreater(relative, 0.1)

    def test_far_away_one_block_stands_for_many(self) -> None:
        """In tiles of 6 x 6 pixels: the farther, the more blocks, up to hundreds, are averaged."""
        tiles = {
            case: found[:, :24].reshape(-1, 4, 6, 8, 6, 3).mean(axis=(2, 4))
            for case, found in self.found.items()
        }
        size = tiles["averaged"].mean(axis=(1, 2, 3))
        apart, without = (
            np.abs(tiles["blocks"] - tiles[case]).mean(axis=(1, 2, 3)) / size
            for case in ("averaged", "mean only")
        )
        self.assertTrue(np.all(np.diff(apart) < 0.0), apart)
        self.assertLess(apart[-1], 0.1)
        self.assertGreater(without[-1], 3 * apart[-1])

    def test_energy_and_hue_do_not_jump(self) -> None:
        """Parallel light, and a camera that goes straight back: the mean must stay as it is, but
        for the few blocks that are seen from near."""
        for case, energy, hue_deg in (("averaged", 0.04, 3.0), ("blocks", 0.08, 12.0)):
            means = self.found[case].mean(axis=(1, 2))
            self.assertLess(np.abs(np.diff(np.log(means.sum(axis=1)))).max(), energy, case)
            lab = hues.to_oklab(means)
            turn = np.degrees(np.diff(np.unwrap(np.arctan2(lab[:, 2], lab[:, 1]))))
            self.assertLess(np.abs(turn).max(), hue_deg, case)


if __name__ == "__main__":
    unittest.main()
