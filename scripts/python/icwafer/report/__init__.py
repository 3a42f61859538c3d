# SPDX-License-Identifier: GPL-2.0-or-later
"""A page on which the renders of a study are compared: one HTML file without a network."""
