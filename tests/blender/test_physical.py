# SPDX-License-Identifier: GPL-2.0-or-later
"""What Blender renders with the model PHYSICAL is what the material's headers say.

A plane under a point lamp: every pixel has its own pair of directions. The headers are asked through
a program (tests/oracle), with the parameters that the sockets have; so sockets, properties, frame,
tables and the lamp's strength are tested together, in absolute terms.
"""

from __future__ import annotations

import os
import subprocess
import unittest
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import host
import numpy as np
import pixels

ROOT = Path(__file__).resolve().parents[2]
ORACLE = Path(
    os.environ.get(
        "ICWAFER_PHYSICAL_ORACLE", ROOT / "build" / "core" / "tests" / "oracle" / "physical_oracle"
    )
)

SIZE = (96, 64)
LAMP = np.array([-0.5, 0.4, 0.9])
VIEW_WIDTH = 3.0
POWER_W = 100.0

# From XYZ to Rec.709 (IEC 61966-2-1); the channels are normalised later.
TO_REC709 = np.array(
    [
        [3.2404542, -1.5371385, -0.4985314],
        [-0.9692660, 1.8760108, 0.0415560],
        [0.0556434, -0.2040259, 1.0572252],
    ]
)
METALS = ("COPPER", "ALUMINIUM", "TUNGSTEN", "SILICON", "CUSTOM")
OXIDES = ("SIO2", "SI3N4", "CUSTOM")
ILLUMINANTS = ("EQUAL_ENERGY", "D65", "A", "F2", "F11", "WHITE_LED", "SODIUM")


@dataclass(frozen=True)
class Wires:
    """The node's sockets and lists."""

    spacing_nm: float = 1000.0
    width_nm: float = 250.0
    cross_spacing_nm: float = 0.0
    cross_width_nm: float = 250.0
    oxide_nm: float = 530.0
    groove_nm: float = 300.0
    coherence_um: float = 6.0
    roughness: float = 0.2
    variation: float = 0.0
    oxide: str = "SIO2"
    ior: float = 1.544
    metal: str = "COPPER"
    illuminant: str = "EQUAL_ENERGY"
    metal_n: tuple[float, float, float] = (0.27, 0.68, 1.3)
    metal_k: tuple[float, float, float] = (3.4, 2.62, 2.4)
    length_um: float = 6.0
    direction_rad: float = 0.0

    def numbers(self) -> list[float]:
        """In the order of the oracle."""
        return [
            self.spacing_nm, self.width_nm, self.cross_spacing_nm, self.cross_width_nm,
            self.oxide_nm, self.groove_nm, self.coherence_um, self.roughness, self.variation,
            OXIDES.index(self.oxide), self.ior, METALS.index(self.metal),
            ILLUMINANTS.index(self.illuminant), *self.metal_n, *self.metal_k, self.length_um,
        ]  # fmt: skip

    def variant(self) -> dict[str, Any]:
        """For inside/render_variants.py."""
        return {
            "properties": {
                "model": "PHYSICAL",
                "metal": self.metal,
                "oxide": self.oxide,
                "illuminant": self.illuminant,
            },
            "inputs": {
                "Wire Spacing": self.spacing_nm,
                "Wire Width": self.width_nm,
                "Cross Spacing": self.cross_spacing_nm,
                "Cross Width": self.cross_width_nm,
                "Oxide Thickness": self.oxide_nm,
                "Oxide IOR": self.ior,
                "Groove Depth": self.groove_nm,
                "Coherence Width": self.coherence_um,
                "Wire Length": self.length_um,
                "Roughness": self.roughness,
                "Spacing Variation": self.variation,
                "Metal n": self.metal_n,
                "Metal k": self.metal_k,
                "Direction": self.direction_rad,
            },
            "lamp": LAMP.tolist(),
            "power_w": POWER_W,
            "size": SIZE,
            "view_width": VIEW_WIDTH,
            "exact_pixels": True,
        }


CASES = {
    "new": Wires(),
    "aslant": Wires(direction_rad=0.6),
    "mesh": Wires(spacing_nm=1300.0, cross_spacing_nm=2200.0, cross_width_nm=500.0),
    "aluminium, nitride, F11": Wires(metal="ALUMINIUM", oxide="SI3N4", illuminant="F11"),
    "tungsten, daylight": Wires(metal="TUNGSTEN", illuminant="D65", groove_nm=150.0),
    "silicon, LED, no oxide": Wires(metal="SILICON", illuminant="WHITE_LED", oxide_nm=0.0),
    "custom": Wires(metal="CUSTOM", oxide="CUSTOM", ior=1.8, illuminant="A"),
    "sodium": Wires(illuminant="SODIUM", coherence_um=3.0),
    "many spacings": Wires(spacing_nm=1500.0, variation=0.1, illuminant="F2"),
    "wide spacing": Wires(spacing_nm=30000.0, width_nm=9000.0),
}


def expected(wires: Wires) -> np.ndarray:
    """Radiance in the middle of each pixel, (height, width, 3)."""
    width, height = SIZE
    x = ((np.arange(width) + 0.5) / width - 0.5) * VIEW_WIDTH
    y = (0.5 * height - 0.5 - np.arange(height)) / width * VIEW_WIDTH
    place = np.stack(np.broadcast_arrays(x[None, :], y[:, None], 0.0), axis=-1)
    to_lamp = LAMP - place
    distance = np.linalg.norm(to_lamp, axis=-1, keepdims=True)
    light = to_lamp / distance
    # An orthographic camera looks straight down.
    view = np.broadcast_to([0.0, 0.0, 1.0], light.shape)
    along = np.array([np.cos(wires.direction_rad), np.sin(wires.direction_rad), 0.0])
    frame = np.array([[-along[1], along[0], 0.0], along, [0.0, 0.0, 1.0]])
    directions = np.concatenate([light @ frame.T, view @ frame.T], axis=-1)
    asked = np.concatenate([TO_REC709.ravel(), wires.numbers(), directions.ravel()])
    answer = subprocess.run(
        [ORACLE], input=asked.astype(np.float32).tobytes(), capture_output=True, check=True
    )
    f = np.frombuffer(answer.stdout, np.float32).reshape(height, width, 3)
    # What Blender means by a lamp of P watts: the intensity P / (4 pi).
    return f * POWER_W / (4 * np.pi) * light[..., 2:] / distance**2


class Physical(unittest.TestCase):
    def test_pixels_are_the_headers(self) -> None:
        folder = host.fresh_folder("physical")
        variants = [
            wires.variant() | {"exr": str(folder / f"{number}.exr")}
            for number, wires in enumerate(CASES.values())
        ]
        host.run_inside(
            host.built_blender(),
            "render_variants",
            {"engine": "CYCLES", "variants": variants},
            folder=folder,
            seconds=180,
        )
        for (name, wires), variant in zip(CASES.items(), variants, strict=True):
            with self.subTest(name):
                rendered = pixels.read(Path(variant["exr"]))
                headers = expected(wires)
                self.assertGreater(float(headers.std()), 0.05 * float(headers.mean()))
                # Samples lie within a hundredth of a pixel around its middle.
                error = ((rendered - headers) ** 2).mean() ** 0.5
                self.assertLess(float(error / (headers**2).mean() ** 0.5), 1e-3)


if __name__ == "__main__":
    unittest.main()
