# SPDX-License-Identifier: GPL-2.0-or-later
"""Dies are checked over many seeds for what must hold for every one of them."""

from __future__ import annotations

import sys
import unittest
from dataclasses import replace
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts" / "python"))

from icwafer.chips.die import generate  # noqa: E402
from icwafer.chips.model import MM, Die, DieSpec, Group, Kind  # noqa: E402
from icwafer.chips.presets.spacing import with_spacing  # noqa: E402
from icwafer.chips.spread import Normal, Uniform  # noqa: E402
from icwafer.errors import IcwaferError  # noqa: E402

SEEDS = range(12)
GROUPS = (
    Group("logic", Kind.LOGIC, Normal(1080, 12), weight=3.0),
    Group("other logic", Kind.LOGIC, Normal(960, 20), turned=1.0),
    Group("memory", Kind.MEMORY, Normal(1190, 8), diffraction=Normal(0.6, 0.05)),
    Group("analog", Kind.ANALOG, Normal(1270, 15), turned=0.5),
    Group("pads", Kind.IO, Normal(920, 15)),
    Group("channel", Kind.STRIP, Normal(1000), diffraction=Normal(0.0)),
)
SPEC = DieSpec(GROUPS)


def coverage(rect_nm: np.ndarray) -> np.ndarray:
    """How many blocks lie over each cell of the grid that all their edges make."""
    xs, columns = np.unique(rect_nm[:, 0::2], return_inverse=True)
    ys, rows = np.unique(rect_nm[:, 1::2], return_inverse=True)
    (x0, x1), (y0, y1) = columns.reshape(-1, 2).T, rows.reshape(-1, 2).T
    # A rectangle is the sum from its corner on, less the sums from where it ends.
    count = np.zeros((len(ys), len(xs)), dtype=np.int32)
    for y, x, sign in ((y0, x0, 1), (y0, x1, -1), (y1, x0, -1), (y1, x1, 1)):
        np.add.at(count, (y, x), sign)
    return count.cumsum(axis=0).cumsum(axis=1)[:-1, :-1]


def cell_values(die: Die, group: int) -> np.ndarray:
    """The spacings drawn for a group, each once although many blocks may share it."""
    return np.unique(die.spacing_nm[die.group == group].astype(np.float64))


def dies(spec: DieSpec = SPEC) -> list[Die]:
    return [generate(replace(spec, seed=seed)) for seed in SEEDS]


