# SPDX-License-Identifier: GPL-2.0-or-later
"""File > Import > Chip Layout."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import bpy
from bpy.props import CollectionProperty, EnumProperty, FloatProperty, StringProperty
from bpy_extras.io_utils import ImportHelper
from bpy_extras.object_utils import AddObjectHelper

from .add_die import add_die, add_wires
from .add_wafer import WaferOptions
from .busy import InSteps, Steps, all_or_nothing, finished
from .errors import reported
from .placing import PlacingOptions

if TYPE_CHECKING:
    from icwafer.portrait.apart import Wish
    from icwafer.portrait.subject import Subject

#: The command's options, as messages name them, and what they are called here.
_NAMES = {
    "with --layers": "as Process",
    "with --lef": "by selecting them with it",
    "with --top": "as Top Cell",
    "--tile": "Tile",
    "--window": "Window",
}

#: Blender needs the texts of an enumeration's items to live as long as they are shown.
_process_items: list[tuple[str, str, str]] = []


def process_items(_owner: object, _context: object) -> list[tuple[str, str, str]]:
    """The processes whose layers are known, and one's own."""
    if not _process_items:
        from icwafer.layout_import.process import USUAL, built_in

        usual_first = sorted(built_in(), key=lambda name: name != USUAL)
        _process_items.extend((name, name, "Layers of this process") for name in usual_first)
        own = "A layer map of your own: select it with the chip's file, or give its path below"
        _process_items.append(("OWN", "Layer Map", own))
    return _process_items


def side_um(name: str, description: str) -> FloatProperty:
    """A property for the side of a square on the chip, 0 for the usual one."""
    return FloatProperty(
        name=f"{name} (µm)", description=description, min=0.0, max=10_000.0, precision=1, step=500
    )


class ImportOptions(WaferOptions, PlacingOptions):
    """Properties of an import: the files, how to read them, and what to make of them."""

    filepath: StringProperty(subtype="FILE_PATH", options={"HIDDEN"})
    directory: StringProperty(subtype="DIR_PATH", options={"HIDDEN", "SKIP_SAVE"})
    files: CollectionProperty(
        type=bpy.types.OperatorFileListElement, options={"HIDDEN", "SKIP_SAVE"}
    )
    kind: EnumProperty(
        name="Make",
        description="What to make of the chip",
        items=[
            ("DIE", "Die", "One chip, as blocks with the wires that are found in each"),
            ("WIRES", "Wires", "One chip with each of its wires, for a close look; as blocks if "
             "there are too many"),
            ("WAFER", "Wafer", "A wafer full of this chip"),
        ],
    )
    process: EnumProperty(
        name="Process",
        description="The manufacturing process, which says what the file's layers are",
        items=process_items,
    )
    layer_map: StringProperty(
        name="Layer Map", description="File that describes the layers of another process, .toml"
    )
    top: StringProperty(
        name="Top Cell", description="The cell to read; empty for the one that contains all others"
    )
    tile_um: side_um(
        "Tile",
        "Side of the squares that the chip is looked at in, in µm. 0 for 25, or on large chips "
        "what gives 500 of them; take 200 for power straps",
    )
    window_um: side_um(
        "Window",
        "Side of what is looked at in the middle of each tile, in µm. 0 for the tile, at most 50; "
        "larger ones find longer periods",
    )

    def draw_reading(self, layout: bpy.types.UILayout) -> None:
        """The panel's part on how the files are read."""
        layout.prop(self, "process")
        if self.process == "OWN":
            layout.prop(self, "layer_map")
        layout.prop(self, "top")
        column = layout.column(align=True)
        column.prop(self, "tile_um")
        column.prop(self, "window_um")

    def draw_thing(self, layout: bpy.types.UILayout) -> None:
        layout.prop(self, "kind", expand=True)
        if self.kind == "WAFER":
            self.draw_wafer(layout)


