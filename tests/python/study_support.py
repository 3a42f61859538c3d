# SPDX-License-Identifier: GPL-2.0-or-later
"""What the tests of studies share: a study file, the real command, and a stand-in for Blender."""

from __future__ import annotations

import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path
from typing import Any

from support import REPOSITORY, write

STAND_IN = Path(__file__).resolve().with_name("stand_in_blender.py")

HEAD = 'version = 1\nname = "Test"\n[scene]\npicture = "full"\n'


def axis(name: str, setting: str, values: list[Any]) -> str:
    """The text of an axis."""
    return f'[[axis]]\nname = "{name}"\nset = "{setting}"\nvalues = {json.dumps(values)}\n'


class StudyCase(unittest.TestCase):
    """Every test has an empty folder; its studies are rendered by the stand-in."""

    #: Where the folder is; None for the usual place.
    place: str | None = None

    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory(dir=self.place)
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.environment = {**os.environ, "ICWAFER_BLENDER": str(STAND_IN)}

    def study(self, *parts: str, head: str = HEAD) -> Path:
        return write(self.folder / "study.toml", head + "".join(parts))

    def start(self, study: Path, output: Path, *arguments: str) -> subprocess.Popen[str]:
        command = [REPOSITORY / "scripts" / "icwafer", "render", study, "-o", output, *arguments]
        return subprocess.Popen(
            [str(word) for word in command],
            env=self.environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )

    def render(self, study: Path, output: Path, *arguments: str, status: int = 0) -> str:
        """Renders with the real command; returns what it writes, stdout and stderr."""
        with self.start(study, output, *arguments) as process:
            out, err = process.communicate(timeout=120)
        self.assertEqual(process.returncode, status, out + err)
        return out + err

    def facts(self, output: Path) -> dict[str, dict[str, Any]]:
        """What each finished job says of itself, by its id; what is in the making begins with "."."""
        return {
            path.parent.name: json.loads(path.read_text())
            for path in sorted((output / "jobs").glob("[!.]*/job.json"))
        }


def images(output: Path) -> dict[str, bytes]:
    """All image files below a folder of results, by their paths."""
    return {
        str(path.relative_to(output)): path.read_bytes()
        for path in sorted(output.rglob("*"))
        if path.suffix in (".exr", ".png")
    }


def names(output: Path) -> set[str]:
    """All files below a folder of results."""
    return {str(path.relative_to(output)) for path in output.rglob("*")}
