# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes for the standalone `cycles` program, in its XML."""

from __future__ import annotations

import math

import dispersion
import numpy as np
from dispersion import Mount


def _numbers(*values: float) -> str:
    return " ".join(f"{value:.9g}" for value in values)


def scene(mount: Mount) -> str:
    """The mount's scene: a grating under a lamp, without film, wire diffraction and mirror.

    Cycles' cameras look along their own z axis and see from -1 to 1.
    """
    right, top, forward = dispersion.camera_axes(mount)
    scale = 1.0 if mount.perspective else 0.5 * mount.view
    matrix = np.zeros((4, 4))
    matrix[:3, :3] = scale * right, scale * top, forward
    matrix[3] = *mount.camera, 1.0
    kind = "perspective" if mount.perspective else "orthograph"
    turn = math.radians(mount.turn_deg)
    cosine, sine = math.cos(turn), math.sin(turn)
    return f"""<cycles>
<transform matrix="{_numbers(*matrix.flat)}">
  <camera width="{mount.size_px}" height="{mount.size_px}" camera_type="{kind}"
          fov="{_numbers(2.0 * math.atan(0.5 * mount.view))}"/>
</transform>
<film filter_type="box" filter_width="1"/>
<background><background name="world" strength="0"/>
  <connect from="world background" to="output surface"/></background>
<shader name="wafer">
  <ic_wafer_bsdf name="chip" model="CS348B" wire_spacing="{_numbers(mount.spacing_nm)}"
                 direction="{_numbers(math.radians(mount.direction_deg))}"
                 lobe_width="{_numbers(mount.lobe_width)}" specular="0"
                 use_thin_film="false" use_wire_diffraction="false"/>
  <connect from="chip BSDF" to="output surface"/>
</shader>
<shader name="lamp">
  <emission name="glow"/>
  <connect from="glow emission" to="output surface"/>
</shader>
<state shader="lamp">
  <light light_type="point" size="0" co="{_numbers(*mount.lamp)}" strength="100 100 100"/>
</state>
<transform matrix="{_numbers(cosine, sine, 0, 0, -sine, cosine, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1)}">
  <state shader="wafer">
    <mesh P="-20 -20 0  20 -20 0  20 20 0  -20 20 0" nverts="4" verts="0 1 2 3"/>
  </state>
</transform>
</cycles>
"""
