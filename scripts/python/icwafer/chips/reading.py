# SPDX-License-Identifier: GPL-2.0-or-later
"""Turns the tables of a layout file into the dataclasses of the model."""

from __future__ import annotations

import dataclasses
import typing
from collections.abc import Callable
from typing import Any

import numpy as np

from icwafer.chips import packing
from icwafer.chips.check import Problem, group_problems
from icwafer.chips.model import BlockTable, DieSpec, Group, Kind, Layout, kind_names
from icwafer.chips.rules import rule_of
from icwafer.chips.spread import Clustered, Normal, Spread, Uniform
from icwafer.suggest import unknown
from icwafer.toml_lines import FieldPath


class Unreadable(Exception):
    """A table, key or value that no layout has."""

    def __init__(self, path: FieldPath, text: str) -> None:
        super().__init__(text)
        self.problem = Problem(path, text)


def layout_of(document: dict[str, Any]) -> Layout:
    """The layout of a file's tables, not checked for sense. Raises Unreadable."""
    return _dataclass(Layout, document, ())


def _dataclass(cls: type, table: object, path: FieldPath, base: object = None) -> Any:
    """A dataclass from a table; fields that it leaves out are those of `base`, or defaults."""
    if not isinstance(table, dict):
        raise Unreadable(path, f"{table!r:.60} is not a table")
    hints = typing.get_type_hints(cls)
    declared = {field.name: field for field in dataclasses.fields(cls)}
    values = {} if base is None else {name: getattr(base, name) for name in declared}
    for key, value in table.items():
        if key not in declared:
            raise Unreadable((*path, key), unknown("field", key, declared))
        values[key] = _decode(hints[key], value, (*path, key), values.get(key))
    for name, field in declared.items():
        if name not in values and field.default is dataclasses.MISSING:
            raise Unreadable(path, f"{name} is missing: give {rule_of(field).help}")
    if cls is DieSpec and isinstance(values.get("blocks"), dict):
        values["blocks"] = _blocks(values["blocks"], values["groups"], (*path, "blocks"))
    return cls(**values)


def _decode(hint: Any, value: object, path: FieldPath, old: Any) -> Any:
    if hint == tuple[DieSpec, ...]:
        return tuple(_die(item, (*path, i)) for i, item in enumerate(_list(value, path)))
    if hint == tuple[Group, ...]:
        return _groups(_list(value, path), path, old or ())
    if hint == tuple[tuple[int, int], ...]:
        return tuple(_pair(item, (*path, i)) for i, item in enumerate(_list(value, path)))
    if hint == BlockTable | None:
        return value  # needs the groups
    decoder = _DECODERS.get(hint)
    if decoder:
        return decoder(value, path)
    cls = next((part for part in typing.get_args(hint) if dataclasses.is_dataclass(part)), hint)
    return _dataclass(cls, value, path)


def _die(table: object, path: FieldPath) -> DieSpec:
    from icwafer.chips.presets import PRESETS

    if not isinstance(table, dict) or "preset" not in table:
        return _dataclass(DieSpec, table, path)
    name = _text(table["preset"], (*path, "preset"))
    if name not in PRESETS:
        raise Unreadable((*path, "preset"), unknown("preset", name, PRESETS))
    changes = {key: value for key, value in table.items() if key != "preset"}
    return _dataclass(DieSpec, changes, path, PRESETS[name].dies[0])


def _groups(tables: list, path: FieldPath, old: tuple[Group, ...]) -> tuple[Group, ...]:
    """The groups of a preset, changed by tables of the same name, and new ones."""
    groups = {group.name: group for group in old}
    names = set()
    for index, table in enumerate(tables):
        name = table.get("name") if isinstance(table, dict) else None
        base = groups.get(name) if isinstance(name, str) else None
        group = _dataclass(Group, table, (*path, index), base)
        if group.name in names:
            text = f"'{group.name}' is already taken: choose another"
            raise Unreadable((*path, index, "name"), text)
        for problem in group_problems(group, (*path, index)):  # later its index may be another
            raise Unreadable(problem.path, problem.text)
        names.add(group.name)
        groups[group.name] = group
    return tuple(groups.values())


