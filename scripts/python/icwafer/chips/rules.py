# SPDX-License-Identifier: GPL-2.0-or-later
"""What the fields of a layout may hold, stated once, where the field is declared.

The reader, the checks, the command line and the manual all take it from there: `rule_of` returns
the rule of a field of a dataclass.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable
from dataclasses import MISSING, dataclass, field
from typing import Any


@dataclass(frozen=True)
class Rule:
    """The values that a field allows.

    low, high: the ends of the range, for numbers and every value of a spread; of an array's size,
    for tuples. choices: the names that a text may be, asked for when they are needed.
    """

    help: str
    low: float = -math.inf
    high: float = math.inf
    choices: Callable[[], tuple[str, ...]] | None = None

    @property
    def range(self) -> str:
        """The range as a message says it."""
        return f"{self.low:.10g} to {self.high:.10g}"

    def allows(self, value: float) -> bool:
        """Whether a number is inside the range; no number (NaN) never is."""
        return self.low <= value <= self.high


def ruled(
    help: str,
    low: float = -math.inf,
    high: float = math.inf,
    *,
    choices: Callable[[], tuple[str, ...]] | None = None,
    default: Any = MISSING,
) -> Any:
    """A field of a dataclass with a rule; without a default it has to be given."""
    return field(default=default, metadata={"rule": Rule(help, low, high, choices)})


def rule_of(declared: dataclasses.Field) -> Rule:
    """The rule of a field that `ruled` declared."""
    return declared.metadata["rule"]
