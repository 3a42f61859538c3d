# SPDX-License-Identifier: GPL-2.0-or-later
"""Many studies at a glance: an index page that links their reports, and one picture of all."""

from __future__ import annotations

import html
import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import OpenImageIO as oiio

from icwafer.compare import images
from icwafer.errors import IcwaferError
from icwafer.files import replacing
from icwafer.report import encode, page
from icwafer.report.contact_sheet import spread_over
from icwafer.report.measure import Options, view_of
from icwafer.report.study import Job, Study, load

_PARTS = Path(__file__).with_name("page")
_SHOWN = 6  # pictures of each study
_THUMBNAIL_PX = 200
# The picture of all studies: width, columns of studies, sizes inside.
_WIDTH, _COLUMNS, _GAP, _TITLE_PX = 1200, 2, 6, 24
_STRIP = 5
_GROUND, _INK = (0.09, 0.09, 0.09), (0.86, 0.86, 0.86)


@dataclass(frozen=True)
class Reported:
    """A study and its report."""

    study: Study
    report: Path

    @property
    def finished(self) -> list[Job]:
        return [job for job in self.study.jobs if job.image]


def studies_in(folder: Path) -> list[Path]:
    """The folders of rendered studies in a folder, by name. Raises IcwaferError for none."""
    found = sorted(path.parent for path in folder.glob("*/study.json"))
    if not found:
        raise IcwaferError(
            f"{folder}: no rendered studies in it; scripts/icwafer render --all makes them"
        )
    return found


def write(
    folder: Path, *, config: Path | None, ppd: float, hdr: bool, largest_mb: float
) -> list[Path]:
    """Writes the report of each study in a folder, index.html and studies.jpg; returns them.

    A study without a finished picture is left out. Raises IcwaferError where there is none at all.
    """
    reported = []
    for place in studies_in(folder):
        study = load(place)
        if any(job.image for job in study.jobs):
            report = place / "report.html"
            page.write(study, report, config=config, ppd=ppd, hdr=hdr, largest_mb=largest_mb)
            reported.append(Reported(study, report))
    if not reported:
        raise IcwaferError(f"{folder}: no study in it has a picture; render them first")
    options = Options(config, None, None, ppd, 1.0, _THUMBNAIL_PX, hdr)
    index, picture = folder / "index.html", folder / "studies.jpg"
    with replacing(index) as unfinished:
        unfinished.write_text(_index(reported, options, folder), encoding="utf-8")
    with replacing(picture) as unfinished:
        buffer = _picture(reported, options)
        buffer.specmod()["Compression"] = "jpeg:88"
        if not buffer.write(str(unfinished)):
            raise IcwaferError(f"{picture}: cannot be written ({buffer.geterror()}); mend this")
    return [*(each.report for each in reported), index, picture]


def _shown(job: Job, options: Options) -> np.ndarray:
    image = images.read(job.image)
    return (
        view_of(job, options, image.linear).encode(image.pixels) if image.linear else image.pixels
    )


def _index(reported: Sequence[Reported], options: Options, folder: Path) -> str:
    style = (_PARTS / "style.css").read_text(encoding="utf-8")
    entries = "\n".join(_entry(each, options, folder) for each in reported)
    return f"""<!doctype html>
<!-- SPDX-License-Identifier: GPL-2.0-or-later -->
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="dark light">
<title>Studies</title>
<link rel="icon" href="data:,">
<style>
{style}
.study {{ display: block; text-decoration: none; }}
.study h2 {{ text-decoration: underline; text-decoration-color: var(--line); margin: 0; }}
.study p {{ margin: 2px 0 8px; color: var(--quiet); max-width: 90ch; }}
.strip {{ display: grid; grid-template-columns: repeat({_SHOWN}, minmax(0, 200px)); gap: 4px; }}
.strip img {{ width: 100%; height: auto; border-radius: 3px; }}
@media (max-width: 600px) {{ .strip {{ grid-template-columns: repeat(3, 1fr); }} }}
</style>
</head>
<body>
<header><h1>Studies</h1><p id="description">{len(reported)} studies,
{sum(len(each.finished) for each in reported)} renders. Each opens its report.</p></header>
<main>
{entries}
</main>
</body>
</html>
"""


def _entry(each: Reported, options: Options, folder: Path) -> str:
    study, finished = each.study, each.finished
    failed = len(study.jobs) - len(finished)
    count = f"{len(finished)} renders" + (f", {failed} failed" if failed else "")
    swept = ", ".join(axis.name for axis in study.axes)
    pictures = "".join(
        f'<img src="{encode.thumbnail(_shown(job, options), options.thumbnail_px)}" '
        f'alt="{html.escape(job.id)}" title="{html.escape(job.id)}" loading="lazy">'
        for job in spread_over(finished, _SHOWN)
    )
    return (
        f'<section><a class="study" href="{html.escape(os.path.relpath(each.report, folder))}">'
        f"<h2>{html.escape(study.name)}</h2><p>{html.escape(study.description)} {count}"
        f'{f" over {html.escape(swept)}" if swept else ""}.</p>'
        f'<div class="strip">{pictures}</div></a></section>'
    )


def _picture(reported: Sequence[Reported], options: Options) -> oiio.ImageBuf:
    """All studies, each a title and a strip of renders, in columns."""
    column = (_WIDTH - (_COLUMNS + 1) * 2 * _GAP) // _COLUMNS
    cell = (column - (_STRIP - 1) * _GAP) // _STRIP
    tall = _TITLE_PX + cell * 9 // 16 + 2 * _GAP
    rows = -(-len(reported) // _COLUMNS)
    sheet = oiio.ImageBuf(oiio.ImageSpec(_WIDTH, rows * tall + 2 * _GAP, 3, oiio.UINT8))
    oiio.ImageBufAlgo.fill(sheet, _GROUND)
    for number, each in enumerate(reported):
        x = 2 * _GAP + number // rows * (column + 2 * _GAP)
        y = _GAP + number % rows * tall
        oiio.ImageBufAlgo.render_text(
            sheet, x, y + _TITLE_PX // 2 + 1, each.study.name, 15, "DejaVuSans", _INK,
            aligny="center",
        )  # fmt: skip
        for place, job in enumerate(spread_over(each.finished, _STRIP)):
            shown = images.to_buffer(_cropped(_shown(job, options)))
            roi = oiio.ROI(0, cell, 0, cell * 9 // 16)
            small = oiio.ImageBufAlgo.clamp(oiio.ImageBufAlgo.resize(shown, roi=roi), 0.0, 1.0)
            left = x + place * (cell + _GAP)
            oiio.ImageBufAlgo.paste(sheet, left, y + _TITLE_PX, 0, 0, small)
    return sheet


def _cropped(shown: np.ndarray) -> np.ndarray:
    """The middle of an image, 16 to 9."""
    height, width = shown.shape[:2]
    wide, high = min(width, height * 16 // 9), min(height, -(-width * 9 // 16))
    top, left = (height - high) // 2, (width - wide) // 2
    return shown[top : top + high, left : left + wide]
