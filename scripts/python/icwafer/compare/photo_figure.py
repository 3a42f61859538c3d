# SPDX-License-Identifier: GPL-2.0-or-later
"""The colours of a photograph and of a render drawn for the eye, as SVG for the page."""

from __future__ import annotations

import math

import numpy as np

from icwafer.compare import srgb
from icwafer.compare.hues import HUE_BINS, Band, HueComparison, from_oklab

_WIDTH, _LEFT = 960, 90
_STRIP, _BARS = 34, 150
#: Hues are drawn at one lightness, so that brightness, which is not compared, does not distract.
_LIGHTNESS = 0.72


def svg(found: HueComparison, names: tuple[str, str]) -> str:
    """Two strips of the colours along the line with their bands, and the two hue distributions."""
    parts = [_text(_LEFT, 16, "Hue along the line, at one lightness; names where a hue is passed")]
    for index, (profile, name) in enumerate(zip(found.profiles, names)):
        top = 30 + index * (_STRIP + 34)
        step = (_WIDTH - _LEFT) / profile.place.size
        parts.append(_text(_LEFT - 10, top + _STRIP / 2 + 4, name, "end"))
        parts += [
            _rect(_LEFT + i * step, top, step + 0.6, _STRIP, _colour(*chroma))
            for i, chroma in enumerate(profile.chroma)
        ]
        parts += _band_marks(profile.bands, top + _STRIP)
    base = 30 + 2 * (_STRIP + 34) + 30 + _BARS
    parts.append(_text(_LEFT, base - _BARS - 12, f"Hues: {names[0]} filled, {names[1]} as a line"))
    parts += _histograms(found.hue_histograms, base)
    return (
        f'<svg class="chart" viewBox="0 0 {_WIDTH} {base + 30}" role="img" aria-label="Hues of '
        f'{names[0]} and {names[1]}">{"".join(parts)}</svg>'
    )


def _band_marks(bands: tuple[Band, ...], y: float) -> list[str]:
    parts, last = [], -math.inf
    for band in bands:
        x = _LEFT + band.place * (_WIDTH - _LEFT)
        parts.append(f'<path class="grid" d="M{x:.1f} {y}v5"/>')
        if x - last > 62:  # else it would cover the name before
            parts.append(_text(x, y + 18, band.name, "middle"))
            last = x
    return parts


def _histograms(histograms: tuple[np.ndarray, np.ndarray], base: float) -> list[str]:
    step = (_WIDTH - _LEFT) / HUE_BINS
    scale = _BARS / max(float(np.max(histograms)), 1e-9)
    parts = []
    for i, share in enumerate(histograms[0]):
        hue = 2 * math.pi * (i + 0.5) / HUE_BINS
        colour = _colour(0.2 * math.cos(hue), 0.2 * math.sin(hue))
        height = share * scale
        parts.append(_rect(_LEFT + i * step, base - height, step - 1, height, colour))
    line = " ".join(
        f"{_LEFT + (i + side) * step:.1f},{base - share * scale:.1f}"
        for i, share in enumerate(histograms[1])
        for side in (0, 1)
    )
    parts.append(f'<polyline class="outline" points="{line}"/>')
    for degrees in range(0, 361, 60):
        x = _LEFT + degrees / 360 * (_WIDTH - _LEFT)
        parts.append(_text(x, base + 20, f"{degrees}°", "end" if degrees == 360 else "middle"))
    return parts


def _colour(a: float, b: float) -> str:
    """Of chroma as a share of the lightness, moved towards grey until a screen can show it."""
    for strength in np.linspace(1.0, 0.0, 21):
        lab = _LIGHTNESS * np.array([1.0, strength * a, strength * b])
        linear = from_oklab(lab)
        if linear.min() >= -1e-6 and linear.max() <= 1.0:
            break
    return "#" + "".join(f"{round(value * 255):02x}" for value in srgb.encode(linear.clip(0, 1)))


def _rect(x: float, y: float, width: float, height: float, colour: str) -> str:
    place = f'x="{x:.1f}" y="{y:.1f}" width="{width:.1f}" height="{height:.1f}"'
    return f'<rect {place} fill="{colour}"/>'


def _text(x: float, y: float, text: str, anchor: str = "start") -> str:
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}">{text}</text>'
