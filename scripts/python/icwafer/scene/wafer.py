# SPDX-License-Identifier: GPL-2.0-or-later
"""Wafers: one object whose dies are instances, so that a wafer costs the memory of one die.

The object's mesh is the disc of silicon and a loose point where each die stands; a geometry-nodes
modifier puts the dies on the points. The points carry `ic_die` (1 for the first kind of die, 0 for
the disc's own points, a negative number for what only viewports show) and the drift of the place,
`ic_drift`, which the material reads from the instance (Attribute node, type Instancer). Of what can
carry such attributes, an object for each die takes several times as long to the first sample, and
is hundreds of things to move (tests/benchmarks/wafer_scale.py).
"""

from __future__ import annotations

from collections.abc import Generator, Sequence

import bpy
import numpy as np

from icwafer.attributes import DRIFT, DRIFTING
from icwafer.chips.clip import Pieces, cut_to_usable
from icwafer.chips.die import generate
from icwafer.chips.model import Die, Layout
from icwafer.chips.outline import edge_profile_mm, outline_mm
from icwafer.chips.placement import WaferMap, blank_fields_mm, place_dies
from icwafer.chips.wafer import Wafer
from icwafer.errors import IcwaferError
from icwafer.scene.mesh import GAP_NM, STEP_MM, block_faces_mm, die_mesh
from icwafer.scene.parts import Parts
from icwafer.scene.polygons import add_attribute, at_height, loose_faces, polygon_mesh
from icwafer.scene.stand_in import stand_in

#: The node group that puts dies on points, one for all wafers of a file.
GROUP = "IC Wafer Instances"


def add_wafer(
    layout: Layout,
    collection: bpy.types.Collection,
    parts: Parts,
    name: str = "Wafer",
    gap_nm: float = GAP_NM,
    plates: bool = True,
) -> bpy.types.Object:
    """Links a wafer full of dies, as one object, to a collection; see `wafer_in_steps`."""
    steps = wafer_in_steps(layout, collection, parts, name, gap_nm, plates)
    while True:
        try:
            next(steps)
        except StopIteration as end:
            return end.value


def wafer_in_steps(
    layout: Layout,
    collection: bpy.types.Collection,
    parts: Parts,
    name: str = "Wafer",
    gap_nm: float = GAP_NM,
    plates: bool = True,
) -> Generator[float, None, bpy.types.Object]:
    """Links a wafer full of dies, as one object, to a collection. Yields how much is done, 0 to 1.

    The front lies in the plane z = 0 in mm, the wafer's centre is the origin, notch or flat at -y.
    plates: whether viewports show plates in place of the dies, see `icwafer.scene.stand_in`. Raises
    IcwaferError where the layout has no wafer.
    """
    if layout.wafer is None:
        raise IcwaferError("the layout has no wafer: give it a table [wafer]")
    places = place_dies(layout)
    meshes: list[bpy.types.Mesh] = []
    kind_of = yield from _die_meshes(meshes, layout, places, gap_nm)
    plates &= len(meshes) > 0
    mesh = _disc_mesh(name, layout, places, kind_of, plates)
    for material in (parts.silicon, parts.edge, parts.lane, parts.ground, parts.film_edge):
        mesh.materials.append(material)
    wafer = bpy.data.objects.new(name, mesh)
    dies = bpy.data.collections.new(f"{name} dies")
    # Geometry nodes pick by place in alphabetical order.
    for number, shape in enumerate(meshes):
        for material in (parts.blocks, parts.ground):
            shape.materials.append(material)
        die = bpy.data.objects.new(f"Die {number:05}", shape)
        die.display_type = "BOUNDS" if plates else "TEXTURED"
        dies.objects.link(die)
    if plates:
        title = f"Die {len(meshes):05} stand-in"
        # Wider lanes than real ones, which could not be seen.
        lane_mm = -0.05 * min(layout.dies[0].width_mm, layout.dies[0].height_mm)
        rects = _grounds_mm(layout, places, lane_mm)
        dies.objects.link(stand_in(title, layout.wafer, rects, meshes[0], parts))
    modifier = wafer.modifiers.new("Dies", "NODES")
    modifier.node_group = _instancing_group()
    modifier[modifier.node_group.inputs["Dies"].identifier] = dies
    collection.objects.link(wafer)
    return wafer


