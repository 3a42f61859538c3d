# SPDX-License-Identifier: GPL-2.0-or-later
"""Compares images: with each other, with their own noise, and with a photograph."""
