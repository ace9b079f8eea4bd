#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""test_package.py BUILD: the Python package against the documents of the program."""
import base64
import copy
import csv
import errno
import faulthandler
import gc
import io
import json
import math
import os
import pathlib
import pickle
import re
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import weakref
from unittest import mock

import common  # first: it names the library
import flexwright
import numpy as np
from common import GALLERY, PROGRAM, ROOT, SIX_BAR
from flexwright import _design, _library

COMB = str(GALLERY / "comb-stage" / "device.xml")
GRIPPER = str(GALLERY / "free-form-gripper" / "device.xml")
TENDONS = str(GALLERY / "four-tendons" / "device.xml")


def program(*arguments, may=(0, 1, 4)):
    """What the program prints."""
    done = subprocess.run([str(PROGRAM), *arguments], capture_output=True, text=True, check=False)
    assert done.returncode in may, done.stderr
    return done.stdout


class Header(unittest.TestCase):
    """The package's tables are those of flexwright.h."""

    header = re.sub(r"/\*.*?\*/", "", (ROOT / "include/flexwright.h").read_text(), flags=re.S)

    def fields(self, struct):
        body = re.search(r"typedef struct %s \{(.*?)\} %s;" % (struct, struct), self.header, re.S)
        out = []
        for line in body.group(1).split(";"):
            out += [re.sub(r"\[.*|.*[\s*]", "", part.strip()) for part in line.split(",")]
        return [name for name in out if name]

    def test_structs(self):
        for name, struct in (("fw_design_options", _library.OptionsStruct),
                             ("fw_diagnostic", _library.DiagnosticStruct),
                             ("fw_array", _library.ArrayStruct),
                             ("fw_study_settings", _library.StudySettingsStruct)):
            self.assertEqual(self.fields(name), [f[0] for f in struct._fields_])

    def test_numbers_and_documents(self):
        from flexwright import _design
        for prefix, mine in (("FW_NUMBERS_", _design.NUMBERS),
                             ("FW_DOCUMENT_", {k: v[0] for k, v in _design.DOCUMENTS.items()}),
                             ("FW_DESIGN_", flexwright.device.WRITES)):
            theirs = {k.lower(): int(v)
                      for k, v in re.findall(prefix + r"(\w+) = (\d+)", self.header)}
            theirs.pop("everything", None)
            self.assertEqual(mine, theirs)

    def test_functions(self):
        known = set(re.findall(r"^FW_API [^;{]*?(\w+)\(", self.header, flags=re.M))
        self.assertLessEqual(set(_library._FUNCTIONS), known)


class Check(unittest.TestCase):
    """The verdict's numbers are those of verdict.json."""

    def compare(self, file, **options):
        v = flexwright.Device(file).check(**options)
        document = json.loads(program("check", file, "--json"))
        self.assertEqual(v.decision, document["verdict"])
        self.assertEqual([h["id"] for h in document["hinges"]], list(v.utilisation))
        for h in document["hinges"]:
            u = v.utilisation[h["id"]]
            row = v.hinges[h["id"]]
            self.assertEqual(h["utilisation"], float(u))
            self.assertEqual(tuple(h["utilisation_band"]), u.band)
            self.assertEqual(h["peak_angle_rad"], row.peak_angle)
            self.assertEqual(h["limit_angle_rad"], row.limit_angle)
            self.assertEqual(h["peak_strain"], row.peak_strain)
            self.assertEqual((h["scene"], h["flow"], h["verdict"]),
                             (row.scene, row.flow, row.verdict))
            made = h["as_fabricated"]
            if made is None:
                self.assertIsNone(u.made)
                self.assertTrue(math.isnan(row.made_utilisation))
            else:
                self.assertEqual(made["utilisation"], float(u.made))
                self.assertEqual(tuple(made["utilisation_band"]), u.made.band)
                self.assertEqual((made["corner"], made["flow"], made["most"], made["sigma"]),
                                 (row.made_corner, row.made_flow, row.made_most, row.made_sigma))
        self.assertEqual(len(document["clearances"]), v.clearances.count)
        for c, row in zip(document["clearances"], v.clearances.rows):
            self.assertEqual((c["clearance_m"], c["low_m"], c["a"], c["verdict"]),
                             (row.clearance, row.clearance_low, row.a, row.verdict))
        self.assertEqual(len(document["requirements"]), v.requirements.count)
        for r, row in zip(document["requirements"], v.requirements.rows):
            self.assertEqual((r["probe"], r["unit"], r["verdict"]),
                             (row.probe, row.unit, row.verdict))
            self.assertEqual(r["value"] if r["value"] is not None else "none",
                             row.value if not math.isnan(row.value) else "none")
        for p, row in zip(document.get("probes", []), v.probes.rows):
            self.assertEqual((p["id"], p["peak"], p["final"]), (row.id, row.peak, row.final))
        for f, row in zip(document["flows"], v.flows.rows):
            self.assertEqual((f["id"], f["verdict"], f["manufacturable"]),
                             (row.id, row.verdict, flexwright.truth(row.manufacturable)))
        for key, label in (("governing", "made"), ("governing_drawn", "drawn")):
            if document[key]:
                self.assertEqual(document[key]["what"], v.governing[label].what)
        return v

    def test_six_bar(self):
        v = self.compare(SIX_BAR)
        self.assertTrue(v.accepted)
        self.assertEqual(v.flow_hinges.count, 12)
        self.assertIn("<svg", v.svg)
        self.assertIn("hinge A", repr(v))

    def test_gripper(self):
        v = self.compare(GRIPPER)
        self.assertGreater(v.requirements.count + v.probes.count, 0)
        self.assertIn("<table>", v.hinges._repr_html_())

    def test_rejected_is_a_result(self):
        v = flexwright.Device(SIX_BAR, set={"flexure[A]/@length": "75 um"}).check(advice="none")
        self.assertEqual(v.decision, "reject")
        self.assertGreater(v.utilisation["A"].low, 1)

    def test_same_question_same_answer(self):
        d = flexwright.Device(SIX_BAR)
        self.assertIs(d.check()._design, d.check()._design)
        self.assertIsNot(d.check()._design, d.check(accuracy=1e-4)._design)


