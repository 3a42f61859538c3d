# SPDX-License-Identifier: GPL-2.0-or-later
"""Rendering a picture: it appears complete or not at all, and only when something changed."""

from __future__ import annotations

import os
import unittest

from support import CommandCase, write

from icwafer import paths, render
from icwafer.errors import IcwaferError

#: Stands in for Blender: writes what it was asked for, and counts how often.
BLENDER = """#!/bin/sh
while [ "$1" != --output ]; do shift; done
echo "Fra:1 | Sample 1/1" | tee -a "$2.count" > "$2.png"
echo exr > "$2.exr"
"""


class RenderTest(CommandCase):
    def setUp(self) -> None:
        super().setUp()
        write(paths.BLENDER, BLENDER.replace("$2.count", f"{self.folder}/count"), 0o755)
        self.script = write(self.folder / "pictures.py", "")
        self.replace(render, imported=lambda _: [self.script])
        self.base = self.folder / "out" / "demo" / "wafer"

    def times_rendered(self) -> int:
        return len((self.folder / "count").read_text().splitlines())

    def test_both_files_and_nothing_else(self) -> None:
        paths = render.render("full", self.base)
        self.assertEqual([path.name for path in paths], ["wafer.png", "wafer.exr"])
        self.assertEqual(sorted(self.base.parent.iterdir()), sorted(paths))

    def test_only_when_something_changed(self) -> None:
        render.render("full", self.base)
        render.render("full", self.base)
        self.assertEqual(self.times_rendered(), 1)
        later = self.base.with_suffix(".png").stat().st_mtime + 10
        os.utime(self.script, (later, later))
        render.render("full", self.base)
        self.assertEqual(self.times_rendered(), 2)

    def test_a_failure_leaves_the_last_picture(self) -> None:
        png = write(self.base.with_suffix(".png"), "last")
        write(paths.BLENDER, "#!/bin/sh\necho 'Error: no camera'; exit 1\n", 0o755)
        with self.assertRaisesRegex(IcwaferError, "Rendering full failed: Error: no camera"):
            render.render("full", self.base)
        self.assertEqual(png.read_text(), "last")

    def test_no_blender(self) -> None:
        paths.BLENDER.unlink()
        with self.assertRaisesRegex(IcwaferError, "not built yet"):
            render.render("full", self.base)


if __name__ == "__main__":
    unittest.main()
