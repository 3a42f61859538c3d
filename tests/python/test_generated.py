# SPDX-License-Identifier: GPL-2.0-or-later
"""What is generated and committed is what its generator writes today."""

import subprocess
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


class Generated(unittest.TestCase):
    def check(self, generator: str) -> None:
        done = subprocess.run(
            [sys.executable, "-B", ROOT / generator, "--check"], capture_output=True, text=True
        )
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_colour_matching_functions(self) -> None:
        self.check("shaders/icwafer/data/make_cie1931.py")

    def test_manual_page(self) -> None:
        self.check("plugin/manual/make_manual.py")

    def test_manual_has_every_input(self) -> None:
        sys.path.insert(0, str(ROOT / "plugin" / "manual"))
        import make_manual

        names = [i.name for i in make_manual.float_inputs()]
        self.assertEqual(names[:3], ["Wire Spacing", "Wire Width", "Oxide Thickness"])
        self.assertEqual(len(names), 11)
        for i in make_manual.float_inputs():
            self.assertLessEqual(i.minimum, i.initial, i.name)
            self.assertLessEqual(i.initial, i.maximum, i.name)
            self.assertGreater(len(i.tooltip), 40, i.name)


if __name__ == "__main__":
    unittest.main()
