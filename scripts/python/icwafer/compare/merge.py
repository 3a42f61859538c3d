# SPDX-License-Identifier: GPL-2.0-or-later
"""The subcommand `icwafer merge`: renders of one scene become one, with its variance."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from icwafer.errors import IcwaferError, InputError
from icwafer.files import replacing

if TYPE_CHECKING:
    import numpy as np

#: The layer of an EXR that `icwafer compare --variance` looks for.
VARIANCE = "Variance"


def register(add: Callable[[str, str], argparse.ArgumentParser]) -> None:
    """Adds the subcommand; `add` makes a parser of a name and a help text."""
    parser = add("merge", "average renders of one scene with different seeds; notes the variance")
    parser.add_argument("renders", type=Path, nargs="+", metavar="RENDER.exr")
    parser.add_argument(
        "-o", "--output", type=Path, required=True, metavar="FILE.exr",
        help=f"with the layer {VARIANCE}, for icwafer compare --variance",
    )  # fmt: skip
    parser.add_argument("--layer", metavar="NAME", help="of the renders, as ViewLayer.Combined")
    parser.set_defaults(run=_run)


def _run(arguments: argparse.Namespace) -> int:
    from icwafer import packages

    packages.install("images")
    mean, variance = merge(arguments.renders, arguments.layer)
    write(arguments.output, mean, variance)
    print(f"{arguments.output}: {len(arguments.renders)} renders")
    return 0


def merge(renders: Sequence[Path], layer: str | None = None) -> tuple[np.ndarray, np.ndarray]:
    """Mean of some renders and the variance of that mean; both height x width x 3.

    The variance is estimated from the renders' differences, with one degree of freedom less than
    there are renders. Raises InputError for fewer than two, other than scene-linear ones, and
    sizes that differ.
    """
    import numpy as np

    from icwafer.compare import images

    if len(renders) < 2:
        raise InputError("one render has no variance to be seen; name two or more")
    first = images.read(renders[0], layer)
    mean = np.zeros(first.pixels.shape)
    squares = np.zeros(first.pixels.shape)
    for count, path in enumerate(renders, 1):
        image = images.read(path, layer)
        if not image.linear:
            raise InputError(f"{path}: is not scene-linear; name EXRs")
        if image.size != first.size:
            raise InputError(f"{path} has another size than {first.path}; render them alike")
        if image.bad.any():
            raise InputError(f"{path}: has {image.bad.sum()} pixels that are NaN or infinite")
        # Welford's recurrence: no cancellation.
        step = image.pixels - mean
        mean += step / count
        squares += step * (image.pixels - mean)
    return mean, squares / (len(renders) - 1) / len(renders)


def write(path: Path, mean: np.ndarray, variance: np.ndarray) -> None:
    """Writes both to one EXR, the variance as the layer `VARIANCE`."""
    import numpy as np
    import OpenImageIO as oiio

    height, width = mean.shape[:2]
    spec = oiio.ImageSpec(width, height, 6, oiio.FLOAT)
    spec.channelnames = (*"RGB", *(f"{VARIANCE}.{letter}" for letter in "RGB"))
    image = oiio.ImageBuf(spec)
    pixels = np.concatenate([mean, variance], axis=-1).astype(np.float32)
    image.set_pixels(oiio.ROI(), pixels)
    with replacing(path) as unfinished:
        if not image.write(str(unfinished)):
            raise IcwaferError(f"{path}: cannot be written ({image.geterror()}); mend this")
