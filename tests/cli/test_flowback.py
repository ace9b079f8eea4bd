#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measured values flow back: a mock lot of six wafers is logged, reported, calibrated and planned again, in one command
each and with nothing copied between them; what cannot be is refused, with what there is."""
import datetime
import hashlib
import html
import json
import math
import pathlib
import random
import re
import tempfile
import unittest
import xml.etree.ElementTree as tree

from common import FLOWS, ROOT, device_for, run

SILICON, COPPER = FLOWS
GALLERY_STAGE = ROOT / "docs/gallery/comb-stage/device.xml"
SPACE = "{urn:flexwright:process:1}"


def knudsen(x):
    """transmission of a slot of depth/width x (Berman)"""
    if x < 1e-3:
        return 1 - x / 2 + x * x / 4 - x**3 / 24
    s = math.sqrt(1 + x * x)
    return (1 + s - x) / 2 - 1.5 * (x - math.asinh(x))**2 / (x**3 + 3 * x * x + 4 - (x * x + 4) * s)


def depth(width, travelled, lag):
    """root of D + S J(w, D) = R t by bisection, J by the trapezoidal rule; all in um"""
    def transport(end, n=400):
        f = [1 / knudsen(end * i / n / width) - 1 for i in range(n + 1)]
        return end / n * (sum(f) - (f[0] + f[-1]) / 2)
    low, high = 0.0, travelled
    for _ in range(40):
        middle = (low + high) / 2
        low, high = (middle, high) if middle + lag * transport(middle) < travelled else (low, middle)
    return low


class Flowback(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.addCleanup(self.temporary.cleanup)
        self.here = pathlib.Path(self.temporary.name)
        self.log = self.here / "lot.log"
        self.random = random.Random(1)
        self.stage = self.here / "comb-stage.xml"  # in the flow of one plate
        self.stage.write_text(GALLERY_STAGE.read_text().replace("silicon-on-glass", SILICON))

    def expect(self, result, status=0):
        self.assertEqual(result.returncode, status, result.stdout[-2000:] + result.stderr[-4000:])
        return result

    def command(self, *arguments):
        # how exactly the motion is known changes nothing of a log
        return run("log", self.stage, "--flow", SILICON, "--run", self.log, "--corners", "none", "--accuracy", "3e-2", *arguments)

    def sites(self, mean, spread):
        return " ".join(f"{self.random.gauss(mean, spread):.3f}" for _ in range(5))

    def etch(self, wafer, *more, power="250 W", rate=0.545, lag=0.09, end="10:05", words=""):
        coupons = []
        for width in (5, 10, 20, 50, 100):
            values = self.sites(depth(width + 2.2, rate * 90, lag), 0.25)
            coupons += ["--coupon", f"arde-slots, drawn={width} um, value={values} um, u=0.05 um, at=90 min, u-at=3 s"]
        return self.command("--entry", f"S18; start=2026-11-0{wafer}T08:00; end=2026-11-0{wafer}T{end}; by=AB; second=CD{words}",
                            "--wafer", wafer, "--instrument", "profilometer 2", "--setting", f"power={power}",
                            "--site", f"aluminium left={self.sites(0.42, 0.01)} um", *coupons, *more)

    def lot(self):
        for wafer in range(1, 7):
            first = ("--lot", "L7", "--wafers", "6") if wafer == 1 else ()
            self.expect(self.etch(wafer, *first, power="262 W" if wafer == 3 else "250 W",
                                  rate=0.545 * (1 + 0.01 * self.random.gauss(0, 1))))

    def test_the_sheet_asks_of_the_step_what_calibrate_takes(self):
        for flow in ("al-masked-rie", "silicon-on-glass"):
            line = next(l for l in (ROOT / f"masks/{flow}.xml").read_text().splitlines() if 'id="al-step"' in l)
            self.assertIn('measure="aluminium that the plasma took', line)
        table = self.here / "left.csv"
        for lost, status in ((1.3, 3), (0.8, 0)):
            table.write_text(f"coupon,feature,drawn_um,measured,u,unit,at,u_at,at_unit\nal-step,,,{lost},0.01,um,50,0.2,um\n")
            done = run("calibrate", table, "--flow", "al-masked-rie", "-o", self.here / "left.xml")
            self.assertEqual(done.returncode, status, done.stderr)
            self.assertEqual("al-step: the mask lost 1.3 um, and there were 1 um of it (al.d)" in done.stderr, status == 3, done.stderr)

    def test_a_doubtful_unit_is_said_to_the_quiet_too(self):
        entry = "S01; start=2026-11-02T08:00; end=2026-11-02T08:08; by=AB; thickness=50.1 {}; cracks or chipped edge=0"
        for number, (unit, says) in enumerate((("mm", "more than 100 times the 52 um"), ("nm", "less than a hundredth of the 48 um"),
                                               ("um", None))):
            self.log = self.here / f"{number}.log"
            said = self.expect(self.command("--entry", entry.format(unit), "--wafer", "1", "--wafers", "6", "-q")).stderr
            self.assertEqual(said.strip() == "", says is None, said)
            if says:
                self.assertIn(says, said)
                self.assertIn("is the unit right?", said)

    def test_a_measured_thickness_that_the_description_overrules_is_told(self):
        lab = self.here / "thick.xml"
        lab.write_text(f'<process xmlns="urn:flexwright:process:1" flow="{SILICON}"><source id="gauge" kind="measured" '
                       'date="2026-11-20">gauge</source><q id="si.d" value="48" u="0.2" unit="um" status="measured" '
                       'src="gauge"/></process>')
        leaf = ROOT / "docs/gallery/leaf-four-bar/device.xml"
        judged = ("check", leaf, "--lab", lab, "--measurements", "none", "--corners", "none")
        told = self.expect(run(*judged)).stderr
        self.assertIn("FW-D507", told)
        self.assertIn('--set "material/@thickness=48 um"', told)
        self.assertNotIn("FW-D507", self.expect(run(*judged, "--set", "material/@thickness=48 um")).stderr)

    def test_a_wafer_that_the_description_overrules_is_told(self):
        lab, device = self.here / "wide.xml", self.here / "device.xml"
        device.write_text((ROOT / "docs/gallery/leaf-four-bar/device.xml").read_text().replace(
            "</device>", '<wafer diameter="100 mm"/></device>'))
        judged = ("check", device, "--lab", lab, "--measurements", "none", "--corners", "none", "--flow", SILICON)
        for width, told in ((150, True), (100, False), (76.2, True)):
            lab.write_text(f'<process xmlns="urn:flexwright:process:1" flow="{SILICON}"><source id="order" kind="measured" '
                           f'date="2026-11-20">order</source><q id="wafer.D" value="{width}" u="0.1" unit="mm" '
                           'status="measured" src="order"/></process>')
            said = self.expect(run(*judged)).stderr
            self.assertEqual("FW-D529" in said, told, said)
            if told:
                self.assertRegex(said, rf"wide\.xml:\d+:\d+: warning: 'wafer.D' is {width:g} mm here, but the <wafer>")
                self.assertNotIn("FW-D529", self.expect(run(*judged, "--set", f"wafer/@diameter={width} mm")).stderr)

    def test_a_laboratory_meets_the_spinner_too(self):
        lab = self.here / "thick.xml"
        lab.write_text(f'<process xmlns="urn:flexwright:process:1" flow="{SILICON}"><source id="sheet" kind="datasheet" '
                       'date="2026-11-20">sheet</source><q id="litho.resist" value="60" u="1" unit="um" status="typical" '
                       'src="sheet"/></process>')
        said = self.expect(run("recipe", ROOT / "docs/gallery/leaf-four-bar/device.xml", "--flow", SILICON, "--lab", lab,
                               "-o", self.here / "out"), 3).stderr
        self.assertRegex(said, r"thick\.xml:\d+:\d+: error: step S07 would spin at 2\.28 rpm .*FW-D563")

    def test_a_step_that_the_device_does_not_need_is_nowhere(self):
        """the tethers of a device that has none are broken in no file; the sheet shows the step struck out, with its reason"""
        without, glass, files, bill = GALLERY_STAGE.read_text(), "silicon-on-glass", {}, {}
        for name, text in (("none", without), ("some", without.replace(' tethers="no"', ""))):
            device = self.here / f"{name}.xml"
            device.write_text(text)
            self.expect(run("recipe", device, "--corners", "none", "--measurements", "none", "--advice", "none", "-q",
                            "-o", self.here / name))
            files[name] = {p.name: p.read_text() for p in (self.here / name / "recipes").iterdir()}
            recipe = json.loads(files[name].pop(glass + ".json"))
            self.assertEqual([s["id"] for s in recipe["steps"]].count("G50"), name == "some")
            self.assertEqual(recipe.get("left_out"), None if name == "some" else [
                {"id": "G50", "title": "Break the tethers", "before": "G51", "why": "the device has no tethers"}])
            bill[name] = {m["id"]: m for m in recipe["bill"]["machines"]}
        self.assertEqual(files["none"].keys(), files["some"].keys())
        sheet = files["none"].pop(glass + ".html")
        struck = "<s>G50&ensp;Break the tethers</s>: left out, the device has no tethers."
        self.assertEqual(sheet.count(struck), 2)
        self.assertNotIn("G50", sheet.replace(struck, ""))
        self.assertNotIn("<s>G50", files["some"].pop(glass + ".html"))
        for name, text in files["none"].items():
            self.assertNotIn("G50", text, name)
        for name in (".csv", ".ics", ".schedule.csv", ".schedule.json", ".schedule.svg", ".sections.json"):
            self.assertIn("G50", files["some"][glass + name], name)
        self.assertLess(bill["none"]["prober"]["booked_s"], bill["some"]["prober"]["booked_s"])
        entry = "G50; start=2026-11-02T08:00; end=2026-11-02T08:15; by=AB; bridges that still stand=0"
        for name, status in (("none", 3), ("some", 0)):
            said = self.expect(run("log", self.here / f"{name}.xml", "--flow", glass, "--run", self.here / f"{name}.log", "--lot", "L1",
                                   "--wafers", "1", "--entry", entry, "--wafer", "1", "-q"), status).stderr
            self.assertEqual("step 'G50' (Break the tethers) is left out of this plan, because the device has no tethers" in said,
                             name == "none", said)
        late = run("recipe", self.here / "none.xml", "--planned", "G50=20 min", "-o", self.here / "late")
        self.assertIn("no flow of this device has such a step", self.expect(late, 2).stderr)

    def test_words_as_they_are_printed(self):
        """ids of wafers with - between two, measures with the coupon that they are read on, coupons by the name that the sheet
        has; "no" and "none" are 0 where a number is limited that may be 0, and "yes" is none; a step of all wafers, one after the
        other, takes as many times as long as there are loads"""
        day = self.here / "day.txt"
        day.write_text("S02; start=2025-06-02T08:00; end=2025-06-02T08:35; by=AB; wafer=A1-A3\n"
                       "S05; start=2025-06-02T09:00; end=2025-06-02T10:00; by=AB\n"
                       "S18; start=2025-06-02T11:00; end=2025-06-02T13:05; by=AB; wafer=A2; aluminium left on coupon al-step=0.4 um; "
                       "coupon=slots, drawn=10 um, value=45.4 um, u=0.1 um, at=90 min\n")
        self.expect(self.command("--lot", "L", "--wafers", "A1,A2,A3,B4", "--entries", day))
        lines = [line.split("\t") for line in self.log.read_text().splitlines()]
        self.assertEqual([word for line in lines for word in line if "S02" in line[0] and word.startswith("wafer=")],
                         ["wafer=A1", "wafer=A2", "wafer=A3"])
        steps = {s["id"]: s for s in json.loads(self.expect(self.command("--json")).stdout)["steps"]}
        self.assertEqual(steps["S05"]["judged"], "in window")
        self.assertEqual(steps["S18"]["measured"][0]["measure"], "aluminium left")
        when = "; start=2025-06-02T14:00; end=2025-06-02T16:05; by=AB"
        for wafer, word in (("A1", "no"), ("A3", "none"), ("B4", "0")):
            self.expect(self.command("--entry", f"S18; wafer={wafer}; grass on the floor={word}{when}"))
        told = [m for s in json.loads(self.expect(self.command("--json")).stdout)["steps"] for e in (s, *s.get("others", [])) for m in e.get("measured", [])
                if m["measure"] == "grass on the floor"]
        self.assertEqual([(m["value"], m["accepted"]) for m in told], 3 * [(0, True)])
        for words, says in (("S18; wafer=A1; grass on the floor=yes", "its limits are numbers"), ("S01; wafer=A1; thickness=none", "thickness=none"), ("S02; wafer=A3-A1", "no wafer 'A3-A1'")):
            result = self.expect(self.command("--entry", words + "; start=2025-06-02T14:00; end=2025-06-02T16:05; by=AB"), 3)
            self.assertIn(says, result.stderr)

    def test_a_load_is_an_entry_of_each_of_its_wafers(self):
        """as the schedule of the sheet writes it; the log is that of single entries, byte for byte"""
        clean = "S02; start=2026-11-02T08:48; end=2026-11-02T09:23; by=AB; particles in bright light=0"
        begun = ("--wafers", "6", "--lot", "L1", "-q")
        for number, (load, wafers) in enumerate((("1-6", "123456"), ("2,5", "25"), ("1-3,6", "1236"), ("4", "4"))):
            self.log = self.here / f"load{number}.log"
            self.expect(self.command("--entry", clean, "--wafer", load, "--setting", "bath temperature=74 Cel", *begun))
            together = self.log.read_bytes()
            self.log = self.here / f"single{number}.log"
            for k, wafer in enumerate(wafers):
                self.expect(self.command("--entry", clean, "--wafer", wafer, "--setting", "bath temperature=74 Cel",
                                         *(begun if k == 0 else ("-q",))))
            self.assertEqual(together, self.log.read_bytes(), load)
            day = self.here / "day.txt"
            day.write_text(f"{clean}; wafer={load}; set bath temperature=74 Cel\n")
            self.log = self.here / f"day{number}.log"
            self.expect(self.command("--entries", day, *begun))
            self.assertEqual(len(self.log.read_text().splitlines()), 1 + len(wafers))
        before = self.log.read_bytes()
        for load, more, says in (("3-7", (), "no wafer '7'"), ("1,,2", (), "'wafer=' is not written"), ("5-2", (), "no wafer '5-2'"),
                                 ("1-2", ("--site", "particles in bright light=0 0 0 0 0"), "of several wafers (1-2)")):
            result = self.expect(self.command("--entry", clean, "--wafer", load, *more), 3)
            self.assertIn(says, result.stderr)
            self.assertEqual(before, self.log.read_bytes())
        # a wafer that is named like a range is that wafer
        self.log = self.here / "named.log"
        self.expect(self.command("--entry", clean, "--wafer", "1-2", "--wafers", "1-2,1,2", "-q"))
        self.assertEqual(len(self.log.read_text().splitlines()), 2)

    def test_what_the_sheet_prints_can_be_typed(self):
        """its signs for units, and differences below 0"""
        for number, unit in enumerate(("um", "µm", "μm")):
            self.log = self.here / f"unit{number}.log"
            self.expect(self.command("--entry", "S01; start=2026-11-02T08:00; end=2026-11-02T08:08; by=AB; thickness=50.1 50.2 50 49.9 50.3 "
                                     + unit, "--wafer", "1", "--wafers", "1", "-q"))
            self.expect(self.command("--entry", "S08; start=2026-11-02T10:00; end=2026-11-02T10:02; by=AB", "--setting",
                                     "temperature=100 " + ("°C" if number else "Cel"), "--wafer", "1", "-q"))
            self.expect(self.command("--entry", "S12; start=2026-11-02T12:00; end=2026-11-02T12:08; by=AB; "
                                     f"resist width against the mask=-0.2 0.1 -0.1 0 -0.2 {unit}", "--wafer", "1", "-q"))
            done = json.loads(self.expect(self.command("--json")).stdout)
            sites = {s["id"]: s["measured"][0]["sites"]["centre"] for s in done["steps"] if s["id"] in ("S01", "S12")}
            self.assertEqual(sites, {"S01": 50.1, "S12": -0.2})
        said = self.expect(self.command("--entry", "S12; start=2026-11-02T12:00; end=2026-11-02T12:08; by=AB; "
                                        "resist width against the mask=-0.2 m", "--wafer", "1"), 3)
        self.assertIn("FW-D278", said.stderr)

    def test_a_difference_is_one_wherever_its_limits_lie(self):
        """a pack with a larger edge of the aluminium puts both limits of a line's width against the drawn one above 0; what was logged by
        limits below 0 is read as it stands"""
        lab = self.here / "lab.xml"
        lab.write_text('<process xmlns="urn:flexwright:process:1" id="laboratory" version="1" title="x" flow="al-masked-rie">'
                       '<source id="laboratory" kind="measured">x</source>'
                       '<q id="made.al-edge" value="1.15" u="0.02" unit="um" status="measured" src="laboratory"/></process>')
        entry = "S15; start=2026-11-02T10:00; end=2026-11-02T10:07; by=AB; line width in aluminium against the drawn one="
        for number, (packs, width) in enumerate((((), "-1.9"), (("--lab", lab), "-0.05"), (("--lab", lab), "none"))):
            self.log = self.here / f"difference{number}.log"
            self.expect(self.command("--entry", f"{entry}{width}{'' if width == 'none' else ' um'}", "--wafers", "1", "-q", *packs))
            done = json.loads(self.expect(self.command("--json", *packs)).stdout)
            (measured,) = [s["measured"][0] for s in done["steps"] if s["id"] == "S15"]
            self.assertEqual(measured["value"], 0 if width == "none" else float(width))
            self.assertEqual(measured["accepted"], not packs)
        self.log = self.here / "difference0.log"
        self.expect(self.command("--entry", "plan; start=2026-11-03T08:00; by=AB; note=the edge was measured", "-q", "--lab", lab))

    def test_every_line_of_every_sheet_can_be_typed(self):
        """what has a cell for what was really set or measured, of all five flows, by the name that is printed"""
        for flow in ("al-masked-rie", "copper-on-porous-silicon", "soi-deep-rie", "silicon-on-glass", "soi-double-sided"):
            device = self.here / f"{flow}.xml"
            device.write_text(GALLERY_STAGE.read_text() if flow == "silicon-on-glass" else device_for(flow))
            few = ("--flow", flow, "--corners", "none", "--accuracy", "3e-2", "-q")
            out = self.here / flow
            run("recipe", device, *few, "--measurements", "none", "--advice", "none", "-o", out)
            sheet = (out / "recipes" / f"{flow}.html").read_text()
            day, lines, set_ = self.here / "day.txt", [], 0
            for step, body in re.findall(r'<section class="step" id="(\w+)">(.*?)</section>', sheet, re.S):
                rows = [[html.unescape(re.sub("<[^>]*>", "", c)).strip() for c in re.findall(r"<td[^>]*>(.*?)</td>", row, re.S)]
                        for row in re.findall(r"<tr[^>]*>(.*?)</tr>", body, re.S)]
                words = [f"{step}; start=2026-11-02T08:00; end=2026-11-02T08:08; by=AB; second=CD"]
                for cells in rows:
                    planned = re.match(r"([-\d.e]+)(?: ± [-\d.e]+)? ?(.*)$", cells[1]) if len(cells) == 5 and cells[4] == "" else None
                    if planned:
                        words.append(f"set {cells[0]}={planned[1]} {planned[2]}".strip())
                set_ += len(words) - 1
                lines.append("; ".join(words))
            day.write_text("\n".join(lines))
            self.assertGreater(set_, 30, flow)
            self.expect(run("log", device, *few, "--run", self.here / f"{flow}.log", "--wafers", "1", "--entries", day))
            said = json.loads(self.expect(run("log", device, *few, "--run", self.here / f"{flow}.log", "--json")).stdout)
            self.assertEqual(sum(len(s["settings"]) for s in said["steps"]), set_)

    def test_a_coupon_is_of_what_is_there(self):
        """lines in the resist are the printed edge, those of the metal its own; at other steps, and by times that cannot be, none"""
        lines = "; coupon=cd-lines, line, drawn=10 um, value={} um, u=0.05 um; coupon=cd-lines, space, drawn=10 um, value={} um, u=0.05 um"
        resist, metal = lines.format("10.04 10.06 10.02", "9.96 9.98 9.94"), lines.format("7.90 7.92 7.88", "12.10 12.12 12.08")
        at = "{}; start=2026-11-02T{}; end=2026-11-02T{}; by=AB; wafer=1"
        refused = self.expect(self.command("--wafers", "1", "--entry", at.format("S09", "09:00", "09:08") + resist), 3)
        self.assertIn("[FW-D706]", refused.stderr)
        self.assertIn("(litho.edge) from S11 to S13", refused.stderr)
        self.expect(self.command("--wafers", "1", "--entry", at.format("S12", "10:00", "10:08") + resist))
        printed = self.expect(run("calibrate", self.log, "--flow", SILICON))
        self.assertRegex(printed.stdout, r'<q id="litho.edge" value="0.02" ')
        self.assertNotIn("made.al-edge", printed.stdout)
        self.expect(self.command("--entry", at.format("S15", "11:00", "11:07") + metal))
        early = self.expect(self.command("--entry", at.format("S14", "12:00", "12:17")))
        self.assertIn("[FW-D707]", early.stderr)
        left = self.expect(run("calibrate", self.log, "--flow", SILICON, "--all-runs"))
        self.assertIn("[FW-D707]", left.stderr)
        self.assertNotIn("made.al-edge", left.stdout)
        self.expect(self.command("--entry", at.format("S15", "12:20", "12:27") + metal))
        both = self.expect(run("calibrate", self.log, "--flow", SILICON))
        self.assertRegex(both.stdout, r'<q id="made.al-edge" value="0.05" ')
        self.assertRegex(both.stdout, r'<q id="litho.edge" value="0.02" ')

    def test_one_side_alone(self):
        """lines that are gone say nothing to calibrate without those that stand; a mistake of a load is told once"""
        etch = "S18; wafer=1; start=2026-11-02T08:00; end=2026-11-02T10:05; by=AB; second=CD; coupon=undercut-ladder, {}, drawn={} um, at=52 um"
        said = self.expect(self.command("--entry", etch.format("gone", 4), "--wafers", "2"))
        self.assertIn("gone without stands", said.stderr)
        said = self.expect(self.command("--entry", etch.format("stands", 5)))
        self.assertNotIn("without", said.stderr)
        said = self.expect(self.command("--entry", "S02; wafer=1-2; start=2026-11-02T07:00; end=2026-11-02T07:30; by=AB; colour=blue"), 3)
        self.assertEqual(said.stderr.count("measures no 'colour'"), 1)
        said = self.expect(self.command("--entry", "S02; wafer=1; by=AB; scrapped=cracked"), 3)
        self.assertIn("lacks start=, when it was seen", said.stderr)

    def test_a_day_at_once(self):
        day = self.here / "day.txt"
        lines = ["# Monday", ""] + [f"S01; start=2026-11-02T08:{w}0; end=2026-11-02T08:{w}8; by=AB; wafer={w}; instrument=gauge; "
                                    f"thickness=50.1 50.2 50.0 49.9 50.3 um; cracks or chipped edge=0" for w in range(1, 4)]
        day.write_text("\r\n".join(lines))
        self.expect(self.command("--entries", day, "--wafers", "3", "-q"))
        together = self.log.read_bytes()
        self.log = self.here / "one.log"
        for number, line in enumerate(lines[2:]):
            self.expect(self.command("--entry", line, *([] if number else ["--wafers", "3"])))
        self.assertEqual(together, self.log.read_bytes())
        # all or none, and where
        day.write_text("\n".join(lines[2:4] + ["  S02; start=2026-11-02T09:00; end=2026-11-02T09:35; by=AB; colour=red"]))
        said = self.expect(self.command("--entries", day), 3).stderr
        self.assertIn("day.txt:3:3: error", said)
        self.assertEqual(together, self.log.read_bytes())
        day.write_text("# nothing\n")
        self.assertIn("no entry", self.expect(self.command("--entries", day), 3).stderr)
        self.assertIn("use one of them", self.expect(self.command("--entries", day, "--entry", "S01"), 2).stderr)

    def scheduled(self, device, flow, wafers, few):
        """the entries of a lot that was run as its schedule says, in the order of their ends; what the log asks for"""
        out = self.here / f"plan-{flow}"
        self.expect(run("plan", device, *few, "--wafers", wafers, "--operators", 2, "--day", "08:00-18:00 from 2026-11-02", "--advice", "none", "-o", out))
        plan = json.loads((out / f"recipes/{flow}.schedule.json").read_text())
        asked = {s["id"]: s for s in json.loads(self.expect(run("log", device, *few, "--json")).stdout)["steps"]}
        entries = []
        for one in plan["runs"]:
            first, step = one["first_wafer"], asked[one["step"]]
            words = {}
            for m in step["measures"]:
                low, high = (float(m[k]) if m[k] else None for k in ("low", "high"))
                if m["unit"] == "yes/no":
                    words[m["measure"]] = "yes"
                elif low is not None or high is not None:
                    value = high / 2 if low is None else 1.2 * low if high is None else (low + high) / 2
                    words[m["measure"]] = f"{value:g}" + ("" if m["unit"] == "1" else " " + m["unit"])
            for q in step["sets"]:
                if q["planned"] is not None:
                    words["set " + q["name"]] = f"{q['planned']:.10g}" + ("" if q["unit"] == "1" else " " + q["unit"])
            for wafer in range(first, first + one["wafers"]) if first else [None]:
                entries.append({"step": one["step"], "wafer": wafer, "start": one["start_s"], "end": one["end_s"], "words": words})
        return sorted(entries, key=lambda e: (e["end"], e["start"]))

    def logged(self, device, few, wafers, entries, minutes=False):
        """what is said of the entries, with -q, and the log"""
        day, log = self.here / "day.txt", self.here / "day.log"
        for old in (log, self.here / "day.log.head"):
            old.unlink(missing_ok=True)

        def moment(seconds):
            when = datetime.datetime(2026, 11, 2) + datetime.timedelta(seconds=seconds)
            return when.strftime("%Y-%m-%dT%H:%M" if minutes else "%Y-%m-%dT%H:%M:%S")
        day.write_text("".join("; ".join([e["step"], f"start={moment(e['start'])}", f"end={moment(e['end'])}", "by=AB", "second=CD"]
                                         + ([f"wafer={e['wafer']}"] if e["wafer"] else [])
                                         + [f"{k}={v}" for k, v in e["words"].items()]) + "\n" for e in entries))
        said = self.expect(run("log", device, *few, "--run", log, "--wafers", wafers, "--entries", day, "-q")).stderr
        read = json.loads(self.expect(run("log", device, *few, "--run", log, "--json")).stdout)
        return [line for line in said.splitlines() if "day.txt" in line], read

    def test_a_lot_as_it_was_scheduled(self):
        """of it nothing is asked, nothing unclear and nothing out; and whatever went otherwise with one wafer is named, to the quiet too"""
        other = self.here / "six-bar.xml"
        other.write_text(device_for(COPPER))
        lots = ((self.stage, SILICON), (other, COPPER), (GALLERY_STAGE, "silicon-on-glass"))
        for device, flow in lots:
            few = ("--flow", flow, "--corners", "none", "--accuracy", "3e-2")
            entries = self.scheduled(device, flow, 3, few)
            for minutes in (False, True):
                said, read = self.logged(device, few, 3, entries, minutes)
                self.assertEqual([line for line in said if "the entry does not give" not in line], [], flow)
                judged = {e.get("judged") for s in read["steps"] for e in [s, *s.get("others", [])]}
                self.assertLessEqual(judged, {"in window", "no plan"}, flow)
                self.assertEqual((read["deviations"], read["outside"], read["left_out"]), ([], 0, 0), flow)
        few = ("--flow", SILICON, "--corners", "none", "--accuracy", "3e-2")
        entries = self.scheduled(self.stage, SILICON, 3, few)

        def of(lot, step, wafer=2):
            return next(e for e in lot if e["step"] == step and e["wafer"] == wafer)

        def late(lot, step, by, longer=False):
            one = of(lot, step)
            begins = one["end"] if longer else one["start"]
            for e in lot:
                if e["wafer"] == 2 and e["start"] >= begins:
                    e["start"], e["end"] = e["start"] + by, e["end"] + by
            if longer:
                one["end"] += by
        cases = (("an hour late", lambda lot: late(lot, "S22", 3600), r"step S22 of wafer 2 waited 60 min since S21, and allowed is 0 s to 10 min",
                  ("S22", "2", "wait since S21")),
                 ("over night in its etchant", lambda lot: late(lot, "S14", 15 * 3600, True),
                  r"step S14 of wafer 2 went otherwise than planned: it took 15 h 23 min.*by its law that makes at least 5\d\.\d um \(planned 1 um\), "
                  r"and as much sideways from every edge", ("S14", "2", "duration")),
                 ("another pressure", lambda lot: of(lot, "S18")["words"].update({"set pressure": "12 Pa"}),
                  r"step S18 of wafer 2: pressure = 90\.01 mTorr \(written 12 Pa\), the step allows 78 to 82 mTorr", ("S18", "2", "setting pressure")),
                 ("wrong order", lambda lot: of(lot, "S21").update(start=of(lot, "S22")["end"], end=of(lot, "S22")["end"] + 1500),
                  r"step S22 of wafer 2 began .* before S21 ended", ("S22", "2", "wait since S21")),
                 ("wrong wafer", lambda lot: of(lot, "S14", 1).update(wafer=2), r"step S14, which comes before it, is not in the log", ("S14", "2", "duration")))
        for name, change, words, deviation in cases:
            lot = [dict(e, words=dict(e["words"])) for e in entries]
            change(lot)
            said, read = self.logged(self.stage, few, 3, sorted(lot, key=lambda e: (e["end"], e["start"])))
            self.assertRegex("\n".join(said), words, name)
            self.assertIn(deviation, [(d["step"], d["wafer"], d["what"]) for d in read["deviations"]], name)
        lot = [e for e in entries if (e["step"], e["wafer"]) != ("S13", 2)]
        said, read = self.logged(self.stage, few, 3, lot)
        self.assertRegex("\n".join(said), "step S13, which comes before it, is not in the log")
        self.assertEqual([(s["id"], s["left_out"]) for s in read["steps"] if s["left_out"]], [("S13", ["2"])])
        self.assertEqual(read["left_out"], 1)

    def test_what_went_otherwise_is_said_at_once(self):
        """how long a step took when it is entered, and what was done otherwise when its readings become the laboratory's values"""
        usual = self.expect(self.etch(1, "--lot", "L7", "--wafers", "3")).stderr
        self.assertNotIn("otherwise than planned", usual)
        late = self.expect(self.etch(2, end="14:35", words="; deviation=pump, left over lunch")).stderr
        self.assertIn("step S18 of wafer 2 went otherwise than planned: it took 6 h 35 min, and is to stop by ", late)
        self.assertNotIn("write down why", late)
        self.expect(self.etch(3, power="262 W"))
        lost = self.expect(self.command("--entry", "S18; start=2026-11-03T12:10; by=AB; scrapped=cracked in the chuck", "--wafer", "3")).stderr
        self.assertNotIn("otherwise than planned", lost)  # what became of a wafer took no time
        said = self.expect(run("calibrate", self.log, "--flow", SILICON, "-o", self.here / "lab.xml")).stderr
        told = [line for line in said.splitlines() if "FW-D652" in line]
        self.assertEqual(len(told), 2, said)
        self.assertIn("written down: pump, left over lunch", told[0])
        self.assertIn("power was 262 W", told[1])

    def test_what_is_not_accepted_is_said_at_once(self):
        """a value outside of what its step accepts, and every step that was passed over, when the entry is made"""
        said = self.expect(self.command("--entry", "S01; start=2026-11-02T08:00; end=2026-11-02T08:08; by=AB; thickness=30.0 30.1 30.0 30.2 30.0 um; "
                                        "cracks or chipped edge=3", "--wafer", "1", "--wafers", "1")).stderr
        self.assertIn("thickness = 30.0 30.1 30.0 30.2 30.0 um, accepted is 48 to 52 um", said)
        self.assertEqual(said.count("FW-D736"), 2, said)
        said = self.expect(self.command("--entry", "S05; start=2026-11-02T09:00; end=2026-11-02T09:20; by=AB", "--wafer", "1")).stderr
        self.assertIn("3 steps that come before it are not in the log, S02 to S04", said)
        self.assertNotIn("FW-D736", said)
        said = self.expect(self.command("--entry", "S08; start=2026-11-02T10:00; end=2026-11-02T10:02; by=AB", "--setting", "temperature=160 Cel",
                                        "--wafer", "1")).stderr
        self.assertIn("temperature = 160 Cel, the step allows", said)

    def test_a_lot(self):
        self.lot()
        page = self.here / "report.html"
        done = json.loads(self.expect(self.command("--report", page, "--json")).stdout)
        self.assertEqual(done["wafers"], list("123456"))
        self.assertEqual([(d["step"], d["wafer"], d["what"]) for d in done["deviations"]],
                         [("S18", "3", "setting power")])
        step = next(s for s in done["steps"] if s["id"] == "S18")
        self.assertEqual(step["times"], 6)
        self.assertEqual(len(step["others"]), 5)
        self.assertEqual(sorted(step["measured"][0]["sites"]), ["bottom", "centre", "left", "right", "top"])
        text = page.read_text()
        tree.fromstring(text[text.index("<svg"):text.index("</svg>") + 6])
        self.assertIn("262", text)
        # log -> laboratory pack -> plan
        lab = self.here / "lab.xml"
        self.expect(run("calibrate", self.log, "--flow", SILICON, "-o", lab))
        root = tree.parse(lab).getroot()
        values = {q.get("id"): q for q in root.iter(SPACE + "q")}
        sources = {s.get("id"): s for s in root.iter(SPACE + "source")}
        self.assertEqual(set(values), {"rie.R", "rie.S"})
        for identity, truth, most in (("rie.R", 0.545, 0.03), ("rie.S", 0.09, 0.03)):
            q = values[identity]
            self.assertEqual(q.get("status"), "measured")
            self.assertLess(abs(float(q.get("value")) - truth), 2.5 * float(q.get("u")))
            self.assertLess(float(q.get("u")), most)
            source = sources[q.get("src")]
            self.assertEqual(source.get("date"), "2026-11-06")
            for words in ("wafers 1, 2, 3, 4, 5, 6", "n = 150 readings", "step S18", "2026-11-01 to 2026-11-06",
                          "lot L7", "lot.log"):
                self.assertIn(words, source.text)
        rows = [[float(v) for v in r.get("values").split()] for r in root.iter(SPACE + "row")]
        self.assertEqual(rows[0][1], rows[1][0])
        self.expect(run("plan", self.stage, "--flow", SILICON, "--lab", lab, "-o", self.here / "out", "-q"))
        recipe = json.loads((self.here / "out/recipes" / f"{SILICON}.json").read_text())
        self.assertEqual({o["id"] for o in recipe["overrides"]}, {"rie.R", "rie.S"})
        # the same log gives the same bytes
        self.expect(run("calibrate", self.log, "--flow", SILICON, "-o", self.here / "again.xml"))
        self.assertEqual(lab.read_bytes(), (self.here / "again.xml").read_bytes())

    LINES = ("; coupon=cd-lines, line, drawn=6 um, value={0:.2f} {1:.2f} {2:.2f} um, u=0.03 um; "
             "coupon=cd-lines, space, drawn=6 um, value={3:.2f} {4:.2f} {5:.2f} um, u=0.03 um")

    def etched(self, wafer, taken, minutes, more="", before=""):
        """lines whose edges lost so much, um, of a wafer that was etched so long"""
        lines = [6 - 2 * taken + off for off in (0, 0.02, -0.02)] + [6 + 2 * taken + off for off in (0, -0.01, 0.02)]
        return (f"{before}S14; start=2026-11-03T0{wafer}:00; end=2026-11-03T0{wafer}:{minutes}; by=AB; wafer={wafer}; second=CD{more}\n"
                f"S15; start=2026-11-03T1{wafer}:00; end=2026-11-03T1{wafer}:07; by=AB; wafer={wafer}" + self.LINES.format(*lines) + "\n")

    def value_of(self, pack, identity):
        return next(q for q in tree.parse(pack).getroot().iter(SPACE + "q") if q.get("id") == identity)

    def test_a_reading_is_of_the_plan_of_its_wafer(self):
        """edges are what is left beyond what was planned then: with other values of now they would be false by the difference"""
        over, entries, lab = self.here / "over.xml", self.here / "day.txt", self.here / "lab.xml"
        over.write_text(f'<process xmlns="{SPACE[1:-1]}" id="t" version="1" title="t" flow="{SILICON}"><source id="lab" kind="measured">x'
                        '</source><q id="al.overetch" value="0.5" u="0" unit="1" status="measured" src="lab"/></process>')
        entries.write_text("".join(self.etched(w, 1.5, 27) for w in (1, 2, 3)))
        self.expect(self.command("--lab", over, "--lot", "M", "--wafers", "4", "--entries", entries))
        self.expect(self.command("--entry", "plan; start=2026-11-04T08:00; by=AB; note=over-etch back to 10 %"))
        none = self.expect(run("calibrate", self.log, "--flow", SILICON, "--all-runs", "-o", lab), 3).stderr
        self.assertEqual(none.count("[FW-D735]"), 3, none)
        self.assertIn("step S14 (line 2, 2026-11-03T01:00) was planned with 25 min, and with the values that are used here it would be "
                      "18 min 20 s", none)
        self.assertFalse(lab.exists())
        # the wafer of the plan of now counts alone, and those of the former one with its packs
        entries.write_text(self.etched(4, 1.1, 20))
        self.expect(self.command("--entries", entries))
        one = self.expect(run("calibrate", self.log, "--flow", SILICON, "-o", lab)).stderr
        self.assertEqual(one.count("[FW-D735]"), 3, one)
        self.assertLess(abs(float(self.value_of(lab, "made.al-edge").get("value"))), 0.02)
        self.assertGreater(float(self.value_of(lab, "made.al-edge").get("spread")), 0.1)
        then = self.expect(run("calibrate", self.log, "--flow", SILICON, "--lab", over, "-o", lab)).stderr
        self.assertEqual(re.findall(r"of wafer (\d) do not count", then), ["4"])
        self.assertLess(abs(float(self.value_of(lab, "made.al-edge").get("value"))), 0.02)
        self.assertIsNone(self.value_of(lab, "made.al-edge").get("spread"))

    def test_one_wafer_says_nothing_of_the_next(self):
        """by its log or by a table; what check says of such a pack, and that the band keeps what the flow had"""
        entries, lab = self.here / "day.txt", self.here / "lab.xml"
        entries.write_text(self.etched(1, 1.1, 20))
        self.expect(self.command("--wafers", "1", "--entries", entries))
        (self.here / "lot.csv").write_text("coupon,feature,drawn_um,measured,u,unit,at,u_at,at_unit\ncd-lines,line,6,3.80,0.03,um,,,\n"
                                           "cd-lines,space,6,8.19,0.03,um,,,\n")
        for source, who in ((self.log, "of one wafer"), (self.here / "lot.csv", "a table has no wafers")):
            said = self.expect(run("calibrate", source, "--flow", SILICON, "-o", lab)).stdout
            self.assertIn(f"{who}: how the next one differs is taken to be what the flow had for it, +- 0.14 um", said)
            self.assertGreater(float(self.value_of(lab, "made.al-edge").get("u")), 0.14)
            told = self.expect(run("check", self.stage, "--flow", SILICON, "--lab", lab, "--advice", "none", "--accuracy", "3e-2")).stderr
            self.assertIn("nobody has measured how wafers differ in made.al-edge (taken to be +- 0.14 um)", told)

    def test_what_went_otherwise_before_a_reading(self):
        """the layer that was not accepted, a deviation of an earlier step, and an etch that is not in the log"""
        entries = self.here / "day.txt"
        thin = "S03; start=2026-11-02T08:20; end=2026-11-02T08:50; by=AB; wafer=1; step height on the witness chip=0.6 0.6 0.6 0.61 0.6 um\n"
        for number, (words, says, status) in enumerate((
                (self.etched(1, 1.1, 20, before=thin), "step height on the witness chip of step S03 (line 2) was not accepted, 0.6 0.6 0.6 "
                                                       "0.61 0.6 um; --all-runs counts all [FW-D693]", 3),
                (self.etched(1, 1.1, 20, more="; deviation=acid of yesterday"), "S14 (line 2): written down: acid of yesterday; it counts "
                                                                                "like any other", 0),
                (self.etched(1, 1.1, 20).split("\n")[1], "count: step S14 is not in the log of its wafer", 0),
                (self.etched(1, 1.1, 20), None, 0))):
            self.log = self.here / f"{number}.log"
            entries.write_text(words)
            self.expect(self.command("--wafers", "1", "--entries", entries))
            said = self.expect(run("calibrate", self.log, "--flow", SILICON, "-o", self.here / "lab.xml"), status).stderr
            if says:
                self.assertIn(says, said)
            else:
                self.assertEqual(re.findall(r"FW-D(?:652|693|735)", said), [])
            if status:
                self.expect(run("calibrate", self.log, "--flow", SILICON, "--all-runs", "-o", self.here / "lab.xml"))

    def test_refused(self):
        self.expect(self.etch(1, "--lot", "L7", "--wafers", "2"))
        whole = self.log.read_text()
        entry = "S18; start=2026-11-02T08:00; end=2026-11-02T10:05; by=AB; second=CD"
        for more, says in ((("--wafer", "3"), "there are: 1, 2"),
                           (("--setting", "pover=250 W"), "did you mean 'power'"),
                           (("--setting", "power=250 V"), "is given in W"),
                           (("--setting", "power=-1 W"), "plausible range"),
                           (("--site", "aluminium left=1 2 um"), "measured at 5 sites"),
                           (("--coupon", "arde-slot, drawn=10 um, value=45 um, u=1 um, at=90 min"), "did you mean"),
                           (("--wafers", "3"), "has begun")):
            said = self.expect(self.command("--entry", entry, *more), 3).stderr
            self.assertIn(says, said)
        said = self.expect(self.command("--entry", entry.replace("2026-11-02T10:05", "2126-11-02T10:05")), 3).stderr
        self.assertIn("in the future", said)
        self.assertEqual(self.log.read_text(), whole)
        self.expect(self.command("--wafer", "1"), 2)
        self.expect(self.command("--entry", entry, "--report", "x.html"), 2)
        # a line that is taken off, or changed, is seen by calibrate as by log
        self.expect(self.etch(2))
        both = self.log.read_text()
        self.log.write_text(whole)
        for result in (run("calibrate", self.log, "--flow", SILICON), self.command()):
            self.assertIn("removed at its end", self.expect(result, 3).stderr)
        self.log.write_text(both.replace("drawn=10 um", "drawn=11 um"))
        self.assertIn("FW-D280", self.expect(run("calibrate", self.log, "--flow", SILICON), 3).stderr)
        self.log.write_text(both)
        self.assertIn("FW-D281", self.expect(run("calibrate", self.log, "--flow", COPPER), 3).stderr)

    def test_out_of_range(self):
        """a rate that no etch has is refused, with the reason, and nothing is written"""
        words = "S14; start=2026-11-01T08:00; end=2026-11-01T08:25; by=AB; second=CD"
        self.expect(self.command("--entry", words, "--wafers", "1", "--wafer", "1", "--coupon",
                                 "etch-rate, pan.R, value=900 901 899 900 902 um, at=15 min"))
        said = self.expect(run("calibrate", self.log, "--flow", SILICON, "-o", self.here / "lab.xml"), 3).stderr
        self.assertIn("FW-D278", said)
        self.assertIn("wafer 1", said)
        self.assertFalse((self.here / "lab.xml").exists())

    def test_wafers_that_differ_beyond_sense(self):
        """two wafers of which one was etched twice: what is refused says which wafers and by how much, and nothing is written"""
        for wafer, read in (("1", "700 701 699 700 702"), ("2", "1100 1101 1099 1100 1102")):
            words = f"S14; start=2026-11-01T08:0{wafer}; end=2026-11-01T08:2{wafer}; by=AB; second=CD"
            begun = ("--wafers", "2") if wafer == "1" else ()
            self.expect(self.command("--entry", words, *begun, "--wafer", wafer, "--coupon", f"etch-rate, pan.R, value={read} nm, at=15 min"))
        said = self.expect(run("calibrate", self.log, "--flow", SILICON, "-o", self.here / "lab.xml"), 3).stderr
        self.assertIn("[FW-D530]", said)
        self.assertRegex(said, r"'pan\.R'.* of wafers 1, 2: .*mean of 2 wafers, which differ by 31 % .*measure more wafers")
        self.assertFalse((self.here / "lab.xml").exists())

    def test_corners(self):
        """an edge and an anisotropy that are read off the same lines: one is high where the other is low"""
        (self.here / "lot.csv").write_text("""coupon,feature,drawn_um,measured,u,unit,at,u_at,at_unit
cd-lines,line,10,7.9,0.2,um,,,
cd-lines,space,10,12.05,0.2,um,,,
undercut-ladder,width,16,13.10,0.08,um,50.5,0.3,um
undercut-ladder,width,20,17.06,0.08,um,50.5,0.3,um
""")
        lab, alone, own = self.here / "lab.xml", self.here / "alone.xml", self.here / "own.xml"
        # how wafers differ a table does not say, and what is taken for that is of each value alone: of a laboratory that knows it, little
        stated = '<q id="{}" value="{}" u="{}" spread="{}" unit="{}" status="assumed" src="lab"/>'
        own.write_text(f"""<process xmlns="{SPACE[1:-1]}" id="own" version="1" title="own" flow="{SILICON}"><source id="lab" kind="measured">x</source>
{stated.format("made.al-edge", 0, 0.1, 0.01, "um")}{stated.format("litho.edge", 0, 0.001, 0.001, "um")}{stated.format("rie.A", 0.99, 0.003, 0.0002, 1)}</process>""")
        self.expect(run("calibrate", self.here / "lot.csv", "--flow", SILICON, "--lab", own, "-o", lab))
        text = lab.read_text()
        start, end = text.index("  <correlation"), text.index("</correlation>") + len("</correlation>\n")
        alone.write_text(text[:start] + text[end:])
        used = []
        for pack in (lab, alone):
            verdict = json.loads(self.expect(run("check", self.stage, "--lab", pack, "--json")).stdout)
            used.append(verdict["governing"]["utilisation"])
        self.assertLess(used[0], 0.95 * used[1])
        # a matrix that cannot be is refused at its line
        lab.write_text(text.replace('values="1 -', 'values="1 -1'))
        self.assertRegex(self.expect(run("check", self.stage, "--lab", lab), 3).stderr, r"lab\.xml:\d+:\d+: error: ")

    def test_lines_that_are_gone_are_found(self):
        """the last ones, one between, all, half of one, and the head itself; by log and calibrate, also with -q"""
        for wafer in (1, 2):
            first = ("--lot", "L7", "--wafers", "2") if wafer == 1 else ()
            for entry in (f"S01; start=2026-11-02T08:0{wafer}; end=2026-11-02T08:1{wafer}; by=AB; thickness=50.1 um; "
                          "cracks or chipped edge=0", f"S02; start=2026-11-02T09:0{wafer}; end=2026-11-02T09:3{wafer}; by=AB; "
                          "particles in bright light=0"):
                self.expect(self.command("--entry", entry, "--wafer", wafer, *first, "-q"))
                first = ()
        whole, head = self.log.read_bytes(), pathlib.Path(f"{self.log}.head")
        kept, lines = head.read_bytes(), whole.splitlines(keepends=True)
        self.assertEqual(len(lines), 5)
        readers = (lambda: self.command("-q"), lambda: run("calibrate", self.log, "--flow", SILICON, "-q"),
                   lambda: self.command("--entry", "S02; start=2026-11-03T09:00; end=2026-11-03T09:30; by=AB; "
                                        "particles in bright light=0", "--wafer", "1", "-q"))
        cases = {"the last": (lines[:-1], kept, "3 entries, but its head says 4"), "two": (lines[:-2], kept, "2 entries, but its head says 4"),
                 "all": (lines[:1], kept, "0 entries, but its head says 4"), "half": ([whole[:-40]], kept, "its last line is not complete"),
                 "the middle": (lines[:2] + lines[3:], kept, "this line, or one before it, was changed, removed or moved"),
                 "the head's text": (lines, b"", "the head of the log is damaged")}
        for name, (text, beside, says) in cases.items():
            for k, reader in enumerate(readers):
                self.log.write_bytes(b"".join(text))
                head.write_bytes(beside)
                self.assertIn(says, self.expect(reader(), 3).stderr, (name, k))
                self.assertEqual(self.log.read_bytes(), b"".join(text), (name, k))
        for k, reader in enumerate(readers):  # without its head nothing shows what was removed
            self.log.write_bytes(b"".join(lines[:-1]))
            head.unlink(missing_ok=True)
            self.assertIn("log.head, which is kept beside this log", self.expect(reader(), 3).stderr, k)
            self.assertEqual((self.log.read_bytes(), head.exists()), (b"".join(lines[:-1]), False), k)
        for left, status in ((kept.replace(b"=4", b"=0"), 0), (kept, 3)):  # a beginning that was interrupted; a log that is gone
            self.log.unlink(missing_ok=True)
            head.write_bytes(left)
            self.expect(self.command("--entry", "S01; start=2026-11-02T08:01; end=2026-11-02T08:11; by=AB; thickness=50.1 um; "
                                     "cracks or chipped edge=0", "-q"), status)

    def unmark_head(self):
        """the log as it was written before there were heads"""
        before, lines = "", []
        for line in self.log.read_text().splitlines():
            words = line[:line.rindex("\tchain=")].replace("\thead=kept", "")
            before = hashlib.sha256(f"{before}\n{words}".encode()).hexdigest()
            lines.append(f"{words}\tchain={before}\n")
        self.log.write_text("".join(lines))
        pathlib.Path(f"{self.log}.head").unlink()

    def test_an_old_log(self):
        """one of before there were wafers is read, and goes on"""
        self.expect(self.command("--entry", "S01; start=2026-11-01T08:00; end=2026-11-01T08:08; by=AB; thickness=50.1"))
        self.assertNotIn("wafers=", self.log.read_text())
        self.unmark_head()  # nor a head: it is read, and whoever reads it is told
        self.assertIn("whether lines were removed at the end of the log cannot be told [FW-D283]",
                      self.expect(self.command("-q")).stderr)
        self.expect(self.command())
        said = self.expect(run("calibrate", self.log, "--flow", SILICON), 3).stderr
        self.assertIn("holds no coupon", said)


if __name__ == "__main__":
    unittest.main()
