# SPDX-License-Identifier: GPL-2.0-or-later
"""The description of a wafer: its shape after SEMI M1, its fields of dies, and their drift.

Millimetres; the wafer's centre is the origin, and the notch or primary flat is at the bottom
(direction -y).
"""

from __future__ import annotations

from dataclasses import dataclass

from icwafer.chips.rules import ruled


@dataclass(frozen=True)
class Drift:
    """How a quantity varies over the wafer, relative to its mean over the wafer.

    Films are thicker or thinner towards the rim, and a little more on one side: the shape is a sum
    of Zernike polynomials (F. Zernike, Physica 1, 1934), each with a mean of 0 over the wafer,
    with rho = r / radius: bow (2 rho^2 - 1) + ring (6 rho^4 - 6 rho^2 + 1) + tilt rho cos(phi -
    tilt direction).
    """

    bow: float = ruled(
        "rim against centre: the rim has +bow, the centre -bow", -0.3, 0.3, default=0.0
    )
    ring: float = ruled("centre and rim against the ring between them", -0.3, 0.3, default=0.0)
    tilt: float = ruled("one side against the other", -0.3, 0.3, default=0.0)
    tilt_direction_deg: float = ruled("where the tilt is highest", -360, 360, default=0.0)
    noise: float = ruled("standard deviation from die to die", 0, 0.1, default=0.0)


def mark_names() -> tuple[str, ...]:
    """The orientation marks that a wafer may have."""
    return ("notch", "flats", "none")


def centre_names() -> tuple[str, ...]:
    """What may stand at the wafer's centre."""
    return ("most", "die", "lane")


@dataclass(frozen=True)
class Wafer:
    """A wafer full of dies.

    test_fields: places, in whole reticle fields from the field at the centre, that hold a test
    die (the layout's second die) instead of products. blank_fields: places that were not exposed
    and stay without dies.
    """

    diameter_mm: int = ruled(
        "of a size of SEMI M1: 100, 125, 150, 200 or 300", 100, 300, default=300
    )
    mark: str = ruled("how its orientation is marked", choices=mark_names, default="notch")
    edge_exclusion_mm: float = ruled("rim without dies", 0, 30, default=3.0)
    film_edge_mm: float = ruled(
        "width of the pale line along which films end, in the edge exclusion", 0, 3, default=0.0
    )
    bevel_mm: float = ruled("width of the rounded edge", 0, 1, default=0.35)
    scribe_um: float = ruled("lane between dies, where they are cut apart", 0, 1_000, default=80.0)
    field_columns: int = ruled(
        "dies of one reticle field along x, 0: as many as fit", 0, 1_000, default=0
    )
    field_rows: int = ruled(
        "dies of one reticle field along y, 0: as many as fit", 0, 1_000, default=0
    )
    centre_x: str = ruled(
        "what is at the middle along x: a die, a lane, or whichever makes more complete dies",
        choices=centre_names,
        default="most",
    )
    centre_y: str = ruled("what is at the middle along y", choices=centre_names, default="most")
    field_shift_columns: int = ruled(
        "dies by which the grid of fields is moved along -x", 0, 1_000, default=0
    )
    field_shift_rows: int = ruled(
        "dies by which the grid of fields is moved along -y", 0, 1_000, default=0
    )
    partial_dies: bool = ruled("whether dies that the rim cuts are there", default=False)
    test_fields: tuple[tuple[int, int], ...] = ruled("where test dies stand", 0, 1_000, default=())
    blank_fields: tuple[tuple[int, int], ...] = ruled("where no die stands", 0, 1_000, default=())
    seed: int = ruled("start of its random numbers", 0, 2**32 - 1, default=1)
    oxide: Drift = ruled("drift of the oxide's thickness", default=Drift())
    groove: Drift = ruled("drift of the groove's depth", default=Drift())
    width: Drift = ruled("drift of the wires' width", default=Drift())

    @property
    def radius_mm(self) -> float:
        return self.diameter_mm / 2

    @property
    def usable_radius_mm(self) -> float:
        """Of the circle that complete dies stay in."""
        return self.radius_mm - self.edge_exclusion_mm
