# SPDX-License-Identifier: GPL-2.0-or-later
"""Dies as meshes, with the attributes of their wires."""

from __future__ import annotations

import bpy
import numpy as np

from icwafer.attributes import OF_FACES
from icwafer.chips.clip import Pieces
from icwafer.chips.model import MM, UM, Die
from icwafer.scene.polygons import add_face_attributes, polygon_mesh

GAP_NM = 8 * UM  # the dark line between two blocks: one pixel in a picture of a whole die

#: The face attributes that a die's mesh may carry, and the sockets that each one drives.
SOCKET_OF_ATTRIBUTE = {attribute.name: attribute.socket for attribute in OF_FACES}

#: How far below the blocks the ground between them lies, and the wafer below that: enough to tell
#: them apart in single precision, too little to be seen.
STEP_MM = 0.002


def die_mesh(
    die: Die,
    gap_nm: float = GAP_NM,
    ground: bool = False,
    pieces: Pieces | None = None,
    ground_piece: np.ndarray | None = None,
) -> bpy.types.Mesh:
    """One face per block in the plane z = 0, in mm around the origin; attributes hold the wires.

    gap_nm: dark line between two blocks; each face gives way to it by half of it, at most a fifth
    of a block on each side. ground: another face of the whole die, `STEP_MM` below, with the
    material of index 1.
    pieces: only these parts of the blocks' faces, and `ground_piece` (k, 2) of the ground.
    """
    rects = block_faces_mm(die, gap_nm)
    cut: tuple[tuple[int, np.ndarray], ...] = ()
    block = np.arange(len(die))
    if pieces is not None:
        rects, cut = rects[pieces.whole], pieces.cut
        block = np.r_[pieces.whole, [index for index, _ in cut]].astype(np.int64)
    half_mm = np.array([die.spec.width_mm, die.spec.height_mm]) / 2
    grounds = []
    if ground:
        grounds = [
            _corners(np.r_[-half_mm, half_mm][None])[0] if ground_piece is None else ground_piece
        ]
    loose = [*(polygon for _, polygon in cut), *grounds]
    flat = np.concatenate([_corners(rects).reshape(-1, 2), *loose])
    points = np.zeros((len(flat), 3))
    points[:, :2] = flat
    if ground:
        points[len(flat) - len(grounds[0]) :, 2] = -STEP_MM
    first = np.cumsum([4 * len(rects), *map(len, loose)])
    mesh = polygon_mesh(
        "Die",
        points,
        [
            np.arange(4 * len(rects)).reshape(-1, 4),
            *(np.arange(start, start + len(part))[None] for start, part in zip(first, loose)),
        ],
    )
    if ground:
        mesh.polygons[-1].material_index = 1
    # The ground has no wires.
    of_ground = np.zeros(len(grounds), np.float32)
    columns = {name: getattr(die, name.removeprefix("ic_")) for name in SOCKET_OF_ATTRIBUTE}
    add_face_attributes(
        mesh, {name: np.r_[values[block], of_ground] for name, values in columns.items()}
    )
    return mesh


def block_faces_mm(die: Die, gap_nm: float = GAP_NM) -> np.ndarray:
    """The faces of the blocks, (n, 4) as x0, y0, x1, y1 from the middle of the die."""
    rect_nm = die.rect_nm.astype(np.float64)
    inset_nm = np.minimum(gap_nm / 2, 0.2 * (rect_nm[:, 2:] - rect_nm[:, :2]))
    centre_mm = np.array([die.spec.width_mm, die.spec.height_mm]) / 2
    low = (rect_nm[:, :2] + inset_nm) / MM - centre_mm
    high = (rect_nm[:, 2:] - inset_nm) / MM - centre_mm
    return np.concatenate([low, high], axis=1)


def _corners(rects_mm: np.ndarray) -> np.ndarray:
    """Corners (n, 4, 2) of rectangles (n, 4), counter-clockwise."""
    return rects_mm[:, [[0, 1], [2, 1], [2, 3], [0, 3]]]
