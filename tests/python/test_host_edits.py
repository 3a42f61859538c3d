# SPDX-License-Identifier: GPL-2.0-or-later
"""The edits of a host's tree, on a small tree made up for each test."""

from __future__ import annotations

import contextlib
import io
import os
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

REPOSITORY = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(REPOSITORY / "plugin"))

import host_edits  # noqa: E402
from host_edits import HostEditError, State  # noqa: E402

NODE_HEADER = "source/blender/blenkernel/BKE_node.h"
TYPES = "intern/cycles/kernel/svm/types.h"
EDITS = f"""
version = "3.4.1"

[[add]]
from = "shaders/icwafer"
to = "intern/cycles/kernel/icwafer"

[[add]]
from = "plugin/blender-3.4/node.cc"
to = "source/blender/nodes/node.cc"

[[edit]]
file = "{NODE_HEADER}"
anchor = "#define NODE_B 2"
place = "after"
text = \"\"\"
#define NODE_WAFER 3
\"\"\"

[[edit]]
file = "{NODE_HEADER}"
anchor = "#define NODE_A 1"
place = "before"
text = "/* Nodes. */"

[[edit]]
file = "{TYPES}"
anchor = \"\"\"
  B,
  C,
\"\"\"
place = "replace"
text = \"\"\"
  B,
  WAFER,
  C,
\"\"\"
"""


def snapshot(tree: Path) -> dict[str, bytes | None]:
    """Every file's bytes and every folder (None) below a tree, by relative path."""
    return {
        str(path.relative_to(tree)): path.read_bytes() if path.is_file() else None
        for path in sorted(tree.rglob("*"))
    }


