# SPDX-License-Identifier: GPL-2.0-or-later
"""Blender's own Python tests end the same way in the built Blender as in Debian's own.

They stand in `tests/python` of Blender's source; the ones here need no data beside that folder.
What is compared is all that they print, not only whether they pass: which test functions ran and
how each ended, every add-on and module that loads. A test that fails in Debian's Blender has to
fail in the same way here. Beside them, the whole Python API and the manual pages that it leads to.

Left out: `bl_mesh_validate` (random without a seed), `bl_mesh_modifiers` (uses a handler that
Blender 3.4 no longer has), `bl_rst_completeness` (needs the generated API manual),
`bl_run_operators` (off in Blender's own CMakeLists, ends differently each time),
`bl_rna_manual_reference` (minutes; `test_api` compares the same) and what reads the separate
repository of test files.
"""

from __future__ import annotations

import re
import unittest
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import host

# What the tests' CMakeLists gives to every test.
STANDARD_OPTIONS = (
    "--background",
    "-noaudio",
    "--factory-startup",
    "--debug-memory",
    "--debug-exit-on-error",
    "--python-exit-code", "1",
)  # fmt: skip

# Parts of the output that are another in each run or each installation.
VARYING = (
    (re.compile(r" in \d+\.\d+s"), ""),
    # First of all: a name at random may look like anything below.
    (re.compile(r"(/\S*)?/tmp[a-z0-9_]{8}\b"), "<temporary folder>"),
    (re.compile(r"0x[0-9a-f]+"), "<address>"),
    # What the interpreter had loaded when it crashed, which is the end of a test in both.
    (re.compile(r"^Extension modules: .*"), "Extension modules"),
    # Where the compiler found Blender's source.
    (re.compile(r"\S*\bsource/blender/"), "source/blender/"),
)

# What the built Blender has more, and only this: the RNA paths of the node, the add-on's classes.
OURS = re.compile(r"ShaderNodeBsdfICWafer|^(\w+_(OT|PT|MT)|IC_PG)_ic_", re.IGNORECASE)
ADDON = re.compile(r"^\s*(en|dis)abling: ic_wafer$")

# Its modules, below the installed scripts.
OUR_MODULES = ("addons/ic_wafer", "modules/icwafer", "startup/icwafer_manual")

# What parts of Blender add to the API, by the name of the part in bpy.app.build_options. Where one
# of the Blenders is built without that part, it lacks this. The project's usual build leaves out
# what has nothing to do with rendering (ICWAFER_FULL has it); Debian's has no PDF export.
OF_A_PART = {
    "collada": re.compile(r"^WM_OT_collada_(im|ex)port\b"),
    "fluid": re.compile(
        r"^FluidDomainSettings\.(color|density|flame|heat|temperature|velocity)_grid\b"
    ),
    "haru": re.compile(r"^WM_OT_gpencil_export_pdf\b"),
    "input_ndof": re.compile(r"^PreferencesInput\.ndof_|^[A-Z0-9]+_OT_(view_)?ndof"),
}


@dataclass(frozen=True)
class Outcome:
    """How a test script ended, and each line that it printed with its number of occurrences."""

    status: int
    lines: Counter[str]


def installation_folders(blender: Path) -> tuple[str, ...]:
    """Where a Blender keeps its scripts and data: beside the program, or as Debian has it."""
    beside = blender.resolve().parent / "3.4"
    return (str(beside),) if beside.is_dir() else ("/usr/share/blender",)


