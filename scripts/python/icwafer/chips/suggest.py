# SPDX-License-Identifier: GPL-2.0-or-later
"""Messages about names that do not exist."""

from __future__ import annotations

import difflib
from collections.abc import Iterable


def unknown(what: str, name: str, known: Iterable[str]) -> str:
    """No such thing of that name, the nearest one, or all if none is near."""
    names = list(known)
    near = difflib.get_close_matches(name, names, n=1, cutoff=0.5)
    hint = f"did you mean '{near[0]}'?" if near else f"choose from {', '.join(names)}"
    return f"no {what} '{name:.60}': {hint}" if what else f"'{name:.60}' is unknown: {hint}"
