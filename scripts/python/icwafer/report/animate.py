# SPDX-License-Identifier: GPL-2.0-or-later
"""The subcommand `icwafer animate`: a sweep as a moving picture, and how smoothly it moves."""

from __future__ import annotations

import argparse
import io
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from icwafer.errors import IcwaferError
from icwafer.files import replacing
from icwafer.suggest import unknown

if TYPE_CHECKING:
    import numpy as np

    from icwafer.report.study import Axis, Job, Study

_FORMATS = (".webp", ".gif")
_GAP_PX = 4


@dataclass(frozen=True)
class Movement:
    """What changes from one frame to the next, and between the panels of each frame.

    Per frame, the first left out: luminance, the larger of its mean's ratio to that of the frame
    before and the inverse; flip, the mean FLIP to it. Per frame: beside, the mean FLIP of the first
    two panels, empty where there is one.
    """

    luminance: tuple[float, ...]
    flip: tuple[float, ...]
    beside: tuple[float, ...]


def register(add: Callable[[str, str], argparse.ArgumentParser]) -> None:
    """Adds the subcommand; `add` makes a parser of a name and a help text."""
    parser = add("animate", "a rendered study's sweep as a moving picture, WebP or GIF")
    parser.add_argument("folder", type=Path, metavar="DIR", help="what icwafer render wrote")
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="FILE.webp")
    parser.add_argument("--over", required=True, metavar="AXIS", help="a frame for each value")
    parser.add_argument("--beside", metavar="AXIS", help="its values side by side in each frame")
    parser.add_argument("--ms", type=int, default=110, metavar="N", help="a frame lasts (110)")
    parser.add_argument(
        "--quality", type=int, default=80, metavar="N", help="1 to 100, of WebP (80)"
    )
    parser.set_defaults(run=_run)


def _run(arguments: argparse.Namespace) -> int:
    from icwafer import packages

    packages.install("images")
    from icwafer.report import study

    if arguments.output.suffix not in _FORMATS:
        raise IcwaferError(
            f"{arguments.output}: name a file that ends with {' or '.join(_FORMATS)}"
        )
    loaded = study.load(arguments.folder)
    over = _axis(loaded, arguments.over)
    beside = _axis(loaded, arguments.beside) if arguments.beside else None
    frames = panels(loaded, over, beside)
    found = movement(frames)
    write(arguments.output, labelled(frames, over, beside), arguments.ms, arguments.quality)
    print(f"{arguments.output}: {len(frames)} frames")
    for name, values in (("mean luminance", found.luminance), ("mean FLIP", found.flip)):
        print(f"{name} from frame to frame: {_middle(values):.3f} in the middle, "
              f"{max(values):.3f} at most, to {over.name} "
              f"{over.values[values.index(max(values)) + 1]} {over.unit}")  # fmt: skip
    if found.beside:
        print(f"mean FLIP between the first two of {beside.name}: {found.beside[0]:.3f} in the first "
              f"frame, {found.beside[-1]:.3f} in the last")  # fmt: skip
    return 0


def _middle(values: Sequence[float]) -> float:
    return sorted(values)[len(values) // 2]


def _axis(study: Study, name: str) -> Axis:
    axes = {axis.name: axis for axis in study.axes}
    if name not in axes:
        raise IcwaferError(f"{study.name}: {unknown('axis', name, axes)}")
    return axes[name]


def panels(study: Study, over: Axis, beside: Axis | None) -> list[list[np.ndarray]]:
    """The frames; each has its panels, height x width x 3, as a screen shows them.

    Other axes keep their first value. Raises IcwaferError for a job without a picture.
    """
    if len(over.values) < 2:
        raise IcwaferError(f"{study.name}: {over.name} has one value; animate a longer axis")
    fixed = {axis.name: axis.values[0] for axis in study.axes}
    jobs = {_key(job.settings): job for job in study.jobs}
    return [
        [
            _shown(study, jobs.get(_key(fixed | {over.name: value} | other)))
            for other in ([{beside.name: v} for v in beside.values] if beside else [{}])
        ]
        for value in over.values
    ]


def _key(settings: dict[str, Any]) -> tuple[tuple[str, str], ...]:
    return tuple(sorted((name, repr(value)) for name, value in settings.items()))


def _shown(study: Study, job: Job | None) -> np.ndarray:
    from icwafer.compare import images
    from icwafer.compare.colour import view_transform

    if job is None or job.image is None:
        raise IcwaferError(f"{study.name}: {job.id if job else 'a job'} has no picture; render it")
    image = images.read(job.image)
    view = view_transform(None, job.view, job.look)
    return view.encode(image.pixels) if image.linear else image.pixels


def movement(frames: Sequence[Sequence[np.ndarray]]) -> Movement:
    """How the first panel moves, in what a screen shows, and how far the second is from it."""
    import numpy as np

    from icwafer.compare import flip, srgb

    ppd = flip.DEFAULT_PIXELS_PER_DEGREE
    firsts = [frame[0] for frame in frames]
    means = [float((srgb.decode(first) @ srgb.LUMINANCE).mean()) for first in firsts]
    pairs = list(zip(firsts, firsts[1:]))
    return Movement(
        luminance=tuple(float(np.exp(abs(np.log(b / a)))) for a, b in zip(means, means[1:])),
        flip=tuple(float(flip.ldr(a, b, ppd).mean()) for a, b in pairs),
        beside=tuple(float(flip.ldr(f[0], f[1], ppd).mean()) for f in frames if len(f) > 1),
    )


def labelled(
    frames: Sequence[Sequence[np.ndarray]], over: Axis, beside: Axis | None
) -> list[np.ndarray]:
    """Frames of one picture each, 8 bit: panels side by side under their values."""
    import numpy as np
    import OpenImageIO as oiio

    from icwafer.compare.images import to_buffer

    made = []
    for value, parts in zip(over.values, frames):
        height, width = parts[0].shape[:2]
        gap = np.zeros((height, _GAP_PX, 3))
        row = np.concatenate([p for part in parts for p in (part, gap)][:-1], axis=1)
        picture = to_buffer(row)
        texts = [str(v) for v in beside.values] if beside else [""]
        texts[0] = f"{texts[0]}   {over.name} {value} {over.unit}".strip()
        for index, text in enumerate(texts):
            oiio.ImageBufAlgo.render_text(
                picture, index * (width + _GAP_PX) + 8, 20, text, 14, "DejaVuSans", (1, 1, 1),
                shadow=2,
            )  # fmt: skip
        made.append(np.round(picture.get_pixels(oiio.FLOAT).clip(0, 1) * 255).astype(np.uint8))
    return made


def write(path: Path, frames: Sequence[np.ndarray], ms: int, quality: int) -> None:
    """There and back, without an end; the last frame at each side stays for a while."""
    from PIL import Image

    pictures = [Image.fromarray(frame) for frame in frames]
    pictures += pictures[-2:0:-1]
    times = [ms] * len(pictures)
    times[0] = times[len(frames) - 1] = 6 * ms
    data = io.BytesIO()
    pictures[0].save(
        data, path.suffix[1:].upper(), save_all=True, append_images=pictures[1:], duration=times,
        loop=0, quality=quality, method=6,
    )  # fmt: skip
    with replacing(path) as unfinished:
        unfinished.write_bytes(data.getvalue())
