# SPDX-License-Identifier: GPL-2.0-or-later
"""The settings of a scene: flat names such as `camera.lens_mm`, and what each one allows.

A picture (`icwafer.pictures.Picture`) is a tree of dataclasses; its settings are the leaves:

    lights.2.power_w                 of the second light; lights.*.power_w of each one
    die.groups.cache.spacing_nm      of a group of the die; die.groups.*.spacing_nm of each one
    node.Wire Spacing, node.model    inputs and properties of the node
    data.objects["Lamp"].location    of a .blend file: a data path as Blender writes it

Ranges are those that the dataclasses declare, and of the node's inputs those of its table.
"""

from __future__ import annotations

import dataclasses
import enum
import functools
import math
import sys
import typing
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from icwafer import paths
from icwafer.chips.check import check_die
from icwafer.chips.document import read_layout
from icwafer.chips.model import BlockTable, DieSpec
from icwafer.chips.presets import PRESETS
from icwafer.chips.rules import Rule
from icwafer.chips.spread import Clustered, Normal, Spread, Uniform
from icwafer.errors import SettingError
from icwafer.pictures import PICTURES, Picture
from icwafer.suggest import nearest

sys.path.insert(0, str(paths.PLUGIN / "manual"))
import make_manual  # noqa: E402

#: The settings of one scene as JSON has them, in a fixed order.
Scene = dict[str, Any]

#: Settings that say where a scene, or its die, comes from; they come before all others.
PICTURE, BLEND, LAYOUT = "picture", "blend", "layout"
#: A scene has the file of a layout's blocks here, if the layout lists them one by one.
BLOCKS = "die.blocks"
#: Settings that name a file.
FILES = (BLEND, LAYOUT, BLOCKS, "environment.image")
#: Parts that a scene from a .blend file has; everything else of it is reached by `data.`.
BLEND_PARTS = ("node", "data", "render", "view")

#: What a random quantity may be; a file writes the fields of one of these, or only the mean.
_SPREADS = {
    ("mean", "deviation"): Normal,
    ("low", "high"): Uniform,
    ("centres", "deviation"): Clustered,
}

_NODE_NAMES = {
    "model": ("CS348B", "PHYSICAL"),
    "metal": ("COPPER", "ALUMINIUM", "TUNGSTEN", "SILICON", "CUSTOM"),
    "oxide": ("SIO2", "SI3N4", "CUSTOM"),
    "illuminant": ("EQUAL_ENERGY", "D65", "A", "F2", "F11", "WHITE_LED", "SODIUM"),
}
#: Inputs that are three numbers.
_NODE_VECTORS = {
    "Color": Rule("linear Rec.709", 0, 1),
    "Metal n": Rule("index of the metal in red, green and blue light", 0, 10),
    "Metal k": Rule("extinction of the metal in red, green and blue light", 0, 15),
}
_NODE_FLAGS = ("use_grating", "use_thin_film", "use_wire_diffraction")


@functools.cache
def node_inputs() -> dict[str, Rule]:
    """The node's float inputs by name, from the table of which the node itself is made."""
    return {
        row.name: Rule(row.tooltip, row.minimum, row.maximum) for row in make_manual.float_inputs()
    }


def flatten(thing: Any, prefix: str = "") -> Scene:
    """The leaves of a tree of dataclasses, mappings and tuples of dataclasses, by their names."""
    scene: Scene = {}
    for name, value in _parts(thing):
        if _is_branch(value):
            scene |= flatten(value, f"{prefix}{name}.")
        else:
            scene[prefix + name] = _as_json(value)
    return scene


def picture_of(scene: Mapping[str, Any]) -> Picture:
    """The picture whose settings these are: the inverse of `flatten`.

    Raises IcwaferError for a layout file that cannot be read.
    """
    tree = {"caption": "", "lights": {}} | _nested(scene)
    file = scene.get(BLOCKS)
    tree["die"]["blocks"] = layout_die(file).blocks if file else None
    return _build(Picture, tree)


def check_die_of(scene: Mapping[str, Any]) -> None:
    """Raises IcwaferError where the settings of a scene's die do not make sense together."""
    check_die(picture_of(scene).die)


@functools.cache
def picture_settings(name: str) -> Scene:
    """The settings of one of the project's pictures; not to be changed."""
    scene = flatten(PICTURES[name])
    del scene["caption"]
    return _checked_all(scene)


