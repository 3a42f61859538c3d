# SPDX-License-Identifier: GPL-2.0-or-later
"""Portraits: from the file of a chip to a picture of it."""
