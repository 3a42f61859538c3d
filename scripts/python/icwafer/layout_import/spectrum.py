# SPDX-License-Identifier: GPL-2.0-or-later
"""Finds the gratings in a tile: their periods, directions, duty cycles and strengths.

1. The shapes are merged, so that overlaps count once, and their exact coverage of each pixel is
   Fourier transformed under a Hann window. The pixel is a quarter of the mean width of the shapes.
2. The strongest peak that stands out of its surroundings on the line through the origin is a
   grating's first order: of parallel wires of any duty cycle the first order is the strongest.
3. `refine` moves it to where a comb of six harmonics explains most of the energy.
4. The transform of the polygons themselves, exact at any frequency, gives the amplitudes of the
   harmonics, and these the duty cycle.
5. Peaks at its harmonics, and at the sums and differences of two gratings, are taken out, and the
   search goes on.

Errors, the largest of some hundred exact gratings of periods from 0.2 to 30 um, duty cycles of
0.15 to 0.85 and any angle, with five periods and more in the tile and no whole number of them:
0.013 % of the period, 0.02 % of the duty cycle, 0.0005 degrees. With a second grating or random
shapes in half of the tile 0.02 %, 0.2 % and 0.002 degrees. (tests/python/test_import_spectrum.py
requires 0.1 %, 1 % and 0.1 degrees of both.)

Not told apart: two gratings of one direction whose frequencies are closer than three bins (3 /
tile side) to one another or to each other's harmonics.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from icwafer.layout_import.fourier import exact_comb, transform
from icwafer.layout_import.outline import Outline, rasterise
from icwafer.layout_import.refine import BLOCKS, polish, refine

#: Half the shortest visible wavelength: a finer grating sends no order anywhere.
FINEST_PERIOD_UM = 0.19
#: Fewer periods than this in a tile are no evidence.
FEWEST_PERIODS = 5
#: The first order's amplitude below which a grating is not worth mentioning; full wires of a duty
#: cycle of one half have 0.318, so this is 1/450 of the power.
FAINTEST_AMPLITUDE = 0.015
#: How far a peak stands above the mean power around it. In 240 tiles of random rectangles and of
#: random parallel wires none came above 20.
CLEAREST_NOISE = 30.0
MOST_GRATINGS = 4

_HARMONICS = 6
_LOBE_BINS = 3  # half the width of a line of the spectrum, with some room
_MOST_LOOKS = 60
_FINEST_PIXEL_UM = 0.05
_MOST_PIXELS = 4096


@dataclass(frozen=True)
class Grating:
    """Parallel wires.

    period_um: their spacing. duty: width over period, 0 to 1. direction_rad: of the wires,
    counter-clockwise from x, 0 to pi. amplitude: that of the first order of diffraction, in units
    of the coverage, at most 1/pi.
    """

    period_um: float
    duty: float
    direction_rad: float
    amplitude: float

    @property
    def presence(self) -> float:
        """How much of the tile has these wires: 1 for a tile full of them, without a gap."""
        return min(1.0, self.amplitude * np.pi / np.sin(np.pi * self.duty))


def find_gratings(outline: Outline) -> list[Grating]:
    """The gratings in a tile, strongest first; none if nothing in it is periodic."""
    if outline.area_um2 < 1e-3 * FINEST_PERIOD_UM * min(outline.size_um):
        return []
    columns, rows = _raster_size(outline)
    coverage = rasterise(outline, columns, rows)
    spectrum = _Spectrum(coverage, outline.size_um)
    found: list[tuple[Grating, np.ndarray]] = []
    for peak in spectrum.peaks():
        frequency = polish(outline, refine(coverage, outline.size_um, peak))
        if _amplitudes(outline, frequency[None])[0] < FAINTEST_AMPLITUDE:
            continue  # a line finer than the raster resolves, mirrored into it
        frequency = _first_order(outline, frequency)
        grating = _measure(outline, frequency)
        spectrum.remove_orders(frequency)
        for _, other in found:
            spectrum.remove_sums(frequency, other)
        # Between bins a first order may look weaker than its second and be found after it.
        found = [
            (old, other)
            for old, other in found
            if old.amplitude > grating.amplitude or not spectrum.is_order(other, frequency)
        ]
        found.append((grating, frequency))
        if len(found) == MOST_GRATINGS:
            break
    return sorted((grating for grating, _ in found), key=lambda grating: -grating.amplitude)


def _raster_size(outline: Outline) -> tuple[int, int]:
    """Columns and rows, products of BLOCKS, for pixels of a quarter of the shapes' mean width."""
    pixel = max(outline.mean_width_um / 4, _FINEST_PIXEL_UM)
    return tuple(
        BLOCKS * int(np.clip(np.ceil(side / pixel / BLOCKS), 16, _MOST_PIXELS // BLOCKS))
        for side in outline.size_um
    )


def _first_order(outline: Outline, frequency: np.ndarray) -> np.ndarray:
    """The frequency itself, or a whole fraction of it where there is a stronger line.

    Among other shapes the first order may drown where a higher one still stands out.
    """
    bins = np.hypot(*(frequency * np.array(outline.size_um)))
    parts = np.arange(1, np.clip(int(bins / FEWEST_PERIODS), 1, 5) + 1)
    fractions = frequency / parts[:, None]
    return fractions[_amplitudes(outline, fractions).argmax()]


def _amplitudes(outline: Outline, frequency: np.ndarray) -> np.ndarray:
    """Amplitudes at frequencies (k, 2) that are far from other lines. Returns (k,)."""
    whole = outline.size_um[0] * outline.size_um[1] / 4  # the integral of the window
    return np.abs(transform(outline, frequency)) / whole


def _measure(outline: Outline, frequency: np.ndarray) -> Grating:
    amplitudes, _ = exact_comb(outline, frequency, _HARMONICS)
    first = amplitudes[1]
    # Seen from the middle of a wire all orders are real.
    centred = (amplitudes[1:] * (abs(first) / first) ** np.arange(1, _HARMONICS + 1)).real
    return Grating(
        period_um=1 / np.hypot(*frequency),
        duty=_duty(centred),
        direction_rad=float(np.arctan2(-frequency[0], frequency[1]) % np.pi),
        amplitude=float(abs(first)),
    )


def _duty(amplitudes: np.ndarray) -> float:
    """The duty cycle f whose orders s sin(pi m f) / (pi m) are nearest to those given, any s."""
    order = np.arange(1, len(amplitudes) + 1)

    def mismatch(duty: np.ndarray) -> np.ndarray:
        shape = np.sin(np.pi * order * duty[:, None]) / (np.pi * order)
        return -((shape @ amplitudes) ** 2) / (shape**2).sum(axis=1)

    candidates = np.linspace(0.01, 0.99, 99)
    for _ in range(3):
        best, step = candidates[mismatch(candidates).argmin()], candidates[1] - candidates[0]
        candidates = np.clip(best + np.linspace(-step, step, 41), 0.005, 0.995)
    return float(best)


@lru_cache(maxsize=8)
def _within_range(shape: tuple[int, int], size_um: tuple[float, float]) -> np.ndarray:
    """Bins of periods that the tile holds often enough, that the raster resolves."""
    height, width = shape
    middle = height // 2
    i, j = np.arange(width), np.arange(height)[:, None] - middle
    frequency = np.hypot(i / size_um[0], j / size_um[1])
    finest = min(0.95 * (width - 1) / size_um[0], 1 / FINEST_PERIOD_UM)
    within = (np.hypot(i, j) >= FEWEST_PERIODS - 0.5) & (frequency <= finest)
    within[: middle + 1, 0] = False  # the same as the upper half
    return within


class _Spectrum:
    """The power of a raster under the Hann window, and what of it is explained already."""

    def __init__(self, coverage: np.ndarray, size_um: tuple[float, float]) -> None:
        rows, columns = coverage.shape
        windows = [np.cos(np.pi * ((np.arange(n) + 0.5) / n - 0.5)) ** 2 for n in (columns, rows)]
        window = np.outer(windows[1], windows[0]).astype(np.float32)
        mean = (coverage * window).sum() / window.sum()
        self.size_um = np.array(size_um)
        # Bins (i, j) with i >= 0 along x, and j from below 0 to above along y.
        self.middle = rows // 2
        power = np.abs(np.fft.rfft2((coverage - mean) * window)) ** 2
        self.power = np.fft.fftshift(power, axes=0)
        # A line between bins loses up to half of its amplitude.
        self.faintest_power = (0.5 * FAINTEST_AMPLITUDE * window.sum()) ** 2
        self.free = _within_range(self.power.shape, size_um).copy()

    def peaks(self) -> Iterator[np.ndarray]:
        """Frequencies (2,) of what stands out, by falling power; looks at `free` each time."""
        strong = np.flatnonzero((self.power > self.faintest_power) & self.free)
        looks = 0
        for flat in strong[np.argsort(-self.power.flat[strong], kind="stable")]:
            row, column = np.unravel_index(flat, self.power.shape)
            if not self.free[row, column]:
                continue
            bins = np.array([column, row - self.middle])
            clear = self.power[row, column] > CLEAREST_NOISE * self._surroundings(bins)
            self._remove(bins)
            if clear:
                yield self._interpolated(bins) / self.size_um
            looks += 1
            if looks == _MOST_LOOKS:
                return

    def _interpolated(self, bins: np.ndarray) -> np.ndarray:
        """The top of the parabola through the logarithms of the power beside a peak."""
        offsets = []
        for axis in (np.array([1, 0]), np.array([0, 1])):
            low, mid, high = (np.log(self._power(bins + k * axis) + 1e-300) for k in (-1, 0, 1))
            bend = low - 2 * mid + high
            offsets.append(np.clip((low - high) / (2 * bend), -0.5, 0.5) if bend < 0 else 0.0)
        return bins + np.array(offsets)

    def _power(self, bins: np.ndarray) -> np.ndarray:
        """Power at whole bins (..., 2); negative frequencies along x are mirrored."""
        bins = np.where(bins[..., :1] < 0, -bins, bins)
        rows, columns = self.power.shape
        return self.power[(bins[..., 1] + self.middle) % rows, bins[..., 0] % columns]

    def _surroundings(self, bins: np.ndarray) -> float:
        """Mean power that random shapes would give at a peak.

        Random wires have their power on a line through the origin, random rectangles in a cross;
        so it is the highest of the medians along the lines through the peak to the origin, along
        x and along y, half the frequency to both sides, without the peak and its harmonics. The
        power of random shapes has an exponential distribution, of mean median / ln 2.
        """
        length = np.hypot(*bins)
        reach = int(max(8, length / 2))
        steps = np.concatenate([np.arange(-reach, -1), np.arange(2, reach + 1)])
        medians = []
        for line in (bins / length, np.array([1.0, 0.0]), np.array([0.0, 1.0])):
            places = np.rint(bins + steps[:, None] * line).astype(np.int64)
            orders = np.rint(places @ bins / length**2)
            lone = np.hypot(*(places - orders[:, None] * bins).T) >= 2
            seen = np.abs(places) <= [self.power.shape[1] - 1, self.middle - 1]
            power = self._power(places[lone & seen.all(axis=1)])
            medians.append(np.median(power) if len(power) else np.inf)
        return float(max(medians) / np.log(2))

    def _remove(self, bins: np.ndarray) -> None:
        """Takes a line of the spectrum, and its mirror image, out of the search."""
        for column, row in (bins, -bins):
            x, y = round(column), round(row) + self.middle
            reach = _LOBE_BINS
            if x + reach >= 0 and y + reach >= 0:
                self.free[
                    max(y - reach, 0) : y + reach + 1, max(x - reach, 0) : x + reach + 1
                ] = False

    def remove_orders(self, frequency: np.ndarray) -> None:
        """Takes out a grating's harmonics."""
        bins = frequency * self.size_um
        highest = int(np.hypot(*self.power.shape) / np.hypot(*bins))
        for order in range(1, highest + 1):
            self._remove(order * bins)

    def is_order(self, frequency: np.ndarray, of: np.ndarray) -> bool:
        """Whether a frequency is a harmonic of another one."""
        order = np.rint(frequency @ of / (of @ of))
        return bool(np.hypot(*((frequency - order * of) * self.size_um)) < _LOBE_BINS)

    def remove_sums(self, one: np.ndarray, other: np.ndarray) -> None:
        """Takes out the sums and differences of the orders of two gratings that cross."""
        reach = range(-8, 9)
        for m in reach:
            for n in reach:
                self._remove((m * one + n * other) * self.size_um)
