# SPDX-License-Identifier: GPL-2.0-or-later
"""File > Import > Chip Layout."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import bpy
from bpy.props import CollectionProperty, EnumProperty, FloatProperty, StringProperty
from bpy_extras.io_utils import ImportHelper

from .add_die import add_die, add_wires
from .add_wafer import WaferOptions
from .busy import progress
from .errors import reported
from .placing import PlacingOptions

if TYPE_CHECKING:
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


class IMPORT_SCENE_OT_ic_chip(WaferOptions, PlacingOptions, ImportHelper, bpy.types.Operator):
    """Import a real chip from its layout: GDSII, OASIS, DEF with its LEF files, or .layout.toml"""

    bl_idname = "import_scene.ic_chip"
    bl_label = "Import Chip Layout"
    bl_options = {"REGISTER", "UNDO"}

    filter_glob: StringProperty(
        default="*.gds;*.gds.gz;*.gds2;*.oas;*.def;*.lef;*.toml", options={"HIDDEN"}
    )
    files: CollectionProperty(type=bpy.types.OperatorFileListElement, options={"HIDDEN"})
    directory: StringProperty(subtype="DIR_PATH", options={"HIDDEN"})
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
    tile_um: FloatProperty(
        name="Tile (µm)",
        description="Side of the squares that the chip is looked at in, in µm. 0 for 25, or on "
        "large chips what gives 500 of them; take 200 for power straps",
        default=0.0,
        min=0.0,
        max=10_000.0,
        precision=1,
        step=500,
    )
    window_um: FloatProperty(
        name="Window (µm)",
        description="Side of what is looked at in the middle of each tile, in µm. 0 for the tile, "
        "at most 50; larger ones find longer periods",
        default=0.0,
        min=0.0,
        max=10_000.0,
        precision=1,
        step=500,
    )

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return super().poll(context) and context.mode == "OBJECT"

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        chip = self._chip()
        subject = self._read(context, chip)
        layout, name = subject.layout, chip.name.split(".")[0]
        self.process_values = subject.node
        if self.kind == "WAFER":
            for field, value in self.wafer_numbers_of(layout.wafer).items():
                if not self.properties.is_property_set(field):
                    setattr(self, field, value)
            self.add_wafer(context, layout.dies, layout.wafer, name)
        elif self.kind == "WIRES" and subject.wires:
            add_wires(self, context, layout.dies[0], subject.wires, name)
        else:
            add_die(self, context, layout.dies[0], name)
        return {"FINISHED"}

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

    def _read(self, context: bpy.types.Context, chip: Path) -> Subject:
        from icwafer.errors import IcwaferError
        from icwafer.portrait.apart import Wish, subject_apart

        others = [path for path in self._selected() if path != chip]
        maps = [path for path in others if path.suffix.lower() == ".toml"]
        wish = Wish(
            path=str(chip),
            layers=str(maps[0]) if maps else self._layers(),
            lef=tuple(str(path) for path in others if path.suffix.lower() == ".lef"),
            top=self.top or None,
            wafer=self.kind == "WAFER",
            tile_um=self.tile_um or None,
            window_um=self.window_um or None,
        )
        try:
            with progress(context) as tell:
                return subject_apart(wish, tell)
        except IcwaferError as error:
            text = str(error)
            for option, here in _NAMES.items():
                text = text.replace(option, here)
            raise IcwaferError(text) from None

    def _layers(self) -> str:
        from icwafer.errors import IcwaferError

        if self.process != "OWN":
            return self.process
        if not self.layer_map:
            raise IcwaferError("The process is a layer map: select it with the chip's file")
        return bpy.path.abspath(self.layer_map)

    def draw(self, _context: bpy.types.Context) -> None:
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        layout.prop(self, "kind", expand=True)
        layout.prop(self, "process")
        if self.process == "OWN":
            layout.prop(self, "layer_map")
        layout.prop(self, "top")
        column = layout.column(align=True)
        column.prop(self, "tile_um")
        column.prop(self, "window_um")
        if self.kind == "WAFER":
            self.draw_wafer(layout)
        self.draw_place(layout)
