# SPDX-License-Identifier: GPL-2.0-or-later
"""Report all that Blender's Python API shows, one line each, and with which parts it is built."""

from __future__ import annotations

from collections.abc import Iterator

import bpy
import rna_manual_reference
from exchange import report


def describe_property(path: str, prop: bpy.types.Property) -> str:
    """One line with a property's type, limits, choices and words."""
    words = [path, prop.type, prop.subtype, prop.name, prop.description]
    if prop.type in {"INT", "FLOAT"}:
        words += [prop.hard_min, prop.hard_max, prop.soft_min, prop.soft_max, prop.array_length]
    if prop.type == "ENUM":
        words += [f"{i.identifier}={i.value}" for i in prop.enum_items]
    if prop.type == "POINTER" and prop.fixed_type:
        words.append(prop.fixed_type.identifier)
    return " ".join(map(str, words))


def describe_struct(struct: bpy.types.Struct) -> Iterator[str]:
    """Lines for a class, its properties and its functions with their parameters."""
    yield f"{struct.identifier} ({struct.name}): {struct.description}"
    for prop in struct.properties:
        yield describe_property(f"{struct.identifier}.{prop.identifier}", prop)
    for function in struct.functions:
        path = f"{struct.identifier}.{function.identifier}"
        yield f"{path}(): {function.description}"
        for prop in function.parameters:
            yield describe_property(f"{path}({prop.identifier})", prop)


def all_structs() -> Iterator[bpy.types.Struct]:
    """Every class that is registered, operators included."""
    for name in dir(bpy.types):
        struct = getattr(getattr(bpy.types, name), "bl_rna", None)
        if struct:
            yield struct
    for module in dir(bpy.ops):
        for operator in dir(getattr(bpy.ops, module)):
            yield getattr(getattr(bpy.ops, module), operator).get_rna_type()


options = bpy.app.build_options
report(
    {
        "api": sorted({line for struct in all_structs() for line in describe_struct(struct)}),
        "manual": [f"{path} -> {page}" for path, page in rna_manual_reference.url_manual_mapping],
        "parts": {
            n: getattr(options, n) for n in dir(options) if type(getattr(options, n)) is bool
        },
    }
)
