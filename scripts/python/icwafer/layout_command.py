# SPDX-License-Identifier: GPL-2.0-or-later
"""The command `icwafer layout`: makes, imports, shows and checks layout files.

Nothing is imported before it is needed: the command may have to install numpy first.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path

from icwafer import packages
from icwafer.errors import IcwaferError
from icwafer.layout_import import command as import_command

AddCommand = Callable[[str, str], argparse.ArgumentParser]


def register(add: AddCommand) -> None:
    """Adds the command `layout`; `add` makes a parser from a name and a description."""
    layout = add("layout", "make, import, show or check a layout file of chips and wafers")
    actions = layout.add_subparsers(dest="action", required=True, metavar="ACTION")

    def add_action(name: str, text: str) -> argparse.ArgumentParser:
        return actions.add_parser(name, help=text, description=text, allow_abbrev=False)

    new = add_action("new", "write the layout of a preset")
    new.add_argument("preset", metavar="PRESET", help="a kind of chip; 'list' names them all")
    new.add_argument("-o", "--output", type=Path, metavar="FILE", help="NAME.layout.toml")
    new.add_argument("--seed", metavar="N", help="other blocks of the same kind")
    new.add_argument(
        "--set",
        dest="settings",
        action="append",
        default=[],
        metavar="KEY=VALUE",
        help="change a field: width_mm=12, wafer.diameter_mm=200, groups[cache].turned=0.5",
    )
    new.set_defaults(run=_new)

    show = add_action("show", "print what a layout holds")
    show.add_argument("file", type=Path, metavar="FILE")
    show.add_argument("--plot", type=Path, metavar="PICTURE", help="draw it, as .svg or .png")
    show.set_defaults(run=_show)

    import_command.register(add_action)

    check = add_action("check", "read layouts and make their dies; the first error ends it")
    check.add_argument("files", type=Path, nargs="+", metavar="FILE")
    check.set_defaults(run=_check)


def _new(arguments: argparse.Namespace) -> int:
    packages.install("layout")
    from icwafer.chips.die import generate
    from icwafer.chips.document import ENDING, write_layout
    from icwafer.chips.presets import PRESETS
    from icwafer.chips.settings import changed
    from icwafer.suggest import unknown

    if arguments.preset == "list":
        print("\n".join(PRESETS))
        return 0
    if arguments.preset not in PRESETS:
        raise IcwaferError(unknown("preset", arguments.preset, PRESETS))
    path = arguments.output or Path(arguments.preset + ENDING)
    if not path.name.endswith(ENDING):
        raise IcwaferError(f"{path}: a layout's name ends with {ENDING}; add that")
    seeds = [] if arguments.seed is None else [f"seed={arguments.seed}"]
    layout = changed(PRESETS[arguments.preset], [*seeds, *arguments.settings])
    for spec in layout.dies:
        generate(spec)  # a die may be too small for its floorplan
    write_layout(path, layout)
    print(path)
    return 0


def _show(arguments: argparse.Namespace) -> int:
    packages.install("layout")
    from icwafer.chips.document import read_layout
    from icwafer.chips.summary import summary

    layout = read_layout(arguments.file)
    for line in summary(layout):
        print(line)
    if arguments.plot:
        from icwafer.chips.plot import plot

        plot(layout, arguments.plot)
        print(arguments.plot)
    return 0


def _check(arguments: argparse.Namespace) -> int:
    packages.install("layout")
    from icwafer.chips.die import generate
    from icwafer.chips.document import read_layout

    for path in arguments.files:
        dies = [generate(spec) for spec in read_layout(path).dies]
        print(f"{path}: good, {len(dies)} dies, {sum(map(len, dies))} blocks")
    return 0
