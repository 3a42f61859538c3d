# SPDX-License-Identifier: GPL-2.0-or-later
"""Finds arrays without a pitch in a GDSII file, whose copies all lie on one another.

KLayout reads such an array as a single copy and says nothing, so this looks at the records
themselves (GDSII Stream Format Manual, Calma, release 6.0): SNAME 0x1206, COLROW 0x1302 with the
numbers of columns and rows, XY 0x1003 with the first corner and the two corners opposite to it.
"""

from __future__ import annotations

import gzip
import re
import struct
from collections.abc import Iterator
from pathlib import Path

_ARRAY = re.compile(
    rb"\x12\x06([!-~]{1,64})\x00?.{0,32}?\x00\x08\x13\x02(.{4})\x00\x1c\x10\x03(.{24})", re.DOTALL
)
_LONGEST = 160  # bytes of the expression
_CHUNK = 1 << 24


def array_without_pitch(path: Path) -> tuple[str, int] | None:
    """The name of the cell that is repeated and how often, of the first such array.

    None if there is none, or the file is no GDSII. Memory is bounded. Raises OSError or EOFError
    where the file, or its compression, is damaged.
    """
    for chunk in _chunks(path):
        for match in _ARRAY.finditer(chunk):
            counts = struct.unpack(">2h", match[2])
            corner, *opposite = struct.iter_unpack(">2i", match[3])
            for count, other in zip(counts, opposite):
                if count > 1 and other == corner:
                    return match[1].decode("ascii"), count
    return None


def _chunks(path: Path) -> Iterator[bytes]:
    """The file, decompressed; each chunk begins with the end of the last one."""
    with path.open("rb") as file:
        compressed = file.read(2) == b"\x1f\x8b"
    with gzip.open(path) if compressed else path.open("rb") as file:
        tail = b""
        while chunk := file.read(_CHUNK):
            if not tail and chunk[2:4] != b"\x00\x02":  # the record HEADER
                return
            yield tail + chunk
            tail = chunk[-_LONGEST:]
