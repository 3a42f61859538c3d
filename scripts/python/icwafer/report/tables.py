# SPDX-License-Identifier: GPL-2.0-or-later
"""The study's numbers for other programs: a CSV and a JSON beside the page."""

from __future__ import annotations

import csv
import io
import json

from icwafer.report.measure import MEASURES, Measured
from icwafer.report.study import Study


def to_csv(study: Study, measured: dict[str, Measured]) -> str:
    """One line a job: id, status, all settings, seconds, samples, seed, all measures, command."""
    settings = list(dict.fromkeys(name for job in study.jobs for name in job.settings))
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(
        ["id", "status", *settings, "seconds", "samples", "seed", *MEASURES, "error", "command"]
    )
    for job in study.jobs:
        values = measured[job.id].values if job.id in measured else {}
        writer.writerow(
            [
                job.id,
                "failed" if job.error else "done",
                *(job.settings.get(name, "") for name in settings),
                *("" if x is None else x for x in (job.seconds, job.samples, job.seed)),
                *(format(values[name], ".8g") if name in values else "" for name in MEASURES),
                job.error,
                job.command,
            ]
        )
    return text.getvalue()


def to_json(study: Study, measured: dict[str, Measured], reference: str | None) -> str:
    """The same, with the study's own facts."""
    return json.dumps(
        {
            "name": study.name,
            "description": study.description,
            "axes": [vars(axis) for axis in study.axes],
            "reference": reference,
            "command": study.command,
            "versions": study.versions,
            "measures": MEASURES,
            "jobs": [
                {
                    "id": job.id,
                    "status": "failed" if job.error else "done",
                    "error": job.error,
                    "settings": job.settings,
                    "command": job.command,
                    "seconds": job.seconds,
                    "samples": job.samples,
                    "seed": job.seed,
                    "view_transform": measured[job.id].view if job.id in measured else None,
                    "measures": measured[job.id].values if job.id in measured else {},
                }
                for job in study.jobs
            ],
        },
        indent=1,
    )
