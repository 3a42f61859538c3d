# SPDX-License-Identifier: GPL-2.0-or-later
"""Renders the pictures of the manual page, inside a Blender with the node:

scripts/icwafer blender -b --factory-startup -P plugin/manual/render_pictures.py

After `--`, names of inputs: only their pictures. Each file notes what it shows, for the test that
tells whether it is up to date.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

import bpy  # noqa: E402
import numpy as np  # noqa: E402
import OpenImageIO as oiio  # noqa: E402
from mathutils import Vector  # noqa: E402
from sweeps import PICTURES, SWEEPS, Panel, Sweep  # noqa: E402

SIZE_PX, SAMPLES = 200, 32
RADIUS, HALF_ANGLE_DEG = 10.0, 36.0


def scene_with_watch_glass() -> tuple[bpy.types.Scene, bpy.types.Node]:
    """The scene and its IC Wafer BSDF."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.samples = SAMPLES
    scene.cycles.use_adaptive_sampling = scene.cycles.use_denoising = False
    scene.cycles.max_bounces = 1
    scene.render.resolution_x = scene.render.resolution_y = SIZE_PX
    scene.render.dither_intensity = 0.0
    scene.view_settings.view_transform = "Filmic"
    scene.view_settings.look = "Medium High Contrast"

    glass = bpy.data.objects.new("Watch glass", cap())
    scene.collection.objects.link(glass)
    lamp = bpy.data.lights.new("Lamp", "POINT")
    lamp.energy, lamp.shadow_soft_size = 40_000, 0.8
    place(scene, lamp, (5.0, 6.0, 60.0))
    scene.camera = place(scene, bpy.data.cameras.new("Camera"), (0.0, -14.0, 60.0))
    scene.camera.data.type = "ORTHO"
    scene.camera.data.ortho_scale = 12.4
    scene.world = bpy.data.worlds.new("Room")
    scene.world.use_nodes = True
    background = scene.world.node_tree.nodes["Background"]
    background.inputs["Color"].default_value = (0.22, 0.22, 0.22, 1.0)
    hide_from_camera(scene.world.node_tree, background)

    material = bpy.data.materials.new("Wafer")
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    node = tree.nodes.new("ShaderNodeBsdfICWafer")
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(node.outputs["BSDF"], output.inputs["Surface"])
    glass.data.materials.append(material)
    return scene, node


def cap() -> bpy.types.Mesh:
    """Part of a sphere about the z axis, its rim in the plane z = 0."""
    rings, sectors = 96, 192
    tilt = np.radians(HALF_ANGLE_DEG) * np.arange(1, rings + 1)[:, None] / rings
    turn = 2 * np.pi * np.arange(sectors) / sectors
    grid = np.stack(
        [np.sin(tilt) * np.cos(turn), np.sin(tilt) * np.sin(turn), np.cos(tilt) + 0 * turn],
        axis=-1,
    ).reshape(-1, 3)
    vertices = RADIUS * np.concatenate([[[0, 0, 1]], grid])
    vertices[:, 2] -= RADIUS * np.cos(np.radians(HALF_ANGLE_DEG))
    ring = np.arange(sectors)
    after = (ring + 1) % sectors
    faces = [(0, 1 + a, 1 + b) for a, b in zip(ring, after)]
    for inner in range(rings - 1):
        low, high = 1 + inner * sectors, 1 + (inner + 1) * sectors
        faces += [(low + a, high + a, high + b, low + b) for a, b in zip(ring, after)]
    mesh = bpy.data.meshes.new("Watch glass")
    mesh.from_pydata(vertices.tolist(), [], [tuple(map(int, face)) for face in faces])
    mesh.polygons.foreach_set("use_smooth", np.ones(len(faces), dtype=bool))
    return mesh


def place(
    scene: bpy.types.Scene, data: bpy.types.ID, where: tuple[float, float, float]
) -> bpy.types.Object:
    """A lamp or camera at a place, looking at the watch glass."""
    thing = bpy.data.objects.new(data.name, data)
    thing.location = where
    thing.rotation_euler = (-Vector(where)).to_track_quat("-Z", "Y").to_euler()
    scene.collection.objects.link(thing)
    return thing


