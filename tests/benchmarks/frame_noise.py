# SPDX-License-Identifier: GPL-2.0-or-later
"""Noise of a frame filled with the node, relative to one with an anisotropic Glossy BSDF.

    scripts/icwafer blender -b --factory-startup -P tests/benchmarks/frame_noise.py

A plane under a sky and an area lamp; the same samples for all materials. The glossy lobe (GGX)
has the widths of the node's mirror order across and along the wires. Noise is the standard
deviation over renders with different seeds, as a root mean square over the lit pixels, divided by
their mean: of the luminance, and of the three channels. Lit are the pixels above half of the
frame's mean.
"""

from __future__ import annotations

import math
import sys
import tempfile
from pathlib import Path

import bpy
import numpy as np
import OpenImageIO as oiio

sys.path.insert(0, str(Path(__file__).resolve().parent))
import frame_scene  # noqa: E402

SIZE, SAMPLES, SEEDS = (96, 72), 16, 12
WAVELENGTH_NM = 550.0


def mirror_width(width_um: float, roughness: float) -> float:
    """Standard deviation of the node's mirror order in direction cosines, as its manual states."""
    return math.hypot(0.376e-3 * WAVELENGTH_NM / width_um, math.sqrt(2) * roughness**2)


def glossy(coherence_um: float, length_um: float, roughness: float) -> bpy.types.Material:
    """A microfacet lobe as wide: slopes deflect by twice their angle, so sigma = sqrt(2) alpha.

    Along the tangent, the X axis as for the node's wires, alpha is r^2 (1 - a), across r^2/(1 - a).
    The plane's UV map gives that axis; by itself the node takes circles around the plane's middle.
    """
    along, across = (
        mirror_width(width, roughness) / math.sqrt(2) for width in (length_um, coherence_um)
    )
    made = frame_scene.material(
        "ShaderNodeBsdfAnisotropic",
        {
            "distribution": "GGX",
            "Roughness": (along * across) ** 0.25,
            "Anisotropy": 1.0 - math.sqrt(along / across) if along < across
            else math.sqrt(across / along) - 1.0,
        },
    )  # fmt: skip
    nodes = made.node_tree.nodes
    axis = nodes.new("ShaderNodeTangent")
    axis.direction_type = "UV_MAP"
    made.node_tree.links.new(axis.outputs[0], nodes["Anisotropic BSDF"].inputs["Tangent"])
    return made


def noise(scene: bpy.types.Scene, folder: Path) -> tuple[float, float]:
    """Relative standard deviation of what the scene shows now, of luminance and of channels."""
    settings = scene.render.image_settings
    settings.file_format, settings.color_depth = "OPEN_EXR", "32"
    frames = []
    for seed in range(SEEDS):
        scene.cycles.seed = seed
        bpy.ops.render.render()
        path = str(folder / "frame.exr")
        bpy.data.images["Render Result"].save_render(path, scene=scene)
        # Not ImageBuf, which remembers a file of the same name within the same second.
        frames.append(oiio.ImageInput.open(path).read_image(oiio.FLOAT)[..., :3])
    channels = np.stack(frames)
    mean = channels.mean(axis=(0, -1))
    lit = mean > 0.5 * mean.mean()
    return tuple(
        float(np.sqrt(values.var(axis=0, ddof=1)[lit].mean()) / values.mean(axis=0)[lit].mean())
        for values in (channels @ frame_scene.LUMINANCE, channels)
    )


MATERIALS = {"1 um": {}, "4 um": {"Wire Spacing": 4000.0, "Wire Width": 1000.0}}
LIGHTS = {"sky and lamp": (1.0, 400.0), "sky": (1.0, 0.0), "lamp": (0.0, 400.0)}
WIDTHS = {"Coherence Width": 10.0, "Wire Length": 2.0, "Roughness": 0.05}

scene, plane = frame_scene.scene(SIZE, SAMPLES)
scene.render.use_persistent_data = False  # which would keep the first seed
materials = {
    "GGX": glossy(*WIDTHS.values()),
    **{name: frame_scene.material(frame_scene.NODE, values | WIDTHS)
       for name, values in MATERIALS.items()},
}  # fmt: skip
lamp = next(thing.data for thing in scene.objects if thing.type == "LIGHT")
with tempfile.TemporaryDirectory() as folder:
    for light, (strength, energy) in LIGHTS.items():
        scene.world.node_tree.nodes["Background"].inputs["Strength"].default_value = strength
        lamp.energy = energy
        found = {}
        for name, made in materials.items():
            plane.data.materials[0] = made
            found[name] = noise(scene, Path(folder))
        for name, values in found.items():
            (luminance, channels), (glossy_luminance, glossy_channels) = values, found["GGX"]
            print(
                f"{light}, {name}: luminance {luminance:.3f}, "
                f"{luminance / glossy_luminance:.2f} times GGX; "
                f"channels {channels:.3f}, {channels / glossy_channels:.2f} times GGX"
            )
