# SPDX-License-Identifier: GPL-2.0-or-later
"""All floorplans by name."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np

from icwafer.chips import pictures_plan
from icwafer.chips.plan import Plan
from icwafer.chips.presets import (
    bar_memory,
    dram,
    fpga,
    graphics,
    image_sensor,
    microcontroller,
    power,
    processor,
    test_chip,
)
from icwafer.chips.tree import tree_plan

#: Makes the plan of a die from random numbers, width_nm, height_nm and block_um.
Floorplan = Callable[[np.random.Generator, int, int, float], Plan]

FLOORPLANS: dict[str, Floorplan] = {
    "pictures": pictures_plan.pictures,
    "eight-core": partial(tree_plan, processor.TREE),
    "graphics": partial(tree_plan, graphics.TREE),
    "dram": partial(tree_plan, dram.TREE),
    "bar-memory": partial(tree_plan, bar_memory.TREE),
    "bar-memory-test": partial(tree_plan, bar_memory.TEST_TREE),
    "image-sensor": partial(tree_plan, image_sensor.TREE),
    "microcontroller": partial(tree_plan, microcontroller.TREE),
    "fpga": partial(tree_plan, fpga.TREE),
    "power": partial(tree_plan, power.TREE),
    "test-chip": partial(tree_plan, test_chip.TREE),
}