def _die_meshes(
    meshes: list[bpy.types.Mesh], layout: Layout, places: WaferMap, gap_nm: float
) -> Generator[float, None, np.ndarray]:
    """Appends a mesh for each different die. Returns for each place the index of its mesh.

    Every design is one; every partial die is another, for each one is cut elsewhere. Nothing is
    made for partial dies of which nothing is left; their index is -1.
    """
    kind_of = np.full(len(places), -1)
    partial = np.flatnonzero(places.partial)
    steps = len(layout.dies) + len(partial)
    for design, spec in enumerate(layout.dies):
        complete = (places.die == design) & ~places.partial
        here = [index for index in partial if places.die[index] == design]
        if not complete.any() and not here:
            continue
        die = generate(spec)
        if complete.any():
            kind_of[complete] = len(meshes)
            meshes.append(die_mesh(die, gap_nm, ground=True))
        yield (design + 1) / (steps + 1)
        faces = block_faces_mm(die, gap_nm) if here else None
        for done, index in enumerate(here):
            mesh = _partial_mesh(die, faces, gap_nm, places.centre_mm[index], layout.wafer)
            if mesh:
                kind_of[index] = len(meshes)
                meshes.append(mesh)
            yield (design + 1 + done) / (steps + 1)
    return kind_of


def _partial_mesh(
    die: Die, faces_mm: np.ndarray, gap_nm: float, centre_mm: np.ndarray, wafer: Wafer
) -> bpy.types.Mesh | None:
    """What of a die lies on the usable area, around the middle of the die."""
    half = np.array([die.spec.width_mm, die.spec.height_mm]) / 2
    ground = cut_to_usable(np.r_[centre_mm - half, centre_mm + half][None], wafer)
    blocks = cut_to_usable(faces_mm + np.r_[centre_mm, centre_mm], wafer)
    if not ground.cut:
        return None
    moved = tuple((index, polygon - centre_mm) for index, polygon in blocks.cut)
    return die_mesh(
        die,
        gap_nm,
        ground=True,
        pieces=Pieces(blocks.whole, moved),
        ground_piece=ground.cut[0][1] - centre_mm,
    )


def _disc_mesh(
    name: str, layout: Layout, places: WaferMap, kind_of: np.ndarray, with_stand_in: bool
) -> bpy.types.Mesh:
    """The disc, what lies on it but for the dies, and a loose point for each instance.

    On it lie the ground of the scribe lanes, films without a pattern where fields were not
    exposed, and the line along which the films end.
    """
    wafer = layout.wafer
    rings = [
        np.insert(outline_mm(wafer, inset), 2, height - 2 * STEP_MM, axis=1)
        for inset, height in edge_profile_mm(wafer)
    ]
    around = len(rings[0])
    index = np.arange(around)
    following = np.roll(index, -1)
    sides = [
        np.stack([index, index + around, following + around, following], axis=1) + ring * around
        for ring in range(len(rings) - 1)
    ]
    back = index[::-1] + (len(rings) - 1) * around
    lanes = _grounds_mm(layout, places, layout.wafer.scribe_um / 1000)
    blanks = _cut_mm(blank_fields_mm(layout), wafer)
    film_edge = _film_edge_mm(wafer)
    patches = [*lanes, *blanks, *film_edge]
    stands = np.flatnonzero(kind_of >= 0)
    patch_points = at_height(patches, -1.5 * STEP_MM)
    stand_in_point = np.zeros((int(with_stand_in), 2))
    instances = at_height([places.centre_mm[stands], stand_in_point], 0.0)
    disc = around * len(rings)
    mesh = polygon_mesh(
        name,
        np.concatenate([*rings, patch_points, instances]),
        [index[None], back[None], *sides, *loose_faces(patches, disc)],
    )
    # The faces are flat, the edge is round.
    material = np.repeat(
        np.arange(5, dtype=np.int32),
        [2, around * len(sides), len(lanes), len(blanks), len(film_edge)],
    )
    mesh.polygons.foreach_set("use_smooth", material == 1)
    mesh.polygons.foreach_set("material_index", material)

    first_die = disc + len(patch_points)
    of_dies = slice(first_die, first_die + len(stands))
    number = np.zeros(len(mesh.vertices), dtype=np.int32)
    number[of_dies] = kind_of[stands] + 1
    number[of_dies.stop :] = -(kind_of.max(initial=-1) + 2)
    add_attribute(mesh, "ic_die", "POINT", number, "INT")
    drift = np.zeros((len(mesh.vertices), len(DRIFTING)), dtype=np.float32)
    for component, quantity in enumerate(DRIFTING):
        drift[of_dies, component] = getattr(places, f"{quantity}_scale")[stands] - 1.0
    add_attribute(mesh, DRIFT.name, "POINT", drift, "FLOAT_VECTOR")
    return mesh


