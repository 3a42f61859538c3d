#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Write ../metal_table.h from the refractive indices in this folder, or with --check say whether
it is up to date.

The sources are tabulated at wavelengths of their own. Between these, n and k follow a monotone
cubic in wavelength (F. N. Fritsch and J. Butland, "A method for constructing local monotone
piecewise cubic interpolants", SIAM J. Sci. Stat. Comput. 5, 300 (1984)): through every published
value, with no overshoot at the edge of copper."""

import sys

import numpy as np

from generated import HERE, VISIBLE_NM, main, tabulated_nk

STEP_NM = 5.0
#: In the order of the enumeration Metal in ../metals.h.
METALS = (
    ("copper", "Cu_Johnson.yml", "P. B. Johnson, R. W. Christy, Phys. Rev. B 6, 4370 (1972)"),
    ("aluminium", "Al_Rakic.yml", "A. D. Rakic, Appl. Opt. 34, 4755 (1995)"),
    ("tungsten", "W_Werner.yml", "W. S. M. Werner et al., J. Phys. Chem. Ref. Data 38, 1013 (2009)"),
    ("silicon", "Si_Green-2008.yml", "M. A. Green, Sol. Energ. Mat. Sol. Cells 92, 1305 (2008)"),
)


def monotone_cubic(x: np.ndarray, y: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Values between the points (x, y), x ascending: each monotone where the points are."""
    width = np.diff(x)
    slope = np.diff(y) / width
    left, right = slope[:-1], slope[1:]
    monotone = left * right > 0.0
    weight = (width[:-1] + 2.0 * width[1:]) / (3.0 * (width[:-1] + width[1:]))
    mean = weight * right + (1.0 - weight) * left
    tangent = np.zeros_like(y)
    tangent[1:-1][monotone] = (left * right)[monotone] / mean[monotone]

    cell = np.clip(np.searchsorted(x, at) - 1, 0, len(x) - 2)
    t, h = (at - x[cell]) / width[cell], width[cell]
    return (
        (1.0 + 2.0 * t) * (1.0 - t) ** 2 * y[cell]
        + t**2 * (3.0 - 2.0 * t) * y[cell + 1]
        + t * (1.0 - t) ** 2 * h * tangent[cell]
        - t**2 * (1.0 - t) * h * tangent[cell + 1]
    )


def grid_nm() -> np.ndarray:
    """The wavelengths of the table."""
    return np.arange(VISIBLE_NM[0], VISIBLE_NM[1] + 0.5 * STEP_NM, STEP_NM)


def index(name: str, wavelength_nm: np.ndarray) -> np.ndarray:
    """Complex index n + i k of a source."""
    source_nm, n, k = tabulated_nk(name)
    n, k = (monotone_cubic(source_nm, values, wavelength_nm) for values in (n, k))
    return n + 1j * k


def reflectance_error(name: str, above: float) -> float:
    """Largest error of the reflectance, at normal incidence from a medium of index `above`, where
    the table with linear interpolation stands for the monotone cubic: at every 1/4 nm."""
    fine_nm = np.arange(VISIBLE_NM[0], VISIBLE_NM[1] + 0.1, 0.25)
    exact, table = index(name, fine_nm), index(name, grid_nm())
    linear = np.interp(fine_nm, grid_nm(), table.real) + 1j * np.interp(
        fine_nm, grid_nm(), table.imag
    )

    def reflectance(metal: np.ndarray) -> np.ndarray:
        return np.abs((above - metal) / (above + metal)) ** 2

    return float(np.max(np.abs(reflectance(linear) - reflectance(exact))))


def header_text() -> str:
    """The text of metal_table.h."""
    lines = [
        "/* SPDX-License-Identifier: Apache-2.0 */",
        "",
        "/* Complex refractive indices n + i k of metals, from the refractiveindex.info database.",
        " * Made by data/make_metals.py: do not edit. Host only; kernels read a copy (metals.h).",
        " *",
        " * With linear interpolation the reflectance is wrong by at most, in air and under oxide:",
    ]
    for name, file, paper in METALS:
        errors = " ".join(f"{reflectance_error(file, above):.4f}" for above in (1.0, 1.46))
        lines.append(f" *   {errors}  {name}, {paper}")
    lines[-1] += " */"
    lines += [
        "",
        "#pragma once",
        "",
        '#include "metals.h"',
        "",
        "namespace icwafer {",
        "",
        "// clang-format off",
        "/* {n, k} for each metal and wavelength. */",
        "constexpr float metal_table[metal_table_size] = {",
    ]
    for name, file, _ in METALS:
        lines.append(f"    /* {name} */")
        pairs = [f"{v.real:.5f}f, {v.imag:.5f}f," for v in index(file, grid_nm())]
        lines += ["    " + " ".join(pairs[i : i + 4]) for i in range(0, len(pairs), 4)]
    lines += ["};", "// clang-format on", "", "}  // namespace icwafer", ""]
    return "\n".join(lines)


if __name__ == "__main__":
    sys.exit(main(HERE.parent / "metal_table.h", header_text()))
