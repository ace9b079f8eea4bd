#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The sections of a whole device against its mask's certificate, read from the files as anybody would."""
import html
import itertools
import json
import pathlib
import random
import re
import shutil
import tempfile
import unittest
import xml.etree.ElementTree as ET

from common import ALL, FLOWS, GALLERY, ROOT, device_for, run

SVG = "{http://www.w3.org/2000/svg}"


class Sections(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.here = pathlib.Path(tempfile.mkdtemp())
        done = run("plan", GALLERY, "-q", "-o", cls.here / "out")
        assert done.returncode in (0, 4), done.stderr
        cls.out = cls.here / "out"

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.here)

    def read(self, folder, flow, ending):
        return json.loads((self.out / folder / (flow + ending)).read_text())

    def test_the_gap_is_the_certificates(self):
        for flow in FLOWS:
            sections, mask = self.read("recipes", flow, ".sections.json"), self.read("masks", flow, ".json")
            edges = self.read("recipes", flow, ".json")["edges"]["openings"][0]
            gap = min(sections["openings"], key=lambda o: o["drawn_m"])
            self.assertAlmostEqual(gap["mask_m"] * 1e6, mask["layers"][0]["min_space_um"], 5)
            self.assertAlmostEqual(gap["drawn_m"], edges["drawn_m"], 11)
            self.assertAlmostEqual(gap["top_m"], edges["drawn_m"] - 2 * edges["top"]["known_m"], 11)
            # and in the picture of the last step: the walls of the device's own film beside that gap
            last = [s for s in sections["steps"] if s["changes"]][-1]
            film = max(last["films"], key=lambda f: max(z for a in f["areas_m"] for _, z in a))
            parts = sorted(film["areas_m"], key=lambda a: a[0][0])
            self.assertEqual(len(parts), 3)  # flexure, ring, base
            top = [b[3][0] - a[2][0] for a, b in zip(parts, parts[1:])]
            self.assertAlmostEqual(min(top), gap["top_m"], 11)

    def test_areas_lie_in_the_window(self):
        for flow in FLOWS:
            sections = self.read("recipes", flow, ".sections.json")
            length = sections["cut"]["length_m"]
            for step in sections["steps"]:
                for film in step.get("films", []):
                    for area in film["areas_m"]:
                        self.assertEqual(len(area), 4)
                        self.assertTrue(all(-1e-15 <= s <= length * (1 + 1e-12) for s, _ in area))
                        twice = sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(area, area[1:] + area[:1]))
                        self.assertGreater(twice, 0)  # counter-clockwise

    def test_pictures(self):
        for flow in FLOWS:
            steps = self.read("recipes", flow, ".sections.json")["steps"]
            for ending in (".sections.svg", ".stack.svg"):
                root = ET.parse(self.out / "recipes" / (flow + ending)).getroot()
                words = " ".join(t.text or "" for t in root.iter(SVG + "text"))
                for step in steps:
                    if step["changes"]:
                        self.assertIn(step["title"], words)
            html = (self.out / "recipes" / (flow + ".html")).read_text()
            # of every change, what is made, and where the flow has a release its map
            map_of_release = (self.out / "recipes" / (flow + ".release.svg")).exists()
            self.assertEqual(html.count("<svg "), sum(s["changes"] for s in steps) + 1 + map_of_release)

    def test_wrong_cuts(self):
        for cut in ("1,2,3", "flexure:nobody", "1,1,1,1"):
            done = run("recipe", GALLERY, "-q", "--cut", cut, "-o", self.here / "no")
            self.assertEqual(done.returncode, 2, cut)
            self.assertIn("FW-D277", done.stderr)
            self.assertFalse((self.here / "no").exists())


FIVE = ("al-masked-rie", "copper-on-porous-silicon", "soi-deep-rie", "soi-double-sided", "silicon-on-glass")
FEW = ("--corners", "none", "--measurements", "none", "--advice", "none", "-q")
SPACE = "{urn:flexwright:process:1}"
UNITS = {"nm": 1e-9, "µm": 1e-6, "um": 1e-6, "mm": 1e-3}


def same(a, b, digits=12):
    return abs(a - b) <= 10.0 ** (1 - digits) * max(abs(a), abs(b)) + 1e-15


