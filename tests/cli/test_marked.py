#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Devices whose layout cannot be made, and devices that are rejected: their drawing marks what is
wrong, masks are not written, `hinge` tells what it knows and nothing false. Hinges, plates and bars
are moved by random amounts."""
import json
import pathlib
import random
import re
import tempfile
import unittest
import xml.etree.ElementTree as tree

from common import GALLERY, ROOT, loose_gripper, run

SVG = "{http://www.w3.org/2000/svg}"
STATED = GALLERY.read_text()
BARE = re.sub(r' (mass|inertia|stiffness|damping)="[^"]*"', "", STATED)
PLATE = 'width="1.40 mm" height="0.40 mm" x="1.50 mm" y="2.875 mm"'
STAGE = (ROOT / "docs/gallery/straight-stage/device.xml").read_text()

NECK = """<device xmlns="urn:flexwright:device:1" name="neck">
  <material ref="silicon-100" thickness="50 um"/><limits safety-factor="1.5"/><flow ref="al-masked-rie"/>
  <flexure id="h" kind="csfh" radius="80 um" angle="240 deg" width="8 um" gap="10 um"/>
  <mechanism>
    <body id="p" x="0 mm" y="0 mm">
      <plate width="200 um" height="400 um" x="0 um" y="400 um"/><plate width="200 um" height="200 um" x="199 um" y="700 um"/>
    </body>
    <revolute id="A" a="ground" b="p" hinge="h"/>
  </mechanism>
  <scene name="s" duration="1 ms"><force on="p" x="0 mm" y="0.4 mm" fx="10 uN" fy="0 N"/></scene>