@functools.cache
def layout_settings(layout: str) -> Scene:
    """The settings of a layout's first die, of a preset's or a file's; not to be changed.

    Raises IcwaferError for a file that is no layout.
    """
    die = PRESETS[layout].dies[0] if layout in PRESETS else layout_die(layout)
    blocks = {BLOCKS: layout} if die.blocks is not None else {}
    return _checked_all(flatten(dataclasses.replace(die, blocks=None), "die.")) | blocks


def _checked_all(scene: Scene) -> Scene:
    """The same settings as a study that sets each of them stores them: 1080 as 1080.0."""
    return {name: check(name, value) for name, value in scene.items()}


@functools.cache
def layout_die(file: str) -> DieSpec:
    """The first die of a layout file. Raises IcwaferError for a file that is no layout."""
    return read_layout(Path(file)).dies[0]


def check(name: str, value: Any) -> Any:
    """The value of a setting as the scene stores it. Raises SettingError where it is not allowed.

    Whether the setting exists in a particular scene (a third light, a group) is not looked at.
    """
    if name == PICTURE:
        return _choice(value, tuple(PICTURES))
    if name in (BLEND, LAYOUT):
        return _text(value)
    part, _, rest = name.partition(".")
    if part == "node" and rest:
        return _node_value(rest, value)
    if part == "data" and rest:
        return _data_value(value)
    if name == "lights":
        return _lights(value)
    kind, rule = _declared(name)
    return _checked(kind, rule, value)


def is_leaf(name: str) -> bool:
    """Whether a table that stands at this name is one value, not a part of the scene's tree."""
    if name.startswith(("node.", "data.")):
        return True
    try:
        return _declared(name)[0] is Spread
    except SettingError:
        return False


def expand(name: str, scene: Mapping[str, Any]) -> list[str]:
    """The settings of a scene that a name stands for: several where it has a `*`.

    Raises SettingError where the scene has none.
    """
    part = name.partition(".")[0]
    if BLEND in scene:
        if part not in BLEND_PARTS:
            raise SettingError(
                f"does not exist in a scene from a .blend file: set "
                f"{', '.join(BLEND_PARTS)} or a data path of Blender, data.…"
            )
        return [name]
    if part == "data":
        raise SettingError("is a data path, which only a scene from a .blend file has")
    if part == "node":
        return [name]
    if "*" not in name:
        if name not in scene:
            raise SettingError(f"does not exist: {_nearest_setting(name, scene)}")
        return [name]
    before, after = name.split("*", 1)
    found = [s for s in scene if s.startswith(before) and s.endswith(after)]
    if not found:
        raise SettingError(f"stands for nothing here: {_nearest_setting(name, scene)}")
    return found


def override(scene: Scene, name: str, value: Any) -> None:
    """Sets a checked value in a scene. Raises SettingError where the scene has no such setting."""
    if name in ("lights", LAYOUT) and BLEND not in scene:
        part = "lights." if name == "lights" else "die."
        for old in [setting for setting in scene if setting.startswith(part)]:
            del scene[old]
        if name == LAYOUT:
            scene |= layout_settings(value)
        for number, light in enumerate(value if name == "lights" else (), 1):
            scene |= {f"lights.{number}.{key}": v for key, v in light.items()}
        return
    for setting in expand(name, scene):
        scene[setting] = value


def rules() -> dict[str, Rule]:
    """All settings with what they allow, for help texts; `*` stands for a group or a light."""
    found = {f"node.{name}": rule for name, rule in node_inputs().items()}
    for name in picture_settings("full"):
        parts = name.split(".")
        if parts[0] != "node":
            if parts[0] == "lights" or parts[:2] == ["die", "groups"]:
                parts[-2] = "*"
            general = ".".join(parts)
            found.setdefault(general, _declared(general)[1])
    return found


def _nearest_setting(name: str, known: Iterable[str]) -> str:
    text = nearest(name, known)
    many = "scripts/icwafer render --settings lists all of them"
    return text if text.startswith("did you") else many


# Flattening and its inverse.


def _is_branch(value: Any) -> bool:
    if isinstance(value, tuple):
        return any(dataclasses.is_dataclass(item) for item in value)
    return isinstance(value, Mapping) or _is_tree(type(value))


