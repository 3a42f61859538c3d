# SPDX-License-Identifier: GPL-2.0-or-later
"""The mesh that Blender gets is the die: one face per block, with the wires of the block."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "scripts" / "python"
BLENDER = Path(os.environ.get("ICWAFER_BLENDER", ROOT / "build" / "install" / "blender"))
sys.path.insert(0, str(PACKAGE))

from icwafer.attributes import OF_FACES  # noqa: E402
from icwafer.chips.die import generate  # noqa: E402
from icwafer.chips.model import MM  # noqa: E402
from icwafer.pictures import PICTURES  # noqa: E402

DUMP_MESH = """
import sys
sys.path.insert(0, sys.argv[-2])
import numpy as np
from icwafer import pictures
from icwafer.chips import die
from icwafer.scene.mesh import SOCKET_OF_ATTRIBUTE, die_mesh
mesh = die_mesh(die.generate(pictures.PICTURES["full"].die))
assert not mesh.validate(), "the mesh is not valid"
def read(items, name, width=1):
    values = np.empty(len(items) * width, dtype=np.float32)
    items.foreach_get(name, values)
    return values.reshape(len(items), width)
np.savez(
    sys.argv[-1],
    normal=read(mesh.polygons, "normal", 3),
    area=read(mesh.polygons, "area"),
    center=read(mesh.polygons, "center", 3),
    **{a.name: read(a.data, "value") for a in mesh.attributes if a.name in SOCKET_OF_ATTRIBUTE},
)
"""


class DieMesh(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        cls.die = generate(PICTURES["full"].die)
        with tempfile.TemporaryDirectory() as folder:
            dump = Path(folder) / "mesh.npz"
            subprocess.run(
                [BLENDER, "-b", "--factory-startup", "--python-exit-code", "1"]
                + ["--python-expr", DUMP_MESH, "--", PACKAGE, dump],
                check=True,
                capture_output=True,
                timeout=120,
            )
            cls.mesh = dict(np.load(dump))

    def test_faces_look_up(self) -> None:
        np.testing.assert_allclose(self.mesh["normal"], [[0, 0, 1]] * len(self.die), atol=1e-6)

    def test_each_face_is_in_the_middle_of_its_block(self) -> None:
        rect_mm = self.die.rect_nm / MM
        size_mm = [self.die.spec.width_mm, self.die.spec.height_mm]
        middle = (rect_mm[:, :2] + rect_mm[:, 2:] - size_mm) / 2
        # Single precision of coordinates up to 7.5 mm.
        np.testing.assert_allclose(self.mesh["center"][:, :2], middle, atol=2e-6)

    def test_gaps_are_thin(self) -> None:
        share = self.mesh["area"][:, 0] / (self.die.area_nm2 / MM**2)
        self.assertTrue(((share > 0.35) & (share < 1)).all())
        self.assertGreater(np.median(share), 0.8)

    def test_wires_are_those_of_the_block(self) -> None:
        """What a mesh has no attribute for reads as 0."""
        none = np.zeros((len(self.die), 1))
        for attribute in OF_FACES:
            found = self.mesh.get(attribute.name, none)[:, 0]
            values = getattr(self.die, attribute.name.removeprefix("ic_"))
            np.testing.assert_array_equal(found, values, attribute.name)

    def test_no_attribute_is_0_everywhere(self) -> None:
        carried = [self.mesh[a.name] for a in OF_FACES if a.name in self.mesh]
        self.assertTrue(0 < len(carried) < len(OF_FACES))  # this die has no wires across
        self.assertTrue(all(values.any() for values in carried))


if __name__ == "__main__":
    unittest.main()
