# SPDX-License-Identifier: GPL-2.0-or-later
"""Real noise: two seeds of one die are the same, one percent of its wires' spacing is not.

How often it is wrong is measured with 200 pairs by tests/benchmarks/noise_error_rates.py.
"""

from __future__ import annotations

import unittest

import host
import numpy as np

from icwafer.compare import images, noise

SIZE, SAMPLES = (128, 72), 16


class RealNoise(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        folder = host.fresh_folder("noise_test")
        names = [
            f"{kind}-{i}" for kind, count in (("same", 4), ("changed", 2)) for i in range(count)
        ]
        host.run_inside(
            host.built_blender(),
            "render_seeds",
            {
                "package": str(host.REPOSITORY / "scripts" / "python"),
                "picture": "full",
                "size": SIZE,
                "samples": SAMPLES,
                "renders": [
                    {
                        "seed": seed,
                        "spacing_scale": 1.0 if name.startswith("same") else 1.01,
                        "exr": str(folder / f"{name}.exr"),
                    }
                    for seed, name in enumerate(names, start=1)
                ],
            },
            folder=folder,
            seconds=300,
        )
        cls.same, cls.changed = (
            [images.read(folder / f"{name}.exr").pixels for name in names if name.startswith(kind)]
            for kind in ("same", "changed")
        )

    def test_seeds_differ(self) -> None:
        """Else the next test would be true of anything."""
        self.assertGreater(np.abs(self.same[0] - self.same[1]).max(), 0.05)

    def test_same_scene(self) -> None:
        self.assertFalse(noise.compare(self.same[:1], self.same[1:2]).different)
        self.assertFalse(noise.compare(self.same[:2], self.same[2:]).different)

    def test_one_percent_of_spacing(self) -> None:
        found = noise.compare(self.same[:2], self.changed)
        self.assertTrue(found.different)
        self.assertLess(found.p, 1e-4)
        self.assertGreater(found.rms_beyond, 0.0)


if __name__ == "__main__":
    unittest.main()
