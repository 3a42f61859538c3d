# SPDX-License-Identifier: GPL-2.0-or-later
"""The mouse pointer shows how far long work is."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterator

import bpy


@contextlib.contextmanager
def progress(context: bpy.types.Context) -> Iterator[Callable[[float], None]]:
    """Gives a function that takes how much of the work is done, 0 to 1."""
    manager = context.window_manager
    manager.progress_begin(0, 100)
    try:
        yield lambda share: manager.progress_update(round(100 * share))
    finally:
        manager.progress_end()
