# SPDX-License-Identifier: GPL-2.0-or-later
"""What Blender is asked for: a portrait as data, in a file."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from icwafer.pictures import NodeValue


@dataclass(frozen=True)
class Order:
    """layout: a layout file; wires: a file of `Wires`, or "" to show the die's blocks; wafer: show
    the layout's wafer instead. png, exr: where the picture goes, "" for none. node: inputs and
    properties of the node."""

    layout: str
    wires: str
    wafer: bool
    size: tuple[int, int]
    samples: int
    png: str
    exr: str
    node: Mapping[str, NodeValue] = field(default_factory=dict)

    def write(self, path: Path) -> None:
        """Writes JSON."""
        path.write_text(json.dumps(dataclasses.asdict(self)), encoding="utf-8")

    @classmethod
    def read(cls, path: Path) -> Order:
        """Reads what `write` has written."""
        given = json.loads(path.read_text(encoding="utf-8"))
        return cls(**(given | {"size": tuple(given["size"])}))
