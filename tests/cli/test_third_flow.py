#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A flow that is XML alone (processes/soi-deep-rie.xml and masks/soi-deep-rie.xml; no line of code knows it) plans the devices
of the gallery; and one number of the device moves verdict, mask, times and run sheet together."""
import json
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
        done = run("recipe", "-", *options, "--json", input=text)
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


if __name__ == "__main__":
    unittest.main()
