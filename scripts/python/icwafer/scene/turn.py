# SPDX-License-Identifier: GPL-2.0-or-later
"""How to turn a chip so that the colours of a lamp reach the camera.

Long wires send light only into the plane across them: with q the sum of the unit vectors to the
lamp and to the eye, all orders of a grating are where q has no part along the wires.
"""

from __future__ import annotations

import math

import bpy
from mathutils import Euler, Vector


def turn_to_light_rad(scene: bpy.types.Scene, place: bpy.types.Object, wires_rad: float) -> float:
    """Angle about an object's own Z, in (-pi/2, pi/2], that brings its wires across the light.

    wires_rad: direction of the wires in the object, counter-clockwise from its X. The lamp is the
    one that is brightest there. 0 without a lamp or a camera, or where neither way is better.
    """
    lamps = [thing for thing in scene.objects if thing.type == "LIGHT" and not thing.hide_render]
    if not lamps or scene.camera is None:
        return 0.0
    lamp = max(lamps, key=lambda thing: _strength(thing, place.location))
    to_eye = scene.camera.matrix_world.translation - place.location
    q = _towards(lamp, place.location) + to_eye.normalized()
    q.rotate(Euler(place.rotation_euler).to_quaternion().inverted())
    if q.xy.length < 1e-3:
        return 0.0
    turn = math.atan2(q.y, q.x) + math.pi / 2 - wires_rad
    return math.pi / 2 - (math.pi / 2 - turn) % math.pi


def _towards(lamp: bpy.types.Object, place: Vector) -> Vector:
    """Unit vector from a place to a lamp."""
    if lamp.data.type == "SUN":
        return lamp.matrix_world.to_quaternion() @ Vector((0.0, 0.0, 1.0))
    return (lamp.matrix_world.translation - place).normalized()


def _strength(lamp: bpy.types.Object, place: Vector) -> float:
    """How bright a lamp makes a place, up to a factor of the same order for all kinds."""
    if lamp.data.type == "SUN":
        return lamp.data.energy
    distance = (lamp.matrix_world.translation - place).length
    return lamp.data.energy / max(4 * math.pi * distance**2, 1e-12)
