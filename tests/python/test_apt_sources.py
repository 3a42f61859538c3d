# SPDX-License-Identifier: GPL-2.0-or-later
"""Debian's mirror as the machine's own apt configuration names it, in both formats."""

from __future__ import annotations

import tempfile
import unittest
from pathlib import Path

from support import write

from icwafer.apt_sources import KEYRING, Origin, configured_files, origins

SUITES = ("bookworm", "stable")


class AptSourcesTest(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def read(self, name: str, text: str) -> list[Origin]:
        return origins([write(self.folder / name, text)], SUITES)

    def test_one_line_format(self) -> None:
        text = (
            "# deb http://comment.example/debian bookworm main\n"
            "deb [ arch=amd64 signed-by=/k.gpg ] https://mirror.example/debian/ bookworm main\n"
            "deb-src https://mirror.example/debian bookworm-updates main\n"
            "deb https://other.example/apt tool-bookworm main\n"
            "deb cdrom: bookworm contrib\n"
        )
        expected = Origin("https://mirror.example/debian", "bookworm", ("signed-by=/k.gpg",))
        self.assertEqual(self.read("sources.list", text), [expected])
        self.assertEqual(
            expected.deb_src_line(),
            "deb-src [signed-by=/k.gpg] https://mirror.example/debian bookworm main",
        )

    def test_one_line_format_without_options(self) -> None:
        found = self.read("sources.list", "deb http://mirror.example/debian stable main contrib\n")
        self.assertEqual(found, [Origin("http://mirror.example/debian", "stable")])
        self.assertEqual(
            found[0].deb_src_line(), "deb-src http://mirror.example/debian stable main"
        )

    def test_stanzas(self) -> None:
        text = (
            "# the mirror of this site\n"
            "Types: deb\nURIs: http://mirror.example/debian\n"
            "Suites: bookworm bookworm-updates\nComponents: main\n contrib\n"
            "Signed-By: /usr/share/keyrings/site.gpg\n"
            "\n"
            "Types: deb\nURIs: http://mirror.example/debian-security\n"
            "Suites: bookworm-security\nComponents: main\n"
            "\n"
            "Enabled: no\nTypes: deb\nURIs: http://off.example/debian\n"
            "Suites: bookworm\nComponents: main\n"
        )
        self.assertEqual(
            self.read("debian.sources", text),
            [
                Origin(
                    "http://mirror.example/debian",
                    "bookworm",
                    ("signed-by=/usr/share/keyrings/site.gpg",),
                )
            ],
        )

    def test_the_same_mirror_twice_counts_once(self) -> None:
        line = "deb http://mirror.example/debian bookworm main\n"
        files = [write(self.folder / name, line) for name in ("a.list", "b.list")]
        self.assertEqual(len(origins(files, SUITES)), 1)

    def test_nothing_suitable_means_debian_itself(self) -> None:
        found = self.read("sources.list", "deb http://mirror.example/ubuntu noble main\n")
        self.assertEqual(found[0].options, (f"signed-by={KEYRING}",))
        self.assertEqual(found[0].suite, "bookworm")

    def test_this_machine(self) -> None:
        files = configured_files()
        self.assertEqual(files[0], Path("/etc/apt/sources.list"))
        self.assertTrue(all(path.suffix in (".list", ".sources") for path in files[1:]))


if __name__ == "__main__":
    unittest.main()
