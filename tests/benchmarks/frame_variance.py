# SPDX-License-Identifier: GPL-2.0-or-later
"""Variance of a frame at equal time, the node sampled by the cosine over the node as it is.

    scripts/icwafer blender -b --factory-startup -P tests/benchmarks/frame_variance.py

A plane under a sky and a lamp, seen along narrow lobes. For the node as it is sky and lamp are
sampled, too, as Cycles does. By the cosine alone: a matt closure that outweighs the node a million
times chooses all directions, neither sky nor lamp is sampled, and the pass of glossy light holds
what the node reflects. The time of such a frame is taken as that of the matt closure by itself,
less than it can be. Variance is that of the luminance over renders with different seeds, the mean
over the frame, relative to the square of the frame's mean.
"""

from __future__ import annotations

import resource
import sys
import tempfile
from pathlib import Path

import bpy
import numpy as np
import OpenImageIO as oiio

sys.path.insert(0, str(Path(__file__).resolve().parent))
import frame_scene  # noqa: E402

SIZE, SAMPLES, SEEDS = (240, 180), 64, 8
COHERENCES_UM = (15, 60)
WAFER_PART, MATT_COLOUR = 1e-3, 1e3


def outweighed(tree: bpy.types.NodeTree) -> None:
    """Mixes what the surface has with a matt closure that chooses the directions."""
    surface = tree.nodes["Material Output"].inputs["Surface"]
    wafer = surface.links[0].from_socket
    matt, mix = (tree.nodes.new(f"ShaderNode{kind}") for kind in ("BsdfDiffuse", "MixShader"))
    colour = tree.nodes.new("ShaderNodeValue").outputs[0]
    colour.default_value = MATT_COLOUR
    tree.links.new(colour, matt.inputs["Color"])
    mix.inputs["Fac"].default_value = WAFER_PART
    tree.links.new(matt.outputs[0], mix.inputs[1])
    tree.links.new(wafer, mix.inputs[2])
    tree.links.new(mix.outputs[0], surface)


def pane(camera: bpy.types.Object) -> None:
    """Glass before the camera: on what it sees first, Cycles samples no closure rarely."""
    bpy.ops.mesh.primitive_plane_add(size=1)
    glass = bpy.context.object
    glass.parent, glass.location = camera, (0.0, 0.0, -0.2)
    glass.data.materials.append(frame_scene.material("ShaderNodeBsdfTransparent", {}))
    for kind in ("diffuse", "glossy", "transmission", "volume_scatter", "shadow"):
        setattr(glass, f"visible_{kind}", False)


def mesh_lamp(scene: bpy.types.Scene) -> bpy.types.Material:
    """Replaces the lamp by a square that shines, which Cycles can also leave to chance."""
    lamp = next(thing for thing in scene.objects if thing.type == "LIGHT")
    bpy.ops.mesh.primitive_plane_add(
        size=lamp.data.size, location=lamp.location, rotation=lamp.rotation_euler
    )
    made = frame_scene.material("ShaderNodeEmission", {"Strength": 100.0})
    bpy.context.object.data.materials.append(made)
    bpy.data.objects.remove(lamp)
    return made


def render(scene: bpy.types.Scene, path: Path, glossy: bool) -> tuple[float, np.ndarray]:
    """Processor seconds of the frame, and its luminance."""
    scene.render.filepath = str(path)
    start = resource.getrusage(resource.RUSAGE_SELF).ru_utime
    bpy.ops.render.render(write_still=True)
    seconds = resource.getrusage(resource.RUSAGE_SELF).ru_utime - start
    picture = oiio.ImageInput.open(str(path))
    names = picture.spec().channelnames
    values = picture.read_image(oiio.FLOAT)
    picture.close()

    def layer(name: str) -> np.ndarray:
        return np.stack([values[..., names.index(f"ViewLayer.{name}.{c}")] for c in "RGB"], -1)

    light = layer("GlossDir") + layer("GlossInd") if glossy else layer("Combined")
    return seconds, light @ frame_scene.LUMINANCE


def measure(scene: bpy.types.Scene, folder: Path, glossy: bool) -> tuple[float, np.ndarray]:
    """Seconds of a frame, and the luminance of frames with different seeds."""
    seconds, frames = [], []
    for seed in range(SEEDS):
        scene.cycles.seed = seed
        took, frame = render(scene, folder / "frame.exr", glossy)
        seconds.append(took)
        frames.append(frame)
    return min(seconds), np.stack(frames)


def relative_variance(frames: np.ndarray) -> float:
    return float(frames.var(axis=0, ddof=1).mean() / frames.mean() ** 2)


def main() -> None:
    scene, plane = frame_scene.scene(SIZE, SAMPLES)
    scene.render.use_persistent_data = False  # which would keep the first seed
    scene.cycles.sample_clamp_indirect = 0.0
    scene.render.image_settings.file_format = "OPEN_EXR_MULTILAYER"
    scene.render.image_settings.color_depth = "32"
    layer = scene.view_layers[0]
    layer.use_pass_glossy_direct = layer.use_pass_glossy_indirect = True
    lamp = mesh_lamp(scene)
    pane(scene.camera)

    def sample_lights(sampled: bool) -> None:
        lamp.cycles.sample_as_light = sampled
        scene.world.cycles.sampling_method = "AUTOMATIC" if sampled else "NONE"

    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        sample_lights(False)
        plane.data.materials[0] = frame_scene.material("ShaderNodeBsdfDiffuse", {})
        matt_seconds, _ = measure(scene, folder, glossy=False)
        for coherence_um in COHERENCES_UM:
            width = {"Coherence Width": coherence_um, "Wire Length": coherence_um, "Roughness": 0}
            plane.data.materials[0] = made = frame_scene.material(frame_scene.NODE, width)
            sample_lights(True)
            seconds, frames = measure(scene, folder, glossy=False)
            sample_lights(False)
            outweighed(made.node_tree)
            _, by_cosine = measure(scene, folder, glossy=True)
            ratio = relative_variance(by_cosine) / relative_variance(frames)
            print(
                f"coherence {coherence_um} um: with the cosine the same mean within "
                f"{abs(by_cosine.mean() / frames.mean() - 1):.1%}, the variance {ratio:.0f} times "
                f"as high at equal samples, "
                f"{ratio * matt_seconds / seconds:.0f} times at equal time"
            )


main()
sys.exit(0)