def _parts(thing: Any) -> Iterable[tuple[str, Any]]:
    """The branches and leaves right below: fields, keys, or items by their name or number."""
    if isinstance(thing, Mapping):
        return thing.items()
    if isinstance(thing, tuple):
        return [(getattr(item, "name", str(number)), item) for number, item in enumerate(thing, 1)]
    # What has a name stands under it; blocks one by one stay in their file.
    names = [f.name for f in dataclasses.fields(thing) if f.name not in ("name", "blocks")]
    return [(name, getattr(thing, name)) for name in names]


def _as_json(value: Any) -> Any:
    if isinstance(value, Spread):
        return float(value.mean) if value == Normal(value.mean) else _spread_json(value)
    if isinstance(value, enum.Enum):
        return value.name.lower()
    return list(value) if isinstance(value, tuple) else value


def _spread_json(spread: Spread) -> Scene:
    names = next(names for names, kind in _SPREADS.items() if type(spread) is kind)
    values = (getattr(spread, f.name) for f in dataclasses.fields(spread))
    return {
        name: [float(v) for v in value] if isinstance(value, tuple) else float(value)
        for name, value in zip(names, values)
    }


def _nested(scene: Mapping[str, Any]) -> dict[str, Any]:
    """The tree of a scene. The name of a node's input or of a group may have dots in it."""
    tree: dict[str, Any] = {}
    for setting, value in scene.items():
        part, _, rest = setting.partition(".")
        below = tree.setdefault(part, {}) if rest else tree
        if rest.startswith("groups."):
            name, _, leaf = rest.removeprefix("groups.").rpartition(".")
            below.setdefault("groups", {}).setdefault(name, {})[leaf] = value
        elif part == "lights":
            number, _, leaf = rest.partition(".")
            below.setdefault(number, {})[leaf] = value
        else:
            below[rest or part] = value
    return tree


def _build(kind: Any, value: Any) -> Any:
    """A value of some declared type from its JSON."""
    item = _item_of_branches(kind)
    if item:
        named = "name" in _hints(item)
        return tuple(
            _build(item, part | ({"name": name} if named else {})) for name, part in value.items()
        )
    if kind is Spread:
        return _spread(value)
    if _is_tree(kind):
        hints = _hints(kind)
        return kind(**{name: _build(hints[name], part) for name, part in value.items()})
    if isinstance(kind, type) and issubclass(kind, enum.Enum):
        return kind[value.upper()]
    return tuple(value) if isinstance(value, list) else value


def _spread(value: Any) -> Spread:
    """From its mean or its fields. Raises KeyError for fields that no spread has."""
    if not isinstance(value, Mapping):
        return Normal(value)
    names = next(
        (names for names in _SPREADS if {*value, "deviation"} >= {*names} >= {*value}), ()
    )
    fields = (value.get(name, 0.0) for name in names)
    return _SPREADS[names](*(tuple(f) if isinstance(f, list) else f for f in fields))


@functools.cache
def _hints(cls: type) -> dict[str, Any]:
    return typing.get_type_hints(cls)


def _item_of_branches(kind: Any) -> type | None:
    """Of a tuple of dataclasses, as many as you like: which; None for any other type."""
    arguments = typing.get_args(kind)
    if len(arguments) == 2 and arguments[1] is ... and dataclasses.is_dataclass(arguments[0]):
        return arguments[0]
    return None


# Checking values.


@functools.cache
def _declared(name: str) -> tuple[Any, Rule]:
    """Type and rule of a picture's setting. Raises SettingError where there is no such name."""
    kind, rule, rest = Picture, Rule(""), name
    while rest:
        item = _item_of_branches(kind)
        if item:
            kind, (_, _, rest) = item, rest.rpartition(".")
        part, _, rest = rest.partition(".")
        fields = {f.name: f for f in dataclasses.fields(kind)} if _is_tree(kind) else {}
        if part not in fields or part in ("caption", "name", "blocks"):
            raise SettingError(f"is no setting: {_nearest_setting(name, rules())}")
        rule = fields[part].metadata.get("rule", Rule(""))
        kind = _hints(kind)[part]
    if _is_tree(kind) or _item_of_branches(kind):
        raise SettingError("is a whole group of settings: name one of them")
    return kind, rule


def _is_tree(kind: Any) -> bool:
    return (
        isinstance(kind, type)
        and dataclasses.is_dataclass(kind)
        and not issubclass(kind, (Spread, BlockTable))
    )


