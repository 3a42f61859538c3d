# SPDX-License-Identifier: GPL-2.0-or-later
"""White stays white and rainbows stay rainbows in every working space, through real Cycles.

The `cycles` program renders one scene with OpenColorIO configurations whose scene-linear role is
ITU-R BT.709, BT.2020 or ACEScg.
"""

from __future__ import annotations

import unittest
from pathlib import Path

import host
import numpy as np
import OpenImageIO as oiio
import PyOpenColorIO as ocio

# From ACES2065-1 (AP0, the role `aces_interchange`) to linear light; rows are red, green, blue.
# Academy S-2014-004 for ACEScg; for the others, ACES' published CSC transforms (Bradford, D60 to
# D65).
FROM_AP0 = {
    "ACEScg": [
        [1.4514393161, -0.2365107469, -0.2149285693],
        [-0.0765537734, 1.1762296998, -0.0996759264],
        [0.0083161484, -0.0060324498, 0.9977163014],
    ],
    "Rec.2020": [
        [1.4905096, -0.2661701, -0.2243395],
        [-0.0801755, 1.1821668, -0.1019913],
        [0.0032278, -0.0347768, 1.0315490],
    ],
    "Rec.709": [
        [2.5216494, -1.1368885, -0.3849175],
        [-0.2752136, 1.3697052, -0.0943925],
        [-0.0159251, -0.1478064, 1.1638058],
    ],
}

#: A wafer seen straight from above by an orthographic camera, and a distant lamp beside it.
SCENE = """<cycles>
<transform matrix="1 0 0 0  0 1 0 0  0 0 -1 0  0 0 5 1">
  <camera width="48" height="48" camera_type="{camera}" fov="1.4"/>
</transform>
<film filter_type="box" filter_width="1"/>
<background><background name="world" strength="0"/>
  <connect from="world background" to="output surface"/></background>
<shader name="wafer">
  <ic_wafer_bsdf name="chip" model="CS348B" specular="0" {switches}/>
  <connect from="chip BSDF" to="output surface"/>
</shader>
<shader name="lamp"><emission name="glow"/>
  <connect from="glow emission" to="output surface"/></shader>
<state shader="lamp">
  <light light_type="point" size="0" co="0 2 6" strength="100 100 100"/>
</state>
<state shader="wafer">
  <mesh P="-9 -9 0  9 -9 0  9 9 0  -9 9 0" nverts="4" verts="0 1 2 3"/>
</state>
</cycles>
"""


def _configuration(name: str, folder: Path) -> Path:
    """An OpenColorIO configuration whose scene-linear space is `name`."""
    config = ocio.Config()
    config.setMajorVersion(2)
    config.addColorSpace(ocio.ColorSpace(name="ACES2065-1", family="", encoding="scene-linear"))
    matrix = np.eye(4)
    matrix[:3, :3] = FROM_AP0[name]
    working = ocio.ColorSpace(name=name, encoding="scene-linear")
    working.setTransform(
        ocio.MatrixTransform(matrix=list(matrix.flat)), ocio.COLORSPACE_DIR_FROM_REFERENCE
    )
    config.addColorSpace(working)
    raw = ocio.ColorSpace(name="Raw", isData=True)
    config.addColorSpace(raw)
    for role, space in {
        "scene_linear": name, "aces_interchange": "ACES2065-1", "data": "Raw", "default": name,
    }.items():  # fmt: skip
        config.setRole(role, space)
    config.addDisplayView("sRGB", "Raw", "Raw")
    config.setFileRules(ocio.FileRules())
    path = folder / f"{name}.ocio"
    path.write_text(config.serialize())
    return path


class WorkingSpaces(unittest.TestCase):
    folder: Path

    @classmethod
    def setUpClass(cls) -> None:
        cls.folder = host.fresh_folder("working_spaces")

    def render(self, space: str, picture: str, switches: str, camera: str) -> np.ndarray:
        """Pixels (48, 48, 3) of the scene, linear in the working space."""
        scene = self.folder / f"{picture}.xml"
        scene.write_text(SCENE.format(switches=switches, camera=camera))
        output = self.folder / f"{picture} {space}.exr"
        ended = host.run(
            host.built_cycles(), "--background", "--samples", "4", "--width", "48", "--height",
            "48", "--output", output, scene, folder=self.folder, seconds=120,
            environment={"OCIO": str(_configuration(space, self.folder))},
        )  # fmt: skip
        self.assertEqual(ended.status, 0, ended.tail())
        return oiio.ImageBuf(str(output)).get_pixels(oiio.FLOAT)[..., :3]

    def test_flat_reflectance_is_neutral(self) -> None:
        """With every effect off the reflectance is flat, and the picture grey to 1e-4."""
        off = 'use_grating="false" use_thin_film="false" use_wire_diffraction="false"'
        for space in FROM_AP0:
            with self.subTest(space):
                pixels = self.render(space, "flat", off, "orthograph")
                self.assertGreater(pixels.min(), 0.0)
                grey = pixels.mean(axis=-1, keepdims=True)
                self.assertLess(np.abs(pixels / grey - 1.0).max(), 1e-4)

    def test_colours_are_those_of_the_space(self) -> None:
        """A diffracted colour has other coordinates in another space, and never negative ones."""
        pictures = {
            space: self.render(space, "rainbow", 'use_thin_film="false"', "perspective")
            for space in FROM_AP0
        }
        for space, pixels in pictures.items():
            self.assertGreaterEqual(pixels.min(), 0.0, space)
            self.assertGreater(pixels.max(), 0.0, space)
        narrow, wide = pictures["Rec.709"], pictures["ACEScg"]
        self.assertGreater(np.abs(narrow - wide).max(), 0.02 * wide.max())


if __name__ == "__main__":
    unittest.main()
