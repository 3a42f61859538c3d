# SPDX-License-Identifier: Apache-2.0
"""What the generators of this folder share: reading the data, and writing or checking a header."""

from __future__ import annotations

import csv
import re
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
VISIBLE_NM = (380.0, 780.0)


def columns(name: str) -> dict[str, np.ndarray]:
    """The columns of a CSV file of this folder by their names."""
    with (HERE / name).open(newline="") as file:
        rows = list(csv.DictReader(file))
    return {key: np.array([float(row[key]) for row in rows]) for key in rows[0]}


def tabulated_nk(name: str) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Wavelength in nm, n and k of a refractiveindex.info file with tabulated values."""
    number = r"([\d.]+(?:[eE][+-]?\d+)?)"
    rows = re.findall(rf"^ +{number} +{number} +{number}$", (HERE / name).read_text(), re.M)
    wavelength_um, n, k = np.array(rows, dtype=float).T
    return wavelength_um * 1000.0, n, k


def sellmeier(name: str, wavelength_nm: np.ndarray) -> np.ndarray:
    """Index from a refractiveindex.info file with formula 1, n^2 - 1 = c1 + sum B L^2/(L^2 - C^2)."""
    line = re.search(r"^ +coefficients: (.*)$", (HERE / name).read_text(), re.M)
    if not line:
        raise SystemExit(f"{name}: no coefficients")
    first, *pairs = (float(x) for x in line[1].split())
    squared = (np.asarray(wavelength_nm) / 1000.0) ** 2
    terms = (b * squared / (squared - c * c) for b, c in zip(pairs[::2], pairs[1::2]))
    return np.sqrt(1.0 + first + sum(terms))


def main(header: Path, text: str) -> int:
    """Write the header, or with --check say whether it has this text."""
    if "--check" in sys.argv[1:]:
        if header.exists() and header.read_text() == text:
            return 0
        raise SystemExit(f"{header.name} is out of date: run {Path(sys.argv[0]).name}")
    header.write_text(text)
    return 0
