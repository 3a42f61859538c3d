# SPDX-License-Identifier: GPL-2.0-or-later
"""A table of blocks as text: columns, compressed.

Five columns of 32-bit whole numbers, little-endian, one after the other: x0 and y0 less those of
the block before, width, height (all in nanometres), group (from 0). Neighbours differ little, so
the bytes of equal weight of a column are put together before zlib compresses them; base64.
"""

from __future__ import annotations

import base64
import binascii
import zlib

import numpy as np

from icwafer.chips.model import MAX_BLOCKS, BlockTable


class Damaged(Exception):
    """The text is not that of a table of that many blocks."""


def packed(blocks: BlockTable) -> str:
    """The text of a table; its coordinates fit into 31 bits."""
    low, sides = blocks.rect_nm[:, :2], blocks.rect_nm[:, 2:] - blocks.rect_nm[:, :2]
    steps = np.diff(low, axis=0, prepend=np.zeros((1, 2), dtype=np.int64))
    columns = np.concatenate([steps.T, sides.T, blocks.group[None]])
    by_weight = (
        np.ascontiguousarray(columns, dtype="<i4")
        .view(np.uint8)
        .reshape(5, -1, 4)
        .transpose(0, 2, 1)
    )
    return base64.b64encode(zlib.compress(by_weight.tobytes(), level=6)).decode("ascii")


def unpacked(text: str, count: int) -> BlockTable:
    """The table of `count` blocks from its text. Raises Damaged."""
    if not 0 < count <= MAX_BLOCKS:
        raise Damaged(f"{count} blocks: there must be 1 to {MAX_BLOCKS}")
    decompressor = zlib.decompressobj()
    size = 5 * 4 * count
    try:
        data = decompressor.decompress(base64.b64decode(text, validate=True), size + 1)
    except (binascii.Error, ValueError, zlib.error):
        raise Damaged("the text is damaged: import the chip again") from None
    if len(data) != size or not decompressor.eof:
        raise Damaged(f"the text does not hold {count} blocks: import the chip again")
    by_weight = np.frombuffer(data, dtype=np.uint8).reshape(5, 4, count).transpose(0, 2, 1)
    columns = np.ascontiguousarray(by_weight).view("<i4")[..., 0].astype(np.int64)
    low = columns[:2].cumsum(axis=1).T
    return BlockTable(
        np.concatenate([low, low + columns[2:4].T], axis=1), columns[4].astype(np.int32)
    )
