#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What is said of one parameter alone is followed, as a user would: with --set, in text, JSON and page."""
import html
import json
import os
import pathlib
import re
import tempfile
import unittest

from common import ROOT, run

NODDER = ROOT / "docs/gallery/copper-nodder/device.xml"
LEAF = ROOT / "docs/gallery/leaf-four-bar/device.xml"
COMB = ROOT / "docs/gallery/comb-stage/device.xml"
SIX = ROOT / "docs/gallery/reference-six-bar/device.xml"
PLANS = os.environ.get("FW_GALLERY_PLANS")  # what tests/golden/plans.sh has left of the gallery


class Parameters(unittest.TestCase):
    def expect(self, result, status):
        self.assertEqual(result.returncode, status, result.stdout[-2000:] + result.stderr[-4000:])
        return result

    def follow(self, device, *sets):
        """every proposal is accepted; returns what is said of each parameter"""
        arguments = [a for s in sets for a in ("--set", s)]
        if PLANS and not sets:  # its verdict.json is what check --json prints
            plan = pathlib.Path(PLANS) / device.parent.name
            self.assertIn(int(plan.with_name(plan.name + ".status").read_text()), (1, 4))
            document = (plan / "verdict.json").read_text()
        else:
            result = run("check", device, *arguments, "--json")
            self.assertIn(result.returncode, (1, 4), result.stderr)
            document = result.stdout
        said = json.loads(document)["advice_parameters"]
        declared = re.findall(r'<parameter name="(\w+)"', device.read_text())
        self.assertEqual(sorted(p["set"] for p in said), sorted(declared))
        for p in said:
            self.assertEqual(p["found"] == "accepts", p["value"] is not None, p)
            if p["found"] == "accepts":
                self.expect(run("check", device, *arguments, "--set", f"{p['set']}={p['value']}"), 0)
                self.assertLessEqual(p["from_SI"], p["value_SI"])
                self.assertGreaterEqual(p["to_SI"], p["value_SI"])
                self.assertAlmostEqual(p["change"], abs(p["value_SI"] / p["now_SI"] - 1), places=9)
        changes = [p["change"] for p in said if p["found"] == "accepts"]
        self.assertEqual(changes, sorted(changes))
        self.assertEqual([p["found"] for p in said], sorted(p["found"] for p in said))
        return {p["set"]: p for p in said}

    def test_of_a_design_that_tires(self):
        said = self.follow(NODDER)
        self.assertEqual(said["leaf"]["found"], "none")
        self.assertIn("from 200 um to 600 um", said["leaf"]["text"])
        self.assertEqual({n: said[n]["found"] for n in ("width", "push")}, {"width": "accepts", "push": "accepts"})

    def test_of_other_designs(self):
        said = self.follow(LEAF, "limits/@safety-factor=10")
        self.assertEqual(said["width"]["found"], "accepts")
        said = self.follow(COMB, "volts=100 V")
        self.assertLess(said["volts"]["value_SI"], 100)
        self.assertGreater(said["volts"]["value_SI"], 50)
        self.follow(SIX, "limits/@safety-factor=2.6")

    def test_text_and_page_say_the_same(self):
        with tempfile.TemporaryDirectory() as here:
            out = pathlib.Path(here) / "out"
            result = self.expect(run("plan", LEAF, "--set", "limits/@safety-factor=10", "-o", out), 1)
            alone = result.stdout.split("one parameter alone:")[1]
            set_to, = re.findall(r'--set "(width=[^"]*)"', alone)
            said = json.loads((out / "verdict.json").read_text())["advice_parameters"]
            self.assertEqual(set_to, f"width={said[0]['value']}")
            page = html.unescape((out / "report.html").read_text())
            self.assertIn(f"--set '{set_to}'", page)
            for p in said:
                self.assertIn(p["text"], alone)
                self.assertIn(p["text"], page)

    def test_accepted_designs_are_told_nothing(self):
        result = self.expect(run("check", LEAF), 0)
        self.assertNotIn("parameter", result.stdout)
        printed = run("check", LEAF, "--json").stdout
        self.assertEqual(json.loads(printed)["advice_parameters"], [])
        if PLANS:
            self.assertEqual(printed, (pathlib.Path(PLANS) / "leaf-four-bar/verdict.json").read_text())


if __name__ == "__main__":
    unittest.main()
