# SPDX-License-Identifier: GPL-2.0-or-later
"""The subcommand `icwafer report`."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path

from icwafer import paths
from icwafer.errors import IcwaferError


def register(add: Callable[[str, str], argparse.ArgumentParser]) -> None:
    """Adds the subcommand; `add` makes a parser of a name and a help text."""
    parser = add("report", "one HTML page on which the renders of a study are compared")
    parser.add_argument(
        "folder", type=Path, nargs="?", metavar="DIR", help="what icwafer render wrote"
    )
    parser.add_argument(
        "--all",
        action="store_true",
        help="reports of all studies in DIR (if there is none: out/studies), and an index of them",
    )
    parser.add_argument(
        "-o", "--output", type=Path, metavar="FILE", help="the page; DIR/report.html"
    )
    add_view_options(parser)
    parser.add_argument(
        "--no-hdr-flip", dest="hdr", action="store_false", help="leave out what takes longest"
    )
    parser.add_argument(
        "--megabytes",
        type=float,
        default=64.0,
        metavar="N",
        help="roughly the page's size at most; pictures are embedded smaller if need be (64)",
    )
    parser.set_defaults(run=_run)


def add_view_options(parser: argparse.ArgumentParser) -> None:
    """How scene-linear images are shown, and from how far they are seen."""
    group = parser.add_argument_group("view")
    group.add_argument(
        "--ocio",
        type=Path,
        metavar="FILE",
        help="OpenColorIO configuration; else $OCIO, else Blender's own",
    )
    group.add_argument("--view", metavar="NAME", help="view transform; else its default")
    group.add_argument("--look", metavar="NAME", help="look of the view transform")
    group.add_argument(
        "--ppd",
        type=float,
        metavar="N",
        help="pixels per degree of visual angle, the viewing distance of FLIP and Yee "
        "(67: a 24 inch 4K screen from 0.7 m)",
    )


def _run(arguments: argparse.Namespace) -> int:
    from icwafer import packages

    packages.install("images")
    from icwafer.compare.flip import DEFAULT_PIXELS_PER_DEGREE
    from icwafer.report import overview, page, study

    if arguments.all:
        _refuse(arguments, "output", "view", "look")
        for path in overview.write(
            arguments.folder or paths.OUT / "studies",
            config=arguments.ocio,
            ppd=arguments.ppd or DEFAULT_PIXELS_PER_DEGREE,
            hdr=arguments.hdr,
            largest_mb=arguments.megabytes,
        ):
            print(path)
        return 0
    if arguments.folder is None:
        raise IcwaferError("name the folder that icwafer render wrote, or give --all")
    loaded = study.load(arguments.folder)
    for path in page.write(
        loaded,
        arguments.output or arguments.folder / "report.html",
        config=arguments.ocio,
        view=arguments.view,
        look=arguments.look,
        ppd=arguments.ppd or DEFAULT_PIXELS_PER_DEGREE,
        hdr=arguments.hdr,
        largest_mb=arguments.megabytes,
    ):
        print(path)
    return 0


def _refuse(arguments: argparse.Namespace, *options: str) -> None:
    for option in options:
        if getattr(arguments, option) is not None:
            raise IcwaferError(f"--{option} is for one report; leave it out with --all")
