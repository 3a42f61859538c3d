# SPDX-License-Identifier: GPL-2.0-or-later
"""A small memory of two bars of cells, and its wafer, after a photograph of a 200 mm wafer.

Measured in the photograph "Si wafer" by Enrique Jimenez (CC BY-SA 2.0): the pitch of the dies
relative to the wafer, the shares of bars and dark strips, the reticle fields of 3 x 5 dies, which
of them hold test dies, which were not exposed, and where the rim cuts the pattern. Of the wires
the photograph shows u d only, 960 to 1580 nm over the wafer (orders 2 and 3), where u depends on
the lamp. Period, width, depth and film are those that, with the lamps of the picture `photograph`,
come nearest to the colours of its dies and test fields; the size is one that fits such a wafer.
"""

from __future__ import annotations

import math

from icwafer.chips.model import DieSpec, Group, Kind, Layout
from icwafer.chips.spread import Normal
from icwafer.chips.tree import Cut, Macro, Node, Part, Ring, Tiles
from icwafer.chips.wafer import Drift, Wafer

_GROOVE_NM = 290.4
_FILL_NM = 800.0


def _wires(
    name: str,
    kind: Kind,
    spacing_nm: float,
    duty: float,
    oxide_nm: float = 152.9,
    variation: float = 0.001,
    diffraction: float = 1.0,
    groove_nm: float = _GROOVE_NM,
    strength: float = 1.0,
) -> Group:
    """Blocks of equal wires. duty: width as a share of the spacing.

    strength: of the diffraction. Metal across the wires, too fine for visible light, fills part of
    the grooves: the amplitude falls with what is left of them.
    """
    return Group(
        name,
        kind,
        spacing_nm=Normal(spacing_nm),
        width_nm=Normal(round(duty * spacing_nm, 1)),
        oxide_nm=Normal(oxide_nm),
        diffraction=Normal(diffraction),
        spacing_variation=Normal(variation),
        groove_nm=Normal(groove_nm),
        cross_spacing_nm=Normal(_FILL_NM if strength < 1.0 else 0.0),
        cross_width_nm=Normal(round(_FILL_NM * (1.0 - math.sqrt(strength)), 1)),
    )


#: Wires too fine for visible light, and a quarter of a wave deep: black. Metal of many shapes.
_FINE = _wires("fine", Kind.STRIP, 300.0, 0.5, groove_nm=92.0)
_LANE_METAL = _wires("lane", Kind.SEAL, 2900.0, 0.42, variation=0.05, diffraction=0.25)
_STRIP = Macro(Kind.STRIP)
_LANE = Macro(Kind.SEAL)

#: Rows of cells of several heights, even all over; between them lines of amplifiers.
_CELLS = Macro(Kind.PIXEL)
_BAR = Cut(
    1,
    tuple(
        part
        for _ in range(7)
        for part in (Part(_CELLS, (0.6, 1.4)), Part(Macro(Kind.BUS), um=70.0))
    )
    + (Part(_CELLS, 0.8),),
)
#: Half of a pad is at each side: the saw would part them.
_PADS = Tiles(Cut(1, (Part(Macro(Kind.IO), 0.76), Part(_STRIP, 0.24))), columns=1, rows=5)
_BARS = Cut(
    0,
    (
        Part(_PADS, um=100.0),
        Part(_STRIP, um=372.0),
        Part(_BAR),
        Part(_STRIP, um=430.0),
        Part(_BAR),
        Part(_STRIP, um=350.0),
        Part(_PADS, um=100.0),
    ),
)


def _with_lanes(inside: Node, um: float) -> Cut:
    """Scribe lanes with their metal below and above something, and dark lines along them."""
    dark = Part(_STRIP, um=45.0)
    return Cut(1, (Part(_LANE, um=um), dark, Part(inside), dark, Part(_LANE, um=um)))


TREE = _with_lanes(_BARS, 130.0)

PRODUCT = DieSpec(
    name="bar-memory",
    floorplan="bar-memory",
    seed=1,
    width_mm=4.02,
    height_mm=4.84,
    block_um=500.0,
    groups=(
        _wires("cells", Kind.PIXEL, 1777.6, 0.376),
        _wires("amplifiers", Kind.BUS, 1886.0, 0.376),
        _wires("pads", Kind.IO, 5200.0, 0.3, variation=0.3, diffraction=0.8),
        _LANE_METAL,
        _FINE,
    ),
)


#: Spacing, duty cycle, oxide, variation, and strength: the nearest to the photograph's colours.
_ARRAYS = {
    "array a": (3536.0, 0.139, 729.0, 0.039, 0.34),
    "array b": (3571.0, 0.311, 423.0, 0.022, 0.47),
    "array c": (3160.0, 0.153, 559.0, 0.106, 0.44),
}
_CIRCUIT = (4062.0, 0.113, 833.0, 0.077, 0.44)


def _array(role: str) -> Ring:
    """A square of test structures: brighter columns of one pattern on a darker ground of it."""
    ground = Macro(Kind.PIXEL, f"{role} ground")
    column = Cut(0, (Part(Macro(Kind.PIXEL, role), 0.25), Part(ground, 0.75)))
    return Ring(240.0, ground, Tiles(column, columns=8, rows=1))


_CIRCUITS = Ring(
    200.0,
    Macro(Kind.FILL, "circuit frame"),
    Cut(
        0,
        (
            Part(Macro(Kind.LOGIC), 1.0),
            Part(Macro(Kind.ANALOG), 0.5),
            Part(Tiles(Macro(Kind.LOGIC), columns=2, rows=3, mirror="x"), 0.6),
        ),
    ),
)


def _row(node: Node) -> Part:
    return Part(Ring(45.0, _LANE, Tiles(node, columns=2, rows=1)))


#: From below: circuits, then three rows of arrays.
TEST_TREE = Cut(
    1,
    (
        _row(_CIRCUITS),
        *(_row(Ring(60.0, _STRIP, _array(role))) for role in reversed(_ARRAYS)),
    ),
)

TEST = DieSpec(
    name="bar-memory-test",
    floorplan="bar-memory-test",
    seed=11,
    width_mm=12.2,
    height_mm=24.5,
    block_um=300.0,
    groups=(
        *(
            _wires(role + part, Kind.PIXEL, *wires, strength=share * strength)
            for role, (*wires, strength) in _ARRAYS.items()
            for part, share in (("", 1.5), (" ground", 0.85))
        ),
        _wires("circuit frame", Kind.FILL, *_CIRCUIT[:4], strength=0.5 * _CIRCUIT[4]),
        _wires("logic", Kind.LOGIC, *_CIRCUIT[:4], strength=_CIRCUIT[4]),
        _wires("analog", Kind.ANALOG, *_ARRAYS["array b"][:4], strength=_CIRCUIT[4]),
        _LANE_METAL,
        _FINE,
    ),
)

LAYOUT = Layout(
    dies=(PRODUCT, TEST),
    wafer=Wafer(
        diameter_mm=200,
        edge_exclusion_mm=2.35,
        film_edge_mm=0.22,
        bevel_mm=0.4,
        field_columns=3,
        field_rows=5,
        centre_x="die",
        centre_y="die",
        field_shift_columns=1,
        field_shift_rows=1,
        partial_dies=True,
        test_fields=((-4, -2), (-3, -2), (-3, -3), (-5, 2), (-4, 2), (-4, 3)),
        blank_fields=((-7, 2), (-7, -2), (-5, -3), (3, 4), (-3, 4)),
        oxide=Drift(bow=0.01, tilt=0.005, tilt_direction_deg=140.0, noise=0.001),
    ),
)
