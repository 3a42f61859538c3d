# SPDX-License-Identifier: GPL-2.0-or-later
"""Makes the blocks of a die from its description.

Only additions, products, quotients and square roots decide where a block lies: they are exact to
the last bit on every machine, unlike sines and powers, so the same description gives the same die.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from icwafer.chips.check import check_die
from icwafer.chips.floorplans import FLOORPLANS
from icwafer.chips.model import ATTRIBUTES, Die, DieSpec, Group, Kind, size_nm
from icwafer.chips.plan import Plan
from icwafer.errors import IcwaferError

#: Attributes drawn together with a block's turn; the others have their random numbers after them.
_FIRST_DRAWN = ATTRIBUTES[:4]


def generate(spec: DieSpec) -> Die:
    """Makes the die of a description. Raises IcwaferError where the description makes no sense."""
    check_die(spec)
    rng = np.random.default_rng(spec.seed)
    if spec.blocks is None:
        plan = FLOORPLANS[spec.floorplan](rng, *size_nm(spec), spec.block_um)
        rect_nm, group = plan.rect_nm, _groups_of_blocks(rng, spec, plan)
        cell = plan.cell if spec.copies_alike else np.arange(len(plan))
    else:
        rect_nm, group = spec.blocks.rect_nm, spec.blocks.group
        cell = np.arange(len(group))
    group_of_cell = np.empty(int(cell.max()) + 1, dtype=np.int32)
    group_of_cell[cell] = group
    values = _draw(rng, spec.groups, group_of_cell)
    return Die(spec, rect_nm, group, **{name: drawn[cell] for name, drawn in values.items()})


def _groups_of_blocks(rng: np.random.Generator, spec: DieSpec, plan: Plan) -> np.ndarray:
    """Deals the macros of each kind to the groups of that kind: (n,) int32.

    A macro with a role is of the group of that name and its kind, if there is one.
    """
    kind_of_macro = _main_kind_of_each_macro(plan.macro, plan.kind)
    group_of_macro = np.full(len(kind_of_macro), -1, dtype=np.int32)
    named = {(group.name, group.kind): index for index, group in enumerate(spec.groups)}
    for macro, role in enumerate(plan.roles):
        group_of_macro[macro] = named.get((role, kind_of_macro[macro]), -1)
    kinds = np.unique(plan.kind)
    for kind in kinds:
        macros = np.flatnonzero((kind_of_macro == kind) & (group_of_macro < 0))
        if len(macros):
            group_of_macro[macros] = _deal(rng, _groups_of(spec, kind), len(macros))
    group = group_of_macro[plan.macro]
    if Kind.STRIP in kinds:
        group[plan.kind == Kind.STRIP] = _groups_of(spec, Kind.STRIP)[0][0]
    return group


def _groups_of(spec: DieSpec, kind: int) -> list[tuple[int, float]]:
    """Index and weight of each group of a kind."""
    groups = [(i, group.weight) for i, group in enumerate(spec.groups) if group.kind == kind]
    if not any(weight > 0 for _, weight in groups):
        raise IcwaferError(
            f"die '{spec.name}' has no group of kind {Kind(kind).name.lower()}, which its floorplan "
            "needs: add one with a weight above 0"
        )
    return groups


def _main_kind_of_each_macro(macro: np.ndarray, kind: np.ndarray) -> np.ndarray:
    """The kind of a macro's blocks other than its strips; STRIP where it has no others."""
    kinds = np.full(macro.max() + 1, Kind.STRIP, dtype=np.int8)
    blocks = kind != Kind.STRIP
    kinds[macro[blocks]] = kind[blocks]
    return kinds


def _deal(rng: np.random.Generator, groups: Sequence[tuple[int, float]], count: int) -> np.ndarray:
    """`count` group indices in random order; each group gets its share to the nearest one."""
    indices, weights = np.array([i for i, _ in groups]), np.cumsum([w for _, w in groups])
    dealt = indices[np.searchsorted(weights, (np.arange(count) + 0.5) / count * weights[-1])]
    return rng.permutation(dealt)


def _draw(
    rng: np.random.Generator, groups: Sequence[Group], group_of: np.ndarray
) -> dict[str, np.ndarray]:
    """The wires of cells, given the group of each (m,): arrays (m,) float32 by name."""
    order = np.argsort(group_of, kind="stable")
    ends = np.searchsorted(group_of[order], np.arange(len(groups)), side="right")
    members = np.split(order, ends[:-1])
    values = {
        name: np.empty(len(group_of), dtype=np.float32) for name in ("direction_rad", *ATTRIBUTES)
    }
    for group, cells in zip(groups, members):
        for name in _FIRST_DRAWN:
            values[name][cells] = getattr(group, name).draw(rng, len(cells))
        turned = rng.random(len(cells)) < group.turned
        degrees = np.where(turned, group.direction_deg + 90, group.direction_deg) % 180
        values["direction_rad"][cells] = np.radians(degrees)
    for group, cells in zip(groups, members):
        for name in ATTRIBUTES[len(_FIRST_DRAWN) :]:
            spread = getattr(group, name)
            same = spread.low == spread.high
            values[name][cells] = spread.mean if same else spread.draw(rng, len(cells))
    np.clip(values["diffraction"], 0.0, 1.0, out=values["diffraction"])
    return values


def main_direction_rad(die: Die) -> float:
    """The direction of the wires that cover most of a die, each as much as it diffracts."""
    directions, place = np.unique(die.direction_rad, return_inverse=True)
    weights = np.bincount(place, die.area_nm2 * die.diffraction)
    return float(directions[np.argmax(weights)])