def flat(polygon):
    """left, right, bottom, top of an area"""
    return (min(x for x, _ in polygon), max(x for x, _ in polygon), min(z for _, z in polygon), max(z for _, z in polygon))


class OneComputation(unittest.TestCase):
    """Of five flows, with the packs' values and with a laboratory's: every thickness that a run sheet prints of a film at a step
    (picture, reason, table, JSON) is one number, and what is covered is not etched."""

    def lab(self, flow, number):
        """every value of the pack that is not an angle, a count or a temperature, moved by up to 3 %"""
        root, rows, draw = ET.parse(ROOT / f"processes/{flow}.xml").getroot(), [], random.Random(number * 7919 + len(flow))
        for q in root.iter(SPACE + "q"):
            value, unit = q.get("value"), q.get("unit")
            if not value or q.get("status") == "derived" or unit not in ("um", "nm", "Ao/s", "um/min", "nm/min", "min", "s") or float(value) == 0:
                continue
            if q.get("id") in ("wafer.D", "soi.d", "si.d", "cu.d"):
                continue  # the device's, or its order's
            rows.append(f'<q id="{q.get("id")}" value="{float(value) * draw.uniform(0.97, 1.03):.9g}" urel="0.01" unit="{unit}" status="typical" src="lab"/>')
        return (f'<process xmlns="urn:flexwright:process:1" flow="{flow}"><source id="lab" kind="handbook" date="2026-11-20">lab</source>'
                + "".join(rows) + "</process>")

    def recipe(self, here, flow, number):
        device = here / "device.xml"
        others = ("reference-six-bar", "straight-stage", "leaf-four-bar") if flow == FIVE[0] else ("reference-six-bar",)
        other = "comb-stage" if flow == FIVE[4] else others[number % len(others)]
        device.write_text((ROOT / f"docs/gallery/{other}/device.xml").read_text() if other != "reference-six-bar" else device_for(flow))
        more = ()
        if number:
            (here / "lab.xml").write_text(self.lab(flow, number))
            more = ("--lab", here / "lab.xml")
        out = here / f"{flow}-{number}"
        result = run("recipe", device, "--flow", flow, "-o", out, *FEW, *more)
        if result.returncode == 3:
            return None  # a drawn value broke a rule
        self.assertIn(result.returncode, (0, 1), result.stderr)
        stem = str(out / "recipes" / flow)
        return (json.loads(pathlib.Path(stem + ".json").read_text()), json.loads(pathlib.Path(stem + ".sections.json").read_text()),
                pathlib.Path(stem + ".html").read_text(), pathlib.Path(stem + ".sections.svg").read_text())

    def legends(self, picture):
        """the lengths behind names of films"""
        words = (html.unescape(re.sub("<[^>]*>", "", t)).strip() for t in re.findall(r"<text[^>]*>(.*?)(?:</text>|\.\n)", picture, re.S))
        return [(m[1], float(m[2]) * UNITS[m[3]]) for m in (re.match(r"(.*?) ([\d.]+(?:e-?\d+)?) (nm|µm|mm)$", w) for w in words)
                if m and "scale" not in m[1]]

    def pictured(self, step, picture):
        """each is the thickness of a film of the JSON, or of several of one material on each other"""
        by = {}
        for f in step["films"] + step["elsewhere"]:
            if f["thickness_m"] is not None:
                by.setdefault(f["material"], []).append(f["thickness_m"])
        sums = [sum(c) for t in by.values() for k in (1, 2, 3, 4) for c in itertools.combinations(t, k)]
        for name, length in self.legends(picture):
            self.assertTrue(any(same(length, s, 3) or abs(length - s) <= 0.51 * 10.0 ** (len(str(int(s * 1e6))) - 9) for s in sums),
                            f"{step['id']}: the picture shows {name} of {length * 1e6:.4g} um, its films have {sums}")

    def taken(self, flow, before, step, quantities, names):
        """what the table says that a step takes of an open film is what its picture has lost"""
        checked = 0
        for name, value, unit in quantities:
            m = re.match(r"lost of the open (.*), over-etch included$", name)
            if not m or value is None or m[1] not in names:
                continue
            material, lost = names[m[1]], value * UNITS[unit]
            was = [f["thickness_m"] for f in before["films"] + before["elsewhere"] if f["material"] == material]
            now = [f["thickness_m"] for f in step["films"] + step["elsewhere"] if f["material"] == material]
            fine = any(same(a - b, lost, 6) for a in was for b in now) or (all(a <= lost * (1 + 1e-9) for a in was) and not now)
            self.assertTrue(fine, f"{flow} {step['id']}: {name} {lost * 1e6} um, films {was} -> {now}")
            checked += any(same(a - b, lost, 6) for a in was for b in now)
        return checked

    def covered(self, flow, before, step):
        """an area on which another lies before and after has the top that it had"""
        checked = 0
        for f in before["films"]:
            for g in step["films"]:
                if f["material"] != g["material"]:
                    continue
                for a, b in itertools.product(f["areas_m"], g["areas_m"]):
                    p, q = flat(a), flat(b)
                    if not (same(p[0], q[0]) and same(p[1], q[1]) and same(p[2], q[2])):
                        continue
                    def lid(at, films):
                        return any(same(r[2], at[3]) and r[0] <= at[0] + 1e-12 and r[1] >= at[1] - 1e-12
                                   for other in films for r in map(flat, other["areas_m"]))
                    if lid(p, before["films"]) and lid(q, step["films"]):
                        self.assertTrue(same(p[3], q[3]), f"{flow} {step['id']}: {f['material']} under cover, {p[3]} -> {q[3]}")
                        checked += 1
        return checked

    def reasons(self, recipe, page):
        """"step S18 takes 0.55 um of the open aluminium, sputtered, 1 um thick": the table's number"""
        told = 0
        for step, lost, name in re.findall(r"step (\w+) takes ([\d.]+) um of the open ([^<]*?), [\d.]+ um thick", html.unescape(page)):
            rows = [q["value"] for s in recipe["steps"] if s["id"] == step for q in s["quantities"]
                    if q["name"] == f"lost of the open {name}, over-etch included"]
            self.assertTrue(rows and all(same(float(lost), v, 3) for v in rows), (step, lost, rows))
            told += 1
        return told

    def look(self, flow, number, found):
        with tempfile.TemporaryDirectory() as folder:
            made = self.recipe(pathlib.Path(folder), flow, number)
        if not made:
            return
        recipe, sections, page, picture = made
        root = ET.parse(ROOT / f"processes/{flow}.xml").getroot()
        names = {}
        for file in (root, ET.parse(ROOT / "processes/base.xml").getroot()):
            names.update({m.get("name"): m.get("id") for m in file.iter(SPACE + "material")})
        steps = {s["id"]: s for s in sections["steps"]}
        before = None
        for s in recipe["steps"]:
            step = steps[s["id"]]
            if not step["changes"]:
                continue
            body = re.search(rf'<section class="step" id="{s["id"]}">(.*?)</section>', page, re.S)[1]
            drawn = re.search(r"<svg.*?</svg>", body, re.S)[0]
            self.pictured(step, drawn)
            found["pictures"] += 1
            # the table of the sheet has the JSON's
            for q in s["quantities"]:
                m = re.match(r"lost of the open ", q["name"])
                if m and q["value"] is not None:
                    cell = re.search(re.escape(html.escape(q["name"], quote=False)) + r".*?<td[^>]*>(.*?)</td>", body, re.S)
                    number_ = re.match(r"[\d.e-]+", re.sub("<[^>]*>", "", cell[1]).strip())
                    self.assertTrue(same(float(number_[0]), q["value"], 3), (s["id"], q, cell[1]))
            if before:
                found["taken"] += self.taken(flow, before, step, [(q["name"], q["value"], q["unit"]) for q in s["quantities"]], names)
                found["covered"] += self.covered(flow, before, step)
            before = step
        found["reasons"] += self.reasons(recipe, page)

    def test_every_flow(self):
        found = {"pictures": 0, "taken": 0, "covered": 0, "reasons": 0}
        for flow in FIVE:
            for number in range(8 if ALL else 2):
                with self.subTest(flow=flow, laboratory=number):
                    self.look(flow, number, found)
        self.assertGreater(found["pictures"], 100, found)
        self.assertGreater(found["covered"], 100, found)
        self.assertGreater(found["taken"], 5, found)
        self.assertGreater(found["reasons"], 2, found)


unittest.main()