class Arrays(unittest.TestCase):
    """Motions, modes and equilibria against the documents; nothing is copied."""

    def compare_motion(self, file, scene):
        m = flexwright.Device(file).simulate(scene, samples=101)
        rows = list(csv.reader(io.StringIO(m.csv)))
        table = np.array(rows[1:], dtype=float)
        column = {name: table[:, i] for i, name in enumerate(rows[0])}
        np.testing.assert_array_equal(column["t_s"], m.t)
        for body in m.q:
            for k, part in enumerate(("x_m", "y_m", "phi_rad")):
                np.testing.assert_array_equal(column[f"{body}.{part}"], m.q[body][:, k])
            for k, part in enumerate(("vx_m_per_s", "vy_m_per_s", "omega_rad_per_s")):
                np.testing.assert_array_equal(column[f"{body}.{part}"], m.v[body][:, k])
            if f"{body}.com_x_m" in column:
                np.testing.assert_array_equal(column[f"{body}.com_x_m"], m.com[body, "x"])
        for probe in m.probe:
            name, = [c for c in column if c.startswith(probe + ".")]
            np.testing.assert_array_equal(column[name], m.probe[probe])
        for p in m.json["peaks"]:
            row = m.peaks[p["hinge"]]
            self.assertEqual((p["angle_rad"], p["t_s"], p["error_rad"]),
                             (row.angle, row.t, row.error))
            self.assertLessEqual(np.abs(m.angle[p["hinge"]]).max(),
                                 abs(row.angle) * (1 + 1e-9) + row.error)
        self.assertEqual([p["id"] for p in m.json["probes"]], list(m.probes.get("id", [])))
        forces = list(csv.reader(io.StringIO(m.document("forces_csv"))))
        for i, name in enumerate(forces[0]):
            for joint in m.force:
                if name == f"{joint}.fx_N":
                    np.testing.assert_array_equal(
                        np.array([float(r[i]) for r in forces[1:]]), m.force[joint, "x"])
        return m

    def test_six_bar(self):
        m = self.compare_motion(SIX_BAR, "step-load")
        self.assertEqual(m.q["CD"].shape, (101, 3))
        self.assertEqual(m.a["CD"].shape, (101, 3))
        self.assertEqual(m.angle["A"].shape, (101,))
        self.assertEqual(sorted(m.to_dict())[0], "AB.phi")
        self.assertEqual((m.q.unit, m.v.unit), ("m,m,rad", "m/s,m/s,rad/s"))

    def test_comb(self):
        self.compare_motion(COMB, None)

    def test_frames(self):
        m = self.compare_motion(GRIPPER, None)
        self.assertGreater(np.abs(m.com.array - m.q.array[:, :, :2]).max(), 0)

    def test_no_copy(self):
        m = flexwright.Device(SIX_BAR).simulate()
        view = m.angle["A"]
        self.assertTrue(np.shares_memory(view, m.angle.array))
        self.assertTrue(np.shares_memory(m.q["CD"], m.q.array))
        self.assertEqual(m.q.array.ctypes.data, m._design.numbers("motion")["q"].values.ctypes.data)
        self.assertFalse(view.flags.writeable)
        with self.assertRaises(ValueError):
            view[0] = 1

    def test_arrays_keep_the_design(self):
        view = flexwright.Device(SIX_BAR).simulate().q["CD"]
        before = view.copy()
        for _ in range(5):  # what would be in freed memory
            gc.collect()
            flexwright.Device(SIX_BAR).simulate("gentle-step")
        np.testing.assert_array_equal(before, view)

    def test_modes(self):
        for at in ("rest", "equilibrium"):
            m = flexwright.Device(SIX_BAR).modes(at=at)
            document = m.json["modes"]
            self.assertEqual(len(m), len(document))
            for i, mode in enumerate(document):
                self.assertEqual((mode["f_Hz"], mode["kind"]), (m.f[i], m.table["kind"][i]))
                self.assertEqual(complex(*mode["eigenvalue_per_s"]), m.eigenvalue[i, 0])
                for body, shape in mode["shape"].items():
                    self.assertEqual(shape, m.shape[body][i].tolist())
                for body, shape in mode["damped_shape"].items():
                    self.assertEqual([complex(*z) for z in shape], m.damped_shape[body][i].tolist())

    def test_statics(self):
        s = flexwright.Device(SIX_BAR).statics("step-load", path=True)
        self.assertTrue(s.stable)
        for body, pose in s.json["q"].items():
            self.assertEqual(pose, s.q[body].tolist())
        for hinge in s.json["hinges"]:
            self.assertEqual((hinge["angle_rad"], hinge["force_N"]),
                             (float(s.angle[hinge["hinge"]]), s.force[hinge["hinge"]].tolist()))
        self.assertEqual(s.json["eigenvalues_per_s2"], s.eigenvalue.tolist())
        self.assertEqual(s.path.factor[-1], 1)
        np.testing.assert_allclose(s.path.angle["A"][-1], float(s.angle["A"]), rtol=1e-9)
        self.assertIsNone(flexwright.Device(SIX_BAR).statics("step-load").path)

    def test_assembly_and_workspace(self):
        d = flexwright.Device(SIX_BAR)
        a = d.assemble()
        for body, pose in a.json["after"].items():
            self.assertEqual(pose, a.q[body].tolist())
        w = d.workspace()
        for i, flow in enumerate(w.json["flows"]):
            self.assertEqual(w.flows[i], flow["flow"])
            self.assertEqual(w.volume[i].tolist(), flow["reachable"]["volume"]["m2_rad"])
            self.assertEqual(flow["reachable"]["limit_rad"]["A"], w.limit_angle["A"][i])
            for k, part in enumerate(("x_m", "y_m", "phi_rad")):
                least, most = flow["reachable"]["extents"][part]
                self.assertEqual([least[1], most[0]], w.extents[i, :, k].tolist())

    def test_unknown_names_say_what_there_is(self):
        m = flexwright.Device(SIX_BAR).simulate()
        with self.assertRaisesRegex(KeyError, "AB, BC, CD"):
            m.q["XY"]
        with self.assertRaisesRegex(KeyError, "x, y, phi"):
            m.q["CD", "z"]
        with self.assertRaisesRegex(KeyError, "utilisation"):
            flexwright.Device(SIX_BAR).check().hinges["nix"]


