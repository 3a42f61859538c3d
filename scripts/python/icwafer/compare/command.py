# SPDX-License-Identifier: GPL-2.0-or-later
"""The subcommand `icwafer compare`."""

from __future__ import annotations

import argparse
import json
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from icwafer.compare.measures import MEASURES
from icwafer.errors import IcwaferError, InputError
from icwafer.files import replacing
from icwafer.report.command import add_view_options

if TYPE_CHECKING:
    from icwafer.compare.comparison import Comparison

_EPILOG = """\
exit status:
  0  equal: within all thresholds and, with --noise, --second or --variance, not different beyond
     the noise; with none of these, equal in every pixel
  1  different; the reasons are printed, one a line, after "different:"
  2  bad input, one line on stderr
Pixels that are NaN or infinite always make a difference. EXR and Radiance files hold scene-linear
values and are compared as such; other files, and one of each kind, as a screen shows them. FLIP
and Yee always judge what the screen shows, through the view transform that the result names.

against a photograph:
  icwafer compare --photo PHOTO --corners X,Y X,Y X,Y X,Y RENDER
  The corners are the die's top left, top right, bottom right and bottom left, in pixels from the
  photograph's top left corner (the page of icwafer report prints them when they are clicked).
  Status 0 unless a --fail-hue or --fail-bands threshold is passed.
"""


def register(add: Callable[[str, str], argparse.ArgumentParser]) -> None:
    """Adds the subcommand; `add` makes a parser of a name and a help text."""
    parser = add("compare", "compare two images, or a render with a photograph")
    parser.epilog = _EPILOG
    parser.formatter_class = argparse.RawDescriptionHelpFormatter
    parser.add_argument(
        "images", type=Path, nargs="+", metavar="IMAGE", help="A (the reference) B"
    )
    parser.add_argument("--layer", metavar="NAME", help="of an EXR, as ViewLayer.Combined")
    parser.add_argument(
        "--fit", action="store_true", help="resample the larger image to the smaller one's size"
    )
    parser.add_argument("--flip", action="store_true", help="also FLIP and, of EXRs, HDR-FLIP")
    parser.add_argument(
        "--noise",
        action="store_true",
        help="test whether the difference is more than the noise of two renders",
    )
    parser.add_argument(
        "--second",
        type=Path,
        nargs=2,
        metavar=("A2", "B2"),
        help="renders of the same two scenes with other seeds: makes --noise sharper and measures "
        "the noise",
    )
    parser.add_argument(
        "--variance",
        type=Path,
        nargs=2,
        metavar=("VA", "VB"),
        help="EXRs of the variance of each pixel's mean in A and in B, such as icwafer merge "
        "writes: --noise with one render each, of any numbers of samples",
    )
    parser.add_argument(
        "--variance-layer", metavar="NAME", help="of VA and VB (Variance, if they have it)"
    )
    parser.add_argument(
        "--level", type=float, default=0.01, metavar="P", help="of false alarms of --noise (0.01)"
    )
    for name, meaning in MEASURES.items():
        parser.add_argument(f"--fail-{name}", type=float, metavar="X", help=f"status 1: {meaning}")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the result there")
    parser.add_argument("--html", type=Path, metavar="FILE", help="write a page to compare by eye")
    add_view_options(parser)
    photo = parser.add_argument_group("photograph")
    photo.add_argument("--photo", type=Path, metavar="FILE", help="compare IMAGE with it")
    photo.add_argument(
        "--corners", type=_point, nargs=4, metavar="X,Y", help="of the die in the photograph"
    )
    photo.add_argument(
        "--render-corners", type=_point, nargs=4, metavar="X,Y", help="in IMAGE; else all of it"
    )
    photo.add_argument(
        "--profile",
        type=_point,
        nargs=2,
        default=[(0.5, 0.0), (0.5, 1.0)],
        metavar="S,T",
        help="line on the die along which bands are compared, in shares of its width and height "
        "(0.5,0 0.5,1)",
    )
    photo.add_argument(
        "--fail-hue", type=float, metavar="DEG", help="status 1: hue distributions farther apart"
    )
    photo.add_argument(
        "--fail-bands", type=float, metavar="R", help="status 1: correlation along the line below"
    )
    parser.set_defaults(run=_run)


def _point(text: str) -> tuple[float, float]:
    try:
        x, y = map(float, text.split(","))
    except ValueError:
        raise argparse.ArgumentTypeError(f"'{text}' is not X,Y, two numbers") from None
    return x, y


def _run(arguments: argparse.Namespace) -> int:
    from icwafer import packages

    packages.install("images")
    try:
        return _photo(arguments) if arguments.photo else _images(arguments)
    except IcwaferError as error:
        raise InputError(str(error)) from None


def _ppd(arguments: argparse.Namespace) -> float:
    from icwafer.compare.flip import DEFAULT_PIXELS_PER_DEGREE

    ppd = DEFAULT_PIXELS_PER_DEGREE if arguments.ppd is None else arguments.ppd
    if not 1.0 <= ppd <= 1000.0:
        raise InputError(f"--ppd {ppd:g} is outside 1 to 1000; a screen has about 30 to 100")
    return ppd


