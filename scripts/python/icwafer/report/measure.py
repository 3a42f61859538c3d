# SPDX-License-Identifier: GPL-2.0-or-later
"""What a study's page needs of each render: its pixels in size, its measures, its FLIP map."""

from __future__ import annotations

import math
import multiprocessing
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import OpenImageIO as oiio

from icwafer.compare import comparison, hues, images, overlay, srgb
from icwafer.compare.colour import SRGB_CURVE, ViewTransform, view_transform
from icwafer.errors import IcwaferError
from icwafer.report import encode
from icwafer.report.study import Job, Study

#: Measures of a job: what each is. Luminance is scene-linear, saturation OKLab's chroma over
#: lightness; the others are differences from the reference, RMS and PSNR of scene-linear values.
MEASURES = {
    "luminance": "mean luminance",
    "saturation": "mean saturation",
    "rms": "RMS difference",
    "psnr": "PSNR, dB",
    "flip": "mean FLIP",
    "hdr_flip": "mean HDR-FLIP",
}


@dataclass(frozen=True)
class Measured:
    """A render, encoded for the page (see `encode`), and its measures.

    size: width and height of what is embedded; original_size: of the render. linear: whether it
    was scene-linear. view: names the view transform. flip, hdr_flip: maps, or "".
    curves: of the orders, in pixels of the original size.
    """

    size: tuple[int, int]
    original_size: tuple[int, int]
    pixels: str
    thumbnail: str
    linear: bool
    view: str
    values: dict[str, float]
    flip: str
    hdr_flip: str
    curves: tuple[overlay.Curve, ...]


@dataclass(frozen=True)
class Options:
    """config: OpenColorIO's; view and look: for jobs that name none. ppd: pixels per degree.
    scale: of the embedded pixels. thumbnail_px: longer side of a thumbnail. hdr: whether HDR-FLIP, which takes longest, is computed.
    layer: of the EXRs."""

    config: Path | None
    view: str | None
    look: str | None
    ppd: float
    scale: float
    thumbnail_px: int
    hdr: bool
    layer: str | None = None


def view_of(job: Job, options: Options, linear: bool) -> ViewTransform:
    """The view transform that a job was rendered with, as far as it says so."""
    if not linear:
        return SRGB_CURVE
    return view_transform(options.config, job.view or options.view, job.look or options.look)


def measure(
    study: Study, reference: Job | None, options: Options, processes: int
) -> tuple[dict[str, Measured], dict[str, str]]:
    """All finished jobs by id, and for those that cannot be used the reason."""
    finished = [job for job in study.jobs if job.image]
    tasks = [(job, reference, options) for job in finished]
    if processes > 1 and len(tasks) > 1:
        # Forked, a process would inherit the locks of OpenImageIO's threads, but not the threads.
        with ProcessPoolExecutor(processes, multiprocessing.get_context("spawn")) as pool:
            results = list(pool.map(_attempt, tasks))
    else:
        results = list(map(_attempt, tasks))
    measured = {
        job.id: result for job, result in zip(finished, results) if isinstance(result, Measured)
    }
    failed = {job.id: result for job, result in zip(finished, results) if isinstance(result, str)}
    return measured, failed


def _attempt(task: tuple[Job, Job | None, Options]) -> Measured | str:
    try:
        return _measure(*task)
    except IcwaferError as error:
        return str(error)


def _measure(job: Job, reference: Job | None, options: Options) -> Measured:
    image = images.read(job.image, options.layer)
    view = view_of(job, options, image.linear)
    linear = _light(image)
    rec709 = view.to_rec709(linear)
    lab = hues.to_oklab(rec709)
    values = {
        "luminance": float((rec709 @ srgb.LUMINANCE).mean()),
        "saturation": float(
            np.hypot(lab[..., 1], lab[..., 2]).sum() / max(float(lab[..., 0].sum()), 1e-30)
        ),
    }
    flip_map = hdr_map = ""
    size = _scaled(image.size, options.scale)
    if reference is not None:
        other = images.read(reference.image, options.layer)
        if other.size != image.size:
            raise IcwaferError(
                f"{job.image} is {image.size[0]}x{image.size[1]} and the reference "
                f"{other.size[0]}x{other.size[1]}; render both at one size"
            )
        found = comparison.compare(other, image, view, options.ppd, with_hdr=options.hdr)
        values |= {"rms": found.values["rms"], "flip": found.values["flip"]}
        if math.isfinite(found.values["psnr"]):
            values["psnr"] = found.values["psnr"]
        flip_map = encode.unit_map(_small(found.flip_map, size))
        if found.hdr_flip:
            values["hdr_flip"] = found.values["hdr-flip"]
            hdr_map = encode.unit_map(_small(found.hdr_flip.map, size))
    shown = view.encode(linear)
    return Measured(
        size=size,
        original_size=image.size,
        pixels=encode.half_floats(_small(linear, size)),
        thumbnail=encode.thumbnail(shown, options.thumbnail_px),
        linear=image.linear,
        view=view.name,
        values={name: values[name] for name in MEASURES if name in values},
        flip=flip_map,
        hdr_flip=hdr_map,
        curves=tuple(
            curve
            for grating in job.gratings
            for curve in overlay.grating_overlay(
                image.size,
                grating.camera,
                grating.light,
                grating.plane,
                grating.spacing_nm,
                grating.direction_rad,
            )
        ),
    )


def _light(image: images.Image) -> np.ndarray:
    """Linear light: of an encoded image, what the screen emits."""
    return image.pixels if image.linear else srgb.decode(image.pixels)


def _scaled(size: tuple[int, int], scale: float) -> tuple[int, int]:
    return max(1, round(size[0] * scale)), max(1, round(size[1] * scale))


def _small(values: np.ndarray, size: tuple[int, int]) -> np.ndarray:
    """Resampled without overshoot: ringing would be negative light."""
    if values.shape[:2] == (size[1], size[0]):
        return values
    small = oiio.ImageBufAlgo.resize(
        images.to_buffer(np.atleast_3d(values)), "box", roi=oiio.ROI(0, size[0], 0, size[1])
    )
    return small.get_pixels(oiio.FLOAT).reshape(size[1], size[0], *values.shape[2:])
