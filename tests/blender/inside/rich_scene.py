# SPDX-License-Identifier: GPL-2.0-or-later
"""A scene that uses much of Cycles: what the node's edits might break without being noticed."""

from __future__ import annotations

import math

import bpy


def build_rich_scene() -> None:
    """Replace the scene by one with many kinds of surface, hair, volume, light and geometry."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    _add_camera()
    _add_lights()
    _add_ground()
    _add_bumpy_head()
    _add_ball(_glass(), (-1.6, -0.9, 0.5))
    _add_ball(_principled("Skin", subsurface=0.3, base_colour=(0.8, 0.45, 0.3)), (1.7, -1.0, 0.5))
    _add_ball(_velvet_and_toon(), (0.1, -1.8, 0.35), radius=0.35)
    _add_hairy_ball()
    _add_smoke()
    _add_curve()


def _add_camera() -> None:
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    camera.location = (0.0, -7.5, 3.2)
    camera.rotation_euler = (math.radians(70.0), 0.0, 0.0)
    camera.data.dof.use_dof = True
    camera.data.dof.focus_distance = 7.0
    camera.data.dof.aperture_fstop = 1.2
    bpy.context.collection.objects.link(camera)
    bpy.context.scene.camera = camera


def _add_lights() -> None:
    bpy.ops.object.light_add(type="AREA", location=(-3.0, -2.0, 4.0), rotation=(0.4, -0.6, 0.0))
    bpy.context.object.data.energy = 120.0
    bpy.context.object.data.size = 1.5
    bpy.ops.object.light_add(type="SUN", rotation=(0.9, 0.5, 0.2))
    bpy.context.object.data.energy = 0.7
    bpy.ops.object.light_add(type="SPOT", location=(3.0, -3.0, 4.0), rotation=(0.7, 0.5, 0.3))
    bpy.context.object.data.energy = 250.0
    bpy.context.object.data.color = (1.0, 0.7, 0.4)

    world = bpy.data.worlds.new("Sky")
    world.use_nodes = True
    bpy.context.scene.world = world
    sky = world.node_tree.nodes.new("ShaderNodeTexSky")
    sky.sky_type = "NISHITA"
    sky.sun_elevation = math.radians(25.0)
    background = world.node_tree.nodes["Background"]
    background.inputs["Strength"].default_value = 0.03
    world.node_tree.links.new(sky.outputs["Color"], background.inputs["Color"])


def _material(name: str) -> tuple[bpy.types.Material, bpy.types.NodeTree]:
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    return material, material.node_tree


def _principled(
    name: str,
    *,
    base_colour: tuple[float, float, float],
    subsurface: float = 0.0,
    metallic: float = 0.0,
    bump: bool = False,
) -> bpy.types.Material:
    material, tree = _material(name)
    shader = tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (*base_colour, 1.0)
    shader.inputs["Subsurface"].default_value = subsurface
    shader.inputs["Metallic"].default_value = metallic
    shader.inputs["Roughness"].default_value = 0.35
    shader.inputs["Clearcoat"].default_value = 0.5
    shader.inputs["Sheen"].default_value = 0.3
    shader.inputs["Anisotropic"].default_value = 0.6
    if bump:
        noise = tree.nodes.new("ShaderNodeTexNoise")
        noise.inputs["Scale"].default_value = 9.0
        node = tree.nodes.new("ShaderNodeBump")
        node.inputs["Strength"].default_value = 0.6
        tree.links.new(noise.outputs["Fac"], node.inputs["Height"])
        tree.links.new(node.outputs["Normal"], shader.inputs["Normal"])
    return material


def _surface(name: str, *shader_types: str) -> bpy.types.Material:
    """A material that is the sum of closures, one per node type."""
    material, tree = _material(name)
    tree.nodes.remove(tree.nodes["Principled BSDF"])
    total = tree.nodes.new(shader_types[0]).outputs[0]
    for shader_type in shader_types[1:]:
        add = tree.nodes.new("ShaderNodeAddShader")
        tree.links.new(total, add.inputs[0])
        tree.links.new(tree.nodes.new(shader_type).outputs[0], add.inputs[1])
        total = add.outputs[0]
    tree.links.new(total, tree.nodes["Material Output"].inputs["Surface"])
    return material


def _glass() -> bpy.types.Material:
    return _surface("Glass", "ShaderNodeBsdfGlass")


def _velvet_and_toon() -> bpy.types.Material:
    return _surface(
        "Velvet and toon",
        "ShaderNodeBsdfVelvet",
        "ShaderNodeBsdfToon",
        "ShaderNodeBsdfAnisotropic",
        "ShaderNodeBsdfTranslucent",
    )


def _subdivide(thing: bpy.types.Object, levels: int) -> None:
    subdivision = thing.modifiers.new("Subdivision", "SUBSURF")
    subdivision.levels = subdivision.render_levels = levels


def _add_ball(
    material: bpy.types.Material, location: tuple[float, float, float], radius: float = 0.5
) -> None:
    # Fewer faces than Blender gives to one thread (1024): with more it adds up the normals of
    # neighbours in another order each time, and the last bits of smooth shading change with it.
    bpy.ops.mesh.primitive_cube_add(size=2.4 * radius, location=location)
    for polygon in bpy.context.object.data.polygons:
        polygon.use_smooth = True
    _subdivide(bpy.context.object, 3)
    bpy.context.object.data.materials.append(material)


def _add_ground() -> None:
    bpy.ops.mesh.primitive_plane_add(size=12.0)
    material = _principled("Ground", base_colour=(0.4, 0.4, 0.45))
    tree = material.node_tree
    checker = tree.nodes.new("ShaderNodeTexChecker")
    checker.inputs["Scale"].default_value = 12.0
    tree.links.new(checker.outputs["Color"], tree.nodes["Principled BSDF"].inputs["Base Color"])
    bpy.context.object.data.materials.append(material)


def _add_bumpy_head() -> None:
    bpy.ops.mesh.primitive_monkey_add(size=1.6, location=(0.0, 0.2, 0.9))
    head = bpy.context.object
    _subdivide(head, 1)
    head.data.materials.append(
        _principled("Head", base_colour=(0.7, 0.5, 0.15), metallic=0.8, bump=True)
    )


def _add_hairy_ball() -> None:
    _add_ball(_principled("Under the hair", base_colour=(0.2, 0.1, 0.05)), (2.3, 0.9, 0.6))
    # Not particle hair: that grows in different places each time Blender starts.
    bpy.ops.object.curves_random_add(location=(2.3, 0.9, 0.6))
    bpy.context.object.scale = (0.55, 0.55, 0.55)
    bpy.context.object.data.materials.append(_surface("Hair", "ShaderNodeBsdfHairPrincipled"))


def _add_smoke() -> None:
    bpy.ops.mesh.primitive_cube_add(size=1.4, location=(-2.2, 1.0, 0.75))
    material, tree = _material("Smoke")
    tree.nodes.remove(tree.nodes["Principled BSDF"])
    volume = tree.nodes.new("ShaderNodeVolumePrincipled")
    volume.inputs["Density"].default_value = 1.5
    volume.inputs["Color"].default_value = (0.5, 0.7, 0.9, 1.0)
    tree.links.new(volume.outputs["Volume"], tree.nodes["Material Output"].inputs["Volume"])
    bpy.context.object.data.materials.append(material)


def _add_curve() -> None:
    bpy.ops.curve.primitive_bezier_circle_add(radius=2.6, location=(0.0, 0.0, 0.1))
    curve = bpy.context.object
    curve.data.bevel_depth = 0.07
    curve.data.materials.append(_principled("Ring", base_colour=(0.9, 0.9, 0.9), metallic=1.0))
