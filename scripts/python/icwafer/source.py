# SPDX-License-Identifier: GPL-2.0-or-later
"""The host's source tree: Debian's source package, or a copy of a tree that the user names.

The package is fetched with apt, but with sources, lists and cache of our own: nothing under /etc
changes and no root is needed. It stays in the cache folder with the checksums of the signed index,
against which every file is checked before it is unpacked. Trees appear at their place complete or
not at all.
"""

from __future__ import annotations

import hashlib
import logging
import os
import pwd
import re
import shutil
import subprocess
import sys
from pathlib import Path

from icwafer import apt_sources, paths, progress
from icwafer.errors import IcwaferError

sys.path.insert(0, str(paths.PLUGIN))
import host_edits  # noqa: E402

_log = logging.getLogger(__name__)

PACKAGE = "blender"
SUITES = ("bookworm", "stable", "oldstable")
SUMS = "SHA256SUMS"


def provide(origin: Path | None = None) -> Path:
    """Makes sure that the source tree is there, with our edits up to date, and returns it.

    `origin` is a tree of the same version to copy; None means Debian's source package. A tree that
    is there and came from elsewhere is replaced.
    """
    tree = paths.host_source()
    note = tree.with_name(f"{tree.name}.origin")
    wanted = str(origin.resolve()) if origin else f"Debian's source package {PACKAGE}"
    if not (tree.is_dir() and _read(note) == wanted):
        note.unlink(missing_ok=True)
        if origin:
            _copy(origin, tree)
        else:
            _unpack(fetch(paths.cache_folder() / "source"), tree)
        note.write_text(wanted, encoding="utf-8")
    changed = host_edits.apply(tree, paths.HOST)
    if changed:
        _log.info("%d files of the source edited or brought up to date", len(changed))
    return tree


def _read(path: Path) -> str:
    return path.read_text(encoding="utf-8") if path.is_file() else ""


def _expect_version(tree: Path) -> None:
    version = host_edits.tree_version(tree)
    if version != paths.host_version():
        raise IcwaferError(
            f"{tree}: Blender {version}, but the node is for {paths.host_version()}; "
            "name a tree of that version with ICWAFER_BLENDER_SOURCE"
        )


def _replace_tree(new: Path, tree: Path) -> None:
    if tree.exists():
        old = tree.with_name(f"{tree.name}.old")
        shutil.rmtree(old, ignore_errors=True)
        tree.rename(old)
        shutil.rmtree(old)
    new.rename(tree)


def _staging(tree: Path) -> Path:
    """An absent path beside `tree`, of which nothing is left from an interrupted run."""
    staging = tree.with_name(f"{tree.name}.new")
    shutil.rmtree(staging, ignore_errors=True)
    staging.parent.mkdir(parents=True, exist_ok=True)
    return staging


def _copy(origin: Path, tree: Path) -> None:
    _expect_version(origin)
    staging = _staging(tree)
    _log.info("Copying %s", origin)
    try:
        shutil.copytree(origin, staging, symlinks=True, ignore=shutil.ignore_patterns(".git"))
    except OSError as error:
        shutil.rmtree(staging, ignore_errors=True)
        # copytree goes on after an error and raises the list of all: the first says enough.
        reason = error.args[0][0][2] if isinstance(error, shutil.Error) else error
        raise IcwaferError(
            f"{origin}: cannot be copied to {tree} ({reason}); mend this and run the same command "
            "again"
        ) from None
    _replace_tree(staging, tree)


# Debian's source package ------------------------------------------------------------------------


def fetch(folder: Path) -> Path:
    """Downloads Debian's source package into `folder`, unless it is there, and returns its .dsc.

    What is there is checked against the checksums of the signed index, which are kept beside it.
    """
    if not (folder / SUMS).is_file():
        _download(folder)
    return _verified(folder)


def _verified(folder: Path) -> Path:
    """Checks every file against its checksum; a wrong one is removed, to be fetched again."""
    dsc: Path | None = None
    for line in (folder / SUMS).read_text(encoding="utf-8").splitlines():
        expected, _, name = line.partition("  ")
        path = folder / name
        if not path.is_file() or _sha256(path) != expected:
            path.unlink(missing_ok=True)
            (folder / SUMS).unlink()
            raise IcwaferError(
                f"{path}: not the file that Debian's index names; it was removed, run the same "
                "command again to download it"
            )
        if name.endswith(".dsc"):
            dsc = path
    if dsc is None:
        (folder / SUMS).unlink()
        raise IcwaferError(f"{folder}: no .dsc in it; run the same command again to download it")
    return dsc


