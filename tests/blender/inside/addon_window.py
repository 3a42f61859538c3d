# SPDX-License-Identifier: GPL-2.0-or-later
"""The add-on as a user meets it: menus, search, redo panel, undo, properties editor, file browser.

Parameters: `folder` for the pictures of the window; `chip`, folder and name of a layout file to be
imported; `bad_chip`, one that cannot be read; `pause_s`, the time for each step.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace

import bpy
from bl_ui.space_statusbar import STATUSBAR_HT_header
from exchange import parameters, report
from window import area_of, context_of, in_window

Step = Callable[[], bool | None]

facts: dict[str, object] = {}


def shoot(name: str) -> None:
    """A picture of the window that was opened last."""
    with bpy.context.temp_override(window=bpy.context.window_manager.windows[-1]):
        bpy.ops.screen.screenshot(filepath=f"{parameters()['folder']}/{name}.png")


def press(kind: str, text: str = "") -> None:
    window = bpy.context.window_manager.windows[-1]
    place = {"x": window.width // 2, "y": window.height // 2}
    window.event_simulate(type=kind, value="PRESS", unicode=text or None, **place)
    window.event_simulate(type=kind, value="RELEASE", **place)


def type_text(text: str) -> None:
    for letter in text:
        press("SPACE" if letter == " " else letter.upper(), letter)


def rest_mouse() -> None:
    """In the middle of the window, which is in the 3D view."""
    window = bpy.context.window_manager.windows[-1]
    for away in (9, 0):
        window.event_simulate(
            type="MOUSEMOVE", value="NOTHING", x=window.width // 2 + away, y=window.height // 2
        )


def in_view() -> dict[str, object]:
    return context_of(area_of("VIEW_3D"))


def call_menu(name: str) -> None:
    with bpy.context.temp_override(**in_view()):
        bpy.ops.wm.call_menu(name=name)


def search(text: str) -> None:
    """Blender's own search, which finds what stands in menus."""
    with bpy.context.temp_override(**in_view()):
        bpy.ops.wm.search_menu("INVOKE_DEFAULT")
    type_text(text)


def things() -> dict[str, list[float]]:
    """All meshes of the scene by name: number of faces, and largest side."""
    bpy.context.view_layer.update()
    return {
        thing.name: [len(thing.data.polygons), max(thing.dimensions)]
        for thing in bpy.context.scene.objects
        if thing.type == "MESH"
    }


def panel_rectangle() -> list[int]:
    """Left, bottom, right and top of the redo panel, in pixels of the window."""
    region = next(r for r in area_of("VIEW_3D").regions if r.type == "HUD")
    return [region.x, region.y, region.x + region.width, region.y + region.height]


