# SPDX-License-Identifier: GPL-2.0-or-later
"""The command line: thin over the functions of the package.

Exit status: 0 if all went well, 1 for an error (one line on stderr), 2 for a wrong command line,
130 after Ctrl-C, 141 where who reads the output has gone; `test` passes on ctest's, `compare` has
its own (see its --help).
"""

from __future__ import annotations

import argparse
import errno
import logging
import os
import signal
import subprocess
import sys
from pathlib import Path
from typing import NoReturn

from icwafer import (
    build,
    doctor,
    layout_command,
    packages,
    paths,
    pictures_command,
    render,
    source,
)
from icwafer.assets import command as assets_command
from icwafer.compare import command as compare_command
from icwafer.compare import merge as merge_command
from icwafer.errors import IcwaferError
from icwafer.portrait import command as portrait_command
from icwafer.report import animate as animate_command
from icwafer.report import command as report_command
from icwafer.study import command as study_command


class _UsageError(Exception):
    """A wrong command line."""


class _Parser(argparse.ArgumentParser):
    def error(self, message: str) -> NoReturn:
        raise _UsageError(f"{message}; see {self.prog} --help")


def _demo(arguments: argparse.Namespace) -> int:
    build.build("blender", build.definitions(arguments.definitions))
    for path in render.render("full", paths.OUT / "demo" / "wafer"):
        print(path)
    return 0


def _build(arguments: argparse.Namespace) -> int:
    build.build(arguments.target, build.definitions(arguments.definitions))
    if arguments.target == "blender":
        assets_command.build_library()
    return 0


def _source(arguments: argparse.Namespace) -> int:
    print(source.provide(Path(arguments.origin) if arguments.origin else None))
    return 0


def _doctor(_: argparse.Namespace) -> int:
    failed = False
    for check in doctor.checks():
        finding = doctor.examine(check)
        print(finding, flush=True)
        failed |= bool(finding.mend)
    return int(failed)


def _test(arguments: list[str]) -> int:
    # At once, so that root is asked for once.
    packages.install("base", "images", "core", "host", "layout", "import", "test")
    build.build("core")
    build.build("blender")
    assets_command.build_library()
    return subprocess.run(
        ["ctest", "--preset", "core", *arguments], cwd=paths.REPOSITORY
    ).returncode


def _blender(arguments: list[str]) -> int:
    render.expect_blender()
    os.execv(paths.BLENDER, [str(paths.BLENDER), *arguments])


#: Commands that hand all their arguments on.
_HANDED_ON = {"test": _test, "blender": _blender}


def _parser() -> _Parser:
    parser = _Parser(
        prog="scripts/icwafer",
        description="Silicon wafers in Blender: builds the node, makes dies and renders them.",
        allow_abbrev=False,
    )
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")

    def add(name: str, text: str) -> argparse.ArgumentParser:
        return commands.add_parser(name, help=text, description=text, allow_abbrev=False)

    def add_definitions(command: argparse.ArgumentParser) -> None:
        command.add_argument(
            "-D",
            dest="definitions",
            action="append",
            default=[],
            metavar="NAME=VALUE",
            help=f"option of the build: {' or '.join(build.OPTIONS)}",
        )

    demo = add("demo", "build what is missing and render out/demo/wafer.png")
    add_definitions(demo)
    demo.set_defaults(run=_demo)
    add("test", "build what is missing and run all tests; arguments go to ctest")
    build_command = add("build", "build the material's tests, the cycles program or Blender")
    build_command.add_argument("target", nargs="?", default="blender", choices=build.TARGETS)
    add_definitions(build_command)
    build_command.set_defaults(run=_build)
    add("blender", "start the built Blender; arguments go to it")
    add("doctor", "check dependencies, source edits and build").set_defaults(run=_doctor)
    layout_command.register(add)
    portrait_command.register(add)
    assets_command.register(add)
    pictures_command.register(add)
    study_command.register(add)
    source_command = add("source", "unpack the host's source and apply the edits")
    source_command.add_argument(
        "--from", dest="origin", metavar="DIR", help="tree to copy instead"
    )
    source_command.set_defaults(run=_source)
    compare_command.register(add)
    merge_command.register(add)
    report_command.register(add)
    animate_command.register(add)
    return parser


def _run(argv: list[str]) -> int:
    if argv and argv[0] in _HANDED_ON:
        return _HANDED_ON[argv[0]](argv[1:])
    arguments = _parser().parse_args(argv)
    return arguments.run(arguments)


def _interrupt(*_: object) -> NoReturn:
    raise KeyboardInterrupt


def main(argv: list[str]) -> int:
    """Runs a command and returns its exit status; every error is one line on stderr."""
    logging.basicConfig(level=logging.INFO, format="%(message)s", stream=sys.stdout)
    signal.signal(signal.SIGTERM, _interrupt)
    try:
        try:
            return _run(argv)
        finally:
            sys.stdout.flush()
    except BrokenPipeError:
        # Who reads has seen enough, as `head` does; the rest goes nowhere, also at the exit.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 128 + signal.SIGPIPE
    except KeyboardInterrupt:
        message, status = "interrupted; the same command goes on where it stopped", 130
    except _UsageError as error:
        message, status = str(error), 2
    except IcwaferError as error:
        message, status = str(error), error.status
    except source.host_edits.HostEditError as error:
        message, status = str(error), 1
    except OSError as error:
        mend = "make room" if error.errno in (errno.ENOSPC, errno.EDQUOT) else "mend this"
        where = f"{error.filename}: " if error.filename else ""
        message = f"{where}{error.strerror}; {mend} and run the same command again"
        status = 1
    print(f"icwafer: {message}", file=sys.stderr)
    return status
