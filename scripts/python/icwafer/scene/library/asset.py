# SPDX-License-Identifier: GPL-2.0-or-later
"""What is in a file of the asset library."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import bpy

AUTHOR = "IC Wafer BSDF"
#: Longest side of a thing, in units of the scene: it lies beside or on the cube of a new scene.
LARGE = 3.0


@dataclass(frozen=True)
class Asset:
    """A data-block that becomes an asset.

    catalog: its path, as "Materials/Metals". pose: puts what the preview shows into the scene of
    the previews, or takes something out; what that scene holds is restored afterwards.
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


def show_at(
    thing: bpy.types.Object, longest_mm: float, own_wires_rad: float, wires_rad: float
) -> None:
    """Makes a thing in mm `LARGE` units long, and turns it so that most of its wires lie as wanted."""
    thing.scale = (LARGE / longest_mm,) * 3
    thing.rotation_euler.z = wires_rad - own_wires_rad


def posed(thing: bpy.types.Object, name: str) -> bpy.types.Collection:
    """A collection of one thing, which keeps its turn where it is dragged into a scene.

    The asset browser puts an object down along the axes of the scene, where wires that run along
    its edges are dark; of a collection it puts down an instance.
    """
    collection = bpy.data.collections.new(name)
    collection.objects.link(thing)
    return collection


def show_collection(collection: bpy.types.Collection, scene: bpy.types.Scene) -> None:
    """Puts all of a collection into the scene of the previews."""
    scene.collection.children.link(collection)
