#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Equilibria of devices whose legs heat presses beyond their clamped buckling load before anything moves. References: own
corotational beam finite elements (Euler-Bernoulli, 16 to 24 elements a leg), heated step by step; and Euler's load of a
guided leg, below which a straight chevron stays in its middle."""
import json
import math
import pathlib
import re
import tempfile
import unittest

from common import ALL, ROOT, run

LEG = ('<revolute id="{id}" a="ground" a-x="{s}X" a-y="{r}row-D" b="shuttle" b-x="{s}X" b-y="{r}row-D" hinge="leg" '
       'axis="{axis}"/>')


def chevron(material='ref="silicon-100" thickness="50 um"', flow="soi-deep-rie", width=6, tilt=4, heat=100, load=0,
            substrate='expansion="2.57 ppm/K" substrate-expansion="0 ppm/K"', safety=2, air=""):
    legs = "".join(LEG.format(id=n, s=s, r=r, axis="th-90 deg" if s == "-" else "90 deg-th")
                   for n, s, r in (("A", "-", ""), ("B", "", ""), ("C", "-", "-"), ("D", "", "-")))
    warm = f'<temperature change="{heat} K" {substrate} law="ramp" rise="20 ms"/>' if heat else ""
    return f"""<device xmlns="urn:flexwright:device:1" name="chevron">