class Descriptions(unittest.TestCase):
    """What a device is, how it is changed, what is wrong with it."""

    def test_parameters(self):
        d = flexwright.Device(SIX_BAR, arc="230 deg")
        arc = d.parameters["arc"]
        self.assertAlmostEqual(arc.value, math.radians(230), 12)
        self.assertEqual((arc.unit, arc.written_unit, arc.overridden), ("rad", "deg", 1))
        self.assertEqual(d.scenes, ("step-load", "gentle-step"))
        self.assertEqual(flexwright.Device(SIX_BAR, arc=(230, "deg")).parameters["arc"].value,
                         arc.value)
        other = d.with_(link="115 um")
        self.assertAlmostEqual(other.parameters["link"].value, 115e-6, 15)
        self.assertEqual(other.parameters["arc"].value, arc.value)
        self.assertAlmostEqual(d.parameters["link"].value, 120e-6, 15)

    def test_errors_have_places(self):
        text = pathlib.Path(SIX_BAR).read_text().replace('width="9 um"', 'width="9 umm"', 1)
        with self.assertRaises(flexwright.InputError) as caught:
            flexwright.Device.from_text(text, name="bad.xml")
        error = caught.exception
        lines = text.splitlines()
        at = next(i for i, line in enumerate(lines) if "umm" in line)
        self.assertEqual((error.file, error.line), ("bad.xml", at + 1))
        self.assertEqual(lines[at][error.column - 1:][:3], 'umm')
        self.assertRegex(str(error), r"^bad\.xml:\d+:\d+: error: .*\[FW-D\d{3}\]")
        self.assertIsInstance(error, ValueError)
        again = pickle.loads(pickle.dumps(error))
        self.assertEqual((again.line, again.code, str(again)), (error.line, error.code, str(error)))

    def test_all_mistakes_at_once(self):
        text = pathlib.Path(SIX_BAR).read_text().replace("8 um", "8 umm")
        with self.assertRaises(flexwright.InputError) as caught:
            flexwright.Device.from_text(text)
        self.assertGreaterEqual(len(caught.exception.errors), 6)

    def test_wrong_use(self):
        d = flexwright.Device(SIX_BAR)
        with self.assertRaises(FileNotFoundError) as caught:
            flexwright.Device("there-is-none.xml")
        self.assertIsInstance(caught.exception, flexwright.FileError)
        self.assertEqual((caught.exception.code, caught.exception.file), ("FW-D220", "there-is-none.xml"))
        with self.assertRaisesRegex(flexwright.InputError, "step-load gentle-step"):
            d.simulate("nix")
        with self.assertRaisesRegex(TypeError, "did you mean accuracy"):
            d.check(acuracy=1e-3)
        with self.assertRaises(flexwright.UsageError):
            d.check(accuracy=5.0)
        with self.assertRaises(flexwright.InputError) as caught:
            flexwright.Device(SIX_BAR, nix="1 um")
        self.assertTrue(caught.exception.diagnostics)
        with self.assertRaises(ValueError):
            flexwright.Device(SIX_BAR, arc=math.nan)
        self.assertTrue(d.check().accepted)  # and is as it was

    def test_drawings_beside_the_file(self):
        with tempfile.TemporaryDirectory() as directory:
            file = os.path.join(directory, "device.xml")
            text = pathlib.Path(GRIPPER).read_text()
            with open(file, "w", encoding="utf-8") as out:
                out.write(text)
            names = set(re.findall(r'"([\w.-]+\.(?:dxf|gds))"', text))
            for name in names:
                data = (GALLERY / "free-form-gripper" / name).read_bytes()
                pathlib.Path(directory, name).write_bytes(data)
            self.assertEqual(flexwright.Device(file).check(advice="none").decision,
                             flexwright.Device.from_text(text, directory=directory)
                             .check(advice="none").decision)

    def test_between_processes(self):
        d = pickle.loads(pickle.dumps(flexwright.Device(SIX_BAR, arc="230 deg")))
        self.assertEqual(d.settings, {"arc": "230 deg"})
        self.assertTrue(d.check().accepted)

    def test_a_loop_reads_each_device_once(self):
        """read is a twentieth of a check; with options of the question it was done twice for each"""
        d, seen, call = flexwright.Device(SIX_BAR), [], _design.Design.call

        def told(design, name, *arguments, **named):
            seen.append(name)
            return call(design, name, *arguments, **named)

        with mock.patch.object(_design.Design, "call", told):
            used = [d.with_(arc=(arc, "deg")).check(advice="none", corners="none").utilisation["A"] for arc in (225, 230, 235)]
            self.assertEqual(seen.count("read_memory"), 4)  # the first learns what is asked
            self.assertEqual(used[1], d.with_(arc="230 deg").check(corners="none").utilisation["A"])
            # options of a question that the next device refuses are no reason to refuse it
            other = d.with_(set={"flow[copper-on-porous-silicon]/@thickness": "9.5 um"})
            other.check(flow="al-masked-rie", advice="none", corners="none")
            with self.assertRaises(flexwright.InputError) as caught:
                d.with_(arc="400 deg")
            self.assertIn("arc", str(caught.exception))

    def test_draws_itself(self):
        d = flexwright.Device(SIX_BAR)
        v = d.check()
        self.assertIn("accept", v._repr_html_())
        for shown in (d, v, d.simulate("step-load"), d.modes()):
            self.assertTrue(shown._repr_svg_().startswith("<svg"))
            # a page of a notebook keeps images; of an SVG element in its text nbconvert drops what HTML does not know
            image = re.search(r'<img [^>]*src="data:image/svg\+xml;base64,([^"]+)"/>', shown._repr_html_())
            self.assertIn(shown._repr_svg_(), base64.b64decode(image.group(1)).decode())
            self.assertNotIn("<svg", shown._repr_html_())


