# SPDX-License-Identifier: GPL-3.0-or-later
"""What is passed to the library, as the library takes it: ctypes cuts numbers to their width and texts at a NUL without
a word, so that what does not fit is refused here, by the name that it was passed with."""
from __future__ import annotations

import difflib
import math
import operator
import os
from ctypes import c_char_p, c_double
from typing import Any, Dict, Mapping, Union

import numpy as np

from ._library import OptionsStruct
from .errors import Diagnostic, Severity, UsageError

_TYPES = {name: type_ for name, type_ in OptionsStruct._fields_ if name != "size"}
#: options of every question, as in flexwright.h: the description of fw_design_options says what they are
OPTIONS = tuple(_TYPES)
TRUTHS = ("force", "path", "figures")
PATHS = ("data_directory", "directory", "layers", "laboratory")
MOST_WHOLE = 2**31 - 1  # int32_t
MOST_SIZE = 2**63 - 1  # of size_t, which no machine has

Value = Union[str, int, float]


def refused(what: str) -> UsageError:
    """Wrong usage, as the library says it."""
    return UsageError(what, [Diagnostic(230, Severity.ERROR, None, 0, 0, what)])


def text(name: str, value: Any) -> str:
    """A text without a NUL, in which the library would end it."""
    if not isinstance(value, str):
        raise TypeError(f"{name} is a text, not {value!r}")
    if "\0" in value:
        raise refused(f"{name} = {value!r}: a text without a NUL is needed")
    try:
        value.encode()
    except UnicodeEncodeError as error:
        raise refused(f"{name} = {value!r} is no Unicode text: {error.reason}; of bytes, decode them with the "
                      "encoding that they have") from None
    return str(value)


def path(name: str, value: Any) -> str:
    """Of a file or directory; names that are not UTF-8 as os.fsdecode has them."""
    try:
        out = os.fsdecode(value)
    except TypeError:
        raise TypeError(f"{name} is a path, not {value!r}") from None
    if "\0" in out:
        raise refused(f"{name} = {out!r}: no name of a file has a NUL")
    return out


def whole(name: str, value: Any, least: int = -MOST_WHOLE, most: int = MOST_WHOLE) -> int:
    """A whole number within these limits."""
    try:
        if isinstance(value, (bool, np.bool_)):
            raise TypeError
        number = operator.index(value)
    except TypeError:
        raise TypeError(f"{name} is a whole number, not {value!r}") from None
    if not least <= number <= most:
        raise refused(f"{name} = {number}: a whole number between {least} and {most} is needed")
    return number


def real(name: str, value: Any) -> float:
    """A number, whatever type of Python or NumPy it has."""
    try:
        if isinstance(value, (str, bytes, bytearray, bool, np.bool_)):
            raise TypeError
        return float(value)
    except (TypeError, ValueError, OverflowError):
        raise TypeError(f"{name} is a number, not {value!r}") from None


def truth(name: str, value: Any) -> bool:
    """True or False; a text such as "no" would be true."""
    if isinstance(value, (bool, np.bool_, int, np.integer)) and value in (0, 1):
        return bool(value)
    raise TypeError(f"{name} is True or False, not {value!r}")


def setting(name: str, value: Any) -> str:
    """As the description would write it. A number without a unit is a pure number."""
    if isinstance(value, str):
        return text(name, value)
    if isinstance(value, (bool, np.bool_)):
        return "yes" if value else "no"
    if isinstance(value, tuple) and len(value) == 2:
        return f"{setting(name, value[0])} {text('unit of ' + name, value[1])}"
    try:
        number = real(name, value)
    except TypeError:
        raise TypeError(f'{name} = {value!r}: a text as the description has it ("230 deg"), a pair '
                        '(230, "deg") or a pure number is needed') from None
    if not math.isfinite(number):
        raise refused(f"{name} = {value!r}: not a finite number")
    return repr(int(number)) if number.is_integer() and abs(number) < 1e15 else repr(number)


def setting_name(name: Any) -> str:
    """Of a parameter or an attribute."""
    if not isinstance(name, str) or not name:
        raise TypeError('set takes names of parameters ("arc") and attributes '
                        f'("flexure[leg]/@width"), not {name!r}')
    return text("a name in set", name)


def options(given: Mapping[str, Any]) -> Dict[str, Any]:
    """Options of fw_design_options by their names, without those that are None."""
    out: Dict[str, Any] = {}
    for name, value in given.items():
        if name not in _TYPES:
            near = difflib.get_close_matches(str(name), OPTIONS, 1)
            hint = f"; did you mean {near[0]}?" if near else f"; there are {', '.join(OPTIONS)}"
            raise TypeError(f"there is no option {name}{hint}")
        if value is None:
            continue
        if name in TRUTHS:
            out[name] = int(truth(name, value))
        elif name in PATHS:
            out[name] = path(name, value)
        elif name == "effects" and isinstance(value, (list, tuple, set, frozenset)):
            out[name] = ",".join(text(name, effect) for effect in value)
        elif name == "memory_cap":
            out[name] = whole(name, value, 0, MOST_SIZE)
        elif _TYPES[name] is c_char_p:
            out[name] = text(name, value)
        elif _TYPES[name] is c_double:
            out[name] = real(name, value)
        else:
            out[name] = whole(name, value)
    return out


def raw(name: str, value: Any) -> Any:
    """An option as its field has it."""
    if not isinstance(value, str):
        return value
    return os.fsencode(value) if name in PATHS else value.encode()
