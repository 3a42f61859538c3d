# SPDX-License-Identifier: GPL-2.0-or-later
"""Renders a portrait, inside Blender:

blender -b --factory-startup --python-exit-code 1 -P render.py -- ORDER.json
"""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))

import bpy  # noqa: E402
import numpy as np  # noqa: E402

from icwafer.errors import IcwaferError  # noqa: E402
from icwafer.portrait.order import Order  # noqa: E402
from icwafer.scene import image  # noqa: E402
from icwafer.scene.portrait import build, light  # noqa: E402

#: The lamps are such that this share of what is lit is darker than `BRIGHT` of full light.
LIT_SHARE = 0.75
BRIGHT = 0.5
#: A picture of this share of the size, with this many samples, decides that.
PROOF_SHARE, PROOF_SAMPLES = 8, 24


def render(order: Order) -> None:
    """Writes the files of an order. Raises IcwaferError."""
    scene, lights = build(order)
    folder = Path(order.png).parent
    image.expect_space(folder, order.size)
    # The lamps, not the view: the renderer's threshold of noise is for this brightness.
    light(scene, lights, 1.0)
    light(scene, lights, _gain(scene, folder))
    bpy.ops.render.render()
    for path in filter(None, (order.png, order.exr)):
        image.save(scene, Path(path))


def _gain(scene: bpy.types.Scene, folder: Path) -> float:
    """What the lamps' power must be multiplied with, from a small proof."""
    size, samples = scene.render.resolution_percentage, scene.cycles.samples
    proof = folder / "proof.exr"
    scene.render.resolution_percentage = 100 // PROOF_SHARE
    scene.cycles.samples = PROOF_SAMPLES
    bpy.ops.render.render()
    image.save(scene, proof)
    scene.render.resolution_percentage, scene.cycles.samples = size, samples
    bright = _brightest_channel(proof)
    proof.unlink()
    lit = bright[bright > 0.02 * np.percentile(bright, 95)]
    return float(BRIGHT / np.percentile(lit, 100 * LIT_SHARE)) if len(lit) else 1.0


def _brightest_channel(path: Path) -> np.ndarray:
    """Of each pixel of an EXR, (n,) float32, linear."""
    loaded = bpy.data.images.load(str(path))
    pixels = np.empty(len(loaded.pixels), dtype=np.float32)
    loaded.pixels.foreach_get(pixels)
    brightest = pixels.reshape(-1, loaded.channels)[:, :3].max(axis=1)
    bpy.data.images.remove(loaded)
    return brightest


def main(order: Path) -> int:
    try:
        render(Order.read(order))
    except (IcwaferError, OSError, RuntimeError) as error:
        print(f"icwafer: {' '.join(str(error).split())}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[sys.argv.index("--") + 1])))
