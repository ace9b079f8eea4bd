#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""flexwright assemble: documents, picture, exit statuses, and that simulate starts from the same pose."""
import json
import math
import pathlib
import re
import tempfile
import unittest
import xml.dom.minidom

from common import GALLERY, ROOT, run

STREWN = ROOT / "tests/data/strewn-six-bar.xml"
HEAD = '<device xmlns="urn:flexwright:device:1" name="{name}">\n<mechanism>\n'
FOUR_BAR = (HEAD + """<body id="crank" mass="1 kg" inertia="0.1 kg m^2" x="0.3 m" y="0.4 m" phi="55 deg"/>
<body id="coupler" mass="2 kg" inertia="1.5 kg m^2" x="1.8 m" y="1.6 m" phi="30 deg"/>
<body id="rocker" mass="1.5 kg" inertia="0.8 kg m^2" x="3.2 m" y="1.2 m" phi="95 deg"/>
<revolute id="A" a="ground" a-x="0 m" a-y="0 m" b="crank" b-x="-0.5 m" b-y="0 m"/>
<revolute id="B" a="crank" a-x="0.5 m" a-y="0 m" b="coupler" b-x="-{half} m" b-y="0 m"/>
<revolute id="C" a="coupler" a-x="{half} m" a-y="0 m" b="rocker" b-x="1.25 m" b-y="0 m"/>
<revolute id="D" a="ground" a-x="3.2 m" a-y="0 m" b="rocker" b-x="-1.25 m" b-y="0 m"/>
{driver}</mechanism>
</device>
""")


def four_bar(half="1.5", driver=""):
    return FOUR_BAR.format(name="four-bar", half=half, driver=driver)


def place(pose, x, y):
    c, s = math.cos(pose[2]), math.sin(pose[2])
    return pose[0] + c * x - s * y, pose[1] + s * x + c * y


