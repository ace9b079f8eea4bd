#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The ladder of `flexwright hinge`: four reference flexures by every level against the tables of
docs/theory (finite elements and closed forms computed elsewhere), levels against each other within
what they say of their own errors, the picked level, decks, sharing, and the report."""
import json
import math
import os
import pathlib
import random
import re
import shutil
import tempfile
import unittest
import xml.etree.ElementTree as tree

from common import ALL, GALLERY, run

CCX = shutil.which("ccx")
KEPT = None if ALL else os.environ.get("FW_CCX")  # where a ccx stands that knows the answers (tests/data/ccx)
CHEAP = ["closed-form", "ends", "compliance", "elastica"]
UM = 1e-6


def device(flexures, youngs="169 GPa", poisson=0.22, depth="50 um", strength="500 MPa", crystal=False):
    """every flexure between the ground and a body of its own; (attributes of <flexure>, axis in degrees)"""
    modulus = "" if crystal else f'youngs-modulus="{youngs}" poisson="{poisson}"'
    out = ['<device xmlns="urn:flexwright:device:1" name="flexures">',
           f'<material ref="silicon-100" {modulus} strength="{strength}" thickness="{depth}"/>',
           '<limits safety-factor="1"/>']
    for i, (flexure, _) in enumerate(flexures):
        attributes = " ".join(f'{key}="{value}"' for key, value in flexure.items())
        out.append(f'<flexure id="f{i}" {attributes}/>')
    out.append("<mechanism>")
    for i, (_, axis) in enumerate(flexures):
        out.append(f'<body id="b{i}" mass="0.02 mg" inertia="0.003 mg mm^2" x="{i + 0.5} mm" y="0 mm"/>'
                   f'<revolute id="h{i}" a="ground" a-x="{i} mm" b="b{i}" b-x="-0.5 mm" hinge="f{i}" '
                   f'axis="{axis} deg"/>')
    out.append("</mechanism></device>")
    return "\n".join(out)


class Fillets(unittest.TestCase):
    def test_a_strip_that_is_all_fillet_is_refused(self):
        """kx was -25.7 kN/m, and the scene ran away"""
        for fillet, ok in (("40 um", False), ("60 um", False), ("15 um", True)):
            text = device([({"kind": "leaf", "length": "80 um", "width": "20 um", "fillet": fillet}, 0)])
            done = run("hinge", "-", "--level", "closed-form", input=text)
            self.assertEqual(done.returncode, 0 if ok else 3, done.stderr)
            if not ok:
                self.assertIn("flexure f0 has no stiffness above 0; check its length, width and fillet [FW-D085]", done.stderr)


def arc(r, angle, t, rho):
    return {"kind": "csfh", "radius": f"{r} um", "angle": f"{angle} deg", "width": f"{t} um",
            "gap": "2 um", "fillet": f"{rho} um"}


def leaf(length, t, rho):
    return {"kind": "leaf", "length": f"{length} um", "width": f"{t} um", "fillet": f"{rho} um"}


# closed form x depth x root and finite elements, 3-D, real roots (blocks r +- 40 um, rho = 4 um): K uN um/rad,
# W from the arc's centre um, Kx, Ky N/m, peak strain 1/rad
CLOSED = {"H1": (767465.1, 29.6829), "H2": (2227656.5, 62.9610), "H3": (181722.7, 29.2994)}
SOLID = {"H1": (769198.6, 29.8787, 127.020, 251.951, 0.011625), "H2": (2235484.8, 63.1165, 443.768, 2269.21, 0.022575),
         "H3": (181755.1, 29.3113, 30.0111, 58.6924, 0.014394)}


class Hinge(unittest.TestCase):
    solids = None  # the ladder of the reference hinges up to the continuum

    @classmethod
    def setUpClass(cls):
        cls.kept = dict(os.environ)
        if KEPT:  # the program looks for "ccx" in PATH, and gives it a PATH of its own
            cls.kept["PATH"] = f"{KEPT}:{os.environ['PATH']}"

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.here = pathlib.Path(temporary.name)

    def ladder(self, xml, *arguments, **options):
        path = self.here / "device.xml"
        path.write_text(xml)
        done = run("hinge", path, "--json", *arguments, **options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    def reference(self, *arguments, **options):
        """{name: {level: row}} of H1 to H4, axis along -x, so that the hinge's x is the world's -x"""
        found = {}
        common = self.ladder(device([(arc(100, 270, 8, 4), 0), (arc(100, 180, 10, 4), 0), (leaf(471.2389, 8, 4), 0)]),
                             *arguments, **options)
        copper = self.ladder(device([(arc(100, 270, 10, 4), 0)], "115 GPa", 0.34, "9 um"), *arguments, **options)
        for name, hinge in zip(("H1", "H2", "H4", "H3"), common["hinges"] + copper["hinges"]):
            found[name] = {row["level"]: row for row in hinge["levels"]}
        return found

    def agree(self, a, b, what=("stiffness_Nm_per_rad", "kx_N_per_m", "ky_N_per_m", "strain_per_rad")):
        """two rows of one hinge differ by no more than the sum of their errors"""
        keys = {"stiffness_Nm_per_rad": "stiffness", "kx_N_per_m": "kx", "ky_N_per_m": "ky", "strain_per_rad": "strain"}
        for key in what:
            allowed = a["error"][keys[key]] + b["error"][keys[key]]
            self.assertLessEqual(abs(a[key] / b[key] - 1), allowed, (key, a, b))
        apart = math.dist(a["centre_m"], b["centre_m"])
        self.assertLessEqual(apart, a["error"]["centre_m"] + b["error"]["centre_m"], (a, b))

    def test_reference_closed(self):
        for name, levels in self.reference().items():
            self.assertEqual(list(levels), CHEAP)
            for row in levels.values():
                self.assertTrue(row["solved"])
            closed, beam, law = levels["closed-form"], levels["elastica"], levels["compliance"]
            self.agree(closed, beam)
            # a pure moment bends evenly: stiffness and limit are the same numbers by three ways
            for row in (beam, law):
                self.assertAlmostEqual(row["stiffness_Nm_per_rad"] / closed["stiffness_Nm_per_rad"], 1, 9)
                self.assertAlmostEqual(row["limit_angle_rad"] / closed["limit_angle_rad"], 1, 8)
                self.assertAlmostEqual(row["limit_moment_Nm"] / closed["limit_moment_Nm"], 1, 7)
            self.assertAlmostEqual(beam["limit_drift_m"] / law["limit_drift_m"], 1, 2)
            self.assertIsNone(closed["limit_drift_m"])
            self.assertLess(closed["cpu_s"], beam["cpu_s"])
            if name in CLOSED:
                self.assertAlmostEqual(closed["stiffness_Nm_per_rad"] * 1e12, CLOSED[name][0], delta=0.06)
                self.within(closed, SOLID[name])
                self.within(beam, SOLID[name])

    def within(self, row, solid):
        K, _, kx, ky, strain = solid
        error = row["error"]
        self.assertLessEqual(abs(row["stiffness_Nm_per_rad"] * 1e12 / K - 1), error["stiffness"])
        self.assertLessEqual(abs(row["kx_N_per_m"] / kx - 1), error["kx"])
        self.assertLessEqual(abs(row["ky_N_per_m"] / ky - 1), error["ky"])
        self.assertLessEqual(abs(row["strain_per_rad"] / strain - 1), error["strain"])

    def test_exact_drift(self):
        """of an arc: delta = r th (sinc a sinc th/2 - sinc(a + th/2)); with short roots within 2 %"""
        levels = self.reference()["H1"]
        row, sinc = levels["elastica"], lambda x: math.sin(x) / x
        th, a = row["limit_angle_rad"], math.radians(135)
        exact = 100e-6 * th * (sinc(a) * sinc(th / 2) - sinc(a + th / 2))
        self.assertAlmostEqual(row["limit_drift_m"] / exact, 1, delta=0.02)

    def reference_solids(self):
        """computed once"""
        if Hinge.solids is None:
            Hinge.solids = self.reference("--level", "all", env=self.kept)
        return Hinge.solids

    @unittest.skipUnless(CCX, "CalculiX is not installed")
    def test_reference_continuum(self):
        for name, levels in self.reference_solids().items():
            solid, closed = levels["continuum"], levels["closed-form"]
            self.agree(closed, solid)
            self.agree(levels["elastica"], solid)
            costs = [levels[level]["cpu_s"] for level in ("closed-form", "elastica", "continuum")]
            if not KEPT:  # else nothing was solved
                self.assertEqual(costs, sorted(costs))
            self.assertLess(solid["error"]["stiffness"], closed["error"]["stiffness"])
            if name not in SOLID:
                continue
            # the table's own mesh is off by 1e-4 of K and 1 % of the strain
            self.assertAlmostEqual(solid["stiffness_Nm_per_rad"] * 1e12 / SOLID[name][0], 1,
                                   delta=solid["error"]["stiffness"] + 1e-4)
            self.assertAlmostEqual(solid["kx_N_per_m"] / SOLID[name][2], 1, delta=solid["error"]["kx"])
            self.assertAlmostEqual(solid["ky_N_per_m"] / SOLID[name][3], 1, delta=solid["error"]["ky"])
            self.assertAlmostEqual(solid["strain_per_rad"] / SOLID[name][4], 1, delta=solid["error"]["strain"] + 0.01)
            # W from where the closed form has it: the pin
            moved = math.dist(solid["centre_m"], closed["centre_m"]) / UM
            self.assertAlmostEqual(moved, SOLID[name][1] - CLOSED[name][1], delta=solid["error"]["centre_m"] / UM)

    def random_flexures(self, count, seed):
        draw = random.Random(seed)
        made = []
        for i in range(count):
            t = draw.uniform(5, 12)
            rho = t * draw.uniform(0.1, 1)
            if i % 4 == 3:
                made.append((leaf(draw.uniform(25, 60) * t, t, rho), draw.uniform(-180, 180)))
                continue
            made.append((arc(t / draw.uniform(0.05, 0.15), draw.uniform(140, 300), t, rho), draw.uniform(-180, 180)))
        return made

    def test_random_beams(self):
        for crystal in (False, True):
            text = device(self.random_flexures(40, 11), poisson=0.28, strength="100 MPa", crystal=crystal)
            for hinge in self.ladder(text)["hinges"]:
                levels = {row["level"]: row for row in hinge["levels"]}
                closed, beam = levels["closed-form"], levels["elastica"]
                self.assertTrue(beam["solved"], hinge)
                self.agree(closed, beam)
                self.assertAlmostEqual(beam["stiffness_Nm_per_rad"] / closed["stiffness_Nm_per_rad"], 1, 6)
                # the beam's own part of the error alone: thick arcs
                for key in ("kx_N_per_m", "ky_N_per_m"):
                    short = key[:2]
                    own = beam["error"][short] - closed["error"][short]
                    # of a crystal, shear goes with the direction too: some 0.1 %
                    self.assertLessEqual(abs(beam[key] / closed[key] - 1), own + (0.002 if crystal else 1e-6), hinge)

    def test_deep_arc(self):
        """every level's strain against a solid of its own (`--level continuum`), which is 2.5 % below the printed form"""
        levels = self.ladder(device([(arc(88, 236, 9.3, 3.1), 20)], "140 GPa", 0.27, "74 um", "1 GPa"))["hinges"][0]["levels"]
        self.assertEqual([row["level"] for row in levels], CHEAP)
        for row in levels:
            self.assertLessEqual(abs(row["strain_per_rad"] / 0.01928219 - 1), row["error"]["strain"], row)

    @unittest.skipUnless(CCX, "CalculiX is not installed")
    def test_random_solids(self):
        _, _, an_arc, a_leaf = self.random_flexures(4, 5)
        for crystal, flexures in ((False, [an_arc]), (True, [an_arc, a_leaf])): # ten seconds each
            text = device(flexures, poisson=0.28, crystal=crystal)
            for hinge in self.ladder(text, "--level", "all", env=self.kept)["hinges"]:
                levels = {row["level"]: row for row in hinge["levels"]}
                self.agree(levels["closed-form"], levels["continuum"])
                self.agree(levels["elastica"], levels["continuum"])

    def test_accuracy_picks(self):
        if CCX:
            self.reference_solids()  # of which this is H1
        text = device([(arc(100, 270, 8, 4), 0)])
        rough = self.ladder(text, "--accuracy", "0.05")["hinges"][0]
        self.assertEqual((rough["picked"]["level"], rough["picked"]["reached"]), ("closed-form", True))
        self.assertEqual([row["level"] for row in rough["levels"]], CHEAP)
        plain = self.ladder(text)["hinges"][0]
        self.assertEqual((plain["picked"]["level"], plain["picked"]["reached"]), ("ends", False))
        self.assertIn("none reaches", plain["picked"]["why"])
        fine = self.ladder(text, "--accuracy", "0.001", env=self.kept)["hinges"][0]
        self.assertEqual(fine["levels"][-1]["level"], "continuum")
        if CCX:
            self.assertEqual((fine["picked"]["level"], fine["picked"]["reached"]), ("continuum", True))
            finer = self.ladder(text, "--accuracy", "1e-6", env=self.kept)["hinges"][0]
            self.assertEqual((finer["picked"]["level"], finer["picked"]["reached"]), ("continuum", False))
        one = self.ladder(text, "--level", "elastica")["hinges"][0]
        self.assertEqual([row["level"] for row in one["levels"]], ["elastica"])
        shown = run("hinge", self.here / "device.xml", "--accuracy", "0.05").stdout
        self.assertRegex(shown, r"\n  \* closed-form ")
        self.assertRegex(shown, r"\n  \* the cheapest whose own estimate")
        self.assertIn("--level all", run("hinge", self.here / "device.xml").stdout)
        wrong = run("hinge", self.here / "device.xml", "--level", "solid")
        self.assertEqual(wrong.returncode, 2)

    def test_not_installed(self):
        empty = self.here / "bin"
        empty.mkdir()
        environment = dict(os.environ, PATH=str(empty))
        hinge = self.ladder(device([(arc(100, 270, 8, 4), 0)]), "--level", "all", env=environment)["hinges"][0]
        row = hinge["levels"][-1]
        self.assertEqual((row["level"], row["solved"]), ("continuum", False))
        self.assertIn("calculix", row["why"].lower())
        self.assertEqual(hinge["picked"]["level"], "ends")

    def test_shared(self):
        same, other = arc(100, 270, 8, 4), arc(100, 270, 9, 4)
        hinges = self.ladder(device([(same, 0), (other, 0), (same, 77)]))["hinges"]
        self.assertEqual([h["same_as"] and h["same_as"]["id"] for h in hinges], [None, None, "h0"])
        for a, b in zip(hinges[0]["levels"], hinges[2]["levels"]):
            self.assertEqual(a["cpu_s"], b["cpu_s"])  # one measurement
            self.assertEqual(a["stiffness_Nm_per_rad"], b["stiffness_Nm_per_rad"])
            # its place is its own: the same way from the pin, turned
            first = complex(*a["centre_m"])
            second = complex(*b["centre_m"]) - 2e-3
            self.assertAlmostEqual(abs(first), abs(second), delta=1e-15)
        # of a crystal the direction matters
        hinges = self.ladder(device([(same, 0), (same, 77), (same, 90)], crystal=True))["hinges"]
        self.assertEqual([h["same_as"] and h["same_as"]["id"] for h in hinges], [None, None, "h0"])

    def test_decks(self):
        path = self.here / "device.xml"
        path.write_text(device([(arc(100, 270, 8, 4), 0), (leaf(400, 8, 4), 0)]))
        out = self.here / "decks"
        done = run("hinge", path, "--deck", out)
        self.assertEqual(done.returncode, 0, done.stderr)
        names = sorted(p.name for p in out.iterdir())
        self.assertEqual(names, ["hinge-h0-large.inp", "hinge-h0.inp", "hinge-h1-large.inp", "hinge-h1.inp"])
        for name in names:
            text = (out / name).read_text()
            self.assertTrue(text.rstrip().endswith("*END STEP"), name)
            self.assertIn("*ELEMENT", text)
        again = {name: (out / name).read_bytes() for name in names}
        run("hinge", path, "--deck", out, "--level", "closed-form")
        self.assertEqual(again, {p.name: p.read_bytes() for p in out.iterdir()})
        # of a crystal its constants, in axes that are turned as the hinge lies in it, and of the whole as the wafer lies
        path.write_text(device([(leaf(400, 8, 4), 0), (leaf(400, 8, 4), 77)], crystal=True))
        run("hinge", path, "--deck", out, "--level", "closed-form")
        first = {}
        for name in ("h0", "h1"):
            deck = (out / f"hinge-{name}.inp").read_text()
            self.assertIn("*ELASTIC, TYPE=ORTHO", deck)
            x, y = (float(v) for v in re.search(r"SYSTEM=RECTANGULAR\n([^,]*), ([^,]*),", deck).groups())
            first[name] = math.degrees(math.atan2(y, x))
        self.assertAlmostEqual(((first["h0"] - first["h1"]) - 77 + 45) % 90 - 45, 0, places=6)
        further = run("hinge", path, "--deck", self.here / "further/down")
        self.assertEqual(further.returncode, 0, further.stderr)
        self.assertTrue((self.here / "further/down/hinge-h0.inp").exists())
        below = run("hinge", path, "--deck", path / "place")  # of a file
        self.assertEqual(below.returncode, 5, below.stderr)

    def test_what_moves_the_elastic_centre(self):
        """of a path of two bends without a crystal it is the layer's depth, which a thin layer has not"""
        def said(text):
            return run("hinge", "-", "--level", "closed-form", input=text).stdout

        path = '<flexure id="f0" kind="path" width="10 um"><arc radius="100 um" angle="100 deg"/><arc radius="80 um" angle="-140 deg"/></flexure>'
        of = {key: re.sub(r"<flexure [^>]*/>", path, device([(leaf(200, 10, 5), 0)], **more))
              for key, more in {"deep": {}, "thin": {"depth": "5 um"}, "crystal": {"crystal": True}}.items()}
        self.assertRegex(said(of["deep"]), r"bends of different radius, which the layer's depth stiffens unlike, move the elastic centre by -?0\.0\d+ um")
        self.assertNotIn("crystal moves", said(of["deep"]))
        self.assertNotIn("the elastic centre by", said(of["thin"]))
        self.assertIn("crystal moves the elastic centre by", said(of["crystal"]))

    def test_paths_as_exact_beams(self):
        """hinges whose width varies: both models of what gives agree, and the exact one keeps the energy"""
        path = GALLERY.parent.parent / "free-form-four-bar/device.xml"
        peaks = []
        for model in ("compliance", "elastica"):
            done = run("simulate", path, "--hinge-model", model, "--accuracy", "1e-5", "--json",
                       "--set", f"scene[push]/@duration={3 if ALL else 1} ms")
            self.assertEqual(done.returncode, 0, done.stderr)
            result = json.loads(done.stdout)
            self.assertLess(result["stats"]["energy_error"], 1e-7)
            peaks.append([p["angle_rad"] for p in result["peaks"]])
        for closed, exact in zip(*peaks):
            self.assertLess(abs(closed - exact), 5e-3 * abs(exact))
            self.assertNotEqual(closed, exact)

    def test_thrown_back(self):
        """a stage between soft stops whose leaves ring along them from blow to blow: by exact beams 95 to 103 % of its limit for a modulus 2 %
        more to 1 % less, by closed forms 91 to 92 %. Whatever is asked for is not accepted, and bands of both levels meet"""
        path = self.here / "between-stops.xml"
        stop = ('<contact id="%s" a="ground" a-x="%d um" a-y="626.996 um" a-face="%d deg" b="stage" side="outside" distance="1943.026683 um" '
                'stiffness="1242.73093227 N/m"/>')
        path.write_text(
            '<device xmlns="urn:flexwright:device:1" name="between-stops"><material ref="silicon-100" youngs-modulus="145054.095 MPa" '
            'poisson="0.27473" thickness="41.947784 um" strength="1458.687 MPa"/><limits safety-factor="1"/><flow ref="al-masked-rie"/>'
            '<flexure id="F" kind="leaf" length="501.96 um" width="6.193 um" width-middle="6.253 um" fillet="2.374 um"/>'
            '<mechanism><body id="stage" x="0 um" y="626.996 um" mass="17.6239792333 ug" inertia="0.855444283848 ug mm^2"/>'
            + "".join(f'<revolute id="{i}" a="ground" a-x="{x} um" a-y="250.98 um" b="stage" b-x="{x} um" b-y="-376.016 um" hinge="F" axis="0 deg"/>'
                      for i, x in (("H0", -330.53), ("H1", 330.53)))
            + '</mechanism><scene name="s" duration="104.79225 us"><initial body="stage" vx="10239.8047862 mm/s" vy="0 mm/s" omega="0 rad/s"/>'
            + stop % ("K", 2000, 180) + stop % ("L", -2000, 0) + '</scene></device>')
        bands = []
        for more in ((), ("--hinge-model", "compliance"), ("--hinge-model", "elastica"), ("--set", "material/@youngs-modulus=143600 MPa")):
            done = run("check", path, "--json", "--corners", "none", "--advice", "none", "--measurements", "none", *more)
            verdict = json.loads(done.stdout)
            bands.append([h["utilisation_band"] for h in verdict["hinges"]])
            if "compliance" not in more:
                self.assertNotEqual(verdict["verdict"], "accept", more)
                self.assertEqual(verdict["hinges"][0]["verdict"], "inconclusive", more)
        for closed, exact in zip(bands[1], bands[2]):
            self.assertLess(max(closed[0], exact[0]), min(closed[1], exact[1]))
        self.assertEqual(bands[0], bands[2])  # auto has come to exact beams
        self.assertGreater(bands[0][0][1], 1.0282)  # what it is with a modulus 1 % less

    def jolt(self, revolute, scene, more="", strength="1 GPa"):
        """a lever on a leaf of the ground"""
        path = self.here / "jolt.xml"
        path.write_text(
            '<device xmlns="urn:flexwright:device:1" name="jolt"><material ref="silicon-100" thickness="50 um" youngs-modulus="160 GPa" '
            f'poisson="0.2" strength="{strength}"/><limits safety-factor="2"/><flow ref="al-masked-rie"/>'
            '<flexure id="leaf" kind="leaf" length="300 um" width="10 um"/><mechanism>'
            '<body id="lever" x="0.8 mm" y="0 mm" mass="0.2 mg" inertia="0.05 mg mm^2"/>'
            f'<revolute id="H" a="ground" b="lever" b-x="-0.8 mm" hinge="leaf" axis="-90 deg" {revolute}/>{more}'
            f'</mechanism><scene name="s" duration="8 ms">{scene}</scene></device>')
        return path

    def judged(self, path, *more):
        done = run("check", path, "--json", "--corners", "none", "--advice", "none", "--measurements", "none", *more)
        return done, json.loads(done.stdout)

    def test_cable_goes_taut(self):
        """a cable that stops the lever on its way, and throws it back: with pins for the stated stiffness 75 % (71 to 78), accepted; it is at 111 %"""
        cable = ('<spring id="S" a="lever" b="ground" b-x="0.8 mm" b-y="-0.6 mm" stiffness="500 N/m" length="0.63 mm" cable="yes"/>')
        tendon = ('<tendon id="T" draw="0 mm" stiffness="500 N/m" slack="0.03 mm"><eyelet on="lever"/><eyelet on="ground" x="0.8 mm" '
                  'y="-0.6 mm"/></tendon>')
        for more, scene in ((cable, ""), ("", tendon)):
            _, verdict = self.judged(self.jolt('stiffness="2.27005e-6 N m/rad"', '<force on="lever" fy="60 uN"/>' + scene, more, "0.37 GPa"))
            self.assertNotEqual(verdict["verdict"], "accept")
            self.assertEqual(verdict["hinge_model"][0]["used"], "compliance")
            self.assertGreater(verdict["hinges"][0]["utilisation_band"][1], 1.09)

    def test_blows_that_come_again(self):
        """between joint stops: 91.6 to 99.0 % of the limit was accepted, and a modulus 0.25 % more is at 104 %"""
        path = self.jolt('stop-max="2 deg" stop-stiffness="1e-3 N m/rad" stop-min="-2 deg"',
                         '<force on="lever" fy="120 uN" law="sine" frequency="300 Hz"/>', strength="0.88 GPa")
        done, verdict = self.judged(path)
        self.assertIn("FW-D685", done.stderr)
        self.assertEqual(verdict["verdict"], "inconclusive")
        low, high = verdict["hinges"][0]["utilisation_band"]
        for modulus in (159.6, 160.4):
            other = self.judged(path, "--set", f"material/@youngs-modulus={modulus} GPa")[1]["hinges"][0]["utilisation"]
            self.assertTrue(low <= other <= high, (low, other, high))

    def test_one_model_of_a_scene(self):
        """simulate and check take the same hinges: a joint force was 194 uN of pins for the one and 4 mN for the other"""
        path = self.jolt('stiffness="2.27005e-6 N m/rad"', "",
                         '<body id="m" x="0.8 mm" y="-1 mm" mass="0.1 mg" inertia="0.001 mg mm^2"/>'
                         '<prismatic id="G" a="ground" a-x="0.8 mm" b="m" axis="90 deg"/><distance id="S" a="m" b="lever"/>'
                         '<driver joint="G" value="-1 mm - 0.05 mm*min(1,max(0,(t-1 ms)/(0.1 ms)))"/>')
        moved = json.loads(run("simulate", path, "--json").stdout)["hinge_model"]["used"]
        self.assertEqual(self.judged(path)[1]["hinge_model"][0]["used"], moved)
        self.assertEqual(moved, "compliance")

    def test_damping_that_damps_nothing(self):
        """every hinge states a damping: <material-damping> of the scene has no hinge, and says so once"""
        scene = '<force on="lever" fy="60 uN"/><material-damping loss-factor="0.1"/>'
        done, _ = self.judged(self.jolt('damping="1e-12 N m s/rad"', scene))
        self.assertEqual(done.stderr.count("FW-D686"), 1)
        self.assertNotIn("FW-D686", self.judged(self.jolt("", scene))[0].stderr)

    def test_report(self):
        out = self.here / "out"
        done = run("plan", GALLERY, "-o", out)
        self.assertEqual(done.returncode, 0, done.stderr)
        text = (out / "report.html").read_text()
        tree.fromstring(text.replace("<!DOCTYPE html>", ""))
        table = text[text.index("The hinges by models"):]
        table = table[:table.index("</table>")]
        self.assertEqual(len(re.findall("<td>elastica</td>", table)), 12)  # six hinges, two flows
        self.assertEqual(len(re.findall("rowspan=\"4\"", table)), 12)
        self.assertNotIn("continuum</td>", table)
        self.assertIn("\u00b1", table)
        self.assertIn("drift of the axis", text)
        self.assertNotRegex(table, r"\b(nan|inf)\b")


if __name__ == "__main__":
    unittest.main()
