# SPDX-License-Identifier: GPL-3.0-or-later
"""A device and what can be asked of it."""
from __future__ import annotations

import difflib
import functools
import json
import os
import sys
import threading
import weakref
from typing import Any, Dict, List, Mapping, Optional, Tuple, Union

from . import _arguments, results
from ._arguments import Value
from ._design import DOCUMENTS, Design, Progress, ProgressCallback, Question
from .errors import Diagnostic, FileError, FlexwrightError, Severity, error_of
from .tables import Table, table

#: what `Device.write` writes, as FW_DESIGN_... of flexwright.h
WRITES = {"verdict": 1, "masks": 2, "recipes": 4, "motion": 8, "report": 16}

def show_progress(progress: Progress) -> None:
    """A line on standard error that is written over; for `progress=flexwright.show_progress`."""
    most = "at most " if progress.at_most else ""
    share = f"{progress.done:.3g} of {most}{progress.of:.3g} {progress.unit}" if progress.of else \
        f"{progress.done:.3g} {progress.unit}"
    sys.stderr.write(f"\r\033[K{progress.what}: {share}")
    sys.stderr.flush()


class Device:
    """One description with its settings.

        d = flexwright.Device("stage.xml", arc="230 deg")
        v = d.check()
        v.utilisation["A"].band

    source: path of a device description. Further keywords set parameters of it: texts as the file
    would write them ("230 deg"), pairs (230, "deg"), or pure numbers. `set` takes attributes, and
    names that are no Python words: set={"flexure[A]/@length": "312 um"}.
    options: for all questions (accuracy, flow, effects, data_directory, ...); each question takes its
    own besides.

    The file is read at once, and here only: mistakes raise InputError, with all of them in its
    diagnostics. Any number of devices may work in parallel in threads.

    What the library holds for it is freed when nothing uses it any more; `close()` or `with` lets it go
    at once.
    """

    def __init__(self, source: Union[str, bytes, "os.PathLike[str]", "os.PathLike[bytes]"], *,
                 set: Optional[Mapping[str, Value]] = None,
                 options: Optional[Mapping[str, Any]] = None, **parameters: Value) -> None:
        path = _arguments.path("source", source)
        try:
            with open(path, "rb") as file:
                text = file.read()
        except OSError as error:
            what = "cannot be read: %s" % error.strerror
            said = [Diagnostic(220, Severity.ERROR, path, 0, 0, what, error.errno or 0)]
            raise error_of(FileError.status, f"{path} {what}", said) from error
        self._begin(text, path, os.path.dirname(path) or ".", set, options, parameters)

    @classmethod
    def from_text(cls, text: Union[str, bytes], *, name: str = "memory",
                  directory: Optional[Union[str, "os.PathLike[str]"]] = None,
                  set: Optional[Mapping[str, Value]] = None,
                  options: Optional[Mapping[str, Any]] = None, **parameters: Value) -> "Device":
        """A device from a description in memory. name: of it in messages; directory: where the
        drawings lie that it names (None: none are opened)."""
        self = cls.__new__(cls)
        if not isinstance(text, (str, bytes, bytearray, memoryview)):
            raise TypeError(f"text is a description as str or bytes, not {type(text).__name__}")
        self._begin(text.encode("utf-8", "surrogatepass") if isinstance(text, str) else bytes(text),
                    _arguments.path("name", name),
                    None if directory is None else _arguments.path("directory", directory), set,
                    options, parameters)
        return self

    def _begin(self, text: bytes, file: str, directory: Optional[str],
               attributes: Optional[Mapping[str, Value]], options: Optional[Mapping[str, Any]],
               parameters: Mapping[str, Value],
               habit: Optional[Dict[str, Mapping[str, Any]]] = None) -> None:
        self._text, self._file, self._directory = text, file, directory
        self._set: Dict[str, Value] = {**(attributes or {}), **parameters}
        self._options = _arguments.options(options or {})
        self._closed = False
        if "data_directory" not in self._options and os.environ.get("FLEXWRIGHT_DATA"):
            self._options["data_directory"] = os.environ["FLEXWRIGHT_DATA"]
        if directory is not None:
            self._options.setdefault("directory", directory)
        self._lock = threading.RLock()
        self._listing = threading.RLock()  # of the next two, never held while the library works
        self._busy: "weakref.WeakSet[Design]" = weakref.WeakSet()
        self._questions: List[Question] = []  # that are being answered
        self._known: "weakref.WeakValueDictionary[tuple, Design]" = weakref.WeakValueDictionary()
        # what was asked last of a device of this family: read with those options, the next need not be read twice
        self._habit: Dict[str, Mapping[str, Any]] = {"options": {}} if habit is None else habit
        self._own: Optional[Design] = None
        try:
            self._own = self._design(self._habit["options"])
        except FlexwrightError:
            if not self._habit["options"]:
                raise
            self._own = self._design({})
        self._name = self._own.name or ""

    # ---- designs: one for each set of options ----

    def _design(self, options: Mapping[str, Any]) -> Design:
        """Read, with the settings of this device."""
        key = tuple(sorted(options.items()))
        with self._lock:
            if self._closed:
                raise _arguments.refused("the device is closed, and answers nothing any more; `with_` makes another one of it")
            known = self._known.get(key)
            if known is not None:
                return known
            design = Design({**self._options, **options})
            with self._listing:
                self._busy.add(design)
            for name, value in self._set.items():
                design.set(_arguments.setting_name(name), _arguments.setting(name, value))
            design.call("read_memory", self._file.encode("utf-8", "surrogateescape"), self._text,
                        len(self._text))
            self._known[key] = design
            if not key:
                self._own = design
            return design

    def _ask(self, stages: Tuple[tuple, ...], options: Mapping[str, Any],
             progress: Optional[ProgressCallback], *then: tuple) -> Design:
        """A design with these stages, and what is called when it has them."""
        question = Question()
        with self._listing:
            self._questions.append(question)
        try:
            with question:
                design = self._design(_arguments.options(options))
                try:
                    for stage, *arguments in stages:
                        design.stage(stage, *arguments, progress=progress)
                except BaseException:
                    with self._lock:  # what failed half way is not asked again
                        for key in [k for k, d in self._known.items() if d is design]:
                            del self._known[key]
                    raise
                for name, *arguments in then:
                    design.call(name, *arguments, progress=progress)
        finally:
            with self._listing:
                self._questions.remove(question)
        self._habit["options"] = _arguments.options(options)
        return design

    # ---- what it is ----

    @property
    def _any(self) -> Design:
        return self._own if self._own is not None else self._design({})

    @property
    def name(self) -> str:
        """Of the device, as the description has it."""
        return self._name

    @property
    def file(self) -> str:
        """The file that was read."""
        return self._file

    @functools.cached_property
    def parameters(self) -> Table:
        """A row per parameter: value, min, max in SI of its `unit`, `written_unit`, doc."""
        return table(self._any, "parameters")

    @property
    def scenes(self) -> Tuple[str, ...]:
        """Names of the scenes."""
        return tuple(self.scene_table["name"])

    @functools.cached_property
    def scene_table(self) -> Table:
        """A row per scene: name, flow, duration (s)."""
        return table(self._any, "scenes")

    @property
    def diagnostics(self) -> Tuple[Diagnostic, ...]:
        """What was said of the description, warnings and notes too."""
        return self._any.said("read_memory")

    @property
    def settings(self) -> Dict[str, Value]:
        """Parameters and attributes that were set."""
        return dict(self._set)

    def __repr__(self) -> str:
        changed = "".join(f", {name}={value!r}" for name, value in self._set.items())
        return f"<Device {self.name} from {self._file!r}{changed}>"

    def with_(self, *, set: Optional[Mapping[str, Value]] = None,
              options: Optional[Mapping[str, Any]] = None, **parameters: Value) -> "Device":
        """The same description, as it was read, with other settings."""
        other = type(self).__new__(type(self))
        merged = {k: v for k, v in self._options.items()}
        merged.update(_arguments.options(options or {}))
        other._begin(self._text, self._file, self._directory, {**self._set, **(set or {})}, merged,
                     parameters, self._habit)
        return other

    def __reduce__(self):  # so that it passes between processes
        return _again, (self._text, self._file, self._directory, self._set, self._options)

    def cancel(self) -> None:
        """All running questions of this device end soon with Cancelled, wherever they are; from any thread."""
        with self._listing:
            questions, busy = list(self._questions), list(self._busy)
        for question in questions:
            question.cancelled = True
        for design in busy:
            design.cancel()

    def close(self) -> None:
        """Lets go of what the library holds for this device. Questions that are being answered end with Cancelled, later ones
        are refused; results and arrays that were handed out stay as they are."""
        self._closed = True
        self.cancel()
        with self._lock:
            self._own = None
            self._known.clear()
        for cached in ("parameters", "scene_table"):
            self.__dict__.pop(cached, None)

    def __enter__(self) -> "Device":
        return self

    def __exit__(self, *_raised: object) -> None:
        self.close()

    # ---- questions ----

    def check(self, *, progress: Optional[ProgressCallback] = None,
              **options: Any) -> results.Verdict:
        """The verdict: does any hinge leave its elastic range? A rejected design is a result.

        options: accuracy, flow, effects, corners, advice ("none" is faster where it is rejected), ...
        """
        return results.Verdict(self._ask((("judge",),), options, progress))

    def simulate(self, scene: Optional[str] = None, *,
                 progress: Optional[ProgressCallback] = None, **options: Any) -> results.Motion:
        """One scene in time (None: the first). options: samples, rtol, integrator, method, ..."""
        return results.Motion(self._ask((("simulate",),), {**options, "scene": scene}, progress))

    def modes(self, scene: Optional[str] = None, at: str = "rest", *,
              progress: Optional[ProgressCallback] = None, **options: Any) -> results.Modes:
        """Small motions about "rest" or, under the loads of the scene, about the "equilibrium"."""
        return results.Modes(self._ask((("modes",),), {**options, "scene": scene, "at": at},
                                       progress))

    def statics(self, scene: Optional[str] = None, path: bool = False, *,
                progress: Optional[ProgressCallback] = None, **options: Any) -> results.Statics:
        """The equilibrium under the loads of a scene; path: and the way there from rest."""
        return results.Statics(self._ask((("statics",),),
                                         {**options, "scene": scene, "path": _arguments.truth("path", path) or None},
                                         progress))

    def assemble(self, scene: Optional[str] = None, *, progress: Optional[ProgressCallback] = None,
                 **options: Any) -> results.Assembly:
        """The position with all joints closed. options: independent, rates, accelerations."""
        return results.Assembly(self._ask((("assemble",),), {**options, "scene": scene}, progress))

    def workspace(self, *, progress: Optional[ProgressCallback] = None,
                  **options: Any) -> results.Workspace:
        """Platform poses of a six-bar that the elastic limits leave, proved."""
        return results.Workspace(self._ask((("workspace",),), options, progress))

    def tradeoff(self, scene: Optional[str] = None, budget_s: float = 0, *,
                 progress: Optional[ProgressCallback] = None, **options: Any) -> results.Tradeoff:
        """What accuracy costs. budget_s: work to spend, s of a usual machine; 0: 20."""
        return results.Tradeoff(self._ask((("tradeoff", _arguments.real("budget_s", budget_s), 0),),
                                          {**options, "scene": scene}, progress))

    def fabricate(self, *, progress: Optional[ProgressCallback] = None,
                  **options: Any) -> results.Fabrication:
        """Masks and recipes. A rejected design has no masks unless force=True."""
        return results.Fabrication(self._ask((("judge",), ("fabricate",)), options, progress))

    def masks(self, **options: Any) -> Dict[str, Dict[str, Any]]:
        """By flow: the certificate of its mask."""
        return self.fabricate(**options).masks

    def recipes(self, **options: Any) -> Dict[str, Dict[str, Any]]:
        """By flow: its run sheet."""
        return self.fabricate(**options).recipes

    def write(self, directory: Union[str, "os.PathLike[str]"], *what: str,
              progress: Optional[ProgressCallback] = None, **options: Any) -> int:
        """Files below `directory`, which appears whole or not at all; how many they are.

        what: of "verdict", "masks", "recipes", "motion", "report"; none: all, as `flexwright plan`.
        """
        wrong = [name for name in what if not isinstance(name, str) or name not in WRITES]
        if wrong:
            raise _arguments.refused(f"write knows {', '.join(WRITES)}, not {wrong[0]!r}")
        bits = sum(WRITES[name] for name in dict.fromkeys(what or WRITES))
        stages: Tuple[tuple, ...] = (("judge",),)
        if bits & (WRITES["masks"] | WRITES["recipes"]):
            stages += (("fabricate",),)
        return self._ask(stages, options, progress,
                         ("write", os.fsencode(_arguments.path("directory", directory)), bits)).files_written

    def document(self, name: str, *, progress: Optional[ProgressCallback] = None,
                 **options: Any) -> str:
        """A document by its name ("report_html", "motion_csv", ...); its stage is run."""
        if name not in DOCUMENTS:
            near = difflib.get_close_matches(name, DOCUMENTS, 1)
            raise KeyError(f"{name!r}" + (f"; did you mean {near[0]!r}?" if near else
                                          f": there are {', '.join(DOCUMENTS)}"))
        stage = DOCUMENTS[name][1]
        stages: Tuple[tuple, ...] = ((stage, 0.0, 0),) if stage == "tradeoff" else ((stage,),)
        return self._ask(stages, options, progress).document(name)

    def table(self) -> Dict[str, Any]:
        """Elements and attributes of descriptions, methods, effects: for forms and editors."""
        return json.loads(self._any.document("table_json"))

    @functools.cached_property
    def _drawing(self) -> str:
        """Its hinges coloured by utilisation; where that cannot be judged, as it is assembled."""
        try:
            return self.check(advice="none", corners="none").svg
        except FlexwrightError:
            return self.assemble().svg

    def _repr_svg_(self) -> str:
        return results.element_of(self._drawing)

    def _repr_html_(self) -> str:
        return results.picture_of(self._drawing)


def _again(text: bytes, file: str, directory: Optional[str], attributes: Mapping[str, Value],
           options: Mapping[str, Any]) -> Device:
    self = Device.__new__(Device)
    self._begin(text, file, directory, attributes, options, {})
    return self
