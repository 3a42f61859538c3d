# SPDX-License-Identifier: GPL-2.0-or-later
"""What a layout is, in a few lines of text."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from icwafer.chips.die import generate
from icwafer.chips.model import MM, Die, Layout
from icwafer.chips.placement import place_dies, reticle_field


def summary(layout: Layout) -> Iterator[str]:
    """Lines on each die with its groups, and on the wafer."""
    for spec in layout.dies:
        yield from _die_lines(generate(spec))
    if layout.wafer is not None:
        yield from _wafer_lines(layout)


def _die_lines(die: Die) -> Iterator[str]:
    spec = die.spec
    made = "listed" if spec.blocks is not None else f"floorplan {spec.floorplan}, seed {spec.seed}"
    area_mm2 = spec.width_mm * spec.height_mm
    yield (
        f"die {spec.name}: {spec.width_mm:g} x {spec.height_mm:g} mm, {len(die)} blocks ({made})"
    )
    yield f"  {'group':22} {'kind':7} {'area':>6} {'blocks':>8}  {'spacing':>15}  across  oxide"
    areas = np.bincount(die.group, die.area_nm2, len(spec.groups)) / MM**2
    counts = np.bincount(die.group, minlength=len(spec.groups))
    for group, area, count in zip(spec.groups, areas, counts):
        deviation = group.spacing_nm.deviation
        spacing = f"{group.spacing_nm.mean:.4g}{f' +- {deviation:.3g}' * (deviation > 0)} nm"
        across = f"{group.cross_spacing_nm.mean:.4g}" if group.cross_spacing_nm.mean else "-"
        yield (
            f"  {group.name:22.22} {group.kind.name.lower():7} {area / area_mm2:6.1%} {count:8}  "
            f"{spacing:>15}  {across:>6}  {group.oxide_nm.mean:5.4g}"
        )


def _wafer_lines(layout: Layout) -> Iterator[str]:
    wafer, places = layout.wafer, place_dies(layout)
    field = reticle_field(layout.dies[0], wafer)
    partial, tests = int(places.partial.sum()), int((places.die > 0).sum())
    yield (
        f"wafer: {wafer.diameter_mm} mm, {wafer.mark}, fields of {field.columns} x {field.rows} "
        f"dies, {len(places) - partial - tests} complete dies, {partial} partial, {tests} test"
    )
    for name in ("oxide", "groove", "width"):
        scale = getattr(places, f"{name}_scale")
        if len(scale) and scale.min() < scale.max():
            yield f"  {name:6} {scale.min() - 1:+.2%} to {scale.max() - 1:+.2%} over the wafer"
