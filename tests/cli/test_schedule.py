#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Schedules and calibration as a user meets them: options, files, exit statuses, what follows."""
import csv
import io
import json
import pathlib
import tempfile
import unittest
import xml.dom.minidom

from common import FLOWS, GALLERY, run

SILICON, COPPER = FLOWS
COUPONS = """# lot 7, wafer 3
coupon,feature,drawn_um,measured,u,unit,at,u_at,at_unit
arde-slots,,4,41.9,0.2,um,90,0.2,min
arde-slots,,10,45.6,0.2,um,90,0.2,min
arde-slots,,100,49.4,0.2,um,90,0.2,min
undercut-ladder,gone,3.5,,,,50,0.3,um
undercut-ladder,stands,4,,,,50,0.3,um
undercut-ladder,width,20,16.2,0.15,um,50,0.3,um
cd-lines,line,10,7.95,0.1,um
cd-lines,space,10,12.1,0.1,um
etch-rate,pan.R,,0.90,0.02,um,20,0.1,min
"""


STAGE = """<device xmlns="urn:flexwright:device:1" name="stage">
  <material ref="{material}"{thickness}/>
  <limits safety-factor="2"/>
  <flow ref="{flow}"/>
  <die clearance="400 um"/>
  <flexure id="leaf" kind="leaf" length="520 um" width="{t}" gap="12 um"/>
  <mechanism>
    <body id="left" x="0 mm" y="0.6 mm" width="100 um"/>
    <body id="stage" x="0.7 mm" y="1.2 mm" plate-width="0.5 mm" plate-height="0.4 mm"/>
    <body id="right" x="1.4 mm" y="0.6 mm" width="100 um"/>
    <revolute id="A" a="ground" a-x="0 mm" a-y="0 mm" b="left" b-x="0 mm" b-y="-0.6 mm" hinge="leaf"/>
    <revolute id="B" a="left" a-x="0 mm" a-y="0.6 mm" b="stage" b-x="-0.7 mm" b-y="0 mm" hinge="leaf"/>
    <revolute id="C" a="stage" a-x="0.7 mm" a-y="0 mm" b="right" b-x="0 mm" b-y="0.6 mm" hinge="leaf"/>
    <revolute id="D" a="right" a-x="0 mm" a-y="-0.6 mm" b="ground" b-x="1.4 mm" b-y="0 mm" hinge="leaf"/>
  </mechanism>
  <scene name="push" duration="20 ms"><force on="stage" fx="{force}" law="ramp" rise="5 ms"/></scene>
</device>
"""


