# SPDX-License-Identifier: GPL-2.0-or-later
"""Study files: TOML that says what is rendered and which settings are swept.

    version = 1
    name = "Wire spacing under two lamps"
    description = "What the report says at its top."
    base = "common.toml"            # optional: another study, whose scene and axes this one takes
    reference = { spacing = 1000 }  # optional: the image that the others are compared with

    [scene]                         # what all images have in common
    picture = "full"                # one of the project's pictures, or blend = "scene.blend"
    camera.lens_mm = 80
    [scene.node]
    "Lobe Width" = 0.03

    [[axis]]                        # a sweep; several axes make the matrix of all combinations
    name = "spacing"
    unit = "nm"
    set = "node.Wire Spacing"       # or a list of settings; then each value is a list, too
    values = [800, 1000, 1200]      # or: from = 800, to = 1200, count = 3, scale = "log"

    [[axis]]                        # a list: each case sets what it likes
    name = "lamp"
    [[axis.case]]
    name = "small"                  # or a number
    scene.lights.1.radius_mm = 0.1
    [[axis.case]]
    name = "large"
    scene.lights.1.radius_mm = 5

Names of settings are those of `icwafer.study.fields`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from icwafer import toml_lines
from icwafer.chips.presets import PRESETS
from icwafer.errors import IcwaferError, SettingError
from icwafer.study import fields
from icwafer.suggest import nearest
from icwafer.toml_lines import Document, FieldPath

VERSION = 1
_KEYS = ("version", "name", "description", "base", "reference", "scene", "axis")
_AXIS_KEYS = ("name", "unit", "set", "values", "from", "to", "count", "scale", "case")
MAX_VALUES = 100_000


@dataclass(frozen=True)
class Assignment:
    """A setting and its checked value; `document` and `place` are where a message points to."""

    setting: str
    value: Any
    document: Document
    place: FieldPath

    def error(self, message: str) -> IcwaferError:
        """The error that this setting is wrong, for the reader of the file."""
        line = self.document.line(self.place)
        return IcwaferError(f"{self.document.path}:{line}: {self.setting} {message}")


@dataclass(frozen=True)
class Step:
    """One value of an axis: a number or name, and what it sets."""

    label: Any
    assignments: tuple[Assignment, ...]


@dataclass(frozen=True)
class Axis:
    """One sweep."""

    name: str
    unit: str
    steps: tuple[Step, ...]


@dataclass(frozen=True)
class Study:
    """What a study file says. `reference`: a label for some axes; the others have their first."""

    name: str
    description: str
    scene: tuple[Assignment, ...]
    axes: tuple[Axis, ...]
    reference: Mapping[str, Any] | None
    document: Document


def read(path: Path) -> Study:
    """Reads a study and those that it is based on.

    Raises IcwaferError with file, line, name and what is allowed for anything that is wrong.
    """
    return _read(path, ())


def overridden(study: Study, words: list[str]) -> Study:
    """The study with some settings replaced in all its jobs, each word `SETTING=VALUE` as in TOML.

    Axes that sweep such a setting keep their own values.
    """
    extra: list[Assignment] = []
    for word in words:
        setting, equals, text = word.partition("=")
        if not equals:
            raise IcwaferError(f"--set {word}: write SETTING=VALUE")
        document = Document(Path(f"--set {word}"), {}, {})
        extra.append(_assignment(document, (), setting.strip(), _parsed(text.strip()), Path()))
    return replace(study, scene=_merged(study.scene, tuple(extra)))


def _parsed(text: str) -> Any:
    """A value as TOML writes it; anything else is a text."""
    try:
        return toml_lines.tomllib.loads(f"x = {text}")["x"]
    except toml_lines.tomllib.TOMLDecodeError:
        return text


def _read(path: Path, below: tuple[Path, ...]) -> Study:
    document = toml_lines.read(path)
    _expect_keys(document, (), document.data, _KEYS)
    version = document.data.get("version")
    if version != VERSION:
        raise document.error(("version",), f"is {version}: this icwafer reads version {VERSION}")
    base = _base(document, (*below, path.resolve()))
    scene = tuple(_assignments(document, ("scene",), _table(document, (), "scene")))
    if not base and not any(a.setting in (fields.PICTURE, fields.BLEND) for a in scene):
        raise document.error(
            ("scene",), 'says not what to render: add picture = "full" or blend = "FILE.blend"'
        )
    return Study(
        name=_text(document, (), "name", path.stem),
        description=_text(document, (), "description", base.description if base else ""),
        scene=_merged(base.scene if base else (), scene),
        axes=_axes(document, base.axes if base else ()),
        reference=document.data.get("reference", base.reference if base else None),
        document=document,
    )


def _base(document: Document, below: tuple[Path, ...]) -> Study | None:
    name = _text(document, (), "base", "")
    if not name:
        return None
    path = document.path.parent / name
    if path.resolve() in below:
        chain = [*(p.name for p in below[below.index(path.resolve()) :]), path.name]
        raise document.error(("base",), f"goes round in a circle: {' -> '.join(chain)}")
    if not path.is_file():
        raise document.error(("base",), f"is {name!r}: there is no such file")
    return _read(path, below)


def _merged(
    first: tuple[Assignment, ...], second: tuple[Assignment, ...]
) -> tuple[Assignment, ...]:
    """Both, the second in place of the first where they set the same; where a scene comes from
    (a picture or a file) is one thing."""
    sources = (fields.PICTURE, fields.BLEND)
    replaced = {a.setting for a in second}
    if replaced & set(sources):
        replaced |= set(sources)
    return (*(a for a in first if a.setting not in replaced), *second)


def _axes(document: Document, inherited: tuple[Axis, ...]) -> tuple[Axis, ...]:
    given = document.data.get("axis", [])
    if not isinstance(given, list):
        raise document.error(("axis",), "is one table: write [[axis]], in double brackets")
    axes = {axis.name: axis for axis in inherited}
    named: set[str] = set()
    for number, table in enumerate(given):
        place: FieldPath = ("axis", number)
        _expect_keys(document, place, table, _AXIS_KEYS)
        name = _text(document, place, "name")
        if name in named:
            raise document.error((*place, "name"), f"is {name!r} a second time: name it otherwise")
        named.add(name)
        steps = _cases(document, place) if "case" in table else _values(document, place)
        axes[name] = Axis(name, _text(document, place, "unit", ""), steps)
    return tuple(axes.values())


def _cases(document: Document, place: FieldPath) -> tuple[Step, ...]:
    table = _at(document, place)
    for key in table:
        if key not in ("name", "unit", "case"):
            raise document.error((*place, key), "does not go with case: leave one of them out")
    steps: list[Step] = []
    for number, case in enumerate(table["case"]):
        here: FieldPath = (*place, "case", number)
        _expect_keys(document, here, case, ("name", "scene"))
        label = case.get("name")
        if isinstance(label, bool) or not isinstance(label, (int, float, str)) or label == "":
            raise document.error(here, "has no name: give it a text or a number")
        if label in (step.label for step in steps):
            raise document.error((*here, "name"), f"is {label!r} a second time")
        scene = _table(document, here, "scene")
        steps.append(Step(label, tuple(_assignments(document, (*here, "scene"), scene))))
    return _some(document, (*place, "case"), steps)


def _values(document: Document, place: FieldPath) -> tuple[Step, ...]:
    table = _at(document, place)
    if "set" not in table:
        raise document.error(place, "has neither set nor case: say which setting it sweeps")
    together = isinstance(table["set"], list)
    settings = table["set"] if together else [table["set"]]
    if not all(isinstance(setting, str) for setting in settings) or not settings:
        raise document.error((*place, "set"), "is no name of a setting, nor a list of them")
    values = table["values"] if "values" in table else _range(document, place)
    if not isinstance(values, list):
        raise document.error((*place, "values"), "is no list: write the values in brackets")
    steps: list[Step] = []
    labels: set[str] = set()
    for number, value in enumerate(values):
        here: FieldPath = (*place, "values", number)
        parts = value if together else [value]
        if not isinstance(parts, list) or len(parts) != len(settings):
            raise document.error(here, f"has not {len(settings)} values, one for each setting")
        folder = document.path.parent
        step = Step(
            parts[0] if isinstance(parts[0], (int, float, str)) else _name_of(value),
            tuple(_assignment(document, here, s, v, folder) for s, v in zip(settings, parts)),
        )
        if str(step.label) in labels:
            raise document.error(here, f"is {step.label} a second time")
        labels.add(str(step.label))
        steps.append(step)
    return _some(document, (*place, "values"), steps)


def _name_of(value: Any) -> str:
    """Of a value that is neither number nor text: `[0, 0, 5]` is "0 0 5"."""
    if isinstance(value, list):
        return " ".join(_name_of(item) for item in value)
    if isinstance(value, Mapping):
        return " ".join(f"{key} {_name_of(item)}" for key, item in value.items())
    return f"{value:g}" if isinstance(value, float) else str(value)


def _range(document: Document, place: FieldPath) -> list[float]:
    table = _at(document, place)
    for key in ("from", "to", "count"):
        if not isinstance(table.get(key), (int, float)):
            raise document.error(place, f"has neither values nor a number as {key}: add one")
    first, last, count = table["from"], table["to"], table["count"]
    if not isinstance(count, int) or not 2 <= count <= MAX_VALUES:
        raise document.error((*place, "count"), f"is {count}: allowed are 2 to {MAX_VALUES}")
    scale = _text(document, place, "scale", "linear")
    if scale not in ("linear", "log"):
        raise document.error(
            (*place, "scale"), f"is {scale!r}: {nearest(scale, ('linear', 'log'))}"
        )
    if scale == "log":
        if min(first, last) <= 0:
            raise document.error(place, "has an end at or below 0: a log scale has none")
        values = [first * (last / first) ** (i / (count - 1)) for i in range(count)]
    else:
        values = [first + (last - first) * i / (count - 1) for i in range(count)]
    # Twelve digits: what a person would write, instead of 0.30000000000000004.
    return [_round(value) for value in values]


def _round(value: float) -> float:
    rounded = float(f"{value:.12g}")
    return int(rounded) if rounded == int(rounded) and math.isfinite(rounded) else rounded


def _some(document: Document, place: FieldPath, steps: list[Step]) -> tuple[Step, ...]:
    if not steps:
        raise document.error(place, "is empty: give one value at least")
    return tuple(steps)


def _assignments(document: Document, place: FieldPath, table: Any) -> Iterator[Assignment]:
    """The settings of a table of a scene, nested as one likes; names inside `node` and `data`
    are taken as they stand."""
    for setting, value, here in _leaves(table, place, ""):
        yield _assignment(document, here, setting, value, document.path.parent)


def _leaves(table: Any, place: FieldPath, prefix: str) -> Iterator[tuple[str, Any, FieldPath]]:
    for key, value in table.items():
        setting, here = f"{prefix}{key}", (*place, key)
        if isinstance(value, Mapping) and not fields.is_leaf(setting):
            yield from _leaves(value, here, f"{setting}.")
        else:
            yield setting, value, here


def _assignment(
    document: Document, place: FieldPath, setting: str, value: Any, folder: Path
) -> Assignment:
    try:
        checked = fields.check(setting, value)
    except SettingError as error:
        raise Assignment(setting, value, document, place).error(str(error)) from None
    assignment = Assignment(setting, checked, document, place)
    if (
        setting in fields.FILES
        and checked
        and not (setting == fields.LAYOUT and checked in PRESETS)
    ):
        path = (folder / checked).resolve()
        if not path.is_file():
            ready = f", and {nearest(checked, PRESETS)}" if setting == fields.LAYOUT else ""
            raise assignment.error(f"is {checked!r}: there is no file {path}{ready}")
        assignment = replace(assignment, value=str(path))
    return assignment


def _expect_keys(document: Document, place: FieldPath, table: Any, known: tuple[str, ...]) -> None:
    if not isinstance(table, Mapping):
        raise document.error(place, "is no table")
    for key in table:
        if key not in known:
            raise document.error((*place, key), f"is unknown: {nearest(key, known)}")


def _at(document: Document, place: FieldPath) -> Any:
    value: Any = document.data
    for part in place:
        value = value[part]
    return value


def _table(document: Document, place: FieldPath, key: str) -> Mapping[str, Any]:
    table = _at(document, place).get(key, {})
    if not isinstance(table, Mapping):
        raise document.error((*place, key), "is no table of settings")
    return table


def _text(document: Document, place: FieldPath, key: str, default: str | None = None) -> str:
    value = _at(document, place).get(key, default)
    if value is None:
        raise document.error(place, f"has no {key}: add it")
    if not isinstance(value, str) or (not value and default is None):
        raise document.error((*place, key), f"is {value!r}: write a text in quotation marks")
    return value
