# SPDX-License-Identifier: GPL-2.0-or-later
"""A die: the blocks of a floorplan, each with the wires of the group that it belongs to.

The spread of the groups decides what a die looks like. Where one group covers most of it, that
group gives the background colour and the smaller groups give texture; one wide spread for all
blocks gives a disordered mess, one narrow spread no texture at all.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from icwafer.errors import IcwaferError
from icwafer.floorplan import MM, Kind, processor


@dataclass(frozen=True)
class Spread:
    """A random quantity: normal and kept within three deviations, or uniform between two ends."""

    mean: float
    deviation: float = 0.0
    uniform: bool = False

    @classmethod
    def between(cls, low: float, high: float) -> Spread:
        """Every value from `low` to `high` alike; its deviation is (high - low) / sqrt(12)."""
        return cls((low + high) / 2, (high - low) / 12**0.5, uniform=True)

    def draw(self, rng: np.random.Generator, count: int) -> np.ndarray:
        """`count` values, float64."""
        if self.uniform:
            unit = rng.uniform(-(3**0.5), 3**0.5, count)
        else:
            unit = np.clip(rng.standard_normal(count), -3.0, 3.0)
        return self.mean + self.deviation * unit


@dataclass(frozen=True)
class Group:
    """Blocks of one kind that share the statistics of their wires.

    weight: how many of the macros of this kind belong to the group, relative to its other groups.
    spacing_nm, width_nm, oxide_nm: the node's sockets of these names, > 0.
    diffraction: strength of the diffracted light, 0 to 1.
    turned: share of the blocks whose wires run along y (90 degrees); the rest's run along x.
    """

    name: str
    kind: Kind
    spacing_nm: Spread
    width_nm: Spread = Spread(250.0)
    oxide_nm: Spread = Spread(530.0)
    diffraction: Spread = Spread(0.5)
    turned: float = 0.0
    weight: float = 1.0


@dataclass(frozen=True)
class DieSpec:
    """All that a die is made from: the same description gives the same bytes.

    copies_alike: whether copies of a core, and the rows of a memory, have the same wires, as on a
    real chip; else every block is drawn for itself.
    """

    groups: tuple[Group, ...]
    seed: int = 1
    copies_alike: bool = True
    width_mm: float = 15.0
    height_mm: float = 9.6


@dataclass(frozen=True)
class Die:
    """n blocks, none overlapping another, that cover the die exactly.

    rect_nm: (n, 4) int64, x0, y0, x1, y1; the die's lower left corner is the origin.
    group: (n,) int32, index into spec.groups.
    spacing_nm, width_nm, oxide_nm, direction_rad, diffraction: (n,) float32.
    """

    spec: DieSpec
    rect_nm: np.ndarray
    group: np.ndarray
    spacing_nm: np.ndarray
    width_nm: np.ndarray
    oxide_nm: np.ndarray
    direction_rad: np.ndarray
    diffraction: np.ndarray

    def __len__(self) -> int:
        return len(self.rect_nm)

    @property
    def area_nm2(self) -> np.ndarray:
        """(n,) int64, exact."""
        return (self.rect_nm[:, 2:] - self.rect_nm[:, :2]).prod(axis=1)


def generate(spec: DieSpec) -> Die:
    """Makes the die of a description. Raises IcwaferError where the description makes no sense."""
    _check(spec)
    rng = np.random.default_rng(spec.seed)
    plan = processor(rng, round(spec.width_mm * MM), round(spec.height_mm * MM))

    group_of_macro = np.empty(plan.macro.max() + 1, dtype=np.int32)
    macro_kinds = _main_kind_of_each_macro(plan.macro, plan.kind)
    for kind in Kind:
        members = np.flatnonzero(macro_kinds == kind)
        group_of_macro[members] = _deal(rng, _groups_of(spec, kind), len(members))
    strips = _groups_of(spec, Kind.STRIP)[0][0]
    group = np.where(plan.kind == Kind.STRIP, strips, group_of_macro[plan.macro]).astype(np.int32)

    cell = plan.cell if spec.copies_alike else np.arange(len(plan))
    _, first, inverse = np.unique(cell, return_index=True, return_inverse=True)
    values = _draw(rng, spec.groups, group[first])
    return Die(spec, plan.rect_nm, group, **{name: v[inverse] for name, v in values.items()})


def with_spacing(groups: Sequence[Group], spacing_nm: Spread) -> tuple[Group, ...]:
    """The same groups, with one spread of the spacing for all blocks of the die."""
    return tuple(replace(group, spacing_nm=spacing_nm) for group in groups)


def _check(spec: DieSpec) -> None:
    for kind in Kind:
        if not any(weight > 0 for _, weight in _groups_of(spec, kind)):
            raise IcwaferError(
                f"die has no group of kind {kind.name}: add one with a weight above 0"
            )
    if min(spec.width_mm, spec.height_mm) < 5.0:
        raise IcwaferError(
            f"die of {spec.width_mm:g} x {spec.height_mm:g} mm is too small for the floorplan: "
            "make both sides at least 5 mm"
        )
    for group in spec.groups:
        for field in ("spacing_nm", "width_nm", "oxide_nm"):
            spread: Spread = getattr(group, field)
            if spread.deviation < 0 or spread.mean - 3 * spread.deviation <= 0:
                raise IcwaferError(
                    f"group {group.name}: {field} may reach 0 or below "
                    f"({spread.mean:g} +- {spread.deviation:g}): "
                    "keep the mean above three deviations"
                )


def _groups_of(spec: DieSpec, kind: Kind) -> list[tuple[int, float]]:
    """Index and weight of each group of a kind."""
    return [(i, group.weight) for i, group in enumerate(spec.groups) if group.kind == kind]


def _main_kind_of_each_macro(macro: np.ndarray, kind: np.ndarray) -> np.ndarray:
    """The kind of a macro's blocks other than its strips; STRIP where it has no others."""
    kinds = np.full(macro.max() + 1, Kind.STRIP, dtype=np.int8)
    blocks = kind != Kind.STRIP
    kinds[macro[blocks]] = kind[blocks]
    return kinds


def _deal(
    rng: np.random.Generator, groups: Sequence[tuple[int, float]], count: int
) -> np.ndarray:
    """`count` group indices in random order; each group gets its share to the nearest one."""
    indices, weights = np.array([i for i, _ in groups]), np.cumsum([w for _, w in groups])
    dealt = indices[np.searchsorted(weights, (np.arange(count) + 0.5) / count * weights[-1])]
    return rng.permutation(dealt)


def _draw(
    rng: np.random.Generator, groups: Sequence[Group], group_of: np.ndarray
) -> dict[str, np.ndarray]:
    """The wires of blocks, given the group of each (m,): arrays (m,) float32 by name."""
    spreads = ("spacing_nm", "width_nm", "oxide_nm", "diffraction")
    values = {name: np.empty(len(group_of), dtype=np.float32) for name in spreads}
    values["direction_rad"] = np.empty(len(group_of), dtype=np.float32)
    for index, group in enumerate(groups):
        members = np.flatnonzero(group_of == index)
        for name in spreads:
            values[name][members] = getattr(group, name).draw(rng, len(members))
        turned = rng.random(len(members)) < group.turned
        values["direction_rad"][members] = np.where(turned, np.pi / 2, 0.0)
    np.clip(values["diffraction"], 0.0, 1.0, out=values["diffraction"])
    return values