class HostEditsTest(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.repository = Path(folder.name, "repository")
        self.host = self.repository / "plugin" / "blender-3.4"
        self.tree = Path(folder.name, "blender")
        self.write(
            self.tree / host_edits.VERSION_HEADER,
            "#define BLENDER_VERSION 304\n#define BLENDER_VERSION_PATCH 1\n",
        )
        self.write(self.tree / NODE_HEADER, "#define NODE_A 1\n#define NODE_B 2\n#define END\n")
        self.write(self.tree / TYPES, "enum {\n  A,\n  B,\n  C,\n};")
        self.write(self.repository / "shaders/icwafer/grating.h", "// grating\n")
        self.write(self.repository / "shaders/icwafer/film/stack.h", "// film\n")
        self.write(self.repository / "shaders/icwafer/notes.txt", "not a header\n")
        self.write(self.host / "node.cc", "// node\n")
        self.write_edits(EDITS)
        self.pristine = snapshot(self.tree)

    @staticmethod
    def write(path: Path, text: str) -> None:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def write_edits(self, text: str) -> None:
        self.write(self.host / "edits.toml", text)

    def edit(self, anchor: str, place: str = "after", file: str = NODE_HEADER) -> None:
        """Appends one more edit to the edits."""
        text = f'\n[[edit]]\nfile = "{file}"\nanchor = "{anchor}"\nplace = "{place}"\ntext = "x"\n'
        self.write_edits((self.host / "edits.toml").read_text() + text)

    def apply(self) -> list[str]:
        return host_edits.apply(self.tree, self.host, self.repository)

    def verify(self) -> State:
        return host_edits.verify(self.tree, self.host, self.repository)

    def expect_refusal(self, *parts: str) -> None:
        """Apply fails in one line with these parts, and the tree stays as it is."""
        before = snapshot(self.tree)
        with self.assertRaises(HostEditError) as caught:
            self.apply()
        message = str(caught.exception)
        self.assertNotIn("\n", message)
        for part in parts:
            self.assertIn(part, message)
        self.assertEqual(snapshot(self.tree), before)


class ApplyTest(HostEditsTest):
    def test_edits_stand_where_they_belong(self) -> None:
        changed = self.apply()
        self.assertEqual(
            (self.tree / NODE_HEADER).read_text(),
            "/* Nodes. */\n#define NODE_A 1\n#define NODE_B 2\n"
            "#define NODE_WAFER 3\n#define END\n",
        )
        self.assertEqual((self.tree / TYPES).read_text(), "enum {\n  A,\n  B,\n  WAFER,\n  C,\n};")
        kernel = self.tree / "intern/cycles/kernel/icwafer"
        self.assertEqual((kernel / "grating.h").read_text(), "// grating\n")
        self.assertEqual((kernel / "film/stack.h").read_text(), "// film\n")
        self.assertFalse((kernel / "notes.txt").exists())
        self.assertEqual((self.tree / "source/blender/nodes/node.cc").read_text(), "// node\n")
        self.assertEqual(len(changed), 5)

    def test_after_the_last_line_without_newline(self) -> None:
        self.edit("};", "after", TYPES)
        self.apply()
        self.assertTrue((self.tree / TYPES).read_text().endswith("\n};\nx\n"))

    def test_replacing_a_part_of_a_line(self) -> None:
        self.edit("END", "replace")
        self.apply()
        self.assertIn("#define x\n", (self.tree / NODE_HEADER).read_text())

    def test_an_edit_that_a_tree_does_not_need(self) -> None:
        edit = f'\n[[edit]]\nfile = "{TYPES}"\nanchor = "LEGACY"\nplace = "replace"\ntext = "x"\n'
        self.write_edits(EDITS + edit + 'unless = "  A,"\n')
        self.apply()
        self.assertNotIn("x", (self.tree / TYPES).read_text())
        self.write_edits(EDITS + edit + 'unless = "not there"\n')
        self.expect_refusal(TYPES, "LEGACY", "0 times")

    def test_edits_at_one_place_keep_their_order(self) -> None:
        for letter in "PQ":
            self.write_edits(
                (self.host / "edits.toml").read_text()
                + f'\n[[edit]]\nfile = "{TYPES}"\nanchor = "  A,"\n'
                + f'place = "after"\ntext = "{letter}"\n'
            )
        self.apply()
        self.assertIn("  A,\nP\nQ\n  B,\n", (self.tree / TYPES).read_text())

    def test_twice_is_the_same_as_once(self) -> None:
        self.apply()
        before = snapshot(self.tree)
        times = {path: path.stat().st_mtime_ns for path in self.tree.rglob("*") if path.is_file()}
        self.assertEqual(self.apply(), [])
        self.assertEqual(snapshot(self.tree), before)
        self.assertEqual({path: path.stat().st_mtime_ns for path in times}, times)

    def test_a_touched_header_is_the_only_file_brought_up_to_date(self) -> None:
        self.apply()
        others = [path for path in self.tree.rglob("*.h") if path.name != "grating.h"]
        times = [path.stat().st_mtime_ns for path in others]
        self.write(self.repository / "shaders/icwafer/grating.h", "// better grating\n")
        self.assertEqual(self.verify(), State.OUTDATED)
        self.assertEqual(self.apply(), ["intern/cycles/kernel/icwafer/grating.h"])
        self.assertEqual([path.stat().st_mtime_ns for path in others], times)
        self.assertEqual(self.verify(), State.CURRENT)

    def test_a_dropped_header_and_a_dropped_edit_leave_the_tree(self) -> None:
        self.apply()
        shutil.rmtree(self.repository / "shaders/icwafer/film")
        self.write_edits(EDITS[: EDITS.rindex("[[edit]]")])
        self.apply()
        self.assertFalse((self.tree / "intern/cycles/kernel/icwafer/film").exists())
        self.assertEqual((self.tree / TYPES).read_bytes(), self.pristine[TYPES])
        host_edits.revert(self.tree)
        self.assertEqual(snapshot(self.tree), self.pristine)

    def test_changed_edits_start_from_the_unedited_file(self) -> None:
        self.apply()
        self.write_edits(EDITS.replace("NODE_WAFER 3", "NODE_WAFER 4"))
        self.assertEqual(self.apply(), [NODE_HEADER])
        self.assertNotIn("NODE_WAFER 3", (self.tree / NODE_HEADER).read_text())

    def test_permissions_are_kept(self) -> None:
        (self.tree / TYPES).chmod(0o750)
        self.apply()
        self.assertEqual((self.tree / TYPES).stat().st_mode & 0o777, 0o750)


class OtherFilesTest(HostEditsTest):
    def test_files_of_a_folder_by_their_ending(self) -> None:
        self.write_edits(
            EDITS + '[[add]]\nfrom = "shaders"\nto = "docs"\nfiles = "*.txt"\n'
        )
        self.apply()
        self.assertEqual(
            [path.relative_to(self.tree).as_posix() for path in self.tree.rglob("docs/**/*.*")],
            ["docs/icwafer/notes.txt"],
        )

    def test_a_folder_without_them(self) -> None:
        self.write_edits(
            EDITS + '[[add]]\nfrom = "shaders"\nto = "docs"\nfiles = "*.jpg"\n'
        )
        self.expect_refusal("'shaders' is neither a file nor a folder with *.jpg")


class RefusalTest(HostEditsTest):
    def test_anchor_not_found(self) -> None:
        self.edit("#define NODE_Z 9")
        self.expect_refusal(NODE_HEADER, "'#define NODE_Z 9'", "found 0 times")

    def test_anchor_found_twice(self) -> None:
        self.edit("#define NODE_")
        self.expect_refusal(NODE_HEADER, "'#define NODE_'", "found 2 times")

    def test_file_not_found(self) -> None:
        self.edit("anything", file="source/no_such_file.h")
        self.expect_refusal("source/no_such_file.h", "'anything'", "found 0 times")

    def test_overlapping_edits(self) -> None:
        self.edit("NODE_B 2\\n#define END", "replace")
        self.expect_refusal(NODE_HEADER, "overlaps")

    def test_other_version(self) -> None:
        self.write(
            self.tree / host_edits.VERSION_HEADER,
            "#define BLENDER_VERSION 403\n#define BLENDER_VERSION_PATCH 2\n",
        )
        self.expect_refusal("Blender 4.3.2", "for 3.4.1")

    def test_not_a_blender_tree(self) -> None:
        (self.tree / host_edits.VERSION_HEADER).unlink()
        self.expect_refusal(str(self.tree), "not a Blender source tree")

    def test_version_header_without_version(self) -> None:
        self.write(self.tree / host_edits.VERSION_HEADER, "// nothing\n")
        self.expect_refusal(host_edits.VERSION_HEADER, "no Blender version")

    def test_edited_file_changed_by_somebody(self) -> None:
        self.apply()
        self.write(self.tree / NODE_HEADER, "somebody was here\n")
        self.expect_refusal(NODE_HEADER, "changed")
        for action in (self.verify, lambda: host_edits.revert(self.tree)):
            with self.assertRaisesRegex(HostEditError, f"{NODE_HEADER}: changed"):
                action()

    def test_added_file_changed_by_somebody(self) -> None:
        self.apply()
        self.write(self.tree / "source/blender/nodes/node.cc", "somebody was here\n")
        self.expect_refusal("source/blender/nodes/node.cc", "changed")

    def test_edited_file_removed_by_somebody(self) -> None:
        self.apply()
        (self.tree / TYPES).unlink()
        self.expect_refusal(TYPES, "changed")

    def test_host_has_a_file_of_that_name(self) -> None:
        self.write(self.tree / "source/blender/nodes/node.cc", "theirs\n")
        self.expect_refusal("source/blender/nodes/node.cc", "already")

    def test_lost_original(self) -> None:
        self.apply()
        (self.tree / host_edits.STATE_FOLDER / "originals" / TYPES).unlink()
        self.expect_refusal(TYPES, "lost or damaged")

    def test_damaged_manifest(self) -> None:
        self.apply()
        self.write(self.tree / host_edits.STATE_FOLDER / "manifest.json", '{"files"')
        self.expect_refusal("manifest.json", "damaged")

    def test_edits_that_make_no_sense(self) -> None:
        cases = {
            EDITS + "[[edit": "edits.toml",
            EDITS.replace('version = "3.4.1"', ""): "'version' is missing",
            EDITS.replace('version = "3.4.1"', "version = 3.4"): "'version' must be a string",
            EDITS.replace('place = "before"', 'place = "above"'): "place 'above'",
            EDITS.replace('place = "before"', ""): "'place' is missing",
            EDITS + "\nwhere = 1": "unknown key 'where'",
            EDITS.replace('anchor = "#define NODE_A 1"', 'anchor = ""'): "anchor is empty",
            EDITS.replace(NODE_HEADER, "../outside.h"): "'../outside.h'",
            EDITS.replace(NODE_HEADER, "/etc/passwd"): "'/etc/passwd'",
            EDITS.replace("shaders/icwafer", "shaders/nothing"): "'shaders/nothing'",
            EDITS.replace(NODE_HEADER, "source/blender/nodes/node.cc"): "both added and edited",
        }
        for text, part in cases.items():
            with self.subTest(part):
                self.write_edits(text)
                self.expect_refusal(part)

    def test_no_edits(self) -> None:
        (self.host / "edits.toml").unlink()
        self.expect_refusal("edits.toml", "not found")


class RevertTest(HostEditsTest):
    def test_restores_every_byte_and_folder(self) -> None:
        (self.tree / "intern/cycles/empty").mkdir()
        self.pristine = snapshot(self.tree)
        self.apply()
        self.assertEqual(len(host_edits.revert(self.tree)), 5)
        self.assertEqual(snapshot(self.tree), self.pristine)

    def test_reverting_an_unedited_tree_does_nothing(self) -> None:
        self.assertEqual(host_edits.revert(self.tree), [])
        self.assertEqual(snapshot(self.tree), self.pristine)

    def test_keeps_files_that_are_not_ours(self) -> None:
        self.apply()
        theirs = self.tree / "intern/cycles/kernel/icwafer/theirs.txt"
        self.write(theirs, "theirs\n")
        host_edits.revert(self.tree)
        self.assertEqual(theirs.read_text(), "theirs\n")

    def test_apply_after_revert(self) -> None:
        self.apply()
        edited = snapshot(self.tree)
        host_edits.revert(self.tree)
        self.apply()
        self.assertEqual(snapshot(self.tree), edited)


class VerifyTest(HostEditsTest):
    def test_states(self) -> None:
        self.assertEqual(self.verify(), State.ABSENT)
        self.apply()
        self.assertEqual(self.verify(), State.CURRENT)
        host_edits.revert(self.tree)
        self.assertEqual(self.verify(), State.ABSENT)

    def test_checks_the_anchors_of_an_unedited_tree(self) -> None:
        self.edit("#define NODE_Z 9")
        with self.assertRaisesRegex(HostEditError, "found 0 times"):
            self.verify()

    def test_a_file_put_back_by_hand_is_out_of_date(self) -> None:
        self.apply()
        (self.tree / TYPES).write_bytes(self.pristine[TYPES] or b"")
        self.assertEqual(self.verify(), State.OUTDATED)
        self.apply()
        self.assertEqual(self.verify(), State.CURRENT)


class InterruptionTest(HostEditsTest):
    def break_at_each_rename(self, action: str) -> None:
        """Runs an action with an interruption at its first rename, at its second, and so on."""
        before = snapshot(self.tree)
        real = Path.replace
        for survived in range(50):
            calls = 0

            def replace(path: Path, target: Path) -> Path:
                nonlocal calls
                calls += 1
                if calls == survived + 1:
                    raise KeyboardInterrupt
                return real(path, target)

            with mock.patch.object(Path, "replace", replace):
                try:
                    self.apply() if action == "apply" else host_edits.revert(self.tree)
                except KeyboardInterrupt:
                    self.assertEqual(snapshot(self.tree), before)
                else:
                    self.assertGreater(survived, 3)
                    return
        self.fail("never finished")

    def test_apply(self) -> None:
        self.break_at_each_rename("apply")
        self.assertEqual(self.verify(), State.CURRENT)

    def test_renewed_apply(self) -> None:
        self.apply()
        self.write(self.repository / "shaders/icwafer/grating.h", "// better grating\n")
        self.write_edits(EDITS.replace("NODE_WAFER 3", "NODE_WAFER 4"))
        self.break_at_each_rename("apply")
        self.assertEqual(self.verify(), State.CURRENT)

    def test_revert(self) -> None:
        self.apply()
        self.break_at_each_rename("revert")
        self.assertEqual(snapshot(self.tree), self.pristine)

    def test_killed_half_way(self) -> None:
        """A process that dies without cleaning up: the next apply or revert mends the tree."""
        program = (
            "import os, sys; from pathlib import Path; sys.path.insert(0, sys.argv[1])\n"
            "import host_edits; real = Path.replace; left = [int(sys.argv[5])]\n"
            "def replace(path, target):\n"
            "    left[0] -= 1\n"
            "    return os.kill(os.getpid(), 9) if left[0] < 0 else real(path, target)\n"
            "Path.replace = replace\n"
            "host_edits.apply(Path(sys.argv[2]), Path(sys.argv[3]), Path(sys.argv[4]))\n"
        )
        for survived in range(9):  # two originals, two manifests, five files
            with self.subTest(survived=survived):
                arguments = [
                    REPOSITORY / "plugin",
                    self.tree,
                    self.host,
                    self.repository,
                    survived,
                ]
                done = subprocess.run([sys.executable, "-c", program, *map(str, arguments)])
                self.assertEqual(done.returncode, -signal.SIGKILL)
                host_edits.revert(self.tree)
                self.assertEqual(snapshot(self.tree), self.pristine)


class CommandTest(HostEditsTest):
    def run_command(self, *arguments: str) -> tuple[int, str, str]:
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            status = host_edits.main(list(arguments))
        return status, out.getvalue(), err.getvalue()

    def test_one_line_and_a_status_for_bad_input(self) -> None:
        status, out, err = self.run_command("apply", "--tree", str(self.tree / "nowhere"))
        self.assertEqual((status, out, err.count("\n")), (1, "", 1))
        self.assertIn("not a Blender source tree", err)

    def test_out_of_date_is_a_failure(self) -> None:
        self.write_edits(EDITS[: EDITS.index("[[add]]")] + EDITS[EDITS.index("[[edit]]") :])
        command = ["--tree", str(self.tree), "--host", str(self.host)]
        self.assertEqual(self.run_command("apply", *command)[0], 0)
        self.assertEqual(self.run_command("verify", *command)[0], 0)
        self.edit("#define END")
        status, _, err = self.run_command("verify", *command)
        self.assertEqual(status, 1)
        self.assertIn("run 'apply' again", err)

    def test_full_disk(self) -> None:
        """No file may grow beyond 4 KiB, and one of ours is larger: as on a full disk."""
        self.write(self.host / "node.cc", "// large\n" * 1000)
        self.write_edits(EDITS[: EDITS.index("[[add]]")] + EDITS[EDITS.index("[[edit]]") :])
        self.write(
            self.tree / NODE_HEADER, (self.tree / NODE_HEADER).read_text() + "/**/\n" * 1000
        )
        before = snapshot(self.tree)

        def limit() -> None:
            resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))

        done = subprocess.run(
            [
                sys.executable,
                REPOSITORY / "plugin/host_edits.py",
                "apply",
                "--tree",
                self.tree,
                "--host",
                self.host,
            ],
            preexec_fn=limit,
            capture_output=True,
            text=True,
            env={**os.environ, "LC_ALL": "C"},
        )
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stderr.count("\n"), 1)
        self.assertIn("the tree is as it was", done.stderr)
        self.assertEqual(snapshot(self.tree), before)


if __name__ == "__main__":
    unittest.main()
