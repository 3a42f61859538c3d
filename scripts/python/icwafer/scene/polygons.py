# SPDX-License-Identifier: GPL-2.0-or-later
"""Meshes from arrays of polygons."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import bpy
import numpy as np


def polygon_mesh(
    name: str, points: np.ndarray, polygons: Sequence[np.ndarray], edges: bool = True
) -> bpy.types.Mesh:
    """A mesh of n points and of polygons between them.

    points: (n, 3), in mm. polygons: each (m, k), m polygons of k corners as indices of points,
    counter-clockwise as seen from outside; faces are in this order.
    """
    corners = np.concatenate([part.ravel() for part in polygons]).astype(np.int32)
    sizes = np.repeat(
        [part.shape[1] for part in polygons], [len(part) for part in polygons]
    ).astype(np.int32)
    mesh = bpy.data.meshes.new(name)
    mesh.vertices.add(len(points))
    mesh.vertices.foreach_set("co", np.ascontiguousarray(points, dtype=np.float32).ravel())
    mesh.loops.add(len(corners))
    mesh.loops.foreach_set("vertex_index", corners)
    mesh.polygons.add(len(sizes))
    mesh.polygons.foreach_set("loop_start", np.cumsum(sizes, dtype=np.int32) - sizes)
    mesh.polygons.foreach_set("loop_total", sizes)
    mesh.update(calc_edges=edges)
    return mesh


def loose_faces(polygons: Sequence[np.ndarray], first: int = 0) -> list[np.ndarray]:
    """Polygons (k, ...) without common points, as `polygon_mesh` takes them.

    first: index of the first point; the others follow.
    """
    starts = first + np.cumsum([0, *map(len, polygons)])
    return [np.arange(at, at + len(part))[None] for at, part in zip(starts, polygons)]


def at_height(polygons: Sequence[np.ndarray], z_mm: float) -> np.ndarray:
    """The points (n, 3) of polygons (k, 2) in a plane."""
    return np.insert(np.concatenate([np.empty((0, 2)), *polygons]), 2, z_mm, axis=1)


def add_attribute(
    mesh: bpy.types.Mesh, name: str, domain: str, values: np.ndarray, kind: str = "FLOAT"
) -> None:
    """Gives each face or point (`domain` FACE or POINT) its value.

    kind: FLOAT or INT; or FLOAT_VECTOR, for values (n, 3).
    """
    key = "vector" if kind == "FLOAT_VECTOR" else "value"
    mesh.attributes.new(name, kind, domain).data.foreach_set(key, values.ravel())


def add_face_attributes(mesh: bpy.types.Mesh, values: Mapping[str, np.ndarray]) -> None:
    """Gives the faces attributes: (n,) each, by name.

    What is 0 on all faces becomes none: it reads as 0 without, and Cycles fetches attributes face
    by face before it renders.
    """
    for name, of_faces in values.items():
        if of_faces.any():
            add_attribute(mesh, name, "FACE", of_faces)
