# SPDX-License-Identifier: MIT
"""Exceptions of the module. All are sigs.Error; str() of one is the engine's own line of text."""

from __future__ import annotations


class Error(Exception):
    """A mistake in what comes from outside: files, settings, the machine.

    where  the file and the place in it, or the setting; may be empty
    what   what is wrong and, where possible, what to do about it
    kind   "usage", "bad_data", "cannot_read", "unavailable", "cannot_create", "write_failed", "bad_project" or
           "interrupted": as the exit status of the program `sigs`
    """

    def __init__(self, where: str, what: str, kind: str) -> None:
        super().__init__(where, what, kind)
        self.where = where
        self.what = what
        self.kind = kind

    def __str__(self) -> str:
        return f"{self.where}: {self.what}" if self.where else self.what


class UsageError(Error):
    """A call that makes no sense: no such field, frame or intruder, or a number that is out of range."""


class BadData(Error):
    """An input could be read but is not what it should be."""


class CannotRead(Error):
    """An input is missing or cannot be opened."""


class Unavailable(Error):
    """The machine has no OpenGL, no such encoder, or no more memory or threads."""


class CannotCreate(Error):
    """An output cannot be created, or is there already."""


class WriteFailed(Error):
    """An output could not be written to its end."""


class BadProject(Error):
    """A project file, or one of its fields, is wrong."""


class Interrupted(Error):
    """The work was stopped."""


class ProjectWarning(UserWarning):
    """Something that the user of a project should know but that stops nothing; given by Python's warnings."""


_CLASSES: dict[str, type[Error]] = {
    "usage": UsageError,
    "bad_data": BadData,
    "cannot_read": CannotRead,
    "unavailable": Unavailable,
    "cannot_create": CannotCreate,
    "write_failed": WriteFailed,
    "bad_project": BadProject,
    "interrupted": Interrupted,
}


def error_of(where: str, what: str, kind: str) -> Error:
    """The exception of the class that belongs to the kind."""
    return _CLASSES.get(kind, Error)(where, what, kind)
