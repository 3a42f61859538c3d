# SPDX-License-Identifier: GPL-2.0-or-later
"""The project's pictures by name, and what they are made of."""

from __future__ import annotations

from icwafer.pictures.effects import EFFECTS
from icwafer.pictures.model import (
    Camera,
    Environment,
    Light,
    NodeValue,
    Picture,
    Render,
    Table,
    Vector,
    View,
)
from icwafer.pictures.photograph import PHOTOGRAPH
from icwafer.pictures.studio import STUDIO

__all__ = [
    "PICTURES",
    "Camera",
    "Environment",
    "Light",
    "NodeValue",
    "Picture",
    "Render",
    "Table",
    "Vector",
    "View",
]

PICTURES: dict[str, Picture] = {**EFFECTS, "photograph": PHOTOGRAPH, **STUDIO}
