# SPDX-License-Identifier: GPL-2.0-or-later
"""The model of a layout: wafer, dies, blocks, groups.

A `Layout` is the description that a file holds: the designs of its dies, and the wafer that they
stand on. A `DieSpec` describes a die either by a floorplan, which `icwafer.chips.die.generate`
fills from the seed, or by a table of blocks, as an imported chip has. Both end as a `Die`: arrays
with one entry per block.

The groups decide what a die looks like. Where one group covers most of it, that group gives the
background colour and the smaller groups give texture; one wide spread for all blocks gives a
disordered mess, one narrow spread no texture at all.
"""

from __future__ import annotations

import enum
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from icwafer.chips.rules import ruled
from icwafer.chips.spread import Normal, Spread
from icwafer.chips.wafer import Wafer

UM = 1000  # nm
MM = 1000 * UM

#: Largest numbers of blocks of a die, and of dies of a wafer: guards against a slip of the pen.
MAX_BLOCKS = 20_000_000
MAX_DIES = 1_000_000


class Kind(enum.IntEnum):
    """What a block is, which decides how its macro is filled."""

    LOGIC = 0  # many small irregular blocks
    MEMORY = 1  # a regular array of rows, two halves beside a dark spine
    ANALOG = 2  # few large blocks
    IO = 3  # pads and their drivers
    STRIP = 4  # a channel without a regular pattern of wires: dark
    BUS = 5  # interconnect: long bundles of parallel wires
    PIXEL = 6  # an array of pixels, even all over
    FILL = 7  # dummy metal in otherwise empty places
    SEAL = 8  # the seal ring and what lies outside it


def kind_names() -> tuple[str, ...]:
    """The kinds as a file spells them."""
    return tuple(kind.name.lower() for kind in Kind)


def floorplan_names() -> tuple[str, ...]:
    """The floorplans that a die may have."""
    from icwafer.chips.floorplans import FLOORPLANS

    return tuple(FLOORPLANS)


@dataclass(frozen=True)
class Group:
    """Blocks of one kind that share the statistics of their wires.

    The spreads are the node's sockets of these names. A second family of wires at 90 degrees
    exists where `cross_spacing_nm` is above 0.
    """

    name: str = ruled("what it is called, unique in its die")
    kind: Kind = ruled("which blocks it is for", choices=kind_names)
    spacing_nm: Spread = ruled("period of the wires", 50, 200_000)
    width_nm: Spread = ruled("width of one wire", 1, 200_000, default=Normal(250.0))
    oxide_nm: Spread = ruled("oxide above the wires", 0, 20_000, default=Normal(530.0))
    diffraction: Spread = ruled("strength of the diffracted light", 0, 1, default=Normal(0.5))
    turned: float = ruled("share of its blocks turned by 90 degrees", 0, 1, default=0.0)
    weight: float = ruled(
        "share of the macros of its kind, relative to other groups", 0, 1e6, default=1.0
    )
    direction_deg: float = ruled(
        "the wires of blocks not turned, counter-clockwise from x", -360, 360, default=0.0
    )
    spacing_variation: Spread = ruled(
        "spread of the period inside a block, relative", 0, 1, default=Normal(0.0)
    )
    cross_spacing_nm: Spread = ruled(
        "period of the wires across, 0 for none", 0, 200_000, default=Normal(0.0)
    )
    cross_width_nm: Spread = ruled("width of a wire across", 0, 200_000, default=Normal(0.0))
    groove_nm: Spread = ruled("depth from wire to ground", 0, 20_000, default=Normal(300.0))


#: The fields of a group that become an attribute of each block, in the order of their drawing.
ATTRIBUTES = (
    "spacing_nm",
    "width_nm",
    "oxide_nm",
    "diffraction",
    "spacing_variation",
    "cross_spacing_nm",
    "cross_width_nm",
    "groove_nm",
)


