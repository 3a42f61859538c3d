# SPDX-License-Identifier: GPL-2.0-or-later
"""Damaged, malicious and mistaken files: one clear line, nothing written, little spent."""

from __future__ import annotations

import resource
import struct
import unittest
from pathlib import Path

from import_support import box, write_layouts
from support import CommandCase, write

from icwafer.errors import IcwaferError
from icwafer.layout_import.importer import import_layout
from icwafer.layout_import.process import read_process
from icwafer.layout_import.reader import Limits, Request

SQUARE = {"68/20": [box(0, 0, 90_000, 90_000)]}

PROCESS = """format = "icwafer-process"
version = 1
name = "mine"
oxide_top_um = 2.0

[[layers]]
name = "m1"
gds = ["8/0"]
bottom_um = 1.0
thickness_um = 0.5
metal = "copper"
"""


def record(kind: int, data_type: int, data: bytes = b"") -> bytes:
    """One record of a GDSII file."""
    return struct.pack(">HBB", 4 + len(data), kind, data_type) + data


def real(value: float) -> bytes:
    """An 8-byte real of GDSII: excess-64 exponent of 16, 56 bits of mantissa."""
    exponent = 64
    while value < 1 / 16:
        value, exponent = value * 16, exponent - 1
    return bytes([exponent]) + int(value * 2**56).to_bytes(7, "big")


HEADER = (
    record(0x00, 2, struct.pack(">h", 600))
    + record(0x01, 2, bytes(24))
    + record(0x02, 6, b"LIB1")
    + record(0x03, 5, real(1e-3) + real(1e-9))
)
END = record(0x04, 0)
BOX = (
    record(0x08, 0)
    + record(0x0D, 2, struct.pack(">h", 68))
    + record(0x0E, 2, struct.pack(">h", 20))
    + record(0x10, 3, struct.pack(">10i", 0, 0, 0, 9000, 9000, 9000, 9000, 0, 0, 0))
    + record(0x11, 0)
)


def cell(name: bytes, elements: bytes) -> bytes:
    return record(0x05, 2, bytes(24)) + record(0x06, 6, name) + elements + record(0x07, 0)


def instance(name: bytes) -> bytes:
    place = record(0x10, 3, struct.pack(">2i", 1, 1))
    return record(0x0A, 0) + record(0x12, 6, name) + place + record(0x11, 0)


def array(name: bytes, columns: int, rows: int, corners: tuple[int, ...]) -> bytes:
    return (
        record(0x0B, 0)
        + record(0x12, 6, name)
        + record(0x13, 2, struct.pack(">2h", columns, rows))
        + record(0x10, 3, struct.pack(">6i", *corners))
        + record(0x11, 0)
    )


def nested(levels: int) -> bytes:
    """A file with cells in cells in cells."""
    names = [b"C%07d" % i for i in range(levels)]
    inner = [instance(name) for name in names[1:]] + [BOX]
    return HEADER + b"".join(cell(*pair) for pair in zip(names, inner)) + END


class BadFileCase(CommandCase):
    def refused(self, path: Path, *parts: str, options: tuple[str, ...] = ()) -> None:
        """One line that names the file, exit status 1, nothing new in the folder."""
        before = sorted(self.folder.rglob("*"))
        output = str(self.folder / "chip.layout.toml")
        arguments = ["layout", "import", str(path), "-o", output, *options]
        self.expect_error(arguments, 1, path.name, *parts)
        self.assertEqual(sorted(self.folder.rglob("*")), before)

    def bytes_file(self, name: str, content: bytes) -> Path:
        path = self.folder / name
        path.write_bytes(content)
        return path

    def klayout_file(self, name: str, cells: dict, **file: object) -> Path:
        path = self.folder / name
        write_layouts({path: {"cells": cells, **file}})
        return path


