# SPDX-License-Identifier: GPL-2.0-or-later
"""The project's pictures by name, and what they are made of."""

from __future__ import annotations

from icwafer.pictures.effects import EFFECTS
from icwafer.pictures.model import (
    Camera,
    Dust,
    Environment,
    Irregular,
    Light,
    NodeValue,
    Picture,
    Render,
    Response,
    Table,
    Vector,
    View,
)
from icwafer.pictures.photograph import PHOTOGRAPH
from icwafer.pictures.studio import STUDIO

__all__ = [
    "PICTURES",
    "Camera",
    "Dust",
    "Environment",
    "Irregular",
    "Light",
    "NodeValue",
    "Picture",
    "Render",
    "Response",
    "Table",
    "Vector",
    "View",
]

PICTURES: dict[str, Picture] = {**EFFECTS, "photograph": PHOTOGRAPH, **STUDIO}
