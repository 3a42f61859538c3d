# SPDX-License-Identifier: GPL-2.0-or-later
"""Debian packages: what is missing, what is said, and what apt is asked for."""

from __future__ import annotations

import os
import unittest

from support import CommandCase

from icwafer import packages
from icwafer.errors import IcwaferError

DPKG = """cat <<'END'
installed cmake
installed g++ c++-compiler, c++abi2-dev
installed zlib1g-dev libz-dev (= 1:1.2), libz-dev:amd64
config-files xvfb
END"""


class MissingTest(CommandCase):
    def setUp(self) -> None:
        super().setUp()
        self.fake_program("dpkg-query", DPKG)

    def test_missing(self) -> None:
        wanted = ["cmake", "c++-compiler", "libz-dev", "ninja-build", "xvfb"]
        self.assertEqual(packages.missing(wanted), ["ninja-build", "xvfb"])

    def test_this_is_not_debian(self) -> None:
        self.fake_program("dpkg-query", "exit 127")
        with self.assertRaisesRegex(IcwaferError, "Debian 12"):
            packages.missing(["cmake"])

    def test_purposes(self) -> None:
        self.assertIn("cmake", packages.needed("base"))
        self.assertNotIn("libopenal-dev", packages.needed("base", "host"))
        self.assertIn("libopenal-dev", packages.needed("full"))
        lists = [package for purpose in packages.PURPOSES.values() for package in purpose]
        self.assertEqual(len(lists), len(set(lists)), "a package stands in two lists")


class InstallTest(CommandCase):
    def setUp(self) -> None:
        super().setUp()
        self.replace(packages, PURPOSES={"base": ("cmake", "xvfb"), "test": ("blender",)})
        self.replace(os, geteuid=lambda: 0)
        self.asked = self.folder / "asked"
        self.fake_program("dpkg-query", DPKG)
        self.fake_program("apt-get", f'echo "$DEBIAN_FRONTEND: $*" >> {self.asked}')

    def asked_for(self) -> list[str]:
        return self.asked.read_text().splitlines() if self.asked.exists() else []

    def test_only_what_is_missing(self) -> None:
        packages.install("base", "test")
        update, install = self.asked_for()
        self.assertTrue(update.endswith(" update"))
        self.assertTrue(install.startswith("noninteractive: "))
        self.assertTrue(install.endswith(" install --no-install-recommends blender xvfb"))

    def test_nothing_is_missing(self) -> None:
        self.replace(packages, PURPOSES={"base": ("cmake",)})
        packages.install("base")
        self.assertEqual(self.asked_for(), [])

    def test_lists_that_cannot_be_renewed_are_not_fatal(self) -> None:
        self.fake_program(
            "apt-get", f'case "$*" in *update) exit 100;; esac; echo x > {self.asked}'
        )
        with self.assertLogs("icwafer.packages", "WARNING"):
            packages.install("test")
        self.assertEqual(self.asked_for(), ["x"])

    def test_apt_fails(self) -> None:
        self.fake_program("apt-get", "echo 'E: Unable to locate package blender'; exit 100")
        with self.assertRaises(IcwaferError) as caught:
            packages.install("test")
        message = str(caught.exception)
        self.assertIn("E: Unable to locate package blender", message)
        self.assertIn("apt-install.log", message)
        self.assertIn("check the network", message)

    def test_a_user_is_asked_through_sudo(self) -> None:
        self.replace(os, geteuid=lambda: 1000)
        self.fake_program("sudo", f'echo "sudo $*" >> {self.asked}')
        packages.install("test")
        self.assertEqual(self.asked_for()[0], "sudo --validate")
        self.assertRegex(
            self.asked_for()[2],
            "^sudo --non-interactive DEBIAN_FRONTEND=noninteractive apt-get .* blender$",
        )

    def test_a_user_without_sudo(self) -> None:
        self.replace(os, geteuid=lambda: 1000)
        self.fake_program("sudo", "exit 1")
        with self.assertRaisesRegex(IcwaferError, "run as root: apt-get install blender$"):
            packages.install("test")
        self.assertEqual(self.asked_for(), [])


if __name__ == "__main__":
    unittest.main()
