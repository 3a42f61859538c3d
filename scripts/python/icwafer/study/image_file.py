# SPDX-License-Identifier: GPL-2.0-or-later
"""Image files with metadata that says what made them, and how to make them again.

Everything goes through OpenImageIO, and is read again: a full disk is noticed.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import OpenImageIO as oiio

from icwafer.errors import DiskFull, IcwaferError

#: All our attributes begin with this.
PREFIX = "icwafer:"
#: What Blender writes that differs each time, or says where a file happened to be.
_FLEETING = ("Date", "capDate", "File", "RenderTime", "Time", "Hostname", "Memory", "Software")
#: The time that EXIF calls unknown: without one OpenImageIO notes the present time.
_UNKNOWN_TIME = "0000:00:00 00:00:00"
_TYPES = {".exr": oiio.HALF, ".png": oiio.UINT8}


def copy(source: Path, target: Path, attributes: Mapping[str, str] | None = None) -> None:
    """Copies an image, with these of our attributes (their names without `PREFIX`) and no others.

    The same pixels and attributes give the same bytes: times and places that Blender notes are
    left out. Raises DiskFull where there is no room for the file.
    """
    kind = _TYPES[target.suffix]
    image = oiio.ImageBuf(str(source))
    pixels = image.get_pixels(kind)
    spec = image.specmod()
    for name in [attribute.name for attribute in spec.extra_attribs]:
        if name in _FLEETING or name.endswith("_time") or name.startswith(PREFIX):
            spec.erase_attribute(name)
    spec.attribute("DateTime", _UNKNOWN_TIME)
    for name, value in (attributes or {}).items():
        spec.attribute(f"{PREFIX}{name}", value)
    image.write(str(target), kind)
    again = oiio.ImageBuf(str(target)).get_pixels(kind)
    # Bytes, for a pixel that is no number equals nothing.
    if oiio.geterror() or again is None or again.tobytes() != pixels.tobytes():
        raise DiskFull(f"disk full, or a limit on files: cannot write {target}; make room")


def attributes(path: Path) -> dict[str, str]:
    """Our attributes of an image, without `PREFIX`. Raises IcwaferError where there is none."""
    file = oiio.ImageInput.open(str(path))
    if file is None:
        raise IcwaferError(f"{path}: {oiio.geterror() or 'cannot be read'}")
    found = file.spec().extra_attribs
    return {a.name.removeprefix(PREFIX): a.value for a in found if a.name.startswith(PREFIX)}
