# SPDX-License-Identifier: GPL-2.0-or-later
"""What the presets share: groups from wiring layers, and the rings around a chip."""

from __future__ import annotations

from icwafer.chips.model import Group, Kind
from icwafer.chips.presets.metals import Metal
from icwafer.chips.spread import Normal
from icwafer.chips.tree import Macro, Node, Ring, Tiles
from icwafer.chips.wafer import Drift, Wafer

STRIP = Macro(Kind.STRIP)


def group(
    name: str,
    kind: Kind,
    metal: Metal,
    variation: float = 0.006,
    diffraction: float = 0.5,
    turned: float = 0.0,
    weight: float = 1.0,
    across: Metal | None = None,
    oxide_nm: float = 530.0,
) -> Group:
    """Blocks whose topmost regular wires are those of a layer, and those of `across` below them.

    variation: of the spacing from block to block, relative, three deviations of it at most.
    """
    return Group(
        name,
        kind,
        spacing_nm=Normal(metal.spacing_nm, round(variation * metal.spacing_nm, 3)),
        width_nm=Normal(metal.width_nm),
        oxide_nm=Normal(oxide_nm, 4.0),
        diffraction=Normal(diffraction, 0.03),
        turned=turned,
        weight=weight,
        spacing_variation=Normal(round(variation / 2, 4)),
        cross_spacing_nm=Normal(across.spacing_nm if across else 0.0),
        cross_width_nm=Normal(across.width_nm if across else 0.0),
        groove_nm=Normal(metal.thickness_nm, round(0.01 * metal.thickness_nm, 3)),
    )


def dark_groups(pads: Metal) -> tuple[Group, ...]:
    """What every chip has: channels, pads, the seal ring with its few wide wires."""
    return (
        Group("channel", Kind.STRIP, Normal(1000.0), diffraction=Normal(0.0)),
        group("pads", Kind.IO, pads, variation=0.01, diffraction=0.3),
        group("seal ring", Kind.SEAL, pads, variation=0.0, diffraction=0.1),
    )


def drifting_wafer(**fields: object) -> Wafer:
    """A wafer with the usual drift, and other fields as given.

    Films from a showerhead or a polisher keep their thickness within a few per cent over a wafer,
    mostly with the radius; the etch of the grooves less, and the wires' width follows the
    exposure. Usual orders of magnitude: D. Boning and S. Nassif, Models of process variations in
    device and interconnect, 2000. Here such that the film's colour changes visibly.
    """
    return Wafer(
        oxide=Drift(bow=0.03, ring=0.012, tilt=0.01, tilt_direction_deg=25.0, noise=0.001),
        groove=Drift(bow=-0.015, ring=0.006, tilt=0.008, tilt_direction_deg=115.0, noise=0.002),
        width=Drift(bow=0.01, tilt=0.005, tilt_direction_deg=60.0, noise=0.003),
        **fields,
    )


def chip(core: Node, seal_um: float = 40.0, pad_um: float = 90.0, moat_um: float = 30.0) -> Ring:
    """A core with the rings around it: seal ring, pads, and a moat without wires.

    pad_um: depth of the pads; they stand 1.2 times as far apart.
    """
    pads = Tiles(Macro(Kind.IO), pitch_um=1.2 * pad_um)
    return Ring(seal_um, Macro(Kind.SEAL), Ring(pad_um, pads, Ring(moat_um, STRIP, core)))
