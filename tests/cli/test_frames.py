#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A body's x, y, phi are its reference frame and nothing else: moved over the body, with all points stated anew, it changes
no result beyond round-off. Mass and centre of mass come from what is drawn, or are stated."""
import json
import math
import pathlib
import random
import re
import sys
import tempfile
import unittest
import xml.etree.ElementTree as tree

from common import ALL, ROOT, run

sys.path.insert(0, str(ROOT / "tests/accept"))
import random_devices

NAMES = "{urn:flexwright:device:1}"
# attributes that name a body, and the point that goes with each
POINTS = {"revolute": {"a": "a-", "b": "b-"}, "prismatic": {"a": "a-", "b": "b-"}, "distance": {"a": "a-", "b": "b-"},
          "weld": {"a": "a-", "b": "b-"}, "spring": {"a": "a-", "b": "b-"}, "contact": {"a": "a-", "b": "b-"},
          "force": {"on": ""}, "eyelet": {"on": ""}, "comb-drive": {"on": ""}, "air": {"on": ""},
          "probe": {"on": "", "a": "a-", "b": "b-"}}
# kinds that have no point
WITHOUT = {NAMES + "air": ("slide", "drag"), NAMES + "probe": ("angle", "angular-velocity", "force", "torque", "frequency", "power", "voltage", "current", "capacitance")}
# what is drawn of a body, in its frame, by its points; mirror images about the frame's own axes (symmetry) are not for moving
SHAPES = {"outline": ("",), "plate": ("",), "bar": ("", "to-"), "disc": ("",), "lettering": ("",)}


def moved(text, shift):
    """the description with each body's frame moved by shift[id] (um, in the frame's axes; all phi are 0)"""
    tree.register_namespace("", NAMES[1:-1])
    root = tree.fromstring(text)
    for body in root.iter(NAMES + "body"):
        if "plate-width" in body.attrib:
            for axis in "xy":
                body.attrib.setdefault("plate-" + axis, body.attrib[axis])
        for axis, by in zip("xy", shift.get(body.attrib["id"], (0, 0))):
            body.attrib[axis] = "(%s) + (%.17g um)" % (body.attrib[axis], by)
            if "mass" in body.attrib:
                body.attrib["com-" + axis] = "(%s) - (%.17g um)" % (body.attrib.get("com-" + axis, "0 mm"), by)
            for shape in body:
                for point in SHAPES[shape.tag.removeprefix(NAMES)]:
                    shape.attrib[point + axis] = "(%s) - (%.17g um)" % (shape.attrib.get(point + axis, "0 mm"), by)
    for element in root.iter():
        for who, prefix in POINTS.get(element.tag.removeprefix(NAMES), {}).items():
            if who not in element.attrib or element.attrib.get("kind") in WITHOUT.get(element.tag, ()):
                continue
            for axis, by in zip("xy", shift.get(element.attrib.get(who), (0, 0))):
                element.attrib[prefix + axis] = "(%s) - (%.17g um)" % (element.attrib.get(prefix + axis, "0 mm"), by)
    return tree.tostring(root, encoding="unicode")


def in_other_words(text, draw, drawn):
    """the same device: bodies and what joins them in another order, and, where nothing is drawn, each joint begun at its other body"""
    tree.register_namespace("", NAMES[1:-1])
    root = tree.fromstring(text)
    for group in root.iter(NAMES + "mechanism"):
        for kind in ("body", "revolute", "prismatic", "weld", "spring"):
            places = [i for i, e in enumerate(group) if e.tag == NAMES + kind]
            mixed = [group[i] for i in places]
            draw.shuffle(mixed)
            for i, e in zip(places, mixed):
                group[i] = e
        for e in group:
            if drawn or e.tag.removeprefix(NAMES) not in ("revolute", "prismatic", "weld", "spring"):
                continue
            was = dict(e.attrib)
            for one, other in ("ab", "ba"):
                for of in ("", "-x", "-y"):
                    e.attrib.pop(one + of, None)
                    if other + of in was:
                        e.attrib[one + of] = was[other + of]
            if "axis" in was:
                e.attrib["axis"] = "(%s) + 180 deg" % was["axis"]
    return tree.tostring(root, encoding="unicode")


def by_name(value):
    """lists of what has a name are told by it, not by their order"""
    if isinstance(value, dict):
        return {k: by_name(v) for k, v in value.items()}
    if not isinstance(value, list):
        return value
    for key in ("id", "hinge", "joint"):
        if value and all(isinstance(v, dict) and key in v for v in value) and len({v[key] for v in value}) == len(value):
            return {v[key]: by_name(v) for v in value}
    return [by_name(v) for v in value]


def unsigned(value, key=""):
    """a joint that begins at its other body turns the other way, and bears the opposite force"""
    if isinstance(value, dict):
        return {k: unsigned(v, k) for k, v in value.items()}
    if isinstance(value, list):
        return [unsigned(v, key) for v in value]
    return abs(value) if isinstance(value, float) and re.search("angle|force|moment|torque|travel", key) else value


def numbers(value, path="", out=None):
    """every number of a document by its path"""
    out = {} if out is None else out
    if isinstance(value, dict):
        for key, item in value.items():
            numbers(item, path + "/" + key, out)
    elif isinstance(value, list):
        for key, item in enumerate(value):
            numbers(item, "%s/%d" % (path, key), out)
    elif isinstance(value, (int, float)) and not isinstance(value, bool):
        out[path] = value
    return out


def kind_of(path):
    """what is compared with it in size: an entry of a list with the other entries, a strain with all strains"""
    return "strain" if path.endswith("strain") else re.sub(r"/\d+", "", path)


def least(path):
    """without a load all strains, forces, moments and angles are rounding: of a microstrain, ten micronewtons, a thousandth of a
    micrometre newton and a microradian. Forces: flexures of 1e5 N/m along them, in places that are known to 1e-16 of some
    millimetres, have 1e-13 N of it, 1e-8 of that size"""
    for end, size in (("strain", 1e-6), ("force_N", 1e-5), ("_N", 1e-5), ("_Nm", 1e-9), ("_rad", 1e-6), ("utilisation", 1e-5), ("utilisation_band", 1e-2), ("bodies_give", 1), ("_m", 1e-9)):
        if re.sub(r"/\d+", "", path).endswith(end):
            return size
    return 0


class Frames(unittest.TestCase):
    def setUp(self):
        self.kept = tempfile.TemporaryDirectory()
        self.addCleanup(self.kept.cleanup)

    tips = 2e-3

    def file(self, text):
        path = pathlib.Path(self.kept.name) / "device.xml"
        path.write_text(text, encoding="utf-8")
        return path

    def answer(self, text, *command):
        result = run(command[0], self.file(text), *command[1:], "--json")
        self.assertIn(result.returncode, (0, 1, 4), result.stderr)
        return json.loads(result.stdout)

    def same(self, a, b, within, skip):
        a, b = numbers(a), numbers(b)
        self.assertEqual(set(a), set(b))
        sizes = {}
        for path, value in a.items():  # as small as rounding of the largest of its kind
            sizes[kind_of(path)] = max(sizes.get(kind_of(path), least(path)), abs(value))
        for path, value in a.items():
            if not re.search(skip, path):
                bound = within * sizes[kind_of(path)]
                if path.endswith("tips_at"):  # its forces are known as well as it says
                    bound = self.tips * abs(value) + abs(value) * max(d[path.replace("tips_at", "tips_error")] for d in (a, b))
                self.assertLessEqual(abs(value - b[path]), bound, path)

    SKIP = r"band_parts|tips_error|cpu_s|steps|rhs|residual|constraint|velocity_norm|energy_error|assembly_moved|estimated|error|iterations|looser|utilisation_band|cycles$|boxes|out_of_rest|velocity_moved"

    def unmoved(self, text, shift):
        """statics, modes and verdict of both; the verdict has hinges, corners, clearances, requirements, probes and gaps"""
        other = moved(text, shift)
        for command, within in ((("statics",), 1e-8), (("modes",), 1e-7),
                                (("check", "--corners", "none", "--advice", "none"), 1e-3)):
            a, b = self.answer(text, *command), self.answer(other, *command)
            for document in (a, b):  # the frame's own poses are compared below
                if "q" in document:
                    self.frames(document, shift if document is b else {})
            if command[0] == "check":
                for key in ("verdict", "flows"):  # words, too; numbers of clearances and gaps are known to 0.2 % only
                    self.assertEqual(a[key] if key == "verdict" else [(f["id"], f["manufacturable"]) for f in a[key]],
                                     b[key] if key == "verdict" else [(f["id"], f["manufacturable"]) for f in b[key]])
            # a band holds the integration's own estimate of its error, which hangs on the steps it took
            for document in (a, b):
                document["bands"] = {k: v for k, v in numbers(document).items() if "utilisation_band" in k}
            self.same(a.pop("bands"), b.pop("bands"), 1e-2, "^$")
            self.clearances(a, b)
            # the instant of a least clearance is known only as well as its 0.2 % allow at a flat minimum
            self.same(a, b, within, self.SKIP + r"|/d?q/|/(damped_)?shape/|/path/events/\d+/q|/clearances/\d+/(t_s|at|pose|clearance_m|drawn_m|proved_m|low_m|high_m)|/wiring/gaps/\d+/(t_s|at_m)|/probes/\d+/(maximum_|minimum_)?t_s|/release/parts/\d+/at_m")

    def shifts(self, draw, text):
        ids = re.findall(r'<body id="([\w-]+)"', text)
        self.assertTrue(ids)
        return {i: (draw.uniform(-300, 300), draw.uniform(-300, 300)) for i in ids}

    GALLERY = ("comb-stage", "copper-nodder", "leaf-four-bar", "free-form-four-bar", "free-form-gripper", "straight-stage")

    def test_moved_frames_change_nothing(self):
        draw = random.Random(19)
        with_bodies = [p.parent.name for p in (ROOT / "docs/gallery").glob("*/device.xml") if "<body " in p.read_text(encoding="utf-8")]
        self.assertEqual(sorted(self.GALLERY), sorted(with_bodies))  # six-bars have no frames
        for name in self.GALLERY if ALL else sorted(self.GALLERY)[::2]:
            text = (ROOT / "docs/gallery" / name / "device.xml").read_text(encoding="utf-8")
            with self.subTest(name):
                self.unmoved(text, self.shifts(draw, text))

    def test_of_random_devices(self):
        """legs, comb stages, chains and free forms of every kind of hinge"""
        draw, done = random.Random(20), 0
        for seed in range(1, 400):
            text, _ = random_devices.device(seed)
            if "<body " not in text or re.search(r'symmetry=|plate-|phi=', text):
                continue
            body = re.search(r'<body id="([\w-]+)"', text)[1]  # devices for masks bear next to nothing
            text = re.sub(r"(<scene [^>]*>)", rf'\1<force on="{body}" x="30 um" fx="4 uN" fy="-3 uN"/>', text)
            if run("check", self.file(text), "--corners", "none", "--advice", "none", "--hinge-model", "revolute").returncode not in (0, 1):
                continue  # it cannot be drawn
            with self.subTest(seed=seed):
                self.unmoved(text, self.shifts(draw, text))
            done += 1
            if done == (40 if ALL else 3):
                break
        self.assertGreaterEqual(done, 3)

    def test_of_a_required_workspace(self):
        """what rides on a six-bar has a frame: its workspace, and what holds the required poses, are the same"""
        text = (ROOT / "docs/gallery/reference-six-bar/device.xml").read_text(encoding="utf-8")
        text = re.sub(r'<flow ref="copper[^>]*/>|<workspace flow="copper[^>]*/>|<scene name="gentle.*?</scene>', "", text, flags=re.S)
        text = text.replace("</six-bar>", """</six-bar><mechanism>
            <body id="tool" x="1.5 mm" y="3.6 mm" mass="0.01 mg" inertia="0.001 mg mm^2"/>
            <weld id="hold" a="CD" a-x="0 mm" a-y="0.4 mm" b="tool" b-x="0 mm" b-y="-0.325 mm"/></mechanism>""")
        text = re.sub(r"(<scene [^>]*>)", r'\1<force on="tool" x="30 um" y="10 um" fx="4 uN" fy="-3 uN"/>', text)
        draw = random.Random(21)
        for _ in range(8 if ALL else 2):
            shift = {"tool": (draw.uniform(-300, 300), draw.uniform(-300, 300))}
            other = moved(text, shift)
            a, b = self.answer(text, "workspace"), self.answer(other, "workspace")
            self.assertTrue(a["flows"][0]["required"][0]["certified"])
            self.assertEqual(len(a["flows"][0]["required"][0]["hinges"]), 6)
            self.assertGreater(min(h["strain"] for h in a["flows"][0]["required"][0]["hinges"]), 1e-5)
            self.same(a, b, 1e-9, r"cpu_s|^$")
        self.unmoved(text, shift)

    def clearances(self, a, b):
        """a least clearance is searched for until it is known to 0.2 % (docs/theory/clearance.md); the band holds what the
        motion is off by, which hangs on the steps it took, or a tenth of a long one"""
        for one, other in zip(a.get("clearances", []), b.get("clearances", [])):
            self.assertLessEqual(abs(one["clearance_m"] - other["clearance_m"]), 2e-3 * one["clearance_m"] + 1e-9)
            for x, y in ((one, other), (other, one)):
                self.assertTrue(x["low_m"] <= y["clearance_m"] <= x["high_m"], (x, y))

    def frames(self, document, shift):
        """the centre of mass is where it is, seen from the frame"""
        for body, (x, y, phi) in document["q"].items():
            dx, dy = (1e-6 * v for v in shift.get(body, (0, 0)))
            document["q"][body] = [x - math.cos(phi) * dx + math.sin(phi) * dy, y - math.sin(phi) * dx - math.cos(phi) * dy,
                                   phi]
        document["frame"] = document.pop("q")

    EVERYTHING = """<device xmlns="urn:flexwright:device:1" name="everything">
