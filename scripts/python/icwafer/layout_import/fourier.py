# SPDX-License-Identifier: GPL-2.0-or-later
"""Exact Fourier transforms of outlines under a Hann window, and fits of harmonics to them.

Frequencies are vectors (fx, fy) in cycles per micrometre. The window is cos^2(pi x / w)
cos^2(pi y / h) over a tile of w x h: it lets a tile hold any fraction of a period, because its
transform falls off with the third power of the distance from a line of the spectrum.
"""

from __future__ import annotations

import numpy as np

from icwafer.layout_import.outline import Outline

#: The Hann window is 1/2 + 1/4 e^(+i..) + 1/4 e^(-i..): shifts of the spectrum by whole bins.
_SHIFTS = np.array([(i, j) for i in (-1, 0, 1) for j in (-1, 0, 1)])
_SHARES = np.array([0.25, 0.5, 0.25])[_SHIFTS + 1].prod(axis=1)
_CHUNK = 4096  # edges at a time: bounds the memory, and fits the cache


def window_transform(frequency: np.ndarray, size_um: tuple[float, float]) -> np.ndarray:
    """Transform of the window itself. frequency: (..., 2). Returns (...) float64 in um^2."""
    bins = frequency * np.array(size_um)
    side = np.sinc(bins) / 2 + (np.sinc(bins - 1) + np.sinc(bins + 1)) / 4
    return side.prod(axis=-1) * size_um[0] * size_um[1]


def transform(outline: Outline, frequency: np.ndarray) -> np.ndarray:
    """The integral of window times e^(-2 pi i f.x) over the shapes, exact to rounding.

    By the divergence theorem the integral over a polygon is a sum over its edges: for an edge from
    p to q with centre c, (i / 2 pi |f|^2) (f x (q - p)) sinc(f.(q - p)) e^(-2 pi i f.c), where
    sinc(t) = sin(pi t) / (pi t). (J. Wuttke, "Numerically stable form factor of any polygon and
    polyhedron", 2021, derives the same.) frequency: (k, 2). Returns (k,) complex128 in um^2.
    """
    shifts = _SHIFTS / np.array(outline.size_um)
    sums = np.zeros((len(frequency), len(shifts)), dtype=np.complex128)
    for first in range(0, len(outline.edges_um), _CHUNK):
        edges = outline.edges_um[first : first + _CHUNK]
        centre, along = (edges[:, :2] + edges[:, 2:]) / 2, edges[:, 2:] - edges[:, :2]
        shift_phase = np.exp(-2j * np.pi * (shifts @ centre.T))
        for index, base in enumerate(frequency):
            shifted = base + shifts
            flux = shifted[:, :1] * along[:, 1] - shifted[:, 1:] * along[:, 0]
            turns = np.pi * (shifted @ along.T) + 1e-30  # sin(t) / t is 1 there, and not 0 / 0
            phase = shift_phase * np.exp(-2j * np.pi * (centre @ base))
            sums[index] += (flux * (np.sin(turns) / turns) * phase).sum(axis=1)
    square = ((frequency[:, None] + shifts) ** 2).sum(axis=2)
    mean = square < 1e-18  # frequency 0, where the formula has no value: that is the area
    sums = np.where(mean, outline.area_um2, sums / np.where(mean, 1.0, square) / 2j / np.pi)
    return sums @ _SHARES


def fit_comb(
    moments: np.ndarray, frequency: np.ndarray, size_um: tuple[float, float]
) -> tuple[np.ndarray, np.ndarray]:
    """Fits a Fourier series, sum over m of a_m e^(2 pi i m f.x), to shapes under the window.

    moments: (..., m + 1) complex, the shapes' transform at 0, f, 2f, ... frequency: (..., 2), f.
    Returns the amplitudes of orders 0 to m, (..., m + 1) complex128, and the windowed energy that
    the series explains, (...) float64.

    With a window of finite size the moments are mixtures of all amplitudes; solving the normal
    equations unmixes them, so that a fraction of a period in the window biases nothing (nonlinear
    least squares of harmonics; Christensen and Jakobsson, "Multi-Pitch Estimation", 2009).
    """
    highest = moments.shape[-1] - 1
    differences = np.arange(-2 * highest, 2 * highest + 1)
    mixing = window_transform(differences[:, None] * frequency[..., None, :], size_um)
    order = np.arange(2 * highest + 1)
    matrix = mixing[..., order[:, None] - order + 2 * highest]
    both = np.concatenate([moments[..., :0:-1].conj(), moments], axis=-1)
    amplitudes = np.linalg.solve(matrix, both[..., None])[..., 0]
    energy = (both.conj() * amplitudes).sum(axis=-1).real
    return amplitudes[..., highest:], energy


def exact_comb(
    outline: Outline, frequency: np.ndarray, harmonics: int
) -> tuple[np.ndarray, float]:
    """`fit_comb` with the transform of the polygons themselves. frequency: (2,)."""
    moments = transform(outline, np.arange(harmonics + 1)[:, None] * frequency)
    amplitudes, energy = fit_comb(moments, frequency, outline.size_um)
    return amplitudes, float(energy)
