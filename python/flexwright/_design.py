# SPDX-License-Identifier: GPL-3.0-or-later
"""One fw_design: its stages, documents, diagnostics and numbers."""
from __future__ import annotations

import _thread
import ctypes
import threading
from typing import Any, Callable, Dict, List, Mapping, NamedTuple, Optional, Tuple, Union

import numpy as np

from . import _arguments
from ._library import TOLD, ArrayStruct, OptionsStruct, lib
from .errors import Cancelled, Diagnostic, MemoryLimitError, Severity, error_of

OK = 0
REAL, WHOLE, TEXT, COMPLEX, TRUTH = range(5)

#: FW_NUMBERS_... of flexwright.h
NUMBERS = {name: i for i, name in enumerate(
    ("parameters", "scenes", "hinges", "flow_hinges", "flows", "governing", "clearances",
     "requirements", "probes", "motion", "peaks", "motion_probes", "modes", "statics", "load_path",
     "assembly", "workspace"))}

#: FW_DOCUMENT_... of flexwright.h: number, and the stage that makes it
DOCUMENTS = {
    "verdict_json": (0, "judge"), "verdict_text": (1, "judge"),
    "simulate_json": (2, "simulate"), "simulate_text": (3, "simulate"),
    "motion_csv": (4, "simulate"), "animation_svg": (5, "simulate"),
    "masks_json": (6, "fabricate"), "recipes_json": (7, "fabricate"),
    "device_svg": (8, "judge"), "report_html": (9, "judge"), "diagnostics_text": (10, ""),
    "modes_json": (11, "modes"), "modes_text": (12, "modes"), "modes_svg": (13, "modes"),
    "statics_json": (14, "statics"), "statics_text": (15, "statics"),
    "statics_svg": (16, "statics"), "load_path_csv": (17, "statics"),
    "load_path_svg": (18, "statics"), "assemble_json": (19, "assemble"),
    "assemble_text": (20, "assemble"), "assemble_svg": (21, "assemble"),
    "forces_csv": (22, "simulate"), "workspace_json": (23, "workspace"),
    "workspace_text": (24, "workspace"), "workspace_svg": (25, "workspace"),
    "certificate_json": (26, "workspace"), "table_json": (27, ""), "preview_json": (28, ""),
    "tradeoff_json": (29, "tradeoff"), "tradeoff_text": (30, "tradeoff"),
    "tradeoff_csv": (31, "tradeoff"), "tradeoff_svg": (32, "tradeoff"),
    "diagnostics_json": (33, ""),
}


class Progress(NamedTuple):
    """How far a call is."""

    what: str  #: "judging what a flow makes of it"
    done: float
    of: float  #: 0: not known how many
    unit: str  #: what `done` and `of` count
    at_most: bool = False  #: `of` is the most that a search may come to; it usually ends before


ProgressCallback = Callable[[Progress], Any]


class Array(NamedTuple):
    """A table of the library with its names and units."""

    name: str
    unit: str
    about: str
    labels: Tuple[Optional[Tuple[str, ...]], ...]
    values: np.ndarray


def _text(raw: Optional[bytes]) -> Optional[str]:
    return None if raw is None else raw.decode("utf-8", "replace")


class _Owner:
    """The library's design, freed with this. A Design has one, and so have the arrays that stand on its memory: these hold
    nothing else, since Python does not look for cycles through arrays, and a Design keeps arrays."""

    __slots__ = ("pointer",)

    def __init__(self, pointer: int) -> None:
        self.pointer = pointer

    def __del__(self) -> None:
        lib.fw_design_free(self.pointer)


class _Memory:
    """What a NumPy array stands on: memory of a design, which lives as long as the array does."""

    __slots__ = ("owner", "__array_interface__")

    def __init__(self, owner: _Owner, address: int, shape: Tuple[int, ...], kind: str) -> None:
        self.owner = owner
        self.__array_interface__ = {"version": 3, "shape": shape, "typestr": kind,
                                    "data": (address, True)}


_KINDS = {REAL: np.dtype(np.float64).str, WHOLE: np.dtype(np.int32).str,
          COMPLEX: np.dtype(np.complex128).str, TRUTH: np.dtype(np.int32).str}


