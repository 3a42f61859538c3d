# SPDX-License-Identifier: GPL-2.0-or-later
"""The asset library's files: what is in each one, its previews, and how it is written."""
