#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A flow that is XML alone (processes/soi-deep-rie.xml and masks/soi-deep-rie.xml; no line of code knows it) plans the devices
of the gallery; and one number of the device moves verdict, mask, times and run sheet together."""
import hashlib
import html
import json
import math
import os
import pathlib
import re
import shutil
import tempfile
import unittest

from common import FLOWS, GALLERY, ROOT, run

FLOW = "soi-deep-rie"


def device_of(path):
    """the description with the silicon flow exchanged and everything of the copper flow left out; with holes, without which
    this flow frees nothing wide"""
    text = path.read_text()
    text = re.sub(r'\s*<(flow ref|workspace flow)="%s"[^>]*/>' % FLOWS[1], "", text)
    text = re.sub(r'\s*<scene [^>]*flow="%s"[^>]*>.*?</scene>' % FLOWS[1], "", text, flags=re.S)
    pitch = '<die release-pitch="60 um"'
    text = text.replace("<die", pitch) if "<die" in text else text.replace("<flow ref", pitch + "/><flow ref", 1)
    return text.replace(FLOWS[0], FLOW).replace("silicon-on-glass", FLOW)


class ThirdFlow(unittest.TestCase):
    def setUp(self):
        self.here = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.here)

    def plan(self, text, *options):
        done = run("plan", "-", *options, "-o", self.here / "out", input=text)
        self.assertIn(done.returncode, (0, 1, 4), done.stderr)
        out = {p.name: p.read_bytes() for p in (self.here / "out").rglob("*") if p.is_file()}
        return json.loads(out["verdict.json"]), json.loads(out[FLOW + ".json"]), out, done

    def recipe(self, text, *options):
        done = run("recipe", "-", *options, "--advice", "none", "--json", input=text)
        self.assertIn(done.returncode, (0, 1, 4), done.stderr)
        return json.loads(done.stdout)

    def test_plans_the_gallery_device(self):
        text = device_of(GALLERY)
        verdict, _, out, done = self.plan(text)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual([f["id"] for f in verdict["flows"]], [FLOW])
        for name in (".gds", ".svg", ".lyp", "-coupons.gds", ".html", ".csv", ".ics", ".sections.svg", ".stack.svg"):
            self.assertIn(FLOW + name, out)
        sections = json.loads(out[FLOW + ".sections.json"])  # what the vapour does to the oxide is XML alone, too
        film = {s["id"]: [f["material"] for f in s["films"]] for s in sections["steps"] if s["changes"]}
        self.assertEqual(film["D07"], ["silicon-substrate", "buried-oxide", "silicon-100", "resist"])
        self.assertIn("buried-oxide", film["D10"])
        self.assertNotIn("buried-oxide", film["D12"])  # everything in the window is nearer than its reach
        recipe = self.recipe(text)
        self.assertEqual(len(recipe["steps"]), 13)
        for step in recipe["steps"]:  # a time, or what is missing for it
            self.assertNotEqual(step["time_s"] is None, step["not_computable"] == [], step["id"])
        etch = next(s for s in recipe["steps"] if s["id"] == "D09")
        self.assertIs(recipe["release"]["window"], True)
        self.assertAlmostEqual(etch["time_s"]["nominal"], 50 / 3 * 60, 6)  # 3 um/min; the assumed lag is not planned with
        # (1 - A) (E - D/2) at A = 0.995, E = 1.1 D: 0.15 um, which the mask adds; the open field's own lag is 0.1 nm of it
        self.assertAlmostEqual(recipe["bias_m"], 0.005 * (55e-6 - 25e-6), delta=2e-10)
        self.assertTrue(all(s["in_source"] is False for s in recipe["steps"]))
        self.assertFalse([q for s in recipe["steps"] for q in s["quantities"] if q["status"] == "stated"])

    def own_packs(self, **edits):
        """a data directory whose third flow has texts exchanged"""
        data = self.here / "data"
        for room in ("processes", "masks"):
            shutil.copytree(ROOT / room, data / room)
        pack = data / "processes" / (FLOW + ".xml")
        text = pack.read_text()
        for old, new in edits.values():
            self.assertIn(old, text)
            text = text.replace(old, new, 1)
        pack.write_text(text)
        return dict(os.environ, FLEXWRIGHT_DATA=str(data))

    def test_its_own_material_counts(self):
        """what a flow gives again rules wherever that flow is judged, in place of the shared one"""
        own = ('<material id="silicon-100" name="our silicon" criterion="fracture" conducts="yes">'
                '<q id="youngs" value="147" u="1.5" unit="GPa" status="typical" src="guess"/>'
                '<q id="poisson" value="0.3" u="0.03" unit="1" status="assumed" src="guess"/>'
                '<q id="density" value="2329" u="2" unit="kg/m3" status="typical" src="guess"/>'
                '<q id="strength" value="5" u="0.2" unit="GPa" status="assumed" src="guess"/></material>\n  ')
        env = self.own_packs(a=("<equipment ", own + "<equipment "))
        text = re.sub(r' strength="[^"]*"', "", device_of(GALLERY))  # what the description states rules alone
        said = [json.loads(run("check", "-", "--advice", "none", "--json", input=text, env=e).stdout)
                for e in (None, env)]
        self.assertEqual(said[0]["verdict"], "reject")
        self.assertNotEqual(said[1]["verdict"], "reject")

    def test_closed_on_dates_is_said_at_once(self):
        lab = self.here / "lab.xml"
        lab.write_text('<process xmlns="urn:flexwright:process:1" flow="%s"><source id="day" kind="measured">x</source>'
                       '<tool equipment="aligner" closed="2026-12-01"/></process>' % FLOW)
        done = run("plan", "-", "--lab", lab, "-o", self.here / "out", input=device_of(GALLERY))
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("FW-D376", done.stderr)
        self.assertNotIn("hinge", done.stdout + done.stderr)
        # commands that make no schedule, and take no --day, take the pack; a log is bound to the plan that has a day
        made = run("mask", "-", "--lab", lab, "--advice", "none", "-o", self.here / "masks", input=device_of(GALLERY))
        self.assertTrue((self.here / "masks").is_dir(), made.stderr)
        log = self.here / "lot.log"
        logged = run("log", "-", "--lab", lab, "--run", log, "--lot", "L1", "--wafers", "1", "--entry",
                     "D01; start=2026-11-02T08:00; end=2026-11-02T08:08; by=AB", input=device_of(GALLERY))
        self.assertEqual(logged.returncode, 0, logged.stderr)
        run("recipe", "-", "--lab", lab, "--day", "08:00-18:00 from 2026-11-30", "-o", self.here / "dated", input=device_of(GALLERY))
        recipe = (self.here / f"dated/recipes/{FLOW}.json").read_bytes()
        self.assertIn(f"plan={hashlib.sha256(recipe).hexdigest()}", log.read_text())

    def test_comb_drives_are_insulated_by_the_oxide(self):
        text = device_of(ROOT / "docs/gallery/comb-stage/device.xml").replace(' carrier="insulating"', "")
        recipe = self.recipe(text)
        self.assertNotEqual(recipe["manufacturable"], False, recipe["reasons"])
        self.assertFalse([r for r in recipe["reasons"] if "insulates" in r])
        other = self.recipe(text.replace(FLOW, FLOWS[0]))  # the same drives, cut from one sheet
        self.assertIs(other["manufacturable"], False)
        self.assertTrue([r for r in other["reasons"] if "insulates" in r])

    def test_one_thickness_moves_everything(self):
        text = device_of(GALLERY)
        made = {}
        for thickness in (50, 40):
            verdict, _, out, _ = self.plan(text, "--set", "material/@thickness=%d um" % thickness)
            recipe = self.recipe(text, "--set", "material/@thickness=%d um" % thickness)
            etch = next(s for s in recipe["steps"] if s["id"] == "D09")
            sheet = out[FLOW + ".html"].decode()
            made[thickness] = (verdict["governing"], recipe["bias_m"], etch["time_s"]["nominal"], out[FLOW + ".gds"], sheet)
            self.assertIn("<b>%d</b>" % thickness, sheet)
        for before, after in zip(made[50], made[40]):
            self.assertNotEqual(before, after)
        self.assertAlmostEqual(made[40][1] / made[50][1], 0.8, delta=1e-3)
        self.assertAlmostEqual(made[40][2] / made[50][2], 0.8, 9)


class Coupons(unittest.TestCase):
    def test_a_coupon_gives_what_is_read_of_it(self):
        """an entry with the readings of the slots is not asked for their depth besides; one without them is"""
        here = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, here)
        (here / "leaf.xml").write_text(OrderedPlate.LEAF.replace("silicon-on-glass", FLOW).replace(' carrier="insulating"', "").replace("<order/>", ""))
        for coupon, asked in (("; coupon=arde-slots, drawn=10 um, value=45.6 45.4 um, u=0.1 um, at=16 min", 1), ("", 2)):
            done = run("log", here / "leaf.xml", "--flow", FLOW, "--corners", "none", "--run", here / f"{asked}.log", "--lot", "L", "--wafers", "1", "--entry",
                       "D11; wafer=1; start=2026-11-20T11:00; end=2026-11-20T11:12; by=AB; "
                       "flexure width at the top against the drawn one=-1; flexure width at the bottom against the drawn one=1" + coupon)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(done.stderr.count("the entry does not give"), asked, done.stderr)
            self.assertEqual("depth of the slots" in done.stderr, asked == 2, done.stderr)


class MeasuredWidths(unittest.TestCase):
    """Widths that steps accept agree with each other, and with what the verdict has judged: no step holds a wafer that another
    one has passed, nothing between them having etched it, or that lies within the ranges of its own corners."""

    def test_limits_are_those_that_were_judged(self):
        printed = {"copper-on-porous-silicon": 0.5}  # litho.edge, either way, um; others 0.15
        metal = {"al-masked-rie": 0.22, "silicon-on-glass": 0.22}  # made.al-edge, two standard uncertainties
        here = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, here)
        for flow in (*FLOWS, FLOW, "soi-double-sided", "silicon-on-glass"):
            text = OrderedPlate.LEAF.replace("silicon-on-glass", flow).replace("<order/>", "")
            if flow == FLOWS[1]:
                text = text.replace('<material ref="silicon-100" thickness="50 um"/>', '<material ref="copper-plated"/>')
            if flow != "silicon-on-glass":
                text = text.replace(' carrier="insulating"', "")
            done = run("recipe", "-", "--flow", flow, "--corners", "none", "--measurements", "none", "--advice", "none", "--force", "-o", here / flow, input=text)
            self.assertIn(done.returncode, (0, 1, 4), done.stderr)
            sheet = (here / flow / f"recipes/{flow}.html").read_text()
            page = html.unescape(re.sub("<[^>]+>", "", sheet))
            # who has to part the wafer is told before its first step, not in the sheet's last line
            head = re.sub("<[^b][^>]+>", "", sheet.split("Can this flow make this device?")[1].split("<h3>")[0].split("<h2>")[0])
            parted = ("al-masked-rie", "silicon-on-glass")
            self.assertEqual("no step of this flow parts the wafer" in head, flow not in parted, flow)
            self.assertEqual("frees the devices while it is whole" in head, flow not in parted, flow)
            self.assertEqual("no step of it parts it into dies" in page, flow not in parted, flow)
            found = {}
            for what, low, high, unit in re.findall(r"(flexure width[^\n]*?) against the drawn one[^\n]*?(-?[\d.]+) to (-?[\d.]+) (%|µm)", page):
                found.setdefault(what, set()).add((float(low), float(high), unit))
            if flow not in FLOWS[:1] + ("silicon-on-glass",):
                self.assertEqual(sorted(found), ["flexure width at the bottom", "flexure width at the top"], flow)
            for what, limits in found.items():
                self.assertEqual(len(limits), 1, (flow, what, limits))
                low, high, unit = limits.pop()
                edge = printed.get(flow, 0.15) + metal.get(flow, 0)
                judged = 2 * edge * (1 if unit == "µm" else 10)  # leaves of 10 um
                # an etch that takes more above than below moves the lower end at the top, the upper one at the bottom, away
                self.assertLessEqual(low, -judged + 1e-9 if what != "flexure width at the bottom" else judged, (flow, what))
                self.assertGreaterEqual(high, judged - 1e-9 if what != "flexure width at the top" else -judged, (flow, what))
                self.assertLess(high - low, 2 * judged + (35 if unit == "%" else 0.011), (flow, what))


class OrderedPlate(unittest.TestCase):
    """A plate within the CD tolerance that its order states is one that the verdict still accepts: hinges, and what is required."""
    LEAF = """<device xmlns="urn:flexwright:device:1" name="tuned-leaf">
      <parameter name="w" value="10 um"/><material ref="silicon-100" thickness="50 um"/><flow ref="silicon-on-glass" carrier="insulating"/>
      <die tethers="no"/><order/><flexure id="leaf" kind="leaf" length="400 um" width="w"/>
      <mechanism><body id="bar" x="0 mm" y="0.75 mm" width="120 um"/><revolute id="A" a="ground" b="bar" b-y="-0.75 mm" hinge="leaf"/></mechanism>
      <require frequency="1" plane="in" min="3.7 kHz"/>
      <scene name="nudge" duration="1 ms"><torque on="bar" value="1e-4 mN mm"/></scene>
    </device>"""

    def test_tolerance_keeps_the_verdict(self):
        here = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, here)
        done = run("plan", "-", "--measurements", "none", "-o", here / "out", input=self.LEAF)
        self.assertEqual(done.returncode, 0, done.stderr)
        order = json.loads((here / "out/masks/silicon-on-glass-plate.device.order.json").read_text())
        cd = order["cd_tolerance_um"]
        self.assertIn("requirement frequency-1", order["cd_tolerance_decided_by"])
        self.assertEqual(order["cd_tolerance_from"], "half of what the verdict has left")

        def check(*options):
            return run("check", "-", "--advice", "none", *options, input=self.LEAF).returncode
        for line in (10 - cd, 10 + cd):  # the leaves alone
            self.assertEqual(check("--set", f"w={line} um"), 0, line)
        for share, status in ((1, 0), (2.5, 4)):  # every edge of the device, beside what the laboratory prints
            edge = 0.15 + 0.5 * share * cd
            (here / "lab.xml").write_text(f"""<process xmlns="urn:flexwright:process:1" id="lab" version="1" title="a plate" flow="silicon-on-glass">
              <source id="plate" kind="measured">CD of the plate</source>
              <q id="litho.edge" value="0" lo="-{edge}" hi="{edge}" unit="um" status="assumed" src="plate"/></process>""")
            self.assertEqual(check("--lab", here / "lab.xml"), status, share)

    ARM = """<device xmlns="urn:flexwright:device:1" name="arm">
      <parameter name="push" value="0.2 mN"/><material ref="silicon-100" thickness="50 um"/><limits safety-factor="2"/><flow ref="al-masked-rie"/>
      <order/><die clearance="300 um"/><flexure id="leaf" kind="leaf" length="350 um" width="9 um"/>
      <mechanism><body id="bar" x="0 mm" y="0.6 mm" width="200 um"/><revolute id="A" a="ground" b="bar" b-y="-0.6 mm" hinge="leaf"/></mechanism>
      <scene name="push" duration="1.5 ms"><force on="bar" fx="push" fy="0 mN" law="ramp" rise="1 ms"/><air kind="slide" gap="10 um"/></scene>
    </device>"""

    def lab(self, here, edge):
        path = here / f"lab-{edge}.xml"
        path.write_text(f"""<process xmlns="urn:flexwright:process:1" flow="al-masked-rie"><source id="mine" kind="measured">Our laboratory</source>
          <q id="pan.T" value="22" u="0.5" unit="Cel" status="measured" src="mine"/>
          <q id="litho.edge" value="0" lo="-{edge}" hi="{edge}" unit="um" status="assumed" src="mine"/></process>""")
        return path

    def test_sheet_and_verdict_say_one_figure(self):
        """Corners are judged as closely as their decisions ask for, and have bands of their own. The order stands on the upper end of
        the worst one, as the verdict does, and not on the widest band of any at the most that is used: that asked for a plate of
        +-0 um of what is accepted."""
        here = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, here)
        lab = self.lab(here, 0.15)
        for push in ("0.185 mN", "0.195 mN", "0.203 mN"):
            options = ("-", "--set", f"push={push}", "--lab", lab)
            done = run("check", *options, "--advice", "none", "--json", input=self.ARM)
            self.assertEqual(done.returncode, 0, done.stderr)
            top = json.loads(done.stdout)["governing"]["utilisation_band"][1]
            out = here / push.split()[0]
            done = run("mask", *options, "-o", out, input=self.ARM)
            self.assertEqual(done.returncode, 0, done.stderr)
            order = json.loads((out / "masks/al-masked-rie-plate.order.json").read_text())
            says, by = re.fullmatch(r"hinge A: at most ([\d.]+) % of its limit; lines 0.1 um wider change that by (-[\d.]+) %",
                                    order["cd_tolerance_decided_by"]).groups()
            self.assertAlmostEqual(float(says), 100 * top, delta=0.051)
            # half of the way to the limit, of which the logarithm goes straight with a width
            left = -math.log(top) / (-float(by) / 100 / top / 0.1)
            self.assertGreater(order["cd_tolerance_um"], 0.5 * left - 0.011)
            self.assertLessEqual(order["cd_tolerance_um"], 0.5 * left + 0.001)
            wider = self.lab(here, 0.15 + 0.5 * order["cd_tolerance_um"])
            done = run("check", "-", "--set", f"push={push}", "--lab", wider, "--advice", "none", input=self.ARM)
            self.assertEqual(done.returncode, 0, done.stdout)


class BothFaces(unittest.TestCase):
    """soi-double-sided: windows etched from the back by a plate of its own, aligned to the front"""
    FLOW = "soi-double-sided"
    STAGE = ROOT / "docs/gallery/comb-stage/device.xml"

    def setUp(self):
        self.here = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.here)
        self.device = self.here / "device.xml"
        self.device.write_text(self.STAGE.read_text().replace("silicon-on-glass", self.FLOW))

    def test_is_planned_whole(self):
        done = run("plan", self.device, "--cut", "-900,100,100,100", "--wafers", "2", "-o", self.here / "out")
        self.assertEqual(done.returncode, 0, done.stderr)

        def document(name):
            return json.loads((self.here / "out" / name.replace("FLOW", self.FLOW)).read_text())
        recipe = {s["id"]: s for s in document("recipes/FLOW.json")["steps"]}
        self.assertEqual({k: (s["plate"]["id"], s["plate"]["side"], s["plate"]["aligned_to"]) for k, s in recipe.items() if "plate" in s},
                         {"B06": ("device", "front", ""), "B17": ("window", "back", "device")})
        self.assertEqual(recipe["B17"]["plate"]["overlay_m"], 5e-6)
        sheet = (self.here / f"out/recipes/{self.FLOW}.html").read_text()
        self.assertIn("on the back, mirrored, to device on the front", sheet)
        self.assertIn("positive photoresist, back 10", sheet)
        # the back is written as drawn, the front as its mirror image, since the wafer is turned over
        self.assertEqual([document(f"masks/FLOW-plate.{p}.order.json")["mirrored_in_data"] for p in ("device", "window")], [True, False])
        runs = document("recipes/FLOW.schedule.json")["runs"]
        for wafer in (1, 2):  # the front is cut before the back is, on every wafer
            start = {r["step"]: r["start_s"] for r in runs if r["first_wafer"] <= wafer < r["first_wafer"] + r["wafers"]}
            self.assertLess(start["B09"], start["B20"])
        films = {s["id"]: [f["material"] for f in s["films"]] for s in document("recipes/FLOW.sections.json")["steps"] if s["changes"]}
        self.assertEqual(films["B15"].count("resist"), 3)  # on what stands, beside it, and on the back
        self.assertNotIn("resist", films["B22"])
        self.assertEqual(films["B23"], ["silicon-substrate", "buried-oxide", "silicon-100"])

    def test_a_plate_of_the_wrong_face(self):
        data = self.here / "data"
        for folder in ("processes", "masks"):
            shutil.copytree(ROOT / folder, data / folder, ignore=shutil.ignore_patterns("gallery"))
        table, pack = data / f"masks/{self.FLOW}.xml", data / f"processes/{self.FLOW}.xml"
        for file, old, new, says in (
                (table, "wrong-reading", "right-reading", 'step B17 prints plate "window" on the back'),
                (table, 'title="the device, on the front" layers="1/0 NOT 2/0 NOT 3/0" reading="right',
                 'title="the device, on the front" layers="1/0 NOT 2/0 NOT 3/0" reading="wrong', 'step B06 prints plate "device" on the front'),
                (table, 'name="WINDOW" purpose="windows in the handle below what moves" tone="data clear"',
                 'name="WINDOW" purpose="windows in the handle below what moves" tone="data dark"', "step B17 exposes 'window', which lies inside"),
                (pack, '<plate id="window" inside="window" outside="handle"/>', '<plate id="window" inside="handle" outside="window"/>',
                 "which lies outside of the polygons")):
            whole = file.read_text()
            self.assertIn(old, whole)
            file.write_text(whole.replace(old, new))
            done = run("check", self.device, "--corners", "none", env={**os.environ, "FLEXWRIGHT_DATA": str(data)})
            self.assertEqual(done.returncode, 3, done.stderr)
            self.assertIn("FW-D546", done.stderr)
            self.assertIn(says, done.stderr)
            file.write_text(whole)


class PlatedArea(unittest.TestCase):
    def test_recipe_and_plate_say_one_area(self):
        """what a plate draws beside its dies is plated where it lies over the wafer: a pad of 4 mm in the rim, one that the rim cuts,
        and neither title nor crosses. In either tone of the plate: what is written of the other one is the rest of the wafer"""
        here = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, here)
        corners = "".join("10\n%d\n20\n%d\n" % at for at in ((-2000, -2000), (2000, -2000), (2000, 2000), (-2000, 2000)))
        (here / "pad.dxf").write_text("0\nSECTION\n2\nENTITIES\n0\nLWPOLYLINE\n8\n0\n90\n4\n70\n1\n" + corners + "0\nENDSEC\n0\nEOF\n")
        pads = '<cell file="pad.dxf" unit="um" x="0 mm" y="40 mm"/><cell file="pad.dxf" unit="um" x="49 mm" y="0 mm"/>'
        area = {}
        for name, order, cells in (("none", "", ""), ("pads", "", pads), ("other", '<order tone="inverted"/>', pads)):
            text = (ROOT / "docs/gallery/copper-nodder/device.xml").read_text()
            wafer = '<wafer diameter="100 mm" flat="0 mm" edge-exclusion="20 mm">%s%s</wafer></device>' % (order, cells)
            (here / "device.xml").write_text(text.replace("</device>", wafer))
            done = run("plan", here / "device.xml", "-o", here / name, "--force", "--measurements", "none", "--corners", "none", "--advice", "none")
            self.assertIn(done.returncode, (0, 1, 4), done.stderr)
            plate = json.loads((here / name / "masks/copper-on-porous-silicon-plate.order.json").read_text())
            said = re.search(r"structures of all dies,([\d.]+),cm2", (here / name / "recipes/copper-on-porous-silicon.csv").read_text())
            area[name] = float(said[1]), plate["wafer_area_mm2"] / 100, plate["area_mm2"] / 100
        for name in ("none", "pads"):
            self.assertAlmostEqual(area[name][1] / area[name][0], 1, 5)
            self.assertGreater(area[name][2], area[name][0] + 0.2)  # title and crosses are on no wafer
        self.assertAlmostEqual(area["other"][0], area["pads"][0], 9)
        self.assertAlmostEqual(area["other"][1], math.pi * 25 - area["pads"][1], 5)
        R, a, b = 5.0, 0.2, 4.7  # cm; of the second pad what is nearer than R
        cut = 2 * (0.5 * (a * math.sqrt(R * R - a * a) + R * R * math.asin(a / R)) - a * b)
        self.assertAlmostEqual(area["pads"][0] - area["none"][0], 0.16 + cut, 5)


if __name__ == "__main__":
    unittest.main()
