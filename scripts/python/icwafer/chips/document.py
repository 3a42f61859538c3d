# SPDX-License-Identifier: GPL-2.0-or-later
"""Layout files, `NAME.layout.toml`: reading and writing."""

from __future__ import annotations

from pathlib import Path

from icwafer.chips.model import Layout


def read_layout(path: Path) -> Layout:
    """Reads and checks a layout file.

    Raises IcwaferError with the file, line, field, value and allowed range, or OSError.
    """
    raise NotImplementedError


def write_layout(path: Path, layout: Layout) -> None:
    """Writes a layout file: complete, or not at all.

    The same layout gives the same bytes, and reading the file gives an equal layout. Raises
    IcwaferError where the layout is not valid, or OSError.
    """
    raise NotImplementedError
