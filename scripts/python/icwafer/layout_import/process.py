# SPDX-License-Identifier: GPL-2.0-or-later
"""The metal layers of a process: where they are in a file, and how high on the wafer.

A layer map is a TOML file:

    format = "icwafer-process"
    version = 1
    name = "sky130"
    oxide_top_um = 5.3711            # upper side of the oxide above the highest metal
    nitride_um = 0.42                # silicon nitride above that

    [[layers]]                       # one for each metal layer, in any order
    name = "met1"
    gds = ["68/20"]                  # layer/datatype in GDSII and OASIS; several are united
    lef = "met1"                     # name in LEF and DEF; the layer's own name if left out
    bottom_um = 1.3761               # height of its lower side above the substrate
    thickness_um = 0.36
    metal = "aluminium"              # aluminium, copper, tungsten or silicon
"""

from __future__ import annotations

import dataclasses
import re
import tomllib
import typing
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from icwafer.chips.rules import rule_of, ruled
from icwafer.errors import IcwaferError
from icwafer.suggest import unknown
from icwafer.toml_lines import key_name, line_of

#: The process of a file of which nothing else is said.
USUAL = "sky130"
FORMAT = "icwafer-process"
VERSION = 1

_FOLDER = Path(__file__).parent / "processes"

#: Complex refractive indices at 550 nm: Al Rakic 1995, Cu Johnson and Christy 1972, W Werner 2009,
#: Si Green 2008 (refractiveindex.info).
_INDEX = {
    "aluminium": 1.02 + 6.63j,
    "copper": 1.04 + 2.58j,
    "tungsten": 1.33 + 5.24j,
    "silicon": 4.08 + 0.03j,
}
OXIDE_INDEX = 1.46  # SiO2 at 550 nm, Malitson 1965
NITRIDE_INDEX = 2.02  # Si3N4 at 550 nm, Philipp 1973


def metal_names() -> tuple[str, ...]:
    """The metals that a layer may be of."""
    return tuple(_INDEX)


@dataclass(frozen=True)
class MetalLayer:
    """A layer of metal."""

    name: str = ruled("what it is called, unique in its process")
    gds: tuple[str, ...] = ruled("its layer/datatype in GDSII and OASIS", 1, 16)
    bottom_um: float = ruled("height of its lower side above the substrate", 0, 100)
    thickness_um: float = ruled("from its lower to its upper side", 0.001, 20)
    metal: str = ruled("what it is of", choices=metal_names)
    lef: str = ruled("its name in LEF and DEF", default="")

    @property
    def top_um(self) -> float:
        """Height of its upper side above the substrate."""
        return self.bottom_um + self.thickness_um

    @property
    def reflectance(self) -> float:
        """Share of green light that it reflects inside oxide, by Fresnel's formula."""
        index = _INDEX[self.metal]
        return abs((OXIDE_INDEX - index) / (OXIDE_INDEX + index)) ** 2


@dataclass(frozen=True)
class Process:
    """What the layers of a layout file are; `layers` is sorted, the highest first."""

    name: str = ruled("what it is called")
    oxide_top_um: float = ruled("upper side of the oxide above the highest metal", 0, 100)
    layers: tuple[MetalLayer, ...] = ruled("its metal layers", 1, 64)
    nitride_um: float = ruled("silicon nitride above the oxide", 0, 20, default=0.0)

    def oxide_nm(self, layer: MetalLayer) -> float:
        """Oxide above a layer; nitride counts as the oxide of the same optical thickness."""
        oxide = max(0.0, self.oxide_top_um - layer.top_um)
        return 1000 * (oxide + self.nitride_um * NITRIDE_INDEX / OXIDE_INDEX)


class _Wrong(Exception):
    def __init__(self, path: tuple[str | int, ...], text: str) -> None:
        super().__init__(text)
        self.path, self.text = path, text


def built_in() -> tuple[str, ...]:
    """Names of the processes that come with the program."""
    return tuple(sorted(path.stem for path in _FOLDER.glob("*.toml")))


