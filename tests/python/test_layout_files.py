# SPDX-License-Identifier: GPL-2.0-or-later
"""Layout files: what is written is read again, and what is wrong is named with its line."""

from __future__ import annotations

import base64
import sys
import tempfile
import unittest
import zlib
from dataclasses import replace
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts" / "python"))

from icwafer.chips.die import generate  # noqa: E402
from icwafer.chips.document import (  # noqa: E402
    layout_text,
    parse_layout,
    read_layout,
    write_layout,
)
from icwafer.toml_lines import line_of  # noqa: E402
from icwafer.chips.model import BlockTable, DieSpec, Group, Kind, Layout  # noqa: E402
from icwafer.chips.presets import PRESETS  # noqa: E402
from icwafer.chips.spread import Clustered, Normal, Uniform  # noqa: E402
from icwafer.errors import IcwaferError  # noqa: E402

HEADER = 'format = "icwafer-layout"\nversion = 1\n'
TEXT = layout_text(PRESETS["eight-core"])

SMALL = """\
format = "icwafer-layout"  # a file written by hand
version = 1

[[dies]]
name = "a # b"
width_mm = 0.2
height_mm = 0.1

[[dies.groups]]
name = 'x'
kind = "logic"
spacing_nm = { mean = 800, deviation = 5 }

  [[dies.groups]]
  "name" = "y"
  kind = "memory"
  spacing_nm = {low = 700, high = 720.5}
  oxide_nm = { centres = [500, 530], deviation = 2 }

[dies.blocks]
rows = [  # um
  [0, 0, 10, 10, "x"],  # "[["

  [10, 0, 20, 5, "y"],
  [10, 5, 20, 10,
   "y"],
]
[wafer]
diameter_mm = 200
test_fields = []
oxide.bow = 0.02
"""


def listed(count: int) -> Layout:
    """A die with a listed block of random size in each cell of a grid."""
    rng = np.random.default_rng(count)
    side = int(np.ceil(count**0.5))
    cell = np.stack(np.divmod(np.arange(count), side), axis=1) * 1000
    rect = np.concatenate([cell, cell + rng.integers(1, 1001, (count, 2))], axis=1)
    groups = PRESETS["eight-core"].dies[0].groups
    blocks = BlockTable(rect, rng.integers(len(groups), size=count).astype(np.int32))
    size_mm = side / 1000
    return Layout((DieSpec(groups, name="b", width_mm=size_mm, height_mm=size_mm, blocks=blocks),))