class Damaged(BadFileCase):
    def test_truncated(self) -> None:
        whole = HEADER + b"".join(cell(b"CELL%02d" % i, BOX * 20) for i in range(20)) + END
        path = self.bytes_file("cut.gds", whole[: len(whole) // 2])
        self.refused(path, "Unexpected end-of-file", "write it anew")

    def test_truncated_compression(self) -> None:
        whole = self.klayout_file("chip.gds.gz", {"TOP": SQUARE}).read_bytes()
        self.refused(self.bytes_file("cut.gds.gz", whole[:-20]), "write it anew")

    def test_no_layout_at_all(self) -> None:
        self.refused(self.bytes_file("text.gds", b"Dear reader,\n"), "unknown format")
        self.refused(self.bytes_file("empty.gds", b""), "unknown format")
        self.refused(self.bytes_file("noise.oas", bytes(range(256)) * 40), "unknown format")

    def test_no_such_file(self) -> None:
        self.refused(self.folder / "missing.gds", "no such file")


class Mistaken(BadFileCase):
    def test_empty_cell(self) -> None:
        path = self.klayout_file("chip.gds", {"TOP": {}})
        self.refused(path, "no shape")

    def test_wrong_units(self) -> None:
        self.refused(self.klayout_file("a.gds", {"TOP": SQUARE}, dbu=1000.0), "1000 um", "units")
        self.refused(self.klayout_file("b.gds", {"TOP": SQUARE}, dbu=1e-9), "1e-09 um", "units")

    def test_array_without_pitch(self) -> None:
        for corners, count in (((0, 0, 0, 0, 0, 90_000), 30), ((0, 0, 90_000, 0, 0, 0), 20)):
            body = cell(b"LINE", BOX) + cell(b"TOPS", array(b"LINE", 30, 20, corners))
            path = self.bytes_file("chip.gds", HEADER + body + END)
            self.refused(path, f"{count} times the cell 'LINE'", "pitch of 0")

    def test_array_with_pitch_is_fine(self) -> None:
        repeated = array(b"LINE", 3, 2, (0, 0, 60_000, 0, 0, 40_000))
        body = cell(b"LINE", BOX) + cell(b"TOPS", repeated)
        path = self.bytes_file("chip.gds", HEADER + body + END)
        output = str(self.folder / "chip.layout.toml")
        status, _, error = self.icwafer("layout", "import", str(path), "-o", output)
        self.assertEqual(status, 0, error)

    def test_unknown_layers(self) -> None:
        path = self.klayout_file("chip.gds", {"TOP": {"1/0": SQUARE["68/20"]}})
        self.refused(path, "'sky130'", "1/0", "--layers")

    def test_known_layers_without_shapes(self) -> None:
        cells = {"TOP": {"1/0": SQUARE["68/20"]}, "OTHER": SQUARE}
        path = self.klayout_file("chip.gds", cells)
        self.refused(path, "no shapes on the metal", options=("--top", "TOP"))

    def test_top_cells(self) -> None:
        path = self.klayout_file("chip.gds", {"RIGHT": SQUARE, "LEFT": SQUARE})
        self.refused(path, "LEFT, RIGHT", "--top")
        self.refused(path, "did you mean 'LEFT'", options=("--top", "LEFD"))

    def test_def_without_lef(self) -> None:
        path = write(self.folder / "chip.def", "VERSION 5.8 ;\nDESIGN chip ;\nEND DESIGN\n")
        self.refused(path, "--lef")
        missing = self.folder / "no.lef"
        arguments = ["layout", "import", str(path), "--lef", str(missing)]
        self.expect_error(arguments, 1, "no.lef", "no such file")

    def test_def_with_a_cell_that_no_lef_has(self) -> None:
        text = (
            "VERSION 5.8 ;\nDESIGN chip ;\nUNITS DISTANCE MICRONS 1000 ;\n"
            "DIEAREA ( 0 0 ) ( 9000 9000 ) ;\nCOMPONENTS 1 ;\n"
            "- u1 missing_cell + PLACED ( 0 0 ) N ;\nEND COMPONENTS\nEND DESIGN\n"
        )
        path = write(self.folder / "chip.def", text)
        lef = write(self.folder / "tech.lef", "VERSION 5.7 ;\nEND LIBRARY\n")
        self.refused(path, "missing_cell", options=("--lef", str(lef)))

    def test_output_name(self) -> None:
        path = self.klayout_file("chip.gds", {"TOP": SQUARE})
        arguments = ["layout", "import", str(path), "-o", str(self.folder / "chip.toml")]
        self.expect_error(arguments, 1, ".layout.toml")
        arguments = ["layout", "import", str(path), "--map", str(self.folder / "map.xyz")]
        self.expect_error(arguments, 1, "map.xyz", ".png")

    def test_options(self) -> None:
        for option in ("--tile", "--window", "--limit-gb"):
            for value in ("0", "-5", "nan", "wide"):
                arguments = ["layout", "import", "chip.gds", f"{option}={value}"]
                self.expect_error(arguments, 2, option, value)


class Malicious(BadFileCase):
    def test_a_million_levels(self) -> None:
        path = self.bytes_file("deep.gds", nested(1_000_000))
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss
        self.refused(path, "nested very deep", "--limit-s", options=("--limit-s", "2"))
        most_kb = max(before, resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)
        self.assertLess(most_kb, 3 * 2**20)

    def test_too_many_levels(self) -> None:
        self.refused(self.bytes_file("deep.gds", nested(1500)), "1499 levels", "at most 1000")

    def test_more_shapes_than_atoms(self) -> None:
        """Each level has ten of the one below: 10^18 shapes in some kilobytes."""
        names = [b"LEVEL%03d" % i for i in range(19)]
        cells = cell(names[0], BOX)
        for below, name in zip(names, names[1:]):
            cells += cell(name, instance(below) * 10)
        self.refused(self.bytes_file("bomb.gds", HEADER + cells + END), "1e+18 shapes")

    def test_memory(self) -> None:
        path = self.bytes_file("chip.gds", HEADER + cell(b"TOPS", BOX * 3_000_000) + END)
        limits = Limits(memory_gb=0.6)
        with self.assertRaisesRegex(IcwaferError, "more than 0.6 GB .* --limit-gb"):
            import_layout(Request(path, read_process("sky130"), limits=limits))


class LayerMaps(CommandCase):
    def expect(self, text: str, *parts: str) -> None:
        path = write(self.folder / "mine.toml", text)
        gds = self.folder / "chip.gds"
        arguments = ["layout", "import", str(gds), "--layers", str(path)]
        self.expect_error(arguments, 1, *parts)

    def test_messages(self) -> None:
        for old, new, *parts in (
            ("thickness_um = 0.5", "thickness_um = -1", "mine.toml:10", "-1", "0.001 to 20"),
            ("thickness_um = 0.5", "thickness_um = true", "mine.toml:10", "not a number"),
            ("thickness_um = 0.5", "thicknes_um = 0.5", ":10", "did you mean 'thickness_um'"),
            ("thickness_um = 0.5\n", "", "mine.toml:6", "thickness_um is missing"),
            ('"copper"', '"coper"', "mine.toml:11", "did you mean 'copper'"),
            ('["8/0"]', '["8"]', "mine.toml:8", "68/20"),
            ('["8/0"]', "8", "mine.toml:8", "must be a list"),
            ('"m1"', '""', "mine.toml:7", "no name"),
            ("version = 1", "version = 2", "mine.toml:1", "version = 1"),
            ("oxide_top_um = 2.0", "oxide_top_um = ", "mine.toml", "not valid TOML"),
            ("oxide_top_um = 2.0", "", "mine.toml:1", "oxide_top_um is missing"),
        ):
            with self.subTest(old=old, new=new):
                self.expect(PROCESS.replace(old, new), *parts)

    def test_layers_twice(self) -> None:
        second = PROCESS[PROCESS.index("[[") :].replace('"m1"', '"m2"')
        self.expect(PROCESS + second, "mine.toml:14", "'8/0' is already taken")

    def test_unknown_process(self) -> None:
        arguments = ["layout", "import", "chip.gds", "--layers", "sky13"]
        self.expect_error(arguments, 1, "did you mean 'sky130'", ".toml")


if __name__ == "__main__":
    unittest.main()