def _values(owner: _Owner, raw: ArrayStruct, shape: Tuple[int, ...]) -> np.ndarray:
    """A view of the library's own memory, which cannot be written to; texts become str or None."""
    if raw.type != TEXT:
        return np.asarray(_Memory(owner, raw.data, shape, _KINDS[raw.type]))
    n = int(np.prod(shape, dtype=np.int64))
    texts = np.empty(n, dtype=object)
    pointers = ctypes.cast(raw.data, ctypes.POINTER(ctypes.c_char_p))
    for i in range(n):
        texts[i] = _text(pointers[i])
    texts = texts.reshape(shape)
    texts.flags.writeable = False
    return texts


def _nothing_to_begin_with(cap: int) -> MemoryLimitError:
    """No design at all: the library has nowhere to say why."""
    small = 0 < cap < 1 << 20
    what = f"no device fits into memory_cap = {cap} bytes; allow more" if small else \
        "out of memory: the machine has no more of it"
    return MemoryLimitError(what, [Diagnostic(720 if small else 721, Severity.ERROR, None, 0, 0, what)])


def _is_interruptible() -> bool:
    """Does Python run handlers of signals here, which may end the call?"""
    return threading.current_thread() is threading.main_thread()


class Question:
    """What somebody asked of a device: one call of the library or several. Cancelled at any moment, also between two
    of them, none of its calls begins any more."""

    _now = threading.local()

    def __init__(self) -> None:
        self.cancelled = False
        self._outer: Optional["Question"] = None

    def __enter__(self) -> "Question":
        self._outer, Question._now.one = Question.now(), self
        return self

    def __exit__(self, *_raised: object) -> None:
        Question._now.one = self._outer

    @classmethod
    def now(cls) -> Optional["Question"]:
        """The one that this thread is answering."""
        return getattr(cls._now, "one", None)