<parameter name="len" value="400 um"/><parameter name="th" value="{tilt} deg"/>
<parameter name="row" value="360 um"/><parameter name="X" value="250 um + len/2*cos(th)"/>
<parameter name="D" value="len/2*sin(th)"/>
<material {material}/><limits safety-factor="{safety}"/><flow ref="{flow}"/><die release-pitch="110 um"/>
<flexure id="leg" kind="leaf" length="len" width="{width} um"/>
<mechanism><body id="shuttle" x="0 mm" y="0 mm" plate-width="0.4 mm" plate-height="2*row+0.2 mm"/>{legs}</mechanism>
<probe id="stroke" kind="displacement" on="shuttle" direction="90 deg"/>
<scene name="hot" duration="{14 if air else 40} ms">{warm}
<force on="shuttle" fy="-{load} uN" law="ramp" rise="{8 if air else 20} ms"/>{air}</scene></device>"""


class Heated(unittest.TestCase):
    def setUp(self):
        self.place = tempfile.TemporaryDirectory()
        self.file = pathlib.Path(self.place.name) / "device.xml"

    def tearDown(self):
        self.place.cleanup()

    def answer(self, command, *more, **device):
        self.file.write_text(chevron(**device))
        done = run(command, self.file, *more, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    def stroke_um(self, *more, **device):
        found = self.answer("statics", *more, **device)
        self.assertEqual(found["stable"], True)
        return 1e6 * found["probes"][0]["value"]

    def test_references(self):
        """1 %: the references are of the shuttle's middle, and have a leg's length without what its roots give"""
        copper = dict(material='ref="copper-plated" thickness="30 um"', flow="copper-on-porous-silicon", width=10,
                      tilt=6, substrate='expansion="16.7 ppm/K" substrate-expansion="2.57 ppm/K"')
        for device, reference in ((dict(heat=178), 3.782), (dict(heat=300), 6.111), (dict(heat=300, tilt=1), 12.39),
                                  (dict(heat=200, tilt=2, load=1000), 6.11), (copper, 7.51)):
            with self.subTest(device=device):
                self.assertAlmostEqual(self.stroke_um(**device) / reference, 1, delta=0.01)

    def test_where_it_began_from_the_drawn_pose(self):
        """174 K: as it was, with exact beams; the strokes beside it lie on one line"""
        a, b, c = (self.stroke_um("--hinge-model", "elastica", heat=t) for t in (170, 174, 178))
        self.assertAlmostEqual(b, 3.708205271367508, delta=1e-9)  # 3.70031 in lengths of the layer, about the anchors' mean
        self.assertAlmostEqual((a + c) / (2 * b), 1, delta=1e-4)

    def test_the_path_begins_there(self):
        found = self.answer("statics", "--path", heat=300, load=100)
        self.assertTrue(found["path"]["complete"])
        self.assertAlmostEqual(self.stroke_um(heat=300, load=100), 1e6 * found["probes"][0]["value"], delta=1e-6)
        done = run("statics", self.file, "--path")
        self.assertIn("the load only pushes further", done.stdout)
        self.file.write_text(chevron(heat=300))
        self.assertIn("nothing moves, as where the scene's loads end at 0", run("statics", self.file, "--path").stdout)

    def test_closed_forms_and_modes(self):
        self.assertAlmostEqual(self.stroke_um("--hinge-model", "compliance", heat=300) / 6.111, 1, delta=0.01)
        cold, hot = (self.answer("modes", "--at", "equilibrium", heat=t)["modes"][0]["f_Hz"] for t in (170, 300))
        self.assertGreater(hot, cold)  # its legs are in tension

    def test_a_shuttle_pressed_from_both_sides(self):
        """Each leg alone would bend the plate as a lever. Quadratic triangles in plane stress on the drawn outline have, of what
        the legs store, 0.85 % in the plate beyond one width behind the roots, 0.42 % beyond two"""
        self.file.write_text(chevron(heat=300))
        done = run("check", self.file, "--corners", "none", "--advice", "none", "--json")
        (all_give,), (bases,) = ([float(x) for x in re.findall(rf'"{key}": ([0-9.e+-]+)', done.stdout)] for key in ("bodies_give", "bases_give"))
        self.assertTrue(0.0042 < all_give - bases < 0.0085, (all_give, bases))
        self.assertLess(bases, 0.015)

    def test_a_straight_chevron_buckles(self):
        """to either side, by what takes up the strain beyond Euler's of guided legs, in a half wave of the cosine:
        (pi y/4 L)^2 = e - (pi w/L)^2/12"""
        length, width, strain = 400, 6, 2.57e-6 * 300 * 650 / 400
        arc = 4 * length / math.pi * math.sqrt(strain - (math.pi * width / length) ** 2 / 12)
        self.assertAlmostEqual(abs(self.stroke_um(heat=300, tilt=0)) / arc, 1, delta=0.02)

    def test_what_is_not_followed_is_undecided(self):
        """legs that buckle and bend on as they snap through: 0.26 to 0.38 % of the 0.495 % allowed by the reference"""
        self.file.write_text(chevron(width=4.4, tilt=2.2, heat=0, load=1600, safety=1.2,
                                     air='<air kind="slide" gap="2 um"/>'))
        done = run("check", self.file, "--corners", "none", "--advice", "none")
        self.assertIn("INCONCLUSIVE", done.stdout)
        self.assertRegex(done.stdout, "inconclusive because: .*what is made may go on from there.*FW-D242")
        self.assertNotIn("--hinge-model compliance", done.stdout)

    def probes(self, text, command="simulate", *more):
        self.file.write_text(text)
        done = run(command, self.file, *more, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        return {p["id"]: p for p in json.loads(done.stdout)["probes"]}

    def test_a_free_arm_is_longer_than_its_substrate(self):
        """a tip L from the root of the strip goes out by (alpha - alpha_s) dT L, and the gap to what stands ahead loses as much;
        two arms side by side go apart as the substrate does that both are anchored to. Means over 100 K: copper
        16.7 + 0.5 - 0.035, silicon 2.57 + 0.44 - 0.065 ppm/K"""
        silicon = 2.945e-4
        out = (17.165e-4 - silicon) * 3.95e-3
        here = 50e-6 * (1 + silicon) - out  # the substrate between the two places grows, too
        for law, also in (("", ""), ('law="ramp" rise="10 ms"', "")):
            still = self.probes(ARM.format(law=law, also=also), "statics")
            self.assertAlmostEqual(still["tip"]["value"] / out, 1, delta=1e-3)
            self.assertAlmostEqual(still["far"]["value"], 1e-3 * (1 + silicon), delta=2e-9)
            for probe in ("ahead", "near"):
                self.assertAlmostEqual(still[probe]["value"], here, delta=0.01e-6)
        moved = self.probes(ARM.format(law='law="ramp" rise="10 ms"', also=""))
        self.assertAlmostEqual(moved["tip"]["final"] / out, 1, delta=0.002)
        self.assertAlmostEqual(moved["ahead"]["final"], here, delta=0.02e-6)
        self.assertAlmostEqual(moved["out"]["maximum"], out / 10e-3, delta=0.05 * out / 10e-3)

    def test_relative_and_absolute_places_agree(self):
        """a displacement and the opening ahead of it, of a chevron whose tip lies far from its anchors"""
        found = self.probes(CHEVRON, "statics")
        silicon = 2.57e-6 + 4.4e-9 * 60 - 6.5e-12 * 60**2
        lost = 30e-6 * (1 + silicon * 60) - found["open"]["value"]
        self.assertAlmostEqual(found["tip"]["value"] / lost, 1, delta=1e-5)
        self.assertAlmostEqual(found["tip"]["value"], 8.97e-6, delta=0.02e-6)  # 6.52 um about the mean of the anchors

    def test_a_gap_and_a_clearance_see_what_has_grown(self):
        """the outline of the arm grows about its middle, and its middle goes out"""
        text = ARM.format(law='law="ramp" rise="10 ms"', also="")
        self.file.write_text(text)
        self.file.write_text(text)
        for kelvin, less in ((50, 2.80), (100, 5.616)):
            done = run("check", self.file, "--advice", "none", "--corners", "none", "--json", "--set", f"dT={kelvin} K")
            nearest = json.loads(done.stdout)["clearances"][0]
            self.assertAlmostEqual(1e6 * nearest["drawn_m"], 150 - less, delta=0.02)

    def test_residual_stress_moves_places_too(self):
        """a free arm of a layer under tension is shorter by (1 - nu)/E times its stress"""
        text = ARM.format(law="", also="").replace('<temperature change="dT" />', '<residual-stress mean="100 MPa"/>')
        found = self.probes(text, "statics")
        self.assertAlmostEqual(found["tip"]["value"] / (-100e6 * (1 - 0.34) / 115e9 * 3.95e-3), 1, delta=0.02)

    def test_a_layer_of_a_crystal_has_the_modulus_of_its_plane(self):
        """(100) silicon: c11 + c12 - 2 c12^2/c11 = 180.3 GPa in every direction, not the 213 GPa of a mean E and a nu out of the plane;
        whoever states E alone states that of one direction, and the pair along <110>, 169 GPa and 0.064, is 180.6 GPa"""
        text = ARM.format(law="", also="").replace('<temperature change="dT" />', '<residual-stress mean="100 MPa"/>')
        text = text.replace('"copper-plated" thickness="15 um"', '"silicon-100" thickness="15 um"{}').replace("copper-on-porous-silicon", "al-masked-rie")
        for stated, modulus in (("", 180.316e9), (' youngs-modulus="169 GPa"', 180.316e9), (' youngs-modulus="169 GPa" poisson="0.064"', 169e9 / 0.936)):
            tip = self.probes(text.replace("{}", stated), "statics")["tip"]["value"]
            self.assertAlmostEqual(tip / (-100e6 / modulus * 3.95e-3), 1, delta=0.01)

    def test_what_is_placed_keeps_its_size(self):
        """a jaw grows against a bead of radius r on the substrate, 50 N/m: what it presses is u - gap - (gap + r) alpha_s dT + r s of
        its tip's way u on the substrate, s: what the bead itself grows by. A bead that shrank with copper pressed with 44 uN in place of 30"""
        for extra, heats, own in (('undrawn="placed"', 1, 0), ('undrawn="placed" expansion="9 ppm/K"', 1, 9e-6), ("", 1, 0),
                                  ('undrawn="etched"', 1, 16.7e-6), ('undrawn="placed"', 0, 0), ('undrawn="etched"', 0, 150e6 * 0.66 / 115e9 / 40)):
            why = '<temperature change="40 K" expansion="16.7 ppm/K" substrate-expansion="2.57 ppm/K"/>' if heats else '<residual-stress mean="-150 MPa"/>'
            for r in (10, 500):
                with self.subTest(extra=extra, heats=heats, r=r):
                    found = self.probes(JAW.format(why=why, extra=extra, r=r), "statics")
                    over = found["tip"]["value"] - 0.5e-6 - (0.5 + r) * 1e-6 * 2.57e-6 * 40 * heats + r * 1e-6 * own * 40
                    self.assertAlmostEqual(1e6 * found["press"]["value"], 50e6 * over, delta=0.02 + 1e-3 * 50e6 * over)
        ramp = JAW.format(why='<temperature change="40 K" expansion="16.7 ppm/K" substrate-expansion="2.57 ppm/K" law="ramp" rise="10 ms"/>', extra='undrawn="placed"', r=500)
        self.assertAlmostEqual(self.probes(ramp, "statics")["press"]["value"] / self.probes(ramp.replace(' law="ramp" rise="10 ms"', ""), "statics")["press"]["value"], 1, 9)
        self.file.write_text(ramp)
        moved = json.loads(run("simulate", self.file, "--json").stdout)
        press, tip = (next(p["final"] for p in moved["probes"] if p["id"] == id) for id in ("press", "tip"))
        self.assertAlmostEqual(1e6 * press, 50e6 * (tip - 0.5e-6 - 500.5e-6 * 2.57e-6 * 40), delta=0.06)

    def test_a_tooth_is_of_the_layer_and_its_bead_is_not(self):
        """of one distance, 100 um of a drawn tooth and 400 um of a bead: the tooth is longer with its jaw, the bead is not"""
        tooth = JAW.replace('a-y="0.8 mm" a-face="90 deg"', 'a-y="0.7 mm"').replace('distance="{r} um"', 'distance="{r} um + 100 um"')
        found = self.probes(tooth.format(why='<temperature change="40 K" expansion="16.7 ppm/K" substrate-expansion="2.57 ppm/K"/>', extra='undrawn="placed"', r=400), "statics")
        over = found["tip"]["value"] - 0.5e-6 - 400.5e-6 * 2.57e-6 * 40
        self.assertAlmostEqual(1e6 * found["press"]["value"], 50e6 * over, delta=0.02 + 1e-3 * 50e6 * over)

    def test_a_stated_nothing_is_a_load(self):
        """a sweep of shocks, or of the stress, may begin at 0; without any value the element is a slip"""
        for loads, code in (('<residual-stress mean="0 MPa"/><base-motion ax="0 m/s^2" law="half-sine" rise="1 ms"/>', 0),
                            ('<base-motion law="half-sine" rise="1 ms"/>', 2), ("<residual-stress/>", 2)):
            self.file.write_text(JAW.format(why=loads, extra='undrawn="placed"', r=10))
            done = run("simulate", self.file, "--json")
            self.assertEqual(done.returncode == 0, code == 0, done.stderr)
            self.assertEqual("FW-D093" in done.stderr, code != 0, done.stderr)

    def test_springs_and_drawn_cables_keep_their_length(self):
        """their pull is stiffness times what their ends are farther apart than they are long, in metres"""
        law = ' law="ramp" rise="5 ms"'
        for thing, of in (('<spring id="s" a="ground" a-x="1 mm" a-y="3 mm" b="jaw" b-y="0.8 mm" stiffness="20 N/m" length="1 mm"/>', "spring"),
                          ('<tendon id="s" draw="5 um" stiffness="20 N/m"><eyelet on="jaw" y="0.8 mm"/><eyelet on="ground" x="1 mm" y="3 mm"/></tendon>', "tendon")):
            for when in ("", law):
                text = JAW.format(why=f'<temperature change="40 K" expansion="16.7 ppm/K" substrate-expansion="2.57 ppm/K"{when}/>' + (thing if of == "tendon" else ""), extra='undrawn="placed"', r=100)
                text = text.replace("</mechanism>", (thing if of == "spring" else "") + '</mechanism><probe id="T" kind="force" of="s"/>'
                                    '<probe id="L" kind="distance" a="ground" a-x="1 mm" a-y="3 mm" b="jaw" b-y="0.8 mm"/>')
                found = self.probes(text, "statics")
                rest = 1e-3 if of == "spring" else math.hypot(1e-3, 1.2e-3) - 5e-6
                with self.subTest(of=of, when=when):
                    self.assertAlmostEqual(1e6 * found["T"]["value"], 20e6 * (found["L"]["value"] - rest), delta=1e-3 * 20e6 * (found["L"]["value"] - rest))

    def test_what_a_pack_knows_of_expansion_is_a_corner(self):
        """16.7 ppm/K are known to 0.5: at two of these the tip goes 7.9 % farther. Stated in the scene they are exact"""
        text = CHEVRON.replace('change="60 K"/>', 'change="60 K" law="ramp" rise="20 ms"/><air kind="slide" on="sh" gap="20 um"/>')
        text = text.replace('<scene', '<require probe="tip" measure="final" max="9.35 um"/><scene')
        stated = text.replace('change=', 'expansion="16.7 ppm/K" substrate-expansion="2.57 ppm/K" change=')
        for known, decision in ((text, "inconclusive"), (stated, "accept")):
            self.file.write_text(known)
            done = json.loads(run("check", self.file, "--advice", "none", "--json").stdout)
            self.assertEqual((done["drawn"], done["verdict"]), ("accept", decision))
            self.assertEqual("thermal expansion" in done["summary"][0]["text"], decision != "accept")


