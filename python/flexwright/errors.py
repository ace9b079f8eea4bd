# SPDX-License-Identifier: GPL-3.0-or-later
"""What went wrong, with every diagnostic: file, line, column, number."""
from __future__ import annotations

import dataclasses
import enum
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
    """A file could not be read or written. `filename` is that of the first error; `errno` and `strerror` are the system's where
    Python asked it, and None where the library did: its message says why."""

    status = 4

    def __init__(self, what: str, diagnostics: Sequence[Diagnostic] = (), errno: Optional[int] = None,
                 strerror: Optional[str] = None) -> None:
        super().__init__(what, diagnostics)
        self.errno, self.strerror, self.filename = errno, strerror, self.file

    def __reduce__(self):
        return type(self), (self.what, self.diagnostics, self.errno, self.strerror)


class MissingFileError(FileError, FileNotFoundError):
    """There is no file of that name."""


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
