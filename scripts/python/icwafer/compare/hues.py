# SPDX-License-Identifier: GPL-2.0-or-later
"""Compares the colours of two pictures whose exposure is unknown: hues, saturations, bands.

In OKLab (Ottosson 2020, "A perceptual color space for image processing") all three coordinates
scale with the cube root of the light, so that hue and saturation, chroma over lightness, do not
depend on the exposure at all.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from icwafer.compare.rectify import Point, bilinear

# Ottosson 2020: linear Rec.709 to cone responses, and their cube roots to L, a, b.
_TO_CONES = np.array(
    [
        [0.4122214708, 0.5363325363, 0.0514459929],
        [0.2119034982, 0.6806995451, 0.1073969566],
        [0.0883024619, 0.2817188376, 0.6299787005],
    ]
)
_TO_OKLAB = np.array(
    [
        [0.2104542553, 0.7936177850, -0.0040720468],
        [1.9779984951, -2.4285922050, 0.4505937099],
        [0.0259040371, 0.7827717662, -0.8086757660],
    ]
)

HUE_BINS = 72
SATURATION_BINS = 40
#: Chroma over lightness of the most saturated colour of Rec.709, blue, is 0.69.
LARGEST_SATURATION = 0.8

#: Hues in degrees of the corners of Rec.709's gamut: the names of the bands.
NAMED_HUES = {
    "red": 29.2,
    "yellow": 109.8,
    "green": 142.5,
    "cyan": 194.8,
    "blue": 264.1,
    "magenta": 328.4,
}


@dataclass(frozen=True)
class Band:
    """A place on a profile, 0 to 1, where the hue passes that of a name."""

    name: str
    place: float


@dataclass(frozen=True)
class Profile:
    """Colours along a line: a b as shares of L at `place`, 0 to 1, and the bands there."""

    place: np.ndarray
    chroma: np.ndarray
    bands: tuple[Band, ...]


@dataclass(frozen=True)
class HueComparison:
    """How like each other the colours of two pictures are.

    hue_distance_deg: mean angle by which hues have to be turned to make one distribution the other
    (circular earth mover's distance; 0 to 180). saturation_distance: the same of the saturations.
    histograms: hue and saturation shares of each picture.
    profile_correlation: of the colours along the line, 1 for equal bands.
    shift, stretch: what moves the second picture's bands over the first's (shares of the line) and
    best_correlation what it is then.
    """

    hue_distance_deg: float
    saturation_distance: float
    hue_histograms: tuple[np.ndarray, np.ndarray]
    saturation_histograms: tuple[np.ndarray, np.ndarray]
    profiles: tuple[Profile, Profile]
    profile_correlation: float
    shift: float
    stretch: float
    best_correlation: float


def to_oklab(linear: np.ndarray) -> np.ndarray:
    """Linear Rec.709 to OKLab; L is 1 for white."""
    return np.cbrt(np.maximum(linear, 0.0) @ _TO_CONES.T) @ _TO_OKLAB.T


def from_oklab(lab: np.ndarray) -> np.ndarray:
    """The inverse of `to_oklab`; colours outside Rec.709 have negative channels."""
    return (lab @ np.linalg.inv(_TO_OKLAB).T) ** 3 @ np.linalg.inv(_TO_CONES).T


def compare(
    first: np.ndarray,
    second: np.ndarray,
    line: tuple[Point, Point] = ((0.5, 0.0), (0.5, 1.0)),
) -> HueComparison:
    """Compares two rectified pictures of linear Rec.709, height x width x 3 each.

    line: of the profile, in shares of the width and the height.
    """
    labs = [to_oklab(picture) for picture in (first, second)]
    hues = tuple(_hue_histogram(lab) for lab in labs)
    saturations = tuple(_saturation_histogram(lab) for lab in labs)
    profiles = tuple(_profile(lab, line) for lab in labs)
    colours = [profile.chroma[:, 0] + 1j * profile.chroma[:, 1] for profile in profiles]
    shift, stretch, best = _align(*colours)
    return HueComparison(
        hue_distance_deg=_circular_distance(*hues) * 360 / HUE_BINS,
        saturation_distance=float(np.abs(np.cumsum(saturations[0] - saturations[1])).sum())
        * LARGEST_SATURATION / SATURATION_BINS,
        hue_histograms=hues,
        saturation_histograms=saturations,
        profiles=profiles,
        profile_correlation=_correlation(*colours),
        shift=shift,
        stretch=stretch,
        best_correlation=best,
    )  # fmt: skip


def _hue_histogram(lab: np.ndarray) -> np.ndarray:
    """Shares of the hues, each pixel weighted with its chroma: grey has no hue."""
    hue = np.arctan2(lab[..., 2], lab[..., 1]) % (2 * math.pi)
    weight = np.hypot(lab[..., 1], lab[..., 2])
    counts, _ = np.histogram(hue, HUE_BINS, (0.0, 2 * math.pi), weights=weight)
    return counts / max(counts.sum(), 1e-30)


def _saturation_histogram(lab: np.ndarray) -> np.ndarray:
    """Shares of the saturations, each pixel weighted with its lightness: black has none."""
    saturation = np.hypot(lab[..., 1], lab[..., 2]) / np.maximum(lab[..., 0], 1e-6)
    clipped = np.clip(saturation, 0.0, LARGEST_SATURATION)
    counts, _ = np.histogram(
        clipped, SATURATION_BINS, (0.0, LARGEST_SATURATION), weights=lab[..., 0]
    )
    return counts / max(counts.sum(), 1e-30)


def _circular_distance(first: np.ndarray, second: np.ndarray) -> float:
    """Earth mover's distance on a circle, in bins (Werman, Peleg, Melter, Kong 1986)."""
    surplus = np.cumsum(first - second)
    return float(np.abs(surplus - np.median(surplus)).sum())


def _profile(lab: np.ndarray, line: tuple[Point, Point], points: int = 256) -> Profile:
    """Along a line, as the mean over a strip of a tenth of the picture, so that lines and pads
    inside the die do not count as bands."""
    height, width = lab.shape[:2]
    size = np.array([width, height])
    start, end = (np.array(point) * size for point in line)
    along = end - start
    aside = np.array([-along[1], along[0]]) / np.linalg.norm(along) * 0.1 * size.min()
    place = (np.arange(points) + 0.5) / points
    strip = np.linspace(-0.5, 0.5, 33)
    positions = start + place[:, None, None] * along + strip[None, :, None] * aside
    colour = bilinear(lab, positions[..., 0], positions[..., 1]).mean(axis=1)
    chroma = colour[:, 1:] / np.maximum(colour[:, :1], 1e-6)
    return Profile(place, chroma, _bands(place, chroma))


def _bands(place: np.ndarray, chroma: np.ndarray) -> tuple[Band, ...]:
    """Where the smoothed hue passes a named one while there is colour."""
    kernel = np.hanning(17) / np.hanning(17).sum()
    smooth = np.stack([np.convolve(channel, kernel, "same") for channel in chroma.T], axis=1)
    hue = np.degrees(np.arctan2(smooth[:, 1], smooth[:, 0]))
    found = []
    for name, named in NAMED_HUES.items():
        off = (hue - named + 180) % 360 - 180
        crosses = (off[:-1] * off[1:] <= 0) & (np.abs(off[1:] - off[:-1]) < 90)
        coloured = np.hypot(*smooth[:-1].T) > 0.03
        for i in np.flatnonzero(crosses & coloured):
            step = off[i] / (off[i] - off[i + 1]) if off[i] != off[i + 1] else 0.0
            found.append(Band(name, float(place[i] + step * (place[i + 1] - place[i]))))
    return tuple(sorted(found, key=lambda band: band.place))


def _correlation(first: np.ndarray, second: np.ndarray) -> float:
    """Of two courses of colours, -1 to 1: 1 when hues agree everywhere, -1 when opposite."""
    length = math.sqrt((np.abs(first) ** 2).sum() * (np.abs(second) ** 2).sum())
    return float((first * second.conj()).real.sum() / length) if length else 0.0


def _align(first: np.ndarray, second: np.ndarray) -> tuple[float, float, float]:
    """Shift and stretch of the second course about its middle that correlate best.

    At least half of the first course has to be covered.
    """
    place = (np.arange(first.size) + 0.5) / first.size
    best = (0.0, 1.0, _correlation(first, second))
    for stretch in np.geomspace(0.5, 2.0, 41):
        for shift in np.linspace(-0.5, 0.5, 101):
            source = (place - 0.5 - shift) / stretch + 0.5
            inside = (source >= 0.0) & (source <= 1.0)
            if inside.mean() < 0.5:
                continue
            moved = np.interp(source[inside], place, second.real) + 1j * np.interp(
                source[inside], place, second.imag
            )
            found = _correlation(first[inside], moved)
            if found > best[2] + 1e-9:
                best = (float(shift), float(stretch), found)
    return best
