# SPDX-License-Identifier: GPL-3.0-or-later
"""What a device answers. All numbers are SI and come from the library as they are."""
from __future__ import annotations

import base64
import functools
import json
from typing import Any, Dict, Mapping, Optional, Tuple

import numpy as np

from ._design import DOCUMENTS, Design
from .errors import Diagnostic
from .tables import ByName, Named, Row, Table, table


def picture_of(svg: str) -> str:
    """A picture as an image of a page: what makes pages from notebooks refuses the declaration of an SVG document that
    stands in its text, or drops the elements that HTML does not have, and names in two pictures of a page may meet."""
    return ('<img style="max-width:100%" src="data:image/svg+xml;base64,'
            + base64.b64encode(svg.encode()).decode() + '"/>')


def element_of(svg: str) -> str:
    """The element of an SVG document, without what stands before it."""
    return svg[svg.index("<svg"):]


class Result:
    """Of one design: documents, diagnostics, numbers."""

    _json: str = ""
    _text: str = ""
    _svg: str = ""
    _stages: Tuple[str, ...] = ()  #: calls of the library that make it

    def __init__(self, design: Design) -> None:
        self._design = design

    @property
    def diagnostics(self) -> Tuple[Diagnostic, ...]:
        """Everything that was said of the description and of this result, notes and warnings too."""
        return self._design.said("read_memory", *self._stages)

    @property
    def unreliable(self) -> bool:
        """A diagnostic says that the numbers are not to be relied on."""
        return self._design.unreliable

    @functools.cached_property
    def json(self) -> Dict[str, Any]:
        """The JSON document of the command of the same name, read."""
        return json.loads(self._design.document(self._json))

    @property
    def text(self) -> str:
        """What the command prints on a terminal."""
        return self._design.document(self._text)

    @property
    def svg(self) -> str:
        """A picture, as an SVG document."""
        return self._design.document(self._svg)

    def document(self, name: str) -> str:
        """Another document of the same stage: "motion_csv", "forces_csv", "report_html", ..."""
        if name not in DOCUMENTS:
            raise KeyError(f"{name!r}: there are {', '.join(DOCUMENTS)}")
        return self._design.document(name)

    def cancel(self) -> None:
        """Asks a running call of this result to stop; from any thread."""
        self._design.cancel()

    def __reduce_ex__(self, _protocol: Any):
        raise TypeError(f"a {type(self).__name__} stands on memory of the library and does not pass between processes: return "
                        "what is wanted of it (numbers, .json, tables and arrays do pass), or the Device, and ask it there")

    def __copy__(self) -> "Result":  # nothing of it changes
        return self

    def __deepcopy__(self, _known: Any) -> "Result":
        return self

    def _repr_svg_(self) -> str:
        return element_of(self.svg)

    def _repr_html_(self) -> str:
        return picture_of(self.svg)

    def _named(self, numbers: str, array: str, axis: int) -> Named:
        return Named(self._design.numbers(numbers)[array], axis)

    def _values(self, numbers: str, array: str) -> np.ndarray:
        return self._design.numbers(numbers)[array].values


class Utilisation(float):
    """Share of the elastic limit that a hinge uses; above 1 is too much."""

    low: float  #: its band: at least
    high: float  #: its band: at most
    made: Optional["Utilisation"]  #: of the tightest device that a flow may make; None: not judged

    def __new__(cls, value: float, low: float, high: float,
                made: Optional["Utilisation"] = None) -> "Utilisation":
        self = super().__new__(cls, value)
        self.low, self.high, self.made = float(low), float(high), made
        return self

    def __getnewargs__(self):
        return float(self), self.low, self.high, self.made

    @property
    def band(self) -> Tuple[float, float]:
        """(low, high)."""
        return self.low, self.high

    @property
    def value(self) -> float:
        """The number alone."""
        return float(self)

    @property
    def drawn(self) -> "Utilisation":
        """As drawn: this one."""
        return self

    @property
    def worst(self) -> "Utilisation":
        """What decides: as made where that was judged, else as drawn."""
        return self.made if self.made is not None and self.made > self else self


