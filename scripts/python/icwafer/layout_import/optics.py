# SPDX-License-Identifier: GPL-2.0-or-later
"""From the gratings in a tile's layers to what the node shows of them.

Light that falls on the chip meets the highest metal first: of a lower layer only what lies in the
gaps above it is seen. Wires above that know nothing of those below take away a share of them at
random, and so multiply all of the lower layer's orders by the visible share v; its first order, of
amplitude a, has the power v^2 a^2 R where R is what the metal reflects. The grating with the most
power gives the tile its colours: its period, direction and duty cycle, the oxide above its layer
and the thickness of its metal. The node shows wires without gaps; where they fill a part p of the
tile only ("presence"), the light that keeps the phase from wire to wire has (v p)^2 of that power.
That is the strength, `diffraction`.

The strongest grating across the first one, if it is strong enough to be seen, is the node's second
family. It has to take the strength of the first; so its width is not its own but that which gives
its orders the right power.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from icwafer.layout_import.process import Process
from icwafer.layout_import.spectrum import Grating

#: How far from a right angle a second family may be, and its least power relative to the first.
ACROSS_RAD = np.radians(2.0)
FAINTEST_CROSS = 0.02
#: A tile that diffracts less is dark; full wires diffract 1.
FAINTEST = 1e-3


@dataclass(frozen=True)
class Finding:
    """A grating of a tile. layer: index into the process's layers. visible: the share of the
    layer's metal that has no other above it."""

    layer: int
    visible: float
    grating: Grating


@dataclass(frozen=True)
class Look:
    """What a tile looks like, in the node's inputs; all 0 and layers -1 where it is dark."""

    layer: int = -1
    cross_layer: int = -1
    spacing_nm: float = 0.0
    width_nm: float = 0.0
    direction_rad: float = 0.0
    oxide_nm: float = 0.0
    groove_nm: float = 0.0
    diffraction: float = 0.0
    cross_spacing_nm: float = 0.0
    cross_width_nm: float = 0.0


def look_of(findings: Iterable[Finding], process: Process) -> Look:
    """What a tile with these gratings looks like from above."""

    def power(finding: Finding) -> float:
        amplitude = finding.visible * finding.grating.amplitude
        return amplitude**2 * process.layers[finding.layer].reflectance

    ranked = sorted(findings, key=power, reverse=True)
    if not ranked:
        return Look()
    first = ranked[0]
    coherent = first.visible * first.grating.presence
    if coherent**2 < FAINTEST:
        return Look()
    layer = process.layers[first.layer]
    period_nm = 1000 * first.grating.period_um
    cross = next(
        (
            other
            for other in ranked[1:]
            if _is_across(first.grating, other.grating)
            and power(other) > FAINTEST_CROSS * power(first)
        ),
        None,
    )
    return Look(
        layer=first.layer,
        cross_layer=cross.layer if cross else -1,
        spacing_nm=period_nm,
        width_nm=first.grating.duty * period_nm,
        direction_rad=first.grating.direction_rad,
        oxide_nm=process.oxide_nm(layer),
        groove_nm=1000 * layer.thickness_um,
        diffraction=coherent**2,
        cross_spacing_nm=1000 * cross.grating.period_um if cross else 0.0,
        cross_width_nm=_cross_width_nm(cross, power(cross) / power(first), first) if cross else 0,
    )


def _is_across(one: Grating, other: Grating) -> bool:
    turn = (one.direction_rad - other.direction_rad) % np.pi
    return abs(turn - np.pi / 2) < ACROSS_RAD


def _cross_width_nm(cross: Finding, power: float, first: Finding) -> float:
    """Width with which wires of the first family's presence have the second one's power.

    A duty cycle f gives the first order sin(pi f) / pi; of the two that fit, on the side of the
    real one.
    """
    sine = np.sqrt(power) * np.sin(np.pi * first.grating.duty)
    duty = float(np.arcsin(min(1.0, sine))) / np.pi
    if cross.grating.duty > 0.5:
        duty = 1 - duty
    return duty * 1000 * cross.grating.period_um