class Sides(unittest.TestCase):
    def test_both_sides_of_what_is_buckled_are_in_the_band(self):
        """The layer's stress buckles a bridge, and 20 uN across it come later: nothing decides on which side it is. Beams of finite
        elements have 9827 Hz at +12.48 um at -40 MPa; the well at -12.26 um, against the force, alone was in the band (9.588 to 9.642 kHz)"""
        bridge = ROOT / "tests/data/pressed-bridge.xml"
        for stress, at, low, high in (("-40 MPa", 12.48e-6, 9615, 9827), ("-20 MPa", 7.529e-6, 5400, 6201)):
            rest = json.loads(run("statics", bridge, "--json", "--set", f"stress={stress}").stdout)
            self.assertAlmostEqual(rest["probes"][0]["value"], at, delta=0.01e-6)
            self.assertIn("left an unstable equilibrium", run("statics", bridge, "--set", f"stress={stress}").stdout)
            asked = json.loads(run("check", bridge, "--json", "--advice", "none", "--set", f"stress={stress}").stdout)["requirements"][0]
            self.assertTrue(asked["band"][0] < low and high < asked["band"][1], asked)

    def test_a_peak_where_nothing_was_compared_decides_nothing(self):
        """a bridge jumps to its side in the first millisecond and rests for the second after it. By the law of small loads its leaves
        use 116 % then (101.8 to 131.0: rejected), exact beams have 10 %; both agree where it rests, and only that was compared"""
        seen = {}
        for model in ("compliance", "elastica"):
            top = json.loads(run("check", ROOT / "tests/data/pressed-bridge.xml", "--json", "--advice", "none", "--set", "stress=-20 MPa",
                                 "--set", "scene[p]/@duration=1 s", "--hinge-model", model).stdout)
            seen[model] = top["governing"]
            self.assertEqual(top["verdict"], "inconclusive")
        low, high = seen["compliance"]["utilisation_band"]
        self.assertTrue(low < seen["elastica"]["utilisation"] < high, seen)