class Verdict(Result):
    """Does any hinge leave its elastic range? `Device.check`."""

    _json, _text, _svg = "verdict_json", "verdict_text", "device_svg"
    _stages = ("judge",)

    @property
    def decision(self) -> str:
        """ "accept", "reject" or "inconclusive", as the program's exit status has it."""
        return {0: "accept", 1: "reject", 4: "inconclusive"}[self._design.decision]

    @property
    def accepted(self) -> bool:
        """The decision is accept."""
        return self._design.decision == 0

    def __repr__(self) -> str:
        made = self.governing["made"]
        check = made if made.what else self.governing["drawn"]
        return f"<Verdict {self.decision}: {check.what} uses {check.used:.4g}>"

    @functools.cached_property
    def hinges(self) -> Table:
        """A row per hinge: utilisation, angles (rad), strains, as drawn and as made (made_...)."""
        return table(self._design, "hinges")

    @functools.cached_property
    def flow_hinges(self) -> Table:
        """The same, a row per flow and hinge."""
        return table(self._design, "flow_hinges")

    @functools.cached_property
    def utilisation(self) -> Mapping[str, Utilisation]:
        """By hinge: a float, as drawn, with its band; `.made` is that of the device as made."""
        h = self.hinges

        def made(i: int) -> Optional[Utilisation]:
            if np.isnan(h["made_utilisation"][i]):
                return None
            return Utilisation(h["made_utilisation"][i], h["made_utilisation_low"][i],
                               h["made_utilisation_high"][i])

        return ByName({id_: Utilisation(h["utilisation"][i], h["utilisation_low"][i],
                                        h["utilisation_high"][i], made(i))
                       for i, id_ in enumerate(h["id"])})

    @functools.cached_property
    def flows(self) -> Table:
        """A row per flow: verdict, manufacturable (1, 0, -1: not guaranteed), total_time (s)."""
        return table(self._design, "flows")

    @functools.cached_property
    def governing(self) -> Table:
        """Rows "made" and "drawn": what decides, and the share of what is allowed that it uses."""
        return table(self._design, "governing")

    @functools.cached_property
    def clearances(self) -> Table:
        """How near what moves comes to what it may meet (m), a row per scene and flow."""
        return table(self._design, "clearances")

    @functools.cached_property
    def requirements(self) -> Table:
        """What is asked of the probes, in SI of each row's `unit`."""
        return table(self._design, "requirements")

    @functools.cached_property
    def probes(self) -> Table:
        """What the probes saw, in SI of each row's `unit`; a row per probe, scene and flow."""
        return table(self._design, "probes")

    @property
    def advice(self) -> Tuple[str, ...]:
        """Changes that would be accepted, in words."""
        return tuple(item if isinstance(item, str) else item.get("text", "")
                     for item in self.json.get("advice") or ())

    def _repr_html_(self) -> str:
        return (f"<p><b>{self.decision}</b></p>{picture_of(self.svg)}{self.hinges._repr_html_()}")


