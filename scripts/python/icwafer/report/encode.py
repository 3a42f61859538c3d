# SPDX-License-Identifier: GPL-2.0-or-later
"""Pixels, maps and view transforms as text inside a page; `page/decode.js` is the other side.

Values are laid out so that zlib finds repetition, then compressed, then written in base64.
"""

from __future__ import annotations

import base64
import tempfile
import zlib
from pathlib import Path

import numpy as np
import OpenImageIO as oiio

from icwafer.compare.colour import ViewTransform
from icwafer.compare.images import to_buffer
from icwafer.errors import IcwaferError

#: Tables of view transforms have this many points (a side), over 2^first to 2^last of light.
CURVE_POINTS, CUBE_POINTS = 4096, 49
TABLE_STOPS = (-12.0, 7.0)
#: The longer side of a thumbnail, at most.
THUMBNAIL_PX = 320


def pack(values: bytes) -> str:
    """Compressed and in base64."""
    return base64.b64encode(zlib.compress(values, 9)).decode("ascii")


def half_floats(pixels: np.ndarray) -> str:
    """height x width x 3 as half floats: planes of differences along rows, high bytes first."""
    halves = np.clip(pixels, 0.0, 65504.0).astype(np.float16)
    bits = np.ascontiguousarray(np.moveaxis(halves, -1, 0)).view(np.uint16)
    steps = np.diff(bits, axis=-1, prepend=np.uint16(0))
    return pack((steps >> 8).astype(np.uint8).tobytes() + (steps & 255).astype(np.uint8).tobytes())


def unit_map(values: np.ndarray) -> str:
    """height x width of 0 to 1 as bytes: differences along rows."""
    levels = np.round(np.clip(values, 0.0, 1.0) * 255).astype(np.uint8)
    return pack(np.diff(levels, axis=-1, prepend=np.uint8(0)).tobytes())


def table_inputs(points: int) -> np.ndarray:
    """Light at the points of a table; it grows geometrically, and an offset makes the first 0."""
    first, last = TABLE_STOPS
    return 2.0 ** np.linspace(first, last, points) - 2.0**first


def view_table(view: ViewTransform) -> str:
    """A view transform as 16-bit values: a curve for each channel, else a cube, red fastest.

    A curve is exact where the transform treats the channels alone, as one that only encodes and
    clips; the sharp bend where it clips is what a cube cannot follow.
    """
    curve = view.encode(np.repeat(table_inputs(CURVE_POINTS)[None, :, None], 3, axis=2))
    mixed = np.random.default_rng(0).permuted(np.tile(np.arange(CURVE_POINTS), (3, 1)), axis=1)
    colours = table_inputs(CURVE_POINTS)[mixed].T[None]
    alone = np.stack([curve[0, mixed[channel], channel] for channel in range(3)], axis=-1)
    if np.abs(view.encode(colours)[0] - alone).max() < 1e-3:
        return pack(np.round(curve[0] * 65535).astype("<u2").tobytes())
    side = table_inputs(CUBE_POINTS)
    blue, green, red = np.meshgrid(side, side, side, indexing="ij")
    cube = view.encode(np.stack([red, green, blue], axis=-1).reshape(1, -1, 3))
    return pack(np.round(cube * 65535).astype("<u2").tobytes())


def thumbnail(shown: np.ndarray, side: int) -> str:
    """A small WebP, as a data URI, of an image as a screen shows it; `side` is the longer one."""
    height, width = shown.shape[:2]
    scale = min(1.0, side / max(width, height))
    size = max(1, round(width * scale)), max(1, round(height * scale))
    small = oiio.ImageBufAlgo.resize(to_buffer(shown), roi=oiio.ROI(0, size[0], 0, size[1]))
    small.set_write_format(oiio.UINT8)
    small.specmod()["Compression"] = "webp:85"
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "small.webp"
        if not small.write(str(path)):
            raise IcwaferError(f"{path}: cannot be written ({small.geterror()}); mend this")
        return "data:image/webp;base64," + base64.b64encode(path.read_bytes()).decode("ascii")
