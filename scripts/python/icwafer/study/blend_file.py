# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes from .blend files, with settings of a study in them. Runs inside Blender only.

A file may come from anywhere: its scripts and drivers do not run, and its compositor writes no
files.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import bpy

from icwafer.errors import SettingError
from icwafer.scene.material import NODE, set_node
from icwafer.scene.properties import assign
from icwafer.scene.render import VIEW_ATTRIBUTES
from icwafer.study import fields
from icwafer.suggest import nearest

_RENDER = {
    "samples": "cycles.samples",
    "seed": "cycles.seed",
    "bounces": "cycles.max_bounces",
}


def build(settings: fields.Scene) -> bpy.types.Scene:
    """Opens the file of some settings and applies the others.

    Raises SettingError for the first that does not work.
    """
    path = settings[fields.BLEND]
    try:
        bpy.ops.wm.open_mainfile(filepath=path, load_ui=False, use_scripts=False)
    except RuntimeError as error:
        reason = " ".join(str(error).split())
        raise SettingError(f"cannot be opened: {reason}", fields.BLEND) from None
    scene = bpy.context.scene
    if scene.camera is None:
        raise SettingError(f"{path} has no camera: add one to its scene", fields.BLEND)
    _make_harmless(scene)
    for setting, value in settings.items():
        part, _, rest = setting.partition(".")
        if part == "node":
            _set_nodes(setting, rest, value)
        elif part == "data":
            _set_data(setting, rest, value)
        elif part == "render":
            _set_render(scene, rest, value)
        elif part == "view":
            assign(scene.view_settings, VIEW_ATTRIBUTES[rest], value, setting)
    return scene


def _make_harmless(scene: bpy.types.Scene) -> None:
    """Cycles on the CPU with what this Blender has, and no output but the image."""
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.use_denoising = False
    scene.render.use_sequencer = False
    for node in scene.node_tree.nodes if scene.use_nodes else ():
        if node.bl_idname == "CompositorNodeOutputFile":
            node.mute = True


def _set_render(scene: bpy.types.Scene, name: str, value: Any) -> None:
    if name == "size":
        scene.render.resolution_x, scene.render.resolution_y = value
        scene.render.resolution_percentage = 100
    else:
        owner, _, attribute = _RENDER[name].partition(".")
        setattr(getattr(scene, owner), attribute, value)


def _wafer_nodes() -> Iterator[tuple[bpy.types.NodeTree, bpy.types.Node]]:
    trees = [material.node_tree for material in bpy.data.materials if material.use_nodes]
    for tree in (*trees, *bpy.data.node_groups):
        yield from ((tree, node) for node in tree.nodes if node.bl_idname == NODE)


def _set_nodes(setting: str, name: str, value: Any) -> None:
    """Sets an input or property of all IC Wafer BSDF nodes of the file."""
    nodes = list(_wafer_nodes())
    if not nodes:
        raise SettingError("does not exist: the file has no IC Wafer BSDF node", setting)
    for tree, node in nodes:
        set_node(tree, node, {name: value})


def _set_data(setting: str, path: str, value: Any) -> None:
    """Sets what a data path from bpy.data leads to: `objects["Lamp"].location`."""
    owner_path, dot, attribute = path.rpartition(".")
    try:
        owner = bpy.data.path_resolve(owner_path) if dot else bpy.data
    except ValueError:
        raise SettingError(f"leads nowhere: {_nearest_name(path)}", setting) from None
    properties = getattr(owner, "bl_rna", None)
    names = (
        [p.identifier for p in properties.properties if not p.is_readonly] if properties else []
    )
    if attribute not in names:
        raise SettingError(f"leads nowhere: {nearest(attribute, names)}", setting)
    assign(owner, attribute, value, setting)


def _nearest_name(path: str) -> str:
    """Of a path whose object is missing: the nearest name in that collection."""
    collection, _, rest = path.partition('["')
    wanted = rest.partition('"]')[0]
    owner = getattr(bpy.data, collection, None)
    if owner is None:
        known = [p.identifier for p in bpy.data.bl_rna.properties if p.type == "COLLECTION"]
        return nearest(collection, known)
    return nearest(wanted, [thing.name for thing in owner])
