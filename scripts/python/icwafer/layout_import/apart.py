# SPDX-License-Identifier: GPL-2.0-or-later
"""Imports a chip in a process of its own, for a program that cannot start others by forking.

That is a program with threads or a window, such as Blender. The process gets a request as JSON on
stdin, and answers on stdout with lines of JSON: how much is done, and at last the layout or what is
wrong. It ends with the one who waits for it.
"""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

from icwafer.chips.document import layout_text, parse_layout
from icwafer.chips.model import Layout
from icwafer.errors import IcwaferError
from icwafer.layout_import.process import USUAL


def import_apart(
    path: Path,
    *,
    layers: str = USUAL,
    tile_um: float | None = None,
    window_um: float | None = None,
    top: str | None = None,
    lef: tuple[Path, ...] = (),
    progress: Callable[[float], None] = lambda _: None,
) -> Layout:
    """The layout of a chip; see `reader.Request` for the arguments and `process.read_process`.

    progress is told now and then how much is done, 0 to 1. Raises IcwaferError as
    `importer.import_layout` does.
    """
    request = {
        "path": str(path),
        "layers": layers,
        "tile_um": tile_um,
        "window_um": window_um,
        "top": top,
        "lef": [str(file) for file in lef],
    }
    process = subprocess.Popen(
        ["/usr/bin/python3", "-B", "-m", __name__],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        env=os.environ | {"PYTHONPATH": str(Path(__file__).resolve().parents[2])},
        start_new_session=True,
        text=True,
    )
    try:
        with process.stdin as stdin:
            json.dump(request, stdin)
        for line in process.stdout:
            answer = json.loads(line)
            if "done" in answer:
                progress(answer["done"])
            elif "error" in answer:
                raise IcwaferError(answer["error"])
            else:
                return parse_layout(answer["layout"], str(path))
        raise IcwaferError(f"{path}: the import ended with status {process.wait()}; try it again")
    finally:
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGKILL)
        process.wait()
        process.stdout.close()


def main() -> int:
    """Answers one request."""
    # Not above: multiprocessing, which is among what these import, keeps a reference to the main
    # module, and Blender frees that of a script on its command line; it would crash when it ends.
    from icwafer.layout_import.importer import import_layout
    from icwafer.layout_import.process import read_process
    from icwafer.layout_import.reader import Request

    request = json.load(sys.stdin)
    try:
        imported = import_layout(
            Request(
                path=Path(request["path"]),
                process=read_process(request["layers"]),
                tile_um=request["tile_um"],
                window_um=request["window_um"],
                top=request["top"],
                lef=tuple(map(Path, request["lef"])),
            ),
            progress=lambda share: _answer(done=share),
        )
        _answer(layout=layout_text(imported.layout))
    except IcwaferError as error:
        _answer(error=str(error))
    except OSError as error:
        _answer(error=f"{error.filename}: {error.strerror}")
    return 0


def _answer(**message: object) -> None:
    print(json.dumps(message), flush=True)


if __name__ == "__main__":
    sys.exit(main())
