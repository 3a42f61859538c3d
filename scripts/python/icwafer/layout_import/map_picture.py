# SPDX-License-Identifier: GPL-2.0-or-later
"""A map of what an import found, to look at: false colours, and the wires of each tile."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np
from matplotlib.image import imsave

from icwafer.chips.die import generate
from icwafer.chips.model import Layout
from icwafer.chips.view import die_picture
from icwafer.files import replacing

SIDE_PX = 1024


def layout_map(layout: Layout) -> np.ndarray:
    """The first die from above in false colours, (height, width, 3) float32 in 0 to 1.

    The colours are those of `icwafer.chips.view`, but the hue goes around the circle once from
    0.2 to 6.4 um; pale where the wires run along y, the strongest block as bright as can be.
    Stripes show the direction of the wires.
    """
    die = generate(layout.dies[0])
    width_nm, height_nm = die.size_nm
    width_px = max(1, round(SIDE_PX * width_nm / max(width_nm, height_nm)))
    strongest = max(float(die.diffraction.max()), 1e-6)
    shown = dataclasses.replace(
        die,
        spacing_nm=500 * (die.spacing_nm / 200) ** (1 / 5),
        diffraction=0.7 * np.sqrt(die.diffraction / strongest),
    )
    picture = die_picture(shown, width_px)
    rows, columns = picture.shape[:2]
    y, x = np.mgrid[rows - 0.5 : -0.5 : -1, 0.5:columns]
    scale = width_nm / columns
    for (x0, y0, x1, y1), turn in zip(die.rect_nm / scale, die.direction_rad):
        inside = np.s_[max(0, rows - round(y1)) : rows - round(y0), round(x0) : round(x1)]
        across = y[inside] * np.cos(turn) - x[inside] * np.sin(turn)
        picture[inside] *= (0.82 + 0.18 * np.sign(np.sin(across * np.pi / 6)))[..., None]
    return picture


def write_map(path: Path, layout: Layout) -> None:
    """Writes the map as a PNG, complete or not at all. Raises OSError."""
    with replacing(path) as unfinished:
        imsave(unfinished, layout_map(layout), format="png")