class Motion(Result):
    """One scene in time. `Device.simulate`. Arrays are views of the library's memory."""

    _json, _text, _svg = "simulate_json", "simulate_text", "animation_svg"
    _stages = ("simulate",)

    @property
    def t(self) -> np.ndarray:
        """Time of every row, s, shape (rows,)."""
        return self._values("motion", "t")

    @property
    def q(self) -> Named:
        """By body: x, y, phi of its reference frame, m, m, rad, shape (rows, 3)."""
        return self._named("motion", "q", 1)

    @property
    def v(self) -> Named:
        """By body: velocities of its reference frame, m/s, m/s, rad/s, shape (rows, 3)."""
        return self._named("motion", "v", 1)

    @property
    def a(self) -> Named:
        """By body: accelerations of its reference frame, m/s^2, m/s^2, rad/s^2, shape (rows, 3)."""
        return self._named("motion", "a", 1)

    @property
    def com(self) -> Named:
        """By body: x, y of its centre of mass, m, shape (rows, 2)."""
        return self._named("motion", "com", 1)

    @property
    def angle(self) -> Named:
        """By revolute joint: rotation from its free angle, rad, shape (rows,)."""
        return self._named("motion", "angle", 1)

    @property
    def force(self) -> Named:
        """By revolute joint: force on its body b, N, world axes, shape (rows, 2)."""
        return self._named("motion", "force", 1)

    @property
    def joint_force(self) -> Named:
        """By other joint: force on its body b and torque about its point b, N, N, N m."""
        return self._named("motion", "joint_force", 1)

    @property
    def driver_force(self) -> Named:
        """By driver: force or torque along what it drives, N or N m, shape (rows,)."""
        return self._named("motion", "driver_force", 1)

    @property
    def probe(self) -> Named:
        """By probe: what it sees, in SI of `probe_unit[name]`, shape (rows,)."""
        return self._named("motion", "probe", 1)

    @property
    def probe_unit(self) -> Dict[str, str]:
        """SI unit of each probe."""
        return dict(zip(self.probe.names, self._values("motion", "probe_unit")))

    @functools.cached_property
    def peaks(self) -> Table:
        """A row per joint: largest angle (rad), when (s), error (rad); between the rows too."""
        return table(self._design, "peaks")

    @functools.cached_property
    def probes(self) -> Table:
        """A row per probe: extremes with their times and errors."""
        return table(self._design, "motion_probes")

    @property
    def csv(self) -> str:
        """The table of `simulate --csv`, 17 digits."""
        return self._design.document("motion_csv")

    def to_dict(self) -> Dict[str, np.ndarray]:
        """Columns t, BODY.x, BODY.y, BODY.phi, angle.JOINT, probe.PROBE for a table."""
        out = {"t": self.t}
        out.update(self.q.columns())
        out.update(self.angle.columns("angle."))
        out.update(self.probe.columns("probe."))
        return out

    def __repr__(self) -> str:
        return f"<Motion of {len(self.t)} rows over {self.t[-1]:.6g} s>"


class Modes(Result):
    """Small motions. `Device.modes`."""

    _json, _text, _svg = "modes_json", "modes_text", "modes_svg"
    _stages = ("modes",)

    @functools.cached_property
    def table(self) -> Table:
        """A row per mode: f (Hz), omega (rad/s), stiffness (1/s^2), damping_ratio, modal_mass, kind."""
        arrays = dict(self._design.numbers("modes"))
        keep = ("f", "omega", "stiffness", "damping_ratio", "modal_mass", "kind", "bodies")
        return Table({name: arrays[name] for name in keep})

    @property
    def f(self) -> np.ndarray:
        """Undamped natural frequencies, Hz, slow to fast; 0 where there is none."""
        return self._values("modes", "f")

    @property
    def omega(self) -> np.ndarray:
        """The same, rad/s."""
        return self._values("modes", "omega")

    @property
    def eigenvalue(self) -> np.ndarray:
        """Damped eigenvalues, 1/s, complex, shape (modes, 2)."""
        return self._values("modes", "eigenvalue")

    @property
    def damping_ratio(self) -> np.ndarray:
        """Of each mode; NaN: free or unstable."""
        return self._values("modes", "damping_ratio")

    @property
    def shape(self) -> Named:
        """By body: undamped shapes, shape (modes, 3); m, m, rad."""
        return self._named("modes", "shape", 1)

    @property
    def damped_shape(self) -> Named:
        """By body: complex shapes of the first eigenvalue, shape (modes, 3)."""
        return self._named("modes", "damped_shape", 1)

    @property
    def q(self) -> Named:
        """By body: the pose that they are about, m, m, rad, shape (3,)."""
        return self._named("modes", "q", 0)

    @property
    def probe(self) -> Named:
        """By probe of small motions: its value in SI of `probe_unit`."""
        return self._named("modes", "probe", 0)

    @property
    def probe_unit(self) -> Dict[str, str]:
        """SI unit of each probe."""
        return dict(zip(self.probe.names, self._values("modes", "probe_unit")))

    @property
    def frequency_error(self) -> float:
        """Relative, of every frequency; NaN: not known."""
        return float(self._values("modes", "frequency_error")[0])

    def __len__(self) -> int:
        return len(self.f)

    def __repr__(self) -> str:
        return "<Modes " + ", ".join(f"{f:.6g} Hz" for f in self.f[:6]) + ">"


