# SPDX-License-Identifier: GPL-2.0-or-later
"""A study becomes jobs: one image each, with all its settings and a key of all that it depends on.

Nothing else of the study enters the key, so that a new description, or one more value of an axis,
leaves the other images as they are.
"""

from __future__ import annotations

import hashlib
import itertools
import json
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from icwafer.errors import IcwaferError, SettingError
from icwafer.study import fields, image_file
from icwafer.study.document import Assignment, Axis, Step, Study, overridden
from icwafer.study.keys import Keys
from icwafer.suggest import nearest
from icwafer.toml_lines import Document

MAX_JOBS = 1_000_000
MAX_ID = 120


@dataclass(frozen=True)
class Job:
    """One image: `labels` has its value of each axis, `scene` all settings, with full paths.

    light_key: jobs that have it in common differ in how their light is shown, not in the light.
    """

    id: str
    labels: Mapping[str, Any]
    scene: fields.Scene
    key: str
    light_key: str


@dataclass(frozen=True)
class Plan:
    """All jobs of a study, in the order of its axes, the last one changing fastest."""

    study: Study
    jobs: tuple[Job, ...]
    reference: str | None

    def assignments(self) -> Iterable[Assignment]:
        """Everything that the study sets anywhere."""
        yield from self.study.scene
        for axis in self.study.axes:
            for step in axis.steps:
                yield from step.assignments


def make(study: Study, program: str, needs: Mapping[str, Sequence[str]] | None = None) -> Plan:
    """The jobs of a study.

    program: stands for the renderer in the keys, the hash of its file. needs: for files that the
    study names, the files that those need in turn (the textures of a .blend file).

    Raises IcwaferError, naming the line, where a setting does not exist in the scene that it is
    for, two axes set the same, or there are too many jobs.
    """
    _expect_one_axis_each(study)
    count = 1
    for axis in study.axes:
        count *= len(axis.steps)
    if count > MAX_JOBS:
        raise study.scene[0].error(f"and the axes make {count} jobs: allowed are {MAX_JOBS}")
    keys, scene_of = Keys(program, needs or {}), _SceneMaker(study)
    jobs = []
    taken: set[str] = set()
    dies: set[str] = set()  # those that are known to make sense
    die = ""
    for steps in itertools.product(*(axis.steps for axis in study.axes)):
        labels = {axis.name: step.label for axis, step in zip(study.axes, steps)}
        scene = scene_of(steps)
        identity = _identity(labels, taken)
        taken.add(identity)
        if not (die and scene_of.has_one_die):
            die = keys.die(scene)
        if die not in dies:
            _check_die(study, identity, scene)
            dies.add(die)
        jobs.append(Job(identity, labels, scene, *keys.of(scene, die)))
    return Plan(study, tuple(jobs), _reference(study, jobs))


class _SceneMaker:
    """Makes the scene of a combination of steps; what the study has in common is made once."""

    def __init__(self, study: Study) -> None:
        self._common = study.scene
        self._swept = {a.setting for axis in study.axes for s in axis.steps for a in s.assignments}
        self._fixed: fields.Scene | None = None
        if not self._swept & {fields.PICTURE, fields.BLEND, fields.LAYOUT, "lights"}:
            self._fixed = _scene(self._common)
        #: Whether all scenes have the same die.
        self.has_one_die = self._fixed is not None and not any(
            setting.startswith("die.") for setting in self._swept
        )

    def __call__(self, steps: Iterable[Step]) -> fields.Scene:
        own = tuple(a for step in steps for a in step.assignments)
        if self._fixed is None:
            return _scene((*self._common, *own))
        scene = dict(self._fixed)
        _apply(scene, own)
        return scene


def _scene(assignments: tuple[Assignment, ...]) -> fields.Scene:
    """First where the scene comes from, then its layout and list of lights, then single ones."""
    scene: fields.Scene = {}
    for a in assignments:
        if a.setting == fields.PICTURE:
            scene = dict(fields.picture_settings(a.value))
        elif a.setting == fields.BLEND:
            scene = {fields.BLEND: a.value}
    whole = tuple(a for a in assignments if a.setting in (fields.LAYOUT, "lights"))
    sources = (fields.PICTURE, fields.BLEND, fields.LAYOUT, "lights")
    _apply(scene, whole)
    _apply(scene, tuple(a for a in assignments if a.setting not in sources))
    return scene


