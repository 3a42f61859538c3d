# SPDX-License-Identifier: GPL-2.0-or-later
"""Silicon wafers in Blender: builds the node, makes dies and renders them."""
