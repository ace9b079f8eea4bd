#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every input of every flow is changed, one after the other, by a laboratory: what the recipe says of it changes in all of
its files and in no other place. JSON, table, run sheet, calendar, schedule and sections are compared with each other."""
import csv
import io
import json
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest
import xml.etree.ElementTree as tree

from common import ROOT, device_for, run

SPACE = "{urn:flexwright:process:1}"
DEVICE = ROOT / "docs/gallery/reference-six-bar/device.xml"
FAST = ("--corners", "none", "--measurements", "none", "--advice", "none", "-q", "--wafers", "2")


def seen(a, b):
    """do they differ in what a sheet prints, four digits?"""
    if isinstance(a, (int, float)) and isinstance(b, (int, float)) and not isinstance(a, bool):
        return abs(a - b) > 1e-3 * max(abs(a), abs(b))
    if isinstance(a, dict) and isinstance(b, dict):
        return a.keys() != b.keys() or any(seen(a[k], b[k]) for k in a)
    if isinstance(a, (list, tuple)) and isinstance(b, (list, tuple)):
        return len(a) != len(b) or any(map(seen, a, b))
    return a != b


def inputs(flow):
    """(id, value, unit) of all that has a value of its own"""
    root = tree.parse(ROOT / f"processes/{flow}.xml").getroot()
    return [(q.get("id"), float(q.get("value")), q.get("unit")) for q in root.iter(SPACE + "q")
            if q.get("value") and q.get("status") != "derived" and float(q.get("value")) != 0]


def text(path):
    return pathlib.Path(path).read_bytes().decode()


class Recipe:
    """what each file says, by step"""

    def __init__(self, folder, flow):
        stem = str(folder / "recipes" / flow)
        self.json = {s["id"]: s for s in json.loads(text(stem + ".json"))["steps"]}
        self.quantity = {}
        for name, step in self.json.items():
            for q in step["quantities"]:
                self.quantity.setdefault((name, q["name"]), []).append((q["value"], q["unit"], q["uncertainty"]))
        self.table = {}
        for row in csv.DictReader(io.StringIO(text(stem + ".csv"))):
            self.table.setdefault((row["step"], row["name"]), []).append(
                tuple(None if row[k] == "" else float(row[k]) if k != "unit" else row[k] for k in ("value", "unit", "uncertainty")))
        page = text(stem + ".html")
        self.sheet = {m[1]: re.sub(r"<svg.*?</svg>", "", m[0], flags=re.S)
                      for m in re.finditer(r'<section class="step" id="(\w+)">.*?</section>', page, re.S)}
        self.booked = {s["id"]: s for s in json.loads(text(stem + ".schedule.json"))["steps"]}
        self.runs = {}
        for row in csv.DictReader(io.StringIO(text(stem + ".schedule.csv"))):
            self.runs.setdefault(row["step"], set()).add(float(row["end_s"]) - float(row["start_s"]))
        self.calendar = {}
        for event in text(stem + ".ics").replace("\r\n ", "").split("BEGIN:VEVENT")[1:]:
            at = dict(re.findall(r"^(DTSTART|DTEND)[^:]*:(\S+)", event, re.M))
            title = re.search(r"^SUMMARY:(\w+) (.*)$", event, re.M)
            if title and len(at) == 2 and "(attended)" not in title[2]:
                def seconds(t):
                    return ((int(t[6:8]) * 24 + int(t[9:11])) * 60 + int(t[11:13])) * 60 + int(t[13:15])
                self.calendar.setdefault(title[1], set()).add(seconds(at["DTEND"]) - seconds(at["DTSTART"]))
        sections = json.loads(text(stem + ".sections.json"))
        self.drawn = [[sections["parts"], sections["openings"]],  # a step's title stands in the JSON alone
                      [{k: v for k, v in s.items() if k != "title"} for s in sections["steps"]]]
        self.picture = text(stem + ".sections.svg")


class Inputs(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.addCleanup(self.temporary.cleanup)
        self.here = pathlib.Path(self.temporary.name)

    def recipe(self, flow, name, q=None):
        lab, more = self.here / f"{name}.xml", ()
        if q:
            lab.write_text(f'<process xmlns="urn:flexwright:process:1" flow="{flow}"><source id="lab" kind="handbook" '
                           f'date="2026-11-20">lab</source><q id="{q[0]}" value="{q[1]:.12g}" urel="0.01" unit="{q[2]}" '
                           'status="typical" src="lab"/></process>')
            more = ("--lab", lab)
        out = self.here / name
        device = self.here / "device.xml"
        device.write_text(device_for(flow))
        result = run("recipe", device, "--flow", flow, "-o", out, *FAST, *more)
        if result.returncode == 3:
            return None
        self.assertIn(result.returncode, (0, 1), result.stderr)
        return Recipe(out, flow)

    def agree(self, r):
        """the files of one recipe say the same"""
        for key, values in r.quantity.items():
            self.assertEqual(values, r.table.get(key), key)
        for name, step in r.json.items():
            booked = r.booked[name]
            if step["time_s"] and booked["time"] == "computed":
                self.assertAlmostEqual(booked["duration_s"], max(step["booked_s"], booked["attended_s"]), delta=1e-3 + 1e-9 * step["booked_s"])
            for found in r.runs[name]:
                self.assertAlmostEqual(found, booked["duration_s"], delta=2e-3)
            for found in r.calendar.get(name, ()):
                self.assertLessEqual(abs(found - booked["duration_s"]), 60, name)  # a calendar has whole minutes

    def check(self, flow, share):
        first = self.recipe(flow, "first")
        self.assertIsNotNone(first, "the device as it is")
        self.agree(first)
        tried = refused = 0
        root = tree.parse(ROOT / f"processes/{flow}.xml").getroot()
        tools = {e.get("id"): e.text or "" for e in root.iter(SPACE + "equipment")}
        texts = {s.get("id"): tree.tostring(s).decode() + tools.get(s.get("equipment"), "") for s in root.iter(SPACE + "step")}
        for number, (name, value, unit) in enumerate(inputs(flow)):
            if number % share:
                continue
            now = None
            for factor in (1.02, 0.98):
                now = now or self.recipe(flow, f"q{number}", (name, value * factor, unit))
            if not now:
                refused += 1
                continue
            tried += 1
            with self.subTest(flow=flow, input=name):
                self.agree(now)
                self.assertEqual(first.json.keys(), now.json.keys())
                for step in first.json:
                    keys = [k for k in first.quantity if k[0] == step]
                    moved = {k for k in keys if first.quantity[k] != now.quantity.get(k)}
                    written = {k for k in keys if first.table.get(k) != now.table.get(k)}
                    self.assertEqual(moved, written)
                    if any(seen(first.quantity[k], now.quantity.get(k)) for k in moved) or seen(first.json[step]["time_s"], now.json[step]["time_s"]):
                        self.assertNotEqual(first.sheet[step], now.sheet[step], f"the sheet of {step} stays")
                    if first.json[step] == now.json[step] and "{" not in texts[step]:  # which no other file has
                        self.assertEqual(apart(first.sheet[step]), apart(now.sheet[step]), f"the sheet of {step} alone changes")
                self.assertEqual(first.drawn == now.drawn, first.picture == now.picture)
        self.assertGreater(tried, 4 * refused)


BROWSER = next(filter(None, map(shutil.which, ("chromium-headless-shell", "chromium", "chromium-browser"))), None)


def apart(sheet):
    """without what the verdict says of another way of drying: verdict.json and the report have it, and a recipe's own JSON is the
    same whatever the verdict; and without the numbers of sources, which are counted as the sheet names them"""
    return re.sub(r' \[\d+\]', "", re.sub(r'<p class="small"><b>Not for this device:.*?</p>', "", sheet, flags=re.S))


class Printed(unittest.TestCase):
    @unittest.skipUnless(BROWSER, "no browser that prints")
    def test_a_sheet_has_few_pages(self):
        """of six wafers the silicon flow on at most twelve sheets, and the copper flow on fifteen, of the paper that there is: A4, or
        Letter, which is what this browser takes where nothing is said, and may be a sheet more"""
        with tempfile.TemporaryDirectory() as folder:
            for flow, most in (("al-masked-rie", 12), ("copper-on-porous-silicon", 15)):
                out = pathlib.Path(folder) / flow
                run("recipe", DEVICE, "--flow", flow, "-o", out, "-q", "--wafers", 6)
                sheet = (out / "recipes" / f"{flow}.html").read_text()
                for paper, size in (("A4", (b"594", b"841")), ("Letter", (b"612", b"792"))):
                    page = out / f"{paper}.html"
                    page.write_text(sheet.replace("</style>", "@page{size:A4}</style>", 1) if paper == "A4" else sheet)
                    subprocess.run([BROWSER, "--headless", "--no-sandbox", "--disable-gpu", "--no-pdf-header-footer",
                                    f"--user-data-dir={folder}/profile", f"--print-to-pdf={out}.pdf", f"file://{page}"],
                                   capture_output=True, timeout=120, check=True)
                    printed = pathlib.Path(f"{out}.pdf").read_bytes()
                    self.assertEqual(set(re.findall(rb"/MediaBox \[0 0 (\d+)[.\d]* (\d+)", printed)), {size})
                    self.assertLessEqual(len(re.findall(rb"/Type\s*/Page(?!s)", printed)), most + (paper == "Letter"))


if __name__ == "__main__":
    ALL = bool(os.environ.get("FW_TEST_ALL"))
    # of the flows that the device does not name a few inputs here, each another one than that of the others
    for number, one in enumerate(("al-masked-rie", "copper-on-porous-silicon", "soi-deep-rie", "silicon-on-glass", "soi-double-sided")):
        share = 1 if ALL else 4 if one in DEVICE.read_text() else 16
        setattr(Inputs, f"test_{number}_{one.replace('-', '_')}", lambda self, flow=one, share=share: self.check(flow, share))
    unittest.main()
