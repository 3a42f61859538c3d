# SPDX-License-Identifier: GPL-2.0-or-later
"""A 300 mm wafer of more than 600 dies with more than 100,000 blocks each: time and memory.

    scripts/icwafer blender -b --factory-startup -P tests/benchmarks/wafer_scale.py

Reads the layout from a file, builds the wafer and renders one sample of a small picture of it; what
that takes is the time before the first sample. Then the same picture with an object for each die
instead of instances by geometry nodes, whose synchronisation is compared. With `-- partial` after
the command the wafer has partial dies, too, each with its own mesh.
"""

from __future__ import annotations

import dataclasses
import resource
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts" / "python"))

import bpy  # noqa: E402

from icwafer.attributes import DRIFT  # noqa: E402
from icwafer.chips.document import read_layout, write_layout  # noqa: E402
from icwafer.chips.presets import PRESETS  # noqa: E402
from icwafer.pictures import Camera, Light, Render  # noqa: E402
from icwafer.scene.camera import camera_object  # noqa: E402
from icwafer.scene.lamps import lamp  # noqa: E402
from icwafer.scene.parts import parts  # noqa: E402
from icwafer.scene.picture import empty_scene  # noqa: E402
from icwafer.scene.render import set_render  # noqa: E402
from icwafer.scene.wafer import add_wafer  # noqa: E402

DIE = {"width_mm": 10.32, "height_mm": 10.1, "block_um": 24.0}


def write_large_layout(path: Path) -> None:
    layout = PRESETS["eight-core"]
    die = dataclasses.replace(layout.dies[0], **DIE)
    wafer = dataclasses.replace(layout.wafer, test_fields=(), partial_dies="partial" in sys.argv)
    write_layout(path, dataclasses.replace(layout, dies=(die,), wafer=wafer))


def peak_gb() -> float:
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e6


def render_s() -> float:
    start = time.perf_counter()
    bpy.ops.render.render()
    return time.perf_counter() - start


def dies_as_objects(wafer: bpy.types.Object) -> None:
    """Takes the modifier away and links an object for each die, with its drift, as a child."""
    dies = bpy.data.collections[f"{wafer.name} dies"].objects
    points = wafer.data.attributes
    for index, point in enumerate(points["ic_die"].data):
        if point.value:
            child = bpy.data.objects.new("Die", dies[point.value - 1].data)
            child.location = wafer.data.vertices[index].co
            child.parent = wafer
            child[DRIFT.name] = points[DRIFT.name].data[index].vector
            bpy.context.scene.collection.objects.link(child)
    wafer.modifiers.clear()


scene = empty_scene()
with tempfile.TemporaryDirectory() as folder:
    file = Path(folder) / "large.layout.toml"
    write_large_layout(file)
    begin = time.perf_counter()
    layout = read_layout(file)
wafer = add_wafer(layout, scene.collection, parts(), plates=False)
built_s = time.perf_counter() - begin
scene.camera = camera_object(Camera((0, -560, 400), (0, 0, 0), 90))
scene.collection.objects.link(scene.camera)
scene.collection.objects.link(lamp(Light("AREA", (-60, -90, 330), 1e6, size_mm=(300, 60))))
set_render(scene, Render((64, 36), samples=1))
first_s = render_s()
faces = [
    len(instance.object.data.polygons)
    for instance in bpy.context.evaluated_depsgraph_get().object_instances
    if instance.is_instance
]
blocks = sum(faces) - len(faces)  # each die has its ground
print(f"{len(faces)} dies, {blocks / 1e6:.1f} million blocks")
print(f"read and built: {built_s:.1f} s; then to the end of the first sample: {first_s:.1f} s")
print(f"peak: {peak_gb():.2f} GB")
again_s = render_s()
dies_as_objects(wafer)
print(f"an object per die takes {render_s() / again_s:.2f} times as long to the first sample")