def _sha256(path: Path) -> str:
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def _private_apt(folder: Path) -> list[str | Path]:
    """apt's options that keep its sources, lists and cache inside `folder`."""
    apt = folder / "apt"
    for name in ("lists/partial", "cache/archives/partial"):
        (apt / name).mkdir(parents=True, exist_ok=True)
    sources = apt / "sources.list"
    lines = [
        origin.deb_src_line()
        for origin in apt_sources.origins(apt_sources.configured_files(), SUITES)
    ]
    sources.write_text("\n".join(lines) + "\n", encoding="utf-8")
    settings = {
        "Dir::Etc::sourcelist": sources,
        "Dir::Etc::sourceparts": "-",
        "Dir::State::Lists": apt / "lists",
        "Dir::Cache": apt / "cache",
        "APT::Sandbox::User": pwd.getpwuid(os.getuid()).pw_name,
        "Acquire::Languages": "none",
        "Acquire::Retries": "3",
    }
    return [word for name, value in settings.items() for word in ("-o", f"{name}={value}")]


def _download(folder: Path) -> None:
    options = _private_apt(folder)
    advice = "check the network and apt's sources, then run the same command again"
    environment = {"LC_ALL": "C"}
    text = progress.run(
        "Index of Debian's source packages",
        ["apt-get", "-q", *options, "update"],
        paths.LOGS / "source-index.log",
        environment,
        advice,
    )
    records = subprocess.run(
        ["apt-cache", *map(str, options), "showsrc", "--only-source", PACKAGE],
        capture_output=True,
        text=True,
        env={**os.environ, **environment},
    )
    version, sums = newest_record(records.stdout, paths.host_version())
    if not version:
        complaints = [line for line in text.splitlines() if line.startswith(("E:", "W:"))]
        reason = complaints[0] if complaints else f"the index has no {PACKAGE}"
        raise IcwaferError(
            f"no source package of Blender {paths.host_version()}: {reason}; {advice}, or name a "
            "source tree with -DICWAFER_BLENDER_SOURCE=DIR"
        )
    # apt-get has no option for the folder that it downloads to: it is the working folder.
    progress.run(
        f"Source package {PACKAGE} {version}",
        [
            "env",
            f"--chdir={folder}",
            "apt-get",
            "-q",
            *options,
            "source",
            "--download-only",
            "--only-source",
            f"{PACKAGE}={version}",
        ],
        paths.LOGS / "source-download.log",
        environment,
        advice,
    )
    text = "".join(f"{checksum}  {name}\n" for name, checksum in sums.items())
    (folder / SUMS).write_text(text, encoding="utf-8")
    shutil.rmtree(folder / "apt")


def newest_record(records: str, upstream: str) -> tuple[str, dict[str, str]]:
    """Version and SHA-256 by file name of the last record for an upstream version.

    `records` is a Sources index: stanzas of fields. ("", {}) if it has no such version.
    """
    version, sums = "", {}
    for stanza in records.split("\n\n"):
        found = re.search(r"^Version: (.+)$", stanza, re.MULTILINE)
        block = re.search(r"^Checksums-Sha256:\s*\n((?: .+\n?)+)", stanza, re.MULTILINE)
        if found and block and re.fullmatch(rf"{re.escape(upstream)}[-+~].*", found[1]):
            version = found[1]
            words = [line.split() for line in block[1].splitlines()]
            sums = {name: checksum for checksum, _, name in words}
    return version, sums


def _unpack(dsc: Path, tree: Path) -> None:
    staging = _staging(tree)
    try:
        progress.run(
            "Unpacking the source",
            ["dpkg-source", "--no-check", "--no-copy", "-x", dsc, staging],
            paths.LOGS / "source-unpack.log",
        )
        _expect_version(staging)
    except BaseException:
        shutil.rmtree(staging, ignore_errors=True)
        raise
    _replace_tree(staging, tree)