@dataclass(frozen=True, eq=False)
class BlockTable:
    """Blocks listed one by one.

    rect_nm: (n, 4) int64, x0 < x1 and y0 < y1 as x0, y0, x1, y1; the die's lower left corner is
    the origin. group: (n,) int32, index into the die's groups. Blocks do not overlap; where there
    is none the die is bare.
    """

    rect_nm: np.ndarray
    group: np.ndarray

    @classmethod
    def from_um(cls, rect_um: np.ndarray, group: np.ndarray) -> BlockTable:
        """From rectangles in micrometres, rounded to whole nanometres.

        rect_um: (n, 4), x0, y0, x1, y1. group: (n,), whole numbers.
        """
        rect_nm = np.rint(np.asarray(rect_um, dtype=np.float64) * UM).astype(np.int64)
        return cls(rect_nm.reshape(-1, 4), np.asarray(group).astype(np.int32))

    def __len__(self) -> int:
        return len(self.rect_nm)

    def __eq__(self, other: object) -> bool:
        return (
            isinstance(other, BlockTable)
            and np.array_equal(self.rect_nm, other.rect_nm)
            and np.array_equal(self.group, other.group)
        )


@dataclass(frozen=True)
class DieSpec:
    """All that a die is made from: the same description gives the same bytes.

    blocks: instead of a floorplan; then `floorplan`, `block_um` and the groups' weights are not
    used, and `seed` only where a group spreads.
    """

    groups: tuple[Group, ...] = ruled("its groups of blocks", 1, 1_000_000)
    name: str = ruled("what it is called, unique in its layout", default="die")
    floorplan: str = ruled(
        "how its blocks are arranged", choices=floorplan_names, default="pictures"
    )
    seed: int = ruled("start of all its random numbers", 0, 2**32 - 1, default=1)
    copies_alike: bool = ruled(
        "whether copies of a core and rows of a memory have the same wires, as on a real chip; "
        "else every block is drawn for itself",
        default=True,
    )
    width_mm: float = ruled("extent along x", 0.001, 300, default=15.0)
    height_mm: float = ruled("extent along y", 0.001, 300, default=9.6)
    block_um: float = ruled("usual side of a block of logic", 1, 5_000, default=140.0)
    blocks: BlockTable | None = ruled("its blocks, one by one", default=None)


@dataclass(frozen=True)
class Layout:
    """What a layout file holds: the first die is the product, others stand in test fields."""

    dies: tuple[DieSpec, ...] = ruled("the designs of its dies", 1, 16)
    wafer: Wafer | None = ruled("the wafer that they stand on", default=None)


@dataclass(frozen=True)
class Die:
    """n blocks, none overlapping another; those of a floorplan cover the die exactly.

    rect_nm: (n, 4) int64, x0, y0, x1, y1; the die's lower left corner is the origin.
    group: (n,) int32, index into spec.groups.
    All others: (n,) float32. direction_rad is counter-clockwise from x, 0 to pi.
    """

    spec: DieSpec
    rect_nm: np.ndarray
    group: np.ndarray
    direction_rad: np.ndarray
    spacing_nm: np.ndarray
    width_nm: np.ndarray
    oxide_nm: np.ndarray
    diffraction: np.ndarray
    spacing_variation: np.ndarray
    cross_spacing_nm: np.ndarray
    cross_width_nm: np.ndarray
    groove_nm: np.ndarray

    def __len__(self) -> int:
        return len(self.rect_nm)

    @property
    def size_nm(self) -> tuple[int, int]:
        """Extent along x and y."""
        return size_nm(self.spec)

    @property
    def area_nm2(self) -> np.ndarray:
        """(n,) int64, exact."""
        return (self.rect_nm[:, 2:] - self.rect_nm[:, :2]).prod(axis=1)


class Size(NamedTuple):
    """Whole nanometres along x and y."""

    width_nm: int
    height_nm: int

    @property
    def area_um2(self) -> float:
        return self.width_nm / UM * self.height_nm / UM


def size_nm(spec: DieSpec) -> Size:
    """The size of a die, rounded to whole nanometres."""
    return Size(round(spec.width_mm * MM), round(spec.height_mm * MM))