class Files(unittest.TestCase):
    """Masks, recipes and what is written."""

    def test_same_files_as_the_program(self):
        with tempfile.TemporaryDirectory() as directory:
            mine, theirs = os.path.join(directory, "mine"), os.path.join(directory, "theirs")
            n = flexwright.Device(SIX_BAR).write(mine, "masks")
            program("mask", SIX_BAR, "-o", theirs, "-q")
            for base, _, files in os.walk(theirs):
                for file in files:
                    a = pathlib.Path(base, file)
                    b = pathlib.Path(mine, a.relative_to(theirs))
                    self.assertEqual(a.read_bytes(), b.read_bytes(), a)
            self.assertGreater(n, 4)
            with self.assertRaises(flexwright.FileError):
                pathlib.Path(directory, "full").mkdir()
                pathlib.Path(directory, "full", "mine.txt").write_text("x")
                flexwright.Device(SIX_BAR).write(os.path.join(directory, "full"), "verdict")

    def test_masks_and_recipes(self):
        f = flexwright.Device(SIX_BAR).fabricate()
        self.assertEqual(sorted(f.masks), ["al-masked-rie", "copper-on-porous-silicon"])
        self.assertEqual(sorted(f.recipes), sorted(f.masks))
        steps = f.steps("al-masked-rie")
        self.assertEqual(len(steps["id"]), len(steps["time"]))
        one = flexwright.Device(SIX_BAR).recipes(flow="al-masked-rie")
        self.assertEqual(list(one), ["al-masked-rie"])


