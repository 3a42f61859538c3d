# SPDX-License-Identifier: GPL-2.0-or-later
"""FLIP: how visible the difference is to someone who flips between two images.

LDR: Andersson, Nilsson, Akenine-Moeller, Oskarsson, Astroem, Fairchild 2020, "FLIP: A Difference
Evaluator for Alternating Images", Proc. ACM Comput. Graph. Interact. Tech. 3(2). HDR: Andersson,
Nilsson, Shirley, Akenine-Moeller 2021, "Visualizing Errors in Rendered High Dynamic Range Images",
Eurographics short papers. Section numbers below are those of the first paper.

Maps hold 0 (no visible difference) to 1 (the largest), height x width.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from icwafer.compare import srgb

# Section 4.1.1, table 1: contrast sensitivity as sums of Gaussians, (a, b) each, of the
# achromatic, the red-green and the blue-yellow channel; b in squared degrees.
_SENSITIVITY = (
    ((1.0, 0.0047),),
    ((1.0, 0.0053),),
    ((34.1, 0.04), (13.5, 0.025)),
)
_WIDEST = 0.04
# Section 4.1.2 and 4.3: exponent and knee of the colour difference.
_COLOUR_EXPONENT, _KNEE, _KNEE_VALUE = 0.7, 0.4, 0.95
# Section 4.2: width of an edge in degrees, exponent of the feature difference.
_FEATURE_DEG, _FEATURE_EXPONENT = 0.082, 0.5

#: Pixels per degree of a 24 inch 3840-pixel screen, 0.7 m wide, seen from 0.7 m, the papers' own.
DEFAULT_PIXELS_PER_DEGREE = 0.7 * 3840 / 0.7 * math.pi / 180

#: Tone mappers of the HDR variant: coefficients of (k0 x^2 + k1 x + k2) / (k3 x^2 + k4 x + k5).
TONE_MAPPERS: dict[str, tuple[float, ...]] = {
    # Narkowicz's fit of the ACES curve, exposed by 0.6 as in the 2021 paper.
    "aces": (0.6**2 * 2.51, 0.6 * 0.03, 0.0, 0.6**2 * 2.43, 0.6 * 0.59, 0.14),
    "reinhard": (0.0, 1.0, 0.0, 0.0, 1.0, 1.0),
}
# The brightest exposure takes the median, the darkest the maximum, to this tone-mapped value.
_TONE_TARGET = 0.85


@dataclass(frozen=True)
class HdrFlip:
    """Map, the exposures in stops from first to last, and for each pixel the stop of its value."""

    map: np.ndarray
    start_exposure: float
    stop_exposure: float
    exposures: int
    exposure_of_pixel: np.ndarray


def pixels_per_degree(distance_m: float, screen_width_m: float, screen_width_px: int) -> float:
    """Of a screen seen from a distance, at its middle (2020, section 6)."""
    return distance_m * screen_width_px / screen_width_m * math.pi / 180


def ldr(reference: np.ndarray, test: np.ndarray, ppd: float) -> np.ndarray:
    """FLIP map of two images of sRGB-encoded values, 0 to 1, height x width x 3 each.

    ppd: pixels per degree of visual angle, > 0. Symmetric in its two images.
    """
    linear = [srgb.decode(np.clip(image, 0.0, 1.0)) for image in (reference, test)]
    return _linear_ldr(linear[0], linear[1], ppd)


def hdr(
    reference: np.ndarray,
    test: np.ndarray,
    ppd: float,
    tone_mapper: str = "aces",
    start: float | None = None,
    stop: float | None = None,
    exposures: int | None = None,
) -> HdrFlip:
    """FLIP map of two images of linear Rec.709 values: the largest LDR-FLIP over exposures.

    Unless given, the exposures (in stops) come from the reference's luminance, so that the map is
    not symmetric; with `start` and `stop` given it is.
    """
    coefficients = TONE_MAPPERS[tone_mapper]
    if start is None or stop is None:
        first, last = exposure_range(reference, tone_mapper)
        start, stop = first if start is None else start, last if stop is None else stop
    count = exposures or max(2, math.ceil(stop - start))
    stops = np.linspace(start, stop, count)
    worst = np.zeros(reference.shape[:2])
    at = np.full(worst.shape, start)
    for exposure in stops:
        mapped = [
            _tone_map(np.maximum(image, 0.0) * 2.0**exposure, coefficients)
            for image in (reference, test)
        ]
        here = _linear_ldr(mapped[0], mapped[1], ppd)
        at = np.where(here > worst, exposure, at)
        worst = np.maximum(worst, here)
    return HdrFlip(worst, float(start), float(stop), count, at)


def exposure_range(reference: np.ndarray, tone_mapper: str = "aces") -> tuple[float, float]:
    """First and last exposure in stops (2021, section 3.1)."""
    k0, k1, k2, k3, k4, k5 = TONE_MAPPERS[tone_mapper]
    quadratic = (k0 - _TONE_TARGET * k3, k1 - _TONE_TARGET * k4, k2 - _TONE_TARGET * k5)
    target = max(float(root.real) for root in np.roots(quadratic))
    luminance = np.maximum(reference, 0.0) @ srgb.LUMINANCE
    lit = luminance[luminance > 0.0]
    if not lit.size:
        return 0.0, 0.0
    # Much of a rendered chip is black surroundings, whose median would ask for endless exposure.
    middle = np.median(luminance) or np.median(lit)
    return math.log2(target / lit.max()), math.log2(target / middle)


def weighted_median(flip_map: np.ndarray) -> float:
    """The value below which pixels make half of the sum of a map ("weighted median")."""
    values = np.sort(flip_map, axis=None)
    total = np.cumsum(values)
    return float(values[np.searchsorted(total, 0.5 * total[-1])])


def _tone_map(linear: np.ndarray, k: tuple[float, ...]) -> np.ndarray:
    mapped = ((k[0] * linear + k[1]) * linear + k[2]) / ((k[3] * linear + k[4]) * linear + k[5])
    return np.clip(mapped, 0.0, 1.0)


def _linear_ldr(reference: np.ndarray, test: np.ndarray, ppd: float) -> np.ndarray:
    # Single precision, as the authors' evaluator; it halves the time.
    opponent = [_to_opponent(image.astype(np.float32)) for image in (reference, test)]
    colour = _colour_difference(*(_to_perceived(image, ppd) for image in opponent))
    feature = _feature_difference(*(image[..., 0] for image in opponent), ppd)
    return colour ** (1.0 - feature)


def _to_opponent(linear: np.ndarray) -> np.ndarray:
    """Y C_x C_z: CIELAB without its roots, so that filtering is linear in light (4.1.1)."""
    x, y, z = np.moveaxis(srgb.to_xyz(linear), -1, 0)
    return np.stack([116 * y - 16, 500 * (x - y), 200 * (y - z)], axis=-1)


def _from_opponent(opponent: np.ndarray) -> np.ndarray:
    luma, red_green, blue_yellow = np.moveaxis(opponent, -1, 0)
    y = (luma + 16) / 116
    return srgb.from_xyz(np.stack([y + red_green / 500, y, y - blue_yellow / 200], axis=-1))


def _to_perceived(opponent: np.ndarray, ppd: float) -> np.ndarray:
    """CIELAB with Hunt's effect of what the eye resolves at a distance (section 4.1.2)."""
    radius = math.ceil(3 * math.sqrt(_WIDEST / (2 * math.pi**2)) * ppd)
    offset_deg = np.arange(-radius, radius + 1) / ppd
    seen = np.empty_like(opponent)
    for channel, terms in enumerate(_SENSITIVITY):
        filtered, weight = 0.0, 0.0
        for a, b in terms:
            kernel = np.exp(-((math.pi * offset_deg) ** 2) / b)
            height = a * math.sqrt(math.pi / b)
            along_row = _filter(opponent[..., channel], kernel, axis=1)
            filtered += height * _filter(along_row, kernel, axis=0)
            weight += height * kernel.sum() ** 2
        seen[..., channel] = filtered / weight
    lab = srgb.to_lab(np.clip(_from_opponent(seen), 0.0, 1.0))
    return _hunt(lab)


