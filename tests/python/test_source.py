# SPDX-License-Identifier: GPL-2.0-or-later
"""The host's source tree: from a tree that the user names, and from Debian's package."""

from __future__ import annotations

import hashlib
import os
import resource
import subprocess
import sys
import textwrap
from pathlib import Path
from unittest import main

from support import REPOSITORY, CommandCase, blender_tree, write

from icwafer import apt_sources, paths, source


def digest(path: Path, algorithm: str) -> str:
    return hashlib.new(algorithm, path.read_bytes()).hexdigest()


class TreeTest(CommandCase):
    """A tree that the user names."""

    def setUp(self) -> None:
        super().setUp()
        self.origin = blender_tree(self.folder / "theirs")
        write(self.origin / "COPYING", "free\n")

    def test_it_is_copied_and_edited(self) -> None:
        write(
            self.host / "edits.toml",
            'version = "3.4.1"\n[[edit]]\nfile = "COPYING"\nanchor = "free"\n'
            'place = "after"\ntext = "and edited"\n',
        )
        tree = source.provide(self.origin)
        self.assertEqual(tree, paths.BUILD / "source" / "blender-3.4.1")
        self.assertEqual((tree / "COPYING").read_text(), "free\nand edited\n")
        self.assertEqual((self.origin / "COPYING").read_text(), "free\n")

    def test_what_is_done_is_not_done_again(self) -> None:
        tree = source.provide(self.origin)
        mark = write(tree / "mark", "")
        source.provide(self.origin)
        self.assertTrue(mark.exists())

    def test_another_origin_replaces_the_tree(self) -> None:
        tree = source.provide(self.origin)
        write(tree / "mark", "")
        other = blender_tree(self.folder / "other")
        source.provide(other)
        self.assertFalse((tree / "mark").exists())
        self.assertEqual(
            sorted(p.name for p in tree.parent.iterdir()),
            ["blender-3.4.1", "blender-3.4.1.origin"],
        )

    def test_an_interrupted_copy_is_made_again(self) -> None:
        write(paths.BUILD / "source" / "blender-3.4.1.new" / "half", "")
        tree = source.provide(self.origin)
        self.assertFalse((tree / "half").exists())

    def test_other_version(self) -> None:
        blender_tree(self.origin, 403, 2)
        self.expect_error(["source", "--from", str(self.origin)], 1, "Blender 4.3.2", "for 3.4.1")
        self.assertFalse(paths.host_source().exists())

    def test_not_a_blender_tree(self) -> None:
        empty = self.folder / "empty"
        empty.mkdir()
        self.expect_error(["source", "--from", str(empty)], 1, "not a Blender source tree")

    def test_full_disk(self) -> None:
        """No file may grow beyond 64 KiB: the copy fails as on a full disk, and leaves nothing."""
        (self.origin / "large").write_bytes(bytes(100_000))
        program = (
            "import sys; from pathlib import Path; from icwafer import cli, paths\n"
            "paths.BUILD = Path(sys.argv[1]); paths.HOST = Path(sys.argv[2])\n"
            "sys.exit(cli.main(sys.argv[3:]))"
        )
        done = subprocess.run(
            [
                sys.executable,
                "-B",
                "-c",
                program,
                paths.BUILD,
                self.host,
                "source",
                "--from",
                self.origin,
            ],
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (1 << 16, 1 << 16)),
            capture_output=True,
            text=True,
            env={**os.environ, "PYTHONPATH": str(REPOSITORY / "scripts" / "python")},
        )
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertIn("File too large", done.stderr)
        self.assertEqual(list((paths.BUILD / "source").iterdir()), [])


class PackageTest(CommandCase):
    """Debian's source package, without a network."""

    def package(self, folder: Path) -> None:
        """Makes a source package with a tree of the right version, and its checksums."""
        tree = blender_tree(folder / "blender-3.4.1+dfsg")
        names = ["blender_3.4.1+dfsg.orig.tar.xz", "blender_3.4.1+dfsg-2.debian.tar.xz"]
        write(tree / "debian" / "source" / "format", "3.0 (quilt)\n")
        write(tree / "debian" / "changelog", "")
        tar = ["tar", "-C", str(folder), "-cJf"]
        debian = f"{tree.name}/debian"
        subprocess.run([*tar, folder / names[0], "--exclude", debian, tree.name], check=True)
        subprocess.run(["tar", "-C", tree, "-cJf", folder / names[1], "debian"], check=True)
        text = "Format: 3.0 (quilt)\nSource: blender\nVersion: 3.4.1+dfsg-2\n"
        for title, algorithm in (("Checksums-Sha256", "sha256"), ("Files", "md5")):
            text += f"{title}:\n"
            for name in names:
                size = (folder / name).stat().st_size
                text += f" {digest(folder / name, algorithm)} {size} {name}\n"
        dsc = write(folder / "blender_3.4.1+dfsg-2.dsc", text)
        self.names = [*names, dsc.name]
        lines = [f"{digest(folder / name, 'sha256')}  {name}\n" for name in self.names]
        write(folder / source.SUMS, "".join(lines))

    def test_it_is_unpacked_from_the_cache(self) -> None:
        self.package(paths.cache_folder() / "source")
        tree = source.provide()
        self.assertEqual(source.host_edits.tree_version(tree), "3.4.1")
        self.assertTrue((tree / "debian").is_dir())

    def test_a_damaged_download_is_refused(self) -> None:
        cache = paths.cache_folder() / "source"
        self.package(cache)
        with (cache / self.names[0]).open("ab") as file:
            file.write(b"x")
        self.expect_error(["source"], 1, self.names[0], "run the same command again")
        self.assertFalse((cache / self.names[0]).exists())
        self.assertFalse(paths.host_source().exists())

    def test_a_missing_download_is_noticed(self) -> None:
        cache = paths.cache_folder() / "source"
        self.package(cache)
        (cache / self.names[2]).unlink()
        self.expect_error(["source"], 1, self.names[2], "run the same command again")

    def test_no_network(self) -> None:
        nowhere = write(
            self.folder / "sources.list", "deb http://127.0.0.1:9/debian bookworm main\n"
        )
        self.replace(apt_sources, configured_files=lambda: [nowhere])
        self.expect_error(["source"], 1, "127.0.0.1", "check the network")
        self.assertFalse(paths.host_source().exists())

    def test_the_index(self) -> None:
        records = textwrap.dedent(
            """
            Package: blender
            Version: 2.83.5+dfsg-5
            Checksums-Sha256:
             aaaa 10 blender_2.83.5+dfsg-5.dsc

            Package: blender
            Version: 3.4.1+dfsg-2
            Files:
             0000 10 blender_3.4.1+dfsg-2.dsc
            Checksums-Sha256:
             bbbb 10 blender_3.4.1+dfsg-2.dsc
             cccc 20 blender_3.4.1+dfsg.orig.tar.xz
            Homepage: https://www.blender.org
            """
        )
        self.assertEqual(
            source.newest_record(records, "3.4.1"),
            (
                "3.4.1+dfsg-2",
                {"blender_3.4.1+dfsg-2.dsc": "bbbb", "blender_3.4.1+dfsg.orig.tar.xz": "cccc"},
            ),
        )
        self.assertEqual(source.newest_record(records, "3.4"), ("", {}))


if __name__ == "__main__":
    main()
