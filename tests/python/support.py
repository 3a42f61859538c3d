# SPDX-License-Identifier: GPL-2.0-or-later
"""What the tests of the command share: a build folder of their own, and made-up programs."""

from __future__ import annotations

import contextlib
import io
import os
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

REPOSITORY = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(REPOSITORY / "scripts" / "python"), str(REPOSITORY / "plugin")]

from icwafer import cli, paths  # noqa: E402


def write(path: Path, text: str, mode: int = 0o644) -> Path:
    """Writes a file and the folders that it needs."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    path.chmod(mode)
    return path


def blender_tree(root: Path, version: int = 304, patch: int = 1) -> Path:
    """A tree that has nothing of Blender's but the header with its version."""
    write(
        root / "source/blender/blenkernel/BKE_blender_version.h",
        f"#define BLENDER_VERSION {version}\n#define BLENDER_VERSION_PATCH {patch}\n",
    )
    return root


class CommandCase(unittest.TestCase):
    """Every test has an empty folder and builds inside it."""

    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.host = self.folder / "plugin" / "blender-3.4"
        write(self.host / "edits.toml", 'version = "3.4.1"\n')
        build = self.folder / "build"
        self.replace(
            paths,
            BUILD=build,
            LOGS=build / "log",
            HOST=self.host,
            HOST_BINARY=build / "blender",
            INSTALLED=build / "install",
            BLENDER=build / "install" / "blender",
            CYCLES=build / "install" / "cycles",
        )
        self.set_environment(XDG_CACHE_HOME=str(self.folder / "cache"))

    def replace(self, thing: object, **values: object) -> None:
        """Replaces attributes until the test ends."""
        patcher = mock.patch.multiple(thing, **values)
        patcher.start()
        self.addCleanup(patcher.stop)

    def set_environment(self, **values: str) -> None:
        patcher = mock.patch.dict(os.environ, values)
        patcher.start()
        self.addCleanup(patcher.stop)

    def fake_program(self, name: str, script: str) -> None:
        """Puts a shell script before the program of that name."""
        programs = self.folder / "bin"
        write(programs / name, f"#!/bin/sh\n{script}\n", 0o755)
        if not os.environ["PATH"].startswith(str(programs)):
            self.set_environment(PATH=f"{programs}:{os.environ['PATH']}")

    def icwafer(self, *arguments: str) -> tuple[int, str, str]:
        """Runs the command; returns its exit status, stdout and stderr."""
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            status = cli.main(list(arguments))
        return status, out.getvalue(), err.getvalue()

    def expect_error(self, arguments: list[str], status: int, *parts: str) -> None:
        """The command fails with this status and one line that contains all parts."""
        actual, _, err = self.icwafer(*arguments)
        self.assertEqual(actual, status, err)
        self.assertEqual(err.count("\n"), 1, err)
        self.assertTrue(err.startswith("icwafer: "), err)
        for part in parts:
            self.assertIn(part, err)