class Lifetimes(unittest.TestCase):
    """What the library holds is freed when nothing uses it any more, arrays included."""

    def freed(self, ask):
        """how many designs of the library are freed when what `ask` answered is let go, without a look for cycles"""
        gc.collect()
        gc.disable()
        try:
            freed, free = [], _design.lib.fw_design_free
            with mock.patch.object(_design.lib, "fw_design_free", lambda pointer: (freed.append(pointer), free(pointer))):
                kept = ask(flexwright.Device(SIX_BAR))
                before = len(freed)
                del kept
                return before, len(freed)
        finally:
            gc.enable()

    def test_numbers_are_let_go(self):
        for ask in (lambda d: d.modes().f.copy(), lambda d: d.simulate(samples=11).q["CD"].copy(),
                    lambda d: float(d.statics().q["CD"][0]), lambda d: d.parameters["arc"].value):
            before, after = self.freed(ask)
            self.assertGreaterEqual(before, 1)  # nothing of the device is left beside the copy
            self.assertEqual(before, after)

    def test_views_and_results_keep_it(self):
        for ask in (lambda d: d.modes().f, lambda d: d.simulate(samples=11).angle["A"], lambda d: d.modes()):
            before, after = self.freed(ask)
            self.assertEqual(after, before + 1)

    def test_a_sweep_lets_go(self):
        known = []

        def measure(device):
            result = device.modes()
            known.append(weakref.ref(result._design))
            return {"f": result.f[0]}

        gc.disable()
        try:
            for _row in flexwright.sweep(SIX_BAR, flexwright.grid(arc=["220 deg", "225 deg", "230 deg"]), measure=measure):
                self.assertEqual([ref() for ref in known], [None] * len(known))
        finally:
            gc.enable()

    def test_what_a_callback_raised_is_let_go(self):
        d = flexwright.Device(SIX_BAR)
        known = []

        def told(_progress):
            known.append(weakref.ref(list(d._busy)[-1]))
            raise KeyError("x")

        gc.collect()
        gc.disable()
        try:
            with self.assertRaises(KeyError):
                d.check(progress=told)
            d.close()
            self.assertIsNone(known[0]())
        finally:
            gc.enable()

    def test_close(self):
        with flexwright.Device(SIX_BAR) as d:
            m = d.simulate(samples=11)
            own = weakref.ref(d._own)
            self.assertTrue(d.parameters["arc"].value > 0)
        self.assertIsNone(own())
        self.assertEqual(m.q["CD"].shape, (11, 3))  # results stay
        self.assertEqual((d.name, "reference-six-bar" in repr(d)), ("reference-six-bar", True))
        with self.assertRaisesRegex(flexwright.UsageError, "closed"):
            d.check()
        with self.assertRaisesRegex(flexwright.UsageError, "closed"):
            d.parameters
        self.assertEqual(d.with_(arc="230 deg").name, "reference-six-bar")

    def test_results_do_not_pass_between_processes(self):
        d = flexwright.Device(SIX_BAR)
        for result in (d.modes(), d.simulate(samples=11), d.statics(path=True)):
            with self.assertRaisesRegex(TypeError, f"a {type(result).__name__} stands on memory of the library .* return"):
                pickle.dumps(result)
            self.assertIs(copy.deepcopy(result), result)
            self.assertIs(copy.copy(result), result)
        m = d.simulate(samples=11)
        np.testing.assert_array_equal(pickle.loads(pickle.dumps(m.q))["CD"], m.q["CD"])
        self.assertEqual(pickle.loads(pickle.dumps(m.peaks))["A"].angle, m.peaks["A"].angle)


