# SPDX-License-Identifier: GPL-2.0-or-later
"""The error that a user sees."""


class IcwaferError(Exception):
    """One line: what is wrong, and what to do about it. The command prints it and exits with 1."""
