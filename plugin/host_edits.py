#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Puts the node into a host's source tree, checks it there, and takes it out again.

    host_edits.py apply|verify|revert --tree DIR [--host plugin/blender-3.4]

The edits are data: `edits.toml` in a folder per host version.

    version = "3.4.1"
    [[add]]                   # a file, or files of a folder at any depth
    from = "shaders/icwafer"  # relative to the repository
    to = "intern/cycles/kernel/icwafer"
    files = "*.jpg"           # optional: which files of a folder, *.h if left out
    [[edit]]
    file = "source/blender/blenkernel/BKE_node.h"
    anchor = "exact text"     # one or several lines; found exactly once in the unedited file
    place = "after"           # "before", "after" or "replace"
    text = "whole lines"
    unless = "exact text"     # optional: a file in which this occurs does not need the edit

"after" adds whole lines below the line in which the anchor ends, "before" above the line in which
it begins. "replace" puts `text` exactly where the anchor was; a last newline of `text` counts only
if the anchor has one. All edits of a file are matched against the unedited file.

The tree remembers what was done to it in the folder `.icwafer-edits`: a manifest and the unedited
files. Everything is planned in memory and staged there first, so that the tree itself changes by
renaming alone: a full disk, an error or Ctrl-C leaves it as it was.
"""

from __future__ import annotations

import argparse
import contextlib
import enum
import hashlib
import json
import re
import shutil
import sys
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath

REPOSITORY = Path(__file__).resolve().parent.parent
DEFAULT_HOST = REPOSITORY / "plugin" / "blender-3.4"
STATE_FOLDER = ".icwafer-edits"
VERSION_HEADER = "source/blender/blenkernel/BKE_blender_version.h"


class HostEditError(Exception):
    """One line: what is wrong with which file, and what to do about it."""


class State(enum.Enum):
    """How a tree stands to the edits: `ABSENT` means unedited, `CURRENT` edited and up to date."""

    ABSENT = "not applied"
    OUTDATED = "out of date"
    CURRENT = "applied"


@dataclass(frozen=True)
class Edit:
    """One change of one file of the host."""

    file: str
    anchor: bytes
    place: str
    text: bytes
    unless: bytes | None = None


@dataclass(frozen=True)
class HostEdits:
    """The content of an `edits.toml`; `added` maps paths in the host to files of ours."""

    source: Path
    version: str
    added: dict[str, Path]
    edits: dict[str, list[Edit]]


@dataclass(frozen=True)
class Entry:
    """One file of ours in the tree.

    `original` is the hash of the unedited file (None: the host has no such file). `edited` are
    the hashes that it may have now: one, or two if an apply was killed half-way.
    """

    original: str | None
    edited: tuple[str, ...]


@dataclass(frozen=True)
class Manifest:
    """What was done to a tree: its files, and the folders that were made for them."""

    files: dict[str, Entry] = field(default_factory=dict)
    folders: tuple[str, ...] = ()

    def to_json(self) -> bytes:
        files = {
            path: {"original": entry.original, "edited": list(entry.edited)}
            for path, entry in sorted(self.files.items())
        }
        return json.dumps({"files": files, "folders": list(self.folders)}, indent=1).encode()

    @staticmethod
    def from_json(data: bytes) -> Manifest:
        content = json.loads(data)
        files = {
            path: Entry(entry["original"], tuple(entry["edited"]))
            for path, entry in content["files"].items()
        }
        return Manifest(files, tuple(content["folders"]))


# Reading the edits ------------------------------------------------------------------------------


def load_edits(host: Path, repository: Path = REPOSITORY) -> HostEdits:
    """Reads `edits.toml` of a host folder; `HostEditError` says what is wrong with it."""
    source = host / "edits.toml"
    try:
        content = tomllib.loads(source.read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise HostEditError(f"{source}: not found; name a host folder with --host") from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise HostEditError(f"{source}: {error}") from None

    _expect_keys(content, {"version"}, {"add", "edit"}, f"{source}")
    added: dict[str, Path] = {}
    for item in content.get("add", []):
        _expect_keys(item, {"from", "to"}, {"files"}, f"{source}: [[add]]")
        target, wanted = _inside(item["to"], source), item.get("files", "*.h")
        added |= _added_files(repository, item["from"], wanted, target, source)
    edits: dict[str, list[Edit]] = {}
    for item in content.get("edit", []):
        edit = _read_edit(item, source)
        if edit.file in added:
            raise HostEditError(f"{source}: {edit.file} is both added and edited; edit our file")
        edits.setdefault(edit.file, []).append(edit)
    return HostEdits(source, content["version"], added, edits)


def _expect_keys(
    item: dict[str, object], needed: set[str], optional: set[str], where: str
) -> None:
    for key in sorted(needed - item.keys()):
        raise HostEditError(f"{where}: '{key}' is missing")
    for key in sorted(item.keys() - needed - optional):
        raise HostEditError(f"{where}: unknown key '{key}'")
    for key in sorted(needed):
        if not isinstance(item[key], str):
            raise HostEditError(f"{where}: '{key}' must be a string")


def _inside(path: str, source: Path) -> str:
    pure = PurePosixPath(path)
    if pure.is_absolute() or ".." in pure.parts or pure.parts[:1] in ((), (STATE_FOLDER,)):
        raise HostEditError(f"{source}: '{path}' must be a path inside the host's tree")
    return pure.as_posix()


def _added_files(
    repository: Path, origin: str, wanted: str, target: str, source: Path
) -> dict[str, Path]:
    ours = repository / origin
    if ours.is_file():
        return {target: ours}
    files = sorted(ours.rglob(wanted)) if ours.is_dir() else []
    if not files:
        raise HostEditError(
            f"{source}: [[add]] '{origin}' is neither a file nor a folder with {wanted}"
        )
    return {f"{target}/{file.relative_to(ours).as_posix()}": file for file in files}


def _read_edit(item: dict[str, str], source: Path) -> Edit:
    _expect_keys(item, {"file", "anchor", "place", "text"}, {"unless"}, f"{source}: [[edit]]")
    if item["place"] not in ("before", "after", "replace"):
        raise HostEditError(
            f"{source}: {item['file']}: place '{item['place']}' is none of before, after, replace"
        )
    if not item["anchor"].strip():
        raise HostEditError(f"{source}: {item['file']}: the anchor is empty")
    file = _inside(item["file"], source)
    unless = item.get("unless")
    return Edit(
        file, item["anchor"].encode(), item["place"], item["text"].encode(),
        unless.encode() if unless else None,
    )  # fmt: skip


def tree_version(tree: Path) -> str:
    """The version of a Blender source tree, as "3.4.1", from its own header."""
    header = tree / VERSION_HEADER
    try:
        text = header.read_text(encoding="utf-8")
    except OSError:
        raise HostEditError(f"{tree}: not a Blender source tree (no {VERSION_HEADER})") from None
    version = re.search(r"^#define BLENDER_VERSION (\d+)$", text, re.MULTILINE)
    patch = re.search(r"^#define BLENDER_VERSION_PATCH (\d+)$", text, re.MULTILINE)
    if not version or not patch:
        raise HostEditError(f"{header}: no Blender version in it; take an unchanged source tree")
    major, minor = divmod(int(version[1]), 100)
    return f"{major}.{minor}.{patch[1]}"


# Planning ---------------------------------------------------------------------------------------


def edited_text(original: bytes, edits: list[Edit], source: Path) -> bytes:
    """The file with all its edits; each anchor must occur exactly once, and none may overlap."""
    needed = (edit for edit in edits if edit.unless is None or edit.unless not in original)
    replacements = sorted(
        (_replacement(original, edit, source) for edit in needed), key=lambda item: item[:2]
    )
    pieces: list[bytes] = []
    done = 0
    for begin, end, text, edit in replacements:
        if begin < done:
            raise HostEditError(
                f"{edit.file}: anchor {_quote(edit.anchor)} overlaps another edit "
                f"of this file; mend {source}"
            )
        pieces += [original[done:begin], text]
        done = end
    return b"".join([*pieces, original[done:]])


def _replacement(original: bytes, edit: Edit, source: Path) -> tuple[int, int, bytes, Edit]:
    """The half-open range of `original` that an edit replaces, and what it puts there."""
    count = original.count(edit.anchor)
    if count != 1:
        raise HostEditError(
            f"{edit.file}: anchor {_quote(edit.anchor)} found {count} times, not "
            f"once; mend {source} or take an unchanged source tree"
        )
    begin = original.index(edit.anchor)
    end = begin + len(edit.anchor)
    if edit.place == "replace":
        return begin, end, edit.text if edit.anchor[-1:] == b"\n" else _chomp(edit.text), edit
    lines = _chomp(edit.text) + b"\n"
    if edit.place == "before":
        at = original.rfind(b"\n", 0, begin) + 1
    else:
        newline = original.find(b"\n", end - 1)
        if newline < 0:
            return len(original), len(original), b"\n" + lines, edit
        at = newline + 1
    return at, at, lines, edit


def _chomp(text: bytes) -> bytes:
    return text[:-1] if text.endswith(b"\n") else text


def _quote(anchor: bytes) -> str:
    text = " ".join(anchor.decode().split())
    return f"'{text if len(text) <= 70 else text[:67] + '...'}'"


def _hash(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()


def _read(path: Path) -> bytes | None:
    try:
        return path.read_bytes()
    except (FileNotFoundError, NotADirectoryError):
        return None


@dataclass(frozen=True)
class _Tree:
    """A host's tree together with what it remembers of earlier edits."""

    root: Path
    manifest: Manifest

    @staticmethod
    def open(root: Path) -> _Tree:
        tree_version(root)
        data = _read(root / STATE_FOLDER / "manifest.json")
        try:
            manifest = Manifest() if data is None else Manifest.from_json(data)
        except (ValueError, KeyError, TypeError, AttributeError):
            raise HostEditError(
                f"{root / STATE_FOLDER / 'manifest.json'}: damaged; remove {root} and unpack the "
                "source again"
            ) from None
        tree = _Tree(root, manifest)
        tree._expect_unchanged()
        return tree

    def _expect_unchanged(self) -> None:
        for path, entry in self.manifest.files.items():
            current = _read(self.root / path)
            if (None if current is None else _hash(current)) not in (
                entry.original,
                *entry.edited,
            ):
                raise HostEditError(
                    f"{path}: changed in {self.root} since the edits were applied; make the "
                    "change in the project's own files, and take an unchanged source tree"
                )

    def original(self, path: str) -> bytes | None:
        """The unedited file, None if the host has no such file."""
        entry = self.manifest.files.get(path)
        if entry is None:
            return _read(self.root / path)
        if entry.original is None:
            return None
        data = _read(self.root / STATE_FOLDER / "originals" / path)
        if data is None or _hash(data) != entry.original:
            raise HostEditError(
                f"{STATE_FOLDER}/originals/{path}: lost or damaged; remove {self.root} and unpack "
                "the source again"
            )
        return data

    def wanted(self, host: HostEdits) -> dict[str, bytes]:
        """Content of every file that the edits add or change."""
        version = tree_version(self.root)
        if version != host.version:
            raise HostEditError(
                f"{self.root}: Blender {version}, but {host.source} is for {host.version}; take a "
                "source tree of that version"
            )
        files: dict[str, bytes] = {}
        for path, ours in host.added.items():
            if self.original(path) is not None:
                raise HostEditError(
                    f"{path}: the host already has this file; choose another name in {host.source}"
                )
            files[path] = ours.read_bytes()
        for path, edits in host.edits.items():
            original = self.original(path)
            if original is None:
                raise HostEditError(
                    f"{path}: not in {self.root}, anchor {_quote(edits[0].anchor)} found 0 times; "
                    f"mend {host.source} or take an unchanged source tree"
                )
            files[path] = edited_text(original, edits, host.source)
        return files


