# SPDX-License-Identifier: GPL-2.0-or-later
"""Are two renders different, or is it only their noise?

Renders of one scene with two seeds differ in every pixel, and their errors have heavy tails
(fireflies), so that neither a threshold nor Student's t says whether the scenes are the same. This
test needs one assumption: that the noise of different pixels is independent, and that two renders
of the same scene are exchangeable, as those of one program with the same samples and different
seeds are. Then the difference of a pixel is as likely x as -x, whatever its distribution, and for
the self-normalised sum over a tile

    T = sum x_i / sqrt(sum x_i^2)

P(T >= t) <= 3.18 P(Z >= t), Z standard normal, without any condition on tails or variances
(Bentkus and Dzindzalieta 2015, "A tight Gaussian bound for weighted sums of Rademacher random
variables", Bernoulli 21(2), theorem 1.1). Two kinds of difference are looked for:

- shift: x = A - B. A tile became lighter, darker, redder.
- spread: x = |A - B| - |noise|, where the noise is what two renders of the *same* scene differ by.
  A tile changed inside, up here and down there. It needs two renders of each.

Where the variance of each pixel is known, one render of each is enough for both kinds, and they
may have unequal samples: then x = A - B is divided by the root of the summed variances V, whose sums
over a tile of 64 pixels or more are close to normal, and the spread is x = (A - B)^2 - V, skewed
upwards, which makes its self-normalised sum fall short of the bound.

With two renders of each, A stands for the mean of its two, and the noise is (A1 - A2 + B1 - B2)/2
and (A1 - A2 - B1 + B2)/2: of the same variance as (A1 + A2 - B1 - B2)/2.

All tiles, of several sizes up to the whole image, times three colour axes, times both kinds are
tested together: the images are different when the smallest p times the number of tests is below
the level (Bonferroni: valid under every dependence between tests). The map of what differs is that
of Benjamini and Hochberg 1995 at the same level.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

#: Orthogonal axes: brightness, red against blue, green against both. They separate the light
#: changes from the colour changes and keep the symmetry of the noise.
_AXES = np.array([[1, 1, 1], [1, 0, -1], [-1, 2, -1]]) / np.sqrt([[3], [2], [6]])
_RADEMACHER = 3.18
_SMALLEST_TILE = 8
_HALF_FLOAT = 2.0**-11


@dataclass(frozen=True)
class NoiseTest:
    """What was found.

    different: the images differ beyond their noise, at `level` (probability of a false alarm).
    p: for the whole image: the smallest of all tests' times their number, at most 1.
    tests: how many; share: of the image's tiles of 8 x 8 pixels in which it differs.
    tiles: rows x columns of them, True where it differs.
    rms: of the difference. rms_noise: what the noise alone would make of it; rms_beyond: what is
    left, sqrt(max(0, rms^2 - rms_noise^2)). Both None with one render of each.
    """

    different: bool
    p: float
    level: float
    tests: int
    share: float
    tiles: np.ndarray
    rms: float
    rms_noise: float | None
    rms_beyond: float | None


@dataclass(frozen=True)
class _Statistic:
    """x is summed over tiles, divided by the root of the sum of `power`; both height x width x 3.

    two_sided: whether a negative sum counts as well.
    """

    x: np.ndarray
    power: np.ndarray
    two_sided: bool

    def log_p(self, size: int) -> np.ndarray:
        """Of every tile of a size and every axis."""
        t = _ratio(_tile_sums(self.x, size), np.sqrt(_tile_sums(self.power, size)))
        return _log_p(np.abs(t)) + math.log(2) if self.two_sided else _log_p(t)


def compare(
    a: Sequence[np.ndarray],
    b: Sequence[np.ndarray],
    level: float = 0.01,
    variances: tuple[np.ndarray, np.ndarray] | None = None,
) -> NoiseTest:
    """Tests one or two renders of each scene, height x width x 3, linear or encoded.

    Rejects two renders of the same scene with at most the probability `level`. The renders of one
    scene must have different seeds, and all of them the same number of samples: noise of unequal
    strength is not symmetric when it has fireflies. With `variances`, of each pixel's mean in A
    and in B and of the same shape, one render of each is given, with any number of samples.
    """
    if len(a) != len(b) or len(a) not in (1, 2) or (variances and len(a) > 1):
        raise ValueError("one render of each scene, or two of each, or one with its variance")
    if variances:
        difference, statistics, noise_power = _known_noise(a[0], b[0], variances)
    else:
        difference, statistics, noise_power = _unknown_noise(a, b)
    tests = [  # (log p, tile size) of every size and kind: rows x columns x axes
        (statistic.log_p(size), size)
        for size in _tile_sizes(difference.shape)
        for statistic in statistics
    ]
    every = np.concatenate([log_p.ravel() for log_p, _ in tests])
    log_level = math.log(level)
    significant = _benjamini_hochberg(every, log_level)
    smallest = float(every.min()) + math.log(every.size)

    tiles = np.zeros(_grid(difference.shape, _SMALLEST_TILE), dtype=bool)
    for log_p, size in sorted(tests, key=lambda test: test[1]):
        for row, column in np.argwhere((log_p <= significant).any(axis=-1)):
            step = size // _SMALLEST_TILE
            inside = tiles[row * step : (row + 1) * step, column * step : (column + 1) * step]
            # A large tile is marked only where no smaller one in it says more exactly where.
            inside |= not inside.any()

    rms = math.sqrt(np.mean(difference**2))
    rms_noise = math.sqrt(noise_power) if noise_power is not None else None
    beyond = math.sqrt(max(0.0, rms**2 - rms_noise**2)) if rms_noise is not None else None
    return NoiseTest(
        different=smallest <= log_level,
        p=min(1.0, math.exp(smallest)),
        level=level,
        tests=every.size,
        share=float(tiles.mean()),
        tiles=tiles,
        rms=rms,
        rms_noise=rms_noise,
        rms_beyond=beyond,
    )


def _unknown_noise(
    a: Sequence[np.ndarray], b: Sequence[np.ndarray]
) -> tuple[np.ndarray, list[_Statistic], float | None]:
    """The difference, what is tested of it, and the mean square of its noise."""
    axes_of = [np.asarray(image, dtype=np.float64) @ _AXES.T for image in (*a, *b)]
    if len(a) == 1:
        difference, noises = axes_of[0] - axes_of[1], []
    else:
        a1, a2, b1, b2 = axes_of
        difference = (a1 + a2 - b1 - b2) / 2
        noises = [(a1 - a2 + b1 - b2) / 2, (a1 - a2 - b1 + b2) / 2]
    spreads = [np.abs(difference) - np.abs(noise) for noise in noises]
    statistics = [_Statistic(difference, difference**2, two_sided=True)]
    statistics += [_Statistic(spread, spread**2, two_sided=False) for spread in spreads]
    noise_power = float(np.mean([noise**2 for noise in noises])) if noises else None
    return difference, statistics, noise_power


def _known_noise(
    a: np.ndarray, b: np.ndarray, variances: tuple[np.ndarray, np.ndarray]
) -> tuple[np.ndarray, list[_Statistic], float]:
    """The same; here the axes are the channels, for whose sums no variance is known."""
    difference = np.asarray(a, dtype=np.float64) - b
    power = np.add(*variances, dtype=np.float64)
    spread = difference**2 - power
    # Files of half floats are rounded, also where there is no noise.
    rounding = (_HALF_FLOAT * np.maximum(np.abs(a), np.abs(b), dtype=np.float64)) ** 2
    statistics = [
        _Statistic(difference, power + rounding, two_sided=True),
        _Statistic(spread - rounding, spread**2 + rounding**2, two_sided=False),
    ]
    return difference, statistics, float(power.mean())


def _grid(shape: tuple[int, ...], size: int) -> tuple[int, int]:
    return math.ceil(shape[0] / size), math.ceil(shape[1] / size)


def _tile_sizes(shape: tuple[int, ...]) -> Iterator[int]:
    """8, 16, 32 pixels and so on, the last one covering the image."""
    size = _SMALLEST_TILE
    while True:
        yield size
        if size >= max(shape[:2]):
            return
        size *= 2


def _tile_sums(x: np.ndarray, size: int) -> np.ndarray:
    """Sums over every tile: rows x columns x axes."""
    rows, columns = _grid(x.shape, size)
    padded = np.zeros((rows * size, columns * size, x.shape[2]))
    padded[: x.shape[0], : x.shape[1]] = x
    return padded.reshape(rows, size, columns, size, x.shape[2]).sum(axis=(1, 3))


def _ratio(sums: np.ndarray, lengths: np.ndarray) -> np.ndarray:
    """T; 0 where nothing differs."""
    return np.divide(sums, lengths, out=np.zeros_like(sums), where=lengths > 0.0)


def _log_p(t: np.ndarray) -> np.ndarray:
    """Logarithm of the bound on P(T >= t), at most 0."""
    # Far out the normal tail underflows; there density(t) / t bounds it from above.
    tail = np.array([math.erfc(min(value, 30.0) / math.sqrt(2)) / 2 for value in t.flat])
    near = np.log(tail.reshape(t.shape))
    capped = np.maximum(t, 1.0)
    far = -0.5 * capped**2 - np.log(capped * math.sqrt(2 * math.pi))
    return np.minimum(np.where(t < 30.0, near, far) + math.log(_RADEMACHER), 0.0)


def _benjamini_hochberg(log_p: np.ndarray, log_level: float) -> float:
    """The largest log p that is significant at a false discovery rate; -inf if none is."""
    ordered = np.sort(log_p)
    allowed = log_level + np.log(np.arange(1, ordered.size + 1) / ordered.size)
    passing = np.flatnonzero(ordered <= allowed)
    return float(ordered[passing[-1]]) if passing.size else -math.inf
