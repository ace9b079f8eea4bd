#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The device out of its plane through the program: sag against its carrier, shocks, stress gradients, modes, and required
frequencies that count both kinds."""
import json
import math
import pathlib
import re
import tempfile
import unittest

from common import ROOT, TURNED_LEAF, run

STAGE = """<device xmlns="urn:flexwright:device:1" name="stage">
<material ref="silicon-100" thickness="%s"/>%s
<flexure id="leaf" kind="leaf" length="400 um" width="6 um" gap="10 um"/><mechanism>
<body id="left" x="0 mm" y="0.75 mm" width="120 um"/>
<body id="stage" x="0.9 mm" y="1.5 mm" plate-width="0.7 mm" plate-height="0.5 mm"/>
<body id="right" x="1.8 mm" y="0.75 mm" width="120 um"/>
<revolute id="A" a="ground" b="left" b-x="0 mm" b-y="-0.75 mm" hinge="leaf"/>
<revolute id="B" a="left" a-x="0 mm" a-y="0.75 mm" b="stage" b-x="-0.9 mm" b-y="0 mm" hinge="leaf"/>
<revolute id="C" a="stage" a-x="0.9 mm" a-y="0 mm" b="right" b-x="0 mm" b-y="0.75 mm" hinge="leaf"/>
<revolute id="D" a="right" a-x="0 mm" a-y="-0.75 mm" b="ground" b-x="1.8 mm" b-y="0 mm" hinge="leaf"/></mechanism>%s
<scene name="push" duration="20 ms"><force on="stage" fx="1 uN"/>%s</scene></device>"""
GLASS = '<flow ref="silicon-on-glass" carrier="insulating"/>'
QUICK = ("--corners", "none", "--advice", "none")


class OutOfPlane(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.file = pathlib.Path(self.folder.name) / "device.xml"

    def tearDown(self):
        self.folder.cleanup()

    def stage(self, command, thickness="50 um", flow="", asked="", scene="", options=QUICK):
        self.file.write_text(STAGE % (thickness, flow, asked, scene))
        done = run(command, self.file, "--json", *options)
        self.assertIn(done.returncode, (0, 1, 4), done.stderr)
        return json.loads(done.stdout)

    def across(self, scene="", **options):
        whole = self.stage("check", scene=scene, **options)
        return whole, whole["out_of_plane"][0], whole["out_of_plane"][0]["scenes"][0]

    def test_tipping_is_said_alike(self):
        """at which load it may tip, and by how much its forces may be off: terminal and report as JSON"""
        whole, all_, scene = self.across(flow=GLASS)
        error = scene["tips_error"]
        self.assertGreater(error, 0)
        sure = scene["tips_at"] / (1 + error)
        done = run("check", self.file, *QUICK)
        said = re.search(r"  push: does not tip below ([\d.e+]+) times its forces, which may be off by ([\d.e-]+) %: sure up to ([\d.e+]+)\n", done.stdout)
        self.assertTrue(said, done.stdout)
        out = pathlib.Path(self.folder.name) / "out"
        run("plan", self.file, "-o", out, "--measurements", "none", *QUICK)
        cell = re.search(r"<td>([\d.e+]+), ([\d.e-]+) ?%</td><td>([\d.e+]+)</td><td>\w+</td></tr>", (out / "report.html").read_text().replace("\u00a0", " "))
        self.assertTrue(cell)
        for found in (said, cell):
            for text, value in zip(found.groups(), (scene["tips_at"], 100 * error, sure)):
                self.assertAlmostEqual(float(text) / value, 1, delta=6e-3)

    def test_pins_leave_out_what_flexures_do(self):
        """a force that comes at once rings on flexures and not on pins: what pins are sure of is nothing that flexures deny"""
        def sure(model):
            scene = self.across(options=(*QUICK, "--hinge-model", model))[2]
            return scene["tips_at"] / (1 + scene["tips_error"])
        pins, flexures = sure("revolute"), sure("compliance")
        self.assertLess(pins, flexures)
        self.assertGreater(pins, 0.3 * flexures)

    def test_what_is_not_drawn_tips_as_well(self):
        """an arm at the end of a thin leaf, with a mass and no outline: pressed it buckles across the plane where
        k L tan(k L) = L/e, e = 250 um from the leaf to the force, and pulled it never does"""
        length, arm, width, depth, modulus = 300e-6, 250e-6, 10e-6, 4e-6, 150e9
        low, high = 0.0, math.pi / 2
        for _ in range(60):
            q = (low + high) / 2
            low, high = (q, high) if q * math.tan(q) < length / arm else (low, q)
        buckles = modulus * width * depth ** 3 / 12 * (low / length) ** 2
        self.assertAlmostEqual(buckles, 74.9e-6, delta=0.1e-6)

        def judged(force, axis=-90):
            self.file.write_text(f'''<device xmlns="urn:flexwright:device:1" name="bare">
  <material ref="silicon-100" youngs-modulus="150 GPa" poisson="0.25" thickness="4 um" strength="1 GPa"/>
  <flexure id="leaf" kind="leaf" length="300 um" width="10 um" fillet="5 um"/>
  <mechanism>
    <body id="arm" x="0.4 mm" y="0 mm" mass="10 ug" inertia="1 ug mm^2"/>
    <revolute id="A" a="ground" b="arm" b-x="-0.4 mm" hinge="leaf" axis="{axis} deg"/>
  </mechanism>
  <scene name="push" duration="50 ms"><force on="arm" fx="{force:.9g} N" law="expression"
    factor="(1 - cos(pi*time/(50 ms)))/2"/></scene></device>''')
            done = run("check", self.file, "--json", *QUICK)
            whole = json.loads(done.stdout)
            self.assertEqual("FW-D651" in done.stderr, axis == 90)
            return whole["verdict"], [r["code"] for r in whole["reasons"]]

        for share in (1.02, 2.0):
            self.assertEqual(judged(-share * buckles), ("inconclusive", ["FW-D582"]))
        self.assertEqual(judged(-0.5 * buckles), ("accept", []))
        self.assertEqual(judged(2 * buckles), ("accept", []))
        judged(2 * buckles, 90)  # the leaf runs back over the arm, which is said

    def test_forces_of_round_off_tip_nothing(self):
        """A pure torque puts no force on its leaf but round-off, which is another one in every run: 0.172 mN over 1 mm was undecided, and 0.168 and
        0.176 accepted, since the noise of one run was 60 times that of another."""
        for push in (0.164, 0.172, 0.18):
            self.file.write_text(TURNED_LEAF)
            said = json.loads(run("check", self.file, *QUICK, "--set", f"push={push} mN", "--json").stdout)
            self.assertEqual(said["verdict"], "accept")

    def test_tips_where_it_is_pressed_though_it_was_pulled_harder(self):
        """a plate at the end of a thin leaf: a force that stays along x buckles it at EI q^2, q L tan(q L) = L/a, a from the leaf
        to the force. Pulled by 200 uN before, it is pressed by less than that."""
        length, a, width, depth, modulus = 300e-6, 450e-6, 12e-6, 5e-6, 150e9
        low, high = 0.0, 1.5
        for _ in range(60):
            q = (low + high) / 2
            low, high = (q, high) if q * math.tan(q) < length / a else (low, q)
        buckles = modulus * width * depth ** 3 / 12 * (low / length) ** 2
        self.assertAlmostEqual(buckles, 113e-6, delta=1e-6)

        def sure(table):
            self.file.write_text(f'''<device xmlns="urn:flexwright:device:1" name="plate">
  <material ref="silicon-100" youngs-modulus="150 GPa" poisson="0.25" thickness="5 um" strength="3 GPa"/>
  <flexure id="leaf" kind="leaf" length="300 um" width="12 um" fillet="6 um" gap="10 um"/>
  <mechanism>
    <body id="plate" x="0.6 mm" y="0 mm" plate-width="0.7 mm" plate-height="0.6 mm"/>
    <revolute id="A" a="ground" b="plate" b-x="-0.6 mm" hinge="leaf" axis="90 deg"/>
  </mechanism>
  <scene name="push" duration="100 ms"><force on="plate" fx="1 uN" fy="0 N" law="table" table="{table}"/></scene></device>''')
            whole = json.loads(run("check", self.file, "--json", *QUICK).stdout)
            scene = whole["out_of_plane"][0]["scenes"][0]
            codes = [r["code"] for r in whole["reasons"]]
            return scene["tips_at"] / (1 + scene["tips_error"]), "FW-D582" in codes

        pressed, tips = sure("0 ms: 0; 100 ms: -60")
        self.assertFalse(tips)
        self.assertLess(pressed * 60e-6, buckles)
        for most in (60, 100, 150, 190):  # less than the pull in all of them
            both, tips = sure(f"0 ms: 0; 20 ms: 200; 50 ms: 0; 100 ms: -{most}")
            self.assertLess(both * most * 1e-6, buckles, most)
            self.assertEqual(tips, both < 1)
        self.assertTrue(tips)

    def test_loads_in_the_plane_soften_it(self):
        """a plate on a thin leaf, pressed by a share s of what buckles it: its lowest frequency across the plane is sqrt(1 - s) times
        that at rest, of rigid plates on one bending leaf, and sqrt(1 + s) where it is pulled; it sags by 1/(1 - s) as far"""
        length, a, width, depth, modulus = 300e-6, 450e-6, 12e-6, 5e-6, 150e9
        low, high = 0.0, 1.5
        for _ in range(60):
            q = (low + high) / 2
            low, high = (q, high) if q * math.tan(q) < length / a else (low, q)
        buckles = modulus * width * depth ** 3 / 12 * (low / length) ** 2

        def judged(share, require="", gz=0.0):
            self.file.write_text(f'''<device xmlns="urn:flexwright:device:1" name="plate">
  <material ref="silicon-100" youngs-modulus="150 GPa" poisson="0.25" thickness="5 um" strength="3 GPa"/>
  <flexure id="leaf" kind="leaf" length="300 um" width="12 um" fillet="6 um" gap="10 um"/>
  <mechanism>
    <body id="plate" x="0.6 mm" y="0 mm" plate-width="0.7 mm" plate-height="0.6 mm"/>
    <revolute id="A" a="ground" b="plate" b-x="-0.6 mm" hinge="leaf" axis="90 deg"/>
  </mechanism>{require}
  <scene name="push" duration="100 ms"><force on="plate" fx="{share * buckles:.9g} N" law="ramp" rise="90 ms"/>
  <gravity gz="{gz} m/s^2"/></scene></device>''')
            return json.loads(run("check", self.file, "--json", *QUICK).stdout)

        at_rest = judged(-0.01)["out_of_plane"][0]["modes"][0]["f_Hz"]
        for share, plane in ((-0.5, "across"), (-0.3, "either"), (0.5, "across")):
            truth = at_rest * math.sqrt(1 + share)
            asked = f'<require frequency="1" plane="{plane}" scene="push" min="%s Hz" max="%s Hz"/>'
            whole = judged(share, asked % (0.8 * at_rest, 1.15 * at_rest))
            self.assertEqual(whole["verdict"], "inconclusive", share)
            low, high = whole["requirements"][0]["band"]
            self.assertTrue(low < truth < high, (share, low, truth, high))
            self.assertEqual(judged(share, asked % (0.98 * low, 1.02 * high))["verdict"], "accept")
        # what is asked for at rest knows no loads
        self.assertEqual(judged(-0.5, f'<require frequency="1" plane="across" min="{0.85 * at_rest} Hz"/>')["verdict"], "accept")
        free, pressed = (judged(share, gz=-100.0)["out_of_plane"][0]["scenes"][0]["lowest_m"] for share in (-0.001, -0.5))
        self.assertGreater(pressed / free, 2)

    def test_what_hangs_over(self):
        """a bar held in its middle: its halves droop by q l^4/(8 E I), far more than its leaf gives, and swing as cantilevers"""
        def judged(long, gz, more=""):
            self.file.write_text(f'''<device xmlns="urn:flexwright:device:1" name="wings">
<material ref="silicon-100" youngs-modulus="150 GPa" poisson="0.25" thickness="20 um" strength="3 GPa"/>{GLASS}<die tethers="no"/>
<flexure id="leaf" kind="leaf" length="100 um" width="20 um" fillet="10 um"/><mechanism>
<body id="bar" x="0 mm" y="0.5 mm" width="100 um"><plate width="{long} mm" height="100 um"/></body>
<revolute id="A" a="ground" b="bar" b-x="0 mm" b-y="-0.5 mm" hinge="leaf" axis="0 deg"/></mechanism>
<scene name="s" duration="5 ms"><force on="bar" fy="0.01 uN"/><gravity gz="{gz} m/s^2"/>{more}</scene></device>''')
            whole = json.loads(run("check", self.file, "--json", *QUICK).stdout)
            return whole["verdict"], whole["out_of_plane"][0]

        half, density, modulus, depth = 3e-3, 2329.0, 150e9, 20e-6
        droop = 1.5 * density * half ** 4 / (modulus * depth ** 2)  # m per m/s^2
        for g, verdict in ((1000.0, "accept"), (4200.0, "inconclusive")):
            got, plane = judged(6, -g)
            down = -plane["scenes"][0]["lowest_m"]
            self.assertEqual(got, verdict)
            self.assertTrue(0.95 * droop * g < down < 1.5 * droop * g, (droop * g, down))
        own = 3.516 / (2 * math.pi) * math.sqrt(modulus * depth ** 2 / 12 / density) / half ** 2
        self.assertLess(plane["modes"][0]["band_Hz"][0], (own ** -2 + plane["modes"][0]["f_Hz"] ** -2) ** -0.5)
        self.assertGreater(plane["weight_sag_m"], 9.81 * droop)
        # a ramp that takes seven periods or more sets next to nothing ringing: it does what lasts
        slow = -judged(6, 0, '<base-motion az="500 m/s^2" law="ramp" rise="1 s"/>')[1]["scenes"][0]["lowest_m"]
        still = -judged(6, -500.0)[1]["scenes"][0]["lowest_m"]
        self.assertTrue(0.999 * still < slow < 1.02 * still, (still, slow))
        # a shock that comes at once does as much twice, and more
        shaken = -judged(6, 0, '<base-motion az="500 m/s^2"/>')[1]["scenes"][0]["lowest_m"]
        self.assertTrue(1000 * droop < shaken < 25 * 500 * droop, (shaken, droop))
        # what is short hangs over by next to nothing
        self.assertLess(-judged(0.3, -1000.0)[1]["scenes"][0]["lowest_m"], 0.5e-6)

    def test_a_short_shock_throws_by_its_impulse(self):
        """A plate on a leaf with a folded arm and a head: a half sine of 3000 m/s2 that lasts 0.02 ms, a seventh of the slowest period, throws the
        head down by 1.23 um (24 modes of CalculiX from the mask, C3D15), and one of a quarter of that by a quarter. No more
        than twice that is said, and not 11 and 7.5 um"""
        def judged(az, rise):
            self.file.write_text(f'''<device xmlns="urn:flexwright:device:1" name="arm">
<material ref="silicon-100" youngs-modulus="150 GPa" poisson="0.25" thickness="50 um" strength="2 GPa"/><limits safety-factor="1.5"/>
<flow ref="silicon-on-glass"/><die tethers="no"/><flexure id="leaf" kind="leaf" length="300 um" width="14 um"/><mechanism>
<body id="p" x="0.4 mm" y="0 mm" plate-width="0.2 mm" plate-height="0.3 mm">
<bar x="0.05 mm" y="0.1 mm" to-x="0.05 mm" to-y="0.9 mm" width="24 um"/><bar x="0.038 mm" y="0.888 mm" to-x="0.6 mm" to-y="0.888 mm" width="24 um"/>
<plate x="0.6 mm" y="0.85 mm" width="150 um" height="150 um"/></body>
<revolute id="A" a="ground" a-x="0 mm" a-y="0 mm" b="p" b-x="-0.4 mm" hinge="leaf" axis="90 deg"/></mechanism>
<scene name="shock" duration="5 ms"><base-motion az="{az} m/s^2" law="half-sine" rise="{rise} ms"/></scene></device>''')
            said = json.loads(run("check", self.file, "--json", *QUICK).stdout)
            return said["verdict"], said["out_of_plane"][0]["scenes"][0]

        verdict, scene = judged(3000, 0.02)
        down, up = -scene["lowest_m"], scene["highest_m"]
        self.assertTrue(1.23e-6 < down < 2 * 1.23e-6, down)
        self.assertTrue(1.23e-6 < up < 2 * 1.23e-6, up)
        self.assertAlmostEqual(-judged(3000, 0.005)[1]["lowest_m"] / down, 0.25, delta=0.01)
        self.assertEqual(judged(6000, 0.02)[0], "accept")
        # what is as long as a period is as it was: by what modes do
        self.assertLess(-judged(3000, 0.5)[1]["lowest_m"], 6e-6)

    def test_a_known_force_bends_its_own_place(self):
        """The head of an arm that is folded twice, on a stage: a slow force on it moves it by 3.72 um along x and 0.46 along y (C3D15 of CalculiX, from the
        mask), of which rigid bodies have 2.77 and 0.04. The band holds that and is no wider than what bodies add, on the side to which
        the force pulls; it is accepted for 6 um and not for 3.6. What comes at once rings either way"""
        def judged(fx, fy, most="6 um", law='law="ramp" rise="20 ms"', measure="final", lasts="40 ms"):
            self.file.write_text(f'''<device xmlns="urn:flexwright:device:1" name="head">
<material ref="silicon-100" youngs-modulus="150 GPa" poisson="0.25" thickness="50 um" strength="2 GPa"/><limits safety-factor="1.5"/>
<flow ref="al-masked-rie"/><die tethers="no"/><flexure id="leaf" kind="leaf" length="300 um" width="12 um"/><mechanism>
<body id="left" x="0 mm" y="0.5 mm" width="100 um"/><body id="stage" x="0.6 mm" y="1 mm" plate-width="0.4 mm" plate-height="0.3 mm">
<bar x="0 mm" y="0.1 mm" to-x="0 mm" to-y="0.9 mm" width="24 um"/><bar x="-0.012 mm" y="0.888 mm" to-x="0.112 mm" to-y="0.888 mm" width="24 um"/>
<bar x="0.1 mm" y="0.9 mm" to-x="0.1 mm" to-y="0.25 mm" width="24 um"/><plate x="0.18 mm" y="0.3 mm" width="180 um" height="90 um"/></body>
<body id="right" x="1.2 mm" y="0.5 mm" width="100 um"/>
<revolute id="A" a="ground" a-x="0 mm" a-y="0 mm" b="left" b-x="0 mm" b-y="-0.5 mm" hinge="leaf"/>
<revolute id="B" a="left" a-x="0 mm" a-y="0.5 mm" b="stage" b-x="-0.6 mm" b-y="0 mm" hinge="leaf"/>
<revolute id="C" a="stage" a-x="0.6 mm" a-y="0 mm" b="right" b-x="0 mm" b-y="0.5 mm" hinge="leaf"/>
<revolute id="D" a="right" a-x="0 mm" a-y="-0.5 mm" b="ground" b-x="1.2 mm" b-y="0 mm" hinge="leaf"/></mechanism>
<probe id="tx" kind="displacement" on="stage" x="180 um" y="300 um" direction="0 deg"/>
<probe id="ty" kind="displacement" on="stage" x="180 um" y="300 um" direction="90 deg"/>
<require probe="tx" measure="{measure}" max="{most}" scene="s"/><require probe="ty" measure="{measure}" max="1 mm" scene="s"/>
<scene name="s" duration="{lasts}"><force on="stage" x="180 um" y="300 um" fx="{fx} uN" fy="{fy} uN" {law}/></scene></device>''')
            said = json.loads(run("check", self.file, "--json", *QUICK).stdout)
            return said["verdict"], [r["band"] for r in said["requirements"]]

        verdict, (x, y) = judged(40, 60)
        self.assertEqual(verdict, "accept")
        self.assertTrue(2.4e-6 < x[0] < 3.72e-6 < x[1] < 4.5e-6, x)
        self.assertTrue(0 < y[0] < 0.46e-6 < y[1] < 0.7e-6, y)
        self.assertNotEqual(judged(40, 60, "3.6 um")[0], "accept")
        back, _ = judged(-40, -60)[1]
        self.assertTrue(-4.5e-6 < back[0] < -3.72e-6 < back[1] < -2.4e-6, back)
        self.assertEqual(judged(40, 60, measure="peak")[0], "inconclusive")
        sudden = judged(40, 60, law="", lasts="2 ms")[1][0]
        self.assertGreater(sudden[1] - sudden[0], 2 * (x[1] - x[0]))

    def test_what_hangs_over_bends_in_the_plane(self):
        """a bar held in its middle, whose ends are pulled aside by F each: by F L^3/(3 E I), by m' a L^4/(8 E I) where it is shaken, and with
        3.516/(2 pi L^2) sqrt(E I/m') as a cantilever. As a rigid body it goes nowhere, and swings at 29 kHz"""
        long, wide, deep, modulus, density = 3e-3, 40e-6, 50e-6, 150e9, 2329.0
        section = deep * wide ** 3 / 12

        def judged(scene, asked):
            self.file.write_text(f'''<device xmlns="urn:flexwright:device:1" name="wings">
<material ref="silicon-100" youngs-modulus="150 GPa" poisson="0.25" thickness="50 um" strength="3 GPa"/><die clearance="100 um"/>
<flexure id="leaf" kind="leaf" length="200 um" width="10 um" fillet="10 um"/><mechanism>
<body id="bar" x="0 mm" y="0.5 mm" width="100 um"><plate width="6 mm" height="40 um"/></body>
<revolute id="A" a="ground" b="bar" b-x="0 mm" b-y="-0.5 mm" hinge="leaf" axis="0 deg"/></mechanism>
<probe id="tip" kind="displacement" on="bar" x="3 mm" y="0 mm" direction="90 deg"/>{asked}<scene name="s" duration="5 ms">{scene}</scene></device>''')
            said = json.loads(run("check", self.file, "--json", *QUICK).stdout)
            return said["verdict"], sorted((r["code"], float(re.search(r"(?:by up to|in the plane from) ([\d.e+-]+) ", r["text"])[1])) for r in said["reasons"])

        ends = "".join(f'<force on="bar" x="{x} mm" fy="20 uN"/>' for x in (3, -3))
        tip = '<require probe="tip" measure="maximum" max="2 um" scene="s"/>'
        own = 3.516 / (2 * math.pi * long ** 2) * math.sqrt(modulus * section / (density * wide * deep))  # 5.8 kHz
        goes = 20e-6 * long ** 3 / (3 * modulus * section)  # 4.5 um, and twice that where it comes at once
        verdict, reasons = judged(ends, f'{tip}<require frequency="2" plane="in" min="{own * 1.01} Hz"/>')
        self.assertEqual((verdict, [r[0] for r in reasons]), ("inconclusive", ["FW-D639", "FW-D640"]))
        # at rest and by its own mode, each as beams have it at most: 1.15 times what bodies add to 1/omega^2, 1.1 times what shapes are off by
        self.assertTrue(1.9 * goes < 1e-6 * reasons[0][1] < 2 * 1.15 * 1.1 * 1.05 * goes, (goes, reasons))
        self.assertTrue(0.85 * own < reasons[1][1] < own, (own, reasons))
        shaken = '<base-motion ay="3000 m/s^2" law="half-sine" rise="1 ms"/>'
        goes = density * wide * deep * 3000 * long ** 4 / (8 * modulus * section)  # 3.5 um
        verdict, reasons = judged(shaken, tip)
        self.assertEqual((verdict, reasons[0][0]), ("inconclusive", "FW-D639"))
        self.assertTrue(1.9 * goes < 1e-6 * reasons[0][1] < 2.4 * goes, (goes, reasons))
        self.assertEqual(judged(shaken.replace("3000", "300"), f'{tip}<require frequency="2" plane="in" min="{own / 1.4} Hz"/>'), ("accept", []))
        # 200 uN bend it by 45 um, which with its sudden double reaches the frame
        self.assertEqual(judged(ends.replace("20 uN", "200 uN"), "")[1][0][0], "FW-D638")

    def folded(self, body, scene, asked=""):
        """a plate of 1 by 0.5 mm on four leaves of 12 um, with bars of 24 um and what they hold beside it"""
        pins = "".join(f'<revolute id="{i}" axis="0 deg" a="ground" a-x="{x} mm" a-y="{y} mm" b="lo" b-x="{x} mm" b-y="{y} mm" hinge="leaf"/>'
                       for i, x, y in (("A", -0.35, -0.6), ("B", 0.35, -0.6), ("C", -0.35, 0.6), ("D", 0.35, 0.6)))
        way, pad = body
        bars = "".join(f'<bar x="{a[0]} mm" y="{a[1]} mm" to-x="{b[0]} mm" to-y="{b[1]} mm" width="24 um" ends="round"/>' for a, b in zip(way, way[1:]))
        self.file.write_text(f'''<device xmlns="urn:flexwright:device:1" name="folded">
<material ref="silicon-100" thickness="50 um" youngs-modulus="160 GPa" poisson="0.22"/><limits safety-factor="2"/>
<flow ref="silicon-on-glass" carrier="insulating"/><die tethers="no"/><flexure id="leaf" kind="leaf" length="400 um" width="12 um"/>
<mechanism><body id="lo" x="0 mm" y="0 mm" plate-width="1 mm" plate-height="0.5 mm">{bars}{pad}</body>{pins}</mechanism>
{asked}<scene name="s" duration="20 ms">{scene}</scene></device>''')
        said = json.loads(run("check", self.file, "--json", *QUICK).stdout)
        return said, [r["code"] for r in said["reasons"]]

    def test_bars_that_fold_back(self):
        """serpentines, folds and hooks hold their ends by all of their length, not by what a straight cut meets side by side: against plane solids and
        solids of CalculiX from the masks, Hz in the plane and across it. In bands, and not needlessly far below"""
        head = '<plate x="1.1 mm" y="0.85 mm" width="320 um" height="540 um"/>'
        serpentine = ((0.49, 0), (2.6, 0), (2.6, 0.2), (1, 0.2), (1, 0.4), (2.6, 0.4), (2.6, 0.6), (1.2, 0.6))
        longer = ((0.49, 0), (2.8, 0), (2.8, 0.12), (1, 0.12), (1, 0.24), (2.8, 0.24), (2.8, 0.36), (1, 0.36), (1, 0.48), (2.8, 0.48), (2.8, 0.6), (1.2, 0.6))
        fold = (((0.49, 0), (2.6, 0), (2.6, 0.4), (1.2, 0.4)), '<plate x="1.05 mm" y="0.4 mm" width="320 um" height="500 um"/>')
        hook = (((0.49, 0), (1.9, 0), (1.9, 1.4)), '<plate x="1.9 mm" y="1.55 mm" width="300 um" height="300 um"/>')
        asked = '<require frequency="1" plane="in" min="1 Hz"/><require frequency="1" plane="across" min="1 Hz"/>'
        for body, in_it, across in (((longer, head), 858, 1294), ((serpentine, head), 1214, 1689), (fold, 1818, 2749), (hook, 1948, None)):
            said, _ = self.folded(body, '<force on="lo" fx="1 uN"/>', asked)
            low = [r["band"][0] for r in said["requirements"]]
            self.assertTrue(0.9 * in_it < low[0] < in_it, (low, in_it))
            if across:
                self.assertTrue(0.8 * across < low[1] < across, (low, across))
            more, codes = self.folded(body, '<force on="lo" fx="1 uN"/>', asked.replace("1 Hz", f"{1.05 * in_it} Hz", 1))
            self.assertEqual((more["verdict"], codes), ("inconclusive", ["FW-D640"]))
        # 1000 m/s2 across: the end of the longer one comes down by 22.0 um over a hollow of 20
        said, codes = self.folded((longer, head), '<gravity gz="-1000 m/s^2"/>')
        self.assertEqual((said["verdict"], codes), ("inconclusive", ["FW-D580"]))
        self.assertTrue(22e-6 < -said["out_of_plane"][0]["scenes"][0]["lowest_m"] < 1.5 * 22e-6)
        # in the plane: 191 um of 150 between it and the frame at 14000 m/s2 (at 15000 it is not known to bear itself, either: at most 100 %, corners
        # counted three times), and 7.5 um of what a probe may move at 1000
        self.assertEqual(self.folded((serpentine, head), '<base-motion ay="-14000 m/s^2" law="ramp" rise="10 ms"/>')[1], ["FW-D638"])
        said, codes = self.folded(fold, '<base-motion ay="1000 m/s^2" law="ramp" rise="10 ms"/>',
                                  '<probe id="tip" kind="displacement" on="lo" x="1.05 mm" y="0.4 mm"/><require probe="tip" max="5 um"/>')
        self.assertEqual((said["verdict"], codes), ("inconclusive", ["FW-D639"]))
        self.assertTrue(7.5e-6 < said["requirements"][0]["band"][1] < 3 * 7.5e-6, said["requirements"])

    def test_what_a_flow_makes_tips(self):
        """a device that surely stays flat as drawn, and does not where the flow makes it thinner and softer: neither as made
        nor in a yield does it count as one that holds"""
        copper = STAGE.replace("silicon-100", "copper-plated").replace('width="6 um"', 'width="12 um"') % ("3 um", '<flow ref="copper-on-porous-silicon"/>', "", "")

        def judged(load, *more, thickness="3 um", modulus=None):
            text = copper.replace('fx="1 uN"', f'fx="{load:.4g} uN"').replace('"3 um"', f'"{thickness}"')
            self.file.write_text(text)
            sets = () if modulus is None else ("--set", f"material/@youngs-modulus={modulus}")
            done = run("check", self.file, "--json", "--advice", "none", *sets, *more)
            return json.loads(done.stdout)

        alone = judged(1, "--corners", "none")["out_of_plane"][0]["scenes"][0]["tips_at"]
        near = alone / 1.15  # uN: forces go with the load
        drawn = judged(near, "--corners", "none")
        self.assertEqual(drawn["verdict"], "accept")
        self.assertAlmostEqual(drawn["out_of_plane"][0]["scenes"][0]["tips_at"], 1.15, delta=0.05)
        made = judged(near)
        self.assertEqual(made["verdict"], "inconclusive")
        self.assertIn("may tip the device out of its plane", json.dumps(made["reasons"]))
        # a corner that is drawn says the same
        self.assertEqual(judged(near, "--corners", "none", thickness="2.7 um", modulus="85 GPa")["verdict"], "inconclusive")
        # what is farther from it than any corner can take away is accepted
        self.assertEqual(judged(alone / 8)["verdict"], "accept")
        judged(near, "--corners", "none")
        study = self.file.with_name("study.xml")
        study.write_text('<study xmlns="urn:flexwright:study:1" name="s" kind="yield" samples="200" device="device.xml"/>')
        done = run("study", study, "-o", self.file.with_name("out"), "--no-progress")
        self.assertEqual(done.returncode, 0, done.stderr)
        flow = json.loads(self.file.with_name("out").joinpath("study.json").read_text())["yields"][0]
        self.assertLess(flow["yield"], 0.95, flow)

    def test_electrodes_lift(self):
        """at the middle of a stage whose stiffness there is known: both drives over a silicon carrier, none over glass"""
        drives = "".join(f'<comb-drive id="{side}" kind="comb" on="stage" x="{x} mm" y="0 mm" direction="{turn} deg" fingers="20" '
                         f'gap="4 um" overlap="30 um" length="{long} um" voltage="30 V"/>' for side, x, turn, long in
                         (("r", 0.43, 0, 90), ("l", -0.43, 180, 90)))
        whole, all_, scene = self.across(scene=drives, flow='<flow ref="soi-deep-rie"/>')
        force = 2 * 20 * 90e-6 * 8.8541878128e-12 * 30**2 / (2 * 4e-6)
        self.assertEqual(all_["body"], "stage")
        # two forces beside the middle lift it evenly; what bodies give comes on top
        even = force / all_["stiffness_N_per_m"]
        self.assertTrue(even < scene["lift_m"] < 1.6 * even, (even, scene))
        done = run("check", self.file, *QUICK)
        self.assertEqual("FW-D596" in done.stderr, scene["lift_m"] > 0.5e-6)
        self.file.write_text(self.file.read_text().replace("30 V", "45 V"))
        again = run("check", self.file, "--json", *QUICK)
        self.assertAlmostEqual(json.loads(again.stdout)["out_of_plane"][0]["scenes"][0]["lift_m"] / scene["lift_m"], 2.25, delta=1e-6)
        self.assertRegex(again.stderr, r"lift body \w+ by up to [0-9.]+ um.*FW-D596")
        glass = self.across(scene=drives, flow=GLASS)[2]
        self.assertEqual(glass["lift_m"], 0)

    def test_nothing_asked(self):
        whole, all_, scene = self.across()
        self.assertEqual(whole["verdict"], "accept")
        self.assertNotIn("lowest_m", scene)
        self.assertTrue(all_["known"])
        first = all_["modes"][0]
        self.assertLess(first["band_Hz"][0], first["f_Hz"])
        self.assertGreater(first["band_Hz"][1], first["f_Hz"])
        self.assertGreater(scene["tips_at"], 1)
        self.assertGreater(all_["stiffness_over_in_plane"], 1)
        # stiffness across goes with the depth's cube, or of the torsion with the depth
        thin = self.across(thickness="25 um")[1]
        self.assertTrue(2 < all_["stiffness_N_per_m"] / thin["stiffness_N_per_m"] < 8)

    def test_comes_down_on_its_carrier(self):
        whole, all_, one = self.across('<gravity gz="-9.80665 m/s^2"/>', flow=GLASS)
        self.assertEqual(whole["verdict"], "accept")
        # what hangs over its hinges bends besides by its weight, of plates that are short by next to nothing
        self.assertTrue(1 - 1e-3 < -one["lowest_at_rest_m"] / all_["weight_sag_m"] < 1)
        gap = all_["below"]["gap_m"]
        self.assertAlmostEqual(gap, 20e-6)
        per = one["lowest_at_rest_m"] / 9.80665
        # the hollow is 22 um deep at most, and surely met where that is left with all that stiffness may be off by
        for share, verdict in ((0.5, "accept"), (1.02, "inconclusive"), (1.1, "inconclusive"), (2, "reject")):
            pull = f'<gravity gz="{gap * share / per} m/s^2"/>'
            whole, _, now = self.across(pull, flow=GLASS)
            self.assertEqual(whole["verdict"], verdict)
            self.assertAlmostEqual(now["lowest_at_rest_m"] / (-share * gap), 1, 6)
            self.assertEqual(verdict != "accept", "580" in json.dumps(whole["reasons"]))
        up = self.across(f'<gravity gz="{-2 * gap / per} m/s^2"/>', flow=GLASS)[0]
        self.assertEqual(up["verdict"], "accept")  # upwards there is nothing

    def test_weight_that_nobody_states(self):
        """a heavy stage would lie on its glass: a scene that does not say which way is down is undecided, one that says so is
        judged as it comes down, or not at all where the device stands on edge"""
        sag = self.across(flow=GLASS)[1]["weight_sag_m"]
        self.assertLess(sag, 1e-6)
        for heavy, said in (("0.5 mg", "accept"), ("30 mg", "inconclusive")):
            options = QUICK + ("--set", f"body[stage]/@mass={heavy}", "--set", "body[stage]/@inertia=10 mg mm^2")
            whole, all_, _ = self.across(flow=GLASS, options=options)
            self.assertEqual(whole["verdict"], said)
            self.assertEqual(all_["weight_sag_m"] > all_["below"]["gap_m"], said != "accept")
            self.assertEqual("FW-D673" in json.dumps(whole), said != "accept")
        self.assertNotIn("FW-D673", json.dumps(self.across(options=options)[0]))  # nothing is known to be below it
        # what shakes it is not its weight, which adds to it; where that alone brings it down nothing is open but that. Of what is
        # below it the least counts, and is said
        heavy = QUICK + ("--set", "body[stage]/@mass=1.5 mg", "--set", "body[stage]/@inertia=1 mg mm^2")
        sag = self.across(flow=GLASS, options=heavy)[1]["weight_sag_m"]
        for share, number in ((0.6, "673"), (1.5, "580")):
            az = share * 18e-6 / sag * 9.81 / 2
            said = self.across(f'<base-motion az="{az} m/s^2"/>', flow=GLASS, options=heavy)[0]["reasons"]
            texts = [r["text"] for r in said if number in r["code"]]
            self.assertEqual((len(texts), len(said)), (1, 1), said)
            self.assertIn("(a hollow of 20 um in its carrier), of which 18 um are sure", texts[0])
            self.assertEqual("by what shakes it there and its weight, " in texts[0], number == "673")
        flat = self.across('<gravity gz="-9.81 m/s^2"/>', flow=GLASS, options=options)[0]
        self.assertEqual(flat["verdict"], "reject")
        self.assertNotIn("FW-D673", json.dumps(flat))
        edge = self.across('<gravity gy="-9.81 m/s^2"/>', flow=GLASS, options=options)[0]
        self.assertNotIn("FW-D673", json.dumps(edge))

    def test_shock(self):
        still = self.across('<gravity gz="-100 m/s^2"/>')[2]
        at_once = self.across('<base-motion az="100 m/s^2"/>')[2]
        slow = self.across('<base-motion az="100 m/s^2" law="ramp" rise="15 ms"/>')[2]
        self.assertEqual(at_once["dynamic"], 2)
        self.assertLess(slow["dynamic"], 1.1)
        # "dynamic" is of the modes of plates; what hangs over answers with its own, and each bound lies a few percent above what it bounds
        self.assertAlmostEqual(at_once["lowest_m"] / slow["lowest_m"] * slow["dynamic"] / 2, 1, 2)
        self.assertGreater(at_once["lowest_m"] / still["lowest_m"], 2)  # the modes' sizes are added
        self.assertLess(at_once["lowest_m"] / still["lowest_m"], 3)
        self.assertEqual(at_once["lowest_at_rest_m"], 0)

    def test_a_scene_that_ends_with_its_shock(self):
        """What a pulse sets ringing goes on where the scene ends, or within the pulse: the sag, the hinges' strain and what may touch
        are those of a scene that lasts. Of a pulse far shorter than the period that is what its impulse leaves, a w 2 rise/pi over
        w^2 of the mode that goes up and down, and little more by the others."""
        shock = '<base-motion az="5000 m/s^2" law="half-sine" rise="0.01 ms"/>'
        still = self.across('<gravity gz="-1 m/s^2"/>')
        low = still[1]["modes"][0]["band_Hz"][0] * 2 * math.pi
        leaves = -still[2]["lowest_m"] * 5000 * low * 2 * 0.01e-3 / math.pi
        seen = []
        for lasts in ("0.006 ms", "0.01 ms", "5 ms"):
            self.file.write_text((STAGE % ("50 um", GLASS, "", shock)).replace("1 uN", "1 nN").replace('duration="20 ms"', f'duration="{lasts}"'))
            whole = json.loads(run("check", self.file, "--json", *QUICK).stdout)
            now = whole["out_of_plane"][0]["scenes"][0]
            seen.append((now["lowest_m"], now["strained"]))
            self.assertTrue(0.95 * leaves < -now["lowest_m"] < 2 * leaves, (lasts, leaves, now))
            self.assertEqual(whole["verdict"], "inconclusive" if -now["lowest_m"] > 18e-6 else "accept")
        for short in seen[:2]:
            self.assertAlmostEqual(short[0] / seen[2][0], 1, 2)
            self.assertLess(abs(short[1] - seen[2][1]), 0.03 * seen[2][1])

    def test_a_shock_bends_its_hinges(self):
        """one that the device's frequencies do not see is no fault of theirs; one that bends hinges past their limit is never
        accepted, weight that does so at rest is rejected, and both grow with what acts"""
        shock = '</scene><scene name="drop" duration="5 ms"><base-motion az="%s km/s^2" law="half-sine" rise="0.5 ms"/>'
        lasts = '<require frequency="1" min="1 Hz" plane="in"/>'
        used = []
        for a in ("0.1", "0.4", "20"):
            whole = self.stage("check", scene=shock % a, asked=lasts)
            drop = whole["out_of_plane"][0]["scenes"][1]
            self.assertEqual(drop["scene"], "drop")
            self.assertEqual(drop["strained_sure"], 0)
            used.append(drop["strained"])
            reasons = [r for r in whole["reasons"] if "across the plane" in r["text"]]
            self.assertEqual(bool(reasons), drop["strained"] > 1)
            self.assertEqual(whole["verdict"], "inconclusive" if reasons else "accept", whole["reasons"])
        self.assertAlmostEqual(used[1] / used[0], 4, places=2)
        self.assertGreater(used[2], 1)
        weight = '<gravity gz="%s km/s^2"/>'
        little, much = (self.across(scene=weight % g) for g in ("-0.2", "-50"))
        self.assertAlmostEqual(much[2]["strained_sure"] / little[2]["strained_sure"], 250, places=6)
        self.assertEqual(much[0]["verdict"], "reject")
        self.assertTrue(any("bends across the plane" in r["text"] for r in much[0]["reasons"]))
        self.assertEqual(little[0]["verdict"], "accept")

    def test_what_is_used_in_the_plane_is_added(self):
        """a shock uses as much of a hinge beside a push as without one, with all that the push may use: of a scene that does not govern the
        hinge its own use, widened by the band of what does"""
        shock = '<base-motion az="0.2 km/s^2"/>'  # at once: twice as much as at rest, at any frequency
        def of(*scenes):
            self.file.write_text((STAGE % ("50 um", "", "", "")).split("<scene")[0] + "".join(
                f'<scene name="s{i}" duration="20 ms"><force on="stage" fx="{push} uN"/>{more}</scene>'
                for i, (push, more) in enumerate(scenes)) + "</device>")
            whole = json.loads(run("check", self.file, "--json", *QUICK).stdout)
            self.assertEqual(whole["verdict"], "accept", whole["reasons"])
            scenes = whole["out_of_plane"][0]["scenes"]
            # what is pressed in the plane is softer across it
            left = [1 - (1 + s["tips_error"]) / s["tips_at"] if s["tips_at"] else 1 for s in scenes]
            return whole["hinges"], [(s.get("strained"), l) for s, l in zip(scenes, left)]
        _, ((alone, _),) = of((0, shock))
        strong, ((both, left),) = of((40, shock))
        self.assertAlmostEqual(both, alone / left + max(h["utilisation_band"][1] for h in strong), 5)
        weak, _ = of((15, ""))
        two, ((first, _), (second, left)) = of((40, shock), (15, shock))
        self.assertAlmostEqual(first, both, 9)
        self.assertAlmostEqual(second, alone / left + max(w["utilisation"] * h["utilisation_band"][1] / h["utilisation"] for w, h in zip(weak, two)), 5)
        self.assertGreater(first - second, 0.1)

    def test_repeated_shocks(self):
        """a shock that hinges bear once is not accepted ten million times, and one that is a tenth of it is"""
        shock = '</scene><scene name="drop" duration="5 ms"><base-motion az="%s km/s^2" law="half-sine" rise="0.5 ms"/>'
        lasts = '<require frequency="1" min="1 Hz" plane="in"/>'
        repeated = '<limits safety-factor="2" cycles="1e7"/>'
        single = '<limits safety-factor="2"/>'
        once = self.stage("check", scene=shock % "0.1", asked=lasts, flow=single)
        used = once["out_of_plane"][0]["scenes"][1]["strained"]
        strong = f"{0.1 * 0.9 / used:.4g}"
        for flow, a, verdict in ((single, strong, "accept"), (repeated, strong, "inconclusive"), (repeated, f"{0.01 * 0.9 / used:.4g}", "accept")):
            whole = self.stage("check", scene=shock % a, asked=lasts, flow=flow)
            self.assertEqual(whole["verdict"], verdict, whole["reasons"])
            self.assertEqual(any("repetitions of scene drop" in r["text"] for r in whole["reasons"]), verdict != "accept")

    def test_a_stress_gradient_bends_its_hinges(self):
        """it lifts what it curls, and the flexures on the ground hold that: in proportion, and rejected where it is past their limit"""
        used = []
        for gradient in (1, 2, 4000):
            whole, _, now = self.across(f'<residual-stress gradient="{gradient} MPa/um"/>', flow='<limits safety-factor="2"/>')
            used.append((now["strained_sure"], now["strained"], whole["verdict"]))
        self.assertGreater(used[0][0], 0)
        self.assertAlmostEqual(used[1][0] / used[0][0], 2, places=6)
        self.assertAlmostEqual(used[2][0] / used[0][0], 4000, places=2)
        self.assertEqual(used[0][2], "accept")
        self.assertEqual(used[2][2], "reject")

    def test_a_shaker_at_a_resonance(self):
        """N periods of a sine at the lowest frequency across the plane do pi N times what its amplitude does at rest, the stiffness
        known or not; far from it a few times"""
        still = self.across(scene='<gravity gz="-10 m/s^2"/>')
        f = still[1]["modes"][0]["f_Hz"]
        down = {}
        for times, name in ((1, "there"), (1.02, "near"), (0.3, "below")):
            shake = f'<base-motion az="10 m/s^2" law="sine" frequency="{times * f} Hz"/>'
            down[name] = -self.across(scene=shake)[2]["lowest_m"]
        rest = -still[2]["lowest_m"]
        periods = 0.02 * f
        # at rest of flexures as soft as they may be, whose resonance is not there
        self.assertGreater(down["there"], 0.95 * 3.1416 * periods * rest / (1 + still[1]["stiffness_error"]))
        self.assertLess(down["there"], 1.3 * 3.1416 * periods * rest)
        self.assertGreater(down["near"], 0.9 * down["there"])
        self.assertLess(down["below"], 2.2 * rest)
        # a frequency is off by half of what its stiffness is off by, and no more: three quarters of that is beside the resonance, which
        # 200 ms tell apart
        long, moved = STAGE.replace('"20 ms"', '"200 ms"'), []
        for times in (1, 1 + 0.75 * still[1]["stiffness_error"]):
            self.file.write_text(long % ("50 um", "", "", f'<base-motion az="10 m/s^2" law="sine" frequency="{times * f} Hz"/>'))
            moved.append(json.loads(run("check", self.file, "--json", *QUICK).stdout)["out_of_plane"][0]["scenes"][0]["lowest_m"])
        self.assertLess(moved[1] / moved[0], 0.3)

    def test_strain_of_a_plate_on_a_leaf(self):
        """at least that of a cantilever, m g (L/2 + dx) over its section; at most twice it and what its twist warps, and half its shear"""
        done = run("check", ROOT / "tests/data/theory/plate.xml", "--json", *QUICK)
        whole = json.loads(done.stdout)
        scene = whole["out_of_plane"][0]["scenes"][0]
        limit = whole["hinges"][0]["strain_limit"]
        moment = 0.05e-6 * 9.80665 * (150e-6 + 600e-6)
        bends = 6 * moment / (10e-6 * (40e-6) ** 2 * 150e9)
        error = whole["out_of_plane"][0]["stiffness_error"]
        self.assertAlmostEqual(scene["strained_sure"] * (1 + error) * limit / bends, 1, places=6)
        twist = 0.05e-6 * 9.80665 * 100e-6 / (150e9 / 2.5 * 11233e-24)  # J of the page
        most = 2 * (bends + twist * 10e-6 * math.sqrt(3 / 2.5)) + 0.5 * twist * 10e-6
        across = (scene["strained"] - whole["hinges"][0]["utilisation_band"][1]) * limit / (1 + error)
        self.assertAlmostEqual(across / most, 1, places=3)

    def test_ledger(self):
        """nothing in the plane moves otherwise, whatever acts across it"""
        def simulated(scene):
            found = self.stage("simulate", scene=scene, options=("--scene", "push", "--effects", "all"))
            return found, next(e for e in found["effects"] if e["id"] == "out-of-plane")
        plain, gone = simulated("")
        self.assertFalse(gone["called_for"])
        sagging, there = simulated('<gravity gz="-9.8 m/s^2"/>')
        self.assertTrue(there["called_for"])
        self.assertTrue(0 < there["bound"] < 1e-4, there["bound"])
        self.assertEqual(plain["final"], sagging["final"])
        four = simulated('<gravity gz="-39.2 m/s^2"/>')[1]["bound"]
        self.assertAlmostEqual(four / there["bound"], 16, 1)

    def test_gradient(self):
        up = self.across('<residual-stress gradient="1 MPa/um"/>')[2]
        down = self.across('<residual-stress gradient="-1 MPa/um"/>')[2]
        self.assertGreater(up["highest_m"], 1e-6)
        self.assertAlmostEqual(up["highest_m"] / -down["lowest_m"], 1, 9)  # the mirror image of each other
        self.assertAlmostEqual(up["lowest_m"], -down["highest_m"], 18)

    def test_a_gradient_lifts_one_arm_all_along(self):
        """one body on one clamped leaf lies on one sphere that touches the ground at the clamp: nothing
        is below the plane where it curls up, and its corners are where that sphere has them. Tangent planes are far below a sphere"""
        self.file.write_text('''<device xmlns="urn:flexwright:device:1" name="arm"><material ref="silicon-100" thickness="50 um"/>
            <flexure id="leaf" kind="leaf" length="400 um" width="10 um" gap="12 um"/><mechanism><body id="arm" x="0 mm" y="0.75 mm" width="120 um"/>
            <revolute id="A" a="ground" a-x="0 mm" a-y="0 mm" b="arm" b-x="0 mm" b-y="-0.75 mm" hinge="leaf"/></mechanism>
            <scene name="push" duration="20 ms"><force on="arm" fx="1 uN"/></scene><scene name="curls" duration="20 ms">
            <residual-stress gradient="1 MPa/um"/><force on="arm" fx="1 uN"/></scene><scene name="droops" duration="20 ms">
            <residual-stress gradient="-1 MPa/um"/><force on="arm" fx="1 uN"/></scene></device>''')
        whole = json.loads(run("check", self.file, "--json", *QUICK).stdout)
        up, down = (next(s for s in whole["out_of_plane"][0]["scenes"] if s["scene"] == name) for name in ("curls", "droops"))
        self.assertEqual((up["lowest_m"], up["lowest_at_rest_m"], down["highest_m"]), (0, 0, 0))
        self.assertAlmostEqual(up["highest_m"], -down["lowest_m"], 15)
        # the outer corners are rounded by 10 um about (50, 940 um) from the clamp
        far = math.hypot(50e-6, 940e-6) + 10e-6
        kappa = 1e12 / (165.7e9 + 63.9e9 - 2 * 63.9e9**2 / 165.7e9)  # of (100) silicon, in every direction of the plane
        self.assertAlmostEqual(down["lowest_at_rest_m"] / (-kappa * far**2 / 2), 1, 5)

    def test_whole_solid(self):
        """the gallery's four-bar of an even material, pushed across the plane at its coupler: CalculiX 2.20, every leaf a
        solid with its roots, bodies rigid (the deck of `hinge --deck` with its middle plane antisymmetric)"""
        text = (ROOT / "docs/gallery/leaf-four-bar/device.xml").read_text()
        for gone in (r"<spring[^>]*/>", r"<gravity[^>]*/>", r"<flow[^>]*/>"):
            text = re.sub(gone, "", text)
        self.file.write_text(text.replace('thickness="50 um"', 'thickness="50 um" youngs-modulus="150 GPa" poisson="0.25"'))
        all_ = json.loads(run("check", self.file, "--json", *QUICK).stdout)["out_of_plane"][0]
        self.assertEqual(all_["body"], "coupler")
        self.assertAlmostEqual(all_["stiffness_N_per_m"] * 0.2983686, 1, 2)

    def test_a_law_that_nothing_bounds(self):
        """forces beside the centre, and shocks, whose law is a formula of whose largest value nothing is proved"""
        law = 'law="expression" factor="atan2(time, 20 ms)/(1 rad)"'
        whole, _, one = self.across(f'<force on="stage" x="0.1 mm" fx="1 uN" {law}/>')
        self.assertEqual(whole["verdict"], "accept")
        bounded = self.across('<force on="stage" x="0.1 mm" fx="1 uN" law="ramp" rise="15 ms"/>')[2]
        self.assertTrue(1 < one["tips_at"] <= bounded["tips_at"], (one["tips_at"], bounded["tips_at"]))
        shaken = self.across(f'<base-motion az="100 m/s^2" {law}/>', flow=GLASS)
        self.assertEqual(shaken[0]["verdict"], "inconclusive")
        self.assertIn("580", json.dumps(shaken[0]["reasons"]))
        etched_through = self.across(f'<base-motion az="100 m/s^2" {law}/>')  # nothing is below it
        self.assertEqual(etched_through[0]["verdict"], "inconclusive")
        self.assertIn("nothing bounds the law", json.dumps(etched_through[0]["reasons"]))
        self.assertIsNone(etched_through[2]["strained"])

    def test_a_law_that_is_bounded_by_intervals(self):
        """a formula whose largest value is proved is judged as a ramp of that size is, and a shock of it is decided"""
        law = 'law="expression" factor="(1 - cos(pi*time/(20 ms)))/2"'
        whole, _, one = self.across(f'<force on="stage" x="0.1 mm" fx="1 uN" {law}/>')
        self.assertEqual(whole["verdict"], "accept")
        ramp = self.across('<force on="stage" x="0.1 mm" fx="1 uN" law="ramp" rise="15 ms"/>')[2]
        self.assertAlmostEqual(one["tips_at"] / ramp["tips_at"], 1, delta=0.05)
        shaken = self.across(f'<base-motion az="100 m/s^2" {law}/>', flow=GLASS)
        self.assertNotIn("580", json.dumps(shaken[0]["reasons"]))

    def test_required_frequency_counts_both(self):
        thin = "6 um"
        whole, all_, _ = self.across(thickness=thin)
        modes = self.stage("modes", thickness=thin, options=())
        inner, outer = modes["modes"][0]["f_Hz"], modes["out_of_plane"]["modes"][0]["f_Hz"]
        self.assertAlmostEqual(all_["modes"][0]["f_Hz"] / outer, 1, 9)
        self.assertLess(outer, 0.8 * inner)
        between = f'{(outer * inner) ** 0.5} Hz'
        for plane, verdict in ((' plane="in"', "accept"), ("", "reject"), (' plane="across"', "reject")):
            whole = self.stage("check", thickness=thin, asked=f'<require frequency="1" min="{between}"{plane}/>')
            self.assertEqual(whole["verdict"], verdict, plane)
            self.assertAlmostEqual(whole["requirements"][0]["value"] / (inner if "in" in plane else outer), 1, 6)
        probes = self.stage("modes", thickness=thin, options=(), asked="".join(
            f'<probe id="{plane}" kind="frequency" mode="1" plane="{plane}"/>' for plane in ("in", "across", "either")))["probes"]
        self.assertEqual([p["value"] for p in probes], [inner, outer, outer])

    def test_mistakes(self):
        for asked, number in (('<probe id="p" kind="angle" on="stage" plane="in"/>', "FW-D320"),
                              ('<probe id="p" kind="angle" on="stage"/><require probe="p" max="1 deg" plane="in"/>', "FW-D322")):
            self.file.write_text(STAGE % ("50 um", "", asked, ""))
            done = run("check", self.file)
            self.assertEqual(done.returncode, 3)
            self.assertIn(number, done.stderr)

    def test_plate_of_the_page(self):
        done = run("modes", ROOT / "tests/data/theory/plate.xml")
        self.assertIn("out of the plane, of rigid bodies", done.stdout)


LONG_LEAF = """<device xmlns="urn:flexwright:device:1" name="long-leaf"><material ref="silicon-100" thickness="50 um" youngs-modulus="150 GPa"/>
<limits safety-factor="1.5"/><flow ref="al-masked-rie"/><flexure id="leaf" kind="leaf" length="2.4 mm" width="24 um" fillet="12 um"/><mechanism>
<body id="head" x="0 mm" y="1.45 mm" plate-width="0.2 mm" plate-height="0.3 mm" mass="8e-3 mg" inertia="1e-4 mg mm^2"/>
<revolute id="A" a="ground" b="head" b-y="-1.45 mm" hinge="leaf" axis="0 deg"/></mechanism>
<probe id="way" kind="displacement" on="head" direction="0 deg"/>%s<scene name="shaken" duration="%s"><base-motion %s/>
<material-damping loss-factor="0.02"/></scene><die clearance="900 um"/></device>"""
TWO_LEAVES = """<device xmlns="urn:flexwright:device:1" name="two-leaves"><material ref="silicon-100" thickness="50 um" youngs-modulus="150 GPa"/>
<limits safety-factor="1.5"/><flow ref="al-masked-rie"/><flexure id="leaf" kind="leaf" length="%s" width="8 um" fillet="8 um"/><mechanism>
<body id="stage" x="0 mm" y="2.4 mm" plate-width="2.6 mm" plate-height="0.3 mm"/>
<revolute id="A" a="ground" a-x="-1.2 mm" a-y="1 mm" b="stage" b-x="-1.2 mm" b-y="-1.4 mm" hinge="leaf" axis="0 deg"/>
<revolute id="B" a="ground" a-x="1.2 mm" a-y="1 mm" b="stage" b-x="1.2 mm" b-y="-1.4 mm" hinge="leaf" axis="0 deg"/></mechanism>
<scene name="shake" duration="20 ms"><base-motion ax="12000 m/s^2" law="sine" frequency="%s"/>
<material-damping loss-factor="%s"/></scene><die clearance="600 um"/></device>"""


TWO_STAGES = """<device xmlns="urn:flexwright:device:1" name="two-stages"><material ref="silicon-100" thickness="50 um" youngs-modulus="150 GPa"/>
<limits safety-factor="1.5"/><flow ref="al-masked-rie"/><flexure id="la" kind="leaf" length="1.5 mm" width="12 um" fillet="6 um"/>
<flexure id="lb" kind="leaf" length="1.2 mm" width="10 um" fillet="5 um"/><mechanism>
<body id="one" x="0 mm" y="1.7 mm" plate-width="0.36 mm" plate-height="0.36 mm" mass="2e-2 mg" inertia="4e-4 mg mm^2"/>
<body id="two" x="1.6 mm" y="1.7 mm" plate-width="0.36 mm" plate-height="0.36 mm" mass="1e-2 mg" inertia="2e-4 mg mm^2"/>
<revolute id="A" a="ground" a-y="0.75 mm" b="one" b-y="-0.95 mm" hinge="la" axis="0 deg"/>
<revolute id="B" a="one" a-x="0.8 mm" b="two" b-x="-0.8 mm" hinge="lb" axis="90 deg"/></mechanism>
<scene name="s" duration="10 ms"><base-motion ax="%s m/s^2" law="sine" frequency="%s Hz"/><material-damping loss-factor="0.02"/></scene>
<die clearance="900 um"/></device>"""


class FlexuresWeigh(unittest.TestCase):
    """Flexures' own mass, which no motion has, in the bands: against frames of beams with their mass (Euler and Bernoulli, 24 elements of
    cubics a leaf, the head or stage rigid with what the file states)"""
    def check(self, text):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "device.xml"
            file.write_text(text)
            done = run("check", file, "--json", *QUICK)
        self.assertIn(done.returncode, (0, 1, 4), done.stderr)
        whole = json.loads(done.stdout)
        self.said = done.stderr
        return whole, whole["hinges"][0], {r["probe"]: r for r in whole["requirements"]}

    def test_modes_across_the_plane(self):
        """a leaf of 6.7e-9 kg with a head of 8e-9: 4.03 kHz, and 41.3 kHz, which is the leaf; without its mass 4.31 and 129. Across the
        plane its base, 0.9 mm long and 8 times as wide as the leaf, is a tenth of that: integral of x^2/w, as of a stepped cantilever"""
        whole, _, asked = self.check(LONG_LEAF % (
            '<require frequency="1" plane="across" min="4.06 kHz"/><require frequency="2" plane="across" min="60 kHz"/>',
            "10 ms", 'ax="1 m/s^2" law="half-sine" rise="4 ms"'))
        for name, truth, at_least in (("frequency-1", 4030, 0.87), ("frequency-2", 41300, 0.9)):
            low, high = asked[name]["band"]
            self.assertLess(low, truth, name)
            self.assertGreater(low, at_least * truth, name)
            self.assertEqual(asked[name]["verdict"], "inconclusive", name)

    def test_a_shock_and_a_shaker(self):
        """the same leaf: 95000 m/s^2 for 4 ms strain it by 112 % where its mass is counted; shaken by 1900 Hz the head goes 1188 um,
        since its mode lies at 1960 Hz, and not at 2095"""
        whole, hinge, _ = self.check(LONG_LEAF % ("", "10 ms", 'ax="95000 m/s^2" law="half-sine" rise="4 ms"'))
        self.assertEqual(whole["verdict"], "inconclusive")
        self.assertGreater(hinge["utilisation_band"][1], 1.12)
        self.assertLess(hinge["utilisation_band"][1], 1.2)
        _, _, asked = self.check(LONG_LEAF % ('<require probe="way" measure="peak" max="500 um" scene="shaken"/>', "20 ms",
                                              'ax="7500 m/s^2" law="sine" frequency="1900 Hz"'))
        way = asked["way"]
        self.assertEqual(way["verdict"], "inconclusive")
        self.assertGreater(way["band"][1], 1188e-6)
        self.assertLess(way["band"][1], 1188e-6 * 1.6)

    def test_two_stages_in_a_row(self):
        """shaken at the third to fifth mode of the device with its leaves' mass (without it the third is 15.6 kHz): leaves bear 1.25
        times what frames of beams have beside the fillets, in % of what is allowed"""
        for hertz, size, truth in ((3000, 5000, (11.8, 11.0)), (12204, 5000, (9.6, 8.2)), (21953, 5000, (2.8, 4.7)), (48588, 20000, (12.9, 4.1))):
            whole, _, _ = self.check(TWO_STAGES % (size, hertz))
            for hinge, is_ in zip(whole["hinges"], truth):
                low, high = hinge["utilisation_band"]
                self.assertLess(low, 0.0125 * is_, (hertz, hinge["id"]))
                self.assertGreater(high, 0.0125 * is_, (hertz, hinge["id"]))
                self.assertLess(high, 2 * 0.0125 * is_, (hertz, hinge["id"]))

    def test_a_leaf_swings_between_its_ends(self):
        """two leaves at their own 16.5 kHz, while the stage hardly moves: 300 MPa beside the fillets with a loss of 0.01 and 844 with
        0.001, of 667 that are allowed; at 4 kHz hardly more than without their mass"""
        whole, hinge, _ = self.check(TWO_LEAVES % ("2 mm", "16.5 kHz", "0.01"))
        self.assertGreater(hinge["utilisation_band"][1], 300 / 667)
        self.assertLess(hinge["utilisation_band"][1], 2 * 300 / 667)
        self.assertIn("FW-D726", self.said)
        whole, hinge, _ = self.check(TWO_LEAVES % ("2 mm", "16.5 kHz", "0.001"))
        self.assertEqual(whole["verdict"], "inconclusive")
        _, hinge, _ = self.check(TWO_LEAVES % ("2 mm", "4 kHz", "0.01"))
        self.assertLess(hinge["utilisation_band"][1], 1.1 * hinge["utilisation"])


if __name__ == "__main__":
    unittest.main()