# Changing the tree ------------------------------------------------------------------------------


class _Transaction:
    """Files staged beside the tree, then renamed into it; all of them or none."""

    def __init__(self, root: Path) -> None:
        self.root = root
        self.state = root / STATE_FOLDER
        self.staging = self.state / "staging"
        self._steps: list[tuple[Path, Path | None]] = []
        self._undo: list[tuple[Path, Path | None]] = []
        self._made_folders: list[Path] = []

    @contextlib.contextmanager
    def run(self) -> Iterator[_Transaction]:
        """Stage inside the `with` block; its end renames. Any error leaves the tree as it was."""
        fresh = not self.state.exists()
        try:
            shutil.rmtree(self.staging, ignore_errors=True)  # of an apply that was killed
            self.staging.mkdir(parents=True)
            yield self
            for target, staged in self._steps:
                self._swap(target, staged)
        except BaseException:
            self._roll_back()
            shutil.rmtree(self.state if fresh else self.staging, ignore_errors=True)
            raise
        shutil.rmtree(self.staging)

    def put(self, target: Path, data: bytes) -> None:
        """Stages new content of a file; keeps the permissions of the one that it replaces."""
        staged = self.staging / f"new{len(self._steps)}"
        staged.write_bytes(data)
        if target.exists():
            shutil.copymode(target, staged)
        self._steps.append((target, staged))

    def remove(self, target: Path) -> None:
        self._steps.append((target, None))

    def _swap(self, target: Path, staged: Path | None) -> None:
        backup = self.staging / f"old{len(self._undo)}"
        if target.exists():
            backup.hardlink_to(target)
            self._undo.append((target, backup))
        else:
            self._undo.append((target, None))
        if staged is None:
            target.unlink(missing_ok=True)
            return
        for folder in reversed([parent for parent in target.parents if not parent.exists()]):
            folder.mkdir()
            self._made_folders.append(folder)
        staged.replace(target)

    def _roll_back(self) -> None:
        for target, backup in reversed(self._undo):
            if backup is None:
                target.unlink(missing_ok=True)
            else:
                backup.replace(target)
        for folder in reversed(self._made_folders):
            folder.rmdir()


