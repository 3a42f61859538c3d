# SPDX-License-Identifier: GPL-2.0-or-later
"""Everything that imports bpy: scenes, meshes, materials and renders. Runs inside Blender only."""
