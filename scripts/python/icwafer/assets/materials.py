# SPDX-License-Identifier: GPL-2.0-or-later
"""The table of materials: the library's assets, and the presets in the material's properties.

Its format is explained at the top of the table itself, blend_assets/library/materials.toml.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Any

from icwafer import toml_lines
from icwafer.errors import IcwaferError, SettingError
from icwafer.suggest import nearest

FILE_NAME = "materials.toml"
FORMAT = "icwafer-materials"
VERSION = 1

_TEXTS = ("name", "catalog", "description", "source")
_FLAGS = ("from_attributes", "round_tracks")

#: Returns the value of a setting as it is stored; raises SettingError where it is not allowed.
Check = Callable[[str, Any], Any]


@dataclass(frozen=True)
class MaterialPreset:
    """A material: `node` has the inputs and properties of the node that it sets, by name.

    from_attributes: the mesh's attributes drive the inputs that `node` does not name.
    round_tracks: the wires run around the object's Z axis.
    """

    name: str
    catalog: str
    description: str
    source: str
    node: Mapping[str, Any]
    from_attributes: bool = False
    round_tracks: bool = False


def read_materials(path: Path, check: Check | None = None) -> tuple[MaterialPreset, ...]:
    """The materials of a table, in its order.

    check: looks at `node.NAME` and its value; without it any value is taken. Raises IcwaferError
    with the file, line and field.
    """
    document = toml_lines.read(path)
    if document.data.get("format") != FORMAT or document.data.get("version") != VERSION:
        raise IcwaferError(
            f'{path}:1: must begin with format = "{FORMAT}" and version = {VERSION}'
        )
    presets: dict[str, MaterialPreset] = {}
    for index, table in enumerate(document.data.get("materials", ())):
        preset = _preset(document, ("materials", index), table, check)
        if preset.name in presets:
            raise document.error(("materials", index, "name"), f"is {preset.name!r} twice")
        presets[preset.name] = preset
    return tuple(presets.values())


def _preset(
    document: toml_lines.Document,
    place: toml_lines.FieldPath,
    table: dict[str, Any],
    check: Check | None,
) -> MaterialPreset:
    known = (*_TEXTS, *_FLAGS, "node")
    for key, value in table.items():
        if key not in known:
            raise document.error((*place, key), f"is unknown: {nearest(key, known)}")
        kind, wanted = (
            (str, "a text")
            if key in _TEXTS
            else (bool, "true or false")
            if key in _FLAGS
            else (dict, "a table")
        )
        if not isinstance(value, kind) or value == "":
            raise document.error((*place, key), f"is {value!r:.60}: write {wanted}")
    for key in (*_TEXTS, "node"):
        if key not in table:
            raise document.error(place, f"has no {key}: add it")
    node = dict(table["node"])
    for name, value in node.items():
        if check:
            try:
                node[name] = check(f"node.{name}", value)
            except SettingError as error:
                raise document.error((*place, "node", name), str(error)) from None
    return MaterialPreset(**(table | {"node": MappingProxyType(node)}))
