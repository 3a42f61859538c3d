# SPDX-License-Identifier: GPL-2.0-or-later
"""The errors that a user sees."""


class IcwaferError(Exception):
    """One line: what is wrong, and what to do about it. The command prints it and exits with
    `status`."""

    status = 1


class InputError(IcwaferError):
    """What was given cannot be used; for commands whose status 1 is an answer, as `compare`."""

    status = 2


class SettingError(IcwaferError):
    """A setting of a scene that is unknown or not allowed; the text follows the setting's name.

    setting: its name, where the one who catches this cannot know it.
    """

    def __init__(self, message: str, setting: str = "") -> None:
        super().__init__(message)
        self.setting = setting


class DiskFull(IcwaferError):
    """There is no room for a file, or no permission to make it larger."""
