# SPDX-License-Identifier: GPL-2.0-or-later
"""Puts a study and what was measured of it into one HTML file (parts in `page/`)."""

from __future__ import annotations

import html
import json
import os
import re
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path
from typing import Any

import OpenImageIO as oiio

from icwafer.compare.colour import ViewTransform
from icwafer.compare.overlay import Curve
from icwafer.errors import IcwaferError
from icwafer.files import replacing
from icwafer.report import encode, measure, tables
from icwafer.report.contact_sheet import contact_sheet
from icwafer.report.measure import MEASURES, Measured, Options
from icwafer.report.study import Job, Study

_PARTS = Path(__file__).with_name("page")
#: In this order: each may use what those before it define.
_SCRIPTS = ("decode", "colours", "viewer", "contact", "plots", "table", "photo", "main")
# What a pixel takes in the page: a noisy render's half floats, and two maps, compressed, base64.
_BYTES_PER_PIXEL = 8.0


def write(
    study: Study,
    output: Path,
    *,
    config: Path | None = None,
    view: str | None = None,
    look: str | None = None,
    ppd: float,
    hdr: bool = True,
    layer: str | None = None,
    figure: str = "",
    largest_mb: float = 64.0,
    processes: int | None = None,
) -> list[Path]:
    """Writes the page, and beside it a CSV, a JSON and, where axes were swept, contact sheets.

    view, look: for jobs that name none. ppd: pixels per degree, for FLIP. figure: SVG for a
    section of its own. largest_mb: of the page, roughly; the embedded pixels are made as small as
    that needs, the measures are of the originals.

    Raises IcwaferError when no job has a picture; files appear complete or not at all.
    """
    finished = [job for job in study.jobs if job.image]
    if not finished:
        raise IcwaferError(
            f"{study.name}: no job has a picture ({study.jobs[0].error}); render it first"
        )
    reference = next((job for job in finished if job.id == study.reference), None)
    if reference is None and study.reference is None and len(finished) > 1:
        reference = finished[0]
    scale = _scale(finished, largest_mb)
    options = Options(config, view, look, ppd, scale, hdr, layer)
    measured, unusable = measure.measure(
        study, reference, options, processes or os.cpu_count() or 1
    )
    if not measured:
        raise IcwaferError(f"{study.name}: {next(iter(unusable.values()))}")
    study = replace(study, jobs=tuple(_with_error(job, unusable) for job in study.jobs))
    views = {
        measured[job.id].view: measure.view_of(job, options, measured[job.id].linear)
        for job in finished
        if job.id in measured
    }
    data = _page_data(study, measured, reference, scale, ppd)
    blobs = _blobs(measured, views)
    reference_id = reference.id if reference else None
    products = {
        output: _html(study, data, blobs, views, figure),
        output.with_suffix(".csv"): tables.to_csv(study, measured),
        output.with_suffix(".json"): tables.to_json(study, measured, reference_id),
    }
    output.parent.mkdir(parents=True, exist_ok=True)
    for path, text in products.items():
        with replacing(path) as unfinished:
            unfinished.write_text(text, encoding="utf-8")
    written = list(products)
    sheets = contact_sheet(study, measured, views, options)
    for index, sheet in enumerate(sheets):
        suffix = f"-{index + 1}" if len(sheets) > 1 else ""
        path = output.with_name(f"{output.stem}-sheet{suffix}.png")
        with replacing(path) as unfinished:
            if not sheet.write(str(unfinished)):
                raise IcwaferError(f"{path}: cannot be written ({sheet.geterror()}); mend this")
        written.append(path)
    return written


def _with_error(job: Job, errors: dict[str, str]) -> Job:
    return replace(job, error=errors[job.id], image=None) if job.id in errors else job


def _scale(jobs: Iterable[Job], largest_mb: float) -> float:
    """At most 1, so that all pictures together fit."""
    pixels = 0
    for job in jobs:
        file = oiio.ImageInput.open(str(job.image))
        if file is not None:
            pixels += file.spec().width * file.spec().height
            file.close()
    return min(1.0, (largest_mb * 1e6 / max(1.0, pixels * _BYTES_PER_PIXEL)) ** 0.5)


def _page_data(
    study: Study,
    measured: dict[str, Measured],
    reference: Job | None,
    scale: float,
    ppd: float,
) -> dict[str, Any]:
    return {
        "name": study.name,
        "axes": [vars(axis) for axis in study.axes],
        "reference": reference.id if reference else None,
        "measures": {
            key: text for key, text in MEASURES.items()
            if any(key in found.values for found in measured.values())
        },
        "scale": scale,
        "pixelsPerDegree": ppd,
        "cubePoints": encode.CUBE_POINTS,
        "curvePoints": encode.CURVE_POINTS,
        "tableStops": encode.TABLE_STOPS,
        "jobs": [_job_data(job, measured.get(job.id)) for job in study.jobs],
    }  # fmt: skip


def _job_data(job: Job, found: Measured | None) -> dict[str, Any]:
    data = {
        "id": job.id,
        "settings": job.settings,
        "command": job.command,
        "seconds": job.seconds,
        "samples": job.samples,
        "seed": job.seed,
        "error": job.error,
    }
    if found:
        shrunk = found.size[0] / found.original_size[0]
        data |= {
            "width": found.size[0],
            "height": found.size[1],
            "original": found.original_size,
            "thumbnail": found.thumbnail,
            "view": found.view,
            "measures": found.values,
            "maps": [name for name in ("flip", "hdr_flip") if getattr(found, name)],
            "curves": [_curve_data(curve, shrunk) for curve in found.curves],
        }
    return data


def _curve_data(curve: Curve, scale: float) -> dict[str, Any]:
    return {
        "order": curve.order,
        "nm": curve.wavelength_nm,
        "segments": (curve.segments * scale).round(1).ravel().tolist(),
    }


def _blobs(measured: dict[str, Measured], views: dict[str, ViewTransform]) -> dict[str, str]:
    """The long texts by name: pixels and maps of each job, the table of each view transform."""
    blobs = {
        f"{kind}:{job}": getattr(found, kind)
        for job, found in measured.items()
        for kind in ("pixels", "flip", "hdr_flip")
        if getattr(found, kind)
    }
    return blobs | {f"view:{name}": encode.view_table(view) for name, view in views.items()}


def _html(
    study: Study,
    data: dict[str, Any],
    blobs: dict[str, str],
    views: dict[str, ViewTransform],
    figure: str,
) -> str:
    sources = sorted({view.source for view in views.values()})
    facts = [*study.versions.items(), ("OpenColorIO configuration", ", ".join(sources))]
    if study.command:
        facts.append(("rendered by", study.command))
    parts = {
        "title": html.escape(study.name),
        "description": html.escape(study.description),
        "facts": "".join(
            f"<div><dt>{html.escape(name)}</dt><dd>{html.escape(value)}</dd></div>"
            for name, value in facts
        ),
        "figure": figure,
        "style": (_PARTS / "style.css").read_text(encoding="utf-8"),
        "script": "\n".join(
            (_PARTS / f"{name}.js").read_text(encoding="utf-8") for name in _SCRIPTS
        ),
        # No text of a study may end the element.
        "study": json.dumps(data, allow_nan=False).replace("<", "\\u003c"),
        "blobs": "\n".join(
            f'<script type="text/plain" data-name="{html.escape(name)}">{text}</script>'
            for name, text in blobs.items()
        ),
    }
    page = (_PARTS / "page.html").read_text(encoding="utf-8")
    return re.sub(r"\{\{(\w+)\}\}", lambda found: parts[found[1]], page)
