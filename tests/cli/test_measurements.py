#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a measurement is said to be worth is what a laboratory pack with it then gives: the same band, the same decision, the
same windows, to the last digit. And what is said of it, where, and when."""
import html
import json
import pathlib
import re
import tempfile
import unittest

from common import ALL, GALLERY, ROOT, device_for, only_all, run

COMB = ROOT / "docs/gallery/comb-stage/device.xml"
LAB = """<?xml version="1.0"?>
<process xmlns="urn:flexwright:process:1" id="lab" version="1" title="as measured" flow="{flow}">
  <source id="read" kind="measured">read</source>
  <q id="{id}" value="{value!r}" u="{u!r}" unit="{unit}" status="measured" src="read"/>
</process>
"""


def undecided(here):
    """the reference with a third more load: accepted as drawn, undecided as made"""
    text = GALLERY.read_text().replace('fx="0.25 mN" fy="-0.14 mN"', 'fx="0.33 mN" fy="-0.17 mN"')
    device = pathlib.Path(here) / "undecided.xml"
    device.write_text(text)
    return device


class Measurements(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        here = tempfile.TemporaryDirectory()
        cls.addClassCleanup(here.cleanup)
        cls.here = pathlib.Path(here.name)
        cls.device = undecided(here.name)
        cls.base = cls.flows("--measurements", "all")

    @classmethod
    def check(cls, device, *arguments):
        result = run("check", device, "--json", "--advice", "none", *arguments)
        assert result.stdout, result.stderr
        return json.loads(result.stdout)

    @classmethod
    def flows(cls, *arguments):
        return {f["id"]: f for f in cls.check(cls.device, *arguments)["flows"]}

    def lab(self, flow, item):
        pack = self.here / "lab.xml"
        pack.write_text(LAB.format(flow=flow, id=item["id"], value=item["value"], u=item["u_measured"],
                                   unit=item["unit"]))
        return pack

    def try_one(self, device, flow, said, item):
        """the long way: measured, put into a laboratory pack, and the device judged and its flow computed once more"""
        lab = ("--lab", self.lab(flow, item))
        then = {f["id"]: f for f in self.check(device, *lab, "--measurements", "all")["flows"]}[flow]
        got = then["measurements"]
        self.assertEqual(got["verdict"], item["verdict"], item["id"])
        self.assertEqual(got["of"], item["governs"], item["id"])
        self.assertEqual(got["band"], item["governing_band"], item["id"])
        self.assertEqual(got["band"][1], item["most"], item["id"])
        low = got["band"][0]
        if got["of"] == said["of"]:
            self.assertEqual(got["band"], item["band"], item["id"])
        else:  # no device uses less than what governed before still does
            low = max(low, item["band"][0])
        before, after = said["band"][1] - said["band"][0], got["band"][1] - low
        self.assertAlmostEqual(item["narrowing"], before - after, delta=1e-12)
        self.assertEqual(then["as_fabricated"]["verdict"], item["verdict"], item["id"])

    @only_all
    def test_a_laboratory_pack_gives_what_was_said(self):
        tried = exact = 0
        for flow, of in self.base.items():
            said = of["measurements"]
            self.assertIsNotNone(said["band"][1])
            for item in said["ranked"][::1 if ALL else 3]:
                if item["id"] is None or item["value"] is None:
                    continue  # of the material, or nobody knows what it will be
                if item["band"] == said["band"] and not item["windows"]:
                    continue
                self.try_one(self.device, flow, said, item)
                tried += 1
                exact += item["u_measured"] == 0.0
        self.assertGreater(tried, 8 if ALL else 2)
        self.assertGreater(exact, 2 if ALL else 0)  # as if its uncertainty were set to zero

    def test_what_governs_then(self):
        """of every flow those inputs after whose measurement another hinge governs; with them a few others, or all"""
        others = 0
        for flow in ("copper-on-porous-silicon", "soi-deep-rie", "soi-double-sided", "silicon-on-glass"):
            device = self.here / f"{flow}.xml"
            device.write_text(device_for(flow) if flow != "silicon-on-glass" else COMB.read_text())
            said = {f["id"]: f for f in self.check(device, "--measurements", "all")["flows"]}[flow]["measurements"]
            for number, item in enumerate(said["ranked"]):
                if item["id"] is None or item["value"] is None or item["verdict"] is None:
                    continue
                another = item["governs"] != said["of"]
                if another or ALL or (number == 1 and item["band"] != said["band"]):
                    self.try_one(device, flow, said, item)
                    others += another
        self.assertGreater(others, 3)

    def test_windows_are_the_recipe_s(self):
        flows = ["al-masked-rie"]
        if ALL:
            flows += ["copper-on-porous-silicon", "soi-deep-rie", "soi-double-sided", "silicon-on-glass"]
        for flow in flows:
            device = self.device
            if flow != "al-masked-rie":
                device = self.here / f"w-{flow}.xml"
                device.write_text(device_for(flow) if flow != "silicon-on-glass" else COMB.read_text())
            said = {f["id"]: f for f in self.check(device, "--measurements", "all")["flows"]}[flow]["measurements"]
            tried = 0
            for item in said["ranked"]:
                if not item["windows"] or item["value"] is None:
                    continue
                result = run("recipe", device, "--flow", flow, "--json", "--advice", "none",
                             "--measurements", "none", "--lab", self.lab(flow, item))
                steps = {s["id"]: s["time_s"] for s in json.loads(result.stdout)["steps"]}
                tried += 1
                for w in item["windows"]:
                    if w["after_s"]:
                        self.assertAlmostEqual(steps[w["step"]]["first_look"], w["after_s"][0],
                                               delta=1e-9 * w["after_s"][0], msg=item["id"])
                        self.assertAlmostEqual(steps[w["step"]]["clear_by"], w["after_s"][1],
                                               delta=1e-9 * w["after_s"][1], msg=item["id"])
            self.assertGreater(tried, 1, flow)

    def test_rank_and_reader(self):
        ranked = self.base["al-masked-rie"]["measurements"]["ranked"]
        first = ranked[0]
        self.assertEqual(first["id"], "made.al-edge")  # the printed edge is within what cd-lines reads of it
        self.assertEqual(first["read_by"], "coupon cd-lines")
        anisotropy = next(x for x in ranked if x["id"] == "rie.A")
        self.assertEqual(anisotropy["read_by"], "coupon undercut-ladder, with cd-lines")
        self.assertFalse(anisotropy["known"])
        self.assertTrue(first["decides"])
        order = [(not x["decides"], -x["narrowing"]) for x in ranked]
        self.assertEqual(order, sorted(order))
        by = {x["id"] or x["name"]: x["read_by"] for x in ranked}
        self.assertEqual(by["si.d"], "thickness gauge, mean of five sites (S01)")
        self.assertIsNone(by["litho.edge"])  # of this flow cd-lines reads the aluminium's edge
        unknown = {x["id"]: x["needed_for"] for x in ranked if x["value"] is None}
        self.assertEqual(unknown["al.R"], "S03 (with power (al.power))")
        self.assertIn("activation energy (pan.Ea)", self.base["al-masked-rie"]["measurements"]["no_effect"])
        copper = {x["id"] or x["name"]: x for x in self.base["copper-on-porous-silicon"]["measurements"]["ranked"]}
        self.assertIsNone(copper["Young's modulus"]["read_by"])
        self.assertIsNone(copper["made.wall"]["read_by"])
        self.assertEqual(copper["litho.edge"]["read_by"], "coupon cd-lines")

    def test_a_thickness_that_the_description_states_is_what_is_measured(self):
        """and not the pack's own, which is a tenth less"""
        # the copper is a share of whatever is stated
        for flow, of, stated, value, u in (("al-masked-rie", "si.d", 55, 55, 0.55), ("copper-on-porous-silicon", "made.cu", 10, 1, 0.1 / 3**0.5)):
            flows = {f["id"]: f for f in self.check(GALLERY, "--flow", flow, "--set", f"flow[{flow}]/@thickness={stated} um",
                                                    "--measurements", "all")["flows"]}
            item = next(r for r in flows[flow]["measurements"]["ranked"] if r["id"] == of)
            self.assertAlmostEqual(item["value"], value, places=9)
            self.assertAlmostEqual(item["u"], u, places=6)
            self.assertEqual(item["unit"], "um" if value == stated else "1")

    def test_terminal(self):
        result = run("check", self.device, "-q")  # where it is undecided, even in few words
        self.assertEqual(result.returncode, 4)
        line = [x for x in result.stdout.splitlines() if "Measure" in x]
        first = self.base["al-masked-rie"]["measurements"]["first"]
        self.assertEqual(line, [f"al-masked-rie: {first}"])
        self.assertRegex(first, r"^Measure the edge of the aluminium first \(made\.al-edge; coupon cd-lines\): the "
                                r"band of hinge A goes from [\d.]+\.\.[\d.]+ % to [\d.]+\.\.[\d.]+ %.*accepted\.$")
        self.assertNotIn("Measure the", run("check", self.device, "--measurements", "none").stdout)
        self.assertNotIn("an input that is measured alone leaves", result.stdout)
        self.assertNotIn("Measure the", run("check", GALLERY).stdout)  # accepted
        ranked = run("check", GALLERY, "--measurements", "all", "--flow", "al-masked-rie", "--advice", "none").stdout.splitlines()
        at = next(i for i, x in enumerate(ranked) if "an input that is measured alone leaves" in x)
        self.assertRegex(ranked[at], r"^  of the band of hinge A, [\d.]+\.\.[\d.]+ %, ")
        self.assertRegex(ranked[at + 1], r"^  1  edge of the aluminium \(coupon cd-lines\): [\d.]+\.\.[\d.]+ %")

    def test_what_is_asked_for(self):
        def asked(*arguments):
            return [f["measurements"] for f in self.check(GALLERY, *arguments)["flows"]]

        self.assertEqual(asked(), [None, None])
        self.assertEqual(asked("--measurements", "none"), [None, None])
        self.assertTrue(all("band" in m for m in asked("--measurements", "all")))
        refused = run("check", GALLERY, "--measurements", "some")
        self.assertEqual(refused.returncode, 2)
        self.assertIn("needs auto, all or none", refused.stderr)

    def test_sheet_and_report(self):
        out = self.here / "comb"
        self.assertEqual(run("plan", COMB, "-o", out, "-q").returncode, 0)
        flow = json.loads((out / "verdict.json").read_text())["flows"][0]
        self.assertIsNone(flow["measurements"])  # accepted: no bands
        said = json.loads((out / f"recipes/{flow['id']}.measurements.json").read_text())["measurements"]
        self.assertNotIn("band", said)  # to first order, at the cost of the laws alone
        self.assertEqual(said["devices"], 0)
        self.assertNotIn("measurements", json.loads((out / f"recipes/{flow['id']}.json").read_text()))
        sheet = html.unescape((out / f"recipes/{flow['id']}.html").read_text())
        table = sheet[sheet.index("What to measure first"):sheet.index("Steps and times")]
        self.assertEqual(len(re.findall("<tr><td", table)), 5)
        report = html.unescape((out / "report.html").read_text())
        section = report[report.index('<section id="measurements"'):]
        section = section[:section.index("</section>")]
        self.assertEqual(len(re.findall("<tr><td", section)), len(said["ranked"]))
        for item in said["ranked"][:5]:
            self.assertIn(item["id"] or item["name"], table)
            self.assertIn(item["id"] or item["name"], section)


