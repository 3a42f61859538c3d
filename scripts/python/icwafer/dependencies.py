# SPDX-License-Identifier: GPL-2.0-or-later
"""What a script of this package depends on: when that changes, its results are made anew."""

from __future__ import annotations

import ast
import hashlib
from collections.abc import Iterator
from functools import cache
from pathlib import Path

PACKAGE = Path(__file__).resolve().parent


def imported(script: Path) -> list[Path]:
    """A script and the files of all modules of this package that it imports, sorted."""
    found: set[Path] = set()
    waiting = [script]
    while waiting:
        path = waiting.pop()
        if path not in found:
            found.add(path)
            waiting += _imports(path)
    return sorted(found)


@cache
def scripts_hash(script: Path) -> str:
    """SHA-256 of a script and of all modules of this package that it imports."""
    digest = hashlib.sha256()
    for path in imported(script):
        digest.update(path.relative_to(PACKAGE).as_posix().encode() + b"\0" + path.read_bytes())
    return digest.hexdigest()


@cache
def file_hash(path: Path) -> str:
    """SHA-256 of a file's content, read once in the life of this process."""
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def _imports(path: Path) -> Iterator[Path]:
    """The files of the package's modules that a file names in import statements."""
    for node in ast.walk(ast.parse(path.read_bytes())):
        names: list[str] = []
        if isinstance(node, ast.ImportFrom) and node.module:
            names = [node.module, *(f"{node.module}.{alias.name}" for alias in node.names)]
        elif isinstance(node, ast.Import):
            names = [alias.name for alias in node.names]
        for name in names:
            first, *rest = name.split(".")
            if first == PACKAGE.name:
                base = PACKAGE.joinpath(*rest)
                candidates = [base / "__init__.py", *([base.with_suffix(".py")] if rest else [])]
                yield from (candidate for candidate in candidates if candidate.is_file())
