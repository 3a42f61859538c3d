#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Write ../oxides.h: Cauchy's series for the oxides whose Sellmeier formulas are in this folder, or
with --check say whether it is up to date."""

import sys

import numpy as np

from generated import HERE, VISIBLE_NM, main, sellmeier

#: In the order of the enumeration Oxide.
OXIDES = (
    ("sio2", "SiO2_Malitson.yml", "SiO2: I. H. Malitson, J. Opt. Soc. Am. 55, 1205 (1965)"),
    (
        "si3n4",
        "Si3N4_Philipp.yml",
        "Si3N4: H. R. Philipp, J. Electrochem. Soc. 120, 295 (1973); formula of T. Baak,\n"
        " *   Appl. Opt. 21, 1069 (1982)",
    ),
)


def cauchy(name: str) -> tuple[np.ndarray, float]:
    """a, b, c of n = a + b / L^2 + c / L^4, L in nm, and the largest error in the visible range,
    which no other three coefficients make smaller (exchange algorithm of Remez)."""
    wavelength_nm = np.arange(VISIBLE_NM[0], VISIBLE_NM[1] + 0.05, 0.1)
    x, n = (VISIBLE_NM[0] / wavelength_nm) ** 2, sellmeier(name, wavelength_nm)
    at = np.linspace(0, len(x) - 1, 4).astype(int)
    for _ in range(20):
        signs = np.array([1.0, -1.0, 1.0, -1.0])
        *series, _ = np.linalg.solve(np.column_stack([x[at] ** 0, x[at], x[at] ** 2, signs]), n[at])
        error = n - np.polynomial.polynomial.polyval(x, series)
        runs = np.split(np.arange(len(x)), np.flatnonzero(np.diff(np.sign(error))) + 1)
        at = np.array([run[np.argmax(np.abs(error[run]))] for run in runs])
    return np.array(series) * VISIBLE_NM[0] ** np.array([0, 2, 4]), float(np.max(np.abs(error)))


def header_text() -> str:
    """The text of oxides.h."""
    papers = "\n".join(f" *   {paper}" for _, _, paper in OXIDES)
    lines = [
        "/* SPDX-License-Identifier: Apache-2.0 */",
        "",
        "/* Oxides by name: their index of refraction in the visible range, as Cauchy's series. Made by",
        " * data/make_oxides.py from Sellmeier formulas of the refractiveindex.info database: do not",
        " * edit.",
        f"{papers} */",
        "",
        "#pragma once",
        "",
        '#include "platform.h"',
        "",
        "namespace icwafer {",
        "",
        "enum Oxide {",
        *(f"  oxide_{name}," for name, _, _ in OXIDES),
        "  /* Index given by the artist, the same for all wavelengths. */",
        "  oxide_custom,",
        "};",
        "",
        "/* n = a + b / L^2 + c / L^4 for the wavelength L in nanometres, 380 to 780. */",
        "struct Cauchy {",
        "  float a, b, c;",
        "};",
        "",
        "/* `per_nm` is 1 / L, in as many lanes as there are wavelengths. */",
        "template<typename Real>",
        "ICW_DEVICE Real cauchy_index(const Cauchy series, const Real per_nm)",
        "{",
        "  const Real x = per_nm * per_nm;",
        "  return series.a + x * (series.b + x * series.c);",
        "}",
        "",
        "/* The series of an oxide; `custom_index` is that of oxide_custom. */",
        "ICW_DEVICE Cauchy oxide_series(const Oxide oxide, const float custom_index)",
        "{",
        "  switch (oxide) {",
    ]
    for name, file, _ in OXIDES:
        (a, b, c), error = cauchy(file)
        lines += [
            f"    case oxide_{name}: /* Largest error {error:.1e}. */",
            f"      return {{{a:.6f}f, {b:.3f}f, {c:.5e}f}};",
        ]
    lines += [
        "    case oxide_custom:",
        "      break;",
        "  }",
        "  return {custom_index, 0.0f, 0.0f};",
        "}",
        "",
        "}  // namespace icwafer",
        "",
    ]
    return "\n".join(lines)


if __name__ == "__main__":
    sys.exit(main(HERE.parent / "oxides.h", header_text()))
