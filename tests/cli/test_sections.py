#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The sections of a whole device against its mask's certificate, read from the files as anybody would."""
import json
import pathlib
import shutil
import tempfile
import unittest
import xml.etree.ElementTree as ET

from common import FLOWS, GALLERY, run

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
            release = (self.out / "recipes" / (flow + ".release.svg")).exists()  # its map is in the sheet, too
            self.assertEqual(html.count("<svg "), sum(s["changes"] for s in steps) + 1 + release)  # changes, what is made

    def test_wrong_cuts(self):
        for cut in ("1,2,3", "flexure:nobody", "1,1,1,1"):
            done = run("recipe", GALLERY, "-q", "--cut", cut, "-o", self.here / "no")
            self.assertEqual(done.returncode, 2, cut)
            self.assertIn("FW-D277", done.stderr)
            self.assertFalse((self.here / "no").exists())


unittest.main()
