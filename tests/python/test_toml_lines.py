# SPDX-License-Identifier: GPL-2.0-or-later
"""Errors in TOML files name the line on which the key stands."""

from __future__ import annotations

import tomllib
import unittest

from support import CommandCase, write

from icwafer import toml_lines
from icwafer.errors import IcwaferError

TEXT = '''# a comment with = and [brackets]
name = "x # no comment"
text = """
[no.table]
a = 1
"""
nested = [[1, 2], [
  3,  # three
  4.5e3,
]]
inline = { a = 1, "b c" = [ { d = 2 } ] }

[table."quoted.key"]
a.b = 1979-05-27T07:32:00Z

[[list]]
x = 1
[list.sub]
y = 2

[[list]]
x = 3
[[list.deep]]
z = 'it''s'
'''.replace(
    "'it''s'", "'its'"
)

LINES = {
    ("name",): 2,
    ("text",): 3,
    ("nested",): 7,
    ("nested", 0, 1): 7,
    ("nested", 1): 7,
    ("nested", 1, 0): 8,
    ("nested", 1, 1): 9,
    ("inline", "a"): 11,
    ("inline", "b c", 0, "d"): 11,
    ("table", "quoted.key"): 13,
    ("table", "quoted.key", "a", "b"): 14,
    ("list",): 16,
    ("list", 0, "x"): 17,
    ("list", 0, "sub", "y"): 19,
    ("list", 1): 21,
    ("list", 1, "x"): 22,
    ("list", 1, "deep", 0, "z"): 24,
}


def places(value: object, place: toml_lines.FieldPath = ()) -> set[toml_lines.FieldPath]:
    """All places below a value, as `tomllib` has read it."""
    items = value.items() if isinstance(value, dict) else enumerate(value)
    found = set()
    for key, item in items:
        found.add((*place, key))
        if isinstance(item, (dict, list)):
            found |= places(item, (*place, key))
    return found


class LinesTest(unittest.TestCase):
    def test_every_kind_of_key(self) -> None:
        lines = toml_lines.key_lines(TEXT)
        self.assertEqual({place: lines.get(place) for place in LINES}, LINES)

    def test_no_key_is_missed(self) -> None:
        known = places(tomllib.loads(TEXT)) - {("table",)}  # which has no line of its own
        self.assertEqual(known - set(toml_lines.key_lines(TEXT)), set())

    def test_names_of_places(self) -> None:
        self.assertEqual(toml_lines.key_name(("axis", 1, "values")), "axis[2].values")


class ReadTest(CommandCase):
    def test_an_error_names_file_line_and_key(self) -> None:
        path = write(self.folder / "a.toml", TEXT)
        document = toml_lines.read(path)
        error = document.error(("list", 1, "x"), "is wrong")
        self.assertEqual(str(error), f"{path}:22: list[2].x is wrong")
        self.assertEqual(document.line(("list", 1, "not there")), 21)

    def test_files_that_cannot_be_read(self) -> None:
        for content, words in (
            (b"a = 1\nb = [1,\n", "a.toml:"),
            (b"a = 1\nb = = 2\n", "a.toml:2: invalid value"),
            (b"a = 1\na = 2\n", "a.toml:2: cannot overwrite"),
            (b"\xff\xfe", "not a text file in UTF-8"),
        ):
            path = self.folder / "a.toml"
            path.write_bytes(content)
            with self.subTest(content), self.assertRaisesRegex(IcwaferError, words):
                toml_lines.read(path)
        with self.assertRaisesRegex(IcwaferError, "b.toml: No such file"):
            toml_lines.read(self.folder / "b.toml")


if __name__ == "__main__":
    unittest.main()
