# SPDX-License-Identifier: GPL-2.0-or-later
"""Metadata of EXR files, through OpenImageIO: what made an image, and how to make it again."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np
import OpenImageIO as oiio

from icwafer.errors import DiskFull, IcwaferError

#: All our attributes begin with this.
PREFIX = "icwafer:"
#: What Blender writes that differs each time, or says where a file happened to be.
_FLEETING = ("Date", "File", "RenderTime", "Time", "Hostname", "Memory")


def add_attributes(source: Path, target: Path, attributes: Mapping[str, str]) -> None:
    """Copies an EXR file, with attributes added (their names without `PREFIX`).

    The same pixels and attributes give the same bytes: times and places that Blender notes are
    left out. Raises DiskFull where the disk is full.
    """
    image = oiio.ImageBuf(str(source))
    pixels = image.get_pixels(oiio.HALF)
    spec = image.specmod()
    for attribute in list(spec.extra_attribs):
        if attribute.name in _FLEETING or attribute.name.endswith("_time"):
            spec.erase_attribute(attribute.name)
    for name, value in attributes.items():
        spec.attribute(f"{PREFIX}{name}", value)
    written = image.write(str(target), oiio.HALF)
    if not written or not _is_whole(target, pixels):
        raise DiskFull(f"disk full, or a limit on files: cannot write {target}; make room")


def expect_complete(path: Path) -> None:
    """Raises DiskFull unless all pixels of an image can be read."""
    if oiio.ImageBuf(str(path)).get_pixels(oiio.UINT8) is None or oiio.geterror():
        raise DiskFull(f"disk full, or a limit on files: cannot write {path}; make room")


def attributes(path: Path) -> dict[str, str]:
    """Our attributes of an image, without `PREFIX`. Raises IcwaferError where it cannot be read."""
    file = oiio.ImageInput.open(str(path))
    if file is None:
        raise IcwaferError(f"{path}: {oiio.geterror() or 'cannot be read'}")
    found = file.spec().extra_attribs
    return {a.name.removeprefix(PREFIX): a.value for a in found if a.name.startswith(PREFIX)}


def _is_whole(path: Path, pixels: np.ndarray) -> bool:
    """Whether the file has these pixels; writing to a full disk does not always say so."""
    again = oiio.ImageBuf(str(path)).get_pixels(oiio.HALF)
    return not oiio.geterror() and again.shape == pixels.shape and bool((again == pixels).all())