class Ratio(unittest.TestCase):
    """A bridge between two leaves: what heat or stress presses it with goes with their stiffness along themselves, known to
    9 %, and what is left of their bending is K less that. References: the continuum of these leaves, 55 348 N/m for 58 667; and
    the same device with leaves a little narrower or of another K, by the program"""

    def setUp(self):
        self.place = tempfile.TemporaryDirectory()
        self.file = pathlib.Path(self.place.name) / "device.xml"

    def tearDown(self):
        self.place.cleanup()

    def judged(self, text, *more):
        self.file.write_text(text)
        done = run("check", self.file, "--advice", "none", "--json", *more)
        return json.loads(done.stdout)

    def band(self, text, which=0):
        row = self.judged(text, "--corners", "none")["requirements"][which]
        return row["value"], *row["band"]

    def test_forces_have_the_stiffness_along_strips(self):
        """the solid's force is 5.7 % less, and half of 0.8 % was the band"""
        for what in ('<temperature change="5.73 K" expansion="16.7 ppm/K" substrate-expansion="2.57 ppm/K" modulus-change="0 ppm/K" law="ramp" rise="100 ms"/>',
                     '<residual-stress mean="-10 MPa"/>'):
            text = BRIDGE.format(what=what, force=0.01, require='<require probe="fa" measure="final" min="1 uN"/>')
            value, low, high = self.band(text)
            self.assertLess(low, value * 0.943)
            self.assertGreater(low, value * 0.9)
            self.assertGreater(high, value * 1.06)
            self.assertLess(high, value * 1.11)

    def test_exact_beams_of_arcs_have_it_too(self):
        """forces on arcs go by a stiffness that is known worse than that against turns, whatever the model: 72 to 112 % with exact
        beams beside 63 to 127 % of the closed form, whose roots they have"""
        text = """<device xmlns="urn:flexwright:device:1" name="arcs"><material ref="silicon-100" youngs-modulus="106826 MPa" poisson="0.29" thickness="51 um"
 strength="373 MPa"/><limits safety-factor="1"/><flow ref="al-masked-rie"/><flexure id="F" kind="{}" width="9 um" fillet="9 um"/><mechanism>
<body id="stage" x="0 um" y="0 um" mass="4.6 ug" inertia="0.061 ug mm^2"/>
<revolute id="L" a="ground" a-x="-341 um" a-y="0 um" b="stage" b-x="-341 um" b-y="0 um" hinge="F" axis="-90 deg"/>
<revolute id="R" a="stage" a-x="341 um" a-y="0 um" b="ground" b-x="341 um" b-y="0 um" hinge="F" axis="-90 deg"/></mechanism>
<scene name="s" duration="100 ms"><temperature change="65.8 K" expansion="13.6 ppm/K" substrate-expansion="35.5 ppm/K" modulus-change="0 ppm/K"
 law="expression" factor="(1 - cos(pi*time/(100 ms)))/2"/></scene></device>"""
        for kind in ('csfh" radius="60 um" angle="150 deg', 'leaf" length="240 um" width-middle="8 um'):
            wide = []
            for model in "compliance", "elastica":
                hinge = self.judged(text.replace("{}", kind), "--corners", "none", "--hinge-model", model)["hinges"][0]
                wide.append([end / hinge["utilisation"] for end in hinge["utilisation_band"]])
            for closed, exact in zip(*wide):
                self.assertAlmostEqual(abs(exact - 1), abs(closed - 1), delta=0.15 * abs(closed - 1), msg=(kind, wide))

    def test_as_made_too(self):
        """2.237 mN at the worst corner, where solids have 2.11"""
        text = BRIDGE.format(what='<temperature change="5.73117 K" modulus-change="0 ppm/K" law="ramp" rise="100 ms"/>',
                             force=0.01, require='<require probe="fa" measure="final" min="{}"/>')
        for least, decision in (("2.16 mN", "inconclusive"), ("1.9 mN", "accept")):
            self.assertEqual(self.judged(text.replace("{}", least))["verdict"], decision)

    def test_a_frequency_holds_what_is_left(self):
        """at 0.9 of Euler's load 5.7 % less along takes it from 2.39 to 2.82 kHz"""
        text = BRIDGE.format(what='<temperature change="17.1935 K" expansion="16.7 ppm/K" substrate-expansion="2.57 ppm/K" modulus-change="0 ppm/K"/>', force=0.001,
                             require='<require probe="fr" max="2.7 kHz" scene="s"/>')
        _, low, high = self.band(text)
        self.assertLess(low, 1500)
        self.assertGreater(high, 2820)
        self.assertLess(high, 3500)
        self.assertEqual(self.judged(text, "--corners", "none")["verdict"], "inconclusive")

    def test_near_buckling_by_heat(self):
        """0.97 of Euler's load: K by half a per cent moves the middle by 8 %"""
        text = BRIDGE.format(what='<temperature change="18.5308 K" expansion="16.7 ppm/K" substrate-expansion="2.57 ppm/K" modulus-change="0 ppm/K" law="ramp" rise="100 ms"/>',
                             force=2, require='<require probe="mid" measure="peak" max="420 nm"/>')
        value, low, high = self.band(text)
        self.assertAlmostEqual(value, 371e-9, delta=3e-9)
        self.assertLess(low, 0.93 * value)
        self.assertGreater(high, 1.09 * value)
        cool = text.replace("18.5308 K", "1.85 K")
        value, low, high = self.band(cool)
        self.assertLess(high, 1.1 * value)  # far from there it is as known as before

    def test_what_may_buckle_is_undecided(self):
        """drawn: 39 MPa press as near as what leaves are off by; made: 28 MPa of the thinnest corner"""
        drawn = self.judged(DRAWN_BRIDGE.format(stress=-39, most="1 mm"), "--corners", "none")
        self.assertEqual(drawn["verdict"], "inconclusive")
        self.assertIn("FW-D699", [r["code"] for r in drawn["reasons"]])
        self.assertEqual(drawn["requirements"][0]["verdict"], "inconclusive")
        made = self.judged(DRAWN_BRIDGE.format(stress=-28, most="1.28 um"))
        self.assertEqual((made["drawn"], made["verdict"]), ("accept", "inconclusive"))
        for far in (-5, 20):
            self.assertEqual(self.judged(DRAWN_BRIDGE.format(stress=far, most="1.28 um"))["verdict"], "accept")


