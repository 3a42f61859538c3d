# SPDX-License-Identifier: GPL-2.0-or-later
"""The build's decisions: options, space, and the order of the steps."""

from __future__ import annotations

import os
import subprocess
import sys
import unittest
from collections import namedtuple
from pathlib import Path

from support import CommandCase, blender_tree, write

from icwafer import build, packages, paths
from icwafer.assets import command as assets_command
from icwafer.errors import IcwaferError

Usage = namedtuple("Usage", "total used free")


class DefinitionsTest(CommandCase):
    def test_known_options(self) -> None:
        words = ["ICWAFER_FULL=ON", f"ICWAFER_BLENDER_SOURCE={self.folder}/plugin/.."]
        self.assertEqual(
            build.definitions(words),
            {"ICWAFER_FULL": "ON", "ICWAFER_BLENDER_SOURCE": str(self.folder.resolve())},
        )

    def test_a_source_can_be_given_back(self) -> None:
        self.assertEqual(
            build.definitions(["ICWAFER_BLENDER_SOURCE="]), {"ICWAFER_BLENDER_SOURCE": ""}
        )

    def test_bad_options(self) -> None:
        for word, part in {
            "ICWAFER_FUL=ON": "unknown option -DICWAFER_FUL=ON",
            "ICWAFER_FULL": "unknown option -DICWAFER_FULL",
            "ICWAFER_BLENDER_SOURCE=/no/such": "/no/such: no such folder",
        }.items():
            with self.assertRaisesRegex(IcwaferError, part):
                build.definitions([word])

    def test_the_last_build_decides_what_is_not_said(self) -> None:
        self.assertFalse(build.is_full({}))
        write(paths.BUILD / "host" / "CMakeCache.txt", "ICWAFER_FULL:BOOL=on\n")
        self.assertTrue(build.is_full({}))
        self.assertFalse(build.is_full({"ICWAFER_FULL": "OFF"}))


class BuildTest(CommandCase):
    """Builds with a cmake made up for the test, and with all packages there."""

    def setUp(self) -> None:
        super().setUp()
        self.replace(packages, missing=lambda names: [])
        self.asked = self.folder / "asked"
        self.fake_program("cmake", f'echo "$*" >> {self.asked}')
        self.tree = blender_tree(self.folder / "theirs")

    def steps(self) -> list[str]:
        return self.asked.read_text().splitlines() if self.asked.exists() else []

    def test_core_is_configured_and_built(self) -> None:
        status, out, err = self.icwafer("build", "core")
        self.assertEqual((status, err), (0, ""))
        self.assertIn("--preset core", self.steps()[0])
        self.assertEqual(self.steps()[1], f"--build {paths.BUILD}/core")
        self.assertRegex(out, r"Building core: done in \d")

    def test_blender_is_configured_built_and_installed(self) -> None:
        self.replace(paths, REPOSITORY=self.folder)
        # After all steps the asset library follows.
        steps_before_library: list[list[str]] = []
        self.replace(
            assets_command,
            build_library=lambda: steps_before_library.append(self.steps()),
        )
        status, _, err = self.icwafer("build", f"-DICWAFER_BLENDER_SOURCE={self.tree}")
        self.assertEqual((status, err), (0, ""))
        self.assertEqual(steps_before_library, [self.steps()])
        configure, compile_host, install = self.steps()
        self.assertIn(f"-DICWAFER_BLENDER_SOURCE={self.tree.resolve()}", configure)
        self.assertEqual(compile_host, f"--build {paths.BUILD}/host")
        self.assertEqual(install, f"--install {paths.BUILD}/host")
        self.assertTrue(paths.host_source().is_dir())

    def test_a_failed_step_is_the_last(self) -> None:
        self.fake_program(
            "cmake",
            f'echo "$*" >> {self.asked}\n'
            'case "$*" in *--build*) echo "x.cc:1: error: bad"; exit 1; esac',
        )
        source = f"-DICWAFER_BLENDER_SOURCE={self.tree}"
        self.expect_error(
            ["build", "cycles", source],
            1,
            "x.cc:1: error: bad",
            "cycles-build.log",
            "same command",
        )
        self.assertEqual(len(self.steps()), 2)

    def test_other_blender(self) -> None:
        blender_tree(self.tree, 306, 0)
        source = f"-DICWAFER_BLENDER_SOURCE={self.tree}"
        self.expect_error(["build", "blender", source], 1, "Blender 3.6.0", "for 3.4.1")
        self.assertEqual(self.steps(), [])

    def test_too_little_space(self) -> None:
        self.replace(build.shutil, disk_usage=lambda path: Usage(10**9, 9 * 10**8, 10**8))
        for target in build.TARGETS:
            self.expect_error(["build", target], 1, "0.1 GB free", "make room")
        self.assertEqual(self.steps(), [])

    def test_little_memory_means_fewer_compilers(self) -> None:
        pages = {"SC_PAGE_SIZE": 4096, "SC_PHYS_PAGES": 10**6}  # 4.1 GB
        self.replace(build.os, sysconf=pages.__getitem__, cpu_count=lambda: 16)
        self.assertEqual(build._parallel(full=False), {"CMAKE_BUILD_PARALLEL_LEVEL": "4"})
        self.assertEqual(build._parallel(full=True), {"CMAKE_BUILD_PARALLEL_LEVEL": "1"})
        self.replace(build.os, cpu_count=lambda: 2)
        self.assertEqual(build._parallel(full=False), {})


