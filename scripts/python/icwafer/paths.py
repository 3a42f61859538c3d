# SPDX-License-Identifier: GPL-2.0-or-later
"""Where things are: the repository's own folders, what is built from them, and the cache."""

from __future__ import annotations

import os
import re
from pathlib import Path

from icwafer.errors import IcwaferError

REPOSITORY = Path(__file__).resolve().parents[3]
PLUGIN = REPOSITORY / "plugin"
HOST = PLUGIN / "blender-3.4"
BUILD = REPOSITORY / "build"
LOGS = BUILD / "log"
HOST_BINARY = BUILD / "blender"
INSTALLED = BUILD / "install"
BLENDER = INSTALLED / "blender"
CYCLES = INSTALLED / "cycles"
OUT = REPOSITORY / "out"


def host_version() -> str:
    """Version of Blender that the edits are for, as "3.4.1"; written once, in `edits.toml`."""
    edits = HOST / "edits.toml"
    match = re.search(r'^version *= *"(.+)"$', edits.read_text(encoding="utf-8"), re.MULTILINE)
    if not match:
        raise IcwaferError(f"{edits}: no line 'version = \"...\"' in it; add it")
    return match[1]


def host_source() -> Path:
    """The host's source tree, with our edits."""
    return BUILD / "source" / f"blender-{host_version()}"


def cache_folder() -> Path:
    """Downloads that survive the build folder."""
    home = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    return Path(home) / "icwafer"