def _images(arguments: argparse.Namespace) -> int:
    from icwafer.compare import comparison, images
    from icwafer.compare.colour import view_transform

    if len(arguments.images) != 2:
        raise InputError(f"{len(arguments.images)} images; compare two, A and B")
    if not 0.0 < arguments.level < 0.5:
        raise InputError(f"--level {arguments.level:g} is outside 0 to 0.5; usual is 0.01")
    thresholds = {
        name: value
        for name in MEASURES
        if (value := getattr(arguments, "fail_" + name.replace("-", "_"))) is not None
    }
    view = view_transform(arguments.ocio, arguments.view, arguments.look)
    a, b, *second = (
        images.read(path, arguments.layer)
        for path in (*arguments.images, *(arguments.second or ()))
    )
    if arguments.second and arguments.variance:
        raise InputError("--second and --variance both say what the noise is; give one of them")
    variances = tuple(
        images.read(path, arguments.variance_layer or images.layer_if_there(path, "Variance"))
        for path in arguments.variance or ()
    )
    if arguments.html and a.size != b.size:
        raise InputError("--html needs images of one size; render both at one size")
    found = comparison.compare(
        a,
        b,
        view,
        _ppd(arguments),
        with_flip=arguments.flip or "flip" in thresholds or "hdr-flip" in thresholds,
        fit=arguments.fit,
        second=tuple(second) or None,
        with_noise=arguments.noise or bool(second or variances),
        level=arguments.level,
        variances=variances or None,
    )
    failures = found.failures(thresholds)
    _print(found, failures)
    if arguments.json:
        _write_json(arguments.json, comparison.as_json(found, failures))
    if arguments.html:
        title = f"{a.path.name} and {b.path.name}"
        _write_page(arguments, (a.path, b.path), _distinct(a.path, b.path), title)
    return 1 if failures else 0


def _print(found: Comparison, failures: list[str]) -> None:
    for letter, image in (("A", found.a), ("B", found.b)):
        kind = "scene-linear" if image.linear else "encoded"
        print(f"{letter}         {image.path}  {image.size[0]}x{image.size[1]}, {kind}")
    print(f"compared  {found.compared}")
    print(f"view      {found.view}")
    for note in found.notes:
        print(f"note      {note}")
    x, y, channel = found.max_place
    colour = ("red", "green", "blue")[channel]
    remarks = {
        "max": f"  at {x},{y} in {colour}",
        "psnr": "  dB",
        "yee": "  of the pixels",
        "flip": f"  at {found.pixels_per_degree:.4g} pixels per degree",
    }
    if found.hdr_flip:
        hdr = found.hdr_flip
        remarks["hdr-flip"] = (
            f"  over {hdr.exposures} exposures, {hdr.start_exposure:+.2f} to "
            f"{hdr.stop_exposure:+.2f} EV"
        )
    for name, value in found.values.items():
        print(f"{name:9} {value:.6g}{remarks.get(name, '')}")
    if found.noise:
        noise = found.noise
        verdict = "different beyond it" if noise.different else "nothing beyond it"
        print(f"noise     {verdict}: p {noise.p:.3g}, level {noise.level:g}, {noise.tests} tests, "
              f"{100 * noise.share:.1f} % of the tiles")  # fmt: skip
        if noise.rms_noise is not None:
            print(f"          rms {noise.rms:.6g} of the means, {noise.rms_noise:.6g} of it noise,"
                  f" {noise.rms_beyond:.6g} beyond it")  # fmt: skip
    for failure in failures:
        print(f"different: {failure}")
    if not failures:
        print("equal")


def _photo(arguments: argparse.Namespace) -> int:
    from icwafer.compare import photo, photo_figure
    from icwafer.compare.colour import view_transform

    if len(arguments.images) != 1:
        raise InputError(f"{len(arguments.images)} images with --photo; name one render")
    if not arguments.corners:
        raise InputError("--photo needs --corners, the die's four corners in the photograph")
    view = view_transform(arguments.ocio, arguments.view, arguments.look)
    found = photo.compare(
        arguments.photo,
        tuple(arguments.corners),
        arguments.images[0],
        arguments.render_corners and tuple(arguments.render_corners),
        tuple(arguments.profile),
        view,
        arguments.layer,
    )
    failures = photo.failures(found, arguments.fail_hue, arguments.fail_bands)
    for line in photo.described(found):
        print(line)
    for failure in failures:
        print(f"different: {failure}")
    if arguments.json:
        _write_json(arguments.json, photo.as_json(found, failures))
    if arguments.html:
        title = f"{arguments.photo.name} and {arguments.images[0].name}"
        names = ("photo", "render")
        with photo.as_files(found) as files:
            figure = photo_figure.section(found, names)
            _write_page(arguments, files, names, title, figure, photo_figure.INTRODUCTION)
    return 1 if failures else 0


def _distinct(a: Path, b: Path) -> tuple[str, str]:
    """What the page calls two files."""
    if a.name != b.name:
        return a.name, b.name
    return (f"A: {a}", f"B: {b}")


def _write_page(
    arguments: argparse.Namespace,
    files: tuple[Path, Path],
    names: tuple[str, str],
    title: str,
    figure: str = "",
    description: str = "",
) -> None:
    from icwafer.report import page
    from icwafer.report.study import Job, Study

    jobs = tuple(Job(name, {}, image=path) for name, path in zip(names, files))
    study = Study(title, description, (), names[0], "", {}, jobs)
    for path in page.write(
        study,
        arguments.html,
        config=arguments.ocio,
        view=arguments.view,
        look=arguments.look,
        ppd=_ppd(arguments),
        layer=arguments.layer,
        figure=figure,
    ):
        print(path)


def _write_json(path: Path, result: dict[str, Any]) -> None:
    with replacing(path) as unfinished:
        unfinished.write_text(json.dumps(result, indent=1, allow_nan=False) + "\n", "utf-8")
