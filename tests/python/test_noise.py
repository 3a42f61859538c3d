# SPDX-License-Identifier: GPL-2.0-or-later
"""The test that knows noise, on made-up renders whose truth is known."""

from __future__ import annotations

import unittest

import numpy as np

from icwafer.compare import noise

HEIGHT, WIDTH = 48, 80


def bands(stretch: float = 1.0) -> np.ndarray:
    """The true picture: colour bands that move with the spacing, beside black."""
    place = np.linspace(0.0, 18.0, WIDTH) * stretch
    rgb = np.stack([np.sin(place + phase) ** 2 for phase in (0.0, 1.0, 2.0)], axis=-1)
    picture = np.broadcast_to(rgb, (HEIGHT, WIDTH, 3)).copy()
    picture[:, :12] = 0.0
    return picture


class Renders:
    """Renders with the noise of path tracing: skewed, and rare pixels a hundred times too bright
    (a Pareto tail of index 1.5 has no variance at all)."""

    def __init__(self, seed: int, strength: float = 0.15) -> None:
        self.random = np.random.default_rng(seed)
        self.strength = strength

    def of(self, truth: np.ndarray, count: int) -> list[np.ndarray]:
        return [self.one(truth) for _ in range(count)]

    def one(self, truth: np.ndarray) -> np.ndarray:
        shape = 1.0 / self.strength**2
        grain = self.random.gamma(shape, 1.0 / shape, (HEIGHT, WIDTH, 1))
        fireflies = self.random.random((HEIGHT, WIDTH, 1)) < 0.003
        return truth * (grain + fireflies * self.random.pareto(1.5, grain.shape))


    def with_variance(self, truth: np.ndarray, samples: int) -> tuple[np.ndarray, np.ndarray]:
        """Mean of some renders, and its variance as they tell it."""
        every = np.stack(self.of(truth, samples))
        return every.mean(axis=0), every.var(axis=0, ddof=1) / samples


