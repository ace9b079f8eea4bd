#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""`flexwright tradeoff`: JSON and CSV hold the same numbers, the same input gives the same bytes, instructions
repeat, every kind of scene has an answer or a message, and the picture is whole."""
import csv
import json
import math
import pathlib
import shutil
import tempfile
import unittest
import xml.etree.ElementTree as tree

from common import ROOT, run

DEVICES = ROOT / "docs/gallery"
SIX = ROOT / "tests/data/six-bar-benchmark.xml"
VALGRIND = shutil.which("valgrind")


def document(*arguments):
    done = run("tradeoff", "--json", *arguments)
    if done.returncode:
        raise AssertionError(f"{arguments}: {done.returncode}\n{done.stderr}")
    return json.loads(done.stdout)


def same(number, cell):
    return cell == "" if number is None else float(cell) == number


class Files(unittest.TestCase):
    def test_json_and_csv_have_the_same_numbers(self):
        with tempfile.TemporaryDirectory() as room:
            out = pathlib.Path(room) / "out"
            done = run("tradeoff", DEVICES / "reference-six-bar/device.xml", "--budget", "1", "--no-time", "-o", out)
            self.assertEqual(done.returncode, 0, done.stderr)
            whole = json.loads((out / "tradeoff.json").read_text())
            rows = list(csv.DictReader((out / "tradeoff.csv").read_text().splitlines()))
            picture = tree.parse(out / "tradeoff.svg")
        points = [whole["chosen"], *whole["points"]]
        settings = [r for r in rows if r["kind"] in ("chosen", "setting")]
        self.assertEqual(len(settings), len(points))
        self.assertGreater(sum(p["state"] == "done" for p in points), 14)
        for p, r in zip(points, settings):
            self.assertEqual((p["method"], p["integrator"], p["state"]), (r["method"], r["integrator"], r["state"]))
            for key in ("rtol", "error", "estimated", "utilisation_error", "steps", "rhs", "instructions"):
                self.assertTrue(same(p.get(key), r[key]), f"{key}: {p.get(key)} and {r[key]}")
        masks = [r for r in rows if r["kind"] == "mask"]
        self.assertEqual([int(r["rhs"]) for r in masks], [m["bytes"] for m in whole["masks"]])
        models = [r for r in rows if r["kind"] in ("hinge", "effects", "solid", "process")]
        self.assertEqual(len(models), len(whole["models"]))
        for m, r in zip(whole["models"], models):
            self.assertTrue(same(m["change"], r["error"]))
        # coarser masks are smaller, and every chord error is within what was asked for and a grid step
        sizes = [m["bytes"] for m in whole["masks"]]
        self.assertEqual(sizes, sorted(sizes, reverse=True))
        for m in whole["masks"]:
            self.assertLess(m["edge_m"], m["tolerance_m"] + 1e-9)
            self.assertAlmostEqual(m["deflection_bound"], 6 * m["edge_m"] / 8e-6, 12)  # the narrowest is 8 um wide
        text = "".join(picture.getroot().itertext())
        for word in ("wanted", "chosen", "dop853", "minimal", "masks", "reference"):
            self.assertIn(word, text)

    def test_same_bytes(self):
        first, again = (run("tradeoff", SIX, "--budget", "1", "--no-time", "--json") for _ in range(2))
        self.assertEqual(first.returncode, 0, first.stderr)
        self.assertEqual(first.stdout, again.stdout)
        self.assertNotIn("callgrind", first.stdout)
        self.assertIsNone(json.loads(first.stdout)["chosen"]["cpu_s"])


class Numbers(unittest.TestCase):
    def test_what_is_chosen_and_what_would_have_done(self):
        d = document(SIX, "--budget", "2", "--no-time")
        chosen, cheapest = d["chosen"], d["chosen"]["cheapest"]
        self.assertTrue(d["reference"]["independent"])
        self.assertLessEqual(chosen["error"], d["accuracy_wanted"])
        self.assertLessEqual(cheapest["error"], d["accuracy_wanted"])
        self.assertAlmostEqual(d["chosen"]["over_cheapest"], chosen["instructions"] / cheapest["instructions"], 12)
        done = [p for p in d["points"] if p["state"] == "done"]
        for p in done:  # the definition of the front
            cost, error = p["instructions"], max(p["error"], d["reference"]["error"])
            beaten = any(q["instructions"] < cost and max(q["error"], d["reference"]["error"]) < error
                         for q in [*done, chosen])
            if p["front"]:
                self.assertFalse(beaten, p)
        for p in done:  # GSL's extrapolation takes 8 steps for all of the scene, which its estimate does not see
            if p["integrator"] != "gsl-bsimp" and p["error"] > 3 * d["reference"]["error"]:
                self.assertGreaterEqual(p["estimated"], p["error"], p)
        for p in d["points"]:
            self.assertEqual("why" in p, p["state"] != "done")
            self.assertTrue(p["state"] == "done" or p["why"])

    @unittest.skipUnless(VALGRIND, "valgrind is not installed")
    def test_instructions_repeat(self):
        counts = []
        for words in ((SIX, "--budget", "1"), ("--budget", "1", "--", SIX)):  # nothing behind "--" is an option
            d = document(*words)
            self.assertIsNone(d["instructions_why"])
            counts.append({(p["method"], p["integrator"], p["rtol"]): p["instructions"]
                           for p in [d["chosen"], *d["points"]] if p.get("instructions_by") == "callgrind"})
        self.assertEqual(counts[0].keys(), counts[1].keys())
        self.assertGreater(len(counts[0]), 8)
        for key, count in counts[0].items():
            self.assertLess(abs(math.log(count / counts[1][key])), 1e-3, key)
        times = [p["time"] for p in d["points"] if p.get("time")]
        for t in times:  # what is told is narrow, what is not is not there
            if t["told"]:
                self.assertLessEqual(t["high"] - t["low"], 0.1 * t["ratio"] * (1 + 1e-12))
            else:
                self.assertIsNone(t["ratio"])


class Scenes(unittest.TestCase):
    def test_stiff_hinges_that_give(self):
        d = document(DEVICES / "comb-stage/device.xml", "--budget", "1", "--no-time")
        self.assertEqual(d["hinges_as"], "compliance")
        self.assertEqual(d["chosen"]["integrator"], "radau5")
        levels = {m["name"]: m for m in d["models"] if m["kind"] == "hinge"}
        self.assertGreater(levels["revolute"]["change"], 1e-3)

    def test_a_row_of_equilibria(self):
        d = document(DEVICES / "copper-nodder/device.xml", "--budget", "1", "--no-time", "--accuracy", "0.03")
        self.assertTrue(d["chosen"]["quasi_static"])
        self.assertEqual(d["chosen"]["method"], "quasi-static")

    def test_mechanisms_without_flexures(self):
        for name in ("slider-crank", "toggle"):
            d = document(ROOT / f"docs/mechanisms/{name}.xml", "--budget", "1", "--no-time")
            self.assertIsNotNone(d["masks_why"])
            self.assertTrue(any(p["state"] == "done" for p in d["points"]))

    def test_nothing_to_show(self):
        with tempfile.TemporaryDirectory() as room:
            file = pathlib.Path(room) / "d.xml"
            text = SIX.read_text()
            file.write_text(text[:text.index("<scene")] + "</device>")
            done = run("tradeoff", file)
            self.assertEqual(done.returncode, 3)
            self.assertIn("FW-D229", done.stderr)
            file.write_text(text[:text.index("<force")] + "</scene></device>")
            done = run("tradeoff", file)
            self.assertEqual(done.returncode, 3)
            self.assertIn("FW-D290", done.stderr)

    def test_hinges_that_bend_and_do_not_turn(self):
        """a stage that two leaves guide goes to the side: their ends stay parallel, and what angles there are is a 1e-5 of what they use"""
        leaf = ('<revolute id="{0}" a="ground" a-x="{1} mm" a-y="-0.75 mm" b="stage" b-x="{1} mm" b-y="-0.75 mm" '
                'hinge="leaf" axis="0 deg"/>')
        text = ('<device xmlns="urn:flexwright:device:1" name="guided"><material ref="silicon-100" thickness="50 um"/>'
                '<limits safety-factor="2"/><flexure id="leaf" kind="leaf" length="500 um" width="6 um"/><mechanism>'
                '<body id="stage" x="0 mm" y="0 mm" plate-width="1.5 mm" plate-height="0.14 mm" plate-y="-0.2 mm" width="110 um"/>'
                + leaf.format("A", -0.7) + leaf.format("B", 0.7) + '</mechanism><scene name="draw" duration="2 ms">'
                '<force on="stage" y="-0.2 mm" fx="0.3 mN" law="expression" factor="0.5*(1-cos(pi*t/(2 ms)))"/></scene></device>')
        with tempfile.TemporaryDirectory() as room:
            file = pathlib.Path(room) / "d.xml"
            file.write_text(text)
            done = run("tradeoff", file, "--budget", "1", "--no-time")
        self.assertEqual(done.returncode, 3)
        self.assertIn("no joint turns by more than the accuracy wanted of what hinges use", done.stderr)
        self.assertIn("FW-D290", done.stderr)

    def test_usage(self):
        for extra in (("--budget", "0"), ("--budget", "x"), ("--settings", ""), ("--settings", "revolute;nope/dop853/1e-7")):
            done = run("tradeoff", SIX, *extra)
            self.assertEqual(done.returncode, 2, extra)
            self.assertEqual(done.stdout, "")


if __name__ == "__main__":
    unittest.main()
