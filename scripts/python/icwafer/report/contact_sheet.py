# SPDX-License-Identifier: GPL-2.0-or-later
"""A sweep as one picture: rows and columns of renders with their values written at the axes."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import OpenImageIO as oiio

from icwafer.compare import images
from icwafer.compare.colour import ViewTransform
from icwafer.report.measure import Measured, Options
from icwafer.report.study import Axis, Job, Study

_CELL_PX = 320
_MOST_CELLS, _MOST_SHEETS = 24, 12  # across or down
_GAP_PX = 6
_MARGIN_PX = 92
_FONT_PX = 18
_LETTER_PX = 12  # of the widest letters
_FONT = "DejaVuSans"
_GROUND = (0.09, 0.09, 0.09)
_INK = (0.86, 0.86, 0.86)
_FAINT = (0.17, 0.17, 0.17)


def contact_sheet(
    study: Study, measured: dict[str, Measured], views: dict[str, ViewTransform], options: Options
) -> list[oiio.ImageBuf]:
    """One sheet for each combination of the axes' values beyond the two with most values.

    The longest axis runs to the right, the next one down. No axes, no sheet. Of long axes a sheet
    has some values, evenly spread, and of many sheets there are some.
    """
    swept = sorted(
        (axis for axis in study.axes if len(axis.values) > 1), key=lambda axis: -len(axis.values)
    )
    if not swept:
        return []
    across = _thinned(swept[0], _MOST_CELLS)
    down = _thinned(swept[1], _MOST_CELLS) if len(swept) > 1 else None
    sheets = []
    others = swept[2:]
    for chosen in spread_over(list(itertools.product(*(axis.values for axis in others))), _MOST_SHEETS):
        fixed = dict(zip((axis.name for axis in others), chosen))
        title = ", ".join(
            f"{axis.name} {_text(value)} {axis.unit}".strip()
            for axis, value in zip(others, chosen)
        )
        jobs = [
            job for job in study.jobs
            if job.id in measured
            and job.settings.get(across.name) in across.values
            and (down is None or job.settings.get(down.name) in down.values)
            and all(job.settings.get(name) == value for name, value in fixed.items())
        ]  # fmt: skip
        if jobs:
            pictures = {
                (job.settings.get(across.name), down and job.settings.get(down.name)): _shown(
                    job, views[measured[job.id].view], options
                )
                for job in jobs
            }
            heading = f"{study.name}: {title}" if title else study.name
            sheets.append(_sheet(heading, across, down, pictures))
    return sheets


def spread_over(values: Sequence[Any], most: int) -> Sequence[Any]:
    """At most so many values, evenly spread, the first and the last among them."""
    if len(values) <= most:
        return values
    return [values[i] for i in np.linspace(0, len(values) - 1, most).round().astype(int)]


def _thinned(axis: Axis, most: int) -> Axis:
    return replace(axis, values=tuple(spread_over(axis.values, most)))


def _sheet(
    title: str, across: Axis, down: Axis | None, pictures: dict[Any, np.ndarray]
) -> oiio.ImageBuf:
    rows = down.values if down else (None,)
    first = next(iter(pictures.values()))
    cell = (_CELL_PX, max(1, round(_CELL_PX * first.shape[0] / first.shape[1])))
    left = _GAP_PX * 2
    if down:
        longest = max(map(len, (down.name, down.unit, *map(_text, down.values))))
        left += longest * _LETTER_PX + _GAP_PX
    width = left + len(across.values) * (cell[0] + _GAP_PX) + _GAP_PX
    height = _MARGIN_PX + len(rows) * (cell[1] + _GAP_PX) + _GAP_PX
    sheet = oiio.ImageBuf(oiio.ImageSpec(width, height, 3, oiio.UINT8))
    oiio.ImageBufAlgo.fill(sheet, _GROUND)
    _write(sheet, left, 22, title, "left")
    middle = left + (width - left) // 2
    _write(sheet, middle, 48, f"{across.name}, {across.unit}".strip(", "), "center")
    for column, value in enumerate(across.values):
        x = left + column * (cell[0] + _GAP_PX)
        _write(sheet, x + cell[0] // 2, _MARGIN_PX - 20, _text(value), "center")
        for row, other in enumerate(rows):
            y = _MARGIN_PX + row * (cell[1] + _GAP_PX)
            _place(sheet, pictures.get((value, other)), x, y, cell)
    for row, value in enumerate(rows if down else ()):
        y = _MARGIN_PX + row * (cell[1] + _GAP_PX) + cell[1] // 2
        _write(sheet, left // 2, y, _text(value), "center")
    if down:
        _write(sheet, left // 2, 48, down.name, "center")
        _write(sheet, left // 2, 48 + _FONT_PX + 2, down.unit, "center")
    return sheet


def _place(
    sheet: oiio.ImageBuf, picture: np.ndarray | None, x: int, y: int, cell: tuple[int, int]
) -> None:
    if picture is None:
        oiio.ImageBufAlgo.fill(sheet, _FAINT, roi=oiio.ROI(x, x + cell[0], y, y + cell[1]))
        _write(sheet, x + cell[0] // 2, y + cell[1] // 2, "not rendered", "center")
        return
    small = oiio.ImageBufAlgo.resize(
        images.to_buffer(picture), roi=oiio.ROI(0, cell[0], 0, cell[1])
    )
    oiio.ImageBufAlgo.paste(sheet, x, y, 0, 0, oiio.ImageBufAlgo.clamp(small, 0.0, 1.0))


def _write(sheet: oiio.ImageBuf, x: int, y: int, text: str, align: str) -> None:
    oiio.ImageBufAlgo.render_text(
        sheet, x, y, text, _FONT_PX, _FONT, _INK, alignx=align, aligny="center"
    )


def _text(value: object) -> str:
    return f"{value:g}" if isinstance(value, float) else str(value)


def _shown(job: Job, view: ViewTransform, options: Options) -> np.ndarray:
    image = images.read(job.image, options.layer)
    return view.encode(image.pixels) if image.linear else image.pixels
