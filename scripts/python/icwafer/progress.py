# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs long commands: one line that tells how far they are, a log, and the error that matters."""

from __future__ import annotations

import contextlib
import os
import re
import selectors
import signal
import subprocess
import sys
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TextIO

from icwafer.errors import IcwaferError

#: How ninja ("[12/345]") and Cycles ("Sample 12/345") say how far they are.
COUNT = re.compile(r"(?:^\[|Sample )(\d+)/(\d+)")
#: How often a line is written where it cannot be overwritten, such as in a file.
SPARSE_S = 30.0

# What an error looks like, the most telling first.
_ERROR_PATTERNS = [
    re.compile(pattern)
    for pattern in (
        r"No space left on device",
        r"^(icwafer|host_edits): ",
        r"\b(fatal )?error: ",
        r"undefined reference",
        r"^CMake Error",
        r"^E: ",
        r"\bError\b",
        r"\bKilled\b|^ninja: ",
    )
]


def duration(seconds: float) -> str:
    """A time as a person would say it: "0.4 s", "12 s", "3 min 5 s"."""
    if seconds < 9.95:
        return f"{seconds:.1f} s"
    minutes, rest = divmod(round(seconds), 60)
    return f"{minutes} min {rest} s" if minutes else f"{rest} s"


def first_error(log: str) -> str:
    """The line of a log that says best what went wrong; its last line if none stands out."""
    lines = [line.strip() for line in log.splitlines() if line.strip()]
    for pattern in _ERROR_PATTERNS:
        for index, line in enumerate(lines):
            if pattern.search(line):
                # CMake writes the place first and the message below it.
                follow = lines[index + 1 : index + 2] if line.startswith("CMake Error") else []
                return " ".join([line, *follow])
    return lines[-1] if lines else "it wrote nothing"


@dataclass
class Progress:
    """The line of one step: overwritten on a terminal, now and then a new one elsewhere."""

    title: str
    stream: TextIO = field(default_factory=lambda: sys.stdout)
    left: str = ""  # how long it will take, if that is known
    _begin: float = field(default_factory=time.monotonic)
    _written: float = field(default_factory=time.monotonic)
    _count: str = ""

    def feed(self, line: str) -> None:
        """Takes a line of the command's output."""
        match = COUNT.search(line)
        if match:
            done, total = int(match[1]), int(match[2])
            self._count = f" {done}/{total} ({100 * done // max(total, 1)} %),"

    def tick(self) -> None:
        """Writes how far the step is, if it is time to."""
        now = time.monotonic()
        if not self.stream.isatty() and now - self._written < SPARSE_S:
            return
        self._written = now
        left = f", {self.left} left" if self.left else ""
        self._write(f"{self.title} ...{self._count} {duration(now - self._begin)}{left}", False)

    def end(self, verdict: str = "done") -> None:
        self._write(f"{self.title}: {verdict} in {duration(time.monotonic() - self._begin)}", True)

    def _write(self, text: str, final: bool) -> None:
        if self.stream.isatty():
            self.stream.write(f"\r\033[K{text}" + ("\n" if final else ""))
        else:
            self.stream.write(f"{text}\n")
        self.stream.flush()


def run(
    title: str,
    command: Sequence[str | Path],
    log: Path,
    environment: Mapping[str, str] | None = None,
    advice: str = "",
) -> str:
    """Runs a command, shows its progress under `title`, and returns all that it wrote.

    Everything goes to `log` too. `environment` is added to the present one. Raises `IcwaferError`
    with the first error line, the log's path and `advice` if the command fails. On Ctrl-C the
    command and its children are told to stop, and it is waited for them.
    """
    log.parent.mkdir(parents=True, exist_ok=True)
    progress = Progress(title)
    output: list[str] = []
    with log.open("w", encoding="utf-8") as file:
        try:
            process = subprocess.Popen(
                [str(word) for word in command],
                stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                env={**os.environ, **(environment or {})},
                start_new_session=True,
            )
        except FileNotFoundError:
            raise IcwaferError(
                f"{title}: the program {command[0]} is missing; see scripts/icwafer doctor"
            ) from None
        with process:
            try:
                _follow(process, progress, output, file)
            except BaseException:
                _stop(process)
                progress.end("stopped")
                raise
    text = "".join(output)
    if process.returncode != 0:
        progress.end("failed")
        hint = f"; {advice}" if advice else ""
        raise IcwaferError(f"{title} failed: {first_error(text)} (whole log: {log}){hint}")
    progress.end()
    return text


def _follow(
    process: subprocess.Popen[bytes], progress: Progress, output: list[str], log: TextIO
) -> None:
    """Reads the command's output to its end; a silent command still shows the time passing."""
    assert process.stdout is not None
    pending = b""
    with selectors.DefaultSelector() as selector:
        selector.register(process.stdout, selectors.EVENT_READ)
        while True:
            if selector.select(timeout=1.0):
                data = os.read(process.stdout.fileno(), 1 << 16)
                if not data:
                    break
                log.write(data.decode(errors="replace"))
                *lines, pending = (pending + data).replace(b"\r", b"\n").split(b"\n")
                for line in lines:
                    text = line.decode(errors="replace")
                    progress.feed(text)
                    output.append(f"{text}\n")
            progress.tick()
    output.append(pending.decode(errors="replace"))
    process.wait()


def _stop(process: subprocess.Popen[bytes]) -> None:
    """Ends a command and all that it started; ninja and apt clean up when they are interrupted."""
    for sent in (signal.SIGINT, signal.SIGTERM, signal.SIGKILL):
        with contextlib.suppress(ProcessLookupError, subprocess.TimeoutExpired):
            os.killpg(process.pid, sent)
            process.wait(timeout=10)
            break
    with contextlib.suppress(ProcessLookupError):  # children that ignore an interruption
        os.killpg(process.pid, signal.SIGTERM)
