# SPDX-License-Identifier: GPL-2.0-or-later
"""A small memory of two bars of cells, and its wafer, after a photograph of a 200 mm wafer.

Measured in the photograph "Si wafer" by Enrique Jimenez (CC BY-SA 2.0): the pitch of the dies
relative to the wafer, the shares of bars and dark strips, the reticle fields of 3 x 5 dies, which of
them hold test dies, which were not exposed, and where the rim cuts the pattern. The wires' period
follows from the colours there: u d runs from 980 to 1590 nm over the wafer (orders 2 and 3), which
is that of about 1300 nm under a lamp at a usual place. Width, depth and film are chosen so that a
render has the strengths of the photograph's colours.
"""

from __future__ import annotations

from icwafer.chips.model import DieSpec, Group, Kind, Layout
from icwafer.chips.spread import Normal
from icwafer.chips.tree import Cut, Macro, Node, Part, Ring, Tiles
from icwafer.chips.wafer import Drift, Wafer

_OXIDE_NM = Normal(573.0, 1.0)
_GROOVE_NM = Normal(492.0, 1.0)


def _wires(
    name: str, kind: Kind, spacing_nm: float, duty: float, variation: float = 0.0, turned: float = 0.0
) -> Group:
    """Blocks of equal wires, width as a share of the spacing."""
    return Group(
        name,
        kind,
        spacing_nm=Normal(spacing_nm),
        width_nm=Normal(round(duty * spacing_nm, 1)),
        oxide_nm=_OXIDE_NM,
        spacing_variation=Normal(variation),
        groove_nm=_GROOVE_NM,
        turned=turned,
    )


#: Without a pattern: wires so thin that they diffract nothing.
_BARE = Group(
    "bare", Kind.STRIP, Normal(1000.0), Normal(1.0), _OXIDE_NM, diffraction=Normal(0.0)
)
_STRIP = Macro(Kind.STRIP)
_LANE = Macro(Kind.SEAL)

#: Twelve rows of cells; between them lines of amplifiers.
_BAR = Tiles(
    Cut(
        1,
        (
            Part(Macro(Kind.MEMORY), 0.84),
            Part(_STRIP, 0.06),
            Part(Macro(Kind.BUS), 0.10),
        ),
    ),
    columns=1,
    rows=12,
)
_PADS = Tiles(Ring(26.0, _STRIP, Macro(Kind.IO)), pitch_um=230.0)
_BARS = Cut(
    0,
    (
        Part(_PADS, um=230.0),
        Part(_STRIP, um=370.0),
        Part(_BAR),
        Part(_STRIP, um=440.0),
        Part(_BAR),
        Part(_STRIP, um=340.0),
    ),
)


def _with_lanes(inside: Node, um: float) -> Cut:
    """Scribe lanes with their metal below and above something."""
    return Cut(1, (Part(_LANE, um=um), Part(inside), Part(_LANE, um=um)))


TREE = _with_lanes(_BARS, 45.0)

PRODUCT = DieSpec(
    name="bar-memory",
    floorplan="bar-memory",
    seed=1,
    width_mm=4.02,
    height_mm=4.84,
    block_um=150.0,
    groups=(
        _wires("cells", Kind.MEMORY, 1300.0, 0.4),
        _wires("amplifiers", Kind.BUS, 1410.0, 0.35, variation=0.02),
        _wires("pads", Kind.IO, 5200.0, 0.3, variation=0.3),
        _wires("lane", Kind.SEAL, 2600.0, 0.4, variation=0.3),
        _BARE,
    ),
)


def _array(role: str) -> Ring:
    """A square of test structures: a frame, and columns of one pattern between dark lines."""
    column = Cut(0, (Part(Macro(Kind.FILL, role), 0.86), Part(_STRIP, 0.14)))
    return Ring(240.0, Macro(Kind.FILL, f"{role} frame"), Tiles(column, columns=8, rows=1))


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
        *(_row(Tiles(Ring(60.0, _LANE, _array(f"array {name}")), columns=1, rows=1)) for name in "cba"),
    ),
)

_ARRAYS = {"a": 1180.0, "b": 1120.0, "c": 1480.0}

TEST = DieSpec(
    name="bar-memory-test",
    floorplan="bar-memory-test",
    seed=1,
    width_mm=12.2,
    height_mm=24.5,
    block_um=220.0,
    groups=(
        *(
            _wires(f"array {name}{part}", Kind.FILL, factor * spacing, 0.4, variation=0.02)
            for name, spacing in _ARRAYS.items()
            for part, factor in (("", 1.0), (" frame", 0.97))
        ),
        _wires("circuit frame", Kind.FILL, 1520.0, 0.4, variation=0.05),
        _wires("logic", Kind.LOGIC, 1500.0, 0.4, variation=0.06),
        _wires("analog", Kind.ANALOG, 1140.0, 0.4, variation=0.03),
        _wires("lane", Kind.SEAL, 2600.0, 0.4, variation=0.3),
        _BARE,
    ),
)

LAYOUT = Layout(
    dies=(PRODUCT, TEST),
    wafer=Wafer(
        diameter_mm=200,
        edge_exclusion_mm=2.35,
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
        oxide=Drift(bow=0.02, tilt=0.01, tilt_direction_deg=140.0, noise=0.001),
    ),
)