BRIDGE = """<device xmlns="urn:flexwright:device:1" name="bridge">
<material ref="copper-plated" thickness="20 um" youngs-modulus="110 GPa" poisson="0.34" strength="2 GPa"/>
<limits safety-factor="1"/><flow ref="copper-on-porous-silicon"/>
<flexure id="l" kind="leaf" length="300 um" width="8 um"/>
<mechanism><body id="J" x="0 mm" y="0 mm" mass="50 ug" inertia="0.01 mg mm^2"/>
<revolute id="A" a="ground" a-x="-0.5 mm" a-y="0 mm" b="J" b-x="-0.5 mm" b-y="0 mm" hinge="l" axis="-90 deg"/>
<revolute id="B" a="J" a-x="0.5 mm" a-y="0 mm" b="ground" b-x="0.5 mm" b-y="0 mm" hinge="l" axis="-90 deg"/></mechanism>
<probe id="mid" kind="displacement" on="J" direction="90 deg"/><probe id="fa" kind="force" of="A"/>
<probe id="fr" kind="frequency" mode="1" plane="in"/>{require}
<scene name="s" duration="200 ms">{what}<force on="J" fy="{force} uN" law="ramp" rise="100 ms"/>
<material-damping loss-factor="0.2"/></scene></device>"""
DRAWN_BRIDGE = """<device xmlns="urn:flexwright:device:1" name="drawn-bridge">
<material ref="silicon-100" thickness="50 um" youngs-modulus="150 GPa" poisson="0.2" density="2330 kg/m3" strength="1 GPa"/>
<limits safety-factor="1.5"/><flow ref="al-masked-rie"/><flexure id="l" kind="leaf" length="300 um" width="8 um"/>
<mechanism><body id="J" x="0 mm" y="0 mm"><plate width="0.9 mm" height="0.3 mm"/></body>
<body id="Z" x="0 mm" y="-2.2 mm"><plate width="0.5 mm" height="0.4 mm"/></body>
<revolute id="Q" a="ground" a-x="0 mm" a-y="-2.8 mm" b="Z" b-x="0 mm" b-y="-0.6 mm" hinge="l" axis="0 deg"/>
<revolute id="A" a="ground" a-x="-0.7 mm" a-y="0 mm" b="J" b-x="-0.7 mm" b-y="0 mm" hinge="l" axis="-90 deg"/>
<revolute id="B" a="J" a-x="0.7 mm" a-y="0 mm" b="ground" b-x="0.7 mm" b-y="0 mm" hinge="l" axis="-90 deg"/></mechanism>
<probe id="mid" kind="displacement" on="J" direction="90 deg"/><require probe="mid" measure="final" max="{most}"/>
<scene name="s" duration="20 ms"><residual-stress mean="{stress} MPa"/><material-damping loss-factor="0.2"/>
<force on="J" fy="5 uN" law="ramp" rise="5 ms"/></scene></device>"""
ARM = """<device xmlns="urn:flexwright:device:1" name="hot-arm">
<parameter name="dT" value="100 K"/><material ref="copper-plated" thickness="15 um"/><limits safety-factor="1.2"/>
<flow ref="copper-on-porous-silicon"/><die tethers="no"/>
<flexure id="l" kind="leaf" length="300 um" width="12 um" fillet="5 um"/>
<mechanism><body id="arm" x="0 mm" y="0 mm"><plate x="2 mm" width="3600 um" height="200 um"/></body>
<body id="other" x="0 mm" y="1 mm"><plate x="2 mm" width="3600 um" height="200 um"/></body>
<revolute id="A" a="ground" b="arm" hinge="l" axis="-90 deg"/>
<revolute id="B" a="ground" a-y="1 mm" b="other" hinge="l" axis="-90 deg"/></mechanism>
<probe id="tip" kind="displacement" on="arm" x="3.8 mm" direction="0 deg"/>
<probe id="out" kind="velocity" on="arm" x="3.8 mm" direction="0 deg"/>
<probe id="far" kind="distance" a="arm" a-x="3.8 mm" b="other" b-x="3.8 mm"/>
<probe id="near" kind="distance" a="ground" a-x="3.85 mm" b="arm" b-x="3.8 mm"/>
<probe id="ahead" kind="opening" a="ground" a-x="3.85 mm" b="arm" b-x="3.8 mm" direction="180 deg"/>{also}
<scene name="hot" duration="20 ms"><temperature change="dT" {law}/><air kind="slide" on="arm" gap="20 um"/></scene></device>"""
JAW = """<device xmlns="urn:flexwright:device:1" name="heated-jaw">
<material ref="copper-plated" thickness="12 um"/><limits safety-factor="1.5"/><flow ref="copper-on-porous-silicon"/>
<flexure id="leaf" kind="leaf" length="300 um" width="12 um"/>
<mechanism><body id="jaw" x="0 mm" y="1 mm"><plate width="300 um" height="1.6 mm"/></body>
<revolute id="A" a="ground" b="jaw" b-y="-1 mm" hinge="leaf" axis="0 deg"/></mechanism>
<probe id="press" kind="force" of="bead"/><probe id="tip" kind="displacement" on="jaw" y="0.8 mm" direction="90 deg"/>
<scene name="warm" duration="20 ms">{why}
<contact id="bead" a="jaw" a-y="0.8 mm" a-face="90 deg" b="ground" b-y="1.8005 mm + {r} um" side="outside" distance="{r} um"
 stiffness="50 N/m" damping="0.0001 N s/m" {extra}/><material-damping loss-factor="0.2"/></scene></device>"""
