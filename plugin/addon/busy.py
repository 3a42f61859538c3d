# SPDX-License-Identifier: GPL-2.0-or-later
"""Work that takes long: how far it is, that it can be cancelled, and that it leaves all or nothing.

Such work is a generator that yields how much of it is done, 0 to 1, or None while it waits for
something, and returns its result.
"""

from __future__ import annotations

import contextlib
import time
from collections.abc import Generator, Iterator
from typing import TypeVar

import bpy

from .errors import reported

T = TypeVar("T")
Steps = Generator[float | None, None, T]

#: How often work in steps goes on, and how long it may hold up the window each time.
_TICK_S = 0.1
_KINDS = ("objects", "meshes", "materials", "collections", "node_groups")


def finished(context: bpy.types.Context, steps: Steps[T]) -> T:
    """Does all the work at once, while the mouse pointer shows how far it is."""
    manager = context.window_manager
    manager.progress_begin(0, 100)
    try:
        while True:
            done = next(steps)
            if done is not None:
                manager.progress_update(round(100 * done))
    except StopIteration as end:
        return end.value
    finally:
        manager.progress_end()


@contextlib.contextmanager
def all_or_nothing() -> Iterator[None]:
    """Removes what was made meanwhile from the file if it ends with an error or is cancelled."""

    def things() -> set[bpy.types.ID]:
        return {thing for kind in _KINDS for thing in getattr(bpy.data, kind)}

    before = things()
    try:
        yield
    except BaseException:
        bpy.data.batch_remove(things() - before)
        raise


class InSteps:
    """An operator whose work can go on in steps, while its user does something else; Esc cancels.

    `steps` is the work. It sets `doing`, what it is at, and `alone` while nothing else may happen:
    when it makes things, which undo would take from under it.
    """

    alone = False

    def steps(self, context: bpy.types.Context) -> Steps[None]:
        """The work. In steps it must not wait; all at once it may."""
        raise NotImplementedError

    def start(self, context: bpy.types.Context) -> set[str]:
        """Begins the work; `modal` goes on with it."""
        manager = context.window_manager
        self._work, self._done, self._shown = self.steps(context), 0.0, ""
        self._timer = manager.event_timer_add(_TICK_S, window=context.window)
        self.doing = self.bl_label
        self._show(context)
        manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        result = {"CANCELLED"}
        try:
            result = self._go_on(context, event)
        finally:
            if result & {"FINISHED", "CANCELLED"}:
                self.cancel(context)
        return result

    def cancel(self, context: bpy.types.Context) -> None:
        """Ends the work where it is; Blender calls this, too, when it closes or loads a file."""
        self._work.close()
        context.window_manager.event_timer_remove(self._timer)
        if context.workspace:
            context.workspace.status_text_set(None)

    @reported
    def _go_on(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if event.type == "ESC" and event.value == "PRESS":
            self.report({"INFO"}, f"{self.bl_label}: cancelled")
            return {"CANCELLED"}
        if event.type == "TIMER":
            end = time.monotonic() + _TICK_S
            try:
                while time.monotonic() < end:
                    done = next(self._work)
                    if done is None:
                        break
                    self._done = done
            except StopIteration:
                return {"FINISHED"}
            self._show(context)
        return {"RUNNING_MODAL" if self.alone else "PASS_THROUGH"}

    def _show(self, context: bpy.types.Context) -> None:
        text = f"{self.doing}: {self._done:.0%}"

        def draw(header: bpy.types.Header, _context: bpy.types.Context) -> None:
            row = header.layout.row(align=True)
            row.label(text=text, icon="IMPORT")
            row.label(text="Cancel", icon="EVENT_ESC")

        if text != self._shown:
            self._shown = text
            # Blender crashes on what is callable but no function, as of functools.partial.
            context.workspace.status_text_set(draw)
