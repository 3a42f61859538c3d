# SPDX-License-Identifier: GPL-2.0-or-later
"""The command `icwafer pictures`: renders the project's pictures."""

from __future__ import annotations

import argparse
from collections.abc import Callable

from icwafer import build, packages, paths, render
from icwafer.errors import InputError


def register(add: Callable[[str, str], argparse.ArgumentParser]) -> None:
    """Adds the command; `add` makes a parser from a name and a description."""
    command = add("pictures", "render the README's pictures to out/pictures")
    command.add_argument(
        "names", nargs="*", metavar="NAME", help="pictures; all if none is named"
    )
    command.add_argument(
        "--keep", action="store_true", help="also put them into blend_assets/pictures"
    )
    command.set_defaults(run=_pictures)


def _pictures(arguments: argparse.Namespace) -> int:
    packages.install("images")

    from icwafer.pictures import PICTURES

    unknown = [name for name in arguments.names if name not in PICTURES]
    if unknown:
        raise InputError(f"no picture '{unknown[0]}'; choose from {', '.join(PICTURES)}")
    build.build("blender")
    for name in arguments.names or PICTURES:
        png, exr = render.render(name, paths.OUT / "pictures" / name)
        print(png, exr, sep="\n")
        if arguments.keep:
            from icwafer.pictures.kept import copy_picture, kept_path

            kept = kept_path(name, PICTURES[name])
            copy_picture(png, kept)
            print(kept)
    return 0
