# SPDX-License-Identifier: GPL-2.0-or-later
"""Finds what makes no sense in a layout.

A `Problem` names the place as a path of field names and indices from the layout down, so that the
reader of a file can find the line; `check_layout` and `check_die` raise the first one.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterator
from dataclasses import dataclass

from icwafer.chips.blocks import block_problems, overlap_problems
from icwafer.chips.model import MAX_BLOCKS, MAX_DIES, DieSpec, Group, Layout, size_nm
from icwafer.chips.outline import MARKS
from icwafer.chips.placement import RETICLE_MM, reticle_field, test_field_dies_mm
from icwafer.chips.rules import Rule, rule_of
from icwafer.chips.spread import Clustered, Spread, Uniform
from icwafer.chips.wafer import Wafer
from icwafer.errors import IcwaferError
from icwafer.suggest import unknown
from icwafer.toml_lines import FieldPath, key_name


@dataclass(frozen=True)
class Problem:
    """path: where, from the layout down, indices from 0. text: what, and what is allowed."""

    path: FieldPath
    text: str


def check_layout(layout: Layout) -> None:
    """Raises IcwaferError for the first problem of a layout."""
    _raise_first(problems(layout))


def check_die(spec: DieSpec) -> None:
    """Raises IcwaferError for the first problem of a die; that listed blocks overlap is none here,
    because finding that takes long: `check_layout` does it, and so do reading and writing."""
    _raise_first(_die_problems(spec, (f"die '{spec.name}'",)))


def problems(layout: Layout) -> Iterator[Problem]:
    """All problems of a layout."""
    yield from _field_problems(layout, ())
    for index, spec in enumerate(layout.dies):
        yield from _die_problems(spec, ("dies", index))
        if spec.blocks is not None:
            for text in overlap_problems(spec.blocks):
                yield Problem(("dies", index, "blocks"), text)
    yield from _twice([spec.name for spec in layout.dies], ("dies",))
    if layout.wafer is not None:
        yield from _wafer_problems(layout, layout.wafer)


def _raise_first(found: Iterator[Problem]) -> None:
    for problem in found:
        raise IcwaferError(f"{key_name(problem.path)}: {problem.text}")


def _die_problems(spec: DieSpec, path: FieldPath) -> Iterator[Problem]:
    yield from _field_problems(spec, path)
    yield from _twice([group.name for group in spec.groups], (*path, "groups"))
    for index, group in enumerate(spec.groups):
        yield from group_problems(group, (*path, "groups", index))
    if spec.blocks is None and size_nm(spec).area_um2 > MAX_BLOCKS * spec.block_um**2:
        least = math.ceil((size_nm(spec).area_um2 / MAX_BLOCKS) ** 0.5)
        text = f"{spec.block_um:g} makes more than {MAX_BLOCKS} blocks: use {least} or more"
        yield Problem((*path, "block_um"), text)
    if spec.blocks is not None:
        for text in block_problems(spec.blocks, spec):
            yield Problem((*path, "blocks"), text)
            return


def group_problems(group: Group, path: FieldPath) -> Iterator[Problem]:
    """All problems of a group."""
    yield from _field_problems(group, path)
    for width, spacing in (("width_nm", "spacing_nm"), ("cross_width_nm", "cross_spacing_nm")):
        widest, closest = getattr(group, width).high, getattr(group, spacing).low
        if widest >= closest > 0:
            yield Problem(
                (*path, width),
                f"up to {widest:g} of group '{group.name}' leaves no gap between wires: keep it "
                f"below {spacing}, which may be {closest:g}",
            )


def _wafer_problems(layout: Layout, wafer: Wafer) -> Iterator[Problem]:
    yield from _field_problems(wafer, ("wafer",))
    for name in ("oxide", "groove", "width"):
        yield from _field_problems(getattr(wafer, name), ("wafer", name))
    if wafer.diameter_mm not in MARKS:
        sizes = ", ".join(map(str, MARKS))
        yield Problem(("wafer", "diameter_mm"), f"{wafer.diameter_mm} is not one of {sizes}")
        return
    marks = (*MARKS[wafer.diameter_mm], "none")
    if wafer.mark not in marks:
        text = f"'{wafer.mark}' is not made on {wafer.diameter_mm} mm: use {' or '.join(marks)}"
        yield Problem(("wafer", "mark"), text)
        return
    product = layout.dies[0]
    if reticle_field(product, wafer) is None:
        count = f"{max(1, wafer.field_columns)} x {max(1, wafer.field_rows)}"
        yield Problem(
            ("wafer", "field_columns" if wafer.field_columns > 1 else "field_rows"),
            f"{count} dies of {product.width_mm:g} x {product.height_mm:g} mm are more than a "
            f"reticle holds, {RETICLE_MM[0]:g} x {RETICLE_MM[1]:g} mm: make the dies smaller or "
            "fewer",
        )
        return
    lane_mm = wafer.scribe_um / 1000
    pitch_mm2 = (product.width_mm + lane_mm) * (product.height_mm + lane_mm)
    if wafer.diameter_mm**2 > MAX_DIES * pitch_mm2:
        yield Problem(
            ("dies", 0, "width_mm"),
            f"so small a die is there more than {MAX_DIES} times on a wafer of "
            f"{wafer.diameter_mm} mm: make it larger or leave [wafer] out",
        )
        return
    if wafer.test_fields and len(layout.dies) < 2:
        yield Problem(("wafer", "test_fields"), "there is no second die to stand there: add one")
        return
    for index, place in enumerate(wafer.test_fields):
        if place in wafer.test_fields[:index]:
            yield Problem(("wafer", "test_fields", index), f"field {list(place)} is there twice")
        if not len(test_field_dies_mm(layout, place)):
            yield Problem(
                ("wafer", "test_fields", index),
                f"field {list(place)} is not "
                f"{'' if wafer.partial_dies else 'wholly '}on the wafer, or too small for the die "
                f"'{layout.dies[1].name}': choose one nearer to [0, 0]",
            )


def _twice(names: list[str], path: FieldPath) -> Iterator[Problem]:
    seen = set()
    for index, name in enumerate(names):
        if name in seen:
            yield Problem((*path, index, "name"), f"'{name}' is already taken: choose another")
        seen.add(name)


def _field_problems(thing: object, path: FieldPath) -> Iterator[Problem]:
    """Values of a dataclass outside their rules; dataclasses inside it have their own checks."""
    for declared in dataclasses.fields(thing):
        value, here = getattr(thing, declared.name), (*path, declared.name)
        text = _value_problem(value, rule_of(declared))
        if text:
            yield Problem(here, text)


def _value_problem(value: object, rule: Rule) -> str:
    if isinstance(value, Spread):
        return _spread_problem(value, rule)
    if rule.choices and isinstance(value, str) and value not in rule.choices():
        return unknown("", value, rule.choices())
    if isinstance(value, str):
        fine = 0 < len(value) <= 60 and value.isprintable()
        return "" if fine else f"{value!r:.80} is no name: use 1 to 60 printable letters"
    if isinstance(value, tuple) and not rule.low <= len(value) <= rule.high:
        return f"{len(value)} entries: there must be {rule.range}"
    if isinstance(value, (int, float)) and not isinstance(value, bool) and not rule.choices:
        return "" if rule.allows(value) else f"{value:g} is outside {rule.range}"
    return ""


def _spread_problem(spread: Spread, rule: Rule) -> str:
    if isinstance(spread, Uniform) and not spread.low <= spread.high:
        return f"low {spread.low:g} is above high {spread.high:g}"
    if isinstance(spread, Clustered) and not spread.centres:
        return "no centres: give at least one"
    own = spread.cluster_deviation if isinstance(spread, Clustered) else spread.deviation
    if not (math.isfinite(own) and own >= 0):
        return f"deviation {own:g} is outside 0 and above"
    if not (rule.allows(spread.low) and rule.allows(spread.high)):
        reach = (
            f"{spread.low:g}"
            if spread.low == spread.high
            else f"{spread.low:g} to {spread.high:g}"
        )
        return f"{reach} is outside {rule.range}" + (
            "; a normal spread reaches three deviations" if spread.deviation > 0 else ""
        )
    return ""
