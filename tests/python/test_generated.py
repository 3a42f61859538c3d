# SPDX-License-Identifier: GPL-2.0-or-later
"""What is generated and committed is what its generator writes today."""

import html
import re
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

    def test_manual_has_every_attribute_of_meshes(self) -> None:
        """Each with its meaning and unit, and with an input of the node that it drives."""
        sys.path[:0] = [str(ROOT / "plugin" / "manual"), str(ROOT / "scripts" / "python")]
        import make_manual

        from icwafer.attributes import OF_FACES, OF_INSTANCES

        page = make_manual.page_text()
        rows = dict(re.findall(r"<tr><td><code>(ic_\w+)</code><td>(.*)", page))
        self.assertEqual(set(rows), {attribute.name for attribute in (*OF_FACES, *OF_INSTANCES)})
        inputs = {i.name for i in make_manual.float_inputs()}
        for attribute in OF_FACES:
            cells = html.unescape(rows[attribute.name]).split("<td>")
            self.assertEqual(cells, [attribute.unit, attribute.meaning, attribute.socket])
            self.assertIn(attribute.socket, inputs)
        for attribute in OF_INSTANCES:
            self.assertIn(attribute.meaning, html.unescape(rows[attribute.name]))

    def test_manual_shows_every_input(self) -> None:
        """Three values or more of each, in pictures of just these values, and no others."""
        sys.path.insert(0, str(ROOT / "plugin" / "manual"))
        import make_manual
        import OpenImageIO as oiio
        import sweeps

        wanted = {i.name for i in make_manual.float_inputs()}
        wanted |= {"Color", "Normal", "Tangent", "Metal n", "Metal k"}
        wanted |= {"Metal", "Oxide", "Illuminant", "Effects"}
        self.assertEqual(set(sweeps.SWEEPS), wanted)
        files, page = set(), make_manual.page_text()
        for sweep in sweeps.SWEEPS.values():
            self.assertGreaterEqual(len(sweep.panels), 3, sweep.name)
            for panel in sweep.panels:
                file = sweep.file(panel)
                with self.subTest(file.name):
                    spec = oiio.ImageBuf(str(file)).spec()
                    noted = spec.get_string_attribute("ImageDescription")
                    self.assertEqual(noted, sweep.description(panel), "render it anew")
                    self.assertIn(f'src="pictures/{file.name}"', page)
                files.add(file)
        self.assertEqual(set(sweeps.PICTURES.iterdir()), files)
        self.assertLess(sum(file.stat().st_size for file in files), 600_000)

    def test_manual_shows_values_that_an_input_takes(self) -> None:
        sys.path.insert(0, str(ROOT / "plugin" / "manual"))
        import make_manual
        import sweeps

        for i in make_manual.float_inputs():
            values = [panel.values[i.name] for panel in sweeps.SWEEPS[i.name].panels]
            self.assertGreaterEqual(len(set(values)), 3, i.name)
            for value in values:
                self.assertTrue(i.minimum <= value <= i.maximum, f"{i.name} {value}")


if __name__ == "__main__":
    unittest.main()
