# SPDX-License-Identifier: GPL-3.0-or-later
"""What went wrong, with every diagnostic: file, line, column, number."""
from __future__ import annotations

import dataclasses
import enum
import errno
import os
from typing import Optional, Sequence, Tuple


class Severity(enum.IntEnum):
    """How serious a diagnostic is."""

    NOTE = 0
    WARNING = 1
    ERROR = 2


@dataclasses.dataclass(frozen=True)
class Diagnostic:
    """One message about a description or a result."""

    number: int  #: 41 of FW-D041; `flexwright explain FW-D041` has the long text
    severity: Severity
    file: Optional[str]  #: None: it is not about a file
    line: int  #: from 1; 0: the file as a whole
    column: int  #: in bytes, from 1; 0: the line as a whole
    message: str  #: what is wrong, the limit and its source, what to do
    #: errno of the system where it refused a file (errno.ENOENT: there is none of that name); 0: it did not
    system_error: int = 0

    @property
    def code(self) -> str:
        """ "FW-D041"."""
        return f"FW-D{self.number:03d}"

    def __str__(self) -> str:
        place = ""
        if self.file:
            place = ":".join(str(part) for part in (self.file, self.line, self.column) if part) + ": "
        return f"{place}{self.severity.name.lower()}: {self.message} [{self.code}]"


class FlexwrightError(Exception):
    """Something that was asked for has no result. A rejected design is a result, and no error.

    `diagnostics` has what the call that failed said, notes and warnings too; `file`, `line`, `column`,
    `number` and `code` are those of the first error among them (None, 0, 0, 0, None without one).
    """

    status: int = 0

    def __init__(self, what: str, diagnostics: Sequence[Diagnostic] = ()) -> None:
        self.what = what
        self.diagnostics: Tuple[Diagnostic, ...] = tuple(diagnostics)
        super().__init__(what)

    def __reduce__(self):  # so that it passes between processes
        return type(self), (self.what, self.diagnostics)

    @property
    def errors(self) -> Tuple[Diagnostic, ...]:
        """The diagnostics that are errors."""
        return tuple(d for d in self.diagnostics if d.severity is Severity.ERROR)

    @property
    def first(self) -> Optional[Diagnostic]:
        """The first error, or None."""
        return next(iter(self.errors), None)

    @property
    def file(self) -> Optional[str]:
        """Of the first error."""
        return self.first.file if self.first else None

    @property
    def line(self) -> int:
        """Of the first error, from 1."""
        return self.first.line if self.first else 0

    @property
    def column(self) -> int:
        """Of the first error, in bytes, from 1."""
        return self.first.column if self.first else 0

    @property
    def number(self) -> int:
        """Of the first error: 41 of FW-D041."""
        return self.first.number if self.first else 0

    @property
    def code(self) -> Optional[str]:
        """Of the first error: "FW-D041"."""
        return self.first.code if self.first else None

    def __str__(self) -> str:
        return "\n".join(str(d) for d in self.errors) or self.what

    def __repr__(self) -> str:
        more = len(self.errors) - 1
        said = str(self.first or self.what) + (f"; and {more} more" if more > 0 else "")
        return f"{type(self).__name__}({said!r})"


class UsageError(FlexwrightError, ValueError):
    """A wrong option or argument."""

    status = 1


class InputError(FlexwrightError, ValueError):
    """The description or a pack is invalid."""

    status = 2


class GeometryError(FlexwrightError, ValueError):
    """Impossible geometry."""

    status = 3


class FileError(FlexwrightError, OSError):
    """A file could not be read or written. `filename`, `errno` and `strerror` are those of the first error, as of any OSError; where
    the system had nothing against it (a directory holds something else), `errno` and `strerror` are None: the message says why."""

    status = 4

    def __init__(self, what: str, diagnostics: Sequence[Diagnostic] = ()) -> None:
        super().__init__(what, diagnostics)
        reason = self.first.system_error if self.first else 0
        self.errno: Optional[int] = reason or None
        self.strerror: Optional[str] = os.strerror(reason) if reason else None
        self.filename = self.file


class MissingFileError(FileError, FileNotFoundError):
    """There is no file or directory of that name."""


class MemoryLimitError(FlexwrightError, MemoryError):
    """Over the design's memory_cap (FW-D720), or out of memory (FW-D721)."""

    status = 5


class LimitError(FlexwrightError):
    """Another limit was reached."""

    status = 6


class SolverError(FlexwrightError, ArithmeticError):
    """There is no numerical solution."""

    status = 7


class Cancelled(FlexwrightError):
    """The design was cancelled while it was at work."""

    status = 8


class InternalError(FlexwrightError, RuntimeError):
    """A fault of the library; please report it."""

    status = 9


BY_STATUS = {kind.status: kind for kind in (UsageError, InputError, GeometryError, FileError,
                                            MemoryLimitError, LimitError, SolverError, Cancelled,
                                            InternalError)}


def error_of(status: int, what: str, diagnostics: Sequence[Diagnostic]) -> FlexwrightError:
    """The error of a status of the library: of a file that is not there MissingFileError, whoever looked for it."""
    kind = BY_STATUS.get(status, FlexwrightError)
    missing = kind is FileError and next((d.system_error for d in diagnostics if d.severity is Severity.ERROR), 0) == errno.ENOENT
    return (MissingFileError if missing else kind)(what, diagnostics)
