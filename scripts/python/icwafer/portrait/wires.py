# SPDX-License-Identifier: GPL-2.0-or-later
"""The wires of a real chip one by one, each with the grating that it is part of.

A chip that fills a picture shows its wires, which blocks cannot. So its shapes become solids, each
at the height of its layer, and light diffracts on the solids as on the grating that was found in
their layer and place.
"""

from __future__ import annotations

import logging
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from icwafer.layout_import.importer import Imported
from icwafer.layout_import.optics import Finding
from icwafer.layout_import.process import Process
from icwafer.layout_import.reader import Request, read_solids

_log = logging.getLogger(__name__)

#: What a renderer holds in about 5 GB; larger chips are shown as blocks.
MOST_SOLIDS = 3_000_000
#: Share of the light that rows of cells diffract, and how deep they are.
CELLS = 0.35
CELL_GROOVE_NM = 150.0
#: Wires without a grating.
_NONE = {"spacing_nm": 1000.0, "width_nm": 400.0, "direction_rad": 0.0, "diffraction": 0.0}


@dataclass(frozen=True)
class Wires:
    """n solids of metal, around the middle of the chip.

    corners_um: (n, 4, 2), clockwise. bottom_um, top_um: (n,), heights above the lowest metal's
    lower side. attributes: (n,) each, by the names of the faces' attributes without `ic_`.
    """

    corners_um: np.ndarray
    bottom_um: np.ndarray
    top_um: np.ndarray
    attributes: dict[str, np.ndarray]

    def write(self, path: Path) -> None:
        """Writes a .npz file."""
        np.savez(
            path,
            corners_um=self.corners_um,
            bottom_um=self.bottom_um,
            top_um=self.top_um,
            **{f"ic_{name}": values for name, values in self.attributes.items()},
        )

    @classmethod
    def read(cls, path: Path) -> Wires:
        """Reads what `write` has written."""
        with np.load(path) as file:
            columns = dict(file)
        shape = [columns.pop(name) for name in ("corners_um", "bottom_um", "top_um")]
        return cls(*shape, {n.removeprefix("ic_"): values for n, values in columns.items()})


def read_wires(request: Request, imported: Imported) -> Wires | None:
    """The wires of a chip that was imported; None if they are too many.

    Raises IcwaferError where the file cannot be read.
    """
    chip, *layers = read_solids(request, MOST_SOLIDS)
    if not any(len(layer.corners_um) for layer in layers):
        _log.info(
            "%s has more than %d wires: its blocks are shown instead", request.path, MOST_SOLIDS
        )
        return None
    process = request.process
    ground_um = min(layer.bottom_um for layer in process.layers)
    parts = []
    for solids in layers:
        metal = process.layers[solids.layer]
        count = len(solids.corners_um)
        attributes = _gratings(imported, solids.layer, solids.corners_um)
        attributes["oxide_nm"] = np.full(count, process.oxide_nm(metal))
        attributes["groove_nm"] = np.full(count, 1000 * metal.thickness_um)
        parts.append(
            Wires(
                solids.corners_um - np.array(chip.size_um) / 2,
                np.full(count, metal.bottom_um - ground_um),
                np.full(count, metal.top_um - ground_um),
                attributes,
            )
        )
    parts.append(_cells(imported, request.process))
    return Wires(
        *(
            np.concatenate([getattr(part, name) for part in parts])
            for name in ("corners_um", "bottom_um", "top_um")
        ),
        {
            name: np.concatenate([part.attributes[name] for part in parts])
            for name in parts[0].attributes
        },
    )


def _cells(imported: Imported, process: Process) -> Wires:
    """What is seen between the wires: the rows of cells, with the period of the lowest wires."""
    everything = [finding for findings in imported.findings.values() for finding in findings]
    lowest = max((finding.layer for finding in everything), default=0)
    candidates = [finding for finding in everything if finding.layer == lowest]
    strongest = _strongest(candidates)
    # Tracks may be stronger in a tile; the rows have the longer period.
    rows = max(
        (f for f in candidates if f.grating.amplitude > 0.5 * strongest.grating.amplitude),
        key=lambda finding: finding.grating.period_um,
        default=None,
    )
    half = np.array(imported.chip.size_um) / 2
    corners = half * np.array([[(-1, -1), (-1, 1), (1, 1), (1, -1)]])
    look = _look(rows) | {
        "diffraction": CELLS,
        "oxide_nm": process.oxide_nm(process.layers[-1]),
        "groove_nm": CELL_GROOVE_NM,
    }
    top_um = np.array([-0.2])
    attributes = {name: np.array([value]) for name, value in look.items()}
    return Wires(corners, top_um - 0.1, top_um, attributes)


def _gratings(imported: Imported, layer: int, corners_um: np.ndarray) -> dict[str, np.ndarray]:
    """For each solid of a layer the strongest grating of its tile, or else of the whole chip.

    Wires wider than a period are not part of it: they are plain metal.
    """
    count = np.array(imported.chip.tiles)
    found = {
        tile: _strongest([f for f in findings if f.layer == layer])
        for tile, findings in imported.findings.items()
    }
    anywhere = _strongest([finding for finding in found.values() if finding])
    looks = {tile: _look(finding or anywhere) for tile, finding in found.items()}
    place = np.floor(corners_um.mean(axis=1) / np.array(imported.chip.size_um) * count)
    column, row = np.clip(place, 0, count - 1).astype(np.int64).T
    tiles = sorted(looks)
    number = np.zeros(count, dtype=np.int64)
    for index, tile in enumerate(tiles):
        number[tile] = index
    values = {
        name: np.array([looks[tile][name] for tile in tiles])[number[column, row]]
        for name in _NONE
    }
    narrow_nm = 1000 * (corners_um.max(axis=1) - corners_um.min(axis=1)).min(axis=1)
    values["diffraction"][narrow_nm >= values["spacing_nm"]] = 0.0
    return values


def _strongest(findings: list[Finding]) -> Finding | None:
    return max(findings, key=lambda finding: finding.grating.amplitude, default=None)


def _look(finding: Finding | None) -> dict[str, float]:
    if finding is None:
        return _NONE
    grating = finding.grating
    return {
        "spacing_nm": 1000 * grating.period_um,
        "width_nm": 1000 * grating.duty * grating.period_um,
        "direction_rad": grating.direction_rad,
        # Wires stand in bundles: around one that is there, more of the grating is than elsewhere.
        "diffraction": min(1.0, grating.presence) ** 0.5,
    }
