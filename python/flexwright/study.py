# SPDX-License-Identifier: GPL-3.0-or-later
"""Many settings of one description, their results as they come."""
from __future__ import annotations

import concurrent.futures
import ctypes
import itertools
import json
import os
from typing import (Any, Callable, Dict, Iterable, Iterator, List, Mapping, Optional, Sequence,
                    Union)

from . import _arguments
from ._arguments import Value
from ._design import Design, ProgressCallback
from ._library import StudySettingsStruct
from .device import Device
from .errors import FlexwrightError

JOBS_MOST = 256  # threads of one work, as of the library's studies

Settings = Mapping[str, Value]
Measure = Callable[[Device], Mapping[str, Any]]


def verdict_of(device: Device) -> Dict[str, Any]:
    """What a sweep measures unless told otherwise: verdict, share used, utilisation of each hinge as
    drawn, nearest clearance (m)."""
    v = device.check(advice="none")
    governing = v.governing
    made = governing["made"] if governing["made"].what else governing["drawn"]
    out: Dict[str, Any] = {"verdict": v.decision, "used": made.used, "used_low": made.used_low,
                           "used_high": made.used_high, "governing": made.what}
    out.update({f"utilisation.{id_}": float(u) for id_, u in v.utilisation.items()})
    near = v.clearances.get("clearance", ())
    out["clearance"] = float(min(near)) if len(near) else None
    return out


def grid(**values: Iterable[Value]) -> Iterator[Dict[str, Value]]:
    """Every combination of the values, the last one running fastest."""
    names = list(values)
    for row in itertools.product(*values.values()):
        yield dict(zip(names, row))


def sweep(device: Union[Device, str, "os.PathLike[str]"], settings: Iterable[Settings], *,
          measure: Measure = verdict_of, jobs: int = 1,
          options: Optional[Mapping[str, Any]] = None) -> Iterator[Dict[str, Any]]:
    """A dict for each of the settings, in their order, as soon as it is known: the settings, then what
    was measured. A device that has no result gives "error" (its message) and nothing is raised: neither by settings
    that no device takes nor by `measure`, whatever it raises. Wrong arguments of sweep itself are, and what a handler of a
    signal raises (Ctrl-C, an alarm) while the library works.

        rows = flexwright.sweep("stage.xml", flexwright.grid(arc=["220 deg", "230 deg"]))
        frame = pandas.DataFrame(rows)

    measure: from a Device to named numbers. jobs: threads that work side by side; 0: one for each
    processor. Nothing is computed ahead of what is asked for but by as many as there are jobs.
    """
    _arguments.whole("jobs", jobs, 0, JOBS_MOST)
    base = device if isinstance(device, Device) else Device(device, options=options)
    if options and base is device:
        base = base.with_(options=options)

    working: Dict[int, Device] = {}

    def one(setting: Settings) -> Dict[str, Any]:
        row: Dict[str, Any] = {}
        try:
            row.update(setting)
            device = base.with_(set=setting)
            working[id(device)] = device
            try:
                row.update(measure(device))
            finally:
                del working[id(device)]
        except FlexwrightError as error:
            row["error"] = str(error)
        except Exception as error:  # pylint: disable=broad-except - a row's error is the row's
            if getattr(error, "_of_a_handler", False):
                raise
            row["error"] = f"{type(error).__name__}: {error}"
        return row

    if jobs == 1:
        return (one(setting) for setting in settings)
    return _side_by_side(one, settings, jobs or min(os.cpu_count() or 1, JOBS_MOST), working)


def _side_by_side(one: Callable[[Settings], Dict[str, Any]], settings: Iterable[Settings],
                  jobs: int, working: Mapping[int, Device]) -> Iterator[Dict[str, Any]]:
    coming = iter(settings)
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        waiting: List["concurrent.futures.Future[Dict[str, Any]]"] = []
        try:
            for setting in itertools.islice(coming, 2 * jobs):
                waiting.append(pool.submit(one, setting))
            while waiting:
                row = waiting.pop(0).result()
                for setting in itertools.islice(coming, 1):
                    waiting.append(pool.submit(one, setting))
                yield row
        finally:
            for future in waiting:  # whoever asks has had enough, or pressed Ctrl-C
                future.cancel()
            for device in list(working.values()):
                device.cancel()


def columns(rows: Iterable[Mapping[str, Any]]) -> Dict[str, list]:
    """Rows as columns, None where a row has no value: for plots and tables."""
    taken: Sequence[Mapping[str, Any]] = list(rows)
    names = dict.fromkeys(name for row in taken for name in row)
    return {name: [row.get(name) for row in taken] for name in names}


def run_study(file: Union[str, "os.PathLike[str]"], directory: Union[str, "os.PathLike[str]"], *,
              study: Optional[str] = None, jobs: int = 0, shard: int = 0, shards: int = 0,
              resume: bool = False, set: Optional[Mapping[str, Value]] = None,
              progress: Optional[ProgressCallback] = None, **options: Any) -> Optional[Dict[str, Any]]:
    """Runs a <study> of a device file, or a study file, as `flexwright study` does: sweep, yield, size,
    sensitivity or worst case. What it found, as study.json has it (SI); None for a shard.

        found = flexwright.run_study("widths.xml", "out/widths")
        rows = pandas.read_csv("out/widths/study.csv")

    directory: of study.sqlite, study.csv, study.json and study.html. jobs: threads; 0: one for each
    processor. set: settings of every device, before the study's own. options: of every device
    (accuracy, flow, ...). Ctrl-C keeps the samples so far, and resume=True goes on with them.
    """
    chosen = _arguments.options(options)
    if "data_directory" not in chosen and os.environ.get("FLEXWRIGHT_DATA"):
        chosen["data_directory"] = os.environ["FLEXWRIGHT_DATA"]
    design = Design(chosen)
    for path, value in (set or {}).items():
        design.set(_arguments.setting_name(path), _arguments.setting(path, value))
    text, length = ctypes.c_void_p(), ctypes.c_size_t()
    settings = StudySettingsStruct(ctypes.sizeof(StudySettingsStruct),
                                   None if study is None else _arguments.text("study", study).encode(),
                                   os.fsencode(_arguments.path("directory", directory)),
                                   _arguments.whole("jobs", jobs), _arguments.whole("shard", shard),
                                   _arguments.whole("shards", shards),
                                   int(_arguments.truth("resume", resume)))
    design.call("study", os.fsencode(_arguments.path("file", file)), ctypes.byref(settings), ctypes.byref(text),
                ctypes.byref(length), progress=progress)
    return json.loads(ctypes.string_at(text.value, length.value)) if text.value else None
