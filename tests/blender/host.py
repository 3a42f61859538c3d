# SPDX-License-Identifier: GPL-2.0-or-later
"""Find the programs under test, start them with a time limit, and read what they report.

Two Blenders take part: the built one, with the node, and the stock one, Debian's own package of
the same version, which is the reference for everything that the node must not change. A program
that is missing fails the test with a line that says how to get it; nothing is skipped.

Scripts that run inside Blender stand in `inside/`. They get their parameters as one JSON object in
a file, whose name follows `--`, and answer with one in another file (see `inside/exchange.py`).
"""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

T = TypeVar("T")

REPOSITORY = Path(__file__).resolve().parents[2]
INSIDE = Path(__file__).resolve().parent / "inside"
HOST_VERSION = "3.4.1"
HOST_SOURCE = REPOSITORY / "build" / "source" / f"blender-{HOST_VERSION}"

# Large enough for Blender's default workspace with a node of fourteen sockets to be readable.
SCREEN = "1600x1000x24"


class MissingProgram(AssertionError):
    """A program that a test needs is not there; the text says how to get it."""


@dataclass(frozen=True)
class Run:
    """How a program ended: exit status (negative: killed by that signal) and all its output."""

    status: int
    output: str

    def tail(self, lines: int = 25) -> str:
        """The last lines of the output, for the message of a failing test."""
        return "\n".join(self.output.splitlines()[-lines:])


def _program(variable: str, default: Path, remedy: str) -> Path:
    path = Path(os.environ.get(variable, default))
    if not os.access(path, os.X_OK) or path.is_dir():
        raise MissingProgram(f"{path} is not a program that can be started: {remedy}")
    return path


def built_blender() -> Path:
    """The Blender that has the node."""
    return _program(
        "ICWAFER_BLENDER",
        REPOSITORY / "build" / "install" / "blender",
        "run 'scripts/icwafer build blender', or set ICWAFER_BLENDER to the built program",
    )


def built_cycles() -> Path:
    """The standalone `cycles` program that has the node."""
    return _program(
        "ICWAFER_CYCLES",
        REPOSITORY / "build" / "install" / "cycles",
        "run 'scripts/icwafer build cycles', or set ICWAFER_CYCLES to the built program",
    )


def stock_blender() -> Path:
    """Debian's own Blender of the same version, without the node."""
    path = _program(
        "ICWAFER_STOCK_BLENDER",
        Path("/usr/bin/blender"),
        "the reference is Debian's package, 'apt-get install blender'",
    )
    if path.samefile(built_blender()):
        raise MissingProgram(f"{path} is the built Blender: a comparison with itself says nothing")
    return path


def in_both(work: Callable[[str, Path], T]) -> tuple[T, T]:
    """Results of `work(role, blender)` for the roles "stock" and "built", done side by side."""
    blenders = {"stock": stock_blender(), "built": built_blender()}
    with ThreadPoolExecutor(len(blenders)) as pool:
        stock, built = pool.map(work, blenders, blenders.values())
    return stock, built


def host_source() -> Path:
    """The source tree of the built Blender (its own tests are in there)."""
    path = Path(os.environ.get("ICWAFER_BLENDER_SOURCE", HOST_SOURCE))
    if not (path / "tests" / "python").is_dir():
        raise MissingProgram(
            f"{path} is not Blender's source: run 'scripts/icwafer build blender', "
            "or set ICWAFER_BLENDER_SOURCE to the tree"
        )
    return path


def fresh_folder(name: str) -> Path:
    """An empty folder for a test's pictures and files; it stays, to be seen after a failure."""
    folder = REPOSITORY / "out" / "tests" / name
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    return folder


def _private_environment(folder: Path) -> dict[str, str]:
    """An environment in which neither a user's settings nor leftovers of other runs are seen."""
    user = folder / "user"
    # An add-on of Blender's expects that its parent folder exists.
    (user / ".config" / "blender").mkdir(parents=True, exist_ok=True)
    return os.environ | {
        "BLENDER_USER_CONFIG": str(user),
        "BLENDER_USER_SCRIPTS": str(user),
        "HOME": str(user),
        "TMPDIR": str(user),
        # The same OpenGL on every machine, with a graphics card or without one.
        "LIBGL_ALWAYS_SOFTWARE": "1",
    }


def _on_virtual_screen(command: list[str]) -> list[str]:
    if shutil.which("xvfb-run") is None:
        raise MissingProgram("xvfb-run is not installed: 'apt-get install xvfb libgl1-mesa-dri'")
    return ["xvfb-run", "--auto-servernum", f"--server-args=-screen 0 {SCREEN}", *command]


def run(
    program: Path,
    *arguments: str | Path,
    folder: Path,
    seconds: float,
    screen: bool = False,
    environment: dict[str, str] | None = None,
) -> Run:
    """Run a program to its end, in `folder`.

    `screen` gives it a virtual display with software OpenGL. When the time is over the program and
    all that it started end, and AssertionError says what it had printed so far.
    """
    command = [str(program), *map(str, arguments)]
    process = subprocess.Popen(
        _on_virtual_screen(command) if screen else command,
        cwd=folder,
        env=_private_environment(folder) | (environment or {}),
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        errors="replace",
        start_new_session=True,
    )
    try:
        output, _ = process.communicate(timeout=seconds)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        output, _ = process.communicate()
        ended = Run(-signal.SIGKILL, output)
        raise AssertionError(
            f"not done after {seconds:g} s: {' '.join(command)}\n{ended.tail()}"
        ) from None
    return Run(process.returncode, output)


def run_inside(
    blender: Path,
    script: str,
    parameters: dict[str, Any],
    *,
    folder: Path,
    seconds: float,
    screen: bool = False,
    window: bool = False,
) -> dict[str, Any]:
    """Run `inside/<script>.py` in a Blender and return its report.

    `screen` gives OpenGL to a Blender without window; `window` opens Blender's window on it. A
    script that ends with an error, or without a report, is an AssertionError with its last lines.
    """
    folder.mkdir(parents=True, exist_ok=True)
    given = folder / f"{script}.parameters.json"
    report = folder / f"{script}.report.json"
    report.unlink(missing_ok=True)
    given.write_text(json.dumps(parameters | {"report": str(report)}))
    ended = run(
        blender,
        *([] if window else ["--background"]),
        "--factory-startup",
        "--python-exit-code", "1",
        "--python-expr", f"import sys; sys.path.insert(0, {str(INSIDE)!r})",
        "--python", INSIDE / f"{script}.py",
        "--", given,
        folder=folder,
        seconds=seconds,
        screen=screen or window,
    )  # fmt: skip
    if ended.status != 0 or not report.exists():
        raise AssertionError(
            f"{script} in {blender} ended with status {ended.status}:\n{ended.tail()}"
        )
    return json.loads(report.read_text()) | {"output": ended.output}
