# SPDX-License-Identifier: GPL-2.0-or-later
"""The command `icwafer layout import`.

Nothing is imported before it is needed: the command may have to install numpy first.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path

from icwafer import packages
from icwafer.errors import IcwaferError

AddAction = Callable[[str, str], argparse.ArgumentParser]


def add_reading_options(command: argparse.ArgumentParser) -> None:
    """Adds the options that say how a chip's file is to be understood."""
    command.add_argument(
        "--layers",
        default="sky130",
        metavar="PROCESS",
        help="the process whose layers these are: a built-in one or a layer map, MAP.toml",
    )
    command.add_argument(
        "--lef", type=Path, action="append", default=[], metavar="FILE", help="a LEF for a DEF"
    )
    command.add_argument("--top", metavar="CELL", help="the cell to read; default: the top one")


def register(add_action: AddAction) -> None:
    """Adds the action `import`; `add_action` makes a parser from a name and a description."""
    command = add_action("import", "make a layout from a chip's GDSII, OASIS or DEF file")
    command.add_argument("file", type=Path, metavar="FILE", help="also compressed, as .gds.gz")
    command.add_argument("-o", "--output", type=Path, metavar="FILE", help="NAME.layout.toml")
    add_reading_options(command)
    command.add_argument(
        "--tile",
        type=_length,
        metavar="UM",
        help="side of a tile; default 25, or for large chips what gives 500 tiles",
    )
    command.add_argument(
        "--window",
        type=_length,
        metavar="UM",
        help="side of what is looked at in the middle of each tile; default: the tile, at most 50",
    )
    command.add_argument("--map", type=Path, metavar="PICTURE", help="also draw what was found")
    command.add_argument("--limit-gb", type=_limit, metavar="GB", help="memory to read the file")
    command.add_argument("--limit-s", type=_limit, metavar="S", help="computing to read the file")
    command.set_defaults(run=_import)


def _length(text: str) -> float:
    return _between(text, 1.0, 10_000.0)


def _limit(text: str) -> float:
    return _between(text, 1.0, 1e6)


def _between(text: str, low: float, high: float) -> float:
    try:
        value = float(text)
    except ValueError:
        value = float("nan")
    if not low <= value <= high:
        raise argparse.ArgumentTypeError(f"'{text}' is not a number from {low:g} to {high:g}")
    return value


def _import(arguments: argparse.Namespace) -> int:
    packages.install("layout", "import")
    from icwafer.chips.document import ENDING, write_layout
    from icwafer.layout_import.importer import import_layout
    from icwafer.layout_import.process import read_process
    from icwafer.layout_import.reader import Limits, Request

    source: Path = arguments.file
    output = arguments.output or Path(source.name.split(".")[0] + ENDING)
    if not output.name.endswith(ENDING):
        raise IcwaferError(f"{output}: a layout's name ends with {ENDING}; add that")
    if arguments.map and arguments.map.suffix != ".png":
        raise IcwaferError(f"{arguments.map}: a map's name ends with .png; add that")
    limits = Limits(
        arguments.limit_gb or Limits.memory_gb, round(arguments.limit_s or Limits.seconds)
    )
    imported = import_layout(
        Request(
            path=source,
            process=read_process(arguments.layers),
            tile_um=arguments.tile,
            window_um=arguments.window,
            top=arguments.top,
            lef=tuple(arguments.lef),
            limits=limits,
        )
    )
    write_layout(output, imported.layout)
    print(output)
    if arguments.map:
        from icwafer.layout_import.map_picture import write_map

        write_map(arguments.map, imported.layout)
        print(arguments.map)
    return 0