CHEVRON = """<device xmlns="urn:flexwright:device:1" name="heated-chevron">
<material ref="copper-plated" thickness="15 um"/><flow ref="copper-on-porous-silicon"/>
<flexure id="l1" kind="leaf" length="600 um" width="10 um" fillet="6 um"/>
<mechanism><body id="sh" x="0 mm" y="0 mm"><plate width="300 um" height="1000 um" y="-0.1 mm"/>
<plate width="200 um" height="2200 um" y="1.4 mm"/></body>
<revolute id="A" a="ground" a-x="-0.62 mm" a-y="-0.06 mm" b="sh" b-x="-0.62 mm" b-y="-0.06 mm" hinge="l1" axis="-84 deg"/>
<revolute id="B" a="ground" a-x="0.62 mm" a-y="-0.06 mm" b="sh" b-x="0.62 mm" b-y="-0.06 mm" hinge="l1" axis="84 deg"/>
<revolute id="C" a="ground" a-x="-0.62 mm" a-y="-1 mm" b="sh" b-x="-0.62 mm" b-y="-1 mm" hinge="l1" axis="-84 deg"/>
</mechanism><probe id="tip" kind="displacement" on="sh" y="2.5 mm" direction="90 deg"/>
<probe id="open" kind="opening" a="ground" a-y="2.53 mm" b="sh" b-y="2.5 mm" direction="-90 deg"/>
<scene name="hot" duration="40 ms"><temperature change="60 K"/></scene></device>"""


TWO_JAWS = """<device xmlns="urn:flexwright:device:1" name="two-jaws">
<material ref="copper-plated" thickness="12 um"/><limits safety-factor="1.5" cycles="1e6"/><flow ref="copper-on-porous-silicon"/>
<flexure id="leaf" kind="leaf" length="350 um" width="10 um" fillet="10 um"/><mechanism>
<body id="left" x="-0.5 mm" y="0 mm"><plate x="0.05 mm" y="1.1 mm" width="300 um" height="1.6 mm"/>
<plate x="0.3 mm" y="1.8 mm" width="300 um" height="200 um"/></body>
<body id="right" x="0.5 mm" y="0 mm"><plate x="-0.05 mm" y="1.1 mm" width="300 um" height="1.6 mm"/>
<plate x="-0.3 mm" y="1.8 mm" width="300 um" height="200 um"/></body>
<revolute id="A" a="ground" a-x="-0.5 mm" b="left" hinge="leaf" axis="0 deg"/>
<revolute id="B" a="ground" a-x="0.5 mm" b="right" hinge="leaf" axis="0 deg"/></mechanism>
<probe id="grip" kind="force" of="bead"/>
<probe id="open" kind="opening" a="left" a-x="0.45 mm" a-y="1.8 mm" b="right" b-x="-0.45 mm" b-y="1.8 mm" direction="0 deg"/>
<require probe="grip" measure="final" min="5 uN" scene="close"/>
<require probe="open" measure="maximum" min="95 um" scene="close"/>
<scene name="close" duration="100 ms">
<tendon id="tl" pull="68.5 uN" law="ramp" rise="40 ms"><eyelet on="left" x="0.15 mm" y="1.0 mm"/><eyelet on="ground" x="-0.08 mm" y="-0.62 mm"/></tendon>
<tendon id="tr" pull="68.5 uN" law="ramp" rise="40 ms"><eyelet on="right" x="-0.15 mm" y="1.0 mm"/><eyelet on="ground" x="0.08 mm" y="-0.62 mm"/></tendon>
<contact id="bead" a="left" a-x="0.45 mm" a-y="1.8 mm" a-face="0 deg" b="right" b-x="-0.45 mm" b-y="1.8 mm" side="outside" distance="80 um" stiffness="40 N/m" damping="0.002 N s/m" undrawn="placed"/>
<material-damping loss-factor="0.2"/><temperature change="40 K" law="ramp" rise="30 ms"/></scene></device>"""

ONE_JAW = """<device xmlns="urn:flexwright:device:1" name="heated-jaw">
<material ref="copper-plated" thickness="9 um"/><limits safety-factor="1.5"/><flow ref="copper-on-porous-silicon"/>
<flexure id="leaf" kind="leaf" length="300 um" width="12 um"/>
<mechanism><body id="jaw" x="0 mm" y="1 mm"><plate x="0 mm" y="0 mm" width="200 um" height="1.6 mm"/></body>
<revolute id="A" a="ground" b="jaw" b-y="-1 mm" hinge="leaf" axis="0 deg"/></mechanism>
<probe id="press" kind="force" of="wall"/><require probe="press" measure="final" max="1 mN" scene="warm"/>
<scene name="warm" duration="20 ms"><temperature change="40 K" expansion="16.7 ppm/K" substrate-expansion="2.57 ppm/K" law="ramp" rise="10 ms"/>
<contact id="wall" a="jaw" a-y="0.8 mm" a-face="90 deg" b="ground" b-x="0 mm" b-y="1.80 mm + 20.5 um" side="outside" distance="20 um" stiffness="50 N/m" damping="0.0001 N s/m" undrawn="placed"/>
<material-damping loss-factor="0.05"/></scene></device>"""


