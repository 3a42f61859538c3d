# SPDX-License-Identifier: GPL-2.0-or-later
"""What must hold for every die of every preset, over seeds and sizes."""

from __future__ import annotations

import sys
import unittest
from dataclasses import replace
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts" / "python"))

from icwafer.chips.blocks import overlap  # noqa: E402
from icwafer.chips.check import check_layout  # noqa: E402
from icwafer.chips.die import generate  # noqa: E402
from icwafer.chips.geometry import frames, grids, sliced  # noqa: E402
from icwafer.chips.model import (  # noqa: E402
    ATTRIBUTES,
    BlockTable,
    Die,
    DieSpec,
    Group,
    Kind,
    Layout,
    floorplan_names,
)
from icwafer.chips.presets import PRESETS  # noqa: E402
from icwafer.chips.spread import Clustered, Normal, Uniform  # noqa: E402
from icwafer.errors import IcwaferError  # noqa: E402

SEEDS = range(5)
SPECS = {spec.name: spec for layout in PRESETS.values() for spec in layout.dies}
ARRAYS = ("rect_nm", "group", "direction_rad", *ATTRIBUTES)


def all_bytes(die: Die) -> list[bytes]:
    return [getattr(die, name).tobytes() for name in ARRAYS]


def meet(rect: np.ndarray) -> set[tuple[int, int]]:
    """All pairs of rectangles that overlap, by comparing each with each."""
    low, high = rect[:, None, :2], rect[None, :, 2:]
    pairs = (low < high).all(axis=2) & (low < high).all(axis=2).T
    return {(int(a), int(b)) for a, b in zip(*np.nonzero(pairs)) if a < b}