class InTemporary(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.addCleanup(self.temporary.cleanup)
        self.here = pathlib.Path(self.temporary.name)

    def expect(self, result, status=0):
        self.assertEqual(result.returncode, status, result.stdout[-2000:] + result.stderr[-4000:])
        return result

    def recipe(self, name, *arguments):
        self.expect(run("recipe", GALLERY, *arguments, "-o", self.here / name, "-q"))
        return self.here / name / "recipes"


class Schedule(InTemporary):
    def test_files(self):
        recipes = self.recipe("out", "--wafers", "4", "--operators", "2")
        for flow in FLOWS:
            plan = json.loads((recipes / f"{flow}.schedule.json").read_text())
            self.assertEqual((plan["schema"], plan["wafers"], plan["operators"]), ("flexwright.schedule/1", 4, 2))
            self.assertTrue(plan["feasible"])
            self.assertGreaterEqual(plan["makespan_s"], plan["lower_bound_s"] - 1e-6)
            last = max(r["end_s"] for r in plan["runs"])
            self.assertAlmostEqual(last - plan["day_open_s"], plan["makespan_s"], places=5)
            end = {}
            step = {s["id"]: i for i, s in enumerate(plan["steps"])}
            for r in plan["runs"]:  # every wafer goes through every step, in order
                for w in range(r["first_wafer"], r["first_wafer"] + r["wafers"]):
                    end.setdefault(w, {})[step[r["step"]]] = (r["start_s"], r["end_s"])
            self.assertEqual(sorted(end), [1, 2, 3, 4])
            for wafer, times in end.items():
                self.assertEqual(sorted(times), list(range(len(step))))
                for i in range(1, len(step)):
                    self.assertGreaterEqual(times[i][0], times[i - 1][1] - 1e-6)
                for hold in plan["holds"]:
                    if hold["first_only"] and wafer > 1:
                        continue
                    waited = times[step[hold["to"]]][0] - times[step[hold["from"]]][1]
                    self.assertLessEqual(waited, hold["max_s"] + 1e-5)
            rows = list(csv.DictReader(io.StringIO((recipes / f"{flow}.schedule.csv").read_text())))
            self.assertEqual(len(rows), len(plan["runs"]))
            xml.dom.minidom.parse(str(recipes / f"{flow}.schedule.svg"))
            html = (recipes / f"{flow}.html").read_text()
            self.assertIn("4 wafers, 2 operators, 08:00 to 18:00", html)
            self.assertIn("Safe stopping points", html)

    def test_days_and_planning_times(self):
        def hours(name, *arguments):
            text = (self.recipe(name, "--flow", SILICON, *arguments) / f"{SILICON}.schedule.json").read_text()
            return json.loads(text)["makespan_s"] / 3600
        alone = hours("a")
        self.assertLess(alone, 10)
        self.assertAlmostEqual(hours("b", "--planned", "S03=90 min,S09=8 min"), alone + 1.25, places=6)
        self.assertGreater(hours("c", "--day", "08:00-12:00"), 24)
        self.assertAlmostEqual(hours("d", "--day", "none"), alone, places=6)

    def test_wrong_options(self):
        for bad in (("--wafers", "0"), ("--wafers", "51"), ("--operators", "1.5"), ("--day", "8-18"),
                    ("--day", "18:00-08:00"), ("--planned", "S03"), ("--planned", "S03=90"),
                    ("--planned", "S99=1 h"), ("--planned", "S03=9 um")):
            result = self.expect(run("recipe", GALLERY, *bad, "-o", self.here / "bad"), 2)
            self.assertRegex(result.stderr, r"FW-D(230|199)")
            self.assertFalse((self.here / "bad").exists())
        self.expect(run("check", GALLERY, "--wafers", "2"), 2)


class Calibrate(InTemporary):
    def coupons(self, text=COUPONS):
        path = self.here / "lot7.csv"
        path.write_text(text)
        return path

    def calibrated(self):
        lab = self.here / "lab.xml"
        self.expect(run("calibrate", self.coupons(), "--flow", SILICON, "-o", lab))
        return lab

    def test_times_bias_and_verdict_follow(self):
        lab = self.calibrated()
        values = {q.getAttribute("id"): q for q in xml.dom.minidom.parse(str(lab)).getElementsByTagName("q")}
        self.assertEqual(sorted(values), ["made.al-edge", "pan.R", "rie.A", "rie.R", "rie.S"])
        self.assertTrue(all(q.getAttribute("status") == "measured" for q in values.values()))
        out = {}
        for name, more in (("without", ()), ("with", ("--lab", lab))):
            self.expect(run("plan", GALLERY, "--flow", SILICON, *more, "-o", self.here / name, "-q"))
            recipe = json.loads((self.here / name / f"recipes/{SILICON}.json").read_text())
            verdict = json.loads((self.here / name / "verdict.json").read_text())
            out[name] = recipe, verdict, (self.here / name / "report.html").read_text()
        time = {n: {s["id"]: s["time_s"] for s in out[n][0]["steps"]} for n in out}
        self.assertAlmostEqual(time["without"]["S14"]["nominal"], 1000, places=6)
        self.assertAlmostEqual(time["with"]["S14"]["nominal"], 1e-6 / (0.9e-6 / 1200), delta=2)
        self.assertGreater(out["with"][0]["bias_m"], out["without"][0]["bias_m"] + 1e-7)
        self.assertNotEqual(out["with"][1]["hinges"][0]["as_fabricated"],
                            out["without"][1]["hinges"][0]["as_fabricated"])
        self.assertEqual(len(out["with"][0]["overrides"]), 5)
        self.assertEqual(out["without"][0]["overrides"], [])
        self.assertRegex(out["with"][2], "laboratory.{1,6}s rie.A = 0.98")
        inputs = json.loads((self.here / "with/manifest.json").read_text())["inputs"]
        self.assertIn("lab.xml", [i["name"] for i in inputs])
        html = (self.here / f"with/recipes/{SILICON}.html").read_text()
        self.assertIn("Values of the laboratory: 5", html)

    def test_a_thickness_beside_its_aim(self):
        lab = self.here / "pads.xml"
        lab.write_text('<process xmlns="urn:flexwright:process:1" id="lab" version="1" title="x" flow="' + COPPER +
                       '"><source id="s" kind="measured">pads</source><q id="made.cu" value="1.2" u="0.0111111" unit="1" '
                       'status="measured" src="s"/></process>')
        made = {}
        for name, more in (("pack", ()), ("lab", ("--lab", lab))):
            verdict = json.loads(self.expect(run("check", GALLERY, "--flow", COPPER, "--json", *more)).stdout)
            made[name] = {h["id"]: h["as_fabricated"] for h in verdict["hinges"]}
        # of the hinge that governs: others are looked at only as far as they could come near it
        self.assertIn("thickness 8.1 um", made["pack"]["C"]["corner"])
        self.assertIn("thickness 10.6 um", made["lab"]["C"]["corner"])
        # a force bends what is thicker less: the stress goes with 1/h, 9/10.8 = 0.833
        self.assertAlmostEqual(made["lab"]["A"]["nominal"] / made["pack"]["A"]["nominal"], 9 / 10.8, delta=0.005)

    def test_a_thickness_that_a_laboratory_plans(self):
        """what comes of it goes with it, as where the description states it: 8.1 um stayed, and was accepted"""
        head = f'<process xmlns="urn:flexwright:process:1" flow="{COPPER}"><source id="s" kind="measured">book</source>'
        lab, old = self.here / "thin.xml", self.here / "old.xml"
        lab.write_text(head + '<q id="cu.d" value="6.5" u="0.01" unit="um" status="measured" src="s"/></process>')
        old.write_text(head + '<q id="made.cu" value="9.28" u="0.07" unit="um" status="measured" src="s"/></process>')
        said = []
        for name, thickness, more in (("none", "", ("--lab", lab)), ("thin", ' thickness="6.5 um"', ())):
            device = self.here / f"{name}.xml"
            device.write_text(STAGE.format(thickness=thickness, material="copper-plated", flow=COPPER, force="0.018 mN", t="10 um"))
            said.append(json.loads(run("check", device, "--json", "--measurements", "none", *more).stdout)["hinges"])
        self.assertIn("thickness 5.85 um", said[0][0]["as_fabricated"]["corner"])
        self.assertEqual([h["as_fabricated"] for h in said[0]], [h["as_fabricated"] for h in said[1]])
        # a length says nothing of another plan: refused by name
        self.assertRegex(self.expect(run("check", GALLERY, "--flow", COPPER, "--lab", old), 3).stderr,
                         "'made.cu' is pure number in the process pack, and not length")

    def test_with_the_packs_of_the_laboratory(self):
        """what follows from values that the laboratory has replaced is found with those, and a plan with others is told so"""
        head = f'<process xmlns="urn:flexwright:process:1" flow="{SILICON}"><source id="s" kind="measured">book</source>'
        mine, lab, other = (self.here / name for name in ("mine.xml", "lab.xml", "other.xml"))
        mine.write_text(head + '<q id="al.d" value="1.2" u="0.03" unit="um" status="measured" src="s"/></process>')
        other.write_text(head.replace(SILICON, COPPER) + "</process>")
        table = self.coupons("coupon,feature,drawn_um,measured,u,unit\ncd-lines,line,10,7.36,0.03,um\ncd-lines,space,10,12.64,0.03,um\n")
        edge = {}
        for name, with_lab in (("without", ()), ("with", ("--lab", mine))):
            self.expect(run("calibrate", table, "--flow", SILICON, "-o", lab, *with_lab))
            edge[name] = float(lab.read_text().split('"made.al-edge" value="')[1].split('"')[0])
            self.assertEqual("for use with mine.xml (SHA-256 " in lab.read_text(), bool(with_lab))
            for packs in (f"{mine},{lab}", f"{lab},{mine}", lab):
                told = run("check", GALLERY, "--flow", SILICON, "--lab", packs, "--measurements", "none").stderr
                self.assertEqual("FW-D676" in told, bool(with_lab) == (packs == lab), told)
        self.assertAlmostEqual(edge["with"], 0, places=6)
        self.assertAlmostEqual(edge["without"], -0.22, places=6)
        self.assertIn("for the flow 'copper-on-porous-silicon'", self.expect(run("calibrate", table, "--flow", SILICON, "--lab", other), 3).stderr)
        self.expect(run("calibrate", table, "--flow", SILICON, "--lab", self.here / "none.xml"), 5)

    def test_refusals(self):
        lab = self.here / "lab.xml"
        wrong = COUPONS.replace("undercut-ladder,width,20,16.2", "undercut-ladder,width,20,12.2")
        result = self.expect(run("calibrate", self.coupons(wrong), "--flow", SILICON, "-o", lab), 3)
        self.assertIn("FW-D212", result.stderr)
        self.assertFalse(lab.exists())
        result = self.expect(run("calibrate", self.coupons(COUPONS.replace("arde-slots,,4,", "arde-slots,,,")),
                                 "--flow", SILICON, "-o", lab), 3)
        self.assertIn("lot7.csv:3:1: error: arde-slots needs drawn_um", result.stderr)
        self.expect(run("calibrate", self.coupons()), 2)
        self.expect(run("calibrate", self.coupons(), "--flow", "no-such-flow"), 3)
        self.expect(run("calibrate", self.here / "none.csv", "--flow", SILICON), 5)
        good = self.calibrated().read_text()
        lab.write_text(good.replace('id="rie.A"', 'id="rie.B"'))
        result = self.expect(run("check", GALLERY, "--lab", lab), 3)
        self.assertIn("did you mean 'rie.", result.stderr)

    def test_standard_output(self):
        result = self.expect(run("calibrate", self.coupons(), "--flow", SILICON))
        self.assertTrue(result.stdout.startswith("<?xml"))
        self.assertIn("rie.A", result.stderr)
        lab = self.calibrated()
        result = self.expect(run("check", GALLERY, "--lab", lab, "--flow", COPPER))
        self.assertIn("FW-D211", result.stderr)  # nothing of it is used


class Bill(unittest.TestCase):
    """what a lot uses up is of the loads that its schedule makes: people and waits make more of them than full loads are"""

    def test_loads_are_those_of_the_schedule(self):
        with tempfile.TemporaryDirectory() as name:
            here = pathlib.Path(name)
            out = here / "out"
            done = run("plan", GALLERY, "--flow", SILICON, "--wafers", "6", "--operators", "2", "--corners", "none", "--advice", "none", "-o", out)
            self.assertEqual(done.returncode, 0, done.stderr)
            recipe = json.loads((out / f"recipes/{SILICON}.json").read_text())
            runs = list(csv.DictReader(io.StringIO((out / f"recipes/{SILICON}.schedule.csv").read_text())))
            steps = {s["id"]: s for s in recipe["steps"]}
            loads = {i: sum(r["step"] == i for r in runs) for i in steps}
            for machine in recipe["bill"]["machines"]:
                if machine["booked_s"] is None:
                    continue
                booked = sum(loads[i] * steps[i]["booked_s"] for i in machine["steps"].split(", "))
                self.assertAlmostEqual(machine["booked_s"] / booked, 1, 9, machine["id"])
            sheet = (out / f"recipes/{SILICON}.html").read_text()
            self.assertIn("6 wafers, in the loads of the schedule", sheet)
            self.assertGreater(loads["S06"], 1)


if __name__ == "__main__":
    unittest.main()
