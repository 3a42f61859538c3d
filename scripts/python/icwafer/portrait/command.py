# SPDX-License-Identifier: GPL-2.0-or-later
"""The command `icwafer portrait`: from the file of a chip to a picture of it.

Nothing is imported before it is needed: the command may have to install numpy first.
"""

from __future__ import annotations

import argparse
import re
import tempfile
from collections.abc import Callable
from pathlib import Path

from icwafer import packages, paths, render
from icwafer.errors import IcwaferError
from icwafer.layout_import.command import add_reading_options

_SCRIPT = Path(__file__).with_name("render.py")
_SIDES = (16, 8192)


def register(add: Callable[[str, str], argparse.ArgumentParser]) -> None:
    """Adds the command; `add` makes a parser from a name and a description."""
    command = add("portrait", "render a picture of a chip, or of a wafer full of it")
    command.add_argument(
        "file", type=Path, metavar="FILE", help=".gds, .gds.gz, .oas, .def or .layout.toml"
    )
    command.add_argument(
        "-o",
        "--output",
        type=Path,
        metavar="PICTURE",
        help=".png or .jpg; default: FILE's name with .png"
    )
    command.add_argument(
        "--wafer",
        action="store_true",
        help="show a wafer full of it; chips below 6 mm are enlarged",
    )
    command.add_argument(
        "--size", type=_size, default=(1920, 1080), metavar="WIDTHxHEIGHT", help="1920x1080"
    )
    command.add_argument(
        "--samples", type=_samples, default=26, metavar="N", help="paths per pixel; default 26"
    )
    command.add_argument("--exr", action="store_true", help="also write the linear light, as EXR")
    add_reading_options(command)
    command.set_defaults(run=_portrait)


def _size(text: str) -> tuple[int, int]:
    match = re.fullmatch(r"(\d{1,5})x(\d{1,5})", text)
    size = (int(match[1]), int(match[2])) if match else (0, 0)
    if not all(_SIDES[0] <= side <= _SIDES[1] for side in size):
        raise argparse.ArgumentTypeError(
            f"'{text}' is not WIDTHxHEIGHT with sides from {_SIDES[0]} to {_SIDES[1]} pixels"
        )
    return size


def _samples(text: str) -> int:
    if not re.fullmatch(r"\d{1,5}", text) or int(text) < 1:
        raise argparse.ArgumentTypeError(f"'{text}' is not a whole number from 1 to 99999")
    return int(text)


def _portrait(arguments: argparse.Namespace) -> int:
    source: Path = arguments.file
    output: Path = arguments.output or Path(source.name.split(".")[0] + ".png")
    if output.suffix not in (".png", ".jpg"):
        raise IcwaferError(f"{output}: a picture's name ends with .png or .jpg; add that")
    if not source.is_file():
        raise IcwaferError(f"{source}: no such file; name a chip or a layout")
    if not output.parent.is_dir():
        raise IcwaferError(f"{output.parent}: no such folder; make it, or choose another one")
    blender = render.blender()
    packages.install("layout", "import", *(["images"] if output.suffix == ".jpg" else []))
    from icwafer.chips.document import ENDING, write_layout
    from icwafer.pictures.kept import copy_picture
    from icwafer.portrait.order import Order
    from icwafer.portrait.subject import subject_of

    subject = subject_of(
        source, arguments.layers, tuple(arguments.lef), arguments.top, arguments.wafer
    )
    # In the folder of the output, so that what is done takes its place at once.
    with tempfile.TemporaryDirectory(prefix=".portrait-", dir=output.parent) as name:
        folder = Path(name).resolve()
        write_layout(folder / f"chip{ENDING}", subject.layout)
        if subject.wires:
            subject.wires.write(folder / "wires.npz")
        made = {ending: folder / f"portrait{ending}" for ending in (".png", ".exr")}
        Order(
            layout=str(folder / f"chip{ENDING}"),
            wires=str(folder / "wires.npz") if subject.wires else "",
            wafer=arguments.wafer,
            size=arguments.size,
            samples=arguments.samples,
            png=str(made[".png"]),
            exr=str(made[".exr"]) if arguments.exr else "",
            node={"illuminant": "D65", **subject.node},
        ).write(folder / "order.json")
        render.run_script(
            f"Rendering {output.name}",
            blender,
            _SCRIPT,
            [folder / "order.json"],
            paths.LOGS / "portrait.log",
        )
        if arguments.exr:
            made[".exr"].replace(output.with_suffix(".exr"))
            print(output.with_suffix(".exr"))
        if output.suffix == ".jpg":
            copy_picture(made[".png"], output)
        else:
            made[".png"].replace(output)
        print(output)
    return 0