def _hunt(lab: np.ndarray) -> np.ndarray:
    return lab * np.concatenate([np.ones_like(lab[..., :1]), *2 * [0.01 * lab[..., :1]]], axis=-1)


def _hyab(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """Abasi, Amani Tehran, Fairchild 2020: city-block in lightness, Euclidean in chroma."""
    difference = first - second
    return np.abs(difference[..., 0]) + np.hypot(difference[..., 1], difference[..., 2])


def _colour_difference(reference: np.ndarray, test: np.ndarray) -> np.ndarray:
    """Section 4.1.3: 0 to 1, the large differences compressed."""
    # Green and blue are the two colours of the screen's gamut that are farthest apart.
    green, blue = (_hunt(srgb.to_lab(np.eye(3)[channel])) for channel in (1, 2))
    largest = _hyab(green, blue) ** _COLOUR_EXPONENT
    difference = _hyab(reference, test) ** _COLOUR_EXPONENT
    knee = _KNEE * largest
    above = _KNEE_VALUE + (difference - knee) / (largest - knee) * (1 - _KNEE_VALUE)
    return np.clip(np.where(difference < knee, _KNEE_VALUE / knee * difference, above), 0.0, 1.0)


def _feature_difference(reference: np.ndarray, test: np.ndarray, ppd: float) -> np.ndarray:
    """Section 4.2: edges and points that are in one image only, 0 to 1."""
    deviation = 0.5 * _FEATURE_DEG * ppd
    offset = np.arange(-(radius := math.ceil(3 * deviation)), radius + 1)
    smooth = np.exp(-0.5 * (offset / deviation) ** 2)
    edge = _unit_sides(-offset * smooth)
    point = _unit_sides(((offset / deviation) ** 2 - 1) * smooth)
    smooth /= smooth.sum()

    def strengths(luma: np.ndarray) -> list[np.ndarray]:
        grey = (luma + 16) / 116
        smooth_down, smooth_across = (_filter(grey, smooth, axis) for axis in (0, 1))
        return [
            np.hypot(_filter(smooth_down, kernel, axis=1), _filter(smooth_across, kernel, axis=0))
            for kernel in (edge, point)
        ]

    differences = [
        np.abs(in_reference - in_test)
        for in_reference, in_test in zip(strengths(reference), strengths(test))
    ]
    return np.clip((np.maximum(*differences) / math.sqrt(2)) ** _FEATURE_EXPONENT, 0.0, 1.0)


def _unit_sides(kernel: np.ndarray) -> np.ndarray:
    """Scaled so that the positive weights sum to 1 and the negative ones to -1."""
    return np.where(
        kernel > 0, kernel / kernel[kernel > 0].sum(), kernel / -kernel[kernel < 0].sum()
    )


def _filter(image: np.ndarray, kernel: np.ndarray, axis: int) -> np.ndarray:
    """Convolution along an axis; beyond the border the border's pixels continue."""
    radius = kernel.size // 2
    padding = [(0, 0), (0, 0)]
    padding[axis] = (radius, radius)
    padded = np.pad(image, padding, mode="edge")
    result, product = np.zeros_like(image), np.empty_like(image)
    for first, weight in enumerate(kernel[::-1]):
        window = [slice(None), slice(None)]
        window[axis] = slice(first, first + image.shape[axis])
        np.multiply(padded[tuple(window)], float(weight), out=product)
        result += product
    return result
