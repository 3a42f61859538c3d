# SPDX-License-Identifier: GPL-2.0-or-later
"""How many blocks of a die are made in a second, on one core, and what it takes to read them:

PYTHONPATH=scripts/python taskset -c 0 /usr/bin/python3 tests/benchmarks/bench_layout.py [PRESET ...]

Every preset is made with blocks so small that there are about a million of them. The best of five
runs counts.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from dataclasses import replace

from icwafer.chips.die import generate
from icwafer.chips.document import layout_text, parse_layout
from icwafer.chips.model import BlockTable, Die, DieSpec, Layout
from icwafer.chips.presets import PRESETS

MILLION = 1_000_000
FLOORPLANS = [name for name in PRESETS if not name.startswith("spacing")]


def best_of(runs: int, work: Callable[[], object]) -> float:
    """Seconds of processor time of the fastest run: it is one thread, and others may be busy."""
    times = []
    for _ in range(runs):
        start = time.process_time()
        work()
        times.append(time.process_time() - start)
    return min(times)


def with_a_million_blocks(spec: DieSpec) -> Die:
    """The die with the largest `block_um` that gives a million blocks."""
    die = generate(spec)
    while len(die) < MILLION:
        spec = replace(spec, block_um=spec.block_um * min(0.9, (len(die) / MILLION) ** 0.5))
        die = generate(spec)
    return die


def main(names: list[str]) -> None:
    print(f"{'preset':16} {'blocks':>9} {'block_um':>9} {'s':>6} {'million/s':>10}")
    for name in names:
        die = with_a_million_blocks(PRESETS[name].dies[0])
        seconds = best_of(5, lambda: generate(die.spec))
        speed = len(die) / seconds / MILLION
        print(f"{name:16} {len(die):9} {die.spec.block_um:9.2f} {seconds:6.3f} {speed:10.2f}")
    listed = replace(die.spec, blocks=BlockTable(die.rect_nm, die.group))
    text = layout_text(Layout((listed,)))
    writing = best_of(2, lambda: layout_text(Layout((listed,))))
    reading = best_of(2, lambda: parse_layout(text, name))
    size = len(text) / MILLION
    print(f"listed, {name}: {size:.1f} MB, written in {writing:.2f} s, read in {reading:.2f} s")


if __name__ == "__main__":
    main(sys.argv[1:] or FLOORPLANS)
