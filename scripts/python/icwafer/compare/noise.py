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


def compare(a: Sequence[np.ndarray], b: Sequence[np.ndarray], level: float = 0.01) -> NoiseTest:
    """Tests one or two renders of each scene, height x width x 3, linear or encoded.

    Rejects two renders of the same scene with at most the probability `level`. The renders of one
    scene must have different seeds, and all of them the same number of samples: noise of unequal
    strength is not symmetric when it has fireflies.
    """
    if len(a) != len(b) or len(a) not in (1, 2):
        raise ValueError("one render of each scene, or two of each")
    axes_of = [np.asarray(image, dtype=np.float64) @ _AXES.T for image in (*a, *b)]
    if len(a) == 1:
        difference, noises = axes_of[0] - axes_of[1], []
    else:
        a1, a2, b1, b2 = axes_of
        difference = (a1 + a2 - b1 - b2) / 2
        noises = [(a1 - a2 + b1 - b2) / 2, (a1 - a2 - b1 + b2) / 2]

    tests = []  # (log p, tile size) of every size and kind: rows x columns x axes
    for size in _tile_sizes(difference.shape):
        tests.append((_log_p(np.abs(_self_normalised(difference, size))) + math.log(2), size))
        for noise in noises:
            spread = np.abs(difference) - np.abs(noise)
            tests.append((_log_p(_self_normalised(spread, size)), size))
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
    rms_noise = math.sqrt(np.mean([noise**2 for noise in noises])) if noises else None
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


def _self_normalised(x: np.ndarray, size: int) -> np.ndarray:
    """T of every tile and axis; 0 where nothing differs."""
    rows, columns = _grid(x.shape, size)
    padded = np.zeros((rows * size, columns * size, x.shape[2]))
    padded[: x.shape[0], : x.shape[1]] = x
    tiles = padded.reshape(rows, size, columns, size, x.shape[2])
    length = np.sqrt((tiles**2).sum(axis=(1, 3)))
    return np.divide(tiles.sum(axis=(1, 3)), length, out=np.zeros_like(length), where=length > 0.0)


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
