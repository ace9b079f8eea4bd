#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Drawn bodies from the command line: a jaw as an outline, as plates, as DXF and as GDSII is one jaw, to the byte of its mask; the
manifest has the drawing's hash; what is wrong with a drawing is said at its place, and nothing beside the device file is opened."""
import hashlib
import json
import math
import pathlib
import random
import re
import struct
import tempfile
import unittest

from common import ROOT, run

TWO = """<device xmlns="urn:flexwright:device:1" name="two"><material ref="silicon-100" thickness="50 um"/><flow ref="al-masked-rie"/>
<mechanism>%s</mechanism><flexure id="f" kind="csfh" radius="80 um" angle="240 deg" width="8 um" gap="10 um"/>
<scene name="push" duration="20 ms"><force on="L" fx="1 uN"/></scene></device>"""
DEVICE = """<device xmlns="urn:flexwright:device:1" name="jaw">
<material ref="silicon-100" thickness="50 um"/>
<flow ref="al-masked-rie"/>
<flexure id="f" kind="csfh" radius="80 um" angle="240 deg" width="8 um" gap="10 um"/>
<mechanism>
<body id="jaw" x="0 mm" y="0.1 mm">
%s
</body>
<revolute id="A" a="ground" b="jaw" b-y="-0.1 mm" hinge="f"/>
</mechanism>
<scene name="push" duration="2 ms"><force on="jaw" x="1 mm" fy="5 uN"/></scene>
</device>
"""


def outline(points):
    lines = "".join('<line to-x="%.17g um" to-y="%.17g um"/>' % p for p in points[1:] + points[:1])
    return '<outline start-x="%.17g um" start-y="%.17g um">%s</outline>' % (*points[0], lines)


def dxf(points, unit=13, scale=1):
    vertices = "".join("10\n%.17g\n20\n%.17g\n" % (x * scale, y * scale) for x, y in points)
    return ("0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n%d\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n0\nLWPOLYLINE\n8\njaw\n90\n%d\n70\n1\n"
            % (unit, len(points))) + vertices + "0\nENDSEC\n0\nEOF\n"


def lines(points):
    """the same as single lines in any order and direction"""
    out, ends = "", list(zip(points, points[1:] + points[:1]))
    random.Random(3).shuffle(ends)
    for i, (a, b) in enumerate(ends):
        a, b = (a, b) if i % 2 else (b, a)
        out += "0\nLINE\n8\njaw\n10\n%.17g\n20\n%.17g\n11\n%.17g\n21\n%.17g\n" % (*a, *b)
    return "0\nSECTION\n2\nENTITIES\n" + out + "0\nENDSEC\n0\nEOF\n"


def real8(value):
    exponent = 0
    while value >= 1:
        value, exponent = value / 16, exponent + 1
    while value < 1 / 16:
        value, exponent = value * 16, exponent - 1
    return struct.pack(">Q", (exponent + 64) << 56 | round(value * 2**56))


def record(kind, data=b""):
    return struct.pack(">HH", 4 + len(data), kind) + data


def gds(*polygons):
    day = struct.pack(">12h", *[2026, 1, 1, 0, 0, 0] * 2)
    out = record(0x0002, struct.pack(">h", 600)) + record(0x0102, day) + record(0x0206, b"LIB\0")
    out += record(0x0305, real8(1e-3) + real8(1e-9)) + record(0x0502, day) + record(0x0606, b"JAW\0")
    for points in polygons:
        xy = b"".join(struct.pack(">ii", round(1000 * x), round(1000 * y)) for x, y in points + points[:1])
        out += record(0x0800) + record(0x0d02, struct.pack(">h", 3)) + record(0x0e02, struct.pack(">h", 0))
        out += record(0x1003, xy) + record(0x1100)
    return out + record(0x0700) + record(0x0400)


def stairs(seed):
    """a jaw of plates that stand on each other from the hinge on, and its outline; um, on the grid"""
    draw = random.Random(seed)
    x, steps = 150, []
    for i in range(draw.randint(2, 5)):  # every other one wide, so that no step is too small for a mask
        wide = 70 * (i % 2)
        steps.append((x, x + draw.randint(150, 350), -100 - draw.randint(40, 90) - wide, -100 + draw.randint(40, 90) + wide))
        x = steps[-1][1]
    points = [p for x0, x1, low, _ in steps for p in ((x0, low), (x1, low))]
    points += [p for x0, x1, _, high in reversed(steps) for p in ((x1, high), (x0, high))]
    plates = "".join('<plate x="%.17g um" y="%.17g um" width="%d um" height="%d um"/>' % ((x0 + x1) / 2, (low + high) / 2, x1 - x0, high - low)
                     for x0, x1, low, high in steps)
    return points, plates


