# SPDX-License-Identifier: GPL-2.0-or-later
"""Turns the dataclasses of the model into the lines of a layout file."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator

from icwafer.chips import packing
from icwafer.chips.model import BlockTable, Group, Kind, Layout
from icwafer.chips.spread import Clustered, Normal, Spread, Uniform

_MAX_ROWS = 1000
_BY_FLOORPLAN = ("floorplan", "copies_alike", "block_um")  # not used by a die with blocks


def lines_of_layout(layout: Layout) -> Iterator[str]:
    """All lines of a layout but the first two, which say what the file is."""
    for spec in layout.dies:
        yield from ("", "[[dies]]")
        unused = _BY_FLOORPLAN if spec.blocks is not None else ()
        yield from _lines_of_fields(spec, skip=unused)
        for group in spec.groups:
            yield from ("", "[[dies.groups]]")
            yield from _lines_of_fields(group)
        if spec.blocks is not None:
            yield from ("", "[dies.blocks]")
            yield from _lines_of_blocks(spec.blocks, spec.groups)
    if layout.wafer is not None:
        yield from ("", "[wafer]")
        yield from _lines_of_fields(layout.wafer)
        for field in dataclasses.fields(layout.wafer):
            value = getattr(layout.wafer, field.name)
            if dataclasses.is_dataclass(value):
                yield from ("", f"[wafer.{field.name}]")
                yield from _lines_of_fields(value)


def _lines_of_fields(thing: object, skip: tuple[str, ...] = ()) -> Iterator[str]:
    """The plain fields of a dataclass; those with tables of their own come after them."""
    for field in dataclasses.fields(thing):
        value = getattr(thing, field.name)
        tables = isinstance(value, tuple) and value and dataclasses.is_dataclass(value[0])
        nested = dataclasses.is_dataclass(value) and not isinstance(value, Spread)
        if value is not None and not tables and not nested and field.name not in skip:
            yield f"{field.name} = {_encode(value)}"


def _encode(value: object) -> str:
    if isinstance(value, Kind):
        return _encode(value.name.lower())
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return '"' + value.replace("\\", "\\\\").replace('"', '\\"') + '"'
    if isinstance(value, float):
        return repr(float(value))
    if isinstance(value, tuple):
        return "[" + ", ".join(map(_encode, value)) + "]"
    if isinstance(value, Uniform):
        return f"{{ low = {_encode(float(value.low))}, high = {_encode(float(value.high))} }}"
    if isinstance(value, Clustered):
        centres = _encode(tuple(map(float, value.centres)))
        deviation = _encode(float(value.cluster_deviation))
        return f"{{ centres = {centres}, deviation = {deviation} }}"
    if isinstance(value, Normal):
        mean, deviation = _encode(float(value.mean)), _encode(float(value.deviation))
        return f"{{ mean = {mean}, deviation = {deviation} }}" if value.deviation else mean
    return str(value)


def _lines_of_blocks(blocks: BlockTable, groups: tuple[Group, ...]) -> Iterator[str]:
    if len(blocks) > _MAX_ROWS:
        yield f"count = {len(blocks)}"
        yield f"packed = '{packing.packed(blocks)}'"
        return
    yield "rows = ["
    for rect_um, group in zip((blocks.rect_nm / 1000).tolist(), blocks.group):
        yield f"  [{', '.join(map(repr, rect_um))}, {_encode(groups[group].name)}],"
    yield "]"
