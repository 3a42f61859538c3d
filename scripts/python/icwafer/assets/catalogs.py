# SPDX-License-Identifier: GPL-2.0-or-later
"""The catalogs of the asset library: Blender's own file of them, `blender_assets.cats.txt`."""

from __future__ import annotations

import re
from pathlib import Path

from icwafer.errors import IcwaferError

FILE_NAME = "blender_assets.cats.txt"

_LINE = re.compile(r"([0-9a-f]{8}(?:-[0-9a-f]{4}){3}-[0-9a-f]{12}):([^:]+):([^:]*)")


def read_catalogs(path: Path) -> dict[str, str]:
    """Identifiers of the catalogs by their paths, as "Materials/Metals", in the file's order.

    Raises IcwaferError for a line that Blender would not understand or a catalog that is there
    twice, OSError where the file cannot be read.
    """
    catalogs: dict[str, str] = {}
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        if not line.strip() or line.startswith(("#", "VERSION ")):
            continue
        match = _LINE.fullmatch(line)
        if not match:
            raise IcwaferError(f"{path}:{number}: write IDENTIFIER:PATH:NAME, not '{line:.60}'")
        identifier, name, _ = match.groups()
        if name in catalogs or identifier in catalogs.values():
            raise IcwaferError(f"{path}:{number}: this path or identifier is there twice")
        catalogs[name] = identifier
    return catalogs