class IMPORT_SCENE_OT_ic_chip(InSteps, ImportOptions, bpy.types.Operator):
    """Import a real chip from its layout: GDSII, OASIS, DEF with its LEF files, or .layout.toml"""

    bl_idname = "import_scene.ic_chip"
    bl_label = "Import Chip Layout"
    bl_options = {"REGISTER", "UNDO"}

    #: The last wish and what came of it, so that the redo panel need not read it again.
    kept = None

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        if not self.properties.is_property_set("filepath"):
            bpy.ops.import_scene.ic_chip_choose("INVOKE_DEFAULT")
            return {"CANCELLED"}
        return self.start(context) if context.window else self.execute(context)

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        finished(context, self.steps(context, patience_s=0.1))
        return {"FINISHED"}

    def steps(self, context: bpy.types.Context, patience_s: float = 0.0) -> Steps[None]:
        chip = self._chip()
        self.doing = f"Reading {chip.name}"
        subject = yield from self._read(self._wish(chip), patience_s)
        while not self.poll(context):
            self.doing = f"{chip.name} waits for Object Mode"
            yield 1.0
            yield None
        self.doing, self.alone = f"Building {chip.name}", True
        with all_or_nothing():
            yield from self._make(context, subject, chip.name.split(".")[0])

    def _read(self, wish: Wish, patience_s: float) -> Steps[Subject]:
        from icwafer.errors import IcwaferError
        from icwafer.portrait.apart import subject_apart

        if self.kept is None or self.kept[0] != wish:
            try:
                self.kept = wish, (yield from subject_apart(wish, patience_s))
            except IcwaferError as error:
                text = str(error)
                for option, here in _NAMES.items():
                    text = text.replace(option, here)
                raise IcwaferError(text) from None
        return self.kept[1]

    def _make(self, context: bpy.types.Context, subject: Subject, name: str) -> Steps[None]:
        from icwafer.portrait.subject import with_wafer

        self.process_values = subject.node
        if self.kind == "WAFER":
            layout = with_wafer(subject.layout)
            for field, value in self.wafer_numbers_of(layout.wafer).items():
                if not self.properties.is_property_set(field):
                    setattr(self, field, value)
            yield from self.wafer_in_steps(context, layout.dies, layout.wafer, name)
        elif self.kind == "WIRES" and subject.wires:
            add_wires(self, context, subject.layout.dies[0], subject.wires, name)
        else:
            add_die(self, context, subject.layout.dies[0], name)

    def node_values(self) -> dict[str, Any]:
        return super().node_values() | self.process_values

    def _selected(self) -> list[Path]:
        named = [Path(self.directory, file.name) for file in self.files if file.name]
        return named or [Path(self.filepath)]

    def _chip(self) -> Path:
        """The file of the chip among the selected ones; the others belong to it."""
        from icwafer.errors import IcwaferError

        selected = self._selected()
        helping = {".lef", ".toml"}
        chips = [
            path
            for path in selected
            if path.suffix.lower() not in helping or path.name.endswith(".layout.toml")
        ]
        if len(chips) != 1:
            names = ", ".join(path.name for path in chips) or "none"
            raise IcwaferError(
                "Select one chip, and its LEF files or layer map if it needs them; these are "
                f"chips: {names}"
            )
        return chips[0]

    def _wish(self, chip: Path) -> Wish:
        from icwafer.portrait.apart import Wish

        others = [path for path in self._selected() if path != chip]
        maps = [path for path in others if path.suffix.lower() == ".toml"]
        return Wish(
            path=str(chip),
            layers=str(maps[0]) if maps else self._layers(),
            lef=tuple(str(path) for path in others if path.suffix.lower() == ".lef"),
            top=self.top or None,
            tile_um=self.tile_um or None,
            window_um=self.window_um or None,
        )

    def _layers(self) -> str:
        from icwafer.errors import IcwaferError

        if self.process != "OWN":
            return self.process
        if not self.layer_map:
            raise IcwaferError("The process is a layer map: select it with the chip's file")
        return bpy.path.abspath(self.layer_map)


class IMPORT_SCENE_OT_ic_chip_choose(ImportOptions, ImportHelper, bpy.types.Operator):
    __doc__ = IMPORT_SCENE_OT_ic_chip.__doc__

    bl_idname = "import_scene.ic_chip_choose"
    bl_label = "Import Chip Layout"
    bl_options = {"INTERNAL"}

    filter_glob: StringProperty(
        default="*.gds;*.gds.gz;*.gds2;*.oas;*.def;*.lef;*.toml", options={"HIDDEN"}
    )

    def execute(self, context: bpy.types.Context) -> set[str]:
        options = self.as_keywords(ignore=("filter_glob", "files"))
        # What is not said of the wafer, the file decides; of the place, the 3D cursor.
        for name in (*WaferOptions.__annotations__, *AddObjectHelper.__annotations__):
            if not self.properties.is_property_set(name):
                del options[name]
        files = [{"name": file.name} for file in self.files]
        with context.temp_override(**_view(context)):
            bpy.ops.import_scene.ic_chip("INVOKE_DEFAULT", True, files=files, **options)
        return {"FINISHED"}

    def draw_thing(self, layout: bpy.types.UILayout) -> None:
        super().draw_thing(layout)
        self.draw_reading(layout)


def _view(context: bpy.types.Context) -> dict[str, Any]:
    """The 3D view that shows the redo panel of an import, which began in a menu."""
    views = [area for area in context.screen.areas if area.type == "VIEW_3D"]
    if not views:
        return {}
    view = max(views, key=lambda area: area.width * area.height)
    return {
        "area": view,
        "region": next(region for region in view.regions if region.type == "WINDOW"),
    }
