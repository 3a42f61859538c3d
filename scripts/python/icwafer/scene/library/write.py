# SPDX-License-Identifier: GPL-2.0-or-later
"""Makes one file of the asset library, inside Blender:

blender -b --factory-startup --python-exit-code 1 -P write.py -- KIND SOURCES FILE.blend

SOURCES is the folder with the table of materials and the catalogs.
"""

from __future__ import annotations

import importlib
import os
import sys
from collections.abc import Callable
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3]))

import bpy  # noqa: E402

from icwafer.assets.catalogs import FILE_NAME, read_catalogs  # noqa: E402
from icwafer.assets.plan import KINDS  # noqa: E402
from icwafer.errors import IcwaferError  # noqa: E402
from icwafer.scene.library.asset import Asset, mark  # noqa: E402
from icwafer.scene.library.previews import SIZE, render_preview  # noqa: E402
from icwafer.scene.library.stage import stage  # noqa: E402
from icwafer.scene.material import expect_node  # noqa: E402
from icwafer.scene.turn import turn_to_light_rad  # noqa: E402

SAMPLES = 24

#: Told how many assets are done, of how many, and the name of the last one.
Progress = Callable[[int, int, str], None]


def write(kind: str, sources: Path, path: Path, progress: Progress) -> None:
    """Makes the assets of a kind with their previews and writes them to a file.

    Raises IcwaferError for bad sources and OSError where the file cannot be written.
    """
    bpy.ops.wm.read_factory_settings()
    expect_node()
    wires_rad = _wires_in_new_scene_rad(bpy.context.scene)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    catalogs = read_catalogs(sources / FILE_NAME)
    contents = importlib.import_module(f"icwafer.scene.library.{kind}")
    assets = list(contents.assets(sources, wires_rad))
    scene = stage(SIZE, SAMPLES)
    for number, asset in enumerate(assets, 1):
        if asset.catalog not in catalogs:
            raise IcwaferError(f"{sources / FILE_NAME}: has no catalog '{asset.catalog}': add it")
        mark(asset, catalogs[asset.catalog])
        _photograph(scene, asset)
        progress(number, len(assets), asset.id.name)
    try:
        bpy.data.libraries.write(
            str(path), {asset.id for asset in assets}, fake_user=True, compress=True
        )
    except RuntimeError as error:
        raise OSError(None, " ".join(str(error).split()), str(path)) from error


def _wires_in_new_scene_rad(scene: bpy.types.Scene) -> float:
    """The direction of wires on the ground in whose colours Blender's new scene shows its middle."""
    return turn_to_light_rad(scene, bpy.data.objects.new("Middle", None), 0.0)


def _photograph(scene: bpy.types.Scene, asset: Asset) -> None:
    camera = scene.camera
    before = [set(links) for links in (scene.collection.objects, scene.collection.children)]
    asset.pose(scene)
    render_preview(scene, asset.id)
    for links, kept in zip((scene.collection.objects, scene.collection.children), before):
        now = set(links)
        for thing in now - kept:
            links.unlink(thing)
        for thing in kept - now:
            links.link(thing)
    scene.camera = camera


def _progress_without_cycles() -> Progress:
    """Prints how far the work is, and keeps what Blender itself prints about it to itself."""
    stream = os.fdopen(os.dup(sys.stdout.fileno()), "w")
    with open(os.devnull, "w") as nowhere:
        os.dup2(nowhere.fileno(), sys.stdout.fileno())

    def progress(done: int, total: int, name: str) -> None:
        print(f"[{done}/{total}] {name}", file=stream, flush=True)

    return progress


def main(arguments: list[str]) -> int:
    try:
        if len(arguments) != 3:
            raise IcwaferError("write.py takes KIND SOURCES FILE.blend")
        kind, sources, path = arguments
        if kind not in KINDS:
            raise IcwaferError(f"no kind of assets '{kind}': choose from {', '.join(KINDS)}")
        write(kind, Path(sources), Path(path), _progress_without_cycles())
    except (IcwaferError, OSError) as error:
        print(f"icwafer: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[sys.argv.index("--") + 1 :]))