class LoadPath:
    """Equilibria one after the other, from rest to the whole load. `Statics.path`."""

    def __init__(self, statics: "Statics") -> None:
        self._of = statics

    @property
    def factor(self) -> np.ndarray:
        """Of the loads: 0 at rest, 1 all of them, shape (points,)."""
        return self._of._values("load_path", "factor")

    @property
    def q(self) -> Named:
        """By body: pose of its reference frame, m, m, rad, shape (points, 3)."""
        return self._of._named("load_path", "q", 1)

    @property
    def angle(self) -> Named:
        """By revolute joint: rotation, rad, shape (points,)."""
        return self._of._named("load_path", "angle", 1)

    @property
    def force(self) -> Named:
        """By revolute joint: force on its body b, N, shape (points, 2)."""
        return self._of._named("load_path", "force", 1)

    @functools.cached_property
    def table(self) -> Table:
        """A row per point: factor, lowest eigenvalue (1/s^2), negative ones, kind of the point."""
        return Table(self._of._design.numbers("load_path"))

    def __len__(self) -> int:
        return len(self.factor)


class Statics(Result):
    """Equilibrium under the loads of a scene. `Device.statics`."""

    _json, _text, _svg = "statics_json", "statics_text", "statics_svg"
    _stages = ("statics",)

    @property
    def q(self) -> Named:
        """By body: pose of its reference frame, m, m, rad, shape (3,)."""
        return self._named("statics", "q", 0)

    @property
    def rest_q(self) -> Named:
        """The same where nothing acts."""
        return self._named("statics", "rest_q", 0)

    @property
    def com(self) -> Named:
        """By body: its centre of mass, m, shape (2,)."""
        return self._named("statics", "com", 0)

    @property
    def angle(self) -> Named:
        """By revolute joint: rotation from its free angle, rad."""
        return self._named("statics", "angle", 0)

    @property
    def force(self) -> Named:
        """By revolute joint: force on its body b, N, shape (2,)."""
        return self._named("statics", "force", 0)

    @property
    def joint_force(self) -> Named:
        """By other joint: force on its body b and torque about its point b, N, N, N m."""
        return self._named("statics", "joint_force", 0)

    @property
    def driver_force(self) -> Named:
        """By driver: N or N m."""
        return self._named("statics", "driver_force", 0)

    @property
    def eigenvalue(self) -> np.ndarray:
        """Of the tangent stiffness over the mass, 1/s^2, ascending; below 0: unstable."""
        return self._values("statics", "eigenvalue")

    @property
    def stable(self) -> bool:
        """No eigenvalue is below 0."""
        return bool(self._values("statics", "stable")[0])

    @property
    def probe(self) -> Named:
        """By probe: what it sees, in SI of `probe_unit`."""
        return self._named("statics", "probe", 0)

    @property
    def probe_unit(self) -> Dict[str, str]:
        """SI unit of each probe."""
        return dict(zip(self.probe.names, self._values("statics", "probe_unit")))

    @property
    def path(self) -> Optional[LoadPath]:
        """The load path; None: it was not asked for (`statics(path=True)`)."""
        return LoadPath(self) if self._design.numbers("load_path") else None

    def __repr__(self) -> str:
        return f"<Statics, {'stable' if self.stable else 'unstable'}>"


