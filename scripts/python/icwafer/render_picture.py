# SPDX-License-Identifier: GPL-2.0-or-later
"""Renders one of the project's pictures, inside Blender:

blender -b --factory-startup --python-exit-code 1 -P render_picture.py -- NAME --output out/NAME
"""

from __future__ import annotations

import argparse
import dataclasses
import logging
import re
import sys
from pathlib import Path
from typing import NoReturn

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from icwafer.errors import IcwaferError  # noqa: E402
from icwafer.pictures import PICTURES, Picture  # noqa: E402

logger = logging.getLogger("icwafer")


class _Parser(argparse.ArgumentParser):
    def error(self, message: str) -> NoReturn:
        raise IcwaferError(f"{message}: see render_picture.py --help")


def _count(text: str) -> int:
    if not re.fullmatch(r"[1-9]\d{0,6}", text):
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number from 1 to 9999999")
    return int(text)


def _size(text: str) -> tuple[int, int]:
    match = re.fullmatch(r"([1-9]\d{0,4})x([1-9]\d{0,4})", text)
    if not match:
        raise argparse.ArgumentTypeError(f"{text!r} is not a size: write WIDTHxHEIGHT")
    return int(match[1]), int(match[2])


def _parser() -> argparse.ArgumentParser:
    parser = _Parser(prog="render_picture.py", description="Renders one picture.")
    parser.add_argument("name", choices=PICTURES, metavar="NAME", help=", ".join(PICTURES))
    parser.add_argument(
        "--output", type=Path, required=True, help="path without ending; .png and .exr are written"
    )
    parser.add_argument("--samples", type=_count, help="per pixel, instead of the picture's own")
    parser.add_argument("--size", type=_size, help="WIDTHxHEIGHT, instead of the picture's own")
    parser.add_argument("--seed", type=_count, help="of the die, instead of the picture's own")
    return parser


def chosen_picture(arguments: argparse.Namespace) -> Picture:
    """The picture of that name with what the command line says in place of its own."""
    picture = PICTURES[arguments.name]
    if arguments.seed:
        picture = dataclasses.replace(
            picture, die=dataclasses.replace(picture.die, seed=arguments.seed)
        )
    given = {key: getattr(arguments, key) for key in ("samples", "size")}
    overrides = {key: value for key, value in given.items() if value}
    return dataclasses.replace(picture, render=dataclasses.replace(picture.render, **overrides))


def render(picture: Picture, output: Path) -> None:
    """Writes output.png, as a screen shows it, and output.exr, linear: both or neither.

    Raises IcwaferError where the folder cannot be written or the disk is full.
    """
    import bpy

    from icwafer.scene import image
    from icwafer.scene.picture import build

    output = output.resolve()
    scene = build(picture)
    try:
        output.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise IcwaferError(f"cannot make folder {output.parent}: {error.strerror}") from error
    image.expect_space(output.parent, picture.render.size)
    bpy.ops.render.render()
    # Written beside and renamed, so that no half of a picture is ever left.
    parts = {
        output.with_name(output.name + ending): output.with_name(f".part-{output.name}{ending}")
        for ending in (".exr", ".png")
    }
    try:
        for part in parts.values():
            image.save(scene, part)
        for path, part in parts.items():
            part.replace(path)
            logger.info("wrote %s", path)
    except (OSError, RuntimeError) as error:
        reason = " ".join(str(error).split())
        raise IcwaferError(f"cannot write {output}.png and .exr: {reason}") from error
    finally:
        for part in parts.values():
            part.unlink(missing_ok=True)


def main(arguments: list[str]) -> int:
    logging.basicConfig(level=logging.INFO, format="%(message)s")
    try:
        parsed = _parser().parse_args(arguments)
        render(chosen_picture(parsed), parsed.output)
    except IcwaferError as error:
        print(f"icwafer: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    after_dashes = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    sys.exit(main(after_dashes))
