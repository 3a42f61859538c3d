# SPDX-License-Identifier: GPL-2.0-or-later
"""What is in a file of the asset library."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import bpy

AUTHOR = "IC Wafer BSDF"


@dataclass(frozen=True)
class Asset:
    """A data-block that becomes an asset.

    catalog: its path, as "Materials/Metals". pose: puts what the preview shows into the scene of
    the previews; whatever it links there is taken out again.
    """

    id: bpy.types.ID
    catalog: str
    description: str
    pose: Callable[[bpy.types.Scene], None]


def mark(asset: Asset, catalog_id: str) -> None:
    """Makes the data-block an asset of a catalog."""
    asset.id.asset_mark()
    data = asset.id.asset_data
    data.catalog_id = catalog_id
    data.description = asset.description
    data.author = AUTHOR
    for tag in ("IC Wafer", *asset.catalog.split("/")):
        data.tags.new(tag, skip_if_exists=True)