class EveryDie(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        cls.dies = dies()

    def test_blocks_cover_the_die_exactly_once(self) -> None:
        for die in self.dies:
            self.assertTrue((die.rect_nm[:, 2:] > die.rect_nm[:, :2]).all())
            self.assertEqual(die.rect_nm[:, :2].min(axis=0).tolist(), [0, 0])
            size_nm = [round(SPEC.width_mm * MM), round(SPEC.height_mm * MM)]
            self.assertEqual(die.rect_nm[:, 2:].max(axis=0).tolist(), size_nm)
            count = coverage(die.rect_nm)
            self.assertEqual((count.min(), count.max()), (1, 1))
            self.assertEqual(die.area_nm2.sum(), size_nm[0] * size_nm[1])

    def test_odd_sizes_are_covered_too(self) -> None:
        for die in dies(replace(SPEC, width_mm=7.123457, height_mm=11.000003)):
            count = coverage(die.rect_nm)
            self.assertEqual((count.min(), count.max()), (1, 1))

    def test_several_thousand_blocks_of_every_kind(self) -> None:
        for die in self.dies:
            self.assertTrue(4000 < len(die) < 20000, len(die))
            self.assertEqual(np.unique(die.group).tolist(), list(range(len(GROUPS))))

    def test_the_same_seed_gives_the_same_bytes(self) -> None:
        for die in self.dies:
            again = generate(die.spec)
            for name in ("rect_nm", "group", "spacing_nm", "width_nm", "oxide_nm",
                         "direction_rad", "diffraction"):  # fmt: skip
                self.assertEqual(getattr(die, name).tobytes(), getattr(again, name).tobytes())

    def test_another_seed_gives_another_die(self) -> None:
        plans = {generate(replace(SPEC, seed=seed)).rect_nm.tobytes() for seed in SEEDS}
        self.assertEqual(len(plans), len(SEEDS))

    def test_groups_have_their_mean_and_deviation(self) -> None:
        # All seeds together, so that the error of the means is small; five standard errors.
        for index, group in enumerate(GROUPS):
            if group.spacing_nm.deviation == 0:
                continue
            values = np.concatenate([cell_values(die, index) for die in self.dies])
            error = group.spacing_nm.deviation / len(values) ** 0.5
            self.assertGreaterEqual(len(values), len(SEEDS), group.name)
            self.assertAlmostEqual(values.mean(), group.spacing_nm.mean, delta=5 * error)
            self.assertAlmostEqual(
                values.std(), group.spacing_nm.deviation, delta=5 * error / 2**0.5
            )

    def test_wires_run_along_x_or_along_y(self) -> None:
        for die in self.dies:
            share = []
            for index in range(len(GROUPS)):
                direction = die.direction_rad[die.group == index]
                turned = np.isclose(direction, np.pi / 2)
                self.assertTrue((turned | (direction == 0)).all())
                share.append(turned.mean())
            self.assertEqual((share[0], share[1]), (0.0, 1.0))
            self.assertTrue(0.2 < share[3] < 0.8, share[3])

    def test_strips_are_dark_and_nothing_else_is(self) -> None:
        for die in self.dies:
            strip = die.group == len(GROUPS) - 1
            self.assertTrue((die.diffraction[strip] == 0).all())
            self.assertTrue((die.diffraction[~strip] > 0.3).all())

    def test_cores_are_copies(self) -> None:
        # Eight cores and 24 tiles from one of each: far fewer values than blocks.
        for die in self.dies:
            self.assertLess(2 * len(cell_values(die, 0)), np.count_nonzero(die.group == 0))


class Statistics(unittest.TestCase):
    def test_the_heaviest_group_is_the_background(self) -> None:
        for seed in SEEDS:
            die = generate(replace(SPEC, seed=seed))
            logic = [die.area_nm2[die.group == index].sum() for index in (0, 1)]
            self.assertGreater(logic[0], 1.5 * logic[1])

    def test_one_wide_spread_fills_its_whole_range(self) -> None:
        die = generate(replace(SPEC, groups=with_spacing(GROUPS, Uniform(800, 1200))))
        self.assertTrue(800 <= die.spacing_nm.min() < 805)
        self.assertTrue(1195 < die.spacing_nm.max() <= 1200)
        self.assertAlmostEqual(cell_values(die, 0).std(), 400 / 12**0.5, delta=10)

    def test_a_normal_spread_ends_at_three_deviations(self) -> None:
        values = Normal(1000, 10).draw(np.random.default_rng(1), 100_000)
        self.assertEqual((values.min(), values.max()), (970, 1030))


class BadDescriptions(unittest.TestCase):
    def test_each_is_refused_by_name(self) -> None:
        narrow = replace(GROUPS[0], spacing_nm=Normal(50, 20))
        negative = replace(GROUPS[0], oxide_nm=Normal(530, -1))
        for spec, words in (
            (replace(SPEC, groups=GROUPS[:2] + GROUPS[3:]), "memory"),
            (replace(SPEC, height_mm=4.0), "too small"),
            (replace(SPEC, groups=(narrow, *GROUPS[1:])), "spacing_nm"),
            (replace(SPEC, groups=(negative, *GROUPS[1:])), "oxide_nm"),
        ):
            with self.assertRaisesRegex(IcwaferError, words):
                generate(spec)


if __name__ == "__main__":
    unittest.main()
