# SPDX-License-Identifier: GPL-2.0-or-later
"""The errors that a user sees."""


class IcwaferError(Exception):
    """One line: what is wrong, and what to do about it. The command prints it and exits with
    `status`."""

    status = 1


class InputError(IcwaferError):
    """What was given cannot be used; for commands whose status 1 is an answer, as `compare`."""

    status = 2
