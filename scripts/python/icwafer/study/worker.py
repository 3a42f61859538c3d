# SPDX-License-Identifier: GPL-2.0-or-later
"""Renders the jobs of a study, one after the other, inside Blender (see `icwafer.study.workers`):

blender -b --factory-startup --disable-autoexec --python-exit-code 1 -P worker.py -- REPLIES
"""

from __future__ import annotations

import ctypes
import errno
import json
import os
import signal
import sys
import time
import traceback
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))

import bpy  # noqa: E402

from icwafer.errors import DiskFull, IcwaferError, SettingError  # noqa: E402
from icwafer.scene import image, picture  # noqa: E402
from icwafer.scene.material import expect_node  # noqa: E402
from icwafer.study import blend_file, fields, image_file  # noqa: E402

_LIBC = ctypes.CDLL(None)
_PR_SET_PDEATHSIG = 1
#: Errors after which no other job can be rendered either.
_FATAL = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EROFS, errno.EACCES, errno.EPERM)


def main(replies: int) -> None:
    """Serves requests until the input ends. Raises IcwaferError in a Blender without the node."""
    _end_with_parent()
    expect_node()
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)  # a limit on files is an error, not a crash
    with os.fdopen(replies, "w") as answer:

        def reply(facts: Mapping[str, Any]) -> None:
            answer.write(json.dumps(facts) + "\n")
            answer.flush()

        reply({"ready": {"version": bpy.app.version_string}})
        for line in sys.stdin:
            request = json.loads(line)
            reply({"render": _render, "check": _check}[request["do"]](request))


def _end_with_parent() -> None:
    """The engine may be killed: then nobody waits for the result."""
    _LIBC.prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)


def _check(request: Mapping[str, Any]) -> dict[str, Any]:
    """Builds a scene without rendering it: which setting does not work, which files it needs."""
    scene = request["scene"]
    try:
        if fields.BLEND in scene:
            blend_file.build(scene)
        else:
            picture.check(fields.picture_of(scene))
    except SettingError as error:
        return {"error": str(error), "setting": error.setting}
    except IcwaferError as error:
        return {"error": str(error)}
    blend = fields.BLEND in scene
    return {"needs": sorted(bpy.utils.blend_paths(absolute=True)) if blend else []}


def _render(request: Mapping[str, Any]) -> dict[str, Any]:
    folder = Path(request["folder"])
    try:
        with _log(folder / "log.txt"):
            return _render_to(
                folder, request["scene"], request["attributes"], request["light"]
            )
    except SettingError as error:
        return {"error": f"{error.setting} {error}"}
    except IcwaferError as error:
        return {"error": str(error), "fatal": isinstance(error, DiskFull)}
    except OSError as error:
        where = error.filename or folder
        return {"error": f"{where}: {error.strerror}", "fatal": error.errno in _FATAL}
    except Exception as error:
        with suppress(OSError), (folder / "log.txt").open("a", encoding="utf-8") as log:
            traceback.print_exc(file=log)
        return {"error": " ".join(str(error).split())}


def _render_to(
    folder: Path, settings: fields.Scene, attributes: Mapping[str, str], light: str | None
) -> dict[str, Any]:
    """Renders, or takes over the linear image `light`, and shows it as the settings say."""
    begin = time.monotonic()
    scene = _build(settings)
    share = scene.render.resolution_percentage / 100
    size = int(scene.render.resolution_x * share), int(scene.render.resolution_y * share)
    image.expect_space(folder, size)
    raw, linear, shown = (folder / name for name in ("raw.exr", "image.exr", "image.png"))
    rendered = not _is_light(light, attributes["light_key"])
    if rendered:
        bpy.ops.render.render()
        image.save(scene, raw)
        light = str(raw)
    image_file.copy(Path(light), linear, attributes)
    # From the file, so that it does not matter whether it was rendered or taken over.
    raw = raw.with_suffix(".png")
    image.show(scene, linear, raw)
    image_file.copy(raw, shown)
    for path in folder.glob("raw.*"):
        path.unlink()
    return {
        "seconds": round(time.monotonic() - begin, 3),
        "rendered": rendered,
        "samples": scene.cycles.samples,
        "seed": scene.cycles.seed,
        "size": size,
        "view_transform": scene.view_settings.view_transform,
        "look": scene.view_settings.look,
    }


def _is_light(path: str | None, key: str) -> bool:
    """Whether an image is there and has this light: its folder may be another job's by now."""
    try:
        return path is not None and image_file.attributes(Path(path)).get("light_key") == key
    except IcwaferError:
        return False


def _build(settings: fields.Scene) -> bpy.types.Scene:
    """The scene of a job. Raises SettingError."""
    if fields.BLEND in settings:
        return blend_file.build(settings)
    return picture.build(fields.picture_of(settings))


@contextmanager
def _log(path: Path) -> Iterator[None]:
    """Everything that is written to the screen meanwhile goes to a file, from C as from Python."""
    streams = (sys.stdout, sys.stderr)
    saved = [os.dup(number) for number in (1, 2)]
    file = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o666)
    try:
        for number in (1, 2):
            os.dup2(file, number)
        yield
    finally:
        for stream in streams:
            with suppress(OSError):
                stream.flush()
        _LIBC.fflush(None)
        for number, copy in zip((1, 2), saved):
            os.dup2(copy, number)
            os.close(copy)
        os.close(file)


if __name__ == "__main__":
    try:
        main(int(sys.argv[sys.argv.index("--") + 1]))
    except IcwaferError as error:
        print(f"icwafer: {error}", file=sys.stderr)
        sys.exit(1)
