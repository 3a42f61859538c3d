# SPDX-License-Identifier: GPL-2.0-or-later
"""What the asset library consists of, one .blend file for each kind of asset, and where it is."""

from __future__ import annotations

from pathlib import Path

from icwafer import paths

#: Each kind has a module of that name in icwafer.scene.library, and a file of that name.
KINDS = ("materials", "dies", "wafers", "lights", "studios")


def installed_folder() -> Path:
    """Where the built Blender has the library; the add-on shows it in the asset browser."""
    version = paths.host_version().rpartition(".")[0]
    return paths.INSTALLED / version / "datafiles" / "icwafer"
