# SPDX-License-Identifier: GPL-2.0-or-later
"""Changes of a layout from the command line: `wafer.diameter_mm=200`.

The key is the path of a field as messages spell it, `dies[1].groups[3].spacing_nm`, counting from
1; a die or a group may be named instead, `dies[test-chip]`, and a field of the first die needs no
path. The value is written as in a layout file; a text needs no quotes.
"""

from __future__ import annotations

import dataclasses
import re
import tomllib
from collections.abc import Iterable
from typing import Any

from icwafer.chips.check import problems
from icwafer.chips.document import layout_text
from icwafer.chips.model import DieSpec, Layout
from icwafer.chips.reading import Unreadable, layout_of
from icwafer.errors import IcwaferError
from icwafer.suggest import unknown
from icwafer.toml_lines import key_name

_STEP = re.compile(r"(\w+)(?:\[([^\]]+)\])?")


def changed(layout: Layout, settings: Iterable[str]) -> Layout:
    """A layout with some fields set; each setting is `KEY=VALUE`.

    Raises IcwaferError that begins with the setting, or with the field that it makes wrong.
    """
    document = tomllib.loads(layout_text(layout))
    del document["format"], document["version"]
    for setting in settings:
        key, equals, value = setting.partition("=")
        if not equals:
            raise IcwaferError(f"--set {setting}: write KEY=VALUE, as in seed=5")
        _set(document, setting, key.strip(), value.strip())
    try:
        result = layout_of(document)
        problem = next(problems(result), None)
    except Unreadable as error:
        problem = error.problem
    if problem:
        raise IcwaferError(f"{key_name(problem.path)}: {problem.text}")
    return result


def _set(document: dict[str, Any], setting: str, key: str, value: str) -> None:
    steps = key.split(".")
    if steps[0].partition("[")[0] in {field.name for field in dataclasses.fields(DieSpec)}:
        steps.insert(0, "dies[1]")
    if steps[0] == "wafer":
        document.setdefault("wafer", {})
    table = document
    for step in steps[:-1]:
        table = _inside(table, step, setting)
    match = _STEP.fullmatch(steps[-1])
    if not match or match[2] or not isinstance(table, dict):
        raise IcwaferError(f"--set {setting}: '{key}' is no field; write as in wafer.diameter_mm")
    table[steps[-1]] = _value(value)


def _inside(table: dict[str, Any], step: str, setting: str) -> dict[str, Any]:
    match = _STEP.fullmatch(step)
    if not match:
        raise IcwaferError(f"--set {setting}: '{step}' is no field; write as in dies[1].seed")
    name, place = match.groups()
    if not isinstance(table, dict):
        raise IcwaferError(f"--set {setting}: what is before '{step}' has no fields; leave it out")
    if name not in table:
        raise IcwaferError(f"--set {setting}: {unknown('field', name, table)}")
    inner = table[name]
    if place is None or not isinstance(inner, list):
        return inner
    if place.isdecimal():
        if not 1 <= int(place) <= len(inner):
            raise IcwaferError(
                f"--set {setting}: {name} are 1 to {len(inner)}, there is no {place}"
            )
        return inner[int(place) - 1]
    names = [item["name"] for item in inner if isinstance(item, dict)]
    if place not in names:
        raise IcwaferError(f"--set {setting}: {unknown(name[:-1], place, names)}")
    return inner[names.index(place)]


def _value(text: str) -> object:
    try:
        return tomllib.loads(f"value = {text}")["value"]
    except ValueError:
        return text
