# SPDX-License-Identifier: GPL-2.0-or-later
"""What the asset library consists of: one .blend file for each kind of asset."""

from __future__ import annotations

#: Each kind has a module of that name in icwafer.scene.library, and a file of that name.
KINDS = ("materials", "dies", "wafers", "lights", "studios")
