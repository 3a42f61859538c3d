# SPDX-License-Identifier: GPL-2.0-or-later
"""The three statistics of the original project (Stanford CS 348B, silicon wafers), on one die.

Uniform in 800 to 1200 nm: a disordered mess. Normal, 1000 +- 50 nm: the blocks all but vanish.
Clustered: the largest group gives the background, the smaller ones texture.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from icwafer.chips.model import DieSpec, Group, Kind, Layout
from icwafer.chips.spread import Normal, Spread, Uniform

#: The largest group gives the background, the others texture.
CLUSTERED_GROUPS = (
    Group("core logic", Kind.LOGIC, Normal(1080, 7), diffraction=Normal(0.5, 0.04), weight=4.0),
    Group("dense logic", Kind.LOGIC, Normal(960, 14), diffraction=Normal(0.4, 0.05), turned=1.0),
    Group("cache", Kind.MEMORY, Normal(1190, 6), diffraction=Normal(0.6, 0.03), weight=2.0),
    Group(
        "register file", Kind.MEMORY, Normal(1000, 10), diffraction=Normal(0.4, 0.04), turned=1.0
    ),
    Group("analog", Kind.ANALOG, Normal(1270, 12), diffraction=Normal(0.35, 0.04), turned=0.5),
    Group("pads", Kind.IO, Normal(920, 15), diffraction=Normal(0.4, 0.04)),
    Group("channel", Kind.STRIP, Normal(1000), diffraction=Normal(0.0)),
)

#: One kind of block beside another no longer differs, but for the channels.
EVEN_GROUPS = tuple(
    group if group.kind == Kind.STRIP else replace(group, diffraction=Normal(0.5), turned=0.0)
    for group in CLUSTERED_GROUPS
)


def with_spacing(groups: Sequence[Group], spacing_nm: Spread) -> tuple[Group, ...]:
    """The same groups, with one spread of the spacing for all blocks of the die."""
    return tuple(replace(group, spacing_nm=spacing_nm) for group in groups)


UNIFORM_DIE = DieSpec(
    with_spacing(CLUSTERED_GROUPS, Uniform(800, 1200)),
    name="spacing-uniform",
    seed=6,
    copies_alike=False,
)
NORMAL_DIE = DieSpec(
    with_spacing(EVEN_GROUPS, Normal(1000, 50 / 3)), name="spacing-normal", seed=6
)
CLUSTERED_DIE = DieSpec(CLUSTERED_GROUPS, name="spacing-clustered", seed=6)

UNIFORM, NORMAL, CLUSTERED = (Layout((die,)) for die in (UNIFORM_DIE, NORMAL_DIE, CLUSTERED_DIE))