def _new_folders(root: Path, paths: list[str]) -> set[str]:
    """Folders that the tree does not have yet and that files at `paths` need."""
    parents = {p.as_posix() for path in paths for p in PurePosixPath(path).parents}
    return {path for path in parents if not (root / path).is_dir()}


def _remove_folders(root: Path, folders: set[str]) -> None:
    for folder in sorted(folders, reverse=True):
        with contextlib.suppress(OSError):  # not empty: somebody else's files are in it
            (root / folder).rmdir()


def apply(tree: Path, host: Path = DEFAULT_HOST, repository: Path = REPOSITORY) -> list[str]:
    """Brings a tree up to date with the edits and returns the paths that it wrote or removed.

    Files that are right already keep their modification time. Raises `HostEditError` or `OSError`
    and leaves the tree as it was.
    """
    before = _Tree.open(tree)
    wanted = before.wanted(load_edits(host, repository))
    return _change(before, wanted)


def _change(before: _Tree, wanted: dict[str, bytes]) -> list[str]:
    root, old = before.root, before.manifest
    dropped = old.files.keys() - wanted.keys()
    content: dict[str, bytes | None] = {path: before.original(path) for path in dropped} | wanted
    changed = sorted(path for path, data in content.items() if data != _read(root / path))

    entries: dict[str, Entry] = {}
    for path, data in wanted.items():
        original = before.original(path)
        entries[path] = Entry(None if original is None else _hash(original), (_hash(data),))
    needed = {p.as_posix() for path in wanted for p in PurePosixPath(path).parents}
    made = _new_folders(root, list(wanted)) | (set(old.folders) & needed)
    final = Manifest(entries, tuple(sorted(made)))
    if not changed and final == old:
        return []

    # While files are being renamed, both the old and the new ones are accepted as ours.
    interim = Manifest(
        {
            path: Entry(
                entry.original,
                tuple(
                    dict.fromkeys(
                        (*entry.edited, *(old.files[path].edited if path in old.files else ()))
                    )
                ),
            )
            for path, entry in (old.files | entries).items()
        },
        tuple(sorted(made | set(old.folders))),
    )
    state = root / STATE_FOLDER
    with _Transaction(root).run() as transaction:
        for path in wanted.keys() - old.files.keys():
            original = before.original(path)
            if original is not None:
                transaction.put(state / "originals" / path, original)
        transaction.put(state / "manifest.json", interim.to_json())
        for path in changed:
            data = content[path]
            if data is None:
                transaction.remove(root / path)
            else:
                transaction.put(root / path, data)
        transaction.put(state / "manifest.json", final.to_json())
        for path in dropped:
            transaction.remove(state / "originals" / path)
    _remove_folders(root, set(old.folders) - made)
    return changed