def _grounds_mm(layout: Layout, places: WaferMap, lane_mm: float) -> list[np.ndarray]:
    """The ground of each die with half of a lane around it, cut by the rim: (k, 2) each."""
    sizes = np.array([(die.width_mm, die.height_mm) for die in layout.dies])[places.die]
    half = (sizes + lane_mm) / 2
    rects = np.concatenate([places.centre_mm - half, places.centre_mm + half], axis=1)
    return _cut_mm(rects, layout.wafer)


def _film_edge_mm(wafer: Wafer) -> list[np.ndarray]:
    """The line along which the films end, in quadrangles: (4, 2) each; not on the round edge."""
    outer_mm = max(wafer.edge_exclusion_mm - wafer.film_edge_mm, wafer.bevel_mm)
    if outer_mm >= wafer.edge_exclusion_mm:
        return []
    inner, outer = (outline_mm(wafer, inset) for inset in (wafer.edge_exclusion_mm, outer_mm))
    return list(
        np.stack([inner, outer, np.roll(outer, -1, axis=0), np.roll(inner, -1, axis=0)], axis=1)
    )


def _cut_mm(rects_mm: np.ndarray, wafer: Wafer) -> list[np.ndarray]:
    """What of rectangles (n, 4) lies on the usable area: (k, 2) each."""
    pieces = cut_to_usable(rects_mm, wafer)
    whole: Sequence[np.ndarray] = rects_mm[pieces.whole][:, [[0, 1], [2, 1], [2, 3], [0, 3]]]
    return [*whole, *(polygon for _, polygon in pieces.cut)]


def _instancing_group() -> bpy.types.NodeTree:
    """Puts the objects of a collection on points: the one that `ic_die` names, counted from 1.

    Where the number is negative, viewports show the object, and renders do not.
    """
    group = bpy.data.node_groups.get(GROUP)
    if group is not None:
        return group
    group = bpy.data.node_groups.new(GROUP, "GeometryNodeTree")
    group.inputs.new("NodeSocketGeometry", "Geometry")
    group.inputs.new("NodeSocketCollection", "Dies").description = "The different dies, by name"
    group.outputs.new("NodeSocketGeometry", "Geometry")
    given = group.nodes.new("NodeGroupInput")
    result = group.nodes.new("NodeGroupOutput")
    number = group.nodes.new("GeometryNodeInputNamedAttribute")
    number.data_type = "INT"
    number.inputs["Name"].default_value = "ic_die"
    viewport = group.nodes.new("GeometryNodeIsViewport")
    dies = group.nodes.new("GeometryNodeCollectionInfo")
    dies.inputs["Separate Children"].default_value = True
    dies.inputs["Reset Children"].default_value = True
    instances = group.nodes.new("GeometryNodeInstanceOnPoints")
    instances.inputs["Pick Instance"].default_value = True
    join = group.nodes.new("GeometryNodeJoinGeometry")

    def math(operation: str, *operands: bpy.types.NodeSocket | float) -> bpy.types.Node:
        node = group.nodes.new("ShaderNodeMath")
        node.operation = operation
        for socket, operand in zip(node.inputs, operands):
            if isinstance(operand, float):
                socket.default_value = operand
            else:
                group.links.new(operand, socket)
        return node

    value = number.outputs[4]  # the integer one of outputs that all have one name
    counted = math("ABSOLUTE", value)
    pick = math("SUBTRACT", counted.outputs[0], 1.0)
    opposite = math("MULTIPLY", value, -1.0)
    in_viewport = math("MULTIPLY", opposite.outputs[0], viewport.outputs[0])
    wanted = math("MAXIMUM", value, in_viewport.outputs[0])
    for column, row, node in (
        (0, 0, given),
        (0, -250, number),
        (0, -450, viewport),
        (1, -400, opposite),
        (1, -600, counted),
        (2, -100, dies),
        (2, -400, in_viewport),
        (2, -600, pick),
        (3, -300, wanted),
        (4, -100, instances),
        (5, 0, join),
        (6, 0, result),
    ):
        node.location = (200 * column, row)
    for source, target in (
        (given.outputs["Geometry"], join.inputs["Geometry"]),
        (given.outputs["Geometry"], instances.inputs["Points"]),
        (given.outputs["Dies"], dies.inputs["Collection"]),
        (wanted.outputs[0], instances.inputs["Selection"]),
        (pick.outputs[0], instances.inputs["Instance Index"]),
        (dies.outputs[0], instances.inputs["Instance"]),
        (instances.outputs["Instances"], join.inputs["Geometry"]),
        (join.outputs["Geometry"], result.inputs["Geometry"]),
    ):
        group.links.new(source, target)
    return group
