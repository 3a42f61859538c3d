# SPDX-License-Identifier: GPL-2.0-or-later
"""Chips and wafers as data: layouts are made here, read, written and drawn, without Blender."""
