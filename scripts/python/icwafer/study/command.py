# SPDX-License-Identifier: GPL-2.0-or-later
"""The command `icwafer render`.

What needs numpy or OpenImageIO is imported when it is used: a bare machine has neither.
"""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from icwafer import packages, paths
from icwafer.errors import IcwaferError
from icwafer.progress import duration

if TYPE_CHECKING:
    from icwafer.study.order import Order
    from icwafer.study.plan import Plan

#: The studies that come with the project.
STUDIES = paths.REPOSITORY / "scripts" / "studies"
SHOWN_JOBS = 20


def register(add: Callable[[str, str], argparse.ArgumentParser]) -> None:
    """Adds the command; `add(name, help)` makes its parser."""
    command = add("render", "render a study: one file that says which images, see the README")
    command.add_argument(
        "study",
        nargs="?",
        type=Path,
        metavar="STUDY.toml",
        help="or an EXR file that a study has made, to render it again",
    )
    command.add_argument("-o", "--output", type=Path, metavar="DIR", help="folder of the results")
    command.add_argument(
        "--all",
        action="store_true",
        help="render all studies of the project, each to a folder of its name in DIR "
        "(if there is no -o: out/studies)",
    )
    command.add_argument("--dry-run", action="store_true", help="only say what would be done")
    command.add_argument(
        "--set",
        dest="settings",
        action="append",
        default=[],
        metavar="SETTING=VALUE",
        help="for all images, such as render.samples=4",
    )
    command.add_argument(
        "--settings", dest="list", action="store_true", help="list all settings of a scene"
    )
    command.add_argument(
        "--only", action="append", default=[], metavar="JOB", help="only this job of the study"
    )
    command.add_argument(
        "--jobs",
        type=_count,
        default=1,
        metavar="N",
        help="images that are rendered at the same time (%(default)s); they share the cores",
    )
    command.add_argument(
        "--isolate", action="store_true", help="start Blender anew for every image"
    )
    command.add_argument(
        "--timeout",
        type=_seconds,
        default=3600.0,
        metavar="S",
        help="for one image (%(default)g s)",
    )
    command.add_argument("--engine", choices=("local", "slurm"), default="local")
    command.add_argument(
        "--sbatch",
        action="append",
        default=[],
        metavar="OPTION",
        help="for Slurm's sbatch, such as --sbatch=--partition=long",
    )
    command.set_defaults(run=_run)


def _count(text: str) -> int:
    if not text.isdigit() or not 1 <= int(text) <= 1024:
        raise argparse.ArgumentTypeError(f"{text!r} is not a number from 1 to 1024")
    return int(text)


def _seconds(text: str) -> float:
    try:
        seconds = float(text)
    except ValueError:
        seconds = 0.0
    if not 0 < seconds < 1e9:
        raise argparse.ArgumentTypeError(f"{text!r} is not a number of seconds above 0")
    return seconds


def _run(arguments: argparse.Namespace) -> int:
    packages.install("base", "images")
    if arguments.list:
        _list_settings()
        return 0
    orders = _orders(arguments)
    if len(orders) == 1:
        return _one(orders[0], arguments)
    return max([_one_of_all(order, arguments) for order in orders])


def _list_settings() -> None:
    from icwafer.study import fields

    for name, rule in fields.rules().items():
        allowed = rule.range if rule.low > -float("inf") else ""
        print(f"{name:34}  {allowed:20}  {rule.help.split('. ')[0]}")


def _orders(arguments: argparse.Namespace) -> Sequence[Order]:
    from icwafer.study.order import Order

    if arguments.all == bool(arguments.study):
        raise IcwaferError("name one study, or --all; see scripts/icwafer render --help")
    output = arguments.output
    if arguments.all:
        folder = output or paths.OUT / "studies"
        pairs = [(study, folder / study.stem) for study in sorted(STUDIES.glob("*.toml"))]
    elif output is None and not arguments.dry_run:
        raise IcwaferError("say where the results go: -o DIR")
    else:
        pairs = [(arguments.study, output or paths.OUT / "studies" / arguments.study.stem)]
    return [
        Order(
            study.resolve(),
            folder.resolve(),
            Path(os.environ.get("ICWAFER_BLENDER") or paths.BLENDER).resolve(),
            tuple(arguments.settings),
            tuple(arguments.only),
            arguments.jobs,
            arguments.isolate,
            arguments.timeout,
        )
        for study, folder in pairs
    ]


def _one_of_all(order: Order, arguments: argparse.Namespace) -> int:
    """A study that is not possible does not keep the others from being rendered."""
    try:
        return _one(order, arguments)
    except IcwaferError as error:
        print(f"icwafer: {error}", file=sys.stderr)
        return 1


def _one(order: Order, arguments: argparse.Namespace) -> int:
    from icwafer.study import run, slurm

    made = run.prepare(order)
    if arguments.dry_run:
        run.judge(order, made)
        _describe(order, made)
        return 0
    engine = run.render_here
    if arguments.engine == "slurm":
        engine = slurm.engine(tuple(arguments.sbatch))
    summary = run.render(order, made, engine)
    for outcome in summary.failed:
        log = order.folder / "jobs" / outcome.job.id / "log.txt"
        print(f"failed: {outcome.job.id}: {outcome.error} ({log})")
    print(
        f"{order.folder}: {summary.rendered} rendered, {summary.present} were there, "
        f"{len(summary.failed)} failed"
    )
    return 1 if summary.failed else 0


def _describe(order: Order, made: Plan) -> None:
    from icwafer.study import run

    jobs = run.missing(order, made)
    for job in jobs[:SHOWN_JOBS]:
        print(job.id)
    if len(jobs) > SHOWN_JOBS:
        print(f"... and {len(jobs) - SHOWN_JOBS} more")
    seconds = run.estimate_s(order, made, jobs)
    guess = "not known" if seconds is None else f"about {duration(seconds)}"
    print(f"{len(jobs)} of {len(made.jobs)} images are to be rendered: {guess}")
