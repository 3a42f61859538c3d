# SPDX-License-Identifier: GPL-2.0-or-later
"""The command `icwafer assets`: builds the asset library of the built Blender.

Nothing is imported before it is needed: the command may have to install numpy first.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path

from icwafer import packages

AddCommand = Callable[[str, str], argparse.ArgumentParser]


def register(add: AddCommand) -> None:
    """Adds the command `assets`; `add` makes a parser from a name and a description."""
    command = add("assets", "build the asset library, which the built Blender then shows")
    command.set_defaults(run=_assets)


def _assets(_: argparse.Namespace) -> int:
    for path in build_library():
        print(path)
    return 0


def build_library() -> list[Path]:
    """Installs what the library needs, and brings it up to date; see `icwafer.assets.build`."""
    packages.install("base", "images")
    from icwafer.assets.build import build

    return build()
