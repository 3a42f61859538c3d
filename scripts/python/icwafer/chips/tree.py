# SPDX-License-Identifier: GPL-2.0-or-later
"""Floorplans as trees: nodes that cut a rectangle, down to macros of one kind.

A slicing structure (R. H. J. M. Otten, Automatic Floorplan Design, 19th Design Automation
Conference, 1982) with one more sort of node: `Tiles`, copies of one part, as the cores of a
processor and the banks of a memory are. Copies share their blocks and their wires.

A floorplan is built in three steps: the tree is laid out down to macros, once for each part that
is copied; all macros are filled with blocks together; the copies are made.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Union

import numpy as np

from icwafer.chips.fill import fill
from icwafer.chips.geometry import Rect, frame, grid, length, longer_axis, sliced, split
from icwafer.chips.model import UM, Kind
from icwafer.chips.plan import Plan, copied
from icwafer.errors import IcwaferError

Share = Union[float, tuple[float, float]]


@dataclass(frozen=True)
class Macro:
    """One macro of a kind, of the group named like its role if the die has such a group."""

    kind: Kind
    role: str = ""


@dataclass(frozen=True)
class Part:
    """A node and its extent: a share of what is left, also drawn between two, or fixed."""

    node: Node
    share: Share = 1.0
    um: float = 0.0


@dataclass(frozen=True)
class Cut:
    """Parts beside each other along x (axis 0) or above each other (axis 1)."""

    axis: int
    parts: tuple[Part, ...]


@dataclass(frozen=True)
class Twins:
    """A node, its mirror image along an axis, and something between them."""

    axis: int
    node: Node
    between: Part


@dataclass(frozen=True)
class Slices:
    """Parts with areas in proportion to their shares, in random order, cut as square as can be."""

    parts: tuple[Part, ...]


@dataclass(frozen=True)
class Tiles:
    """Copies of one tile, as many as given, or as fit at the pitch.

    mirror: "x" if every second column is mirrored, "y" for rows, "xy" for both.
    """

    node: Node
    columns: int = 0
    rows: int = 0
    pitch_um: float = 0.0
    mirror: str = ""


@dataclass(frozen=True)
class Region:
    """Macros of about one size, sliced at random; each kind has its share of their number."""

    macro_um: float
    shares: tuple[tuple[Kind, float], ...]


@dataclass(frozen=True)
class Ring:
    """A frame of four sides around something."""

    um: float
    side: Node
    inside: Node


Node = Union[Macro, Cut, Twins, Slices, Tiles, Region, Ring]


@dataclass(frozen=True)
class _Copies:
    """Something laid out in `source`, to be copied to all targets."""

    piece: _Piece
    source: Rect
    targets: np.ndarray  # (k, 4)
    flips: np.ndarray  # (k, 2) bool


#: What a node became: a range of macros, copies, or several of these.
_Piece = Union[range, _Copies, list]


def tree_plan(
    root: Node, rng: np.random.Generator, width_nm: int, height_nm: int, block_um: float
) -> Plan:
    """The floorplan of a tree on a die whose lower left corner is at (0, 0).

    Half of all seeds have it mirrored. Raises IcwaferError where a fixed part does not fit.
    """
    die = (0, 0, width_nm, height_nm)
    layout = _Layout(rng)
    piece = layout.place(root, die)
    flips = rng.integers(2, size=(1, 2)).astype(bool)
    blocks = fill(rng, np.array(layout.rects), np.array(layout.kinds), round(block_um * UM))
    starts = np.searchsorted(blocks.macro, np.arange(len(layout.rects) + 1))
    rect = np.empty((_size(piece, starts), 4), dtype=np.int64)
    block = np.empty(len(rect), dtype=np.int64)
    _unfold(_Copies(piece, die, np.array([die]), flips), blocks, starts, rect, block)
    return Plan(
        rect, blocks.kind[block], blocks.macro[block], blocks.cell[block], tuple(layout.roles)
    )


@dataclass
class _Layout:
    """Collects macros while the tree is laid out."""

    rng: np.random.Generator
    rects: list[Rect] = field(default_factory=list)
    kinds: list[Kind] = field(default_factory=list)
    roles: list[str] = field(default_factory=list)

    def place(self, node: Node, rect: Rect) -> _Piece:
        if isinstance(node, Macro):
            return self._macros([rect], [node.kind], [node.role])
        if isinstance(node, Cut):
            return [self.place(p.node, r) for p, r in zip(node.parts, self._cut(node, rect))]
        if isinstance(node, Twins):
            return self._twins(node, rect)
        if isinstance(node, Slices):
            order = self.rng.permutation(len(node.parts))
            parts = [node.parts[index] for index in order]
            return self._slices(parts, [self._drawn(part.share) for part in parts], rect)
        if isinstance(node, Tiles):
            return self._tiles(node, rect)
        if isinstance(node, Region):
            return self._region(node, rect)
        sides, inside = _fitting_frame(rect, round(node.um * UM))
        return [*(self.place(node.side, side) for side in sides), self.place(node.inside, inside)]

    def _macros(self, rects: Sequence[Rect], kinds: Sequence[Kind], roles: Sequence[str]) -> range:
        first = len(self.rects)
        self.rects += rects
        self.kinds += kinds
        self.roles += roles
        return range(first, len(self.rects))

    def _cut(self, node: Cut, rect: Rect) -> list[Rect]:
        fixed_nm = [round(part.um * UM) for part in node.parts]
        shares = [0.0 if part.um else self._drawn(part.share) for part in node.parts]
        extent = length(rect, node.axis)
        free = extent - sum(fixed_nm)
        if free < extent // 10:
            raise _too_small(rect, f"fixed parts of {sum(fixed_nm) / UM:g} um")
        total = sum(shares) or 1.0
        lengths = [nm or share / total * free for nm, share in zip(fixed_nm, shares)]
        return split(rect, node.axis, [nm / extent for nm in lengths[:-1]])

    def _drawn(self, share: Share) -> float:
        return self.rng.uniform(*share) if isinstance(share, tuple) else share

    def _twins(self, node: Twins, rect: Rect) -> _Piece:
        middle = node.between.um * UM / length(rect, node.axis) or self._drawn(node.between.share)
        if middle > 0.9:
            raise _too_small(rect, f"a middle of {node.between.um:g} um")
        first, between, last = split(rect, node.axis, [(1 - middle) / 2, middle])
        targets = np.array([first, last])
        flips = np.array([[False, False], [node.axis == 0, node.axis == 1]])
        twins = _Copies(self.place(node.node, first), first, targets, flips)
        return [twins, self.place(node.between.node, between)]

    def _slices(self, parts: Sequence[Part], areas: Sequence[float], rect: Rect) -> _Piece:
        """Cuts the parts in two of nearly equal area, and each of them again."""
        if len(parts) == 1:
            return self.place(parts[0].node, rect)
        shares = np.cumsum(areas) / sum(areas)
        half = int(np.argmin(np.abs(shares[:-1] - 0.5))) + 1
        first, second = split(rect, longer_axis(rect), [shares[half - 1]])
        return [
            self._slices(parts[:half], areas[:half], first),
            self._slices(parts[half:], areas[half:], second),
        ]

    def _tiles(self, node: Tiles, rect: Rect) -> _Piece:
        counts = [
            given or max(1, round(length(rect, axis) / (node.pitch_um * UM)))
            for axis, given in enumerate((node.columns, node.rows))
        ]
        if min(length(rect, axis) // count for axis, count in enumerate(counts)) < UM:
            raise _too_small(rect, f"{counts[0]} x {counts[1]} tiles")
        tiles = grid(rect, *counts)
        rows, columns = np.divmod(np.arange(len(tiles)), counts[0])
        flips = np.stack(
            [("x" in node.mirror) & (columns % 2 == 1), ("y" in node.mirror) & (rows % 2 == 1)],
            axis=1,
        )
        return _Copies(self.place(node.node, tiles[0]), tiles[0], np.array(tiles), flips)

    def _region(self, node: Region, rect: Rect) -> range:
        """Every kind gets its share to the nearest whole macro, in random order: drawing each
        macro for itself would leave whole regions without memory for some seeds."""
        area = np.array([(node.macro_um * UM) ** 2])
        rects, _ = sliced(self.rng, np.array([rect]), area, max_aspect=2.5)
        kinds, shares = zip(*node.shares)
        bounds = np.cumsum(shares) / sum(shares) * len(rects)
        dealt = np.searchsorted(np.round(bounds), np.arange(len(rects)) + 0.5)
        order = self.rng.permutation(len(rects))
        dealt_kinds = [kinds[dealt[place]] for place in order]
        return self._macros([tuple(r) for r in rects.tolist()], dealt_kinds, [""] * len(rects))


def _size(piece: _Piece, starts: np.ndarray) -> int:
    """How many blocks a piece has with all copies."""
    if isinstance(piece, range):
        return int(starts[piece.stop] - starts[piece.start])
    if isinstance(piece, _Copies):
        return len(piece.targets) * _size(piece.piece, starts)
    return sum(_size(part, starts) for part in piece)


def _unfold(
    piece: _Piece, blocks: Plan, starts: np.ndarray, rect_nm: np.ndarray, block: np.ndarray
) -> None:
    """Writes a piece with all copies: rectangles (n, 4), and which filled block (n,) each one is."""
    if isinstance(piece, range):
        first, last = starts[piece.start], starts[piece.stop]
        rect_nm[:] = blocks.rect_nm[first:last]
        block[:] = np.arange(first, last)
    elif isinstance(piece, _Copies):
        count = _size(piece.piece, starts)
        original = np.empty((count, 4), dtype=np.int64)
        _unfold(piece.piece, blocks, starts, original, block[:count])
        rect_nm[:] = copied(original, piece.source, piece.targets, piece.flips)
        block[:] = np.tile(block[:count], len(piece.targets))
    else:
        first = 0
        for part in piece:
            last = first + _size(part, starts)
            _unfold(part, blocks, starts, rect_nm[first:last], block[first:last])
            first = last


def _fitting_frame(rect: Rect, width_nm: int) -> tuple[list[Rect], Rect]:
    if 2.5 * width_nm > min(length(rect, 0), length(rect, 1)):
        raise _too_small(rect, f"a ring of {width_nm / UM:g} um")
    return frame(rect, width_nm)


def _too_small(rect: Rect, what: str) -> IcwaferError:
    width, height = length(rect, 0) / UM, length(rect, 1) / UM
    return IcwaferError(
        f"the die is too small for its floorplan: {what} must fit into {width:g} x {height:g} um; "
        "make width_mm and height_mm larger"
    )
