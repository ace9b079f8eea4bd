#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Moving and still pictures of mechanisms without drawn shapes: everything that moves stays in the
picture, below the title, at all times; nothing of the mechanism is left out."""
import pathlib
import re
import tempfile
import unittest
import xml.etree.ElementTree as tree

from common import ROOT, run

FIGURES = sorted((ROOT / "tests/data/figures").glob("*.xml"))
MECHANISMS = sorted((ROOT / "docs/mechanisms").glob("*.xml"))
SVG = "{http://www.w3.org/2000/svg}"
NUMBER = r"-?[0-9.]+"


def pairs(text):
    """end points of a path in capital letters, or of the values of a translation"""
    return [(float(x), float(y)) for x, y in re.findall(rf"({NUMBER})[ ,]({NUMBER})", text)]


def figures(root):
    """the panels of a picture: nested <svg> with a size"""
    return [e for e in root.iter(SVG + "svg") if e is not root]


def places(panel):
    """every point of the picture where something is, or gets to"""
    found = []
    for e in panel:
        if e.tag == SVG + "path" and e.get("d") and not e.get("transform"):
            if re.fullmatch(rf"([ML]{NUMBER} {NUMBER}|Z)*", e.get("d")):
                found += pairs(e.get("d"))
                for a in e.iter(SVG + "animate"):
                    found += pairs(a.get("values"))
        if e.tag == SVG + "g" and "translate" in (e.get("transform") or ""):
            found += pairs(e.get("transform"))
            for a in e:
                if a.get("type") == "translate":
                    found += pairs(a.get("values"))
    return found


class Pictures(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.addCleanup(self.temporary.cleanup)
        self.here = pathlib.Path(self.temporary.name)

    def test_names_of_hinges_stand_within_the_picture(self):
        """with shares of many letters, too, and with names that are long"""
        gallery = ROOT / "docs/gallery"
        faint = re.sub(r'fx="0.25 mN"', 'fx="3 nN"', (gallery / "reference-six-bar/device.xml").read_text(encoding="utf-8"))
        faint = re.sub(r'<scene name="gentle.*?</scene>|<workspace [^>]*/>|<flow ref="copper[^>]*/>', "", faint, flags=re.S)
        named = re.sub(r'<revolute id="(\w)"', r'<revolute id="\1-of-the-stage"', (gallery / "leaf-four-bar/device.xml").read_text(encoding="utf-8"))
        letter, longest = 0.54 * 13, 0
        for number, text in enumerate((faint, named)):
            path, out = self.here / f"{number}.xml", self.here / f"out{number}"
            path.write_text(text, encoding="utf-8")
            result = run("plan", path, "-o", out, "--corners", "none", "--advice", "none", "-q")
            self.assertIn(result.returncode, (0, 1, 4), result.stderr)
            root, labels = tree.parse(out / "device.svg").getroot(), 0
            width = float(root.get("viewBox").split()[2])
            for e in root.iter(SVG + "text"):
                if e.get("font-size") != "13" or e.find(SVG + "tspan") is None:
                    continue
                wide = letter * len("".join(e.itertext()).strip())
                left = float(e.get("x")) - {"start": 0, "middle": wide / 2, "end": wide}[e.get("text-anchor")]
                self.assertTrue(-0.5 <= left and left + wide <= width + 0.5, (left, wide, "".join(e.itertext())))
                labels, longest = labels + 1, max(longest, wide)
            self.assertGreaterEqual(labels, 4)
        self.assertGreater(longest, 80)  # more than any picture of the gallery has

    def inside(self, path, least):
        text = path.read_text()
        self.assertNotRegex(text, r"\b(nan|inf)\b")
        root = tree.fromstring(text)
        panels = figures(root)
        self.assertTrue(panels, path)
        for panel in panels:
            width, height = float(panel.get("width")), float(panel.get("height"))
            found = places(panel)
            self.assertGreaterEqual(len(found), least, path)
            for x, y in found:
                self.assertTrue(4 <= x <= width - 4 and 4 <= y <= height - 4,
                                f"{path.name}: ({x}, {y}) in {width} x {height}")
        return root, panels

    def test_motion(self):
        for device in FIGURES + MECHANISMS:
            svg = self.here / "motion.svg"
            result = run("simulate", device, "--animate", svg, "-q")
            self.assertIn(result.returncode, (0, 4), (device, result.stderr))  # 4: they start elsewhere than stated
            root, panels = self.inside(svg, 100)
            title = next(e for e in root if e.tag == SVG + "text")
            self.assertGreater(float(panels[0].get("y")), float(title.get("y")) + 4)

    def test_assembly(self):
        for device in FIGURES + MECHANISMS:
            svg = self.here / "assemble.svg"
            result = run("assemble", device, "--svg", svg, "-q")
            self.assertIn(result.returncode, (0, 4), (device, result.stderr))  # 4: they start elsewhere than stated
            self.inside(svg, 2)

    def test_equilibrium_and_modes(self):
        for device in FIGURES:
            if run("statics", device, "-o", self.here / "s", "-q").returncode == 0:
                self.inside(self.here / "s/statics.svg", 2)
            result = run("modes", device, "-o", self.here / "m", "-q")
            self.assertIn(result.returncode, (0, 4), (device, result.stderr))  # 4: they start elsewhere than stated
            root = tree.parse(self.here / "m/modes.svg").getroot()
            if figures(root):
                self.inside(self.here / "m/modes.svg", 10)
            else:
                self.assertIn("nothing free", "".join(root.itertext()))

    def animation(self, name):
        svg = self.here / f"{name}.svg"
        self.assertIn(run("simulate", ROOT / f"tests/data/figures/{name}.xml", "--animate", svg, "-q").returncode, (0, 4))
        return svg.read_text()

    def test_nothing_is_left_out(self):
        foot = "l-6.27 10.45h12.54Z"
        self.assertEqual(self.animation("rods").count(foot), 2)  # anchors of two rods
        self.assertEqual(self.animation("drod").count(foot), 2)  # pin and rod
        self.assertEqual(self.animation("drod").count('stroke="#D55E00"'), 1)  # the driven rod
        self.assertEqual(self.animation("sr").count('stroke="#8250df"'), 1)  # its spring
        self.assertEqual(self.animation("vm").count('stroke="#8250df"'), 3)  # two, and the slider's
        self.assertEqual(self.animation("vm").count("stroke-dasharray=\"1 5\""), 1)  # a guide
        self.assertEqual(self.animation("tele").count('stroke="#B03A00"'), 1)  # stops
        hub = self.animation("hub")
        outline = next(d for d in re.findall(r' d="([^"]*)"', hub) if d.endswith("Z") and
                       re.fullmatch(rf"([ML]{NUMBER} {NUMBER})+Z", d))
        self.assertEqual(outline.count("L") + 1, 9)  # all around, the tenth joint inside


if __name__ == "__main__":
    unittest.main()