class Assembly(Result):
    """The position with all joints closed. `Device.assemble`."""

    _json, _text, _svg = "assemble_json", "assemble_text", "assemble_svg"
    _stages = ("assemble",)

    @property
    def q(self) -> Named:
        """By body: pose of its reference frame, m, m, rad, shape (3,)."""
        return self._named("assembly", "q", 0)

    @property
    def before(self) -> Named:
        """By body: as the description states it."""
        return self._named("assembly", "before", 0)

    @property
    def moved(self) -> Named:
        """By body: way of its centre of mass, m."""
        return self._named("assembly", "moved", 0)

    @property
    def v(self) -> Optional[Named]:
        """By body: velocities for the rates asked for, m/s, m/s, rad/s; None: not computed."""
        return self._named("assembly", "v", 0) if "v" in self._design.numbers("assembly") else None

    @property
    def force(self) -> Optional[Named]:
        """By revolute joint: force on its body b, N; None: not computed."""
        has = "force" in self._design.numbers("assembly")
        return self._named("assembly", "force", 0) if has else None


class Workspace(Result):
    """Platform poses that the elastic limits leave. `Device.workspace`."""

    _json, _text, _svg = "workspace_json", "workspace_text", "workspace_svg"
    _stages = ("workspace",)

    @property
    def flows(self) -> Tuple[Optional[str], ...]:
        """The flows, in the order of the rows."""
        return tuple(self._values("workspace", "flow"))

    @property
    def volume(self) -> np.ndarray:
        """Proved brackets of the volume, m^2 rad, shape (flows, 2)."""
        return self._values("workspace", "volume")

    @property
    def extents(self) -> np.ndarray:
        """Where x, y (m) and phi (rad) end, seen from the drawn pose: shape (flows, 2, 3), the inner
        end of each proved bracket: these displacements are reached."""
        least, most = self._values("workspace", "least"), self._values("workspace", "most")
        return np.stack([least[:, 1], most[:, 0]], axis=1)

    @property
    def limit_angle(self) -> Named:
        """By hinge: rotation at the limit, rad, shape (flows,)."""
        return self._named("workspace", "limit_angle", 1)

    @property
    def certificate(self) -> Dict[str, Any]:
        """Proofs of the required boxes, for other programs to verify."""
        return json.loads(self._design.document("certificate_json"))


class Tradeoff(Result):
    """What accuracy costs. `Device.tradeoff`."""

    _json, _text, _svg = "tradeoff_json", "tradeoff_text", "tradeoff_svg"
    _stages = ("tradeoff",)

    @property
    def csv(self) -> str:
        """The same numbers as a table."""
        return self._design.document("tradeoff_csv")


class Fabrication(Result):
    """Masks and recipes. `Device.fabricate`."""

    _json, _text, _svg = "recipes_json", "verdict_text", "device_svg"
    _stages = ("judge", "fabricate")

    @staticmethod
    def _by_flow(document: Dict[str, Any], several: str) -> Dict[str, Dict[str, Any]]:
        items = document[several] if several in document else [document]
        return ByName({item["flow"]: item for item in items})

    @functools.cached_property
    def masks(self) -> Dict[str, Dict[str, Any]]:
        """By flow: the certificate of its mask: layers, areas, widths, findings."""
        return self._by_flow(json.loads(self._design.document("masks_json")), "masks")

    @functools.cached_property
    def recipes(self) -> Dict[str, Dict[str, Any]]:
        """By flow: its run sheet: steps, times, quantities."""
        return self._by_flow(self.json, "recipes")

    def steps(self, flow: Optional[str] = None) -> Dict[str, list]:
        """Columns of a flow's steps for a table: id, title, time (s, None: not computable)."""
        recipe = self.recipes[flow] if flow else next(iter(self.recipes.values()))
        of = recipe["steps"]
        return {"id": [s["id"] for s in of], "title": [s["title"] for s in of],
                "time": [s["time_s"]["nominal"] if s["time_s"] else None for s in of],
                "not_computable": [", ".join(s["not_computable"]) for s in of]}


__all__ = ["Assembly", "Fabrication", "LoadPath", "Modes", "Motion", "Result", "Row", "Statics",
           "Table", "Tradeoff", "Utilisation", "Verdict", "Workspace"]