class Mistakes(unittest.TestCase):
    """An exception has what its own call said; what the library would cut or turn round is refused by its name."""

    def fails(self, kind, ask):
        with self.assertRaises(kind) as caught:
            ask()
        return caught.exception

    def test_an_exception_is_of_its_call(self):
        d = flexwright.Device(SIX_BAR)
        quick = {"advice": "none", "corners": "none"}
        v = d.check(**quick)
        said = v.diagnostics
        with tempfile.TemporaryDirectory() as full:
            pathlib.Path(full, "mine.txt").write_text("x")
            for _ in range(2):
                error = self.fails(flexwright.FileError, lambda: d.write(full, "verdict", **quick))
                self.assertEqual((error.code, len(error.errors), error.filename), ("FW-D223", 1, full))
            self.assertEqual(self.fails(flexwright.FileError, lambda: d.write("/proc/none/x", "verdict", **quick)).code, "FW-D222")
            for _ in range(110):  # more than a design keeps
                self.fails(flexwright.FileError, lambda: d.write(full, "verdict", **quick))
            again = self.fails(flexwright.FileError, lambda: d.write("/proc/none/x", "verdict", **quick))
        self.assertEqual((again.code, again.file, len(again.diagnostics)), ("FW-D222", "/proc/none/x", 1))
        self.assertEqual(v.diagnostics, said)
        self.assertEqual(d.check(**quick).diagnostics, said)
        self.assertEqual(self.fails(flexwright.UsageError, lambda: d.tradeoff(budget_s=-1)).code, "FW-D230")

    def test_values_that_c_would_cut(self):
        d = flexwright.Device(SIX_BAR)
        for wrong in ({"samples": 2**32 + 11}, {"memory_cap": -1}, {"memory_cap": 2**64}, {"jobs": 2**33}, {"flow": "al-masked-rie\0x"},
                      {"flow": "\udce4"}, {"effects": ["inertia\0"]}, {"directory": "a\0b"}):
            error = self.fails(flexwright.UsageError, lambda wrong=wrong: d.check(**wrong))
            self.assertIn(next(iter(wrong)), str(error))
            self.assertEqual(error.code, "FW-D230")
        for wrong in ({"force": "no"}, {"figures": 2}, {"samples": 11.0}, {"samples": "11"}, {"accuracy": "1e-3"}, {"accuracy": 1j},
                      {"flow": ["al-masked-rie"]}, {"flow": {"a": 1}}, {"flow": b"al-masked-rie"}, {"laboratory": 1}):
            self.assertIn(next(iter(wrong)), str(self.fails(TypeError, lambda wrong=wrong: d.check(**wrong))))
        self.assertIn("path", str(self.fails(TypeError, lambda: d.statics(path="no"))))
        self.assertIn("scene", str(self.fails(flexwright.UsageError, lambda: d.simulate("step-load\0x"))))
        self.assertIn("budget_s", str(self.fails(TypeError, lambda: d.tradeoff(budget_s="x"))))
        self.assertIn("directory", str(self.fails(flexwright.UsageError, lambda: d.write("a\0b"))))
        self.assertIn("write knows", str(self.fails(flexwright.UsageError, lambda: d.write("out", ["verdict"]))))
        self.assertEqual(d.simulate(samples=np.int64(11), accuracy=np.float32(1e-3), force=np.bool_(False)).t.shape, (11,))

    def test_settings(self):
        for value in ("230 deg\0garbage", (230, "deg\0"), math.nan):
            self.assertIn("arc", str(self.fails(flexwright.UsageError, lambda value=value: flexwright.Device(SIX_BAR, arc=value))))
        for value in (None, [230, "deg"], (1, 2, 3), 1j, b"230 deg"):
            self.assertIn("arc = ", str(self.fails(TypeError, lambda value=value: flexwright.Device(SIX_BAR, arc=value))))
        self.fails(flexwright.UsageError, lambda: flexwright.Device(SIX_BAR, set={"arc\0zzz": "230 deg"}))
        self.assertIn("set takes names", str(self.fails(TypeError, lambda: flexwright.Device(SIX_BAR, set={1: "230 deg"}))))
        self.fails(TypeError, lambda: flexwright.Device.from_text(5))
        self.fails(flexwright.UsageError, lambda: flexwright.Device.from_text("<device/>", name="a\0b"))

    def test_names_of_files(self):
        text = pathlib.Path(SIX_BAR).read_bytes()
        self.assertEqual(flexwright.Device(SIX_BAR.encode()).file, SIX_BAR)
        with tempfile.TemporaryDirectory() as here:
            directory = os.path.join(os.fsencode(here), b"bad\xffd")
            os.mkdir(directory)
            with open(os.path.join(directory, b"device.xml"), "wb") as out:
                out.write(text)
            for file in (os.path.join(directory, b"device.xml"), os.fsdecode(os.path.join(directory, b"device.xml"))):
                d = flexwright.Device(file)
                self.assertEqual(d.write(os.path.join(directory, b"out"), "verdict", advice="none", corners="none"), 1)
            self.assertTrue(os.path.exists(os.path.join(directory, b"out", b"verdict.json")))

    def test_errors_of_files_are_those_of_python(self):
        error = self.fails(FileNotFoundError, lambda: flexwright.Device("there-is-none.xml"))
        for one in (error, pickle.loads(pickle.dumps(error))):
            self.assertEqual((one.errno, one.filename, one.strerror), (2, "there-is-none.xml", os.strerror(2)))
        with tempfile.TemporaryDirectory() as here:  # the library looked for these
            out, there = os.path.join(here, "out"), os.path.join(here, "there")
            study = os.path.join(here, "study.xml")
            pathlib.Path(study).write_text('<study xmlns="urn:flexwright:study:1" name="s" kind="sweep" device="gone.xml">'
                                           '<vary what="a" from="1" to="2"/><respond name="U" value="governing.utilisation"/></study>')
            cases = ((lambda: flexwright.run_study("none.xml", out), "none.xml"),
                     (lambda: flexwright.run_study(study, out), os.path.join(here, "gone.xml")),
                     (lambda: flexwright.Device(SIX_BAR).check(laboratory="none.xml"), "none.xml"))
            for call, name in cases:
                other = self.fails(FileNotFoundError, call)
                for one in (other, pickle.loads(pickle.dumps(other))):
                    self.assertIs(type(one), flexwright.MissingFileError)
                    self.assertEqual((one.errno, one.strerror, one.code), (2, os.strerror(2), "FW-D220"))
                    self.assertEqual(one.filename, name)
            os.mkdir(there)
            other = self.fails(flexwright.FileError, lambda: flexwright.run_study(there, out))
            self.assertEqual((type(other), other.errno), (flexwright.FileError, errno.EISDIR))
            self.assertEqual(self.fails(flexwright.FileError, lambda: flexwright.Device(there)).errno, errno.EISDIR)
        self.assertRegex(repr(error), r"^MissingFileError\('there-is-none.xml: error: .*\[FW-D220\]'\)$")
        many = self.fails(flexwright.InputError, lambda: flexwright.Device.from_text(
            pathlib.Path(SIX_BAR).read_text().replace("8 um", "8 umm")))
        self.assertRegex(repr(many), r"^InputError\(.memory:\d+:.*; and \d+ more.\)$")

    def test_memory_cap(self):
        d = flexwright.Device(SIX_BAR)
        error = self.fails(flexwright.MemoryLimitError, lambda: d.simulate(samples=200000, memory_cap=32 << 20))
        self.assertEqual(error.code, "FW-D720")
        self.assertRegex(str(error), "may take 32 MiB.*memory_cap")
        error = self.fails(flexwright.MemoryLimitError, lambda: d.check(memory_cap=1000))
        self.assertIn("memory_cap = 1000 bytes", str(error))


