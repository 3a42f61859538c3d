# SPDX-License-Identifier: GPL-2.0-or-later
"""Images as arrays, through OpenImageIO, and two of them made comparable."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import OpenImageIO as oiio

from icwafer.errors import InputError
from icwafer.suggest import unknown

#: Formats whose values are scene-linear; all others are as a screen shows them.
LINEAR_FORMATS = ("openexr", "hdr")


@dataclass(frozen=True)
class Image:
    """An image file's colours.

    pixels: height x width x 3, float32, row 0 at the top, as stored; no value is NaN or infinite.
    linear: scene-linear values, else encoded for a screen, 0 to 1.
    bad: height x width, True where the file has a value that is NaN or infinite; 0 in `pixels`.
    notes: what had to be decided to read it, a sentence each.
    """

    path: Path
    pixels: np.ndarray
    linear: bool
    bad: np.ndarray
    notes: tuple[str, ...] = ()

    @property
    def size(self) -> tuple[int, int]:
        """Width and height in pixels."""
        return self.pixels.shape[1], self.pixels.shape[0]


def read(path: Path, layer: str | None = None) -> Image:
    """Reads an image file of any format of OpenImageIO's.

    layer: of an EXR, as "ViewLayer.Combined" or the name of a part; without it the first layer
    with colours. A single channel counts as grey; alpha is left out, as over black.

    Raises InputError where the file, the layer or its channels are not there.
    """
    if not path.is_file():
        raise InputError(f"{path}: no such file; name an image")
    file = oiio.ImageInput.open(str(path))
    if file is None:
        raise InputError(f"{path}: not an image that can be read ({_reason()}); give another one")
    try:
        subimage, channels, notes = _choose(path, _channels_by_layer(file), layer)
        file.seek_subimage(subimage, 0)
        linear = file.format_name() in LINEAR_FORMATS
        pixels = file.read_image(subimage, 0, min(channels), max(channels) + 1, oiio.FLOAT)
        if pixels is None:
            raise InputError(f"{path}: damaged ({file.geterror()}); make it anew")
    finally:
        file.close()
    pixels = np.atleast_3d(pixels)[..., [channel - min(channels) for channel in channels]]
    bad = ~np.isfinite(pixels).all(axis=-1)
    return Image(path, np.where(bad[..., None], np.float32(0), pixels), linear, bad, notes)


def layer_if_there(path: Path, layer: str) -> str | None:
    """The layer's name if a file has it, else None."""
    file = oiio.ImageInput.open(str(path)) if path.is_file() else None
    if file is None:
        return None
    found = _channels_by_layer(file)
    file.close()
    return layer if layer in found else None


def same_size(first: Image, second: Image, fit: bool) -> tuple[Image, Image]:
    """Both at one size: with `fit` the larger one is resampled to the smaller one's.

    Raises InputError without `fit` when they differ, and with it when their shapes do.
    """
    if first.size == second.size:
        return first, second
    sizes = f"{first.path} is {_times(first)}, {second.path} is {_times(second)}"
    if not fit:
        raise InputError(f"{sizes}; render both at one size, or resample with --fit")
    (w1, h1), (w2, h2) = first.size, second.size
    if abs(w1 * h2 - w2 * h1) > max(w1, w2, h1, h2):  # a pixel's rounding is no other shape
        raise InputError(f"{sizes}: another shape; crop one of them")
    smaller = min(first.size, second.size)
    return resized(first, smaller), resized(second, smaller)


def resized(image: Image, size: tuple[int, int]) -> Image:
    """Resampled to another width and height by OpenImageIO's filter for the purpose.

    Encoded values are resampled as they are, as image viewers do.
    """
    if image.size == size:
        return image
    roi = oiio.ROI(0, size[0], 0, size[1])
    pixels = oiio.ImageBufAlgo.resize(to_buffer(image.pixels), roi=roi).get_pixels(oiio.FLOAT)
    bad = oiio.ImageBufAlgo.resize(to_buffer(image.bad.astype(np.float32)[..., None]), roi=roi)
    note = f"{image.path.name} was resampled from {_times(image)} to {size[0]}x{size[1]}."
    return replace(
        image,
        pixels=pixels,
        bad=bad.get_pixels(oiio.FLOAT)[..., 0] > 1e-3,
        notes=(*image.notes, note),
    )


def to_buffer(pixels: np.ndarray) -> oiio.ImageBuf:
    """An OpenImageIO image of an array of height x width x channels."""
    return oiio.ImageBuf(np.ascontiguousarray(pixels, dtype=np.float32))


def _times(image: Image) -> str:
    return "{}x{}".format(*image.size)


def _reason() -> str:
    lines = oiio.geterror().splitlines()
    return lines[0] if lines else "unknown format"


def _channels_by_layer(file: oiio.ImageInput) -> dict[str, tuple[int, dict[str, int]]]:
    """For each layer, its part of the file and the index of each of its channels there."""
    layers: dict[str, tuple[int, dict[str, int]]] = {}
    part = 0
    while file.seek_subimage(part, 0):
        spec = file.spec()
        name = spec.get_string_attribute("oiio:subimagename") if part else ""
        for index, channel in enumerate(spec.channelnames):
            layer, _, letter = channel.rpartition(".")
            layers.setdefault(layer or name, (part, {}))[1].setdefault(letter, index)
        part += 1
    return layers


def _choose(
    path: Path, layers: dict[str, tuple[int, dict[str, int]]], layer: str | None
) -> tuple[int, list[int], tuple[str, ...]]:
    """Part, the three channels' indices and what there is to say about them."""
    coloured = {
        name: (part, [letters[letter] for letter in "RGB"])
        for name, (part, letters) in layers.items()
        if all(letter in letters for letter in "RGB")
    }
    grey = {
        name: (part, [letters[letter]] * 3)
        for name, (part, letters) in layers.items()
        for letter in ("Y", "I", "V", "Z")
        if letter in letters and name not in coloured
    }
    usable = coloured | grey
    if not usable:
        every = ", ".join(sorted({letter for _, found in layers.values() for letter in found}))
        raise InputError(f"{path}: no channels R, G, B, only {every}; render with colours")
    if layer is None:
        layer = next(iter(usable))
    elif layer not in usable:
        raise InputError(f"{path}: {unknown('layer', layer, usable)}")
    part, channels = usable[layer]
    notes = [f"{path.name}: layer '{layer}' of {len(usable)}."] if len(usable) > 1 else []
    if layer in grey:
        notes.append(f"{path.name} has one channel; it counts as grey.")
    return part, channels, tuple(notes)
