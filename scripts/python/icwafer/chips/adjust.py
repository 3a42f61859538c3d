# SPDX-License-Identifier: GPL-2.0-or-later
"""Changes of a layout by hand, as in a panel.

What makes no sense is brought to the nearest that does.

Numbers from a panel have single precision. One that is equal to what it would replace up to that
changes nothing, so that an untouched panel gives the preset, to the last byte.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterable
from dataclasses import dataclass

from icwafer.chips.check import check_layout
from icwafer.chips.model import DieSpec, Group, Layout, size_nm
from icwafer.chips.outline import MARKS
from icwafer.chips.placement import reticle_field, test_field_dies_mm
from icwafer.chips.rules import Rule, rule_of
from icwafer.chips.spread import Spread
from icwafer.chips.wafer import Drift, Wafer

#: Numbers closer than this, relative, are the same in single precision.
_SAME = 2.0**-22


@dataclass(frozen=True)
class GroupChange:
    """What is wanted of the group of this name; means and one standard deviation."""

    name: str
    spacing_nm: float
    deviation_nm: float
    oxide_nm: float
    diffraction: float
    turned: float

    @classmethod
    def none(cls, group: Group) -> GroupChange:
        """What a group is already."""
        return cls(
            group.name,
            group.spacing_nm.mean,
            group.spacing_nm.deviation,
            group.oxide_nm.mean,
            group.diffraction.mean,
            group.turned,
        )


def adjusted_die(
    spec: DieSpec,
    *,
    seed: int,
    width_mm: float,
    height_mm: float,
    block_um: float,
    groups: Iterable[GroupChange] = (),
    most_blocks: float = math.inf,
) -> DieSpec:
    """A die with other numbers; block_um grows where there would be more than `most_blocks`.

    The changes of groups that the die does not have are left out.
    """
    changes = {change.name: change for change in groups}
    spec = dataclasses.replace(
        spec,
        seed=seed,
        width_mm=_kept(spec.width_mm, width_mm),
        height_mm=_kept(spec.height_mm, height_mm),
        groups=tuple(
            adjusted_group(group, changes[group.name]) if group.name in changes else group
            for group in spec.groups
        ),
    )
    least_um = (size_nm(spec).area_um2 / most_blocks) ** 0.5
    return dataclasses.replace(spec, block_um=max(_kept(spec.block_um, block_um), least_um))


def adjusted_group(group: Group, change: GroupChange) -> Group:
    """A group with other numbers, inside their rules.

    The wires keep their share of the spacing, and the spread stays so narrow that there is a gap
    between them.
    """
    rules = {declared.name: rule_of(declared) for declared in dataclasses.fields(Group)}
    spacing = group.spacing_nm
    mean = _kept(spacing.mean, change.spacing_nm, rules["spacing_nm"])
    scale = mean / spacing.mean
    width = _moved(group.width_nm, scale * group.width_nm.mean, rules["width_nm"], scale)
    deviation = _kept(spacing.deviation, max(0.0, change.deviation_nm))
    if (mean, deviation) != (spacing.mean, spacing.deviation):
        floor = max(rules["spacing_nm"].low, 1.001 * width.high)
        spacing = _narrowed(spacing.moved(mean, deviation), floor, rules["spacing_nm"].high)
    return dataclasses.replace(
        group,
        spacing_nm=spacing,
        width_nm=width,
        oxide_nm=_moved(group.oxide_nm, change.oxide_nm, rules["oxide_nm"]),
        diffraction=_moved(group.diffraction, change.diffraction, rules["diffraction"]),
        turned=_kept(group.turned, change.turned, rules["turned"]),
    )


@dataclass(frozen=True)
class WaferChange:
    """What is wanted of a wafer.

    marked: notch or flats, whichever wafers of that diameter have; else none. test_dies: whether
    test dies stand where the layout wants them and where they fit. drift: factor on all drift.
    """

    diameter_mm: int
    marked: bool
    edge_exclusion_mm: float
    scribe_um: float
    partial_dies: bool
    test_dies: bool
    drift: float
    seed: int


def adjusted_wafer(dies: tuple[DieSpec, ...], wafer: Wafer, change: WaferChange) -> Layout:
    """A layout of dies on a wafer with other numbers. Raises IcwaferError where none fits."""
    wanted_fields = wafer.test_fields
    scaled = {
        name: _scaled(getattr(wafer, name), change.drift) for name in ("oxide", "groove", "width")
    }
    wafer = dataclasses.replace(
        wafer,
        diameter_mm=change.diameter_mm,
        mark=MARKS[change.diameter_mm][0] if change.marked else "none",
        edge_exclusion_mm=change.edge_exclusion_mm,
        scribe_um=change.scribe_um,
        partial_dies=change.partial_dies,
        test_fields=(),
        seed=change.seed,
        **scaled,
    )
    if reticle_field(dies[0], wafer) is None:  # the dies are larger than they were
        wafer = dataclasses.replace(wafer, field_columns=0, field_rows=0, blank_fields=())
    layout = Layout(dies, wafer)
    check_layout(layout)
    if change.test_dies and len(dies) > 1:
        fields = tuple(
            place for place in wanted_fields if len(test_field_dies_mm(layout, place))
        )
        layout = Layout(dies, dataclasses.replace(wafer, test_fields=fields))
    return layout


def _kept(old: float, new: float, rule: Rule = Rule("")) -> float:
    """The new value inside its rule, or the old one if both are the same in single precision."""
    return old if math.isclose(old, new, rel_tol=_SAME) else min(max(new, rule.low), rule.high)


def _moved(spread: Spread, mean: float, rule: Rule, scale: float = 1.0) -> Spread:
    """A spread around another mean, `scale` times as wide or as wide as the rule lets it be."""
    mean = _kept(spread.mean, mean, rule)
    if mean == spread.mean:
        return spread
    return _narrowed(spread.moved(mean, scale * spread.deviation), rule.low, rule.high)


def _narrowed(spread: Spread, low: float, high: float) -> Spread:
    """A spread with the same mean, so narrow that it stays inside the ends."""
    reach = max(spread.mean - spread.low, spread.high - spread.mean)
    room = max(0.0, min(spread.mean - low, high - spread.mean))
    if reach <= room:
        return spread
    return spread.moved(spread.mean, spread.deviation * room / reach)


def _scaled(drift: Drift, factor: float) -> Drift:
    """A drift so many times as large, inside its rules."""
    rules = {declared.name: rule_of(declared) for declared in dataclasses.fields(Drift)}
    return dataclasses.replace(
        drift,
        **{
            name: _kept(getattr(drift, name), factor * getattr(drift, name), rules[name])
            for name in ("bow", "ring", "tilt", "noise")
        },
    )