def read_process(name: str) -> Process:
    """A process by its built-in name, or from a layer map ending with .toml.

    Raises IcwaferError with the file, line, field, value and allowed range, or OSError.
    """
    if name in built_in():
        path = _FOLDER / f"{name}.toml"
    elif name.endswith(".toml"):
        path = Path(name)
    else:
        raise IcwaferError(f"{unknown('process', name, built_in())} A layer map ends with .toml")
    try:
        text = path.read_text(encoding="utf-8")
        table = tomllib.loads(text)
    except (UnicodeDecodeError, tomllib.TOMLDecodeError, RecursionError) as error:
        raise IcwaferError(f"{path}: not valid TOML: {error}; correct it") from None
    if table.pop("format", None) != FORMAT or table.pop("version", None) != VERSION:
        raise IcwaferError(
            f'{path}:1: no layer map: it must begin with format = "{FORMAT}" and '
            f"version = {VERSION}"
        )
    try:
        return _process(table)
    except _Wrong as wrong:
        line = line_of(text, wrong.path)
        place = f"{key_name(wrong.path)}: " if wrong.path else ""
        raise IcwaferError(f"{path}:{line}: {place}{wrong.text}") from None


def _process(table: dict[str, Any]) -> Process:
    process = _checked(Process, table, ())
    seen: dict[str, int] = {}
    for index, layer in enumerate(process.layers):
        for field, values in (("name", [layer.name]), ("gds", layer.gds), ("lef", [layer.lef])):
            for value in values:
                if seen.setdefault(f"{field} {value}", index) != index:
                    text = f"'{value}' is already taken by layer {seen[f'{field} {value}'] + 1}"
                    raise _Wrong(("layers", index, field), f"{text}: choose another")
    layers = sorted(process.layers, key=lambda layer: -layer.bottom_um)
    return dataclasses.replace(process, layers=tuple(layers))


def _checked(cls: type, table: object, path: tuple[str | int, ...]) -> Any:
    """A dataclass from a table, every value checked against its field's rule."""
    if not isinstance(table, dict):
        raise _Wrong(path, f"{table!r:.60} is not a table")
    fields = {field.name: field for field in dataclasses.fields(cls)}
    hints = typing.get_type_hints(cls)
    for key in table:
        if key not in fields:
            raise _Wrong((*path, key), unknown("field", key, fields))
    for name, field in fields.items():
        if name not in table and field.default is dataclasses.MISSING:
            raise _Wrong(path, f"{name} is missing: give {rule_of(field).help}")
    values = {
        name: _value(hints[name], fields[name], value, (*path, name))
        for name, value in table.items()
    }
    if cls is MetalLayer:
        values.setdefault("lef", values["name"])
    return cls(**values)


def _value(hint: Any, field: dataclasses.Field, value: object, path: tuple[str | int, ...]) -> Any:
    rule = rule_of(field)
    if hint is float:
        if not isinstance(value, (int, float)) or isinstance(value, bool):
            raise _Wrong(path, f"{value!r:.60} is not a number")
        if not rule.allows(value):
            raise _Wrong(path, f"{value:g} is outside {rule.range}")
        return float(value)
    if hint is str:
        if not isinstance(value, str) or not 0 < len(value) <= 60 or not value.isprintable():
            raise _Wrong(path, f"{value!r:.60} is no name: use 1 to 60 printable letters")
        if rule.choices and value not in rule.choices():
            raise _Wrong(path, unknown("", value, rule.choices()))
        return value
    if not isinstance(value, list) or not rule.low <= len(value) <= rule.high:
        raise _Wrong(path, f"must be a list of {rule.range} entries")
    if hint == tuple[MetalLayer, ...]:
        return tuple(_checked(MetalLayer, item, (*path, i)) for i, item in enumerate(value))
    for item in value:
        if not isinstance(item, str) or not re.fullmatch(r"\d{1,5}/\d{1,5}", item):
            raise _Wrong(path, f'{item!r:.60} is not a layer and datatype as in "68/20"')
    return tuple(value)
