# SPDX-License-Identifier: GPL-2.0-or-later
"""The frequency of a grating to a small fraction of a bin of the coarse spectrum.

The raster is shifted in frequency so that each harmonic comes to rest, and averaged over blocks
much smaller than the window. On these few blocks the energy that a comb of harmonics explains is
quickly found for any frequency nearby, and its maximum is the grating's.
"""

from __future__ import annotations

import numpy as np

from icwafer.layout_import.fourier import exact_comb, fit_comb
from icwafer.layout_import.outline import Outline

#: Blocks along each side of the window: a frequency may move by a few bins without loss.
BLOCKS = 32

#: Harmonics of each pass, and its first step in bins: a comb with more harmonics is sharper, and
#: has side maxima further away from its own.
_PASSES = ((1, 0.12), (2, 0.04), (6, 0.01))

_MOST_STEPS = 30
_POLISHING_HARMONICS = 3
_MANY_PERIODS = 60

_STENCIL = np.array([(i, j) for j in (-1, 0, 1) for i in (-1, 0, 1)], dtype=np.float64)
#: Turns nine values on the stencil into 1, x, y, x^2, xy, y^2 by least squares.
_QUADRATIC = np.linalg.pinv(
    np.stack(
        [
            np.ones(9),
            *_STENCIL.T,
            _STENCIL[:, 0] ** 2,
            _STENCIL.prod(axis=1),
            _STENCIL[:, 1] ** 2,
        ],
        axis=1,
    )
)


def refine(
    coverage: np.ndarray, size_um: tuple[float, float], frequency: np.ndarray
) -> np.ndarray:
    """The frequency whose harmonics explain most of the energy, near a peak of the spectrum.

    coverage: (rows, columns) float32, both multiples of BLOCKS. frequency: (2,), within half a
    bin of the peak. Returns (2,) float64.
    """
    highest = coverage.shape[1] / size_um[0] / 2  # what the raster resolves
    for harmonics, step in _PASSES:
        harmonics = max(1, min(harmonics, int(highest / np.hypot(*frequency))))
        frequency = _climb(_Blocks(coverage, size_um, frequency, harmonics), step)
    return frequency


def polish(outline: Outline, frequency: np.ndarray) -> np.ndarray:
    """The length of a frequency once more, with the exact transform in place of the raster's.

    The raster's error, a small part of a bin, matters only where there are few periods.
    """
    bins = np.hypot(*(frequency * np.array(outline.size_um)))
    if bins > _MANY_PERIODS:
        return frequency
    step = 0.02 / bins
    low, mid, high = (
        exact_comb(outline, frequency * (1 + k * step), _POLISHING_HARMONICS)[1]
        for k in (-1, 0, 1)
    )
    bend = low - 2 * mid + high
    if bend >= 0:
        return frequency
    return frequency * (1 + step * np.clip((low - high) / (2 * bend), -2, 2))


class _Blocks:
    """The windowed raster, shifted by 0, f, 2f, ... and averaged over blocks."""

    def __init__(
        self,
        coverage: np.ndarray,
        size_um: tuple[float, float],
        frequency: np.ndarray,
        harmonics: int,
    ) -> None:
        self.size_um, self.frequency = size_um, frequency
        rows, columns = coverage.shape
        self.orders = np.arange(harmonics + 1)
        x, y = ((np.arange(n) + 0.5) / n - 0.5 for n in (columns, rows))
        turn = [
            np.cos(np.pi * t) ** 2
            * np.exp(-2j * np.pi * self.orders[:, None] * f * side * t)
            * side
            / len(t)
            for t, f, side in zip((x, y), frequency, size_um)
        ]
        # Along x as one product of real matrices per column of blocks, then along y.
        along_x = turn[0].reshape(-1, BLOCKS, columns // BLOCKS).transpose(1, 2, 0)
        parts = np.concatenate([along_x.real, along_x.imag], axis=2).astype(np.float32)
        strips = np.matmul(coverage.reshape(rows, BLOCKS, -1).transpose(1, 0, 2), parts)
        strips = strips[..., : harmonics + 1] + 1j * strips[..., harmonics + 1 :]
        turned = strips * turn[1].T
        self.sums = turned.reshape(BLOCKS, BLOCKS, -1, harmonics + 1).sum(axis=2)
        self.place = (np.arange(BLOCKS) + 0.5) / BLOCKS - 0.5

    def energy(self, bins: np.ndarray) -> np.ndarray:
        """Energy explained at frequencies that are some bins off. bins: (k, 2). Returns (k,)."""
        turn = np.exp(-2j * np.pi * bins[:, :, None, None] * self.place[:, None] * self.orders)
        moments = ((self.sums * turn[:, 0, :, None]).sum(axis=1) * turn[:, 1]).sum(axis=1)
        return fit_comb(moments, self.at(bins), self.size_um)[1]

    def at(self, bins: np.ndarray) -> np.ndarray:
        """The frequency that is some bins off."""
        return self.frequency + bins / np.array(self.size_um)


def _climb(blocks: _Blocks, step: float) -> np.ndarray:
    """The maximum of the explained energy, by fits of a paraboloid with ever smaller stencils."""
    here = np.zeros(2)
    for _ in range(_MOST_STEPS):
        stencil = here + step * _STENCIL
        energies = blocks.energy(stencil)
        _, gx, gy, xx, xy, yy = _QUADRATIC @ (energies - energies.max())
        hessian = np.array([[2 * xx, xy], [xy, 2 * yy]])
        if xx < 0 and np.linalg.det(hessian) > 0:
            move = np.linalg.solve(hessian, [-gx, -gy])
        else:
            move = _STENCIL[energies.argmax()]
        length = np.hypot(*move)
        here = here + step * move * min(1.0, 1.5 / max(length, 1e-12))
        if length < 1.0:
            step /= 6
        if step < 2e-5:
            return blocks.at(here)
        if np.hypot(*here) > 1.5:
            break
    return blocks.frequency  # ran away along a ridge: there is no maximum here