class CommandLineTest(CommandCase):
    def test_wrong_command_lines(self) -> None:
        for arguments, part in (
            ([], "COMMAND"),
            (["bild"], "'bild'"),
            (["build", "blendr"], "'blendr'"),
            (["build", "--fast"], "--fast"),
            (["doctor", "all"], "all"),
        ):
            self.expect_error(arguments, 2, part, "--help")

    def test_a_bare_machine(self) -> None:
        """The command starts without any package, or it could not install them."""
        done = subprocess.run(
            [sys.executable, "-S", "-B", "-m", "icwafer", "--help"],  # -S: without Debian's
            env={"PYTHONPATH": str(paths.REPOSITORY / "scripts" / "python")},
            capture_output=True,
            text=True,
        )
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_who_reads_has_seen_enough(self) -> None:
        reading, writing = os.pipe()
        os.close(reading)
        done = subprocess.run(
            [sys.executable, "-B", "-m", "icwafer", "--help"],
            env={"PYTHONPATH": str(paths.REPOSITORY / "scripts" / "python")},
            stdout=writing,
            stderr=subprocess.PIPE,
            text=True,
        )
        os.close(writing)
        self.assertEqual((done.returncode, done.stderr), (141, ""))

    def test_unknown_definition(self) -> None:
        self.expect_error(["demo", "-DWITH_CYCLES=OFF"], 1, "unknown option -DWITH_CYCLES=OFF")

    def test_blender_is_not_built(self) -> None:
        self.expect_error(["blender", "-b"], 1, "not built yet", "scripts/icwafer build blender")

    def test_a_full_disk_anywhere(self) -> None:
        def full(*_: object) -> None:
            raise OSError(28, "No space left on device", str(self.folder / "x"))

        self.replace(build, build=full)
        self.expect_error(["build", "core"], 1, f"{self.folder}/x: No space left", "make room")

    def test_arguments_of_test_go_to_ctest(self) -> None:
        self.replace(build, build=lambda target: None)
        self.replace(assets_command, build_library=list)
        self.replace(packages, missing=lambda names: [])
        asked = self.folder / "asked"
        self.fake_program("ctest", f'echo "$*" > {asked}; exit 8')
        self.assertEqual(self.icwafer("test", "-R", "grating", "-D", "x")[0], 8)
        self.assertEqual(asked.read_text(), "--preset core -R grating -D x\n")


class BootstrapTest(unittest.TestCase):
    def test_ci_runs_the_tests_and_nothing_else(self) -> None:
        ci = Path(__file__).resolve().parents[2] / ".ci" / "run"
        self.assertTrue(ci.read_text().rstrip().endswith('/../scripts/icwafer" test'))


if __name__ == "__main__":
    unittest.main()
