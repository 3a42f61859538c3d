# SPDX-License-Identifier: GPL-2.0-or-later
"""Two image files compared by all measures, and the thresholds that a script sets."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from icwafer.compare import flip, images, metrics, noise, srgb
from icwafer.compare.colour import ViewTransform
from icwafer.compare.images import Image
from icwafer.errors import InputError


@dataclass(frozen=True)
class Comparison:
    """What was compared, how, and what was found.

    values: of `measures.MEASURES`; those that do not apply to these images are not in it.
    max_place: x, y, channel of the largest difference.
    flip_map, hdr_flip: None unless asked for.
    """

    a: Image
    b: Image
    compared: str
    view: ViewTransform
    pixels_per_degree: float
    values: dict[str, float]
    max_place: tuple[int, int, int]
    flip_map: np.ndarray | None
    hdr_flip: flip.HdrFlip | None
    noise: noise.NoiseTest | None

    @property
    def bad_pixels(self) -> int:
        """Pixels that are NaN or infinite in either image; they count as equal elsewhere."""
        return int((self.a.bad | self.b.bad).sum())

    @property
    def notes(self) -> tuple[str, ...]:
        return self.a.notes + self.b.notes

    def failures(self, thresholds: dict[str, float]) -> list[str]:
        """Why these images are not equal, a line each; none: they are.

        thresholds: by measure. Without one every difference counts, unless the noise was tested:
        then that test decides. NaN and infinite pixels always count.

        Raises InputError for a threshold of a measure that does not apply.
        """
        found = []
        if self.bad_pixels:
            place = np.argwhere(self.a.bad | self.b.bad)[0]
            found.append(
                f"{self.a.bad.sum()} pixels of A and {self.b.bad.sum()} of B are NaN or "
                f"infinite, the first at {place[1]},{place[0]}"
            )
        for name, limit in thresholds.items():
            if name not in self.values:
                raise InputError(f"--fail-{name} does not apply: both images must be scene-linear")
            value = self.values[name]
            if value < limit if name == "psnr" else value > limit:
                sign = "<" if name == "psnr" else ">"
                found.append(f"{name} {value:.6g} {sign} {limit:g}")
        if self.noise is not None:
            if self.noise.different:
                found.append(f"different beyond noise, p = {self.noise.p:.3g}")
        elif not thresholds and self.values["max"] > 0:
            found.append("the images are not equal (no threshold was given)")
        return found


def compare(
    a: Image,
    b: Image,
    view: ViewTransform,
    ppd: float = flip.DEFAULT_PIXELS_PER_DEGREE,
    with_flip: bool = True,
    with_hdr: bool = True,
    fit: bool = False,
    second: tuple[Image, Image] | None = None,
    with_noise: bool = False,
    level: float = 0.01,
    variances: tuple[Image, Image] | None = None,
) -> Comparison:
    """Compares two images; A is the reference.

    Scene-linear images are compared by their values, others, and one of each kind, as a screen
    shows them; what the eye judges (FLIP, Yee) always is. with_noise: tests whether the difference
    is more than noise, best with `second`, renders of the same scenes with other seeds, or with
    `variances`, images of the variance of each pixel's mean.
    """
    a, b = images.same_size(a, b, fit)
    renders = [a, b, *(second or ())]
    linear = all(image.linear for image in renders)
    for image in renders:
        if image.size != a.size:
            raise InputError(f"{image.path} has another size than {a.path}; render them alike")
    bad = np.logical_or.reduce([image.bad for image in renders])

    def values(image: Image) -> np.ndarray:
        pixels = image.pixels if linear or not image.linear else view.encode(image.pixels)
        return np.where(bad[..., None], np.float32(0), pixels)

    pixels = [values(image) for image in renders]
    shown = [view.encode(image) for image in pixels[:2]] if linear else pixels[:2]
    errors = metrics.errors(*pixels[:2])
    visible = metrics.yee(*(srgb.decode(image) for image in shown), ppd)
    found = {
        "mean": errors.mean,
        "rms": errors.rms,
        "psnr": errors.psnr_db,
        "max": errors.max,
        "yee": visible.share,
    }
    flip_map = hdr_flip = None
    if with_flip:
        flip_map = flip.ldr(*shown, ppd)
        found["flip"] = float(flip_map.mean())
        if linear and with_hdr:
            hdr_flip = flip.hdr(*(view.to_rec709(image) for image in pixels[:2]), ppd)
            found["hdr-flip"] = float(hdr_flip.map.mean())
    tested = None
    if with_noise:
        known = variances and _known(variances, a, linear, bad)
        tested = noise.compare(pixels[::2], pixels[1::2], level, known)
    return Comparison(
        a=a,
        b=b,
        compared="scene-linear values" if linear else "values as a screen shows them",
        view=view,
        pixels_per_degree=ppd,
        values=found,
        max_place=errors.max_place,
        flip_map=flip_map,
        hdr_flip=hdr_flip,
        noise=tested,
    )


def _known(
    variances: tuple[Image, Image], render: Image, linear: bool, bad: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Pixels of images of the variance. Raises InputError where they are none of these renders."""
    for image in variances:
        if not (linear and image.linear):
            raise InputError(f"{image.path}: variances are of scene-linear values; give EXRs")
        if image.size != render.size:
            raise InputError(
                f"{image.path} has another size than {render.path}; render them alike"
            )
        if image.pixels.min() < 0.0:
            raise InputError(f"{image.path}: has negative values, which no variance is")
    first, second = (
        np.where((bad | image.bad)[..., None], 0.0, image.pixels) for image in variances
    )
    return first, second


def as_json(comparison: Comparison, failures: Sequence[str]) -> dict[str, object]:
    """The result for a script; an infinite PSNR is null."""
    result: dict[str, object] = {
        "a": _described(comparison.a),
        "b": _described(comparison.b),
        "compared": comparison.compared,
        "view_transform": str(comparison.view),
        "pixels_per_degree": comparison.pixels_per_degree,
        "values": {
            name: value if math.isfinite(value) else None
            for name, value in comparison.values.items()
        },
        "max_place": dict(zip(("x", "y", "channel"), comparison.max_place)),
        "bad_pixels": comparison.bad_pixels,
        "notes": list(comparison.notes),
        "equal": not failures,
        "failures": list(failures),
    }
    if comparison.hdr_flip:
        result["hdr_flip_exposures"] = {
            "start": comparison.hdr_flip.start_exposure,
            "stop": comparison.hdr_flip.stop_exposure,
            "count": comparison.hdr_flip.exposures,
        }
    if comparison.noise:
        names = ("different", "p", "level", "tests", "share", "rms", "rms_noise", "rms_beyond")
        result["noise"] = {name: getattr(comparison.noise, name) for name in names}
    return result


def _described(image: Image) -> dict[str, object]:
    return {
        "path": str(image.path),
        "size": list(image.size),
        "values": "scene-linear" if image.linear else "encoded",
        "bad_pixels": int(image.bad.sum()),
    }
