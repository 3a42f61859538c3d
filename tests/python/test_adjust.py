# SPDX-License-Identifier: GPL-2.0-or-later
"""Numbers from a panel: kept where they make sense, else brought to the nearest that do."""

from __future__ import annotations

import dataclasses
import math
import unittest

import numpy as np
from support import REPOSITORY  # noqa: F401  (finds the package)

from icwafer.chips.adjust import (
    GroupChange,
    WaferChange,
    adjusted_die,
    adjusted_group,
    adjusted_wafer,
)
from icwafer.chips.check import check_die, check_layout, group_problems
from icwafer.chips.die import generate, main_direction_rad
from icwafer.chips.model import Layout
from icwafer.chips.placement import place_dies
from icwafer.chips.presets import PRESETS, TITLES
from icwafer.chips.presets.parts import drifting_wafer
from icwafer.chips.spread import Clustered, Normal, Uniform

SPREADS = (Normal(1000.0, 20.0), Uniform(800.0, 1200.0), Clustered((900.0, 1000.0, 1300.0), 5.0))


def single(value: float) -> float:
    """What a property of Blender keeps of a number."""
    return float(np.float32(value))


def untouched(change: GroupChange) -> GroupChange:
    """A change as a panel returns it that nobody has touched."""
    return GroupChange(
        change.name, *(single(value) for value in dataclasses.astuple(change)[1:])
    )


USUAL = WaferChange(
    diameter_mm=300,
    marked=True,
    edge_exclusion_mm=3.0,
    scribe_um=80.0,
    partial_dies=False,
    test_dies=True,
    drift=1.0,
    seed=1,
)


class Spreads(unittest.TestCase):
    def test_a_moved_spread_has_the_mean_and_deviation(self) -> None:
        for spread in SPREADS:
            with self.subTest(spread=spread):
                moved = spread.moved(700.0, 12.0)
                self.assertIs(type(moved), type(spread))
                self.assertAlmostEqual(moved.mean, 700.0, places=9)
                self.assertAlmostEqual(moved.deviation, 12.0, places=9)
                drawn = moved.draw(np.random.default_rng(1), 20_000)
                # Four standard errors of a mean of 20000.
                self.assertLess(abs(drawn.mean() - 700.0), 4 * 12.0 / math.sqrt(20_000))

    def test_the_shape_stays(self) -> None:
        moved = SPREADS[2].moved(2000.0, 2 * SPREADS[2].deviation)
        gaps = np.diff(moved.centres) / np.diff(SPREADS[2].centres)
        np.testing.assert_allclose(gaps, 2.0)

    def test_equal_clusters_become_a_normal_spread(self) -> None:
        self.assertEqual(Clustered((500.0, 500.0)).moved(600.0, 3.0), Normal(600.0, 3.0))


