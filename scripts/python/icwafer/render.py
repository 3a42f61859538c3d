# SPDX-License-Identifier: GPL-2.0-or-later
"""Renders the project's pictures with the built Blender."""

from __future__ import annotations

import logging
import os
import shutil
from collections.abc import Sequence
from pathlib import Path

from icwafer import paths, progress
from icwafer.dependencies import imported
from icwafer.errors import IcwaferError

_log = logging.getLogger(__name__)

SCRIPT = Path(__file__).with_name("render_picture.py")


def expect_blender() -> None:
    """Raises `IcwaferError` unless Blender is built."""
    if not paths.BLENDER.is_file():
        raise IcwaferError("Blender is not built yet; run scripts/icwafer build blender")


def blender() -> Path:
    """The program to render with: the one that ICWAFER_BLENDER names, or the built one.

    Raises `IcwaferError` where there is none.
    """
    named = os.environ.get("ICWAFER_BLENDER")
    if named and not Path(named).is_file():
        raise IcwaferError(f"{named}: no such file; ICWAFER_BLENDER must name a Blender")
    if not named:
        expect_blender()
    return Path(named or paths.BLENDER).resolve()


def run_script(
    title: str, program: Path, script: Path, arguments: Sequence[str | Path], log: Path
) -> None:
    """Runs a script inside Blender, with its progress under a title. Raises `IcwaferError`."""
    progress.run(
        title,
        [program, "-b", "--factory-startup", "--python-exit-code", "1", "-P", script, "--"]
        + [*arguments],
        log,
        advice="scripts/icwafer doctor checks Blender",
    )


def render(name: str, base: Path) -> tuple[Path, Path]:
    """Renders the picture `name` to `base`.png and `base`.exr, unless both are up to date.

    The files appear complete or not at all.
    """
    expect_blender()
    finished = (base.with_suffix(".png"), base.with_suffix(".exr"))
    if _up_to_date(finished):
        _log.info("Picture %s is up to date", name)
        return finished
    unfinished = base.with_name("unfinished") / base.name
    unfinished.parent.mkdir(parents=True, exist_ok=True)
    run_script(
        f"Rendering {name}",
        paths.BLENDER,
        SCRIPT,
        [name, "--output", unfinished],
        paths.LOGS / f"render-{name}.log",
    )
    for path in finished:
        unfinished.with_suffix(path.suffix).replace(path)
    shutil.rmtree(unfinished.parent)
    return finished


def _up_to_date(products: tuple[Path, ...]) -> bool:
    if not all(product.is_file() for product in products):
        return False
    newest = max(path.stat().st_mtime for path in (paths.BLENDER, *imported(SCRIPT)) if path.exists())
    return min(product.stat().st_mtime for product in products) >= newest
