# SPDX-License-Identifier: GPL-2.0-or-later
"""TOML files whose errors name the line: `tomllib` reads them, and a scan finds where keys stand.

    document = toml_lines.read(path)
    raise document.error(("axis", 0, "values"), "has no values: write one at least")
"""

from __future__ import annotations

import re
import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from icwafer.errors import IcwaferError

#: Where something stands in a document: keys of tables and indices of arrays, from the top down.
FieldPath = tuple[str | int, ...]

_TOKEN = re.compile(
    r'(?P<text>"""(?:\\.|[^\\])*?"{3,5}|\'\'\'.*?\'{3,5}|"(?:\\.|[^"\\\n])*"|\'[^\'\n]*\')'
    r"|(?P<comment>\#[^\n]*)"
    r"|(?P<newline>\n)"
    r"|(?P<mark>[\[\]{},=.])"
    r"|(?P<space>[ \t\r]+)"
    r"|(?P<bare>[^\s\[\]{},=.#\"']+)",
    re.DOTALL,
)


@dataclass(frozen=True)
class Document:
    """A TOML file as it was read; `lines` has the line, from 1, of every key and array item."""

    path: Path
    data: dict[str, Any]
    lines: dict[FieldPath, int]

    def line(self, place: FieldPath) -> int:
        """The line of a key or item, or of the nearest table around it; 1 for the whole file."""
        return _nearest_line(self.lines, place)

    def error(self, place: FieldPath, message: str) -> IcwaferError:
        """An error that names file, line and key, to be raised."""
        name = key_name(place)
        return IcwaferError(
            f"{self.path}:{self.line(place)}: {name + ' ' if name else ''}{message}"
        )


def read(path: Path) -> Document:
    """Reads a file. Raises IcwaferError where it is missing, not readable or not TOML."""
    try:
        text = path.read_text(encoding="utf-8")
    except OSError as error:
        raise IcwaferError(f"{path}: {error.strerror}; name a file that can be read") from None
    except UnicodeDecodeError:
        raise IcwaferError(f"{path}: is not a text file in UTF-8") from None
    try:
        data = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        message, _, at = str(error).partition(" (at ")
        line = re.search(r"line (\d+)", at)
        number = line[1] if line else text.count("\n") + 1
        raise IcwaferError(f"{path}:{number}: {message[:1].lower()}{message[1:]}") from None
    return Document(path, data, key_lines(text))


def key_name(place: FieldPath) -> str:
    """A place as a reader of the file would write it: `axis[2].values` for the second axis."""
    name = ""
    for part in place:
        if isinstance(part, int):
            name += f"[{part + 1}]"
        else:
            name += ("." if name else "") + part
    return name


def line_of(text: str, place: FieldPath) -> int:
    """The line of a key or item of a valid TOML text, or of the nearest table around it; 1 for
    the whole text."""
    return _nearest_line(key_lines(text), place)


def _nearest_line(lines: dict[FieldPath, int], place: FieldPath) -> int:
    while place and place not in lines:
        place = place[:-1]
    return lines.get(place, 1)


def key_lines(text: str) -> dict[FieldPath, int]:
    """Lines of all keys and array items of a valid TOML text."""
    return _Scan(text).lines


class _Scan:
    """One pass over the tokens of a text that `tomllib` has found to be valid."""

    def __init__(self, text: str) -> None:
        self.lines: dict[FieldPath, int] = {}
        self._tokens: list[tuple[str, int]] = []  # what is written, and on which line
        self._lengths: dict[FieldPath, int] = {}  # of the arrays of tables so far
        self._at = 0
        line = 1
        for match in _TOKEN.finditer(text):
            if match.lastgroup not in ("comment", "space"):
                self._tokens.append((match[0], line))
            line += match[0].count("\n")
        self._document()

    def _peek(self) -> str:
        return self._tokens[self._at][0] if self._at < len(self._tokens) else ""

    def _take(self) -> tuple[str, int]:
        self._at += 1
        return self._tokens[self._at - 1]

    def _skip_newlines(self) -> None:
        while self._peek() == "\n":
            self._at += 1

    def _document(self) -> None:
        table: FieldPath = ()
        self._skip_newlines()
        while self._peek():
            if self._peek() == "[":
                table = self._header()
            else:
                self._assignment(table)
            self._skip_newlines()

    def _header(self) -> FieldPath:
        """`[a.b]` or `[[a.b]]`; returns the place of the table that it opens."""
        _, line = self._take()
        repeated = self._peek() == "["
        if repeated:
            self._take()
        place = self._below((), self._key())
        if repeated:
            index = self._lengths.get(place, 0)
            self._lengths[place] = index + 1
            self.lines.setdefault(place, line)
            place = (*place, index)
        self.lines.setdefault(place, line)
        self._at += 2 if repeated else 1
        return place

    def _below(self, table: FieldPath, keys: list[str]) -> FieldPath:
        """The place of a dotted key; where it leads into an array of tables, the last one."""
        for number, key in enumerate(keys):
            table = (*table, key)
            if number < len(keys) - 1 and table in self._lengths:
                table = (*table, self._lengths[table] - 1)
        return table

    def _key(self) -> list[str]:
        """A key, dotted or not: its parts without quotes."""
        keys = []
        while True:
            word, _ = self._take()
            quoted = word[0] in "\"'"
            keys.append(tomllib.loads(f"x = {word}")["x"] if quoted else word)
            if self._peek() != ".":
                return keys
            self._take()

    def _assignment(self, table: FieldPath) -> None:
        line = self._tokens[self._at][1]
        keys = self._key()
        for count in range(1, len(keys) + 1):
            self.lines.setdefault((*table, *keys[:count]), line)
        self._take()  # the equals sign
        self._value((*table, *keys))

    def _value(self, place: FieldPath) -> None:
        if self._peek() == "[":
            self._array(place)
        elif self._peek() == "{":
            self._inline_table(place)
        else:
            while self._peek() not in ("", ",", "]", "}", "\n"):
                self._take()

    def _array(self, place: FieldPath) -> None:
        self._take()
        self._skip_newlines()
        index = 0
        while self._peek() != "]":
            self.lines[*place, index] = self._tokens[self._at][1]
            self._value((*place, index))
            index += 1
            self._end_of_item()
        self._take()

    def _inline_table(self, place: FieldPath) -> None:
        self._take()
        while self._peek() != "}":
            self._assignment(place)
            self._end_of_item()
        self._take()

    def _end_of_item(self) -> None:
        self._skip_newlines()
        if self._peek() == ",":
            self._take()
        self._skip_newlines()