<mechanism>
<body id="arm" mass="1 mg" inertia="1 mg mm^2" x="1 mm" y="0 mm"/>
<body id="slide" mass="2 mg" inertia="1 mg mm^2" x="2.5 mm" y="0.5 mm" com-x="0.1 mm"/>
<body id="end" mass="1 mg" inertia="0.5 mg mm^2" x="3 mm" y="2 mm"/>
<revolute id="pin" a="ground" b="arm" b-x="-1 mm" stiffness="1e-6 N m/rad"/>
<prismatic id="guide" a="arm" a-x="1 mm" a-y="0.2 mm" b="slide" b-x="-0.5 mm" b-y="-0.3 mm" axis="10 deg" stiffness="20 N/m"/>
<weld id="weld" a="slide" a-x="0.2 mm" a-y="0.7 mm" b="end" b-x="-0.3 mm" b-y="-0.8 mm"/>
<spring id="spring" a="arm" a-x="0.3 mm" a-y="0.1 mm" b="ground" b-x="0 mm" b-y="3 mm" stiffness="5 N/m"/>
</mechanism>
<scene name="all" duration="3 ms">
<force on="arm" x="0.5 mm" y="-0.1 mm" fx="0.01 mN" fy="-0.02 mN"/>
<torque on="slide" value="0.01 uN m"/>
<initial body="arm" omega="2 rad/s"/>
<tendon id="T" pull="0.05 mN"><eyelet on="end" x="0.1 mm" y="0.2 mm"/><eyelet on="arm" x="0.2 mm" y="0.4 mm"/>
<eyelet on="ground" x="-1 mm" y="2 mm"/></tendon>
<contact id="C" a="end" a-x="0.1 mm" b="ground" b-x="3.2 mm" b-y="2.1 mm" side="outside" distance="0.1 mm" stiffness="1 N/m"/>
<base-motion ax="3 m/s^2"/><gravity gy="-9.81 m/s^2"/>
</scene>
<probe id="point" kind="displacement" on="slide" x="0.4 mm" y="-0.2 mm" direction="30 deg"/>
<probe id="speed" kind="velocity" on="end" x="0.2 mm"/><probe id="gap" kind="distance" a="arm" a-x="0.4 mm" b="end" b-y="0.3 mm"/>
<probe id="open" kind="opening" a="arm" a-y="0.1 mm" b="ground" b-x="3 mm"/><probe id="pull" kind="force" of="spring"/>
<probe id="cable" kind="force" of="T"/><probe id="joint" kind="force" of="guide"/></device>"""

    def test_points_of_every_element_go_with_the_frame(self):
        shift = {"arm": (120, -70), "slide": (-310, 45), "end": (11, 230)}
        other = moved(self.EVERYTHING, shift)
        for command, within in ((("statics",), 1e-7), (("simulate", "--rtol", "1e-11"), 1e-6)):
            a, b = self.answer(self.EVERYTHING, *command), self.answer(other, *command)
            for document in (a, b):
                state = document if "q" in document else document["final"]
                self.frames(state, shift if document is b else {})
                state.pop("v", None), state.pop("a", None)
            self.same(a, b, within, self.SKIP + "|jacobians|factorisations|projections|rejected|t_s$")

    def test_order_and_sides_do_not_count(self):
        """whose turn of phrase the device is: bodies, joints and springs in any order, begun at either body"""
        draw = random.Random(26)
        everything = self.EVERYTHING.replace("</mechanism>", """<body id="tail" mass="1 mg" inertia="0.7 mg mm^2" x="4 mm" y="2.2 mm"/>
            <revolute id="hip" a="end" a-x="0.4 mm" a-y="-0.1 mm" b="tail" b-x="-0.6 mm" b-y="-0.3 mm" stiffness="2e-6 N m/rad"/>
            <spring id="back" a="tail" a-x="0.3 mm" b="slide" b-y="0.2 mm" stiffness="3 N/m"/></mechanism>""")
        skip = self.SKIP + r"|jacobians|factorisations|projections|rejected|t_s$|/(damped_)?shape/|/(ties|reactions)/\w+/(peak_)?torque_Nm|/probes/joint/"  # about the point of the body where it begins
        for _ in range(2):
            for text in (self.EVERYTHING, everything):
                other = in_other_words(text, draw, False)
                for command, within in ((("statics",), 1e-7), (("modes",), 1e-7), (("simulate", "--rtol", "1e-11"), 1e-5)):
                    if command[0] == "statics" and text is everything:
                        continue  # it is soft, and rests in more than one pose
                    a, b = (by_name(self.answer(t, *command)) for t in (text, other))
                    self.same(unsigned(a), unsigned(b), within, skip)

    def test_order_of_what_is_drawn_does_not_count(self):
        """as before; which sides of a body are tethered, and what that changes, may hang on which body comes first"""
        text = (ROOT / "docs/gallery/leaf-four-bar/device.xml").read_text(encoding="utf-8")
        other = in_other_words(text, random.Random(3), True)
        for command, within in ((("statics",), 1e-7), (("check", "--corners", "none", "--advice", "none"), 1e-3)):
            a, b = (by_name(self.answer(t, *command)) for t in (text, other))
            for document in (a, b):
                document["bands"] = {k: v for k, v in numbers(document).items() if "utilisation_band" in k}
            self.same(a.pop("bands"), b.pop("bands"), 1e-2, "^$")
            self.clearances(a, b)
            self.same(unsigned(a), unsigned(b), within, self.SKIP + r"|/d?q/|/path/events/\w+/q|/clearances/\d+/(t_s|at|pose|clearance_m|drawn_m|proved_m|low_m|high_m)|/tethers/|stiction|/release/|/wiring/")

    def test_masks_are_the_same_bytes(self):
        self.same_masks("free-form-four-bar", {"crank": (0, 200), "coupler": (-100, 50), "rocker": (13, 17)})
        self.same_masks("free-form-gripper", {"left": (-250, 125), "right": (64, -48)})

    def same_masks(self, device, shift):
        text = (ROOT / "docs/gallery" / device / "device.xml").read_text(encoding="utf-8")
        other = moved(text, shift)
        files = []
        for one, which in ((text, "a"), (other, "b")):
            where = pathlib.Path(self.kept.name) / (device + which)
            self.assertEqual(run("mask", self.file(one), "--corners", "none", "-o", where).returncode, 0)
            files.append({f.name: f.read_bytes() for f in where.rglob("*.gds")})
        self.assertEqual(files[0].keys(), files[1].keys())
        for name, content in files[0].items():
            self.assertEqual(content, files[1][name], name)

    PADDLE = """<device xmlns="urn:flexwright:device:1" name="paddle">