class Design:
    """A design of the library, freed when nothing uses it any more, arrays included.

    options: as _arguments.options has them.
    """

    def __init__(self, options: Mapping[str, Any]) -> None:
        self._lock = threading.RLock()
        self._cancelling = threading.RLock()
        self._working = False
        self._done: set = set()
        self._numbers: Dict[str, Dict[str, Array]] = {}
        self._said: List[Tuple[str, Diagnostic]] = []  # by calls that were answered
        struct = OptionsStruct()
        lib.fw_design_options_init(ctypes.byref(struct), ctypes.sizeof(struct))
        for name, value in options.items():
            setattr(struct, name, _arguments.raw(name, value))
        pointer = lib.fw_design_new(ctypes.byref(struct))
        if not pointer:
            raise _nothing_to_begin_with(options.get("memory_cap", 0))
        self._owner = _Owner(pointer)
        self._pointer: int = pointer

    # ---- calls ----

    def _check(self, status: int, what: str) -> None:
        if status == OK:
            return
        name = _text(lib.fw_status_name(status))
        raise error_of(status, f"{what}: {name}", self._of_the_last_call())

    def _of_the_last_call(self) -> List[Diagnostic]:
        """What the last call of the library said."""
        out = []
        for i in range(lib.fw_design_diagnostics_before(self._pointer),
                       lib.fw_design_diagnostics(self._pointer)):
            d = lib.fw_design_diagnostic(self._pointer, i).contents
            out.append(Diagnostic(d.number, Severity(d.severity), _text(d.file), d.line, d.column,
                                  _text(d.message) or "", d.system_error))
        return out

    def _in_thread(self, function: Callable[..., int], arguments: tuple) -> int:
        """The call in a thread of its own, so that this one can take signals: Ctrl-C, an alarm.

        Whatever a handler raises cancels the design, and is raised when its work has ended.
        """
        answer: List[Union[int, BaseException]] = []
        ended = _thread.allocate_lock()
        ended.acquire()

        def work() -> None:
            try:
                answer.append(function(self._pointer, *arguments))
            except BaseException as error:  # pragma: no cover - ctypes refuses an argument
                answer.append(error)
            finally:
                ended.release()

        raised: Optional[BaseException] = None
        try:
            _thread.start_new_thread(work, ())
            ended.acquire()
        except BaseException as error:
            if isinstance(error, RuntimeError) and "start new thread" in str(error):
                raise
            raised = error
            raised._of_a_handler = True  # it ends whatever asked, and not this question alone: sweep looks
            lib.fw_design_cancel(self._pointer)
        while not answer:  # what a handler raises may come when the work has just ended: no lock is given up twice
            try:
                ended.acquire()
            except BaseException:
                lib.fw_design_cancel(self._pointer)
        try:
            if raised is not None:
                raise raised
            if isinstance(answer[0], BaseException):
                raise answer[0]
            return answer[0]
        finally:  # an exception knows this frame, which would know it
            del raised, answer

    def call(self, name: str, *arguments: Any, progress: Optional[ProgressCallback] = None) -> None:
        """fw_design_NAME(design, *arguments), which may take long.

        progress: called with a Progress now and then; what it raises cancels the work and is raised.
        """
        raised: List[BaseException] = []

        def told(_context, what, done, of, unit) -> int:
            try:
                progress(Progress(_text(what) or "", done, abs(of), _text(unit) or "", of < 0))
            except BaseException as error:
                raised.append(error)
                return 1
            return 0

        function = getattr(lib, "fw_design_" + name)
        question = Question.now()
        with self._lock:
            teller = TOLD(told) if progress else TOLD()
            lib.fw_design_progress(self._pointer, teller, None)
            try:
                with self._cancelling:
                    if question is not None and question.cancelled:
                        raise Cancelled(name.replace("_", " ") + ": cancelled", ())
                    self._working = True
                if _is_interruptible():
                    status = self._in_thread(function, arguments)
                else:
                    status = function(self._pointer, *arguments)
            finally:
                with self._cancelling:
                    self._working = False
                    lib.fw_design_cancel_clear(self._pointer)
                lib.fw_design_progress(self._pointer, TOLD(), None)
            self._numbers.clear()
            try:
                if raised:
                    raise raised[0]
            finally:
                raised.clear()
            self._check(status, name.replace("_", " "))
            self._said += [(name, d) for d in self._of_the_last_call()]

    def stage(self, name: str, *arguments: Any,
              progress: Optional[ProgressCallback] = None) -> "Design":
        """A stage, once."""
        if name and name not in self._done:
            if name == "fabricate":
                self.stage("judge", progress=progress)
            self.call(name, *arguments, progress=progress)
            self._done.add(name)
        return self

    def set(self, path: str, value: str) -> None:
        self._check(lib.fw_design_set(self._pointer, path.encode(), value.encode()), "set")

    def cancel(self) -> None:
        """A running call ends soon with Cancelled; from any thread, or a handler of a signal."""
        with self._cancelling:
            if self._working:
                lib.fw_design_cancel(self._pointer)

    # ---- what it has ----

    @property
    def name(self) -> Optional[str]:
        return _text(lib.fw_design_name(self._pointer))

    def said(self, *calls: str) -> Tuple[Diagnostic, ...]:
        """By these calls, where they were answered: what one that failed said is in its exception."""
        return tuple(d for call, d in self._said if call in calls)

    @property
    def decision(self) -> int:
        return lib.fw_design_decision(self._pointer)

    @property
    def unreliable(self) -> bool:
        return bool(lib.fw_design_unreliable(self._pointer))

    @property
    def files_written(self) -> int:
        return lib.fw_design_files_written(self._pointer)

    def document(self, name: str, progress: Optional[ProgressCallback] = None) -> str:
        """A document as text; its stage was called."""
        number, _stage = DOCUMENTS[name]
        text, length = ctypes.c_void_p(), ctypes.c_size_t()
        with self._lock:
            self.call("document", number, ctypes.byref(text), ctypes.byref(length),
                      progress=progress)
            return ctypes.string_at(text.value or 0, length.value).decode("utf-8", "replace")

    def numbers(self, name: str) -> Dict[str, Array]:
        """The arrays of a set by their names; its stage was called."""
        with self._lock:
            if name not in self._numbers:
                self._numbers[name] = self._read_numbers(NUMBERS[name])
            return self._numbers[name]

    def _read_numbers(self, which: int) -> Dict[str, Array]:
        count = ctypes.c_size_t()
        self._check(lib.fw_design_arrays(self._pointer, which, ctypes.byref(count)), "numbers")
        out = {}
        for i in range(count.value):
            raw = lib.fw_design_array(self._pointer, which, i).contents
            shape = tuple(raw.extent[:raw.dimensions])
            labels = tuple(tuple(_text(raw.label[k][j]) or "" for j in range(n))
                           if raw.label[k] else None for k, n in enumerate(shape))
            name = _text(raw.name) or ""
            out[name] = Array(name, _text(raw.unit) or "", _text(raw.about) or "", labels,
                              _values(self._owner, raw, shape))
        return out


def library_version() -> str:
    """Version of the shared library, "MAJOR.MINOR.PATCH"."""
    return _text(lib.fw_library_version()) or ""