class NoiseTest(unittest.TestCase):
    def share_called_different(
        self, other: np.ndarray, count: int, pairs: int, strength: float = 0.15
    ) -> float:
        renders = Renders(11, strength)
        found = [
            noise.compare(renders.of(bands(), count), renders.of(other, count)).different
            for _ in range(pairs)
        ]
        return float(np.mean(found))

    def test_two_seeds_of_one_scene(self) -> None:
        """At level 0.01 at most 1 %, of 200 pairs: with fireflies, with one and two renders."""
        for count in (1, 2):
            self.assertLessEqual(self.share_called_different(bands(), count, 200), 0.01)

    def test_one_percent_of_spacing(self) -> None:
        for count in (1, 2):
            self.assertEqual(self.share_called_different(bands(1.01), count, 20), 1.0)

    def test_a_change_inside_tiles_needs_two_renders(self) -> None:
        """Stripes one pixel wide change places: every tile keeps its mean."""
        stripes = 1.0 + 0.3 * (np.arange(WIDTH) % 2 * 2 - 1)[None, :, None]
        first = 0.5 * stripes * np.ones((HEIGHT, 1, 3))
        second = first[:, ::-1]
        renders = Renders(3)
        self.assertTrue(noise.compare(renders.of(first, 2), renders.of(second, 2)).different)

    def test_with_the_variance_samples_may_differ(self) -> None:
        """At level 0.01 at most 1 %, of 200 pairs: four times the samples, with fireflies."""
        renders, wrong = Renders(12), 0
        for _ in range(200):
            (a, va), (b, vb) = (renders.with_variance(bands(), n) for n in (4, 16))
            wrong += noise.compare([a], [b], variances=(va, vb)).different
        self.assertLessEqual(wrong, 2)

    def test_with_the_variance_one_render_finds_what_else_needs_two(self) -> None:
        stripes = 1.0 + 0.3 * (np.arange(WIDTH) % 2 * 2 - 1)[None, :, None]
        first = 0.5 * stripes * np.ones((HEIGHT, 1, 3))
        renders = Renders(13)
        (a, va), (b, vb) = (renders.with_variance(t, 8) for t in (first, first[:, ::-1]))
        self.assertFalse(noise.compare([a], [b]).different)
        self.assertTrue(noise.compare([a], [b], variances=(va, vb)).different)
        for _ in range(20):
            (a, va), (b, vb) = (renders.with_variance(t, 8) for t in (bands(), bands(1.01)))
            self.assertTrue(noise.compare([a], [b], variances=(va, vb)).different)

    def test_with_the_variance_how_much_is_noise(self) -> None:
        random = np.random.default_rng(14)
        truth = np.full((200, 200, 3), 0.5)
        a, b = (truth + step + random.normal(0, 0.1, truth.shape) for step in (0.0, 0.05))
        known = np.full(truth.shape, 0.01)
        found = noise.compare([a], [b], variances=(known, known))
        self.assertAlmostEqual(found.rms_noise, 0.1 * np.sqrt(2))
        self.assertAlmostEqual(found.rms_beyond, 0.05, delta=0.002)

    def test_without_noise_only_rounding_is_forgiven(self) -> None:
        none = np.zeros_like(bands())
        halves = bands().astype(np.float16).astype(np.float64)
        self.assertFalse(noise.compare([bands()], [halves], variances=(none, none)).different)
        other = bands() * 1.001
        self.assertTrue(noise.compare([bands()], [other], variances=(none, none)).different)

    def test_where_it_differs(self) -> None:
        other = bands()
        other[16:24, 40:48, 0] += 0.5
        renders = Renders(4, strength=0.05)
        found = noise.compare(renders.of(bands(), 1), renders.of(other, 1))
        self.assertTrue(found.different)
        self.assertTrue(found.tiles[2, 5])
        self.assertLess(found.share, 0.1)

    def test_how_much_is_noise(self) -> None:
        """Plain noise of a known variance, and a known difference."""
        random = np.random.default_rng(9)
        truth = np.full((200, 200, 3), 0.5)
        a = [truth + random.normal(0, 0.1, truth.shape) for _ in range(2)]
        b = [truth + 0.05 + random.normal(0, 0.1, truth.shape) for _ in range(2)]
        found = noise.compare(a, b)
        # The mean of two has the variance 0.1^2 / 2; the difference of two means twice that.
        self.assertAlmostEqual(found.rms_noise, 0.1, delta=0.001)
        self.assertAlmostEqual(found.rms_beyond, 0.05, delta=0.001)

    def test_equal_images(self) -> None:
        found = noise.compare([bands()], [bands()])
        self.assertFalse(found.different)
        self.assertEqual(found.p, 1.0)
        self.assertEqual(found.share, 0.0)

    def test_the_order_does_not_matter(self) -> None:
        renders = Renders(6)
        a, b = renders.of(bands(), 2), renders.of(bands(1.002), 2)
        self.assertAlmostEqual(noise.compare(a, b).p, noise.compare(b, a).p)

    def test_the_bound_holds_for_signs(self) -> None:
        """The hardest case of the theorem, all weights equal: exact tails of 8 x 8 coin flips."""
        flips = np.random.default_rng(2).integers(0, 2, (200_000, 64)) * 2 - 1
        t = flips.sum(axis=1) / 8.0
        for limit in (1.0, 2.0, 3.0):
            bound = np.exp(noise._log_p(np.array([limit])))[0]
            self.assertLessEqual((t >= limit).mean(), bound)

    def test_far_tails_neither_vanish_nor_jump(self) -> None:
        logs = noise._log_p(np.array([29.999, 30.001, 60.0]))
        self.assertAlmostEqual(logs[0], logs[1], delta=0.1)
        self.assertAlmostEqual(logs[2], -0.5 * 60**2, delta=10)

    def test_the_number_of_renders(self) -> None:
        with self.assertRaises(ValueError):
            noise.compare([bands()], [bands(), bands()])
        two = [bands(), bands()]
        with self.assertRaises(ValueError):
            noise.compare(two, two, variances=(bands(), bands()))


if __name__ == "__main__":
    unittest.main()