LEVER = """<?xml version="1.0" encoding="UTF-8"?>
<device xmlns="urn:flexwright:device:1" name="lever">
  <material ref="silicon-100" thickness="30 um"/>
  <limits safety-factor="2"/>
  <flow ref="soi-deep-rie"/>
  <flexure id="leaf" kind="leaf" length="400 um" width="8 um"/>
  <mechanism>
    <body id="arm" x="0 mm" y="0.6 mm" width="120 um" plate-width="0.5 mm" plate-height="0.4 mm"/>
    <revolute id="A" a="ground" b="arm" b-y="-0.6 mm" hinge="leaf" axis="0 deg"/>
  </mechanism>
  <scene name="bend" duration="40 ms">
    <torque on="arm" value="60 nJ" law="ramp" rise="20 ms"/>
    <material-damping loss-factor="0.05"/>
  </scene>
  <die title="LEVER" release-pitch="40 um" clearance="200 um"/>
</device>
"""
KNOWN = {"litho.edge": ('value="-0.3" u="0.05"', "um"), "drie.A": ('value="0.985" u="0.001"', "1"),
         "drie.S": ('value="0.05" u="0.005"', "1"), "soi.d": ('value="30" u="0.25"', "um")}
NAMES = {"litho.edge": "printed edge", "drie.A": "anisotropy", "drie.S": "lag of narrow openings",
         "soi.d": "thickness"}


