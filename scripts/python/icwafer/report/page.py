# SPDX-License-Identifier: GPL-2.0-or-later
"""Puts a study and what was measured of it into one HTML file (parts in `page/`)."""

from __future__ import annotations

import html
import json
import os
import re
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import OpenImageIO as oiio

from icwafer.compare.colour import ViewTransform
from icwafer.errors import IcwaferError
from icwafer.files import replacing
from icwafer.report import encode, measure, tables
from icwafer.report.contact_sheet import contact_sheet
from icwafer.report.measure import MEASURES, Measured, Options
from icwafer.report.study import Job, Study

_PARTS = Path(__file__).with_name("page")
#: In this order: each may use what those before it define.
_SCRIPTS = ("decode", "colours", "viewer", "contact", "plots", "table", "photo", "main")
# What things take in the page, compressed and in base64: a pixel of a noisy render's half floats
# and two maps, a pixel of a thumbnail, and a job's settings, measures and orders.
_PIXEL_BYTES, _THUMBNAIL_BYTES, _JOB_BYTES = 8.0, 0.4, 4000.0
#: Of a thumbnail: smaller ones show nothing.
_SMALLEST_PX = 48
#: The part of a page's size that thumbnails may take.
_THUMBNAILS = 0.2


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
    scale, thumbnail_px = _sizes(finished, largest_mb)
    options = Options(config, view, look, ppd, scale, thumbnail_px, hdr, layer)
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


def _sizes(jobs: Sequence[Job], largest_mb: float) -> tuple[float, int]:
    """Scale of the embedded pictures, at most 1, and sides of the thumbnails, so that all fit."""
    room = largest_mb * 1e6
    thumbnail = (_THUMBNAILS * room / len(jobs) / _THUMBNAIL_BYTES) ** 0.5
    room = max(room * (1 - _THUMBNAILS) - _JOB_BYTES * len(jobs), 0.2 * room)
    pixels = 0
    for job in jobs:
        file = oiio.ImageInput.open(str(job.image))
        if file is not None:
            pixels += file.spec().width * file.spec().height
            file.close()
    scale = (room / max(1.0, pixels * _PIXEL_BYTES)) ** 0.5
    return min(1.0, scale), max(_SMALLEST_PX, min(encode.THUMBNAIL_PX, round(thumbnail)))


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
        data |= {
            "width": found.size[0],
            "height": found.size[1],
            "original": found.original_size,
            "thumbnail": found.thumbnail,
            "view": found.view,
            "measures": found.values,
            "maps": [name for name in ("flip", "hdr_flip") if getattr(found, name)],
            "orders": bool(found.curves),
        }
    return data


def _curves(found: Measured) -> str:
    """The orders' curves as packed JSON, in embedded pixels."""
    shrunk = found.size[0] / found.original_size[0]
    curves = [
        {
            "order": curve.order,
            "nm": curve.wavelength_nm,
            "segments": (curve.segments * shrunk).round(1).ravel().tolist(),
        }
        for curve in found.curves
    ]
    return encode.pack(json.dumps(curves).encode())


def _blobs(measured: dict[str, Measured], views: dict[str, ViewTransform]) -> dict[str, str]:
    """The long texts by name: each job's pixels, maps and orders, each view transform's table."""
    blobs = {
        f"{kind}:{job}": getattr(found, kind)
        for job, found in measured.items()
        for kind in ("pixels", "flip", "hdr_flip")
        if getattr(found, kind)
    }
    blobs |= {f"curves:{job}": _curves(found) for job, found in measured.items() if found.curves}
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