class Pressed(unittest.TestCase):
    """jaws that heat, or what comes with it, closes on something stiff"""

    def setUp(self):
        self.place = tempfile.TemporaryDirectory()
        self.file = pathlib.Path(self.place.name) / "device.xml"

    def tearDown(self):
        self.place.cleanup()

    def check(self, text, *more):
        self.file.write_text(text)
        return run("check", self.file, "--jobs", "1", "--advice", "none", "--measurements", "none", *more)

    def test_a_contact_that_closes_makes_no_die_softer(self):
        """Two jaws on a bead. About their loads they swing by 43000 1/s, held by the bead, and at rest by 1400: that is the same
        die, and none of the flow is a thousand times softer. Quasi-static truth of the two extreme corners: 10.2 and 11.5 uN."""
        done = self.check(TWO_JAWS, "--json", "-v")
        said = json.loads(done.stdout)
        # who waits, and has no terminal, is told what is judged (every ten seconds, which a fast machine does not need)
        self.assertTrue("judging what a flow makes of it: " in done.stderr or " so far)" not in done.stderr, done.stderr)
        self.assertEqual(said["verdict"], "accept")
        look_at_rows(self, said, "two jaws")
        grip, opening = (row["as_fabricated"]["all_corners_band"] for row in said["requirements"])
        self.assertTrue(9e-6 < grip[0] < 10.2e-6 and 11.5e-6 < grip[1] < 13e-6, grip)
        self.assertGreater(opening[0], 95e-6)
        for hinge in said["hinges"]:
            self.assertLess(hinge["as_fabricated"]["most"], 0.2)

    def test_solids_of_one_layer_do_not_overlap(self):
        """10 um deep in the drawn pose was a warning beside ACCEPT; what is put there may be pressed in"""
        deeper = TWO_JAWS.replace('distance="80 um"', 'distance="110 um"')
        for text, open_ in ((deeper.replace('"placed"', '"etched"'), True), (deeper, False)):
            done = self.check(text, "--json", "--corners", "none")
            self.assertIn("overlaps by 10 um", done.stderr)
            self.assertEqual("FW-D134" in {r["code"] for r in json.loads(done.stdout)["reasons"]}, open_)

    def test_what_is_its_own_mirror_image_is_only_pressed(self):
        """Between two leaves in line heat turns nothing, and angles and ways are rounding: nothing is a share of them. The force of
        a leaf had a band of -5.1 to 9.6 mN for its 2.19, and parts 300 um apart might meet, 81 000 times as far as computed (FW-D642);
        a side force of 1 uN mended both. E A t/L of both leaves in series by hand, and what their ends give"""
        for change, width in ((5, 12), (-20, 12), (10, 16)):
            text = f'''<device xmlns="urn:flexwright:device:1" name="pressed">
<material ref="copper-plated" thickness="12 um"/><limits safety-factor="1.5"/><flow ref="copper-on-porous-silicon"/>
<flexure id="f" kind="leaf" length="400 um" width="{width} um" width-middle="{width - 2} um" fillet="7 um"/>
<mechanism><body id="stage" x="0 mm" y="0 mm"><plate width="500 um" height="200 um"/></body>
<revolute id="A" a="ground" a-x="-0.55 mm" b="stage" b-x="-0.55 mm" hinge="f" axis="90 deg"/>
<revolute id="B" a="ground" a-x="0.55 mm" b="stage" b-x="0.55 mm" hinge="f" axis="90 deg"/></mechanism>
<probe id="fa" kind="force" of="A" direction="0 deg"/><require probe="fa" measure="final" min="-1 N" max="1 N" scene="heat"/>
<scene name="heat" duration="200 ms"><temperature change="{change} K" law="ramp" rise="150 ms"/></scene></device>'''
            said = json.loads(self.check(text, "--json", "--corners", "none").stdout)
            self.assertNotIn("FW-D642", json.dumps(said["reasons"]))
            row = next(r for r in said["requirements"] if r["probe"] == "fa")
            low, high = sorted(abs(x) for x in row["band"])
            self.assertGreater(row["band"][0] * row["band"][1], 0)
            self.assertLess(high / low, 2, row)
            self.assertEqual(row["value"] > 0, change > 0)

    def test_what_heat_moves_passes_over_what_is_fast(self):
        """heat has no force, so that nothing says what it excites: with a contact besides explicit steps followed the leaf's
        stiff axis, 4200 of them where 300 do (29 s as made before its first corner was through)"""
        self.file.write_text(ONE_JAW)
        said = run("simulate", self.file).stdout
        self.assertIn("integrator radau5", said)
        steps = int(re.search(r"(\d+) steps,", said).group(1))
        self.assertLess(steps, 1000)
        self.assertRegex(said, r"press +force +29\.9\d? uN")


