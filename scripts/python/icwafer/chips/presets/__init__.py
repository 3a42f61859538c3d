# SPDX-License-Identifier: GPL-2.0-or-later
"""Ready layouts after real kinds of chip, by name."""

from __future__ import annotations

from icwafer.chips.model import Layout
from icwafer.chips.presets import (
    bar_memory,
    dram,
    fpga,
    graphics,
    image_sensor,
    microcontroller,
    power,
    processor,
    spacing,
    test_chip,
)

PRESETS: dict[str, Layout] = {
    "eight-core": processor.LAYOUT,
    "graphics": graphics.LAYOUT,
    "dram": dram.LAYOUT,
    "bar-memory": bar_memory.LAYOUT,
    "image-sensor": image_sensor.LAYOUT,
    "microcontroller": microcontroller.LAYOUT,
    "fpga": fpga.LAYOUT,
    "power": power.LAYOUT,
    "test-chip": test_chip.LAYOUT,
    "spacing-uniform": spacing.UNIFORM,
    "spacing-normal": spacing.NORMAL,
    "spacing-clustered": spacing.CLUSTERED,
}

#: The presets for people to choose from: a title and a sentence for each.
TITLES: dict[str, tuple[str, str]] = {
    "eight-core": ("Eight-Core Processor", "Two complexes of four cores around shared caches"),
    "graphics": ("Graphics Processor", "Eight clusters and a shared cache, as large as a reticle"),
    "dram": ("DRAM", "Sixteen banks of memory, with the pads in a line through the middle"),
    "bar-memory": ("Two-Bar Memory", "Small, on a wafer as in a photograph: two bars of cells"),
    "image-sensor": ("Image Sensor", "12 megapixels: the pixels are the grating, both ways"),
    "microcontroller": ("Microcontroller", "Small and simple, half of it flash memory and RAM"),
    "fpga": ("FPGA", "Columns of equal tiles, cut into clock regions"),
    "power": ("Power Management", "Four switching regulators under thick metal: fine colours"),
    "test-chip": ("Test Chip", "Fields of wires of many spacings, between rows of probe pads"),
    "spacing-uniform": ("Spacing: Uniform", "Any spacing from 800 to 1200 nm: a disordered mess"),
    "spacing-normal": ("Spacing: Normal", "1000 nm, give or take 50: the blocks all but vanish"),
    "spacing-clustered": (
        "Spacing: Clustered",
        "A large group for the background colour, smaller ones for texture",
    ),
}
