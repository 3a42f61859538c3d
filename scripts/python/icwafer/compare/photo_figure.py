# SPDX-License-Identifier: GPL-2.0-or-later
"""A photograph and a render for the eye: pictures, words and charts for the page."""

from __future__ import annotations

import html
import math

import numpy as np

from icwafer.compare import rectify, srgb
from icwafer.compare.hues import HUE_BINS, Band, HueComparison, from_oklab
from icwafer.compare.photo import Corners, PhotoComparison
from icwafer.compare.rectify import Point
from icwafer.report import encode

_WIDTH, _LEFT = 960, 90
_STRIP, _BARS = 34, 150
#: Hues are drawn at one lightness, so that brightness, which is not compared, does not distract.
_LIGHTNESS = 0.72


#: What the page says at its top.
INTRODUCTION = (
    "The part between the four corners of both pictures, without perspective, at one mean "
    "brightness. Camera, white balance and lamp of a photograph are unknown: judge the order, the "
    "place and the softness of the colours, not how bright or how rich they are."
)
_SIDE = 480  # of the whole pictures
_BEST = "The render's bands lie best on the photograph's ({:+.3f}) when they are moved by {:+.2f} "


def section(found: PhotoComparison, names: tuple[str, str]) -> str:
    """HTML: what was compared, the result in words, where the bands are, and the figures."""
    hue = found.hues
    wholes = "".join(
        _whole(picture, corners, found.line, name)
        for picture, corners, name in zip(found.pictures, found.corners, names)
    )
    words = [
        f"Hues are {hue.hue_distance_deg:.1f}° apart on average (0° the same, 180° opposite), "
        f"saturations {hue.saturation_distance:.3f} (chroma over lightness, OKLab).",
        f"Along the line, from dot to ring, the colours correlate by {hue.profile_correlation:+.3f} "
        "(1 equal bands, 0 none).",
        _BEST.format(hue.best_correlation, hue.shift)
        + f"of the line and stretched {hue.stretch:.2f} times.",
        f"The render's light was multiplied by {found.gain:.4g}. View transform: {found.view.name}.",
    ]
    items = "".join(f"<li>{html.escape(word)}" for word in words)
    return (
        f'<div class="wholes">{wholes}</div><ul class="words">{items}</ul>'
        f"{_band_table(hue, names)}{svg(hue, names)}"
    )


def _whole(picture: np.ndarray, corners: Corners, line: tuple[Point, Point], name: str) -> str:
    """A whole picture, small, with the part that is compared and the line in it."""
    height, width = picture.shape[:2]
    outline = " ".join(f"{x:.1f},{y:.1f}" for x, y in corners)
    (x1, y1), (x2, y2) = (rectify.from_unit(corners, point) for point in line)
    unit = width / 200
    return (
        f'<figure><svg viewBox="0 0 {width} {height}" role="img" aria-label="{html.escape(name)}, '
        f'and the part of it that is compared" stroke-width="{unit:.2f}">'
        f'<image href="{encode.thumbnail(picture, _SIDE)}" width="{width}" height="{height}"/>'
        f'<polygon points="{outline}"/><path d="M{x1:.1f} {y1:.1f}L{x2:.1f} {y2:.1f}"/>'
        f'<circle class="first" cx="{x1:.1f}" cy="{y1:.1f}" r="{2 * unit:.1f}"/>'
        f'<circle cx="{x2:.1f}" cy="{y2:.1f}" r="{2 * unit:.1f}"/></svg>'
        f"<figcaption>{html.escape(name)}</figcaption></figure>"
    )


def _band_table(found: HueComparison, names: tuple[str, str]) -> str:
    """Where each hue is passed, in the order of the photograph; empty where there is none."""
    of_photo, of_render = (profile.bands for profile in found.profiles)
    rows = []
    left = list(of_render)
    for band in of_photo:
        same = [other for other in left if other.name == band.name]
        nearest = min(same, key=lambda other: abs(other.place - band.place), default=None)
        if nearest:
            left.remove(nearest)
        apart = f"{nearest.place - band.place:+.2f}".replace("-", "−") if nearest else ""
        rows.append((band.place, band.name, f"{band.place:.2f}", _place(nearest), apart))
    rows += [(band.place, band.name, "", _place(band), "") for band in left]
    cells = "".join(
        f'<tr><th scope="row">{name}</th><td>{first}</td><td>{second}</td><td>{apart}</td></tr>'
        for _, name, first, second, apart in sorted(rows)
    )
    heads = "".join(f'<th scope="col">{text}</th>' for text in ("Hue", *names, "moved by"))
    return f'<table class="bands"><tr>{heads}</tr>{cells}</table>' if rows else ""


def _place(band: Band | None) -> str:
    return f"{band.place:.2f}" if band else "none"


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