class Shapes(unittest.TestCase):
    def setUp(self):
        kept = tempfile.TemporaryDirectory()
        self.addCleanup(kept.cleanup)
        self.at = pathlib.Path(kept.name)

    def device(self, shapes):
        path = self.at / "device.xml"
        path.write_text(DEVICE % shapes, encoding="utf-8")
        return path

    def mask(self, shapes):
        out = self.at / "out"
        result = run("mask", self.device(shapes), "-o", out)
        self.assertEqual(result.returncode, 0, result.stderr)
        inputs = {i["name"]: i for i in json.loads((out / "manifest.json").read_text())["inputs"]}
        return (out / "masks/al-masked-rie.gds").read_bytes(), inputs

    def modes(self, shapes):
        return json.loads(run("modes", self.device(shapes), "--json").stdout)["modes"]

    def test_two_jaws_too_near_each_other_are_told_how_far_apart(self):
        """the distance that FW-D128 names is the least at which the base between them finds its way, where neither has one by itself: one jaw
        reaches round both. Two plain jaws get a base each, as near as their round places let them"""
        def said(apart, *round_both):
            def bars(*way):
                return "".join(f'<bar x="{a} um" y="{b} um" to-x="{c} um" to-y="{d} um" width="120 um"/>' for (a, b), (c, d) in zip(way, way[1:]))
            far = apart + 700
            left = ((0, 0), (0, 900)) + (((-700, 900), (-700, -700), (far, -700), (far, 900)) if round_both else ())
            parts = "".join(f'<body id="{b}" x="{x} um" y="0 um">{bars(*way)}</body>'
                            f'<revolute id="{b}{b}" a="ground" a-x="{x} um" a-y="0 um" b="{b}" b-x="0 um" b-y="0 um" hinge="f"/>'
                            for b, x, way in (("L", -apart / 2, left), ("R", apart / 2, left[:2])))
            return run("check", "-", "--corners", "none", "--advice", "none", "--hinge-model", "revolute", input=TWO % parts).stderr
        found = re.search(r"The two are 520 um apart; a base between their round places needs ([\d.]+) um at least \[FW-D128\]", said(520, True))
        self.assertTrue(found)
        self.assertIn("FW-D128", said(float(found.group(1)) - 0.3, True))
        self.assertNotIn("FW-D128", said(float(found.group(1)) + 0.3, True))
        near = re.search(r"hinges LL and RR are 460 um apart, but their surfaces and clearance need ([\d.]+) um; .*\[FW-D125\]", said(460))
        self.assertIn("FW-D125", said(float(near.group(1)) - 0.3))
        self.assertNotIn("error", said(float(near.group(1)) + 0.3))

    def test_four_ways_are_one_jaw(self):
        for seed in range(4):
            points, plates = stairs(seed)
            files = {"jaw.dxf": dxf(points).encode(), "mm.dxf": dxf(points, 4, 1e-3).encode(), "lines.dxf": lines(points).encode(),
                     "jaw.gds": gds(points), "parts.gds": gds(*[[(a, c), (b, c), (b, d), (a, d)] for a, b, c, d in boxes(plates)])}
            for name, data in files.items():
                (self.at / name).write_bytes(data)
            first, _ = self.mask(outline(points))
            ways = [plates, *('<outline file="%s"%s/>' % (n, ' unit="um"' if n == "lines.dxf" else "") for n in files)]
            frequencies = [m["f_Hz"] for m in self.modes(outline(points))]
            for way in ways:
                other, inputs = self.mask(way)
                self.assertEqual(first, other, way)
                for name in files:
                    if name in way:
                        self.assertEqual(inputs[name]["sha256"], hashlib.sha256(files[name]).hexdigest())
                for a, b in zip(frequencies, (m["f_Hz"] for m in self.modes(way))):
                    self.assertAlmostEqual(a / b, 1, delta=1e-9)

    def refused(self, shapes, place, number, says):
        result = run("check", self.device(shapes))
        self.assertEqual(result.returncode, 3, result.stdout)
        self.assertIn(place, result.stderr)
        self.assertIn("[FW-D%d]" % number, result.stderr)
        self.assertIn(says, result.stderr)
        self.assertEqual(result.stderr.count("[FW-D"), 1, result.stderr)

    def test_a_stage_between_two_bases_however_axes_point(self):
        """One base for both hinges is tried first, whose necks lead through the stage; where that cannot be drawn each has one of its
        own. Flexures whose width varies, by however little, were refused there (FW-D264)"""
        flexures = ('kind="leaf" length="400 um" width="12 um"%s', 'kind="csfh" radius="120 um" angle="180 deg" width="12 um"%s')
        found, path = {}, self.at / "between.xml"
        for k, flexure in enumerate(flexures):
            for middle in ("", ' width-middle="11.99 um"'):
                for axes in ((90, 90), (90, 270), (270, 90), (270, 270)):
                    path.write_text(
                        '<device xmlns="urn:flexwright:device:1" name="between"><material ref="silicon-100" thickness="50 um"/>'
                        '<flow ref="al-masked-rie"/><flexure id="f" %s/><mechanism><body id="stage" x="0 mm" y="0 mm">'
                        '<plate width="700 um" height="200 um"/></body>'
                        '<revolute id="A" a="ground" a-x="-0.55 mm" b="stage" b-x="-0.55 mm" hinge="f" axis="%d deg"/>'
                        '<revolute id="B" a="stage" a-x="0.55 mm" b="ground" b-x="0.55 mm" hinge="f" axis="%d deg"/></mechanism>'
                        '</device>' % (flexure % middle, *axes))
                    done = run("modes", path, "--json")
                    self.assertEqual(done.returncode, 0, (flexure % middle, axes, done.stderr))
                    found.setdefault(k, []).append(json.loads(done.stdout)["modes"][0]["f_Hz"])
        self.assertLess(max(found[1]) / min(found[1]), 1.01, found)

    def test_what_is_wrong_is_said_at_its_place(self):
        points, _ = stairs(1)
        (self.at / "jaw.dxf").write_text(dxf(points))
        (self.at / "open.dxf").write_text(dxf(points).replace("\n70\n1\n", "\n70\n0\n"))
        (self.at / "jaw.txt").write_text("no drawing\n")
        (self.at / "secret").mkdir()
        here = "device.xml:7:16: error"
        self.refused('<outline file="no.dxf"/>', here, 310, "No such file")
        self.refused('<outline file="secret"/>', here, 310, "directory")
        self.refused('<outline file="../jaw.dxf"/>', here, 310, "..")
        self.refused('<outline file="%s/jaw.dxf"/>' % self.at, here, 310, "relative")
        self.refused('<outline file="jaw.dxf" unit="mm"/>', "device.xml:7:31: error", 313, "drawn in um")
        self.refused('<outline file="jaw.dxf" layer="other"/>', "device.xml:7:32: error", 314, "no closed line")
        self.refused('<outline file="open.dxf"/>', "open.dxf:15:1: error", 315, "ends at")
        self.refused('<outline file="jaw.txt"/>', "jaw.txt:1:1: error", 312, "group code")

    def test_no_file_is_opened_for_a_text(self):
        points, _ = stairs(1)
        (self.at / "jaw.dxf").write_text(dxf(points))
        text = DEVICE % '<outline file="jaw.dxf"/>'
        result = run("check", "-", input=text, cwd=self.at)
        self.assertEqual(result.returncode, 3)
        self.assertIn("[FW-D311]", result.stderr)

    def test_a_circle_of_chords_is_a_hole(self):
        """GDSII has no arcs: its circles are chords, often shorter than a cut is wide, and open like the circle itself"""
        plate = '<plate x="0.5 mm" width="800 um" height="200 um"/>'
        def used(hole, place):
            (place / "device.xml").write_text(DEVICE % (plate + hole))
            done = run("check", place / "device.xml", "--json", "--advice", "none")
            self.assertEqual(done.returncode, 0, done.stderr + done.stdout[-500:])
            done = run("mask", place / "device.xml", "-o", place / f"out{len(list(place.iterdir()))}")
            self.assertEqual(done.returncode, 0, done.stderr)
            return json.loads(run("modes", place / "device.xml", "--json").stdout)["modes"][0]["f_Hz"]
        with tempfile.TemporaryDirectory() as scratch:
            place = pathlib.Path(scratch)
            none = used("", place)
            for radius in (12, 40):
                circle = ('<outline x="0.7 mm" start-x="-%g um" hole="yes"><arc to-x="%g um" to-y="0 um" radius="%g um" turn="left"/>'
                          '<arc to-x="-%g um" to-y="0 um" radius="%g um" turn="left"/></outline>' % (5 * (radius,)))
                whole = used(circle, place)
                self.assertNotEqual(whole, none)
                for chords in (20, 64, 200):
                    points = [(radius * math.cos(2 * math.pi * (k + 0.3) / chords), radius * math.sin(2 * math.pi * (k + 0.3) / chords)) for k in range(chords)]
                    (place / "hole.gds").write_bytes(gds(points))
                    less = 1 - chords / (2 * math.pi) * math.sin(2 * math.pi / chords)  # of its area
                    found = used('<outline file="hole.gds" x="0.7 mm" hole="yes"/>', place)
                    self.assertAlmostEqual((found - whole) / (none - whole), less, delta=0.003, msg=(radius, chords))

    def test_hinges_on_the_edge(self):
        """where a hinge stands on the edge of what is drawn rounding does not say which way its neck goes"""
        masks = set()
        for edge in ("-100 um", "-0.1 mm", "-100.00000000001 um", "-99.99999999999 um"):
            mask, _ = self.mask('<outline start-x="-60 um" start-y="%s"><line to-x="90 um" to-y="%s"/><line to-x="90 um" to-y="900 um"/>'
                                '<line to-x="300 um" to-y="900 um"/><line to-x="300 um" to-y="1100 um"/><line to-x="-60 um" to-y="1100 um"/>'
                                '<line to-x="-60 um" to-y="%s"/></outline>' % (edge, edge, edge))
            masks.add(mask)
        self.assertEqual(len(masks), 1)

    def test_the_gripper_is_a_device_for_both_flows(self):
        result = run("check", ROOT / "docs/gallery/free-form-gripper/device.xml", "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(json.loads(result.stdout)["verdict"], "accept")


class Widths(unittest.TestCase):
    def test_the_width_that_is_named_is_drawn(self):
        """a narrower bar has narrower necks: what a first refusal left room for was refused again, four times over"""
        device = """<device xmlns="urn:flexwright:device:1" name="crank"><material ref="silicon-100" thickness="50 um"/>
<flow ref="al-masked-rie"/><flexure id="f" kind="csfh" radius="60 um" angle="220 deg" width="8 um" gap="10 um"/><mechanism>
<body id="crank" x="0 mm" y="0 mm" width="%s um"/><body id="rod" x="0 mm" y="%s mm" width="120 um"/>
<revolute id="A" a="ground" b="crank" hinge="f"/><revolute id="B" a="crank" a-y="%s mm" b="rod" hinge="f"/>
<revolute id="C" a="rod" a-x="0.9 mm" b="ground" b-x="0.9 mm" b-y="%s mm" hinge="f"/></mechanism>
<scene name="push" duration="5 ms"><force on="rod" fx="1 uN"/></scene></device>"""

        def said(width, length):
            with tempfile.TemporaryDirectory() as directory:
                path = pathlib.Path(directory, "crank.xml")
                path.write_text(device % (width, length, length, length), encoding="utf-8")
                return run("check", str(path), "--advice", "none").stderr

        for length in ("0.42", "0.5", "0.7"):
            text = said("600", length)
            self.assertIn("FW-D137", text)
            fits = re.search(r"link crank: a bar (\S+) um wide fits", text).group(1)
            self.assertGreater(float(fits), 90)
            self.assertNotIn("FW-D137", said(fits, length))


class Bases(unittest.TestCase):
    def test_leaves_that_stand_upright_are_drawn(self):
        """their necks ran along the face of the root or cut the ring off there: bases could not be united, heads were not to be made"""
        rows = "".join(f'<revolute id="{i}" axis="0 deg" a="ground" a-x="{x} um" a-y="{y} um" b="shuttle" b-x="{x} um" b-y="{y} um" '
                       'hinge="leaf"/>\n' for i, x, y in zip("ABCD", (-900, 900, -900, 900), (-730, -730, 730, 730)))
        text = ('<device xmlns="urn:flexwright:device:1" name="guide">\n<material ref="silicon-100" thickness="50 um"/>'
                '<flow ref="silicon-on-glass" carrier="insulating"/><die tethers="no"/>'
                '<flexure id="leaf" kind="leaf" length="900 um" width="8 um"/><mechanism>\n'
                f'<body id="shuttle" x="0 mm" y="0 mm"><plate width="WIDE um" height="300 um"/></body>\n{rows}</mechanism>'
                '<scene name="go" duration="20 ms"><force on="shuttle" fx="0.1 mN"/></scene></device>')
        for wide in (1970, 2150, 2310):
            with tempfile.TemporaryDirectory() as here:
                path = pathlib.Path(here) / "guide.xml"
                path.write_text(text.replace("WIDE", str(wide)))
                done = run("mask", path, "--corners", "none", "-q", "-o", pathlib.Path(here) / "out")
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertNotIn("error", done.stderr)
        # with the shuttle elsewhere the drawing fails for that, and it is said of each hinge, where it stands
        with tempfile.TemporaryDirectory() as here:
            path = pathlib.Path(here) / "guide.xml"
            path.write_text(text.replace("WIDE", "1970").replace('id="shuttle" x="0 mm"', 'id="shuttle" x="9 mm"'))
            said = run("check", path, "--corners", "none", "--advice", "none").stderr
        apart = re.findall(r"guide\.xml:(\d+):1: error: joint (\w) does not close .* put it ([\d.]+) um apart.*FW-D206", said)
        self.assertEqual(apart, [(str(n), i, "9000") for n, i in enumerate("ABCD", 4)], said)


def boxes(plates):
    import re
    for x, y, w, h in re.findall(r'x="(\S+) um" y="(\S+) um" width="(\d+) um" height="(\d+) um"', plates):
        x, y, w, h = float(x), float(y), int(w), int(h)
        yield x - w / 2, x + w / 2, y - h / 2, y + h / 2


unittest.main()