def unfold_panel() -> None:
    """It begins folded, in the lower left corner of the view."""
    left, bottom, _, top = panel_rectangle()
    window = bpy.context.window_manager.windows[0]
    place = {"x": left + 40, "y": (bottom + top) // 2}
    window.event_simulate(type="MOUSEMOVE", value="NOTHING", x=place["x"] - 9, y=place["y"])
    window.event_simulate(type="MOUSEMOVE", value="NOTHING", **place)
    window.event_simulate(type="LEFTMOUSE", value="PRESS", **place)
    window.event_simulate(type="LEFTMOUSE", value="RELEASE", **place)


def redo(**numbers: object) -> None:
    """What the redo panel does when its user changes something."""
    with bpy.context.temp_override(**in_view()):
        properties = bpy.context.window_manager.operators[-1].properties
        for name, value in numbers.items():
            setattr(properties, name, value)
        bpy.ops.ed.undo_redo("EXEC_DEFAULT", True)  # True: with steps of undo, as from the panel


def undo() -> None:
    with bpy.context.temp_override(**in_view()):
        bpy.ops.ed.undo()


def redo_undone() -> None:
    with bpy.context.temp_override(**in_view()):
        bpy.ops.ed.redo()


def add_wafer() -> None:
    """One with few blocks: a graphics card draws millions at once, software does not."""
    with bpy.context.temp_override(**in_view()):
        bpy.ops.mesh.ic_wafer_add(
            "INVOKE_DEFAULT", True, preset="power", diameter_mm="100", block_um=1000.0
        )  # True: with a step of undo, as from a menu


def add_die() -> None:
    with bpy.context.temp_override(**in_view()):
        bpy.ops.mesh.ic_die_add("INVOKE_DEFAULT", True, preset="bar-memory")


def tell_metals(name: str) -> Step:
    """Remembers the material of each die, and the metal in it."""

    def tell() -> None:
        materials = {
            thing.name: thing.data.materials[0]
            for thing in bpy.context.scene.objects
            if thing.name.startswith("IC Die")
        }
        facts[name] = {
            die: [material.name, material.node_tree.nodes["IC Wafer BSDF"].metal]
            for die, material in materials.items()
        }

    return tell


def choose_file() -> None:
    """In the file browser, which is another window."""
    window = bpy.context.window_manager.windows[-1]
    area = next(area for area in window.screen.areas if area.type == "FILE_BROWSER")
    area.spaces.active.params.directory = parameters()["chip"][0].encode()
    area.spaces.active.params.filename = parameters()["chip"][1]
    region = {region.type: region for region in area.regions}
    facts["options"] = [region["TOOL_PROPS"].width, region["TOOL_PROPS"].height]
    with bpy.context.temp_override(window=window, area=area, region=region["WINDOW"]):
        bpy.ops.file.execute()


def move_cursor(place: tuple[float, float, float]) -> None:
    bpy.context.scene.cursor.location = place


def wait() -> None:
    """While regions of a new window slide in."""


def begin_import(path: str, **options: object) -> None:
    """As after the file browser."""
    with bpy.context.temp_override(**in_view()):
        bpy.ops.import_scene.ic_chip("INVOKE_DEFAULT", True, filepath=path, **options)


def begin_slow_import() -> None:
    """In tiles so small that it takes many seconds."""
    begin_import("/".join(parameters()["chip"]), tile_um=2.0)


def status() -> str:
    """What the operator shows in the status bar; nothing if that is Blender's own again."""
    texts: list[str] = []
    row = SimpleNamespace(label=lambda text, icon: texts.append(text))
    header = SimpleNamespace(layout=SimpleNamespace(row=lambda align: row))
    draw = STATUSBAR_HT_header.draw
    if draw is not STATUSBAR_HT_header._draw_orig:
        draw(header, None)
    return " ".join(texts)


def is_reading() -> bool:
    return status().startswith("Reading") and " 0%" not in status()


def readers() -> int:
    """How many processes of this Blender read chips."""
    found = 0
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            parent = int((folder / "stat").read_text().rpartition(")")[2].split()[1])
            command = (folder / "cmdline").read_bytes()
            found += parent == os.getpid() and b"portrait.apart" in command
        except FileNotFoundError:
            pass  # it has just ended
    return found


def tell_import(name: str) -> Step:
    """Remembers how an import is going, and what of the user's keys reaches the view."""
    return lambda: facts.update(
        {
            name: {
                "status": status(),
                "readers": readers(),
                "things": things(),
                "selected": len(bpy.context.selected_objects),
                "data": [len(bpy.data.meshes), len(bpy.data.materials), len(bpy.data.objects)],
            }
        }
    )


def edit_mode(on: bool) -> None:
    with bpy.context.temp_override(**in_view()):
        bpy.context.view_layer.objects.active = bpy.data.objects["Cube"]
        bpy.ops.object.mode_set(mode="EDIT" if on else "OBJECT")


def until(condition: Callable[[], bool]) -> Step:
    """A step that is called again until something is so."""
    return lambda: not condition()


def tell(name: str) -> Step:
    """Remembers what there is in the scene."""
    return lambda: facts.update({name: things()})


# Else the view is drawn eight times after each change, which takes software long.
bpy.context.preferences.system.viewport_aa = "OFF"
in_window(
    rest_mouse,
    lambda: call_menu("VIEW3D_MT_mesh_add"),
    lambda: shoot("add_menu"),
    lambda: press("ESC"),
    lambda: search("ic die"),
    lambda: press("RET"),
    tell("die"),
    lambda: shoot("folded"),
    unfold_panel,
    lambda: shoot("unfolded"),
    lambda: facts.update({"panel": panel_rectangle()}),
    lambda: redo(seed=3, show_groups=True),
    tell("other seed"),
    lambda: shoot("groups"),
    lambda: redo(preset="dram"),
    tell("other preset"),
    lambda: redo(width_mm=0.1, height_mm=0.1),
    lambda: shoot("refused"),
    tell("refused"),
    lambda: press("ESC"),
    undo,
    tell("undone"),
    redo_undone,
    tell("redone"),
    undo,
    add_wafer,
    tell("wafer"),
    lambda: shoot("wafer"),
    undo,
    lambda: move_cursor((1.0, 2.0, 3.0)),
    lambda: search("chip layout"),
    lambda: press("RET"),
    wait,
    wait,
    lambda: shoot("import"),
    choose_file,
    until(lambda: "chip" in bpy.data.objects),
    tell("imported"),
    lambda: facts.update({"place": list(bpy.data.objects["chip"].location)}),
    lambda: shoot("imported"),
    undo,
    tell("import undone"),
    begin_slow_import,
    until(is_reading),
    lambda: press("A"),
    wait,
    tell_import("reading"),
    lambda: shoot("reading"),
    lambda: press("ESC"),
    wait,
    tell_import("cancelled"),
    lambda: begin_import(parameters()["bad_chip"]),
    until(lambda: status() == ""),
    tell_import("bad chip"),
    lambda: shoot("bad_chip"),
    lambda: press("ESC"),
    lambda: begin_import("/".join(parameters()["chip"])),
    lambda: edit_mode(True),
    until(lambda: "waits" in status()),
    tell_import("in edit mode"),
    lambda: edit_mode(False),
    until(lambda: status() == ""),
    tell_import("after edit mode"),
    add_die,
    add_die,
    tell_metals("two dies"),
    lambda: redo(metal="ALUMINIUM"),
    tell_metals("other metal"),
    lambda: report(facts),
    pause_s=parameters()["pause_s"],
)
