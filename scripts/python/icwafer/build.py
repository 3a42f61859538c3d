# SPDX-License-Identifier: GPL-2.0-or-later
"""Builds the targets `core`, `cycles` and `blender`; each only as far as something changed."""

from __future__ import annotations

import os
import re
import shutil
from collections.abc import Mapping
from pathlib import Path

from icwafer import packages, paths, progress, source
from icwafer.errors import IcwaferError

TARGETS = ("core", "cycles", "blender")
#: CMake variables that a user may set, as `-DNAME=VALUE`.
OPTIONS = ("ICWAFER_FULL", "ICWAFER_BLENDER_SOURCE")
#: Free space that a build from nothing needs, in GB: measured 0.02, 0.5 and 1.6, and some room.
SPACE_GB = {"core": 0.2, "cycles": 1.0, "blender": 2.5}
#: Memory that one compiler may take, in GB.
COMPILER_GB = {False: 0.9, True: 3.0}

_CMAKE_TRUE = ("1", "ON", "YES", "TRUE", "Y")


def definitions(words: list[str]) -> dict[str, str]:
    """Reads `NAME=VALUE` words; an unknown name or a folder that is not there is an error."""
    result: dict[str, str] = {}
    for word in words:
        name, equals, value = word.partition("=")
        if name not in OPTIONS or not equals:
            known = " or ".join(f"-D{option}=..." for option in OPTIONS)
            raise IcwaferError(f"unknown option -D{word}: write {known}")
        if name == "ICWAFER_BLENDER_SOURCE" and value:
            if not Path(value).is_dir():
                raise IcwaferError(f"{value}: no such folder; name a Blender source tree")
            value = str(Path(value).resolve())
        result[name] = value
    return result


def cached_option(name: str) -> str:
    """The value of a CMake variable in the host's build folder; empty before the first build."""
    cache = paths.BUILD / "host" / "CMakeCache.txt"
    text = cache.read_text(encoding="utf-8") if cache.is_file() else ""
    match = re.search(rf"^{name}:\w+=(.*)$", text, re.MULTILINE)
    return match[1] if match else ""


def is_full(options: Mapping[str, str]) -> bool:
    """Whether Blender is built with everything that Debian's package has."""
    value = options.get("ICWAFER_FULL", cached_option("ICWAFER_FULL"))
    return value.upper() in _CMAKE_TRUE


def free_gb(folder: Path) -> float:
    """Free space where a folder is, in GB."""
    return shutil.disk_usage(folder).free / 1e9


def build(target: str, options: Mapping[str, str] | None = None) -> None:
    """Brings a target up to date: packages, source, edits, configuration, compilation, install."""
    options = options or {}
    if target == "core":
        packages.install("base", "images", "core", "layout")
        _expect_space(target, paths.BUILD / "core" / "build.ninja")
        _configure(target, options)
        _compile(target, paths.BUILD / "core", {})
        return
    full = is_full(options)
    packages.install("base", "images", "host", *(["full"] if full else []))
    program = paths.CYCLES if target == "cycles" else paths.BLENDER
    _expect_space(target, program)
    origin = options.get("ICWAFER_BLENDER_SOURCE", cached_option("ICWAFER_BLENDER_SOURCE"))
    source.provide(Path(origin) if origin else None)
    _configure(target, options)
    # The host's own ninja counts; the one around it keeps quiet.
    _compile(target, paths.BUILD / "host", {"NINJA_STATUS": "- ", **_parallel(full)})
    progress.run(
        f"Installing to {paths.INSTALLED.relative_to(paths.REPOSITORY)}",
        ["cmake", "--install", paths.BUILD / "host"],
        paths.LOGS / f"{target}-install.log",
    )


def _expect_space(target: str, product: Path) -> None:
    free, needed = free_gb(paths.REPOSITORY), SPACE_GB[target]
    if not product.exists() and free < needed:
        raise IcwaferError(
            f"{paths.REPOSITORY}: {free:.1f} GB free, but building {target} needs {needed:g} GB; "
            "make room and run the same command again"
        )


def _configure(target: str, options: Mapping[str, str]) -> None:
    progress.run(
        f"Configuring {target}",
        [
            "cmake",
            "-S",
            paths.REPOSITORY,
            "--preset",
            target,
            *(f"-D{name}={value}" for name, value in options.items()),
        ],
        paths.LOGS / f"{target}-configure.log",
    )


def _compile(target: str, folder: Path, environment: Mapping[str, str]) -> None:
    progress.run(
        f"Building {target}",
        ["cmake", "--build", folder],
        paths.LOGS / f"{target}-build.log",
        environment,
        "mend this and run the same command again: what is built stays",
    )


def _parallel(full: bool) -> dict[str, str]:
    """Fewer compilers at a time where memory is short; else ninja's own choice."""
    memory_gb = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 1e9
    jobs = max(1, int(memory_gb / COMPILER_GB[full]))
    enough = jobs >= (os.cpu_count() or 1) + 2
    return {} if enough else {"CMAKE_BUILD_PARALLEL_LEVEL": str(jobs)}
