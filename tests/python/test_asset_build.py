# SPDX-License-Identifier: GPL-2.0-or-later
"""Files of the asset library are made anew when something changed, and only then."""

from __future__ import annotations

import shutil
import tempfile
import unittest
from pathlib import Path
from unittest import mock

from icwafer import dependencies, paths
from icwafer.assets import build
from icwafer.assets.plan import KINDS
from icwafer.errors import IcwaferError


class Building(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        root = Path(folder.name)
        self.sources = root / "library"
        shutil.copytree(build.SOURCES, self.sources)
        self.installed = root / "install"
        self.blender = self.installed / "blender"
        self.installed.mkdir()
        self.blender.write_text("a Blender")
        self.made: list[str] = []
        for target, name, value in (
            (build, "SOURCES", self.sources),
            (build, "BUILT", root / "assets"),
            (paths, "INSTALLED", self.installed),
            (paths, "BLENDER", self.blender),
            (build.render.progress, "run", self._make),
        ):
            patch = mock.patch.object(target, name, value)
            patch.start()
            self.addCleanup(patch.stop)

    def _make(self, _title: str, command: list, _log: Path, **_: object) -> None:
        """In place of Blender: writes a file that says what it was made from."""
        kind, sources, output = command[-3:]
        self.made.append(kind)
        self.assertEqual(output.suffix, ".blend")
        table = (sources / "materials.toml").read_text()
        output.write_text(f"{kind} {len(self.made)} {hash(table)}")

    def build(self) -> list[str]:
        """Builds as a new process does; returns the kinds that were made."""
        dependencies.file_hash.cache_clear()
        self.made = []
        build.build()
        return self.made

    def test_all_is_made_and_installed_and_then_left_alone(self) -> None:
        self.assertEqual(self.build(), [*KINDS])
        names = {path.name for path in build.installed_folder().iterdir()}
        self.assertEqual(
            names,
            {*(f"{kind}.blend" for kind in KINDS), "materials.toml", "blender_assets.cats.txt"},
        )
        times = {path: path.stat().st_mtime_ns for path in build.installed_folder().iterdir()}
        self.assertEqual(self.build(), [])
        for path, time in times.items():
            self.assertEqual(path.stat().st_mtime_ns, time)

    def test_another_table_another_blender_or_a_lost_file(self) -> None:
        self.build()
        table = self.sources / "materials.toml"
        table.write_text(table.read_text().replace('"Wire Width" = 432', '"Wire Width" = 430', 1))
        self.assertEqual(self.build(), ["materials"])
        installed = build.installed_folder() / "materials.toml"
        self.assertEqual(installed.read_text(), table.read_text())
        self.blender.write_text("another Blender")
        self.assertEqual(self.build(), [*KINDS])
        (build.BUILT / "dies.blend").unlink()
        self.assertEqual(self.build(), ["dies"])
        (build.installed_folder() / "dies.blend").unlink()
        self.assertEqual(self.build(), [])
        self.assertTrue((build.installed_folder() / "dies.blend").is_file())

    def test_a_failure_leaves_nothing_half_written(self) -> None:
        self.build()
        before = (build.BUILT / "lights.blend").read_text()
        (build.BUILT / "lights.sha256").unlink()

        def fail(_title: str, command: list, _log: Path, **_: object) -> None:
            command[-1].write_text("half")
            raise IcwaferError("no")

        with mock.patch.object(build.render.progress, "run", fail), self.assertRaises(IcwaferError):
            self.build()
        self.assertEqual((build.BUILT / "lights.blend").read_text(), before)
        self.assertEqual([p.name for p in build.BUILT.iterdir() if p.name.startswith(".")], [])
        self.assertEqual(self.build(), ["lights"])

    def test_a_mistake_in_the_table_stops_before_blender_starts(self) -> None:
        table = self.sources / "materials.toml"
        table.write_text(table.read_text().replace('"COPPER"', '"COPPERY"', 1))
        with self.assertRaisesRegex(IcwaferError, "'COPPER'"):
            self.build()
        self.assertEqual(self.made, [])

    def test_without_blender(self) -> None:
        self.blender.unlink()
        with self.assertRaisesRegex(IcwaferError, "scripts/icwafer build blender"):
            self.build()


if __name__ == "__main__":
    unittest.main()