GUIDED = """<device xmlns="urn:flexwright:device:1" name="guided"><parameter name="dT" value="30 K"/><parameter name="sm" value="0 MPa"/>
<material ref="silicon-100" thickness="50 um" youngs-modulus="160 GPa" poisson="0.22"/><limits safety-factor="2"/>
<flow ref="silicon-on-glass" carrier="insulating"/><die tethers="no"/><flexure id="leaf" kind="leaf" length="400 um" width="6 um"/>
<mechanism><body id="stage" x="0 mm" y="0 mm" plate-width="1.4 mm" plate-height="0.6 mm"/>
<revolute id="A" a="ground" a-x="-0.5 mm" a-y="0.6 mm" b="stage" b-x="-0.5 mm" b-y="0.6 mm" hinge="leaf" axis="0 deg"/>
<revolute id="B" a="ground" a-x="0.5 mm" a-y="0.6 mm" b="stage" b-x="0.5 mm" b-y="0.6 mm" hinge="leaf" axis="0 deg"/>
<revolute id="C" a="ground" a-x="-0.5 mm" a-y="-0.6 mm" b="stage" b-x="-0.5 mm" b-y="-0.6 mm" hinge="leaf" axis="180 deg"/>
<revolute id="D" a="ground" a-x="0.5 mm" a-y="-0.6 mm" b="stage" b-x="0.5 mm" b-y="-0.6 mm" hinge="leaf" axis="180 deg"/></mechanism>
<probe id="x" kind="displacement" on="stage" direction="0 deg"/><probe id="k" kind="stiffness" on="stage" direction="0 deg"/>
<probe id="along" kind="stiffness" on="stage" direction="90 deg"/><require probe="x" measure="final" min="-1 um" scene="push"/>
<require frequency="1" scene="push" min="100 Hz"/><require probe="k" scene="push" min="1 N/m"/>
<require probe="along" scene="push" min="1 N/m"/><scene name="push" duration="14 ms">{}</scene></device>"""
WARM = '<temperature change="dT" expansion="3 ppm/K" substrate-expansion="0 ppm/K" modulus-change="0 ppm/K" {}/>'


class Forks(unittest.TestCase):
    """a stage on four clamped leaves that heat buckles at 31.4 K, by Euler's load of a guided leaf and what fillets stiffen"""

    def judged(self, scene, *more):
        with tempfile.TemporaryDirectory() as place:
            file = pathlib.Path(place) / "device.xml"
            file.write_text(GUIDED.replace("{}", scene))
            done = run("check", file, "--jobs", "1", "--advice", "none", "--corners", "none", "--json", *more)
            return json.loads(done.stdout)

    def test_a_later_force_leaves_heat_as_it_is(self):
        """at 27 K it stands; what was looked at where the force begins was the ramp that goes on, at 48.6 K (FW-D259)"""
        for law in ('law="ramp" rise="5 ms"', 'law="table" table="0 ms: 0; 5 ms: 1; 20 ms: 1"',
                    'law="expression" factor="min(1, t/(5 ms))"'):
            said = self.judged(WARM.format(law) + '<force on="stage" fx="1 nN" fy="0 N" law="ramp" start="9 ms" rise="4 ms"/>',
                               "--set", "dT=27 K")
            self.assertEqual(said["verdict"], "accept", (law, said["reasons"]))

    def test_between_standing_and_buckled(self):
        """some of the devices that it may be stand and others are buckled: one between them has no stiffness but along its leaves.
        The frequency had bands from 430 to 900 Hz"""
        warm = WARM.format('law="ramp" rise="5 ms"')
        for heat, fork in ((27, False), (29.5, True), (30, True), (32, True)):
            _, frequency, k, along = self.judged(warm, "--set", f"dT={heat} K")["requirements"]
            for row in frequency, k:
                self.assertEqual(row["band"][0] == 0, fork, (heat, row))
                self.assertEqual(row["verdict"], "inconclusive" if fork else "accept", (heat, row))
            self.assertGreater(along["band"][0], 1.5e5)
            self.assertEqual(along["verdict"], "accept")

    def test_pins_that_heat_pulls_apart(self):
        """a list of effects without what hinges give leaves pins, and no driver is to blame"""
        for scene, effects, code in ((WARM.format('law="ramp" rise="5 ms"'), "temperature", "FW-D101"),
                                     ('<residual-stress mean="-20 MPa"/>', "residual-stress", "FW-D100")):
            with tempfile.TemporaryDirectory() as place:
                file = pathlib.Path(place) / "device.xml"
                file.write_text(GUIDED.replace("{}", scene))
                said = run("simulate", file, "--effects", effects).stderr
            self.assertIn(code, said)
            self.assertIn("add nonlinear-hinge to the list of --effects", said)
            self.assertNotIn("driver", said)


def on_its_side(row, band):
    """a band of a requirement on the right side of its bounds; None: not known there, or no bound"""
    low, high = band
    return ((row["min"] is None or (low is not None and low >= row["min"])) and
            (row["max"] is None or (high is not None and high <= row["max"])))


def look_at_rows(self, said, what):
    """every row that says accept has its band on the right side of its limit"""
    for row in said["requirements"]:
        made = row["as_fabricated"]
        if row["verdict"] == "accept":
            self.assertTrue(on_its_side(row, row["band"]), f"{what}: {row}")
        if not made or made["verdict"] != "accept":
            continue
        self.assertTrue(on_its_side(row, made["band"]), f"{what}: {row}")
        self.assertTrue(made["all_corners_band"] == [None, None] or on_its_side(row, made["all_corners_band"]), f"{what}: {row}")
    for row in said["hinges"]:
        if row["verdict"] == "accept":
            self.assertLess(row["utilisation_band"][1], 1, f"{what}: {row['id']}")
        made = row["as_fabricated"]
        if made and made["verdict"] == "accept":
            self.assertLess(made["utilisation_band"][1], 1, f"{what}: {row['id']}")
            self.assertTrue(made["most"] is None or made["most"] < 1, f"{what}: {row['id']} {made['most']}")
    for row in said["clearances"]:
        if row["verdict"] == "accept" and row["low_m"] is not None:
            self.assertGreaterEqual(row["low_m"], row["required_m"] or 0, f"{what}: {row}")


class Rows(unittest.TestCase):
    """no row says accept whose band does not lie where it says"""

    def test_of_devices(self):
        files = sorted((ROOT / "docs/gallery").glob("*/device.xml")) + sorted((ROOT / "tests/data").glob("*.xml"))
        few = [f for f in files if f.stem in ("jaws-that-close", "rings-a-little") or f.parent.name == "leaf-four-bar"]
        for file in files if ALL else few:
            done = run("check", file, "--advice", "none", "--measurements", "none", "--json")
            said = json.loads(done.stdout)
            if "verdict" in said:
                look_at_rows(self, said, file)


if __name__ == "__main__":
    unittest.main()