def _checked(kind: Any, rule: Rule, value: Any) -> Any:
    arguments = typing.get_args(kind)
    if kind is Spread:
        return _checked_spread(rule, value)
    if typing.get_origin(kind) is tuple:
        if not isinstance(value, list) or len(value) != len(arguments):
            raise SettingError(f"is {_shown(value)}: write {len(arguments)} values in brackets")
        return [_checked(part, rule, v) for part, v in zip(arguments, value)]
    if kind is bool:
        if not isinstance(value, bool):
            raise SettingError(f"is {_shown(value)}: write true or false")
        return value
    if kind in (int, float):
        return _number(kind, rule, value)
    if isinstance(kind, type) and issubclass(kind, enum.Enum):
        return _choice(value, tuple(name.lower() for name in kind.__members__))
    return _choice(value, rule.choices()) if rule.choices else _text(value)


def _number(kind: type, rule: Rule, value: Any) -> float:
    if isinstance(value, bool) or not isinstance(value, (int, float)) or math.isnan(value):
        raise SettingError(f"is {_shown(value)}: write a number")
    if kind is int and value != int(value):
        raise SettingError(f"is {_shown(value)}: write a whole number")
    if not rule.allows(value):
        meaning = f" ({rule.help.split('. ')[0]})" if rule.help else ""
        raise SettingError(f"is {_shown(value)}: allowed are {rule.range}{meaning}")
    return kind(value)


def _checked_spread(rule: Rule, value: Any) -> Any:
    try:
        spread = _spread(value)
        numbers = [spread.low, spread.high, spread.deviation]
        if not all(isinstance(number, (int, float)) for number in numbers):
            raise TypeError
    except (KeyError, TypeError, ZeroDivisionError):
        written = " or ".join("{" + ", ".join(names) + "}" for names in _SPREADS)
        raise SettingError(f"is {_shown(value)}: write a number or {written}") from None
    for number in (spread.low, spread.high):
        _number(float, rule, number)
    return _as_json(spread)


def _choice(value: Any, names: tuple[str, ...]) -> str:
    if value not in names:
        raise SettingError(f"is {_shown(value)}: {nearest(str(value), names)}")
    return value


def _text(value: Any) -> str:
    if not isinstance(value, str):
        raise SettingError(f"is {_shown(value)}: write a text in quotation marks")
    return value


def _node_value(name: str, value: Any) -> Any:
    if name in node_inputs():
        return _number(float, node_inputs()[name], value)
    if name in _NODE_NAMES:
        return _choice(value, _NODE_NAMES[name])
    if name in _NODE_FLAGS:
        return _checked(bool, Rule(""), value)
    if name in _NODE_VECTORS:
        return _checked(tuple[float, float, float], _NODE_VECTORS[name], value)
    known = [*node_inputs(), *_NODE_VECTORS, *_NODE_NAMES, *_NODE_FLAGS]
    raise SettingError(f"is no input or property of the node: {nearest(name, known)}")


def _data_value(value: Any) -> Any:
    for item in value if isinstance(value, list) else [value]:
        if not isinstance(item, (bool, int, float, str)):
            raise SettingError(f"is {_shown(value)}: write a number, text, flag or list of them")
    return value


def _lights(value: Any) -> list[Scene]:
    """A list of lights as tables; each is completed with the defaults."""
    light_kind = _item_of_branches(_hints(Picture)["lights"])
    if not isinstance(value, list) or not all(isinstance(light, Mapping) for light in value):
        raise SettingError("is no list of tables: write one [[...lights]] for each light")
    lights = []
    for number, given in enumerate(value, 1):
        light = {}
        for field in dataclasses.fields(light_kind):
            if field.name in given:
                try:
                    light[field.name] = check(f"lights.{number}.{field.name}", given[field.name])
                except SettingError as error:
                    raise SettingError(f"number {number}: {field.name} {error}") from None
            elif field.default is dataclasses.MISSING:
                raise SettingError(f"number {number} has no {field.name}: add it")
            else:
                light[field.name] = _as_json(field.default)
        for name in given:
            if name not in light:
                raise SettingError(f"number {number}: {name} is unknown: {nearest(name, light)}")
        lights.append(light)
    return lights


def _shown(value: Any) -> str:
    """A value as the file has it, shortened."""
    text = repr(value) if not isinstance(value, bool) else str(value).lower()
    return text if len(text) <= 60 else f"{text[:57]}..."