class UnharmedPython(unittest.TestCase):
    folder: Path
    tests: Path

    @classmethod
    def setUpClass(cls) -> None:
        cls.folder = host.fresh_folder("unharmed_python")
        cls.tests = host.host_source() / "tests" / "python"

    def outcome(self, blender: Path, work: Path, script: str, *arguments: str) -> Outcome:
        ended = host.run(
            blender,
            *STANDARD_OPTIONS,
            "--python",
            self.tests / f"{script}.py",
            "--",
            *(argument.format(work=work) for argument in arguments),
            folder=work,
            seconds=120,
        )
        text = ended.output.replace(str(work), "<work>")
        for installation in installation_folders(blender):
            text = text.replace(installation, "<installation>")
        for pattern, replacement in VARYING:
            text = pattern.sub(replacement, text)
        return Outcome(ended.status, Counter(line for line in text.splitlines() if line.strip()))

    def assert_same(
        self,
        script: str,
        *arguments: str,
        proof: str,
        as_stock: Callable[[str], str] = lambda line: line,
    ) -> None:
        """`proof` is a line that shows that the test did its work in the stock Blender.

        `{work}` in an argument stands for a folder to write to. `as_stock` makes of a line of the
        built Blender what it would be without node and add-on; of a line of their own nothing.
        """

        def outcome(role: str, blender: Path) -> Outcome:
            work = self.folder / script / role
            work.mkdir(parents=True)
            return self.outcome(blender, work, script, *arguments)

        stock, built = host.in_both(outcome)
        self.assertTrue(
            any(re.search(proof, line) for line in stock.lines),
            f"{script} printed nothing like {proof!r}:\n" + "\n".join(stock.lines),
        )
        built_lines = Counter({as_stock(line): count for line, count in built.lines.items()})
        del built_lines[""]
        self.assertEqual(
            (list(built_lines - stock.lines), list(stock.lines - built_lines)),
            ([], []),
            f"{script}: lines only of the built Blender, of the stock one",
        )
        self.assertEqual(built.status, stock.status, script)

    def assert_same_unittest(self, script: str) -> None:
        self.assert_same(script, "-v", proof=r"^Ran [1-9]\d* test")

    def assert_same_files(self, script: str, *, proof: str) -> None:
        """For a test that writes `.blend` files and reads them again."""
        self.assert_same(script, "--output-dir", "{work}", proof=proof)

    def test_keymap_completeness(self) -> None:
        self.assert_same("bl_keymap_completeness", proof="^done!")

    def test_keymap_validate(self) -> None:
        self.assert_same("bl_keymap_validate", "--relaxed", proof="OK!")

    def test_load_addons(self) -> None:
        self.assert_same(
            "bl_load_addons",
            proof="enabling: cycles",
            as_stock=lambda line: "" if ADDON.search(line) else line,
        )

    def test_load_modules(self) -> None:
        """All of ours load, too."""
        scripts = Path(installation_folders(host.built_blender())[0]) / "scripts"
        ours = sum(len(list((scripts / name).rglob("*.py"))) for name in OUR_MODULES)

        def without_ours(line: str) -> str:
            return re.sub(
                r"^loaded (\d+) modules", lambda m: f"loaded {int(m[1]) - ours} modules", line
            )

        self.assert_same("bl_load_py_modules", proof=r"loaded \d+ modules", as_stock=without_ours)

    def test_bundled_modules(self) -> None:
        """Debian installs Python's modules on their own, so this may fail, at the same import."""
        self.assert_same("bl_bundled_modules", proof="Blender quit|ModuleNotFoundError")

    def test_bpy_path(self) -> None:
        self.assert_same_unittest("bl_pyapi_bpy_path")

    def test_units(self) -> None:
        self.assert_same_unittest("bl_pyapi_bpy_utils_units")

    def test_mathutils(self) -> None:
        self.assert_same_unittest("bl_pyapi_mathutils")

    def test_driver_secure_eval(self) -> None:
        self.assert_same_unittest("bl_pyapi_bpy_driver_secure_eval")

    def test_idprop(self) -> None:
        self.assert_same_unittest("bl_pyapi_idprop")

    def test_idprop_datablock(self) -> None:
        self.assert_same("bl_pyapi_idprop_datablock", proof="Blender quit")

    def test_prop_array(self) -> None:
        self.assert_same_unittest("bl_pyapi_prop_array")

    def test_text(self) -> None:
        self.assert_same_unittest("bl_pyapi_text")

    def test_id_management(self) -> None:
        self.assert_same_unittest("bl_id_management")

    def test_blendfile_io(self) -> None:
        self.assert_same_files("bl_blendfile_io", proof="read_data")

    def test_blendfile_liblink(self) -> None:
        self.assert_same_files("bl_blendfile_liblink", proof="orig_data")

    def test_blendfile_library_overrides(self) -> None:
        self.assert_same_files("bl_blendfile_library_overrides", proof="Saved")

    def test_rna_defaults(self) -> None:
        """It stops at a collection that Blender 2.8 removed, in both."""
        self.assert_same("bl_rna_defaults", proof="test_Curve_SURFACE")

    def test_api(self) -> None:
        """Every class, property, function and operator that Python sees, and its manual page."""
        stock, built = host.in_both(
            lambda role, blender: host.run_inside(
                blender, "dump_api", {}, folder=self.folder / role, seconds=60
            )
        )
        explained = [OURS] + [
            lines
            for part, lines in OF_A_PART.items()
            if stock["parts"][part] != built["parts"][part]
        ]
        for subject, least in (("api", 100_000), ("manual", 3_000)):
            with self.subTest(subject):
                self.assertGreater(len(stock[subject]), least)
                differing = set(stock[subject]).symmetric_difference(built[subject])
                unexplained = [
                    line for line in differing if not any(e.search(line) for e in explained)
                ]
                self.assertEqual(sorted(unexplained), [])


if __name__ == "__main__":
    unittest.main()