def _blocks(table: dict, groups: tuple[Group, ...], path: FieldPath) -> BlockTable:
    if set(table) == {"rows"}:
        names = {group.name: index for index, group in enumerate(groups)}
        rows = [
            _row(row, names, (*path, "rows", index))
            for index, row in enumerate(_list(table["rows"], (*path, "rows")))
        ]
        columns = np.array(rows).reshape(-1, 5)
        return BlockTable.from_um(columns[:, :4], columns[:, 4])
    if set(table) == {"count", "packed"}:
        count = _whole(table["count"], (*path, "count"))
        try:
            return packing.unpacked(_text(table["packed"], (*path, "packed")), count)
        except packing.Damaged as error:
            raise Unreadable((*path, "packed"), str(error)) from None
    raise Unreadable(path, "needs either 'rows', or 'count' and 'packed', and nothing else")


def _row(row: object, names: dict[str, int], path: FieldPath) -> tuple[float, ...]:
    if not isinstance(row, list) or len(row) != 5:
        raise Unreadable(path, f'{row!r:.60} is not [x0, y0, x1, y1, "group"]')
    *corners, name = row
    if not isinstance(name, str) or name not in names:
        raise Unreadable(path, unknown("group", str(name), names))
    corners = [_number(corner, path) for corner in corners]
    if not all(abs(corner) <= 1e6 for corner in corners):
        raise Unreadable(path, f"{row!r:.60} is larger than any die: lengths are in micrometres")
    return (*corners, names[name])


def _spread(value: object, path: FieldPath) -> Spread:
    if not isinstance(value, dict):
        return Normal(_number(value, path))
    keys = set(value)
    if keys == {"low", "high"}:
        return Uniform(*(_number(value[key], (*path, key)) for key in ("low", "high")))
    deviation = _number(value.get("deviation", 0.0), (*path, "deviation"))
    if keys - {"deviation"} == {"mean"}:
        return Normal(_number(value["mean"], (*path, "mean")), deviation)
    if keys - {"deviation"} == {"centres"}:
        centres = _list(value["centres"], (*path, "centres"))
        return Clustered(tuple(_number(c, (*path, "centres")) for c in centres), deviation)
    raise Unreadable(
        path, "needs a number, {mean, deviation}, {low, high} or {centres, deviation}"
    )


def _kind(value: object, path: FieldPath) -> Kind:
    name = _text(value, path)
    if name not in kind_names():
        raise Unreadable(path, unknown("kind", name, kind_names()))
    return Kind[name.upper()]


def _pair(value: object, path: FieldPath) -> tuple[int, int]:
    if not isinstance(value, list) or len(value) != 2:
        raise Unreadable(path, f"{value!r:.60} is not [column, row]")
    return _whole(value[0], path), _whole(value[1], path)


def _list(value: object, path: FieldPath) -> list:
    if not isinstance(value, list):
        raise Unreadable(path, f"{value!r:.60} is not a list")
    return value


def _text(value: object, path: FieldPath) -> str:
    if not isinstance(value, str):
        raise Unreadable(path, f"{value!r:.60} is not a text in quotes")
    return value


def _number(value: object, path: FieldPath) -> float:
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise Unreadable(path, f"{value!r:.60} is not a number")
    try:
        return float(value)
    except OverflowError:
        raise Unreadable(path, "a number too large") from None


def _whole(value: object, path: FieldPath) -> int:
    if isinstance(value, bool) or not isinstance(value, int):
        raise Unreadable(path, f"{value!r:.60} is not a whole number")
    if abs(value) > 2**62:
        raise Unreadable(path, "a number too large")
    return value


def _flag(value: object, path: FieldPath) -> bool:
    if not isinstance(value, bool):
        raise Unreadable(path, f"{value!r:.60} is neither true nor false")
    return value


_DECODERS: dict[Any, Callable[[object, FieldPath], Any]] = {
    str: _text,
    float: _number,
    int: _whole,
    bool: _flag,
    Kind: _kind,
    Spread: _spread,
}