<material ref="silicon-100" thickness="50 um"/><flow ref="al-masked-rie"/>
<flexure id="f" kind="leaf" length="300 um" width="6 um" gap="10 um"/>
<mechanism>
<body id="paddle" {mass}x="0 mm" y="{y} mm" plate-width="0.6 mm" plate-height="0.8 mm" plate-x="0 mm" plate-y="0.8 mm"/>
<revolute id="A" a="ground" a-x="0 mm" a-y="0 mm" b="paddle" b-x="0 mm" b-y="-{y} mm" hinge="f"/>
</mechanism>
<scene name="shock" duration="2 ms"><base-motion ax="20000 m/s^2" law="half-sine" rise="0.2 ms"/></scene></device>"""

    def test_a_paddle_swings_as_it_is_drawn_wherever_its_frame_is(self):
        said = [self.answer(self.PADDLE.format(y=y, mass=""), "check", "--corners", "none", "--advice", "none")
                for y in (0.8, 0.3, 0.05)]
        modes = [self.answer(self.PADDLE.format(y=y, mass=""), "modes") for y in (0.8, 0.3, 0.05)]
        for other, mode in zip(said[1:], modes[1:]):
            self.assertEqual(other["verdict"], said[0]["verdict"])
            self.assertAlmostEqual(other["hinges"][0]["utilisation"] / said[0]["hinges"][0]["utilisation"], 1, delta=1e-3)
            self.assertAlmostEqual(mode["modes"][0]["f_Hz"] / modes[0]["modes"][0]["f_Hz"], 1, delta=1e-9)
            self.assertEqual(list(mode["com"]), ["paddle"])
            for k in range(2):
                self.assertAlmostEqual(mode["com"]["paddle"][k], modes[0]["com"]["paddle"][k], delta=1e-15)

    def test_a_stated_mass_is_at_the_frame_or_where_it_is_said(self):
        mass = 'mass="0.05 mg" inertia="0.004 mg mm^2" '
        frequency = {}
        for y, com in ((0.8, ""), (0.3, ""), (0.3, 'com-y="0.5 mm" ')):
            document = self.answer(self.PADDLE.format(y=y, mass=mass + com), "modes")
            frequency[y, com] = document["modes"][0]["f_Hz"]
            self.assertAlmostEqual(document["com"]["paddle"][1], 1e-3 * (y + (0.5 if com else 0)), delta=1e-12)
        self.assertGreater(frequency[0.3, ""], 1.5 * frequency[0.8, ""])
        self.assertAlmostEqual(frequency[0.3, 'com-y="0.5 mm" '] / frequency[0.8, ""], 1, delta=1e-9)

    def test_a_centre_of_mass_needs_a_mass(self):
        result = run("check", self.file(self.PADDLE.format(y=0.8, mass='com-x="1 um" ')))
        self.assertEqual(result.returncode, 3)
        self.assertRegex(result.stderr, r"device.xml:5:\d+: error: .*com-x.*FW-D064")

    def test_columns_name_frames_and_centres_of_mass(self):
        header = run("simulate", self.file(self.PADDLE.format(y=0.3, mass="")), "--csv", "-",
                     "--samples", "3").stdout.splitlines()[0]
        self.assertEqual(header.split(",")[1:4] + header.split(",")[-2:],
                         ["paddle.x_m", "paddle.y_m", "paddle.phi_rad", "paddle.com_x_m", "paddle.com_y_m"])


if __name__ == "__main__":
    unittest.main()
