# SPDX-License-Identifier: GPL-3.0-or-later
"""libflexwright by ctypes: where it lies, its structs and its functions as in flexwright.h.

ctypes gives up the interpreter's lock during every call, so that designs in several threads really work
side by side.
"""
from __future__ import annotations

import ctypes
import ctypes.util
import os
import pathlib
from ctypes import (CFUNCTYPE, POINTER, Structure, c_char_p, c_double, c_int, c_int32, c_size_t,
                    c_uint, c_void_p)
from typing import Iterator

NAME = "libflexwright.so.0"


class OptionsStruct(Structure):
    """fw_design_options; fields are only ever added at the end."""

    _fields_ = [
        ("size", c_size_t), ("data_directory", c_char_p), ("flow", c_char_p), ("scene", c_char_p),
        ("accuracy", c_double), ("effects", c_char_p), ("method", c_char_p),
        ("integrator", c_char_p), ("rtol", c_double), ("samples", c_int32), ("force", c_int32),
        ("mask_tolerance_m", c_double), ("memory_cap", c_size_t), ("stabilise", c_char_p),
        ("at", c_char_p), ("path", c_int32), ("independent", c_char_p), ("rates", c_char_p),
        ("accelerations", c_char_p), ("corners", c_char_p), ("hinge_model", c_char_p),
        ("mask_formats", c_char_p), ("mask_vertices", c_int32), ("mask_flatten", c_char_p),
        ("wafers", c_int32), ("operators", c_int32), ("day", c_char_p),
        ("planning_times", c_char_p), ("laboratory", c_char_p), ("cut", c_char_p),
        ("advice", c_char_p), ("figures", c_int32), ("measurements", c_char_p),
        ("layers", c_char_p), ("directory", c_char_p), ("jobs", c_int32),
    ]


class StudySettingsStruct(Structure):
    """fw_study_settings; fields are only ever added at the end."""

    _fields_ = [("size", c_size_t), ("study", c_char_p), ("directory", c_char_p), ("jobs", c_int32),
                ("shard", c_int32), ("shards", c_int32), ("resume", c_int32)]


class DiagnosticStruct(Structure):
    """fw_diagnostic."""

    _fields_ = [("number", c_int32), ("severity", c_int32), ("file", c_char_p), ("line", c_int32),
                ("column", c_int32), ("message", c_char_p), ("system_error", c_int32)]


class ArrayStruct(Structure):
    """fw_array."""

    _fields_ = [("name", c_char_p), ("unit", c_char_p), ("about", c_char_p), ("type", c_int32),
                ("dimensions", c_int32), ("extent", c_size_t * 3), ("data", c_void_p),
                ("label", POINTER(c_char_p) * 3)]


#: told of progress: context, what, done, of, unit; an answer other than 0 cancels
TOLD = CFUNCTYPE(c_int, c_void_p, c_char_p, c_double, c_double, c_char_p)

_FUNCTIONS = {
    "fw_status_name": (c_char_p, [c_int]),
    "fw_library_version": (c_char_p, []),
    "fw_design_options_init": (None, [POINTER(OptionsStruct), c_size_t]),
    "fw_design_new": (c_void_p, [POINTER(OptionsStruct)]),
    "fw_design_free": (None, [c_void_p]),
    "fw_design_set": (c_int, [c_void_p, c_char_p, c_char_p]),
    "fw_design_read_memory": (c_int, [c_void_p, c_char_p, c_char_p, c_size_t]),
    "fw_design_name": (c_char_p, [c_void_p]),
    "fw_design_judge": (c_int, [c_void_p]),
    "fw_design_decision": (c_int, [c_void_p]),
    "fw_design_fabricate": (c_int, [c_void_p]),
    "fw_design_simulate": (c_int, [c_void_p]),
    "fw_design_modes": (c_int, [c_void_p]),
    "fw_design_statics": (c_int, [c_void_p]),
    "fw_design_assemble": (c_int, [c_void_p]),
    "fw_design_unreliable": (c_int, [c_void_p]),
    "fw_design_workspace": (c_int, [c_void_p]),
    "fw_design_tradeoff": (c_int, [c_void_p, c_double, c_int]),
    "fw_design_study": (c_int, [c_void_p, c_char_p, POINTER(StudySettingsStruct), POINTER(c_void_p),
                                POINTER(c_size_t)]),
    "fw_design_write": (c_int, [c_void_p, c_char_p, c_uint]),
    "fw_design_files_written": (c_int, [c_void_p]),
    "fw_design_document": (c_int, [c_void_p, c_int, POINTER(c_void_p), POINTER(c_size_t)]),
    "fw_design_text_style": (c_int, [c_void_p, c_int, c_int]),
    "fw_design_diagnostics": (c_size_t, [c_void_p]),
    "fw_design_diagnostics_before": (c_size_t, [c_void_p]),
    "fw_design_diagnostic": (POINTER(DiagnosticStruct), [c_void_p, c_size_t]),
    "fw_design_cancel": (None, [c_void_p]),
    "fw_design_cancel_clear": (None, [c_void_p]),
    "fw_design_progress": (c_int, [c_void_p, TOLD, c_void_p]),
    "fw_design_arrays": (c_int, [c_void_p, c_int, POINTER(c_size_t)]),
    "fw_design_array": (POINTER(ArrayStruct), [c_void_p, c_int, c_size_t]),
}


def _candidates() -> Iterator[str]:
    """Where the library may lie, best first."""
    asked = os.environ.get("FLEXWRIGHT_LIBRARY")
    if asked:
        yield asked
        return
    here = pathlib.Path(__file__).resolve().parent
    yield str(here / "_native" / "lib" / NAME)  # of a wheel
    for above in list(here.parents)[:5]:  # PREFIX/lib/python3/dist-packages/flexwright
        yield str(above / NAME)
        yield from (str(p) for p in sorted(above.glob(f"*-linux-gnu/{NAME}")))
        if above.name in ("lib", "lib64"):
            break
    source = here.parents[1]
    if (source / "include" / "flexwright.h").exists():  # a source tree that was built
        yield str(source / "build" / NAME)
    yield NAME  # as the system finds it


def load() -> ctypes.CDLL:
    """The shared library, with the types of its functions.

    ImportError says where it was looked for, and how to name another place.
    """
    tried = []
    for path in _candidates():
        if os.sep in path and not os.path.exists(path):
            tried.append(path)
            continue
        try:
            library = ctypes.CDLL(path)
        except OSError as error:
            tried.append(f"{path} ({error})")
            continue
        try:
            for name, (result, arguments) in _FUNCTIONS.items():
                function = getattr(library, name)
                function.restype = result
                function.argtypes = arguments
        except AttributeError as error:
            raise ImportError(f"{path} is of an earlier version than this package: {error}; "
                              "install both from the same source") from None
        return library
    raise ImportError("libflexwright was not found; looked at " + ", ".join(tried) +
                      ". Set FLEXWRIGHT_LIBRARY to the file, or install it: cmake --install build")


lib = load()
