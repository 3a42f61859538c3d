# SPDX-License-Identifier: GPL-2.0-or-later
"""Finds the line of a TOML file on which something stands.

Python's tomllib gives no positions of what it has read. This walks over the text of a file that
tomllib has accepted, so it only has to tell headers, keys, strings and brackets apart.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

FieldPath = tuple[str | int, ...]

_BARE_OR_QUOTED = re.compile(r"""\s*(?:([A-Za-z0-9_-]+)|"((?:[^"\\]|\\.)*)"|'([^']*)')\s*""")
_STRING = re.compile(
    r'"""(?:[^\\]|\\.)*?"""(?!")' r"|'''.*?'''(?!')" r'|"(?:[^"\\\n]|\\.)*"' r"|'[^'\n]*'",
    re.DOTALL,
)


def line_of(text: str, path: FieldPath) -> int:
    """The line, from 1, of the longest beginning of `path` that the text has; 1 for none."""
    best, line = 0, 1
    for found, position in _places(text):
        depth = len(found)
        if best < depth <= len(path) and found == path[:depth]:
            best, line = depth, text.count("\n", 0, position) + 1
    return line


def _places(text: str) -> Iterator[tuple[FieldPath, int]]:
    """The path and position of every header, every key, and every element of a key's array."""
    table: FieldPath = ()
    counts: dict[FieldPath, int] = {}
    position = 0
    while True:
        position = _skip(text, position)
        if position >= len(text):
            return
        if text[position] == "[":
            array = text.startswith("[[", position)
            names, end = _names(text, position + 1 + array)
            table = ()
            for name in names[:-1]:
                table += (name,)
                if table in counts:
                    table += (counts[table],)
            table += (names[-1],)
            if array:
                counts[table] = counts.get(table, -1) + 1
                table += (counts[table],)
            yield table, position
            position = end + 1 + array
        else:
            names, end = _names(text, position)
            key = (*table, *names)
            yield key, position
            position = yield from _value(text, end + 1, key)


def _skip(text: str, position: int) -> int:
    """Past blanks and comments."""
    return re.compile(r"(?:\s|#[^\n]*)*").match(text, position).end()


def _names(text: str, position: int) -> tuple[list[str], int]:
    """A dotted key, and the position of what follows it."""
    names = []
    while True:
        match = _BARE_OR_QUOTED.match(text, position)
        names.append(next(group for group in match.groups() if group is not None))
        position = match.end()
        if text[position] != ".":
            return names, position
        position += 1


def _value(text: str, position: int, key: FieldPath) -> Iterator[tuple[FieldPath, int]]:
    """Passes over a value, giving the elements of an array; returns where it ends."""
    depth = element = 0
    while position < len(text):
        character = text[position]
        if character in "\"'":
            position = _STRING.match(text, position).end()
            continue
        if character == "#":
            position = text.find("\n", position) % (len(text) + 1)
            continue
        if character == "\n" and depth == 0:
            break
        if character in "]}":
            depth -= 1
        if depth == 1 and character in "[{":
            yield (*key, element), position
            element += 1
        if character in "[{":
            depth += 1
        position += 1
    return position
