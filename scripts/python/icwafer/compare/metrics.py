# SPDX-License-Identifier: GPL-2.0-or-later
"""OpenImageIO's measures of the difference between two images."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import OpenImageIO as oiio

from icwafer.compare.images import to_buffer


@dataclass(frozen=True)
class Errors:
    """Differences over all pixels and channels, in the images' own values.

    psnr_db: for a peak of 1; infinite for equal images.
    max_place: x, y, channel (0 red) of the largest difference, from the top left.
    """

    mean: float
    rms: float
    psnr_db: float
    max: float
    max_place: tuple[int, int, int]


def errors(first: np.ndarray, second: np.ndarray) -> Errors:
    """Mean, RMS, PSNR and maximum of |first - second|; arrays of height x width x 3."""
    found = oiio.ImageBufAlgo.compare(to_buffer(first), to_buffer(second), 0.0, 0.0)
    # OpenImageIO says 0 dB less a guard value for equal images.
    psnr = math.inf if found.rms_error == 0 else -20 * math.log10(found.rms_error)
    return Errors(
        found.meanerror,
        found.rms_error,
        psnr,
        found.maxerror,
        (found.maxx, found.maxy, found.maxc),
    )


@dataclass(frozen=True)
class Yee:
    """Pixels whose difference is visible (Yee 2004), their share, and the conditions."""

    pixels: int
    share: float
    luminance_cd_m2: float
    field_deg: float


def yee(first: np.ndarray, second: np.ndarray, ppd: float, luminance_cd_m2: float = 100.0) -> Yee:
    """OpenImageIO's perceptual comparison of two images of linear values for a screen, 0 to 1.

    ppd: pixels per degree of visual angle. luminance_cd_m2: of the screen's white. OpenImageIO
    2.4.7 finds differences of colour only: of brightness alone it calls black and white equal.
    """
    width = first.shape[1]
    field_deg = math.degrees(2 * math.atan(math.radians(width / ppd) / 2))
    found = oiio.CompareResults()
    oiio.ImageBufAlgo.compare_Yee(
        to_buffer(first), to_buffer(second), found, luminance_cd_m2, field_deg
    )
    return Yee(found.nfail, found.nfail / (width * first.shape[0]), luminance_cd_m2, field_deg)
