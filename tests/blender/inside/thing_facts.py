# SPDX-License-Identifier: GPL-2.0-or-later
"""What an object made by the add-on is, as far as a test wants to know."""

from __future__ import annotations

import bpy
import numpy as np


def values_of(attribute: bpy.types.Attribute) -> list[float | list[float]]:
    """The least and the greatest value, and their sum; of a vector those of each component."""
    vector = attribute.data_type == "FLOAT_VECTOR"
    values = np.empty((len(attribute.data), 3) if vector else len(attribute.data), np.float32)
    attribute.data.foreach_get("vector" if vector else "value", values.ravel())
    return [values.min(0).tolist(), values.max(0).tolist(), values.sum(0, np.float64).tolist()]


def instances_of(thing: bpy.types.Object) -> int:
    """How many instances an object has after its modifiers, of what renders show."""
    depsgraph = bpy.context.evaluated_depsgraph_get()
    return sum(
        instance.is_instance
        and instance.parent.original == thing
        and not instance.object.hide_render
        for instance in depsgraph.object_instances
    )


def drawn_faces_of(thing: bpy.types.Object) -> int:
    """How many faces of its instances a viewport draws that does not render with Cycles."""
    depsgraph = bpy.context.evaluated_depsgraph_get()
    return sum(
        len(instance.object.data.polygons)
        for instance in depsgraph.object_instances
        if instance.is_instance
        and instance.parent.original == thing
        and instance.object.display_type != "BOUNDS"
    )


def thing_facts(thing: bpy.types.Object) -> dict[str, object]:
    """What an object is: place, size, faces, materials and attributes."""
    mode = thing.mode
    bpy.ops.object.mode_set(mode="OBJECT")  # else its mesh is not up to date
    return {
        "name": thing.name,
        "mode": mode,
        "selected": [other.name for other in bpy.context.view_layer.objects.selected],
        "location": list(thing.location),
        "rotation": list(thing.rotation_euler),
        "scale": list(thing.scale),
        "dimensions": list(thing.dimensions),
        "faces": len(thing.data.polygons),
        "materials": [slot.material.name for slot in thing.material_slots],
        "instances": instances_of(thing),
        "drawn faces": drawn_faces_of(thing),
        "attributes": {
            attribute.name: values_of(attribute)
            for attribute in thing.data.attributes
            if attribute.name.startswith("ic_") and attribute.data_type.startswith("FLOAT")
        },
    }
