# SPDX-License-Identifier: GPL-2.0-or-later
"""Messages about names that do not exist: the nearest one that does."""

from __future__ import annotations

import difflib
from collections.abc import Iterable

_LONGEST = 60


def nearest(name: str, known: Iterable[str]) -> str:
    """The end of a message about an unknown name: the known name that is nearest, or all."""
    names = list(known)
    by_lower = {candidate.lower(): candidate for candidate in names}
    close = difflib.get_close_matches(name.lower(), by_lower, n=1, cutoff=0.55)
    if close:
        return f"did you mean {by_lower[close[0]]!r}?"
    return f"choose from {', '.join(names)}" if names else "there is none to choose from"


def unknown(what: str, name: str, known: Iterable[str]) -> str:
    """A whole message: there is no such thing of that name, but the nearest one, or all."""
    shown = f"'{name:.{_LONGEST}}'"
    return f"{f'no {what} {shown}' if what else f'{shown} is unknown'}: {nearest(name, known)}"
