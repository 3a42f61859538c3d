#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Write ../illuminant_table.h from the spectra in this folder, or with --check say whether it is up
to date."""

import sys

import numpy as np

from generated import HERE, VISIBLE_NM, columns, main

STEP_NM = 5.0
#: In the order of the enumeration Illuminant in ../illuminants.h, after equal energy.
ILLUMINANTS = (
    ("D65, daylight", "illuminant_d65.csv"),
    ("A, tungsten", "illuminant_a.csv"),
    ("F2, fluorescent with a broad phosphor", "illuminant_f2.csv"),
    ("F11, fluorescent with three narrow phosphors", "illuminant_f11.csv"),
    ("LED-B3, blue LED with a phosphor", "illuminant_led_b3.csv"),
)


def power(name: str) -> np.ndarray:
    """Relative spectral power over the visible range, its mean 1."""
    data = columns(name)
    wavelength_nm = np.arange(VISIBLE_NM[0], VISIBLE_NM[1] + 0.5 * STEP_NM, STEP_NM)
    rows = np.searchsorted(data["wavelength_nm"], wavelength_nm)
    if not np.array_equal(data["wavelength_nm"][rows], wavelength_nm):
        raise SystemExit(f"{name}: rows must be {STEP_NM:g} nm apart, from 380 to 780 nm")
    values = data["relative_power"][rows]
    return values / values.mean()


def header_text() -> str:
    """The text of illuminant_table.h."""
    lines = [
        "/* SPDX-License-Identifier: Apache-2.0 */",
        "",
        "/* Relative spectral power of lamps, from the tables of CIE 015:2018. Made by",
        " * data/make_illuminants.py: do not edit. Host only. */",
        "",
        "#pragma once",
        "",
        '#include "illuminants.h"',
        "",
        "namespace icwafer {",
        "",
        "// clang-format off",
        "/* For each tabulated illuminant, every 5 nm of the visible range; the mean of each is 1. */",
        "constexpr double illuminant_table[illuminant_tabulated_count][illuminant_sample_count] = {",
    ]
    for name, file in ILLUMINANTS:
        numbers = [f"{value:.6f}," for value in power(file)]
        lines += [f"    /* {name} */", "    {"]
        lines += ["        " + " ".join(numbers[i : i + 8]) for i in range(0, len(numbers), 8)]
        lines += ["    },"]
    lines += ["};", "// clang-format on", "", "}  // namespace icwafer", ""]
    return "\n".join(lines)


if __name__ == "__main__":
    sys.exit(main(HERE.parent / "illuminant_table.h", header_text()))
