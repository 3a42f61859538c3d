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