def hide_from_camera(tree: bpy.types.NodeTree, background: bpy.types.Node) -> None:
    """The room lights the glass, but what is behind it stays black."""
    path, dark = tree.nodes.new("ShaderNodeLightPath"), tree.nodes.new("ShaderNodeMixShader")
    black = tree.nodes.new("ShaderNodeBackground")
    black.inputs["Color"].default_value = (0.0, 0.0, 0.0, 1.0)
    tree.links.new(path.outputs["Is Camera Ray"], dark.inputs[0])
    tree.links.new(background.outputs[0], dark.inputs[1])
    tree.links.new(black.outputs[0], dark.inputs[2])
    tree.links.new(dark.outputs[0], tree.nodes["World Output"].inputs["Surface"])


class Wafer:
    """The node, set anew for each panel."""

    def __init__(self, node: bpy.types.Node) -> None:
        self.node, self.tree = node, node.id_data
        self.initial = {
            socket.name: tuple(socket.default_value) if hasattr(socket.default_value, "__len__")
            else socket.default_value
            for socket in node.inputs if socket.enabled or socket.name != "Weight"
        }  # fmt: skip
        self.menus = {
            name: getattr(node, name)
            for name in ("model", "metal", "oxide", "illuminant", "use_grating", "use_thin_film",
                         "use_wire_diffraction")
        }  # fmt: skip

    def show(self, sweep: Sweep, panel: Panel) -> None:
        for name, value in self.menus.items():
            setattr(self.node, name, value)
        for name, value in self.initial.items():
            self.node.inputs[name].default_value = value
        for name, value in {**sweep.base, **panel.values}.items():
            if name in self.menus:
                setattr(self.node, name, value)
            else:
                rgba = self.node.inputs[name].type == "RGBA"
                self.node.inputs[name].default_value = (*value, 1.0) if rgba else value
        for other in [n for n in self.tree.nodes if n.bl_idname in _DRIVERS]:
            self.tree.nodes.remove(other)
        if panel.bumps:
            self._bumps(panel.bumps)
        if panel.round:
            tangent = self.tree.nodes.new("ShaderNodeTangent")
            tangent.direction_type, tangent.axis = "RADIAL", "Z"
            self.tree.links.new(tangent.outputs["Tangent"], self.node.inputs["Tangent"])

    def _bumps(self, strength: float) -> None:
        noise, bump = (self.tree.nodes.new(kind) for kind in _DRIVERS[:2])
        coordinates = self.tree.nodes.new(_DRIVERS[2])
        noise.inputs["Scale"].default_value = 0.5
        bump.inputs["Strength"].default_value = strength
        self.tree.links.new(coordinates.outputs["Object"], noise.inputs["Vector"])
        self.tree.links.new(noise.outputs["Fac"], bump.inputs["Height"])
        self.tree.links.new(bump.outputs["Normal"], self.node.inputs["Normal"])


_DRIVERS = ("ShaderNodeTexNoise", "ShaderNodeBump", "ShaderNodeTexCoord", "ShaderNodeTangent")


def shown(scene: bpy.types.Scene, folder: Path) -> oiio.ImageBuf:
    """Renders, through the view transform."""
    bpy.ops.render.render()
    scene.render.image_settings.file_format = "PNG"
    scene.render.image_settings.color_mode = "RGB"
    path = folder / "panel.png"
    bpy.data.images["Render Result"].save_render(str(path), scene=scene)
    return oiio.ImageBuf(oiio.ImageBuf(str(path)).get_pixels(oiio.UINT8))


def main(names: list[str]) -> None:
    scene, node = scene_with_watch_glass()
    wafer = Wafer(node)
    PICTURES.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        for sweep in SWEEPS.values():
            for panel in sweep.panels if not names or sweep.name in names else ():
                wafer.show(sweep, panel)
                picture = shown(scene, Path(folder))
                picture.specmod()["Compression"] = "jpeg:85"
                picture.specmod()["ImageDescription"] = sweep.description(panel)
                if not picture.write(str(sweep.file(panel))):
                    raise SystemExit(f"{sweep.file(panel)}: {picture.geterror()}")


if __name__ == "__main__":
    main(sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else [])
