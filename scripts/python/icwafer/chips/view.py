# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures of layouts without a renderer: false colours for the wires of each block."""

from __future__ import annotations

import numpy as np

from icwafer.chips.model import Die


def die_colours(die: Die) -> np.ndarray:
    """A colour for each block, (n, 3) float32 in 0 to 1.

    The hue goes once around the circle while the spacing doubles: a grating of twice the spacing
    sends the same colours the same way, in twice the order. Blocks that diffract weakly are dark,
    blocks whose wires run rather along y are pale.
    """
    hue = np.log2(die.spacing_nm / 500.0) % 1.0
    upright = np.abs(np.sin(die.direction_rad))
    saturation = 0.80 - 0.40 * upright
    value = 0.15 + 0.85 * np.clip(die.diffraction / 0.7, 0.0, 1.0)
    return _from_hsv(hue, saturation, value)


def die_picture(die: Die, width_px: int) -> np.ndarray:
    """The die from above, (height, width, 3) float32 in 0 to 1, row 0 at the top.

    Larger blocks have a dark line around them; what is no block is black.
    """
    width_nm, height_nm = die.size_nm
    height_px = max(1, round(width_px * height_nm / width_nm))
    edges = np.rint(die.rect_nm * (width_px / width_nm)).astype(np.int64)
    edges[:, [0, 2]] = np.clip(edges[:, [0, 2]], 0, width_px)
    edges[:, [1, 3]] = np.clip(edges[:, [1, 3]], 0, height_px)
    colours = die_colours(die)
    picture = np.zeros((height_px, width_px, 3), dtype=np.float32)

    sides = edges[:, 2:] - edges[:, :2]
    small = (sides.max(axis=1) <= 1) & (edges[:, 0] < width_px) & (edges[:, 1] < height_px)
    picture[edges[small, 1], edges[small, 0]] = colours[small]
    large = ~small & (sides.min(axis=1) > 0)
    for (x0, y0, x1, y1), colour in zip(edges[large].tolist(), colours[large]):
        picture[y0:y1, x0:x1] = colour
        if min(x1 - x0, y1 - y0) > 4:
            picture[y0, x0:x1] *= 0.4
            picture[y0:y1, x0] *= 0.4
    return picture[::-1]


def _from_hsv(hue: np.ndarray, saturation: np.ndarray, value: np.ndarray) -> np.ndarray:
    """Red, green and blue (n, 3) from hue, saturation and value (n,), all in 0 to 1.

    Each channel falls and rises linearly around the circle (A. R. Smith, SIGGRAPH 1978).
    """
    place = (hue[:, None] * 6.0 + np.array([0.0, 4.0, 2.0])) % 6.0
    channel = np.clip(np.abs(place - 3.0) - 1.0, 0.0, 1.0)
    return (value[:, None] * (1.0 - saturation[:, None] * (1.0 - channel))).astype(np.float32)
