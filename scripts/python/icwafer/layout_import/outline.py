# SPDX-License-Identifier: GPL-2.0-or-later
"""Outlines of merged shapes inside a window: area, mean width, an exact coverage raster."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Outline:
    """The shapes of one layer, merged and clipped to a window whose centre is the origin.

    edges_um: (n, 4) float64, x0, y0, x1, y1 of directed edges with the inside on their right.
    size_um: the window's extent along x and y.
    """

    edges_um: np.ndarray
    size_um: tuple[float, float]

    @property
    def area_um2(self) -> float:
        """Exact area of the shapes."""
        x0, y0, x1, y1 = self.edges_um.T
        return float((y1 - y0) @ (x0 + x1)) / -2

    @property
    def coverage(self) -> float:
        """Share of the window that is covered, 0 to 1."""
        return self.area_um2 / (self.size_um[0] * self.size_um[1])

    @property
    def mean_width_um(self) -> float:
        """Twice the area over the perimeter: of long wires of one width, that width."""
        x0, y0, x1, y1 = self.edges_um.T
        return 2 * self.area_um2 / float(np.hypot(x1 - x0, y1 - y0).sum())


def rasterise(outline: Outline, columns: int, rows: int) -> np.ndarray:
    """How much of each pixel is covered: (rows, columns) float32, 0 to 1, row 0 at the bottom.

    Exact for any polygon. Each edge is cut where it passes from pixel to pixel; a piece adds the
    area between itself and its pixel's right side, and its height to all pixels further right.
    """
    scale = np.array([columns / outline.size_um[0], rows / outline.size_um[1]] * 2)
    x0, y0, x1, y1 = (outline.edges_um * scale + np.array([columns, rows] * 2) / 2).T
    rising = y0 != y1
    x0, y0, x1, y1 = x0[rising], y0[rising], x1[rising], y1[rising]

    edge, begin = _cuts(x0, x1, y0, y1)
    last = np.append(edge[1:] != edge[:-1], True)
    end = np.where(last, 1.0, np.append(begin[1:], 1.0))
    middle = (begin + end) / 2
    x = x0[edge] + (x1 - x0)[edge] * middle
    y = y0[edge] + (y1 - y0)[edge] * middle
    height = (y1 - y0)[edge] * (end - begin)
    column = np.clip(x.astype(np.int64), 0, columns - 1)
    row = np.clip(y.astype(np.int64), 0, rows - 1)

    place, beyond = row * (columns + 1) + column, height * (x - column)
    cells = rows * (columns + 1)
    change = np.bincount(place, height - beyond, cells) + np.bincount(place + 1, beyond, cells)
    coverage = change.reshape(rows, columns + 1)[:, :columns].cumsum(axis=1)
    return coverage.astype(np.float32)


def _cuts(
    x0: np.ndarray, x1: np.ndarray, y0: np.ndarray, y1: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Where edges enter a new pixel: index of the edge and place along it (0 to 1), in order."""
    edges, positions = [np.arange(len(x0))], [np.zeros(len(x0))]
    for begin, end in ((x0, x1), (y0, y1)):
        first = np.floor(np.minimum(begin, end)).astype(np.int64) + 1
        count = np.maximum(np.ceil(np.maximum(begin, end)).astype(np.int64) - first, 0)
        edge = np.repeat(np.arange(len(begin)), count)
        line = first[edge] + np.arange(len(edge)) - np.repeat(np.cumsum(count) - count, count)
        edges.append(edge)
        positions.append((line - begin[edge]) / (end - begin)[edge])
    edge, position = np.concatenate(edges), np.concatenate(positions)
    order = np.lexsort((position, edge))
    return edge[order], position[order]
