#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Write ../cie1931.h from cie1931_2deg_1nm.csv, or with --check say whether it is up to date."""

import csv
import sys

from generated import HERE, main


def header_text() -> str:
    """The text of cie1931.h: one row {xbar, ybar, zbar} for each nanometre."""
    with (HERE / "cie1931_2deg_1nm.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    first, last = (int(float(rows[i]["wavelength_nm"])) for i in (0, -1))
    if last - first + 1 != len(rows):
        raise SystemExit("cie1931_2deg_1nm.csv: rows must be 1 nm apart")
    lines = [
        "/* SPDX-License-Identifier: Apache-2.0 */",
        "",
        "/* Colour-matching functions of the CIE 1931 standard observer (2 degrees), from the tables",
        " * of CIE 015. Made by data/make_cie1931.py from data/cie1931_2deg_1nm.csv: do not edit. */",
        "",
        "#pragma once",
        "",
        "namespace icwafer {",
        "",
        f"constexpr int cie1931_first_nm = {first};",
        f"constexpr int cie1931_count = {len(rows)};",
        "",
        "/* {xbar, ybar, zbar} for each nanometre. */",
        "constexpr double cie1931[cie1931_count][3] = {",
        *("    {%s, %s, %s}," % (r["xbar"], r["ybar"], r["zbar"]) for r in rows),
        "};",
        "",
        "}  // namespace icwafer",
        "",
    ]
    return "\n".join(lines)


if __name__ == "__main__":
    sys.exit(main(HERE.parent / "cie1931.h", header_text()))