class Unknown(unittest.TestCase):
    """who knows less accepts no more: what nobody knows, and nothing is assumed of, leaves the verdict open"""

    def packs(self, here, unknown):
        lab = pathlib.Path(here) / "lab.xml"
        device = pathlib.Path(here) / "lever.xml"
        device.write_text(LEVER)
        lab.write_text('<process xmlns="urn:flexwright:process:1" flow="soi-deep-rie">\n'
                       '<source id="m" kind="measured" date="2026-01-01">read</source>\n' + "".join(
                           f'<q id="{id}" unknown="true" unit="{unit}" status="assumed" src="m"/>\n' if id == unknown
                           else f'<q id="{id}" {value} unit="{unit}" status="measured" src="m"/>\n'
                           for id, (value, unit) in KNOWN.items()) + "</process>\n")
        return device, lab

    def check(self, here, unknown):
        device, lab = self.packs(here, unknown)
        result = run("check", device, "--lab", lab, "--json", "--measurements", "all")
        return result.returncode, json.loads(result.stdout)

    def test_what_nobody_knows_accepts_nothing(self):
        with tempfile.TemporaryDirectory() as here:
            status, said = self.check(here, None)
            self.assertEqual((status, said["verdict"]), (0, "accept"))
            for id, name in NAMES.items():
                with self.subTest(id):
                    status, said = self.check(here, id)
                    self.assertEqual((status, said["verdict"], said["drawn"]), (4, "inconclusive", "accept"))
                    flow = said["flows"][0]
                    made = flow["as_fabricated"]
                    self.assertEqual(made["verdict"], "inconclusive")
                    self.assertTrue(f"{name} ({id})" in made["reason"], made["reason"])
                    one = [i for i in made["inputs"] if i["not_known"]]
                    self.assertEqual([(i["name"], i["not_known"], i["low"], i["high"]) for i in one],
                                     [(name, id, None, None)])
                    worth = flow["measurements"]
                    self.assertEqual((worth["ranked"][0]["id"], worth["ranked"][0]["name"]), (id, name))
                    self.assertIn(f"Measure the {name} first ({id}", worth["first"])
                    self.assertNotIn(id, worth["no_effect"])

    def test_no_yield_is_told_of_it(self):
        """devices would be drawn without what nobody knows: 100 % of 128 were accepted"""
        with tempfile.TemporaryDirectory() as here:
            device, lab = self.packs(here, "litho.edge")
            device.write_text(LEVER.replace("</device>", '<study name="survive" kind="yield" samples="200">'
                                            '<uncertain what="flexure[leaf]/@width" mean="8 um" sd="0.02 um"/>'
                                            "</study></device>"))
            result = run("study", device, "--lab", lab, "-o", pathlib.Path(here) / "out")
            self.assertEqual(result.returncode, 3, result.stdout)
            self.assertIn("printed edge (litho.edge)", result.stderr)
            self.assertIn("FW-D695", result.stderr)


if __name__ == "__main__":
    unittest.main()