class Dies(unittest.TestCase):
    def test_an_untouched_panel_gives_the_preset(self) -> None:
        for name, layout in PRESETS.items():
            with self.subTest(preset=name):
                spec = layout.dies[0]
                same = adjusted_die(
                    spec,
                    seed=spec.seed,
                    width_mm=single(spec.width_mm),
                    height_mm=single(spec.height_mm),
                    block_um=single(spec.block_um),
                    groups=[untouched(GroupChange.none(group)) for group in spec.groups],
                )
                self.assertEqual(same, spec)

    def test_what_is_changed_is_changed(self) -> None:
        spec = PRESETS["fpga"].dies[0]
        change = dataclasses.replace(
            GroupChange.none(spec.groups[0]), spacing_nm=1500.0, deviation_nm=9.0, diffraction=0.2
        )
        other = adjusted_die(
            spec, seed=7, width_mm=6.0, height_mm=5.0, block_um=200.0, groups=[change]
        )
        self.assertEqual((other.seed, other.width_mm, other.height_mm), (7, 6.0, 5.0))
        self.assertEqual(other.block_um, 200.0)
        old, new = spec.groups[0], other.groups[0]
        self.assertEqual(new.spacing_nm, Normal(1500.0, 9.0))
        self.assertAlmostEqual(new.diffraction.mean, 0.2)
        duty = [group.width_nm.mean / group.spacing_nm.mean for group in (old, new)]
        self.assertAlmostEqual(*duty, places=12)
        self.assertEqual(other.groups[1:], spec.groups[1:])

    def test_any_number_makes_a_group_without_problems(self) -> None:
        """The ends of the ranges and beyond, for groups of every spread."""
        for preset in PRESETS.values():
            for group in preset.dies[0].groups:
                for spacing in (0.0, 50.0, 300.0, 2e5, 1e9):
                    for deviation in (-1.0, 0.0, 40.0, 5e4):
                        change = GroupChange(group.name, spacing, deviation, 3e4, 2.0, -1.0)
                        found = list(group_problems(adjusted_group(group, change), ()))
                        self.assertEqual(found, [], (group, change))

    def test_the_number_of_blocks_has_a_limit(self) -> None:
        spec = PRESETS["graphics"].dies[0]
        other = adjusted_die(
            spec, seed=1, width_mm=31.3, height_mm=26.0, block_um=1.0, most_blocks=20_000
        )
        check_die(other)
        self.assertLess(len(generate(other)), 60_000)
        self.assertGreater(other.block_um, 100.0)

    def test_the_main_direction_is_that_of_most_wires(self) -> None:
        for name in ("eight-core", "dram"):
            die = generate(PRESETS[name].dies[0])
            weight = die.area_nm2 * die.diffraction
            along = die.direction_rad == np.float32(main_direction_rad(die))
            self.assertGreater(weight[along].sum(), weight[~along].sum())

    def test_every_preset_has_a_title(self) -> None:
        self.assertEqual(list(TITLES), list(PRESETS))


class Wafers(unittest.TestCase):
    def test_the_usual_numbers_give_the_wafer_of_the_preset(self) -> None:
        layout = PRESETS["eight-core"]
        self.assertEqual(adjusted_wafer(layout.dies, layout.wafer, USUAL), layout)

    def test_every_preset_on_every_wafer(self) -> None:
        for name, preset in PRESETS.items():
            for diameter_mm in (100, 125, 150, 200, 300):
                with self.subTest(preset=name, diameter=diameter_mm):
                    change = dataclasses.replace(USUAL, diameter_mm=diameter_mm)
                    wafer = preset.wafer or drifting_wafer()
                    check_layout(adjusted_wafer(preset.dies, wafer, change))

    def test_drift_is_a_factor_and_stays_inside_its_range(self) -> None:
        dies = PRESETS["eight-core"].dies

        def spread_of(drift: float) -> float:
            change = dataclasses.replace(USUAL, drift=drift)
            places = place_dies(adjusted_wafer(dies, drifting_wafer(), change))
            return float(np.ptp(places.oxide_scale))

        self.assertEqual(spread_of(0.0), 0.0)
        self.assertAlmostEqual(spread_of(2.0) / spread_of(1.0), 2.0, delta=0.01)
        self.assertLess(spread_of(1e6), 3.0)

    def test_without_test_dies_there_are_products(self) -> None:
        layout = PRESETS["eight-core"]
        change = dataclasses.replace(USUAL, test_dies=False)
        without = adjusted_wafer(layout.dies, layout.wafer, change)
        self.assertGreater((place_dies(layout).die == 1).sum(), 0)
        self.assertEqual((place_dies(without).die == 1).sum(), 0)

    def test_larger_dies_than_the_preset_has(self) -> None:
        layout = PRESETS["bar-memory"]
        large = dataclasses.replace(layout.dies[0], width_mm=20.0, height_mm=20.0)
        self.assertIsInstance(adjusted_wafer((large,), layout.wafer, USUAL), Layout)


if __name__ == "__main__":
    unittest.main()
