/* SPDX-License-Identifier: Apache-2.0 */

/* The float inputs of the IC Wafer BSDF node, in their order, between `Color` and `Metal n`,
 * `Metal k`, `Normal`, `Tangent`. This table is the one source of the sockets in Blender and
 * Cycles, of the tooltips and of the manual page.
 *
 *   X(identifier, "Name", default, minimum, maximum, KIND, MODEL, "Tooltip")
 *
 * Minimum and maximum are what the socket can be dragged to. KIND: NONE, FACTOR, ANGLE (radian,
 * shown in degrees). MODEL: the one that has the input, PHYSICAL or CS348B, or BOTH. */

#pragma once

// clang-format off
#define ICWAFER_NODE_FLOATS(X) \
  X(wire_spacing, "Wire Spacing", 1000.0f, 50.0f, 200000.0f, NONE, BOTH, \
    "Distance from one wire to the next, in nanometres. Chips: 300 to 4000; an optical disc: " \
    "1600 (CD), 740 (DVD). Smaller spacing spreads the colours further apart. Below 2000 the " \
    "strength of the colours is approximate, their places are exact") \
  X(wire_width, "Wire Width", 250.0f, 0.0f, 100000.0f, NONE, BOTH, \
    "Width of one wire, in nanometres, at most the spacing. Half the spacing removes the second " \
    "colour band, a third removes the third; thin wires show all bands alike") \
  X(oxide_thickness, "Oxide Thickness", 530.0f, 0.0f, 5000.0f, NONE, BOTH, \
    "Thickness of the transparent oxide over the wires, in nanometres. Chips: 300 to 1000. Tints " \
    "the whole surface as a soap film does, and changes the tint with the angle of view") \
  X(oxide_ior, "Oxide IOR", 1.544f, 1.0f, 3.0f, NONE, BOTH, \
    "Index of refraction of the oxide, without unit. Silicon dioxide: 1.46, quartz: 1.544, " \
    "silicon nitride: 2.0. Multiplies the thickness") \
  X(direction, "Direction", 0.0f, -3.14159265f, 3.14159265f, ANGLE, BOTH, \
    "Angle from the tangent to the wires, counter-clockwise as seen from outside. Colours spread " \
    "across the wires: at 0 along the object's Y axis, at 90 degrees along X") \
  X(diffraction, "Diffraction", 0.5f, 0.0f, 1.0f, FACTOR, CS348B, \
    "Strength of the diffracted light, 0 to 1. Chips: 0.3 to 0.7. Brightness of the colours") \
  X(specular, "Specular", 0.3f, 0.0f, 1.0f, FACTOR, CS348B, \
    "Strength of the uncoloured mirror reflection, 0 to 1. Chips: 0.3. Brightness of the " \
    "reflected room and lamps") \
  X(specular_roughness, "Specular Roughness", 0.1f, 0.0f, 1.0f, FACTOR, CS348B, \
    "Roughness of the mirror reflection, 0 to 1, as in Glossy BSDF. Polished wafers: 0 to 0.1. " \
    "Blurs the reflected room") \
  X(diffuse, "Diffuse", 0.0f, 0.0f, 1.0f, FACTOR, CS348B, \
    "Strength of even, matt reflection, 0 to 1. Chips: 0. Lifts the black between the colours") \
  X(lobe_width, "Lobe Width", 0.015f, 0.0005f, 0.2f, NONE, CS348B, \
    "Standard deviation of a colour band in the sine of the angle, without unit. 0.002: sharp " \
    "spectrum, 0.015: soft, 0.1: pastel. Wider bands overlap and mix to softer colours; their " \
    "energy stays the same") \
  X(anisotropy, "Anisotropy", 0.0f, 0.0f, 8.0f, NONE, CS348B, \
    "Exponent of the component of the light's deflection along the wires, without unit. 0: off; " \
    "1 to 4 darken the colours where lamp, surface and eye lie in a plane across the wires") \
  X(groove_depth, "Groove Depth", 300.0f, 0.0f, 2000.0f, NONE, PHYSICAL, \
    "How much deeper the metal between the wires lies, in nanometres. Chips: 100 to 1200. Shifts " \
    "light between the mirror reflection and the colours, each wavelength in its own way") \
  X(cross_spacing, "Cross Spacing", 0.0f, 0.0f, 200000.0f, NONE, PHYSICAL, \
    "Distance between the wires of a second layer at 90 degrees to the first, in nanometres; 0: " \
    "no second layer. Power mesh: 5000 to 100000. Adds colours along the other axis and a lattice " \
    "of them between") \
  X(cross_width, "Cross Width", 250.0f, 0.0f, 100000.0f, NONE, PHYSICAL, \
    "Width of a wire of the second layer, in nanometres, at most the cross spacing. Wider: more " \
    "light along the other axis") \
  X(spacing_variation, "Spacing Variation", 0.0f, 0.0f, 0.3f, NONE, PHYSICAL, \
    "Relative standard deviation of the spacing, without unit: blocks of wires smaller than a " \
    "pixel. 0.05 for a group of blocks of 1000 nm +- 50 nm. Blurs the colours as distance does, " \
    "outer ones more") \
  X(coherence_width, "Coherence Width", 10.0f, 1.0f, 200.0f, NONE, PHYSICAL, \
    "Width across the wires of the patch that interferes, in micrometres: spacing times the " \
    "number of wires in it. 3: pastel, 10: soft, 100: a sharp spectrum") \
  X(wire_length, "Wire Length", 2.0f, 0.5f, 200.0f, NONE, PHYSICAL, \
    "Length over which wires run on undisturbed, in micrometres. Logic: 1 to 10, memory: 20 to " \
    "50, power mesh and optical disc: 200. Short wires spread the colours along themselves") \
  X(roughness, "Roughness", 0.05f, 0.0f, 0.6f, FACTOR, PHYSICAL, \
    "Roughness of the surface, 0 to 0.6, as in Glossy BSDF. Polished wafers: 0 to 0.1. Blurs " \
    "mirror reflection and colours alike")
// clang-format on
