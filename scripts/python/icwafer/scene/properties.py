# SPDX-License-Identifier: GPL-2.0-or-later
"""Setting Blender's properties, with errors that name the setting."""

from __future__ import annotations

from typing import Any

import bpy

from icwafer.errors import SettingError


def assign(owner: bpy.types.bpy_struct, attribute: str, value: Any, setting: str) -> None:
    """Sets a property. Raises SettingError where this Blender has none or refuses the value."""
    try:
        setattr(owner, attribute, value)
    except (AttributeError, TypeError, ValueError) as error:
        reason = str(error).split(": ", 1)[-1].split("= val: ")[-1]
        raise SettingError(f"is not possible here: {' '.join(reason.split())}", setting) from None