class Assemble(unittest.TestCase):
    def setUp(self):
        self.here = tempfile.TemporaryDirectory()
        self.addCleanup(self.here.cleanup)
        self.path = pathlib.Path(self.here.name)

    def device(self, text):
        path = self.path / "device.xml"
        path.write_text(text)
        return path

    def document(self, *arguments):
        result = run("assemble", *arguments, "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads(result.stdout)

    def test_strewn_six_bar(self):
        d = self.document(STREWN)
        self.assertEqual(d["schema"], "flexwright.assemble/1")
        self.assertTrue(d["closed"])
        self.assertLess(d["gap_after_m"], 1e-17)
        self.assertAlmostEqual(d["gap_before_m"], 750.6e-6, delta=1e-7)
        q = d["after"]
        pins = [("AB", -.25e-3, .625e-3, "BC", -.3e-3, -.65e-3), ("BC", .3e-3, .65e-3, "CD", -.7e-3, -.175e-3),
                ("CD", .7e-3, -.125e-3, "DE", -.325e-3, .65e-3), ("DE", .325e-3, -.65e-3, "EF", .275e-3, .65e-3)]
        for a, ax, ay, b, bx, by in pins:
            self.assertLess(math.dist(place(q[a], ax, ay), place(q[b], bx, by)), 1e-17)
        self.assertLess(math.dist(place(q["AB"], .25e-3, -.625e-3), (.7e-3, .15e-3)), 1e-17)
        self.assertEqual(d["freedom"]["dof"], 3)
        self.assertEqual(d["freedom"]["redundant"], [])
        self.assertTrue(all(b["same"] for b in d["branches"]))
        self.assertEqual([b["elbow"] for b in d["branches"]], ["B", "C", "D", "E"])
        distances = [a["distance_m"] for a in d["alternatives"]]
        self.assertEqual(distances, sorted(distances))
        self.assertGreater(distances[0], d["distance_m"])
        self.assertEqual(len(d["independent"]["coordinates"].split(",")), 3)
        self.assertNotIn("velocity", d)

    def test_a_picture_that_cannot_be_saved(self):
        """ends with what is wrong there, and nothing is said of a result"""
        result = run("assemble", STREWN, "--svg", "/nowhere/a.svg")
        self.assertEqual((result.returncode, result.stdout), (5, ""))
        self.assertIn("FW-D222", result.stderr)

    def test_same_bytes(self):
        self.assertEqual(run("assemble", STREWN, "--json").stdout,
                         run("assemble", STREWN, "--json").stdout)

    def test_simulate_starts_there(self):
        assembled = self.document(STREWN)
        self.assertIn("FW-D115", run("simulate", STREWN, "-q").stderr)  # what ends with 4 says why
        result = run("simulate", STREWN, "--csv", "-", "--samples", "2", "-v")
        self.assertEqual(result.returncode, 4, result.stderr)  # another branch may have been meant
        self.assertIn("FW-D115", result.stderr)
        header, first = result.stdout.splitlines()[:2]
        row = dict(zip(header.split(","), map(float, first.split(","))))
        for body, (x, y, phi) in assembled["after"].items():
            self.assertAlmostEqual(row[f"{body}.x_m"], x, delta=1e-17)
            self.assertAlmostEqual(row[f"{body}.y_m"], y, delta=1e-17)
            self.assertAlmostEqual(row[f"{body}.phi_rad"], phi, delta=1e-14)

    def test_closed_device_stays(self):
        d = self.document(GALLERY)
        self.assertEqual((d["iterations"], d["moved_m"]), (0, 0))
        self.assertEqual(d["before"], d["after"])

    def test_kinematics(self):
        """Velocities and accelerations are those of positions nearby, found by assembling again."""
        d = self.document(STREWN, "--independent", "AB.phi,BC.phi,CD.phi", "--rates",
                          "10 rad/s,-3 rad/s,5 rad/s", "--accelerations",
                          "100 rad/s^2,0 rad/s^2,-2e3 rad/s^2")
        self.assertEqual(d["independent"]["coordinates"], "AB.phi,BC.phi,CD.phi")
        self.assertEqual([v["rate"] for v in d["independent"]["values"]], [10, -3, 5])
        self.assertAlmostEqual(d["velocity"]["AB"][2], 10, delta=1e-12)
        self.assertAlmostEqual(d["acceleration"]["CD"][2], -2e3, delta=1e-9)
        # hinge B as a point of both bodies has one velocity and one acceleration
        for a, ax, ay, b, bx, by in [("AB", -.25e-3, .625e-3, "BC", -.3e-3, -.65e-3),
                                     ("DE", .325e-3, -.65e-3, "EF", .275e-3, .65e-3)]:
            point = []
            for body, x, y in ((a, ax, ay), (b, bx, by)):
                q, v, w = d["after"][body], d["velocity"][body], d["acceleration"][body]
                rx, ry = (p - c for p, c in zip(place(q, x, y), q))
                point.append((v[0] - v[2] * ry, v[1] + v[2] * rx,
                              w[0] - w[2] * ry - v[2] ** 2 * rx, w[1] + w[2] * rx - v[2] ** 2 * ry))
            for one, other in zip(*point):
                self.assertAlmostEqual(one, other, delta=1e-12 * max(1, abs(one)))
        # the whole is in balance: forces of the ground, load and inertia
        mass = dict(AB=.0188e-6, BC=.0200e-6, CD=.0653e-6, DE=.0203e-6, EF=.0197e-6)
        ground = d["forces"]["revolute_N"]
        for axis, load in ((0, .35e-3), (1, -.20e-3)):
            inertia = sum(m * d["acceleration"][b][axis] for b, m in mass.items())
            self.assertAlmostEqual(ground["A"][axis] - ground["F"][axis] + load, inertia, delta=1e-14)

    def test_wrong_choices(self):
        for options, text in ((("--independent", "AB.phi"), "3 degrees of freedom"),
                              (("--independent", "AB.phi,AB.x,CD.phi"), "cannot be independent"),
                              (("--independent", "AB.phi,BC.fi,CD.phi"), "no coordinate"),
                              (("--rates", "1 rad/s"), "--rates has 1 value"),
                              (("--rates", "1 rad/s,2 mm,3 rad/s"), "--rates, value 2"),
                              (("--accelerations", "1,2,3"), "--accelerations, value 1")):
            result = run("assemble", STREWN, *options)
            self.assertEqual(result.returncode, 2, (options, result.stderr))
            self.assertIn(text, result.stderr)

    def test_picture(self):
        svg = self.path / "a.svg"
        result = run("assemble", STREWN, "--svg", svg, "-q")
        self.assertEqual((result.returncode, result.stdout), (0, ""), result.stderr)
        text = svg.read_text()
        xml.dom.minidom.parseString(text)
        self.assertEqual(len(re.findall(r"[\d.]+\u00a0\u00b5m</text>", text)), 8)  # six gaps, two scale bars
        self.assertIn("750.6\u00a0\u00b5m", text)
        self.assertNotIn("nan", text)
        self.assertEqual(run("assemble", STREWN, "--svg", "-").stdout, text)

    def test_directory(self):
        out = self.path / "out"
        self.assertEqual(run("assemble", STREWN, "-o", out).returncode, 0)
        self.assertEqual(sorted(p.name for p in out.iterdir()), ["assemble.json", "assemble.svg"])

    def test_impossible(self):
        """The coupler is too long: exit 7, the joint, by how much, and the picture all the same."""
        svg = self.path / "open.svg"
        device = self.device(four_bar(half="4"))
        result = run("assemble", device, "--svg", svg, "--json")
        self.assertEqual(result.returncode, 7)
        said = json.loads(result.stdout)  # in the place of the result that there is not
        self.assertEqual(said["schema"], "flexwright.diagnostics/1")
        self.assertIn("FW-D100", result.stderr)
        self.assertRegex(result.stderr, r"joint [ABCD] stays open by")
        self.assertIn("B to C on coupler measures 8000 mm", result.stderr)
        self.assertIn("1300 mm are missing", result.stderr)
        self.assertIn("cannot be assembled", svg.read_text())
        self.assertEqual(run("simulate", device).returncode, 3)  # no scene: said before anything else

    def test_driver(self):
        driver = '<driver id="motor" joint="D" value="{} deg + 1 rad/s * time"/>\n'
        result = run("assemble", self.device(four_bar(driver=driver.format(10))))
        self.assertEqual(result.returncode, 7)
        self.assertIn("driver motor", result.stderr)
        self.assertIn("91.75 deg", result.stderr)  # crank and coupler in line
        d = self.document(self.device(four_bar(driver=driver.format(120))))
        self.assertAlmostEqual(d["after"]["rocker"][2], math.radians(120), delta=1e-14)
        self.assertEqual(d["freedom"]["dof"], 0)
        self.assertAlmostEqual(d["velocity"]["rocker"][2], 1, delta=1e-13)

    def test_text(self):
        result = run("assemble", STREWN)
        self.assertEqual(result.returncode, 0)
        for words in ("assembled in", "3 degrees of freedom", "branch: all elbows are on the side",
                      "other assemblies", "independent coordinates by pivoting"):
            self.assertIn(words, result.stdout)

    def test_check_refuses(self):
        """Masks are drawn at the stated poses: check says so and where to get better ones."""
        text = STREWN.read_text().replace('<mechanism>', '<material ref="silicon-100" thickness="50 um"/>'
                                          '<flexure id="f" kind="leaf" length="300 um" width="8 um"/>'
                                          '<mechanism>').replace('stiffness=', 'hinge="f" stiffness=')
        result = run("check", self.device(text))
        self.assertEqual(result.returncode, 3)
        self.assertIn("FW-D206", result.stderr)
        self.assertIn("flexwright assemble", result.stderr)

    def test_positions_typed_with_few_digits(self):
        """What rounding leaves open is closed for all commands alike, and said; more is an error as before."""
        leaf = (ROOT / "docs/gallery/leaf-four-bar/device.xml").read_text()

        def typed(offset_um):
            text = leaf.replace('x="0.9 mm" y="1.5 mm"', 'x="%.1f um" y="1500.1 um"' % (900 + offset_um))
            self.assertNotEqual(text, leaf)
            return self.device(text.replace('b-x="1.8 mm"', 'b-x="1800.1 um"'))

        result = run("check", "-v", typed(0.1))
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertRegex(result.stderr, r"note: the stated positions leave joints open by up to 141\.421 nm \(B\).*FW-D132")
        self.assertNotIn("FW-D206", result.stderr)
        result = run("assemble", typed(0.1))
        self.assertIn("after what rounding left open was closed", result.stdout)
        result = run("check", typed(0.5))
        self.assertEqual(result.returncode, 3)
        self.assertRegex(result.stderr, r"joint B .*0\.5099 um.*FW-D206")


if __name__ == "__main__":
    unittest.main()
