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

    def test_tables_of_the_material(self) -> None:
        generators = sorted((ROOT / "shaders/icwafer/data").glob("make_*.py"))
        self.assertEqual(len(generators), 4)
        for generator in generators:
            with self.subTest(generator.name):
                self.check(str(generator.relative_to(ROOT)))

    def test_reflectance_of_the_metals(self) -> None:
        """The table with linear interpolation keeps the reflectance within 2e-3."""
        sys.path.insert(0, str(ROOT / "shaders/icwafer/data"))
        import make_metals

        for name, file, _ in make_metals.METALS:
            for above in (1.0, 1.46):
                with self.subTest(name, above=above):
                    self.assertLess(make_metals.reflectance_error(file, above), 2e-3)

    def test_manual_page(self) -> None:
        self.check("plugin/manual/make_manual.py")

    def test_manual_has_every_input(self) -> None:
        sys.path.insert(0, str(ROOT / "plugin" / "manual"))
        import make_manual

        names = [i.name for i in make_manual.float_inputs()]
        self.assertEqual(names[:3], ["Wire Spacing", "Wire Width", "Oxide Thickness"])
        self.assertEqual(len(set(names)), len(names))
        for i in make_manual.float_inputs():
            self.assertLessEqual(i.minimum, i.initial, i.name)
            self.assertLessEqual(i.initial, i.maximum, i.name)
            self.assertGreater(len(i.tooltip), 40, i.name)


if __name__ == "__main__":
    unittest.main()
