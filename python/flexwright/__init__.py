# SPDX-License-Identifier: GPL-3.0-or-later
"""Flexwright: planar compliant micromanipulators, from one description to verdict, masks, recipes.

    import flexwright

    d = flexwright.Device("stage.xml", arc="230 deg")
    v = d.check()
    print(v.decision, v.utilisation["A"].band)
    m = d.simulate("step")
    m.t, m.q["CD"], m.angle["A"]

All numbers are SI. Arrays are views of the library's memory, which they keep alive.
"""
from ._design import Array, Progress, library_version
from .device import Device, show_progress
from .errors import (Cancelled, Diagnostic, FileError, FlexwrightError, GeometryError, InputError,
                     InternalError, LimitError, MemoryLimitError, MissingFileError, Severity, SolverError,
                     UsageError)
from .results import (Assembly, Fabrication, LoadPath, Modes, Motion, Statics, Tradeoff, Utilisation,
                      Verdict, Workspace)
from .study import columns, grid, run_study, sweep, verdict_of
from .tables import Named, Row, Table, truth

__version__ = library_version()

__all__ = [
    "Array", "Assembly", "Cancelled", "Device", "Diagnostic", "Fabrication", "FileError",
    "FlexwrightError", "GeometryError", "InputError", "InternalError", "LimitError", "LoadPath",
    "MemoryLimitError", "MissingFileError", "Modes", "Motion", "Named", "Progress", "Row",
    "Severity", "SolverError", "Statics", "Table", "Tradeoff", "UsageError", "Utilisation",
    "Verdict", "Workspace", "columns", "grid", "library_version", "run_study", "show_progress",
    "sweep", "truth", "verdict_of",
]