</device>
"""


def enlarged(text, dice):
    w, h, y = dice.uniform(2.2, 3.0), dice.uniform(0.7, 1.2), dice.uniform(2.2, 2.5)
    return text.replace(PLATE, f'width="{w:.3f} mm" height="{h:.3f} mm" x="1.50 mm" y="{y:.3f} mm"')


def together(text, dice):
    """hinge D beside C"""
    x, y = dice.uniform(0.95, 1.1), dice.uniform(2.65, 2.8)
    return text.replace('at="D" x="2.20 mm" y="2.75 mm"', f'at="D" x="{x:.3f} mm" y="{y:.3f} mm"')


def wide(text, dice):
    return text.replace('id="BC" width="link"', f'id="BC" width="{dice.uniform(0.8, 1.2):.3f} mm"')


def errors(stderr, kind="error"):
    """numbers of the diagnostics, each with how often it is said"""
    found = {}
    for code in re.findall(rf"{kind}: .*\[FW-D(\d+)\]", stderr):
        found[code] = found.get(code, 0) + 1
    return found


class Marked(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.addCleanup(self.temporary.cleanup)
        self.here = pathlib.Path(self.temporary.name)

    def plan(self, text, *options):
        file, out = self.here / "device.xml", self.here / "out"
        file.write_text(text)
        result = run("plan", file, "-o", out, "--advice", "none", "--corners", "none", *options)
        return result, out

    def drawing(self, out):
        """the rows of the legend: (code, text, sentence)"""
        text = (out / "device.svg").read_text()
        self.assertNotRegex(text, r"\b(nan|inf)\b")
        root = tree.fromstring(text)
        rows = [g for g in root.iter(SVG + "g") if g.get("class") == "mark-row"]
        height = float(root.get("viewBox").split()[3])
        for row in rows:
            for e in row.iter(SVG + "text"):
                self.assertLess(float(e.get("y")), height, "a row below the picture")
        found = []
        for row in rows:
            words = list(row.iter(SVG + "text"))[-1].text
            code = re.search(r"\[FW-D(\d+)\]$", words)
            found.append((code.group(1) if code else None, words, row.find(SVG + "title").text))
        return root, found

    def test_what_cannot_be_made(self):
        dice = random.Random(19)
        for change in [enlarged, together, wide] * 3:
            text = change(BARE, dice)
            result, out = self.plan(text)
            with self.subTest(change=change.__name__, seen=result.stderr):
                self.assertEqual(result.returncode, 3)
                said = errors(result.stderr)
                self.assertTrue(said)
                self.assertNotIn("082", said, "a body has no shape only because nothing is drawn")
                files = {f.name for f in out.rglob("*") if f.is_file()}
                self.assertEqual(files, {"device.svg", "device.png", "manifest.json"})
                root, rows = self.drawing(out)
                shown = {}
                for code, _, sentence in rows:
                    shown[code] = shown.get(code, 0) + 1
                    self.assertIn(sentence.rsplit(" [", 1)[0], result.stderr)
                self.assertEqual(shown, said)
                marks = [g for g in root.iter(SVG + "g") if g.get("class") == "mark"]
                self.assertEqual(len(marks), len(rows))
                self.assertIn("CANNOT BE MADE", (out / "device.svg").read_text())
                # the same bytes once more
                before = (out / "device.svg").read_bytes()
                self.assertEqual(self.plan(text)[0].returncode, 3)
                self.assertEqual(before, (out / "device.svg").read_bytes())

    def test_judged_without_its_drawing(self):
        """where masses are stated the mechanics are judged; no flow gets a mask, forced or not"""
        dice = random.Random(20)
        for option in ([], ["--force"]):
            result, out = self.plan(enlarged(STATED, dice), *option)
            self.assertEqual(result.returncode, 1, result.stderr)
            self.assertTrue(errors(result.stderr, "warning").get("120"))
            self.assertFalse(list(out.rglob("*.gds")))
            _, rows = self.drawing(out)
            self.assertTrue({"120"} <= {code for code, _, _ in rows}, rows)
            report = (out / "report.html").read_text()
            tree.fromstring(report.split("\n", 1)[1])
            self.assertIn("mark-row", report)
            self.assertIn("This layout cannot be made", report)
            top = json.loads((out / "verdict.json").read_text())["summary"]
            self.assertEqual(top[0]["label"], "cannot be made")
            self.assertIn("FW-D120", top[0]["text"])

    def test_what_no_flow_makes_says_so_first(self):
        """hinges that hold, on plates that overlap in a corner only: the first lines say that it cannot be made, and where"""
        text = STAGE[:STAGE.index("<device")] + NECK
        result, out = self.plan(text)
        self.assertEqual(result.returncode, 1, result.stderr)
        lines = result.stdout.splitlines()
        self.assertEqual(lines[0], "neck: ACCEPT, but cannot be made in al-masked-rie")
        self.assertRegex(lines[1], r"^cannot be made: in al-masked-rie: its mask: link p .* width of .* at \(99\.\d*, 600\) um.* \[FW-D144\]")
        checked = run("check", self.here / "device.xml", "--advice", "none", "--corners", "none")  # the same without a file
        self.assertEqual((checked.returncode, checked.stdout.splitlines()[:2]), (1, lines[:2]), checked.stderr)
        top = json.loads((out / "verdict.json").read_text())["summary"]
        self.assertEqual(top[0]["label"], "cannot be made")
        self.assertIn("But it cannot be made in al-masked-rie", (out / "report.html").read_text())
        result, _ = self.plan(text.replace("199 um", "150 um"))
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stdout.splitlines()[0], "neck: ACCEPT")

    def test_hinges_of_what_cannot_be_made(self):
        """their figures are those of the device that can be made, as far as they are alike"""
        dice = random.Random(21)
        file = self.here / "device.xml"
        file.write_text(BARE)
        sound = json.loads(run("hinge", file, "--json").stdout)["hinges"]
        for change in [enlarged, together, wide] * 2:
            file.write_text(change(BARE, dice))
            result = run("hinge", file, "--json")
            with self.subTest(change=change.__name__, seen=result.stderr):
                self.assertEqual(result.returncode, 0)
                self.assertEqual(errors(result.stderr), {})
                self.assertTrue(errors(result.stderr, "warning"))
                found = json.loads(result.stdout)["hinges"]
                self.assertEqual(len(found), len(sound))
                for a, b in zip(found, sound):
                    self.assertEqual((a["id"], a["flow"]), (b["id"], b["flow"]))
                    for x, y in zip(a["levels"], b["levels"]):
                        self.assertEqual(x["level"], y["level"])
                        if a["id"] in "AEF": # crystal directions of the others are others
                            for key in ("stiffness_Nm_per_rad", "limit_angle_rad"):
                                self.assertAlmostEqual(x[key] / y[key], 1, 9)
                        self.assertTrue(0 < x["limit_angle_rad"] < 3.2)

    def test_hinge_of_every_bad_layout(self):
        """not one error of the mechanics where only the layout is at fault"""
        for file in sorted((ROOT / "tests/bad/layout").glob("*.xml")):
            result = run("hinge", file)
            with self.subTest(file=file.name, seen=result.stderr):
                self.assertEqual(result.returncode, 0)
                self.assertEqual(errors(result.stderr), {})
                self.assertEqual(result.stdout.count("  hinge "), len(set(re.findall(
                    r'(?:<revolute id|<hinge at)="(\w+)"', file.read_text()))))

    def test_every_bad_layout_is_drawn(self):
        for file in sorted((ROOT / "tests/bad/layout").glob("*.xml")):
            result, out = self.plan(file.read_text())
            said = errors(result.stderr)
            if result.returncode != 3 or set(said) & {"202"}: # the title is only too long
                continue
            with self.subTest(file=file.name, seen=result.stderr):
                _, rows = self.drawing(out)
                self.assertEqual({code for code, _, _ in rows}, set(said))

    def test_rejected_by_its_hinges(self):
        dice = random.Random(22)
        for _ in range(2):
            force = dice.uniform(0.8, 1.1)
            result, out = self.plan(STATED.replace('fx="0.25 mN"', f'fx="{force:.3f} mN"'))
            self.assertEqual(result.returncode, 1, result.stderr)
            verdict = json.loads((out / "verdict.json").read_text())
            over = {h["id"] for h in verdict["hinges"] if h["utilisation"] >= 1}
            self.assertTrue(over)
            root, rows = self.drawing(out)
            named = {m.group(1) for _, words, _ in rows
                     if (m := re.match(r"hinge (\w+) uses", words))}
            self.assertEqual(named, over)
            rings = [c for c in root.iter(SVG + "circle") if c.get("class") == "faulty"]
            self.assertEqual(len(rings), len(over))

    def test_parts_that_meet(self):
        dice = random.Random(23)
        for _ in range(2):
            pull = dice.uniform(45, 70)
            result, out = self.plan(loose_gripper(pull=f"{pull:.1f} uN"))
            self.assertEqual(result.returncode, 1, result.stderr)
            root, rows = self.drawing(out)
            self.assertEqual(rows[0][:2], ("294", "link left and link right meet in close "
                                                  "[FW-D294]"))
            self.assertIn("would just not meet", rows[0][2])
            marked = [p for p in root.iter(SVG + "path") if p.get("class") == "faulty"]
            self.assertEqual(len(marked), 2)

    def test_requirement(self):
        stroke = random.Random(24).uniform(80, 120)
        result, out = self.plan(STAGE.replace('min="40 um"', f'min="{stroke:.1f} um"'))
        self.assertEqual(result.returncode, 1, result.stderr)
        _, rows = self.drawing(out)
        self.assertEqual([code for code, _, _ in rows], ["330"])
        self.assertIn("stroke", rows[0][1])

    def test_accepted_has_no_marks(self):
        result, out = self.plan(STATED)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(self.drawing(out)[1], [])

    def test_unreachable_workspace_is_said_once(self):
        for flows in (["al-masked-rie"], ["al-masked-rie", "copper-on-porous-silicon"]):
            text = re.sub(r'  <workspace.*/>\n', "", STATED)
            uses = "".join(f'  <flow ref="{f}"' + ("/>\n" if f.startswith("al") else
                           ' material="copper-plated" thickness="9 um"/>\n') for f in flows)
            text = re.sub(r'(  <flow ref.*/>\n)+', uses, text)
            if len(flows) == 1:
                text = re.sub(r'  <scene name="gentle[^§]*?</scene>\n', "", text)
            text = text.replace("  <die ", '  <workspace x-min="-2 mm" x-max="2 mm" '
                                'y-min="-2 mm" y-max="2 mm" phi-min="-1 deg" phi-max="1 deg"/>\n  <die ')
            file = self.here / "device.xml"
            file.write_text(text)
            result = run("check", file, "--advice", "none")
            self.assertEqual(result.returncode, 1, result.stderr)
            self.assertEqual(errors(result.stderr, "warning").get("201"), 1, result.stderr)


if __name__ == "__main__":
    unittest.main()
