# SPDX-License-Identifier: GPL-2.0-or-later
"""What `cmake --install` puts into Blender's folder of the project's own, and what it removes."""

from __future__ import annotations

import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
ADDON, MODULES = Path("3.4/scripts/addons/ic_wafer"), Path("3.4/scripts/modules/icwafer")
LIBRARY = Path("3.4/datafiles/icwafer")


def run(*command: str | Path) -> None:
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode:
        raise AssertionError(f"{command}: {done.stdout}{done.stderr}")


class Install(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        holder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(holder.cleanup)
        cls.build, cls.installed = Path(holder.name, "build"), Path(holder.name, "with space")
        run("cmake", "-G", "Ninja", "-S", ROOT, "-B", cls.build, "-DICWAFER_BUILD=blender")
        cls.install()
        cls.first = cls.files()

    @classmethod
    def install(cls) -> None:
        run("cmake", "--install", cls.build, "--component", "addon", "--prefix", cls.installed)

    @classmethod
    def files(cls) -> set[Path]:
        return {
            path.relative_to(cls.installed)
            for path in cls.installed.rglob("*")
            if not path.is_dir() or not any(path.iterdir())
        }

    def test_add_on_package_and_sources_of_the_library(self) -> None:
        addon = {ADDON / path.name for path in (ROOT / "plugin/addon").glob("*.py")}
        self.assertEqual({path for path in self.first if path.is_relative_to(ADDON)}, addon)
        sources = {LIBRARY / path.name for path in (ROOT / "blend_assets/library").iterdir()}
        self.assertLessEqual(sources, self.first)
        self.assertIn(MODULES / "scene/mesh.py", self.first)
        for path in self.first:
            if path.is_relative_to(MODULES):
                source = ROOT / "scripts/python/icwafer" / path.relative_to(MODULES)
                self.assertEqual((self.installed / path).read_bytes(), source.read_bytes())

    def test_what_is_no_longer_there_is_removed_from_own_folders_only(self) -> None:
        gone = (ADDON / "gone.py", MODULES / "gone/__init__.py", LIBRARY / "gone.blend")
        kept = {Path("3.4/scripts/addons/other.py"), Path("3.4/scripts/modules/kept/kept.py")}
        for path in (*gone, *kept):
            (self.installed / path).parent.mkdir(parents=True, exist_ok=True)
            (self.installed / path).touch()
        self.install()
        self.assertEqual(self.files(), self.first | kept)


if __name__ == "__main__":
    unittest.main()