def _check_die(study: Study, job: str, scene: fields.Scene) -> None:
    if fields.BLEND in scene:
        return
    try:
        fields.check_die_of(scene)
    except IcwaferError as error:
        raise IcwaferError(f"{study.document.path}: job {job}: {error}") from None


def _apply(scene: fields.Scene, assignments: tuple[Assignment, ...]) -> None:
    for assignment in assignments:
        try:
            fields.override(scene, assignment.setting, assignment.value)
        except SettingError as error:
            raise assignment.error(str(error)) from None


def of_image(image: Path, settings: Sequence[str], program: str) -> Plan:
    """The plan with the one job that an EXR file was made by, as its metadata tells.

    settings: `SETTING=VALUE` words to replace some. Raises IcwaferError where the file has no such
    metadata, or settings in it that are not allowed.
    """
    noted = image_file.attributes(image)
    try:
        labels, given = json.loads(noted["settings"]), json.loads(noted["scene"])
        scene = {name: fields.check(name, value) for name, value in given.items()}
    except KeyError:
        raise IcwaferError(f"{image}: has no settings in it; name an EXR of a study") from None
    except (SettingError, ValueError, AttributeError) as error:
        raise IcwaferError(f"{image}: its settings make no sense: {error}") from None
    axes = tuple(Axis(name, "", (Step(label, ()),)) for name, label in labels.items())
    study = Study(noted["study"], "", (), axes, None, Document(image, {}, {}))
    study = overridden(study, list(settings))
    _apply(scene, study.scene)
    _check_die(study, noted["job"], scene)
    identity = "_".join(map(_slug, noted["job"].split("_")))[:MAX_ID]
    job = Job(identity, labels, scene, *Keys(program, {}).of(scene))
    return Plan(study, (job,), None)


def _expect_one_axis_each(study: Study) -> None:
    owner: dict[str, str] = {}
    for axis in study.axes:
        for step in axis.steps:
            for a in step.assignments:
                if owner.setdefault(a.setting, axis.name) != axis.name:
                    raise a.error(
                        f"is set by two axes, {owner[a.setting]!r} and {axis.name!r}: "
                        "take it out of one of them"
                    )


def _reference(study: Study, jobs: list[Job]) -> str | None:
    """The job with the labels of the reference; an axis that it does not name has its first."""
    if study.reference is None:
        return None
    document = study.document
    wanted: dict[str, Any] = {axis.name: axis.steps[0].label for axis in study.axes}
    for name, label in study.reference.items():
        if name not in wanted:
            raise document.error(("reference", name), f"is no axis: {nearest(name, wanted)}")
        wanted[name] = label
        known = [step.label for axis in study.axes if axis.name == name for step in axis.steps]
        if label not in known:
            names = [str(k) for k in known]
            raise document.error(
                ("reference", name), f"is {label!r}: {nearest(str(label), names)}"
            )
    return next(job.id for job in jobs if job.labels == wanted)


def _identity(labels: Mapping[str, Any], taken: set[str]) -> str:
    """A name for a folder that says which job it is; the same labels give the same name."""
    parts = [f"{_slug(name)}-{_slug(_number(label))}" for name, label in labels.items()]
    identity = "_".join(parts) or "image"
    if len(identity) > MAX_ID or identity in taken:
        digest = hashlib.sha256(json.dumps(labels).encode()).hexdigest()[:10]
        identity = f"{identity[:MAX_ID - 11]}-{digest}"
    return identity


def _number(label: Any) -> str:
    return f"{label:.12g}" if isinstance(label, float) else str(label)


@cache
def _slug(text: str) -> str:
    """Lower case letters, digits, points and hyphens: a name that any file system takes."""
    plain = text.lower()
    if _is_number(plain):  # a minus would look like a hyphen
        plain = plain.replace("-", "m")
    return re.sub(r"[^a-z0-9.]+", "-", plain).strip("-.") or "x"


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True
