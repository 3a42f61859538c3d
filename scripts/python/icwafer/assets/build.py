# SPDX-License-Identifier: GPL-2.0-or-later
"""Builds the asset library with the built Blender and puts it into that Blender's folder.

Each file is made anew only when its sources, the scripts that make it or Blender have changed.
"""

from __future__ import annotations

import hashlib
import shutil
from pathlib import Path

from icwafer import dependencies, paths, render
from icwafer.assets import catalogs, materials
from icwafer.assets.plan import KINDS, installed_folder
from icwafer.errors import IcwaferError
from icwafer.files import replacing
from icwafer.study.fields import check

SOURCES = paths.REPOSITORY / "blend_assets" / "library"
BUILT = paths.BUILD / "assets"
SCRIPT = paths.REPOSITORY / "scripts" / "python" / "icwafer" / "scene" / "library" / "write.py"


def check_sources(folder: Path) -> None:
    """Raises IcwaferError for the first mistake in the table of materials or the catalogs."""
    known = catalogs.read_catalogs(folder / catalogs.FILE_NAME)
    for preset in materials.read_materials(folder / materials.FILE_NAME, check):
        if preset.catalog not in known:
            raise IcwaferError(
                f"{folder / catalogs.FILE_NAME}: no catalog '{preset.catalog}', "
                f"which the material '{preset.name}' stands in: add it"
            )


def build() -> list[Path]:
    """Brings the library up to date and installs it. Returns its files, as installed.

    Raises IcwaferError where Blender is not built, or for a mistake in the sources.
    """
    render.expect_blender()
    check_sources(SOURCES)
    BUILT.mkdir(parents=True, exist_ok=True)
    files = [_build_kind(kind) for kind in KINDS]
    return [_install(file) for file in (*sorted(SOURCES.iterdir()), *files)]


def _build_kind(kind: str) -> Path:
    """The up to date file of a kind of assets."""
    file, stamp = BUILT / f"{kind}.blend", BUILT / f"{kind}.sha256"
    fingerprint = _fingerprint(kind)
    if file.is_file() and stamp.is_file() and stamp.read_text() == fingerprint:
        return file
    with replacing(file) as unfinished:
        render.run_script(
            f"Asset library: {kind}",
            paths.BLENDER,
            SCRIPT,
            [kind, SOURCES, unfinished],
            paths.LOGS / f"assets-{kind}.log",
        )
    with replacing(stamp) as unfinished:
        unfinished.write_text(fingerprint)
    return file


def _fingerprint(kind: str) -> str:
    """SHA-256 of all that decides what is in a file."""
    digest = hashlib.sha256()
    for script in (SCRIPT, SCRIPT.with_name(f"{kind}.py")):
        digest.update(dependencies.scripts_hash(script).encode())
    tables = [catalogs.FILE_NAME, *([materials.FILE_NAME] if kind == "materials" else [])]
    for file in (*(SOURCES / table for table in tables), paths.BLENDER):
        digest.update(dependencies.file_hash(file).encode())
    return digest.hexdigest()


def _install(file: Path) -> Path:
    """Copies a file into the installed library, if it is another one."""
    target = installed_folder() / file.name
    target.parent.mkdir(parents=True, exist_ok=True)
    if not target.is_file() or target.read_bytes() != file.read_bytes():
        with replacing(target) as unfinished:
            shutil.copyfile(file, unfinished)
    return target
