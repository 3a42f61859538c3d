# SPDX-License-Identifier: GPL-2.0-or-later
"""A render against a photograph: both without perspective, colours compared and side by side.

The photograph's camera, lens, white balance and lamp are usually unknown. So brightness is made
equal, and what counts is the order and the place of the hues.
"""

from __future__ import annotations

import contextlib
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import OpenImageIO as oiio

from icwafer.compare import hues, images, rectify, srgb
from icwafer.compare.colour import ViewTransform
from icwafer.compare.hues import HueComparison
from icwafer.compare.rectify import Point
from icwafer.errors import InputError

Corners = tuple[Point, Point, Point, Point]


@dataclass(frozen=True)
class PhotoComparison:
    """Both pictures as rectangles of linear Rec.709, the render's brightness made the photo's.

    gain: by which the render's light was multiplied for that. pictures: both as a screen shows
    them, whole, and corners: of the die in each. line: in shares of the die's width and height.
    """

    photo: np.ndarray
    render: np.ndarray
    photo_path: Path
    render_path: Path
    view: ViewTransform
    gain: float
    hues: HueComparison
    pictures: tuple[np.ndarray, np.ndarray]
    corners: tuple[Corners, Corners]
    line: tuple[Point, Point]


def compare(
    photo: Path,
    corners: Corners,
    render: Path,
    render_corners: Corners | None,
    line: tuple[Point, Point],
    view: ViewTransform,
    layer: str | None = None,
) -> PhotoComparison:
    """Compares a die in a photograph with a render, or the part of it inside `render_corners`.

    A scene-linear render is shown through `view` first, as the photograph went through a camera's
    curve. Raises InputError for corners and files that cannot be used.
    """
    pictured, rendered = images.read(photo), images.read(render, layer)
    if pictured.linear:
        raise InputError(f"{photo} is scene-linear; a photograph is a JPEG, PNG or TIFF")
    size = rectify.natural_size(corners)
    shown = view.encode(rendered.pixels) if rendered.linear else rendered.pixels
    width, height = rendered.size
    if render_corners is None:
        render_corners = ((0.0, 0.0), (width, 0.0), (width, height), (0.0, height))
    flat_photo = rectify.rectify(srgb.decode(pictured.pixels), corners, size)
    flat_render = rectify.rectify(srgb.decode(shown), render_corners, size)
    light = [float((flat @ srgb.LUMINANCE).mean()) for flat in (flat_photo, flat_render)]
    for path, mean in zip((photo, render), light):
        if mean <= 0.0:
            raise InputError(f"{path} is black between the corners; give others")
    return PhotoComparison(
        photo=flat_photo,
        render=flat_render * (light[0] / light[1]),
        photo_path=photo,
        render_path=render,
        view=view,
        gain=light[0] / light[1],
        hues=hues.compare(flat_photo, flat_render, line),
        pictures=(pictured.pixels, shown),
        corners=(corners, render_corners),
        line=line,
    )


def failures(
    found: PhotoComparison, hue_deg: float | None, correlation: float | None
) -> list[str]:
    """Which thresholds are passed, a line each."""
    passed = []
    if hue_deg is not None and found.hues.hue_distance_deg > hue_deg:
        passed.append(f"hue distance {found.hues.hue_distance_deg:.1f} > {hue_deg:g} degrees")
    if correlation is not None and found.hues.profile_correlation < correlation:
        passed.append(f"correlation {found.hues.profile_correlation:.3f} < {correlation:g}")
    return passed


def described(found: PhotoComparison) -> list[str]:
    """The result in lines."""
    hue = found.hues
    height, width = found.photo.shape[:2]
    return [
        f"photo       {found.photo_path}, rectified to {width}x{height}",
        f"render      {found.render_path}, brightness times {found.gain:.4g}",
        f"view        {found.view}",
        f"hues        {hue.hue_distance_deg:.1f} degrees apart (0 one distribution, 180 opposite)",
        f"saturation  {hue.saturation_distance:.4f} apart (chroma over lightness, OKLab)",
        f"bands       correlation {hue.profile_correlation:+.3f} along the line; at best "
        f"{hue.best_correlation:+.3f}, the render moved by {hue.shift:+.2f} of the line and "
        f"stretched {hue.stretch:.2f} times",
        *(
            f"  {name:9} " + ", ".join(f"{band.name} {band.place:.2f}" for band in profile.bands)
            for name, profile in zip(("photo", "render"), hue.profiles)
        ),
    ]


def as_json(found: PhotoComparison, passed: list[str]) -> dict[str, object]:
    """The result for a script."""
    hue = found.hues

    def side(index: int) -> dict[str, object]:
        profile = hue.profiles[index]
        return {
            "hue_histogram": hue.hue_histograms[index].tolist(),
            "saturation_histogram": hue.saturation_histograms[index].tolist(),
            "profile": {"place": profile.place.tolist(), "chroma_ab": profile.chroma.tolist()},
            "bands": [vars(band) for band in profile.bands],
        }

    return {
        "photo": {"path": str(found.photo_path), **side(0)},
        "render": {"path": str(found.render_path), **side(1)},
        "view_transform": str(found.view),
        "gain": found.gain,
        "hue_distance_deg": hue.hue_distance_deg,
        "saturation_distance": hue.saturation_distance,
        "profile_correlation": hue.profile_correlation,
        "best": {
            "correlation": hue.best_correlation, "shift": hue.shift, "stretch": hue.stretch,
        },
        "equal": not passed,
        "failures": passed,
    }  # fmt: skip


@contextlib.contextmanager
def as_files(found: PhotoComparison) -> Iterator[tuple[Path, Path]]:
    """The two rectangles as PNG files, for as long as the context lasts."""
    with tempfile.TemporaryDirectory() as folder:
        paths = (
            Path(folder) / f"{found.photo_path.stem}-rectified.png",
            Path(folder) / f"{found.render_path.stem}-rectified.png",
        )
        for path, linear in zip(paths, (found.photo, found.render)):
            buffer = images.to_buffer(np.clip(srgb.encode(np.maximum(linear, 0.0)), 0.0, 1.0))
            buffer.set_write_format(oiio.UINT8)
            if not buffer.write(str(path)):
                raise InputError(f"{path}: cannot be written ({buffer.geterror()}); mend this")
        yield paths
