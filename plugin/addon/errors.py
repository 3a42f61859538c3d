# SPDX-License-Identifier: GPL-2.0-or-later
"""What goes wrong in the package icwafer becomes one line that Blender shows to its user."""

from __future__ import annotations

import functools
from collections.abc import Callable

import bpy


def reported(execute: Callable[..., set[str]]) -> Callable[..., set[str]]:
    """An operator's `execute` or the like that reports bad input instead of raising it."""

    @functools.wraps(execute)
    def wrapped(
        self: bpy.types.Operator, context: bpy.types.Context, *arguments: object
    ) -> set[str]:
        try:
            from icwafer.errors import IcwaferError
        except ImportError as error:
            text = f"{error}: the add-on IC Wafer works only as installed with its Blender"
            self.report({"ERROR"}, text)
            return {"CANCELLED"}
        try:
            return execute(self, context, *arguments)
        except IcwaferError as error:
            self.report({"ERROR"}, str(error))
        except OSError as error:
            self.report({"ERROR"}, f"{error.filename}: {error.strerror}")
        except MemoryError:
            self.report({"ERROR"}, "This needs more memory than there is: make larger blocks")
        return {"CANCELLED"}

    return wrapped