class Working(unittest.TestCase):
    """Cancelling, progress, threads."""

    slow = {"rtol": 1e-13, "samples": 1000000, "integrator": "rk4"}  # seconds, none of which passes

    def test_progress(self):
        told = []
        flexwright.Device(SIX_BAR).check(progress=told.append)
        self.assertGreater(len({p.what for p in told}), 2)
        motion = [p for p in told if p.unit == "s"]
        self.assertTrue(all(0 < p.done <= p.of * (1 + 1e-12) for p in motion))
        self.assertEqual({round(p.of, 9) for p in motion}, {0.01})  # both scenes last 10 ms

    def test_progress_may_end_it(self):
        class Enough(Exception):
            pass

        def told(_progress):
            raise Enough

        d = flexwright.Device(SIX_BAR)
        with self.assertRaises(Enough):
            d.check(progress=told)
        self.assertTrue(d.check().accepted)

    def test_same_with_and_without_being_told(self):
        a = flexwright.Device(SIX_BAR).check(progress=lambda p: None)
        b = flexwright.Device(SIX_BAR).check()
        self.assertEqual(a.document("verdict_json"), b.document("verdict_json"))

    def test_cancel_from_another_thread(self):
        d = flexwright.Device(SIX_BAR)
        told = threading.Event()

        def cancel():
            told.wait(60)
            d.cancel()

        thread = threading.Thread(target=cancel)
        thread.start()
        with self.assertRaises(flexwright.Cancelled):
            d.simulate(progress=lambda p: told.set(), **self.slow)
        thread.join()
        self.assertTrue(d.check().accepted)

    def test_cancel_between_two_calls(self):
        """a cancel that comes when no call of the library runs, before the first or between two stages, is not lost"""
        for moment in ("set", "stage"):
            d = flexwright.Device(SIX_BAR, arc="231 deg")
            usual = getattr(_design.Design, moment)

            def late(design, *arguments, usual=usual, d=d, **more):
                answer = usual(design, *arguments, **more)
                d.cancel()
                return answer

            with mock.patch.object(_design.Design, moment, late):
                with self.assertRaises(flexwright.Cancelled):
                    d.fabricate(advice="none", corners="none", accuracy=1e-2)
            self.assertTrue(d.check(advice="none", corners="none").accepted)

    def test_ctrl_c(self):
        code = ("import sys, flexwright\n"
                f"d = flexwright.Device({SIX_BAR!r})\n"
                "try:\n"
                "    d.simulate(progress=lambda p: print('working', flush=True),\n"
                f"               **{self.slow!r})\n"
                "except KeyboardInterrupt:\n"
                "    print('interrupted', d.check().decision)\n")
        environment = {**os.environ, "PYTHONPATH": str(ROOT / "python")}
        with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True,
                              env=environment) as child:
            self.assertEqual(child.stdout.readline(), "working\n")
            child.send_signal(signal.SIGINT)
            rest = child.stdout.read().splitlines()
            self.assertEqual(rest[-1], "interrupted accept")
            self.assertEqual(child.wait(), 0)

    def test_alarm(self):
        def late(_signal, _frame):
            raise TimeoutError("late")

        before = signal.signal(signal.SIGALRM, late)
        try:
            signal.setitimer(signal.ITIMER_REAL, 0.05)
            with self.assertRaises(TimeoutError):
                flexwright.Device(SIX_BAR).simulate(**self.slow)
        finally:
            signal.signal(signal.SIGALRM, before)

    def test_an_interrupt_when_the_work_has_just_ended(self):
        """Ctrl-C between the end of the work and the next line of the call that waits for it"""
        class Lock:
            asked = 0

            def __init__(self):
                self.lock = threading.Lock()
                self.release = self.lock.release

            def acquire(self):
                self.lock.acquire()
                Lock.asked += 1
                if Lock.asked == 2:  # the first is before the work begins
                    raise KeyboardInterrupt

        d = flexwright.Device(SIX_BAR)
        faulthandler.dump_traceback_later(120, exit=True)
        try:
            with mock.patch.object(_design._thread, "allocate_lock", Lock):
                with self.assertRaises(KeyboardInterrupt):
                    d.simulate(samples=11)
        finally:
            faulthandler.cancel_dump_traceback_later()
        self.assertEqual(Lock.asked, 2)
        self.assertTrue(d.check(advice="none", corners="none").accepted)

    def test_lock_is_given_up(self):
        count, stop = [0], threading.Event()

        def beside():
            while not stop.is_set():
                count[0] += 1
                time.sleep(0)

        d = flexwright.Device(SIX_BAR)
        thread = threading.Thread(target=beside)
        thread.start()
        seen = []
        d.simulate(samples=100001, rtol=1e-13, progress=lambda p: seen.append(count[0]))
        stop.set()
        thread.join()
        self.assertGreater(seen[-1], seen[0])

    def test_threads(self):
        want = flexwright.Device(SIX_BAR).check().document("verdict_json")
        got = []

        def work():
            got.append(flexwright.Device(SIX_BAR).check().document("verdict_json"))

        threads = [threading.Thread(target=work) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(got, [want] * 4)


class Studies(unittest.TestCase):
    """Sweeps and objectives."""

    def test_sweep(self):
        settings = list(flexwright.grid(arc=["220 deg", "230 deg"], link=["115 um", "120 um"]))
        rows = list(flexwright.sweep(SIX_BAR, settings))
        self.assertEqual([(r["arc"], r["link"]) for r in rows],
                         [(s["arc"], s["link"]) for s in settings])
        for row in rows:
            d = flexwright.Device(SIX_BAR, arc=row["arc"], link=row["link"])
            self.assertEqual(float(d.check(advice="none").utilisation["A"]), row["utilisation.A"])
        self.assertEqual(rows, list(flexwright.sweep(SIX_BAR, settings, jobs=2)))
        table = flexwright.columns(rows)
        self.assertEqual(len(table["arc"]), 4)

    def test_a_study_of_the_program(self):
        """run_study and `flexwright study` leave the same bytes; mistakes carry their places"""
        with tempfile.TemporaryDirectory() as here:
            file = os.path.join(here, "s.xml")
            with open(file, "w") as out:
                out.write('<study xmlns="urn:flexwright:study:1" name="s" kind="sweep" as="drawn" '
                          f'device="{SIX_BAR}"><vary what="arc" from="200 deg" to="260 deg" steps="2"/>'
                          '<respond name="U" value="governing.utilisation"/></study>')
            told = []
            mine = flexwright.run_study(file, os.path.join(here, "a"), flow="al-masked-rie",
                                        progress=told.append)
            program("study", file, "-o", os.path.join(here, "b"), "--flow", "al-masked-rie", "--json")
            for name in ("study.json", "study.csv", "study.sqlite", "study.html"):
                with open(os.path.join(here, "a", name), "rb") as a, open(os.path.join(here, "b", name), "rb") as b:
                    self.assertEqual(a.read(), b.read(), name)
            self.assertEqual(mine["samples"]["run"], 2)
            self.assertEqual(told[-1].of, 2)
            with open(file) as text:
                wrong = text.read().replace("governing.", "governing.x")
            with open(file, "w") as out:
                out.write(wrong)
            with self.assertRaises(flexwright.InputError) as caught:
                flexwright.run_study(file, os.path.join(here, "c"))
            self.assertEqual(caught.exception.diagnostics[0].number, 492)
            self.assertEqual(caught.exception.diagnostics[0].line, 1)

    def test_sweep_streams_and_keeps_errors(self):
        def settings():
            yield {"arc": "230 deg"}
            yield {"arc": "230 um"}
            raise AssertionError("asked for ahead of time")

        rows = flexwright.sweep(SIX_BAR, settings(), measure=lambda d: {"u": 1})
        self.assertEqual(next(rows), {"arc": "230 deg", "u": 1})
        self.assertIn("FW-D025", next(rows)["error"])

    def test_an_error_of_a_row_is_the_rows(self):
        def measure(device):
            return {"u": 1 / (device.settings["arc"] != "240 deg")}

        values = [math.nan, "230 deg", "240 deg", None, "235 deg"]
        for jobs in (1, 2):
            rows = list(flexwright.sweep(SIX_BAR, flexwright.grid(arc=values), measure=measure, jobs=jobs))
            self.assertEqual([sorted(set(row) - {"arc"}) for row in rows], [["error"], ["u"], ["error"], ["error"], ["u"]])
            self.assertIn("arc = nan: not a finite number", rows[0]["error"])
            self.assertEqual(rows[2]["error"], "ZeroDivisionError: division by zero")
            self.assertIn("arc = None", rows[3]["error"])
        rows = list(flexwright.sweep(SIX_BAR, [{"arc": "230 deg"}, 5], measure=lambda d: 7))
        self.assertTrue(all(row["error"].startswith("TypeError: ") for row in rows))
        for jobs in (-1, 257):
            with self.assertRaisesRegex(flexwright.UsageError, "jobs = "):
                flexwright.sweep(SIX_BAR, [], jobs=jobs)
        with self.assertRaisesRegex(TypeError, "jobs is a whole number"):
            flexwright.sweep(SIX_BAR, [], jobs=1.5)

    def test_an_alarm_ends_a_sweep(self):
        """what a handler of a signal raises is of whoever set it, and no row's"""
        def late(_signal, _frame):
            raise TimeoutError("late")

        before = signal.signal(signal.SIGALRM, late)
        try:
            signal.setitimer(signal.ITIMER_REAL, 0.3)
            with self.assertRaises(TimeoutError):
                list(flexwright.sweep(SIX_BAR, [{"arc": "230 deg"}], measure=lambda d: {"t": d.simulate(**Working.slow).t[-1]}))
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0)
            signal.signal(signal.SIGALRM, before)

    def test_arguments_of_a_study(self):
        for wrong in ({"jobs": 2**33}, {"study": "a\0b"}, {"set": {"arc": "230 deg\0"}}):
            with self.assertRaisesRegex(flexwright.UsageError, "jobs|study|arc"):
                flexwright.run_study("none.xml", "none", **wrong)
        with self.assertRaisesRegex(TypeError, "resume is True or False"):
            flexwright.run_study("none.xml", "none", resume="no")

    def test_sweep_is_given_up(self):
        slow = {"rtol": 1e-13, "samples": 1000000, "integrator": "rk4"}  # seconds, none of which passes
        started = threading.Event()

        def measure(device):
            device.simulate(progress=lambda p: started.set(), **slow)
            return {}

        def settings():
            yield {"arc": "230 deg"}
            yield {"arc": "240 deg"}
            started.wait(60)
            raise KeyboardInterrupt  # as if it came while the others work

        rows = flexwright.sweep(SIX_BAR, settings(), measure=measure, jobs=2)
        with self.assertRaises(KeyboardInterrupt):
            next(rows)

    def test_advice(self):
        v = flexwright.Device(SIX_BAR, set={"flexure[A]/@length": "75 um"}).check()
        self.assertTrue(v.advice)
        self.assertTrue(all(isinstance(a, str) and a for a in v.advice), v.advice)

    def test_objective_of_scipy(self):
        from scipy.optimize import brentq, minimize_scalar
        base = flexwright.Device(SIX_BAR)

        def most_used(arc_deg):
            v = base.with_(arc=(arc_deg, "deg")).check(advice="none", corners="none")
            return max(v.utilisation.values())

        wanted = 0.63  # falls with the arc: from 0.642 at 200 to 0.617 at 250 degrees
        root = brentq(lambda arc: most_used(arc) - wanted, 200, 250, xtol=1e-3)
        found = minimize_scalar(lambda arc: (most_used(arc) - wanted) ** 2, bounds=(200, 250),
                                method="bounded", options={"xatol": 1e-2})
        self.assertAlmostEqual(most_used(root), wanted, 6)
        self.assertAlmostEqual(found.x, root, 0)


if __name__ == "__main__":
    unittest.main()
