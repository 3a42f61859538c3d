# SPDX-License-Identifier: GPL-2.0-or-later
"""The doctor: every failure is found and comes with what mends it."""

from __future__ import annotations

import os
import platform
import unittest

from support import CommandCase, blender_tree, write

from icwafer import build, cli, doctor, packages, paths
from icwafer.errors import IcwaferError
from icwafer.source import host_edits


class DoctorTest(CommandCase):
    def expect(self, finding: doctor.Finding, text: str, mend: str) -> None:
        """The finding contains `text`; it advises `mend`, or is well if that is empty."""
        self.assertIn(text, finding.text)
        self.assertTrue(finding.mend.startswith(mend) if mend else not finding.mend, finding)

    def test_system(self) -> None:
        self.replace(platform, freedesktop_os_release=lambda: {"ID": "debian", "VERSION_ID": "13"})
        self.expect(doctor.check_system(), "Python", "use a Debian 12")
        self.replace(platform, freedesktop_os_release=lambda: {"ID": "debian", "VERSION_ID": "12"})
        self.expect(doctor.check_system(), "Python", "")

    def test_packages(self) -> None:
        self.replace(
            packages, PURPOSES={"test": ("cmake", "xvfb")}, missing=lambda names: ["xvfb"]
        )
        self.expect(
            doctor.check_packages("packages", "test"),
            "1 Debian packages are missing",
            "run as root: apt-get install --no-install-recommends xvfb",
        )
        self.replace(packages, missing=lambda names: [])
        self.expect(doctor.check_packages("packages", "test"), "all 2", "")

    def test_space(self) -> None:
        self.replace(build, free_gb=lambda folder: 1.5)
        self.expect(doctor.check_space(), "free", "make room")
        write(paths.BLENDER, "")
        self.expect(doctor.check_space(), "free", "")

    def test_edits(self) -> None:
        tree = paths.host_source()
        write(
            self.host / "edits.toml",
            'version = "3.4.1"\n[[edit]]\nfile = "COPYING"\nanchor = "free"\n'
            'place = "after"\ntext = "edited"\n',
        )

        def check() -> doctor.Finding:
            return doctor.check_edits(tree, self.host, self.folder)

        again = "run scripts/icwafer build blender"
        self.expect(check(), "is not there yet", again)
        blender_tree(tree)
        write(tree / "COPYING", "free\n")
        self.expect(check(), "not applied", again)
        host_edits.apply(tree, self.host, self.folder)
        self.expect(check(), "applied", "")
        write(tree / "COPYING", "somebody was here\n")
        self.expect(check(), "COPYING: changed", f"remove {tree}")

    def test_half_built(self) -> None:
        built = paths.HOST_BINARY / "bin" / "blender"

        def check() -> doctor.Finding:
            return doctor.check_program("Blender", built, paths.BLENDER, "blender")

        again = "run scripts/icwafer build blender"
        self.expect(check(), "not built yet", again)
        write(paths.HOST_BINARY / "build.ninja", "")
        self.expect(check(), "half built", again)
        write(built, "")
        self.expect(check(), "not installed", again)
        write(paths.BLENDER, "")
        self.expect(check(), str(paths.BLENDER), "")
        os.utime(paths.BLENDER, (1, 1))
        self.expect(check(), "older than the build", again)

    def test_core(self) -> None:
        self.expect(doctor.check_core(), "not built", "run scripts/icwafer build core")
        write(paths.BUILD / "core" / "tests" / "shaders" / "test_grating", "")
        self.expect(doctor.check_core(), "built", "")

    def test_start(self) -> None:
        self.expect(doctor.check_start(), "No such file", "run scripts/icwafer build blender")
        write(paths.BLENDER, "#!/bin/sh\necho 'AttributeError: no node' >&2; exit 1\n", 0o755)
        self.expect(doctor.check_start(), "AttributeError: no node", "run scripts/icwafer")
        write(paths.BLENDER, "#!/bin/sh\nexit 139\n", 0o755)
        self.expect(doctor.check_start(), "exit status 139", "run scripts/icwafer")
        write(paths.BLENDER, "#!/bin/sh\nexit 0\n", 0o755)
        self.expect(doctor.check_start(), "has the node and the add-on", "")

    def test_a_check_that_cannot_be_made_is_a_failure(self) -> None:
        def check() -> doctor.Finding:
            raise IcwaferError("dpkg-query does not work here")

        self.expect(doctor.examine(check), "dpkg-query", "mend this")

    def test_the_command_fails_unless_all_is_well(self) -> None:
        well = doctor.Finding("disk", "9 GB free")
        ill = doctor.Finding("core", "not built yet", "run scripts/icwafer build core")
        self.replace(cli.doctor, checks=lambda: [lambda: well, lambda: ill])
        status, out, err = self.icwafer("doctor")
        self.assertEqual((status, err), (1, ""))
        self.assertEqual(
            out,
            "ok    disk: 9 GB free\n"
            "FAIL  core: not built yet; run scripts/icwafer build core\n",
        )
        self.replace(cli.doctor, checks=lambda: [lambda: well])
        self.assertEqual(self.icwafer("doctor")[0], 0)


if __name__ == "__main__":
    unittest.main()
