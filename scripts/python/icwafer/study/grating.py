# SPDX-License-Identifier: GPL-2.0-or-later
"""What the places of the orders in a picture follow from, for those who draw them over it."""

from __future__ import annotations

from typing import Any

from icwafer.pictures import Picture


def gratings(picture: Picture) -> list[dict[str, Any]]:
    """One entry for each lamp, if all blocks of the die have the same wires; else none.

    An entry has the camera, the light and the plane, lengths in mm, `spacing_nm` and
    `direction_rad` from the plane's x axis.
    """
    wires = _wires(picture)
    if wires is None:
        return []
    camera = picture.camera
    return [
        {
            "camera": {
                "position_mm": list(camera.position_mm),
                "target_mm": list(camera.target_mm),
                "lens_mm": camera.lens_mm,
                "roll_deg": camera.roll_deg,
            },
            "light": {"position_mm": list(light.position_mm)},
            "plane": {"point": [0, 0, 0], "normal": [0, 0, 1], "x_axis": [1, 0, 0]},
            "spacing_nm": wires[0],
            "direction_rad": wires[1],
        }
        for light in picture.lights
        if light.kind != "CARD"
    ]


def _wires(picture: Picture) -> tuple[float, float] | None:
    """Spacing and direction of all blocks that diffract; None where they differ."""
    groups = [group for group in picture.die.groups if group.diffraction.high > 0]
    spacings = {group.spacing_nm.mean for group in groups}
    turns = {(group.turned, group.direction_deg) for group in groups}
    if "Wire Spacing" in picture.node:
        spacings = {float(picture.node["Wire Spacing"])}
    direction = picture.node.get("Direction", 0.0 if turns == {(0.0, 0.0)} else None)
    if len(spacings) != 1 or direction is None:
        return None
    return spacings.pop(), float(direction)
