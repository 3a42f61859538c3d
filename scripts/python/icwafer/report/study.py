# SPDX-License-Identifier: GPL-2.0-or-later
"""Reads the folder of a rendered study.

    DIR/study.json           name, description, axes (name, unit, values), jobs (their ids),
                             reference, versions, command
    DIR/jobs/ID/job.json     id, settings, command, seconds, samples, seed, view_transform, look,
                             status, error, grating
    DIR/jobs/ID/image.exr    scene-linear; image.png, as a screen shows it; log.txt

Everything but the name of the study may be missing; without `jobs` all folders count. `grating` is
one object or a list of them and asks for the orders to be drawn over the picture: `camera`
(position_mm, target_mm, lens_mm, roll_deg), `light` (position_mm), `plane` (point, normal, x_axis),
`spacing_nm`, `direction_rad`.
"""

from __future__ import annotations

import json
import shlex
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from icwafer.compare.overlay import Plane
from icwafer.errors import IcwaferError
from icwafer.pictures import Camera, Vector


@dataclass(frozen=True)
class Axis:
    """A setting that the study sweeps; unit is "" for numbers without one and for names."""

    name: str
    unit: str
    values: tuple[Any, ...]


@dataclass(frozen=True)
class Grating:
    """What the orders' places in a picture follow from."""

    camera: Camera
    light: Vector
    plane: Plane
    spacing_nm: float
    direction_rad: float


@dataclass(frozen=True)
class Job:
    """One render. image: the EXR, else the PNG, else None. error: "" if it was rendered."""

    id: str
    settings: dict[str, Any]
    command: str = ""
    seconds: float | None = None
    samples: int | None = None
    seed: int | None = None
    view: str | None = None
    look: str | None = None
    image: Path | None = None
    error: str = ""
    gratings: tuple[Grating, ...] = ()


@dataclass(frozen=True)
class Study:
    """A study and its jobs, in the order of the axes' values. reference: the id of a job."""

    name: str
    description: str
    axes: tuple[Axis, ...]
    reference: str | None
    command: str
    versions: dict[str, str]
    jobs: tuple[Job, ...] = field(default=())


def load(folder: Path) -> Study:
    """Reads a study; a job that cannot be read counts as failed and says why.

    Raises IcwaferError without a usable study.json, and without a single job.
    """
    path = folder / "study.json"
    if not path.is_file():
        raise IcwaferError(f"{path}: no such file; name the folder that icwafer render wrote")
    given = _object(path)
    try:
        axes = tuple(
            Axis(str(axis["name"]), str(axis.get("unit") or ""), tuple(axis["values"]))
            for axis in given.get("axes", [])
        )
        name = str(given["name"])
    except (KeyError, TypeError, AttributeError) as error:
        raise IcwaferError(f"{path}: without a good {error}; render the study anew") from None
    found = (entry for entry in (folder / "jobs").glob("[!.]*") if entry.is_dir())
    ids = given.get("jobs") or sorted(entry.name for entry in found)
    jobs = tuple(
        sorted((_job(folder / "jobs" / id) for id in ids), key=lambda job: _order(axes, job))
    )
    if not jobs:
        raise IcwaferError(f"{folder / 'jobs'}: no jobs; render the study first")
    reference = given.get("reference")
    if reference is not None and reference not in {job.id for job in jobs}:
        raise IcwaferError(f"{path}: reference '{reference}' is none of the jobs; correct it")
    return Study(
        name=name,
        description=str(given.get("description") or ""),
        axes=axes,
        reference=reference,
        command=_command(given.get("command")),
        versions={key: str(value) for key, value in (given.get("versions") or {}).items()},
        jobs=jobs,
    )


def _object(path: Path) -> dict[str, Any]:
    try:
        given = json.loads(path.read_text(encoding="utf-8"))
    except json.JSONDecodeError as error:
        raise IcwaferError(
            f"{path}:{error.lineno}:{error.colno}: {error.msg}; render the study anew"
        ) from None
    except UnicodeDecodeError:
        raise IcwaferError(f"{path}: not a text in UTF-8; render the study anew") from None
    if not isinstance(given, dict):
        raise IcwaferError(f"{path}: not a JSON object; render the study anew")
    return given


def _job(folder: Path) -> Job:
    path = folder / "job.json"
    if not path.is_file():
        return Job(folder.name, {}, error="not rendered yet: no job.json")
    try:
        given = _object(path)
        settings = dict(given.get("settings") or {})
        gratings = given.get("grating") or []
        gratings = tuple(map(_grating, gratings if isinstance(gratings, list) else [gratings]))
    except IcwaferError as error:
        return Job(folder.name, {}, error=str(error))
    except (KeyError, TypeError, ValueError) as error:
        return Job(folder.name, {}, error=f"{path}: bad settings or grating ({error})")
    images = [folder / name for name in ("image.exr", "image.png")]
    image = next((image for image in images if image.is_file()), None)
    error = str(given.get("error") or "")
    if given.get("status", "done") == "failed":
        error, image = error or "failed; see its log.txt", None
    elif image is None:
        error = error or "no image.exr and no image.png"
    return Job(
        id=str(given.get("id") or folder.name),
        settings=settings,
        command=_command(given.get("command")),
        seconds=given.get("seconds"),
        samples=given.get("samples"),
        seed=given.get("seed"),
        view=given.get("view_transform"),
        look=given.get("look"),
        image=image,
        error=error,
        gratings=gratings,
    )


def _grating(given: dict[str, Any]) -> Grating:
    camera = given["camera"]
    return Grating(
        camera=Camera(
            _vector(camera["position_mm"]),
            _vector(camera["target_mm"]),
            float(camera.get("lens_mm", 50.0)),
            float(camera.get("roll_deg", 0.0)),
        ),
        light=_vector(given["light"]["position_mm"]),
        plane=Plane(**{key: _vector(value) for key, value in given.get("plane", {}).items()}),
        spacing_nm=float(given["spacing_nm"]),
        direction_rad=float(given.get("direction_rad", 0.0)),
    )


def _vector(given: list[float]) -> Vector:
    x, y, z = map(float, given)
    return x, y, z


def _command(given: list[str] | str | None) -> str:
    return shlex.join(map(str, given)) if isinstance(given, list) else given or ""


def _order(axes: tuple[Axis, ...], job: Job) -> tuple[Any, ...]:
    places = [
        axis.values.index(value) if (value := job.settings.get(axis.name)) in axis.values else -1
        for axis in axes
    ]
    return (*places, job.id)
