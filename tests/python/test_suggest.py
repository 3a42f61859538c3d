# SPDX-License-Identifier: GPL-2.0-or-later
"""A name with a typing error is answered with the nearest one that exists."""

from __future__ import annotations

import unittest

from icwafer.suggest import nearest, unknown

INPUTS = ["Wire Spacing", "Wire Width"]


class SuggestTest(unittest.TestCase):
    def test_the_nearest_name_whatever_its_case(self) -> None:
        self.assertEqual(nearest("wire spacng", INPUTS), "did you mean 'Wire Spacing'?")

    def test_all_names_where_none_is_near(self) -> None:
        self.assertEqual(nearest("x", INPUTS), "choose from Wire Spacing, Wire Width")
        self.assertEqual(nearest("x", []), "there is none to choose from")

    def test_whole_messages(self) -> None:
        self.assertEqual(
            unknown("preset", "drm", ["dram", "fpga"]), "no preset 'drm': did you mean 'dram'?"
        )
        self.assertEqual(unknown("", "y" * 99, ["a"]), f"'{'y' * 60}' is unknown: choose from a")


if __name__ == "__main__":
    unittest.main()