class EveryPreset(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        cls.dies = [generate(replace(spec, seed=s)) for spec in SPECS.values() for s in SEEDS]

    def test_blocks_cover_the_die_exactly_once(self) -> None:
        for die in self.dies:
            rect = die.rect_nm
            self.assertTrue((rect[:, 2:] > rect[:, :2]).all())
            self.assertTrue((rect[:, :2] >= 0).all() and (rect[:, 2:] <= die.size_nm).all())
            self.assertIsNone(overlap(rect))
            # No overlap, nothing outside, and as much area as the die has: no gap either.
            width_nm, height_nm = die.size_nm
            self.assertEqual(int(die.area_nm2.sum()), width_nm * height_nm)

    def test_every_group_has_blocks_with_wires_in_its_range(self) -> None:
        for die in self.dies:
            self.assertEqual(np.unique(die.group).tolist(), list(range(len(die.spec.groups))))
            for index, group in enumerate(die.spec.groups):
                for name in ATTRIBUTES:
                    values = getattr(die, name)[die.group == index]
                    spread = getattr(group, name)
                    slack = 1e-6 * max(1.0, abs(spread.high))  # single precision
                    low, high = max(0.0, spread.low) - slack, spread.high + slack
                    self.assertTrue(((values >= low) & (values <= high)).all(), (group, name))
            self.assertTrue(((die.direction_rad >= 0) & (die.direction_rad < np.pi)).all())

    def test_the_same_seed_gives_the_same_bytes(self) -> None:
        for die in self.dies:
            self.assertEqual(all_bytes(die), all_bytes(generate(die.spec)))

    def test_another_seed_gives_another_die(self) -> None:
        for name in SPECS:
            plans = {die.rect_nm.tobytes() for die in self.dies if die.spec.name == name}
            self.assertEqual(len(plans), len(SEEDS), name)

    def test_odd_sizes_are_covered_too(self) -> None:
        for name, spec in SPECS.items():
            spec = replace(spec, width_mm=spec.width_mm * 1.0371293, height_mm=9.000001)
            die = generate(spec)
            width_nm, height_nm = die.size_nm
            self.assertIsNone(overlap(die.rect_nm), name)
            self.assertEqual(int(die.area_nm2.sum()), width_nm * height_nm, name)

    def test_smaller_blocks_are_more_blocks(self) -> None:
        for name, spec in SPECS.items():
            if spec.floorplan != "pictures":
                count = len(generate(spec))
                self.assertGreater(
                    len(generate(replace(spec, block_um=spec.block_um / 2))), 1.5 * count, name
                )

    def test_blocks_too_many_are_refused_at_once(self) -> None:
        large = replace(SPECS["graphics"], block_um=2.0)
        with self.assertRaisesRegex(IcwaferError, "more than 20000000 blocks: use 7 or more"):
            generate(large)

    def test_dies_too_small_say_so(self) -> None:
        refused = set()
        for name in floorplan_names():
            spec = next(spec for spec in SPECS.values() if spec.floorplan == name)
            for side_mm in (0.001, 0.01, 0.1, 0.3, 1.0, 3.0):
                small = replace(spec, width_mm=side_mm, height_mm=1.7 * side_mm)
                try:
                    die = generate(small)
                except IcwaferError as error:
                    self.assertRegex(str(error), "too small for")
                    refused.add(name)
                else:
                    self.assertEqual(int(die.area_nm2.sum()), int(np.prod(die.size_nm)))
        self.assertEqual(refused, set(floorplan_names()))


class Arrangement(unittest.TestCase):
    def test_cores_of_the_processor_are_mirrored_copies(self) -> None:
        # The left half, turned over, has the right half's logic and memory.
        die = generate(SPECS["eight-core"])
        width_nm, _ = die.size_nm
        shared = [i for i, g in enumerate(die.spec.groups) if g.name == "shared cache"]
        rect = die.rect_nm[np.isin(die.group, shared)]
        mirrored = np.stack([width_nm - rect[:, 2], rect[:, 1], width_nm - rect[:, 0], rect[:, 3]])
        self.assertGreater(len(rect), 100)
        distance = np.abs(rect[:, None] - mirrored.T).max(axis=2).min(axis=1)
        self.assertLessEqual(distance.max(), 2)  # each copy is rounded to whole nanometres

    def test_copies_share_their_wires(self) -> None:
        spec = SPECS["eight-core"]
        alike, own = generate(spec), generate(replace(spec, copies_alike=False))
        logic = alike.group == 0
        self.assertGreater(logic.sum(), 4 * len(np.unique(alike.spacing_nm[logic])))
        self.assertGreater(len(np.unique(own.spacing_nm[logic])), 0.9 * logic.sum())

    def test_pads_stand_along_all_four_sides(self) -> None:
        die = generate(SPECS["microcontroller"])
        pads = die.rect_nm[[die.spec.groups[g].kind == Kind.IO for g in die.group]]
        width_nm, height_nm = die.size_nm
        for distance in (pads[:, 0], pads[:, 1], width_nm - pads[:, 2], height_nm - pads[:, 3]):
            self.assertGreater((distance < 60_000).sum(), 10)
        inner = np.minimum(
            np.minimum(pads[:, 0], width_nm - pads[:, 2]),
            np.minimum(pads[:, 1], height_nm - pads[:, 3]),
        )
        self.assertLess(inner.max(), 60_000)

    def test_a_macro_takes_the_group_of_its_role(self) -> None:
        die = generate(SPECS["test-chip"])
        fields = [i for i, g in enumerate(die.spec.groups) if g.kind == Kind.PIXEL]
        areas = np.bincount(die.group, die.area_nm2)[fields]
        self.assertEqual(len(fields), 12)
        self.assertLess(areas.max() / areas.min(), 1.01)

    def test_without_a_group_of_a_kind_the_message_names_it(self) -> None:
        spec = SPECS["fpga"]
        groups = tuple(group for group in spec.groups if group.kind != Kind.BUS)
        with self.assertRaisesRegex(IcwaferError, "no group of kind bus"):
            generate(replace(spec, groups=groups))


class ListedBlocks(unittest.TestCase):
    GROUPS = (
        Group("a", Kind.LOGIC, Normal(700.0), direction_deg=30.0),
        Group("b", Kind.MEMORY, Normal(900.0), cross_spacing_nm=Normal(600.0)),
    )

    def die(self, rect_um: list, group: list[int]) -> Die:
        blocks = BlockTable.from_um(np.array(rect_um), np.array(group))
        return generate(DieSpec(self.GROUPS, width_mm=0.03, height_mm=0.02, blocks=blocks))

    def test_are_the_blocks_of_the_die(self) -> None:
        die = self.die([[0, 0, 10, 20], [10, 0, 29.9995, 20]], [1, 0])
        self.assertEqual(die.rect_nm.tolist(), [[0, 0, 10000, 20000], [10000, 0, 30000, 20000]])
        self.assertEqual(die.spacing_nm.tolist(), [900.0, 700.0])
        self.assertEqual(die.cross_spacing_nm.tolist(), [600.0, 0.0])
        np.testing.assert_allclose(die.direction_rad, [0.0, np.radians(30)], rtol=1e-6)

    def test_bad_ones_are_refused(self) -> None:
        for rect_um, group, words in (
            ([[0, 0, 10, 20], [9.999, 0, 20, 20]], [0, 1], "blocks 1, .* and 2 overlap"),
            ([[0, 0, 10, 20.001]], [0], "block 1, .* not inside the die of 0.03 x 0.02 mm"),
            ([[-1, 0, 10, 20]], [0], "not inside"),
            ([[5, 5, 5, 9]], [0], "no area"),
            ([[0, 0, 5, 5]], [2], "has group 3, but there are groups 1 to 2"),
            ([[0, 0, 5, 5]], [0, 1], "shapes"),
            (np.empty((0, 4)), [], "0 blocks"),
        ):
            blocks = BlockTable.from_um(np.array(rect_um), np.array(group))
            spec = DieSpec(self.GROUPS, width_mm=0.03, height_mm=0.02, blocks=blocks)
            with self.subTest(words), self.assertRaisesRegex(IcwaferError, words):
                check_layout(Layout((spec,)))


class Overlap(unittest.TestCase):
    def test_agrees_with_comparing_each_with_each(self) -> None:
        rng = np.random.default_rng(5)
        found = 0
        for count in (2, 3, 10, 40, 300) * 12:
            low = rng.integers(0, 3000, (count, 2))
            rect = np.concatenate([low, low + rng.integers(1, 900 // count + 40, (count, 2))], 1)
            pair, pairs = overlap(rect), meet(rect)
            found += bool(pairs)
            self.assertEqual(pair is None, not pairs)
            if pair:
                self.assertIn(tuple(sorted(pair)), pairs)
        self.assertTrue(10 < found < 50, found)

    def test_one_nanometre_among_many_sizes(self) -> None:
        die = generate(SPECS["microcontroller"])
        rng = np.random.default_rng(1)
        for block in rng.integers(len(die), size=20):
            rect = die.rect_nm.copy()
            side = 2 if rect[block, 2] < die.size_nm[0] else 0
            rect[block, side] += 1 if side == 2 else -1
            self.assertIn(block, overlap(rect))


class Cuts(unittest.TestCase):
    RECTS = np.array([[0, 0, 1_000_003, 700_001], [-9_005, -7, 0, 3_000_000], [1, -2, 2, -1]])

    def assert_parts_fill(self, parts: np.ndarray, parent: np.ndarray, rects: np.ndarray) -> None:
        self.assertIsNone(overlap(parts))
        self.assertTrue((np.diff(parent) >= 0).all())
        for index, rect in enumerate(rects):
            own = parts[parent == index]
            area = (own[:, 2:] - own[:, :2]).prod(axis=1).sum()
            self.assertEqual(area, (rect[2:] - rect[:2]).prod())
            self.assertTrue((own[:, :2] >= rect[:2]).all() and (own[:, 2:] <= rect[2:]).all())

    def test_slices_fill_their_rectangles(self) -> None:
        rng = np.random.default_rng(3)
        for area_nm2 in (4.0, 1e6, 1e9, 1e12):
            rects = self.RECTS if area_nm2 > 1e5 else np.array([[0, 0, 60, 40]])
            areas = np.full(len(rects), area_nm2)
            parts, parent = sliced(rng, rects, areas, max_aspect=3.0)
            self.assert_parts_fill(parts, parent, rects)
            sizes = (parts[:, 2:] - parts[:, :2]).prod(axis=1)
            self.assertLess(sizes.max(), 2 * max(area_nm2, 1.5))

    def test_slices_are_not_long(self) -> None:
        parts, _ = sliced(
            np.random.default_rng(3), self.RECTS[:1], np.array([1e7]), max_aspect=3.0
        )
        sides = parts[:, 2:] - parts[:, :2]
        aspect = sides.max(axis=1) / sides.min(axis=1)
        # A part at the limit may be cut once more across its shorter side, at 0.3 of it.
        self.assertLess(aspect.max(), 3.0 / 0.3 + 0.1)
        self.assertLess(np.median(aspect), 2.0)

    def test_grids_and_frames_fill_their_rectangles(self) -> None:
        rects = self.RECTS[:2]
        tiles, parent = grids(rects, np.array([7, 3]), np.array([1, 11]))
        self.assert_parts_fill(tiles, parent, rects)
        self.assertEqual(np.bincount(parent).tolist(), [7, 33])
        sides, parent, inside = frames(rects, np.array([1000, 17]))
        parts = np.concatenate([sides, inside])
        parents = np.concatenate([parent, np.arange(2)])
        order = np.argsort(parents, kind="stable")
        self.assert_parts_fill(parts[order], parents[order], rects)


class Spreads(unittest.TestCase):
    SPREADS = (
        Normal(1000.0, 20.0),
        Uniform(800.0, 1200.0),
        Clustered((800.0, 1000.0, 1260.0), 10.0),
        Normal(5.0),
    )

    def test_values_have_the_stated_mean_deviation_and_ends(self) -> None:
        count = 200_000
        for spread in self.SPREADS:
            values = spread.draw(np.random.default_rng(7), count)
            error = spread.deviation / count**0.5
            self.assertLessEqual(abs(values.mean() - spread.mean), 5 * error)
            # Cutting a normal spread at three deviations takes 1.3 % of its deviation.
            self.assertAlmostEqual(values.std(), spread.deviation, delta=0.02 * spread.deviation)
            self.assertTrue(((values >= spread.low) & (values <= spread.high)).all())

    def test_clusters_leave_gaps_between_them(self) -> None:
        values = self.SPREADS[2].draw(np.random.default_rng(7), 30_000)
        nearest = np.abs(values[:, None] - np.array(self.SPREADS[2].centres)).min(axis=1)
        self.assertLessEqual(nearest.max(), 30.0)
        counts, _ = np.histogram(values, [0, 900, 1130, 2000])
        np.testing.assert_allclose(counts / 30_000, 1 / 3, atol=0.015)

    def test_the_three_cases_of_the_original_project(self) -> None:
        uniform, normal, clustered = (
            generate(SPECS[f"spacing-{name}"]) for name in ("uniform", "normal", "clustered")
        )
        self.assertAlmostEqual(uniform.spacing_nm.std(), 400 / 12**0.5, delta=10)
        self.assertTrue(((normal.spacing_nm >= 950) & (normal.spacing_nm <= 1050)).all())
        wires = clustered.diffraction > 0
        background = clustered.area_nm2[clustered.group == 0].sum()
        others = np.bincount(clustered.group[wires], clustered.area_nm2[wires])[1:]
        self.assertGreater(background, others.max())


if __name__ == "__main__":
    unittest.main()
