# SPDX-License-Identifier: GPL-2.0-or-later
"""The pictures that the repository keeps, small enough for it."""

from __future__ import annotations

from pathlib import Path

from icwafer import paths
from icwafer.errors import IcwaferError
from icwafer.files import replacing
from icwafer.pictures.model import Picture

#: Larger pictures, in pixels, are kept as JPEG: as PNG, noise and all, they take five times the
#: space.
LARGEST_PNG = 1_000_000
#: Next to a PNG no eye tells the two apart, because colours keep the full resolution too: a wire
#: is a pixel or two wide, and differs from its neighbour in nothing but colour.
_QUALITY = 92


def kept_path(name: str, picture: Picture) -> Path:
    """Where the repository keeps a picture of `PICTURES`."""
    width, height = picture.render.size
    ending = ".png" if width * height <= LARGEST_PNG else ".jpg"
    return paths.REPOSITORY / "blend_assets" / "pictures" / f"{name}{ending}"


def copy_picture(png: Path, path: Path) -> None:
    """Writes the pixels of a PNG, and nothing that changes from render to render, as .png or .jpg.

    The file appears complete or not at all. Raises IcwaferError.
    """
    import OpenImageIO as oiio

    picture = oiio.ImageBuf(str(png))
    plain = oiio.ImageBuf(
        oiio.ImageSpec(picture.spec().width, picture.spec().height, 3, oiio.UINT8)
    )
    plain.specmod().attribute("Compression", f"jpeg:{_QUALITY}")
    plain.specmod().attribute("jpeg:subsampling", "4:4:4")
    plain.copy_pixels(picture)
    with replacing(path) as unfinished:
        if plain.has_error or not plain.write(str(unfinished)):
            reason = " ".join(plain.geterror().split())
            raise IcwaferError(f"cannot write {path}: {reason}; choose another folder")
