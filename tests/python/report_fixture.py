# SPDX-License-Identifier: GPL-2.0-or-later
"""A small study as `icwafer render` leaves it, made of gratings' colours without a renderer."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
from compare_support import write_image

SIZE = (48, 30)
SPACINGS = (900.0, 1000.0, 1100.0)
LOBES = (0.01, 0.03)
REFERENCE = "spacing1000-lobe0.01"

GRATING = {
    "camera": {"position_mm": [0, -300, 900], "target_mm": [0, 0, 0], "lens_mm": 36},
    "light": {"position_mm": [0, 50, 700]},
    "spacing_nm": 2000,
    "direction_rad": 0.0,
}


def picture(spacing_nm: float, lobe: float) -> np.ndarray:
    """Bands whose place follows from the spacing and whose softness from the lobe; up to 4."""
    across = np.linspace(0, 1, SIZE[0])[None, :, None] * np.ones((SIZE[1], 1, 1))
    phase = across * 9000 / spacing_nm + np.array([0.0, 0.33, 0.66])
    bands = (0.5 + 0.5 * np.cos(2 * np.pi * phase) * np.exp(-20 * lobe)) ** 3
    return bands * np.linspace(0, 4, SIZE[1])[:, None, None]


def write_study(folder: Path, name: str = "Spacing & lobe <test> </script><!-- <script>") -> Path:
    """A reference, five more renders (one as PNG only), a failed job and one without a word."""
    study = {
        "name": name,
        "description": "Made up.",
        "axes": [
            {"name": "spacing", "unit": "nm", "values": SPACINGS},
            {"name": "lobe", "unit": "", "values": LOBES},
        ],
        "reference": REFERENCE,
        "versions": {"blender": "3.4.1"},
        "command": ["icwafer", "render", "study.toml", "-o", str(folder)],
    }
    for spacing in SPACINGS:
        for lobe in LOBES:
            id = f"spacing{spacing:g}-lobe{lobe:g}"
            job = {
                "settings": {"spacing": spacing, "lobe": lobe},
                "command": ["icwafer", "render", "study.toml", "--only", id],
                "seconds": spacing / 1000 + lobe,
                "samples": 16,
                "seed": 3,
                "grating": GRATING,
            }
            add_job(folder, id, job)
            pixels = picture(spacing, lobe)
            if id == "spacing1100-lobe0.03":
                write_image(folder / "jobs" / id / "image.png", np.clip(pixels, 0, 1))
            else:
                write_image(folder / "jobs" / id / "image.exr", pixels)
    add_job(folder, "broken", {"settings": {"spacing": 1000.0, "lobe": 0.5}, "status": "failed",
                               "error": "Blender ended with signal 11"})  # fmt: skip
    (folder / "jobs" / "unfinished").mkdir()
    (folder / "study.json").write_text(json.dumps(study))
    return folder


def add_job(folder: Path, id: str, job: dict) -> None:
    (folder / "jobs" / id).mkdir(parents=True)
    (folder / "jobs" / id / "job.json").write_text(json.dumps({"id": id} | job))