class RoundTrip(unittest.TestCase):
    LAYOUTS = {
        **PRESETS,
        "one block": listed(1),
        "rows": listed(1000),
        "packed": listed(1001),
        "many": listed(60_000),
    }

    def test_reading_gives_an_equal_layout_and_writing_the_same_bytes(self) -> None:
        for name, layout in self.LAYOUTS.items():
            with self.subTest(name):
                text = layout_text(layout)
                again = parse_layout(text, name)
                self.assertEqual(again, layout)
                self.assertEqual(layout_text(again), text)

    def test_names_and_numbers_of_any_kind(self) -> None:
        group = Group(
            'quotes " and \\ and \u00b5',
            Kind.PIXEL,
            Uniform(1e-7 + 800, 1e3 + 1 / 3),
            width_nm=Clustered((1.5, 2.25), 0.125),
            oxide_nm=Normal(0),
            turned=1e-5,
        )
        layout = Layout((DieSpec((group,), name="'", seed=2**32 - 1, width_mm=1 / 3),))
        self.assertEqual(parse_layout(layout_text(layout), "x"), layout)

    def test_packed_blocks_are_compact(self) -> None:
        die = generate(PRESETS["eight-core"].dies[0])
        blocks = BlockTable(die.rect_nm, die.group)
        text = layout_text(Layout((replace(die.spec, blocks=blocks),)))
        self.assertLess(len(text) / len(die), 20)

    def test_files_are_complete_or_not_there(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "a.layout.toml"
            write_layout(path, PRESETS["fpga"])
            self.assertEqual(read_layout(path), PRESETS["fpga"])
            before = path.read_bytes()
            bad = replace(PRESETS["fpga"], dies=(replace(PRESETS["fpga"].dies[0], width_mm=-1),))
            with self.assertRaisesRegex(IcwaferError, "width_mm: -1 is outside 0.001 to 300"):
                write_layout(path, bad)
            self.assertEqual(path.read_bytes(), before)
            with self.assertRaises(FileNotFoundError) as caught:
                write_layout(Path(folder) / "none" / "b.layout.toml", PRESETS["fpga"])
            self.assertTrue(caught.exception.filename.endswith("/none/b.layout.toml"))
            self.assertEqual([p.name for p in Path(folder).iterdir()], ["a.layout.toml"])


class ByHand(unittest.TestCase):
    def test_a_small_file(self) -> None:
        layout = parse_layout(SMALL, "small")
        die = layout.dies[0]
        self.assertEqual(die.groups[0].spacing_nm, Normal(800, 5))
        self.assertEqual(die.groups[1].spacing_nm, Uniform(700, 720.5))
        self.assertEqual(die.groups[1].oxide_nm, Clustered((500, 530), 2))
        self.assertEqual(die.blocks.rect_nm[1].tolist(), [10_000, 0, 20_000, 5_000])
        self.assertEqual(die.blocks.group.tolist(), [0, 1, 1])
        self.assertEqual((layout.wafer.diameter_mm, layout.wafer.oxide.bow), (200, 0.02))

    def test_a_preset_with_changes(self) -> None:
        text = HEADER + (
            '[[dies]]\npreset = "dram"\nseed = 77\n'
            '[[dies.groups]]\nname = "cells"\nturned = 0.5\n'
            '[[dies.groups]]\nname = "more"\nkind = "logic"\nspacing_nm = 700\n'
        )
        die, preset = parse_layout(text, "x").dies[0], PRESETS["dram"].dies[0]
        cells = replace(preset.groups[0], turned=0.5)
        more = Group("more", Kind.LOGIC, Normal(700))
        groups = (cells, *preset.groups[1:], more)
        self.assertEqual(die, replace(preset, seed=77, groups=groups))


class Errors(unittest.TestCase):
    """Every message begins with the file and the line that was made wrong."""

    def expect(self, text: str, line: int, *parts: str) -> None:
        with self.assertRaises(IcwaferError) as caught:
            parse_layout(text, "f.toml")
        message = str(caught.exception)
        self.assertTrue(message.startswith(f"f.toml:{line}: "), f"line {line}: {message}")
        self.assertNotIn("\n", message)
        for part in parts:
            self.assertIn(part, message)

    def edited(self, text: str, old: str, new: str, *parts: str, shift: int = 0) -> None:
        """The first `old` becomes `new`; the error is on the line of it, or `shift` lines on."""
        at = text.index(old)
        line = text.count("\n", 0, at) + 1 + shift
        with self.subTest(new):
            self.expect(text[:at] + new + text[at + len(old) :], line, *parts)

    def test_of_written_files(self) -> None:
        for old, new, *parts in (
            ("version = 1", "version = 2", "version is 2", "reads 1 only"),
            ("seed = 8", "seed = 8.0", "dies[1].seed: 8.0 is not a whole number"),
            ("seed = 8", "seed = -1", "dies[1].seed: -1 is outside 0 to 4294967295"),
            ("seed = 8", "sead = 8", "dies[1].sead: no field 'sead': did you mean 'seed'?"),
            ("copies_alike = true", "copies_alike = 1", "1 is neither true nor false"),
            ("width_mm = 10.32", "width_mm = nan", "nan is outside 0.001 to 300"),
            ("width_mm = 10.32", "width_mm = 10.32e9", "is outside 0.001 to 300"),
            ("block_um = 80.0", 'block_um = "80"', "'80' is not a number"),
            ('"eight-core"\nseed', '"eightcore"\nseed', "did you mean 'eight-core'?"),
            ('kind = "memory"', 'kind = "xy"', "no kind 'xy': choose from logic, memory"),
            ("deviation = 6.48", "deviation = 648", "-864 to 3024 is outside 50 to 200000"),
            ("deviation = 6.48", "deviation = -4", "deviation -4 is outside 0 and above"),
            ("{ mean = 1080.0", "{ maen = 1080.0", "needs a number, {mean, deviation}"),
            ("width_nm = 432.0", "width_nm = 1100", "leaves no gap between wires"),
            ("weight = 4.0", "weight = [4]", "groups[1].weight: [4] is not a number"),
            ('name = "cache"', 'name = "logic"', "'logic' is already taken"),
            ('name = "cache"', 'name = ""', "'' is no name"),
            ("diameter_mm = 300", "diameter_mm = 250", "250 is not one of 100, 125, 150"),
            ('mark = "notch"', 'mark = "flats"', "'flats' is not made on 300 mm"),
            ("field_rows = 0", "field_rows = 30", "1 x 30 dies of 10.32 x 7.34 mm are more"),
            ("[-2, 2]", "[-2]", "wafer.test_fields[1]: [-2] is not [column, row]"),
            ("[2, -2]", "[90, 0]", "wafer.test_fields[2]", "is not wholly on the wafer"),
            ("bow = 0.03", "bow = 0.5", "wafer.oxide.bow: 0.5 is outside -0.3 to 0.3"),
            ("[wafer.groove]", "[wafer.grove]", "wafer.grove", "did you mean 'groove'?"),
        ):
            self.edited(TEXT, old, new, *parts)

    def test_of_files_written_by_hand(self) -> None:
        for old, new, *parts in (
            ('10, "x"]', '10, "z"]', "dies[1].blocks.rows[1]: no group 'z'"),
            ('[10, 0, 20, 5, "y"]', '[10, 0, 20, "y"]', "rows[2]", "is not [x0, y0, x1, y1"),
            ("[10, 5, 20, 10,", '[10, "5", 20, 10,', "dies[1].blocks.rows[3]: '5' is not a"),
            ("[0, 0, 10, 10,", "[0, 0, inf, 10,", "rows[1]", "larger than any die"),
            ("oxide.bow = 0.02", 'oxide.bow = "a"', "wafer.oxide.bow: 'a' is not a number"),
            ("high = 720.5", "high = 600", "low 700 is above high 600"),
            ("centres = [500, 530]", "centres = []", "no centres"),
            ('"name" = "y"', '"name" = 3', "groups[2].name: 3 is not a text"),
        ):
            self.edited(SMALL, old, new, *parts)
        # The fault of blocks together is that of their table, and a missing field of its header.
        self.edited(
            SMALL, "[dies.blocks]\nrows = [", "[dies.blocks]\nrows = [[0, 0, 1, 1, 'x'],",
            "blocks 1, [0, 0, 1, 1] um, and 2 overlap",
        )  # fmt: skip
        self.edited(SMALL, '[[dies.groups]]\nname = \'x\'\nkind = "logic"',
                    "[[dies.groups]]\nname = 'x'", "kind is missing")  # fmt: skip

    def test_of_presets(self) -> None:
        self.expect(HEADER + '[[dies]]\npreset = "drm"\n', 4, "no preset 'drm'", "'dram'")
        # The group that a preset has in another place is still found in the file.
        text = HEADER + '[[dies]]\npreset = "dram"\n[[dies.groups]]\nname = "pads"\nturned = 2\n'
        self.expect(text, 7, "dies[1].groups[1].turned: 2 is outside 0 to 1")

    def test_of_texts_that_are_no_layout(self) -> None:
        for text, *parts in (
            ("", "f.toml:1: no layout file"),
            ('format = "other"', "f.toml:1: no layout file"),
            ("\na = \nb = 1", "f.toml:2: not valid TOML: Invalid value at column 5"),
            ("a = ", "f.toml:1: not valid TOML: Invalid value"),
            (TEXT[: TEXT.rindex("spacing_nm = ") + 13], "not valid TOML"),
            ("x = " + 100_000 * "[", "not valid TOML: nested too deeply"),
            ("x = " + 5000 * "9", "not valid TOML"),
            (HEADER, "dies is missing"),
            (HEADER + "dies = 3", "dies: 3 is not a list"),
            (HEADER + "dies = []", "dies: 0 entries"),
            (HEADER + "dies = [3]", "dies[1]: 3 is not a table"),
            (HEADER + "[[dies]]\ngroups = []", "groups: 0 entries"),
            (SMALL[: SMALL.index("  [0, 0")] + "]", "blocks: 0 blocks: there must be 1 to"),
            (HEADER + f"[[dies]]\nseed = {'9' * 400}", "too large"),
        ):
            with self.subTest(text[:40]), self.assertRaises(IcwaferError) as caught:
                parse_layout(text, "f.toml")
            for part in parts:
                self.assertIn(part, str(caught.exception))

    def test_of_binary_files(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "a.layout.toml"
            path.write_bytes(bytes(range(256)) * 10)
            with self.assertRaisesRegex(IcwaferError, "not a text file"):
                read_layout(path)

    def test_of_damaged_packed_blocks(self) -> None:
        text = layout_text(listed(2000))
        at = text.index("packed = '") + len("packed = '")
        bomb = base64.b64encode(zlib.compress(bytes(100_000_000), 9)).decode()
        for new, part in (
            (text[:at] + text[at + 4 :], "damaged"),
            (text[:at] + "\u00e9" + text[at:], "damaged"),
            (text[: at + 400] + text[text.rindex("'") :], "does not hold 2000 blocks"),
            (text.replace("count = 2000", "count = 1999"), "does not hold 1999 blocks"),
            (text.replace("count = 2000", "count = 2001"), "does not hold 2001 blocks"),
            (text.replace("count = 2000", "count = 0"), "must be 1 to 20000000"),
            (text.replace("count = 2000", "count = 99999999999"), "must be 1 to 20000000"),
            (text[:at] + bomb + text[text.rindex("'") :], "does not hold 2000 blocks"),
            (text.replace("count = 2000\n", ""), "needs either 'rows', or"),
        ):
            with self.subTest(part), self.assertRaisesRegex(IcwaferError, part):
                parse_layout(new, "f.toml")

    def test_any_damage_is_either_an_error_of_one_line_or_a_layout(self) -> None:
        rng = np.random.default_rng(11)
        texts = [TEXT, SMALL, layout_text(listed(1200))]
        refused = 0
        for turn in range(300):
            text = texts[turn % 3]
            start, length = rng.integers(len(text)), rng.integers(1, 30)
            noise = "".join(rng.choice(list("[]{}=\",.#-0 9ae\n\\'"), rng.integers(0, 12)))
            damaged = text[:start] + noise + text[start + length :]
            try:
                parse_layout(damaged, "f.toml")
            except IcwaferError as error:
                refused += 1
                self.assertNotIn("\n", str(error))
                self.assertLess(len(str(error)), 400)
        self.assertGreater(refused, 200)


class Lines(unittest.TestCase):
    def test_of_every_key_in_a_text_with_strings_and_brackets(self) -> None:
        text = (
            'a = "[b]\\"#"  # [c]\n'
            "d.e = '''x\n[f]\ny'''\n"
            "[t.'u v']  # t\n"
            'g = [ # {\n 1, "]", [2,\n 3], {h = 1} ]\n'
            "[[l]]\nm = 1\n[[l.n]]\n[[l.n]]\no = {p = {q = 2}}\n[[l]]\nm = 3"
        )
        for path, line in (
            (("a",), 1),
            (("d", "e"), 2),
            (("t", "u v"), 5),
            (("t", "u v", "g"), 6),
            (("t", "u v", "g", 0), 7),
            (("l", 0, "m"), 10),
            (("l", 0, "n", 1, "o", "p"), 13),
            (("l", 1, "m"), 15),
            (("nothing",), 1),
        ):
            with self.subTest(path):
                self.assertEqual(line_of(text, path), line)


if __name__ == "__main__":
    unittest.main()
