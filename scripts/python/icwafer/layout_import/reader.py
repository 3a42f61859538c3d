# SPDX-License-Identifier: GPL-2.0-or-later
"""Our end of the pipe to `worker`: the tiles of a layout file, read in a process of its own."""

from __future__ import annotations

import json
import os
import signal
import subprocess
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np

from icwafer.errors import IcwaferError
from icwafer.layout_import import worker
from icwafer.layout_import.outline import Outline
from icwafer.layout_import.process import Process

#: Where Debian's package has KLayout's libraries and Python module.
KLAYOUT = Path("/usr/lib/klayout")


@dataclass(frozen=True)
class Limits:
    """What reading a file may cost: address space, and seconds of computing."""

    memory_gb: float = 6.0
    seconds: int = 900


@dataclass(frozen=True)
class Request:
    """What to read, and how to cut it.

    tile_um: wanted side of a tile; the chip is cut into a whole number of equal ones. window_um:
    largest side of the window in the middle of a tile that is looked at. None: see `worker`.
    """

    path: Path
    process: Process
    tile_um: float | None = None
    window_um: float | None = None
    top: str | None = None
    lef: tuple[Path, ...] = ()
    limits: Limits = Limits()


@dataclass(frozen=True)
class Chip:
    """The cell that is read: its name, its size, and its columns and rows of tiles."""

    top: str
    size_um: tuple[float, float]
    tiles: tuple[int, int]


@dataclass(frozen=True)
class Cutout:
    """One layer in the window of one tile.

    tile: column and row. layer: index into the process's layers. visible: the share of its area
    with no higher metal above it, 0 to 1.
    """

    tile: tuple[int, int]
    layer: int
    visible: float
    outline: Outline


@dataclass(frozen=True)
class Solids:
    """One layer of a chip as trapezoids.

    layer: index into the process's layers. corners_um: (n, 4, 2) float64, clockwise, from the
    chip's lower left corner; of a triangle the last two are the same.
    """

    layer: int
    corners_um: np.ndarray


def read_solids(request: Request, most: int) -> Iterator[Chip | Solids]:
    """Reads the shapes of a layout file: the chip first, then its layers, the highest first.

    A chip of more than `most` trapezoids has no layers. Raises as `cut_out` does.
    """
    return _read(request, most)


def cut_out(request: Request) -> Iterator[Chip | Cutout]:
    """Reads a layout file: the chip first, then its cutouts, tile by tile, highest layer first.

    Raises IcwaferError where the file cannot be read, or only beyond the limits.
    """
    return _read(request, 0)


def _read(request: Request, most_solids: int) -> Iterator[Chip | Cutout | Solids]:
    if not request.path.is_file():
        raise IcwaferError(f"{request.path}: no such file; name a GDSII, OASIS or DEF file")
    for lef in request.lef:
        if not lef.is_file():
            raise IcwaferError(f"{lef}: no such file; name the LEF files of the DEF")
    if request.path.suffix.lower() == ".def" and not request.lef:
        raise IcwaferError(
            f"{request.path}: a DEF says nothing about the shapes of cells and vias; give the "
            "LEF files of its technology and its cells with --lef"
        )
    process = _start()
    try:
        with process.stdin as stdin:
            stdin.write(json.dumps(_message(request, most_solids)).encode())
        yield from _messages(request, process.stdout)
    except (EOFError, BrokenPipeError):
        raise IcwaferError(f"{request.path}: {_death(process.wait(), request.limits)}") from None
    finally:
        process.kill()
        process.wait()
        process.stdout.close()


def _start() -> subprocess.Popen:
    if not (KLAYOUT / "pymod").is_dir():
        raise IcwaferError(
            "KLayout, which reads layout files, is not installed; run as root: "
            "apt-get install klayout"
        )
    package = Path(__file__).resolve().parents[2]
    environment = os.environ | {
        "PYTHONPATH": f"{package}:{KLAYOUT / 'pymod'}",
        "LD_LIBRARY_PATH": str(KLAYOUT),
        "OPENBLAS_NUM_THREADS": "1",  # each thread would take of the address space
    }
    return subprocess.Popen(
        ["/usr/bin/python3", "-B", "-m", worker.__name__],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        env=environment,
    )


def _message(request: Request, most_solids: int) -> dict[str, Any]:
    return {
        "path": str(request.path),
        "lef": [str(path) for path in request.lef],
        "top": request.top,
        "process": request.process.name,
        "layers": [
            [*layer.gds, *(layer.lef + ending for ending in ("", ".PIN", ".FILL"))]
            for layer in request.process.layers
        ],
        "tile_um": request.tile_um,
        "window_um": request.window_um,
        "most_solids": most_solids,
        "limit_bytes": round(request.limits.memory_gb * 2**30),
        "limit_seconds": request.limits.seconds,
    }


def _messages(request: Request, answer: BinaryIO) -> Iterator[Chip | Cutout | Solids]:
    while True:
        line = answer.readline()
        if not line.endswith(b"\n"):
            raise EOFError
        message = json.loads(line)
        if "end" in message:
            return
        if "error" in message:
            text = message["error"]
            if text == "memory":
                text = _too_much_memory(request.limits)
            raise IcwaferError(f"{request.path}: {text}")
        if "top" in message:
            yield Chip(message["top"], tuple(message["size_um"]), tuple(message["tiles"]))
        elif "solids" in message:
            corners = _numbers(answer, 8 * message["solids"]).reshape(-1, 4, 2)
            yield Solids(message["layer"], corners * message["dbu"])
        else:
            yield _cutout(message, answer)


def _cutout(message: dict[str, Any], answer: BinaryIO) -> Cutout:
    corners = _numbers(answer, 4 * message["edges"]).reshape(-1, 4)
    edges_um = (corners - np.array(message["centre"] * 2)) * message["dbu"]
    outline = Outline(edges_um, tuple(message["size_um"]))
    return Cutout(tuple(message["tile"]), message["layer"], message["visible"], outline)


def _numbers(answer: BinaryIO, count: int) -> np.ndarray:
    data = answer.read(8 * count)
    if len(data) < 8 * count:
        raise EOFError
    return np.frombuffer(data, dtype="<i8")


def _too_much_memory(limits: Limits) -> str:
    return (
        f"needs more than {limits.memory_gb:g} GB of memory; raise the limit with --limit-gb, or "
        "take a smaller cell with --top"
    )


def _death(status: int, limits: Limits) -> str:
    """Why the worker ended without an answer."""
    if status == -signal.SIGXCPU:
        return (
            f"is not read within {limits.seconds} s of computing, because it is very large or its "
            "cells are nested very deep; raise the limit with --limit-s, or take a smaller cell "
            "with --top"
        )
    if status in (-signal.SIGABRT, -signal.SIGKILL):
        return _too_much_memory(limits)
    if status > 0:
        return "KLayout does not start; install the Debian package klayout anew"
    return "KLayout crashed on it, so it is damaged; write it anew with the program it is from"
