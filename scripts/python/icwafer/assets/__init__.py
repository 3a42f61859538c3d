# SPDX-License-Identifier: GPL-2.0-or-later
"""The asset library: its sources (blend_assets/library), and how it is built from them."""
