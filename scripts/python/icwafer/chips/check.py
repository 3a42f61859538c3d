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

from icwafer.chips.blocks import block_problems
from icwafer.chips.model import BlockTable, DieSpec, Group, Layout
from icwafer.chips.rules import Rule, rule_of
from icwafer.chips.spread import Clustered, Spread, Uniform
from icwafer.chips.suggest import unknown
from icwafer.chips.wafer import Wafer
from icwafer.errors import IcwaferError

Path = tuple[str | int, ...]

#: SEMI M1: the diameters of polished wafers, and the marks that they come with.
DIAMETERS_MM = {100: ("flats",), 125: ("flats",), 150: ("flats", "notch"), 200: ("notch",), 300: ("notch",)}

#: Largest field of a wafer scanner.
RETICLE_MM = (26.0, 33.0)


@dataclass(frozen=True)
class Problem:
    """path: where, from the layout down, indices from 0. text: what, and what is allowed."""

    path: Path
    text: str


def spelled(path: Path) -> str:
    """A path as a message says it, counting from 1: `dies[1].groups[3].width_nm`."""
    words = ""
    for step in path:
        words += f"[{step + 1}]" if isinstance(step, int) else f".{step}" if words else step
    return words


def check_layout(layout: Layout) -> None:
    """Raises IcwaferError for the first problem of a layout."""
    _raise_first(problems(layout))


def check_die(spec: DieSpec) -> None:
    """Raises IcwaferError for the first problem of a die."""
    _raise_first(_die_problems(spec, (f"die '{spec.name}'",)))


def problems(layout: Layout) -> Iterator[Problem]:
    """All problems of a layout."""
    yield from _field_problems(layout, ())
    for index, spec in enumerate(layout.dies):
        yield from _die_problems(spec, ("dies", index))
    yield from _twice([spec.name for spec in layout.dies], ("dies",))
    if layout.wafer is not None:
        yield from _wafer_problems(layout, layout.wafer)


def _raise_first(found: Iterator[Problem]) -> None:
    for problem in found:
        raise IcwaferError(f"{spelled(problem.path)}: {problem.text}")


def _die_problems(spec: DieSpec, path: Path) -> Iterator[Problem]:
    yield from _field_problems(spec, path)
    yield from _twice([group.name for group in spec.groups], (*path, "groups"))
    for index, group in enumerate(spec.groups):
        yield from group_problems(group, (*path, "groups", index))
    if spec.blocks is not None:
        for text in block_problems(spec.blocks, spec):
            yield Problem((*path, "blocks"), text)


def group_problems(group: Group, path: Path) -> Iterator[Problem]:
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
    if wafer.diameter_mm not in DIAMETERS_MM:
        sizes = ", ".join(map(str, DIAMETERS_MM))
        yield Problem(("wafer", "diameter_mm"), f"{wafer.diameter_mm} is not one of {sizes}")
    elif wafer.mark not in (*DIAMETERS_MM[wafer.diameter_mm], "none"):
        marks = " or ".join((*DIAMETERS_MM[wafer.diameter_mm], "none"))
        yield Problem(
            ("wafer", "mark"),
            f"'{wafer.mark}' is not made on {wafer.diameter_mm} mm: use {marks}",
        )
    product, lane = layout.dies[0], wafer.scribe_um / 1000
    for axis, (name, count, size) in enumerate(
        (
            ("field_columns", wafer.field_columns, product.width_mm),
            ("field_rows", wafer.field_rows, product.height_mm),
        )
    ):
        extent = max(1, count) * (size + lane)
        if count and extent - lane > max(RETICLE_MM):
            yield Problem(
                ("wafer", name),
                f"{count} dies of {size:g} mm need {extent - lane:g} mm, but a reticle holds "
                f"{RETICLE_MM[0]:g} x {RETICLE_MM[1]:g} mm",
            )
    if wafer.test_fields and len(layout.dies) < 2:
        yield Problem(("wafer", "test_fields"), "there is no second die to stand there: add one")


def _twice(names: list[str], path: Path) -> Iterator[Problem]:
    for index, name in enumerate(names):
        if name in names[:index]:
            yield Problem((*path, index, "name"), f"'{name}' is already taken: choose another")


def _field_problems(thing: object, path: Path) -> Iterator[Problem]:
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
        reach = f"{spread.low:g}" if spread.low == spread.high else f"{spread.low:g} to {spread.high:g}"
        return f"{reach} is outside {rule.range}" + (
            "; a normal spread reaches three deviations" if spread.deviation > 0 else ""
        )
    return ""
