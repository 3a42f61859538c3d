# SPDX-License-Identifier: GPL-2.0-or-later
"""A plot of a layout: its dies from above, the distribution of their spacings, and the wafer."""

from __future__ import annotations

from pathlib import Path

import matplotlib
import numpy as np

from icwafer.chips.die import generate
from icwafer.chips.model import MM, Die, Layout
from icwafer.chips.outline import outline_mm
from icwafer.chips.placement import WaferMap, place_dies
from icwafer.chips.view import die_colours, die_picture
from icwafer.errors import IcwaferError
from icwafer.files import replacing

matplotlib.use("Agg")

import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.collections import PolyCollection  # noqa: E402

ENDINGS = (".png", ".svg")


def plot(layout: Layout, path: Path) -> None:
    """Writes the plot as PNG or SVG, after the path's ending; the same layout, the same bytes."""
    if path.suffix not in ENDINGS:
        raise IcwaferError(f"{path}: a plot is {' or '.join(ENDINGS)}; choose such a name")
    dies = [generate(spec) for spec in layout.dies]
    rows = len(dies) + (layout.wafer is not None)
    style = {"svg.hashsalt": "icwafer", "font.size": 8, "axes.titlesize": 9}
    with matplotlib.rc_context(style):
        figure, axes = plt.subplots(rows, 2, figsize=(11, 4.2 * rows), squeeze=False)
        for die, (above, spacing) in zip(dies, axes):
            _draw_die(above, die)
            _draw_spacing(spacing, die)
        if layout.wafer is not None:
            places = place_dies(layout)
            _draw_wafer(axes[-1, 0], layout, places, figure)
            _draw_drift(axes[-1, 1], places)
        figure.tight_layout()
        metadata = {"Date": None} if path.suffix == ".svg" else {"Software": None}
        with replacing(path) as unfinished:
            figure.savefig(unfinished, dpi=130, metadata=metadata)
        plt.close(figure)


def _draw_die(axes: plt.Axes, die: Die) -> None:
    spec = die.spec
    picture = die_picture(die, width_px=1000)
    axes.imshow(picture, extent=(0, spec.width_mm, 0, spec.height_mm), interpolation="none")
    axes.set_title(f"{spec.name}: {len(die)} blocks")
    axes.set_xlabel("mm")


def _draw_spacing(axes: plt.Axes, die: Die) -> None:
    """Area over the spacing in a hundred steps of equal ratio, one colour for each group."""
    diffracts = die.diffraction > 0
    lowest, highest = die.spacing_nm[diffracts].min(), die.spacing_nm[diffracts].max()
    bins = np.geomspace(0.95 * lowest, 1.05 * highest, 101)
    area = die.area_nm2 / MM**2
    colours = die_colours(die)
    below = np.zeros(len(bins) - 1)
    for index, group in enumerate(die.spec.groups):
        members = np.flatnonzero((die.group == index) & diffracts)
        if len(members):
            heights, _ = np.histogram(die.spacing_nm[members], bins, weights=area[members])
            colour = colours[members].mean(axis=0)
            axes.stairs(
                below + heights, bins, baseline=below, fill=True, color=colour, label=group.name
            )
            below += heights
    axes.set_xscale("log")
    ticks = np.unique(np.round(bins[::12], -1))
    axes.set_xticks(ticks, [f"{tick:.0f}" for tick in ticks])
    axes.minorticks_off()
    axes.set_xlabel("wire spacing, nm")
    axes.set_ylabel("area, mm\u00b2")
    if len(die.spec.groups) <= 20:
        axes.legend(fontsize=6, loc="upper left")


def _draw_wafer(
    axes: plt.Axes, layout: Layout, places: WaferMap, figure: matplotlib.figure.Figure
) -> None:
    axes.fill(*outline_mm(layout.wafer).T, color="0.85")
    sizes = np.array([(spec.width_mm, spec.height_mm) for spec in layout.dies])[places.die]
    corners = np.array([(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)])
    outlines = places.centre_mm[:, None] + corners * sizes[:, None]
    shown = PolyCollection(
        outlines,
        array=100 * (places.oxide_scale - 1),
        cmap="Spectral",
        edgecolors=np.where(places.die == 0, "0.3", "black"),
        linewidths=np.where(places.die == 0, 0.15, 0.8),
    )
    axes.add_collection(shown)
    figure.colorbar(shown, ax=axes, label="oxide, % from the mean")
    axes.set_aspect("equal")
    axes.set_title(f"{layout.wafer.diameter_mm} mm wafer: {len(places)} dies")
    axes.set_xlabel("mm")


def _draw_drift(axes: plt.Axes, places: WaferMap) -> None:
    radius = np.sqrt((places.centre_mm**2).sum(axis=1))
    for name in ("oxide", "groove", "width"):
        axes.plot(radius, 100 * (getattr(places, f"{name}_scale") - 1), ".", ms=2, label=name)
    axes.set_xlabel("distance of the die from the wafer's centre, mm")
    axes.set_ylabel("% from the mean")
    axes.legend(loc="upper left")
