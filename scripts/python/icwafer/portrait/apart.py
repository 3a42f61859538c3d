# SPDX-License-Identifier: GPL-2.0-or-later
"""Reads a subject in a process of its own, for a program that should not fork.

That is a program with threads and a window, such as Blender. The process gets a request as JSON on
stdin, and answers on stdout with lines of JSON: how much is done, and at last the subject, whose
wires are in a file, or what is wrong.
"""

from __future__ import annotations

import dataclasses
import json
import os
import select
import signal
import subprocess
import sys
import tempfile
from collections.abc import Generator, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO

from icwafer.chips.document import layout_text, parse_layout
from icwafer.errors import IcwaferError
from icwafer.layout_import.process import USUAL
from icwafer.portrait.subject import Subject, subject_of
from icwafer.portrait.wires import Wires


@dataclass(frozen=True)
class Wish:
    """What to read; the fields are the arguments of `subject_of`."""

    path: str
    layers: str = USUAL
    lef: tuple[str, ...] = ()
    top: str | None = None
    wafer: bool = False
    tile_um: float | None = None
    window_um: float | None = None


def subject_apart(wish: Wish, patience_s: float) -> Generator[float | None, None, Subject]:
    """What `subject_of` returns, and its errors, in steps between which the caller may do more.

    Yields how much is done, 0 to 1, or None where in `patience_s` seconds nothing was heard.
    Closing the generator ends the process.
    """
    with tempfile.TemporaryDirectory(prefix="icwafer-") as folder:
        wires = Path(folder) / "wires.npz"
        process = subprocess.Popen(
            ["/usr/bin/python3", "-B", "-m", __name__, wires],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            env=os.environ | {"PYTHONPATH": str(Path(__file__).resolve().parents[2])},
            start_new_session=True,
        )
        try:
            with process.stdin as stdin:
                stdin.write(json.dumps(dataclasses.asdict(wish)).encode())
            for line in _lines(process.stdout, patience_s):
                answer = json.loads(line) if line else {"done": None}
                if "done" in answer:
                    yield answer["done"]
                elif "error" in answer:
                    raise IcwaferError(answer["error"])
                else:
                    return Subject(
                        parse_layout(answer["layout"], wish.path),
                        Wires.read(wires) if wires.is_file() else None,
                        answer["node"],
                    )
            status = process.wait()
            raise IcwaferError(f"{wish.path}: reading it ended with status {status}; try it again")
        finally:
            if process.poll() is None:
                os.killpg(process.pid, signal.SIGKILL)
            process.wait()
            process.stdout.close()


def _lines(pipe: BinaryIO, patience_s: float) -> Iterator[bytes | None]:
    """The lines that come through a pipe; None where none came in `patience_s` seconds."""
    begun = b""
    while True:
        if not select.select([pipe], [], [], patience_s)[0]:
            yield None
            continue
        heard = os.read(pipe.fileno(), 1 << 20)
        if not heard:
            return
        *lines, begun = (begun + heard).split(b"\n")
        yield from lines


def main(arguments: list[str]) -> int:
    """Answers one request; the argument is where wires go."""
    wish = json.load(sys.stdin)
    try:
        subject = subject_of(
            Path(wish.pop("path")),
            wish.pop("layers"),
            tuple(map(Path, wish.pop("lef"))),
            progress=lambda share: _answer(done=share),
            **wish,
        )
        if subject.wires:
            subject.wires.write(Path(arguments[0]))
        _answer(layout=layout_text(subject.layout), node=subject.node)
    except IcwaferError as error:
        _answer(error=str(error))
    except OSError as error:
        _answer(error=f"{error.filename}: {error.strerror}")
    return 0


def _answer(**message: object) -> None:
    print(json.dumps(message), flush=True)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
