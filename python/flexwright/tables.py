# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers with their names and units: columns by row, and arrays by what an index stands for."""
from __future__ import annotations

import html
from collections.abc import Mapping as MappingABC
from types import SimpleNamespace
from typing import Any, Dict, Iterator, List, Optional, Tuple, Union

import numpy as np

from ._design import Array, Design


class Row(SimpleNamespace):
    """One row of a Table; its columns are attributes."""

    def to_dict(self) -> Dict[str, Any]:
        """The columns as a plain dict."""
        return dict(vars(self))


def _plain(value: Any) -> Any:
    return value.item() if isinstance(value, np.generic) else value


class ByName(dict):
    """Values by name; a name that is not there is told which are."""

    def __missing__(self, name: str) -> Any:
        raise KeyError(f"{name!r}: there are {', '.join(self) or 'none'}")


class Table(dict):
    """Columns by name, as NumPy arrays of equal length: `pandas.DataFrame(table)` takes it as it is.

    `table["utilisation"]` is a column; `table["A"]` the row of that label, where no column is called
    so; `units` and `about` say what the columns are, `labels` what the rows are.
    """

    def __init__(self, arrays: Dict[str, Array]) -> None:
        rows = {name: a for name, a in arrays.items() if a.values.ndim == 1}
        super().__init__((name, a.values) for name, a in rows.items())
        first = next(iter(rows.values()), None)
        self.units: Dict[str, str] = {name: a.unit for name, a in rows.items()}
        self.about: Dict[str, str] = {name: a.about for name, a in rows.items()}
        self.labels: Tuple[str, ...] = (first.labels[0] or ()) if first else ()
        self.count: int = len(first.values) if first else 0

    def __missing__(self, label: str) -> Row:
        if label in self.labels:
            return self.row(self.labels.index(label))
        raise KeyError(f"{label!r}: neither a column ({', '.join(self)}) nor a row "
                       f"({', '.join(dict.fromkeys(self.labels))})")

    def row(self, which: Union[int, str]) -> Row:
        """A row by its number, or the first of that label."""
        if isinstance(which, str):
            which = self.labels.index(which)
        return Row(**{name: _plain(column[which]) for name, column in self.items()})

    @property
    def rows(self) -> List[Row]:
        """All rows."""
        return [self.row(i) for i in range(self.count)]

    def to_dict(self) -> Dict[str, list]:
        """The columns as plain lists."""
        return {name: column.tolist() for name, column in self.items()}

    def _repr_html_(self) -> str:
        def cell(value: Any) -> str:
            return html.escape("" if value is None else
                               f"{value:.6g}" if isinstance(value, float) else str(value))

        head = "".join(f"<th title='{html.escape(self.about[name])}'>{html.escape(name)}"
                       + (f"<br/><small>{html.escape(self.units[name])}</small>"
                          if self.units[name] not in ("", "1", "*") else "") + "</th>"
                       for name in self)
        body = "".join("<tr>" + "".join(f"<td>{cell(v)}</td>" for v in vars(row).values()) + "</tr>"
                       for row in self.rows)
        # forty columns are wider than a page: the table is moved in its own frame, not the page
        return ("<div style='overflow-x:auto;max-width:100%'><table>"
                f"<thead><tr>{head}</tr></thead><tbody>{body}</tbody></table></div>")


class Named(MappingABC):
    """An array of which one axis counts things with names: `m.q["CD"]`, `m.angle["A"]`.

    Everything is a view of the library's memory: nothing is copied, and nothing can be written.
    """

    def __init__(self, array: Array, axis: int) -> None:
        self.array: np.ndarray = array.values  #: all of it
        self.unit: str = array.unit  #: "m,m,rad": one for each value of the last axis
        self.about: str = array.about  #: a sentence
        self.names: Tuple[str, ...] = array.labels[axis] or ()  #: what can be asked for
        last = array.labels[-1] if axis < array.values.ndim - 1 else None
        self.components: Tuple[str, ...] = last or ()  #: of the last axis: x, y, phi
        self._axis = axis

    def __getitem__(self, key: Union[str, Tuple[str, str]]) -> np.ndarray:
        name, component = key if isinstance(key, tuple) else (key, None)
        if name not in self.names:
            raise KeyError(f"{name!r}: there are {', '.join(self.names) or 'none'}")
        view = self.array[(slice(None),) * self._axis + (self.names.index(name),)]
        if component is None:
            return view
        if component not in self.components:
            raise KeyError(f"{component!r}: there are {', '.join(self.components) or 'none'}")
        return view[..., self.components.index(component)]

    def __iter__(self) -> Iterator[str]:
        return iter(self.names)

    def __len__(self) -> int:
        return len(self.names)

    def __repr__(self) -> str:
        return f"<{', '.join(self.names)}: {self.about}, {self.unit}>"

    def columns(self, prefix: str = "") -> Dict[str, np.ndarray]:
        """Every series by its name, "CD.x": for tables; of arrays whose first axis counts rows."""
        out: Dict[str, np.ndarray] = {}
        for name in self.names:
            for part in self.components or (None,):
                key = prefix + name + (f".{part}" if part else "")
                out[key] = self[name, part] if part else self[name]
        return out


def truth(value: int) -> Optional[bool]:
    """Of a column of type truth: True, False, or None where it is not known."""
    return None if value < 0 else bool(value)


def table(design: Design, name: str) -> Table:
    """A set of numbers as a Table."""
    return Table(design.numbers(name))


__all__ = ["Named", "Row", "Table", "table", "truth"]
