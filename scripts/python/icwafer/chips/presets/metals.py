# SPDX-License-Identifier: GPL-2.0-or-later
"""Wiring layers of real processes, as published: what the groups of the presets are made from."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Metal:
    """Period, width and thickness of a layer's wires at their closest."""

    spacing_nm: float
    width_nm: float
    thickness_nm: float


# SkyWater 130 nm: track pitches, minimum widths and thicknesses of the open design kit
# (skywater-pdk, rules of the periphery and LEF of sky130_fd_sc_hd). The standard cells' rows are
# 2.72 um high, and met1 carries their rails; the single-port bit cell of its SRAM is 1.58 um high.
SKY130_ROW = Metal(2720, 480, 350)
SKY130_MET2 = Metal(460, 140, 350)
SKY130_MET3 = Metal(680, 300, 800)
SKY130_MET4 = Metal(920, 300, 800)
SKY130_MET5 = Metal(3400, 1600, 1200)
SKY130_SRAM = Metal(1580, 480, 350)

# Intel 45 nm: K. Mistry et al., IEDM 2007, table of the interconnect.
INTEL45_M6 = Metal(360, 180, 324)
INTEL45_M7 = Metal(560, 280, 504)
INTEL45_M8 = Metal(810, 400, 720)

# Intel 65 nm: P. Bai et al., IEDM 2004, table of the interconnect. It does not give widths: two
# fifths of the period are assumed, for with a half every second order is dark.
INTEL65_M6 = Metal(480, 192, 432)
INTEL65_M7 = Metal(720, 288, 650)
INTEL65_M8 = Metal(1080, 432, 975)

# IHP 130 nm BiCMOS: layout rules of the open design kit SG13G2 (minimum width and distance).
IHP_METAL5 = Metal(410, 200, 490)
IHP_TOP1 = Metal(3280, 1640, 2000)
IHP_TOP2 = Metal(4000, 2000, 3000)
