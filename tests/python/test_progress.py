# SPDX-License-Identifier: GPL-2.0-or-later
"""Long commands: what they show, what they leave in the log, how they fail and how they stop."""

from __future__ import annotations

import contextlib
import io
import os
import signal
import subprocess
import sys
import time
import unittest
from pathlib import Path

from support import REPOSITORY, CommandCase

from icwafer import progress
from icwafer.errors import IcwaferError


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


class ProgressTest(unittest.TestCase):
    def test_durations(self) -> None:
        cases = {0.04: "0.0 s", 9.94: "9.9 s", 9.96: "10 s", 59.7: "1 min 0 s", 200: "3 min 20 s"}
        for seconds, text in cases.items():
            self.assertEqual(progress.duration(seconds), text)

    def test_a_terminal_has_one_line(self) -> None:
        stream = Terminal()
        line = progress.Progress("Building", stream)
        line.feed("[12/48] Building CXX object wafer.cpp.o")
        line.tick()
        line.end()
        shown = stream.getvalue().split("\r\033[K")
        self.assertRegex(shown[1], r"^Building \.\.\. 12/48 \(25 %\), 0\.\d s$")
        self.assertRegex(shown[2], r"^Building: done in 0\.\d s\n$")

    def test_a_file_gets_few_lines(self) -> None:
        stream = io.StringIO()
        line = progress.Progress("Rendering", stream)
        for sample in range(100):
            line.feed(f"Fra:1 Mem:9M | Sample {sample}/100")
            line.tick()
        self.assertEqual(stream.getvalue(), "")
        line._written -= progress.SPARSE_S  # half a minute later
        line.tick()
        self.assertRegex(stream.getvalue(), r"^Rendering \.\.\. 99/100 \(99 %\), \d\.\d s\n$")

    def test_the_line_that_matters(self) -> None:
        cases = {
            "a.c:3:5: warning: unused\na.c:9:1: error: 'x' undeclared\nninja: stopped": (
                "a.c:9:1: error: 'x' undeclared"
            ),
            "-- checking\nCMake Error at x.txt:7 (message):\n  No library.\n\n-- incomplete": (
                "CMake Error at x.txt:7 (message): No library."
            ),
            "Err:1 http://x\nE: Unable to fetch some archives": "E: Unable to fetch some archives",
            "a.c:9:1: error: first\ncc: No space left on device": "cc: No space left on device",
            "some text\nlast words\n": "last words",
            "": "it wrote nothing",
        }
        for log, line in cases.items():
            self.assertEqual(progress.first_error(log), line)


class RunTest(CommandCase):
    def run_quietly(self, *command: str) -> str:
        with contextlib.redirect_stdout(io.StringIO()) as out:
            result = progress.run("Step", command, self.folder / "log" / "step.log")
        self.shown = out.getvalue()
        return result

    def test_output_goes_to_the_log(self) -> None:
        text = self.run_quietly("sh", "-c", "echo one; echo two >&2; printf three")
        self.assertEqual(text, "one\ntwo\nthree")
        self.assertEqual((self.folder / "log" / "step.log").read_text(), text)
        self.assertRegex(self.shown, r"^Step: done in 0\.\d s\n$")

    def test_a_failure_names_the_error_and_the_log(self) -> None:
        with self.assertRaises(IcwaferError) as caught:
            self.run_quietly(
                "sh", "-c", "echo before; echo 'x.cpp:1: error: bad'; echo after; exit 3"
            )
        message = str(caught.exception)
        self.assertIn("Step failed: x.cpp:1: error: bad", message)
        self.assertIn(str(self.folder / "log" / "step.log"), message)

    def test_a_missing_program(self) -> None:
        with self.assertRaisesRegex(IcwaferError, "no-such-program is missing"):
            self.run_quietly("no-such-program")

    def test_the_command_cannot_wait_for_input(self) -> None:
        self.assertEqual(self.run_quietly("cat"), "")

    def test_control_c_stops_the_command_and_its_children(self) -> None:
        child = self.folder / "child"
        program = (
            "import sys; from pathlib import Path; from icwafer import cli, progress\n"
            "cli._run = lambda argv: progress.run('Step', argv, Path(sys.argv[1]))\n"
            "sys.exit(cli.main(sys.argv[2:]))\n"
        )
        script = f"sleep 60 & echo $! > {child}.part; mv {child}.part {child}; wait"
        command = [sys.executable, "-c", program, self.folder / "log", "sh", "-c", script]
        for sent in (signal.SIGINT, signal.SIGTERM):
            child.unlink(missing_ok=True)
            process = subprocess.Popen(
                command,
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
                text=True,
                env={**os.environ, "PYTHONPATH": str(REPOSITORY / "scripts" / "python")},
            )
            deadline = time.monotonic() + 20
            while not child.exists() and time.monotonic() < deadline:
                time.sleep(0.02)
            process.send_signal(sent)
            out, err = process.communicate(timeout=30)
            self.assertEqual(process.returncode, 130)
            self.assertEqual(
                err, "icwafer: interrupted; the same command goes on where it stopped\n"
            )
            self.assertIn("Step: stopped", out)
            while is_running(int(child.read_text())):
                self.assertLess(time.monotonic(), deadline, "the child is still running")
                time.sleep(0.02)


def is_running(pid: int) -> bool:
    """Whether a process is there and not merely waiting to be collected."""
    try:
        status = Path(f"/proc/{pid}/stat").read_text()
    except (FileNotFoundError, ProcessLookupError):
        return False
    return status.rpartition(")")[2].split()[0] != "Z"


if __name__ == "__main__":
    unittest.main()
