# SPDX-License-Identifier: GPL-2.0-or-later
"""Random quantities: the statistics that the blocks of a group share.

The unit is that of the field that holds the spread.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np


class Spread(ABC):
    """A distribution with a mean, a standard deviation and two ends that no value passes."""

    mean: float
    deviation: float
    low: float
    high: float

    @abstractmethod
    def draw(self, rng: np.random.Generator, count: int) -> np.ndarray:
        """`count` values, float64."""

    @abstractmethod
    def moved(self, mean: float, deviation: float) -> Spread:
        """The same shape elsewhere: with another mean and standard deviation, at least 0."""


@dataclass(frozen=True)
class Normal(Spread):
    """Normal, kept within three deviations; without a deviation every value is the mean."""

    mean: float
    deviation: float = 0.0

    @property
    def low(self) -> float:
        return self.mean - 3 * self.deviation

    @property
    def high(self) -> float:
        return self.mean + 3 * self.deviation

    def draw(self, rng: np.random.Generator, count: int) -> np.ndarray:
        unit = np.clip(rng.standard_normal(count), -3.0, 3.0)
        return self.mean + self.deviation * unit

    def moved(self, mean: float, deviation: float) -> Normal:
        return Normal(mean, deviation)


@dataclass(frozen=True)
class Uniform(Spread):
    """Every value from `low` to `high` alike."""

    low: float
    high: float

    @property
    def mean(self) -> float:
        return (self.low + self.high) / 2

    @property
    def deviation(self) -> float:
        return (self.high - self.low) / 12**0.5

    def draw(self, rng: np.random.Generator, count: int) -> np.ndarray:
        return self.mean + self.deviation * rng.uniform(-(3**0.5), 3**0.5, count)

    def moved(self, mean: float, deviation: float) -> Uniform:
        half = 3**0.5 * deviation
        return Uniform(mean - half, mean + half)


@dataclass(frozen=True)
class Clustered(Spread):
    """Normal within three deviations around one of several centres, each as likely as another.

    cluster_deviation: within one cluster; `deviation` is that of all values together.
    """

    centres: tuple[float, ...]
    cluster_deviation: float = 0.0

    @property
    def mean(self) -> float:
        return sum(self.centres) / len(self.centres)

    @property
    def deviation(self) -> float:
        between = sum((centre - self.mean) ** 2 for centre in self.centres) / len(self.centres)
        return (between + self.cluster_deviation**2) ** 0.5

    @property
    def low(self) -> float:
        return min(self.centres) - 3 * self.cluster_deviation

    @property
    def high(self) -> float:
        return max(self.centres) + 3 * self.cluster_deviation

    def draw(self, rng: np.random.Generator, count: int) -> np.ndarray:
        centres = np.array(self.centres)[rng.integers(len(self.centres), size=count)]
        return centres + self.cluster_deviation * np.clip(rng.standard_normal(count), -3.0, 3.0)

    def moved(self, mean: float, deviation: float) -> Spread:
        if not self.deviation:
            return Normal(mean, deviation)
        scale = deviation / self.deviation
        centres = tuple(mean + scale * (centre - self.mean) for centre in self.centres)
        return Clustered(centres, scale * self.cluster_deviation)