def revert(tree: Path) -> list[str]:
    """Restores the unedited tree byte for byte and returns the paths that it wrote or removed.

    Restored files get a new modification time, so that a build notices them.
    """
    changed = _change(_Tree.open(tree), {})
    shutil.rmtree(tree / STATE_FOLDER, ignore_errors=True)
    return changed


def verify(tree: Path, host: Path = DEFAULT_HOST, repository: Path = REPOSITORY) -> State:
    """Checks every anchor and every file; raises `HostEditError` if the edits do not fit."""
    before = _Tree.open(tree)
    wanted = before.wanted(load_edits(host, repository))
    if not before.manifest.files:
        return State.ABSENT
    current = {path: _read(tree / path) for path in before.manifest.files}
    return State.CURRENT if current == wanted else State.OUTDATED


# Command line -----------------------------------------------------------------------------------


def _run(arguments: argparse.Namespace) -> int:
    tree: Path = arguments.tree
    if arguments.command == "verify":
        state = verify(tree, arguments.host)
        if state is State.OUTDATED:
            raise HostEditError(f"{tree}: the edits are {state.value}; run 'apply' again")
        print(f"{tree}: {state.value}, every anchor found exactly once")
        return 0
    if arguments.command == "apply":
        changed = apply(tree, arguments.host)
    else:
        changed = revert(tree)
    print(f"{tree}: {len(changed)} files changed" if changed else f"{tree}: nothing to do")
    return 0


def main(argv: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(
        description="Applies, verifies or reverts the edits of a host's source tree."
    )
    parser.add_argument("command", choices=["apply", "verify", "revert"])
    parser.add_argument("--tree", type=Path, required=True, help="the host's source tree")
    parser.add_argument("--host", type=Path, default=DEFAULT_HOST, help="folder with edits.toml")
    arguments = parser.parse_args(argv)
    try:
        return _run(arguments)
    except HostEditError as error:
        print(f"host_edits: {error}", file=sys.stderr)
    except OSError as error:
        print(
            f"host_edits: {error.filename or arguments.tree}: {error.strerror}; the tree is "
            "as it was: mend this and run the command again",
            file=sys.stderr,
        )
    except KeyboardInterrupt:
        print("host_edits: interrupted; the tree is as it was", file=sys.stderr)
        return 130
    return 1


if __name__ == "__main__":
    sys.exit(main())
