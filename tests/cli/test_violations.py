#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A mask that breaks design rules: no mask, but the list, KLayout's database and the marked outlines; KLayout reads both."""
import collections
import json
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

from common import FLOWS, GALLERY, ROOT, run

RULES = """
<rule kind="notch" layer="device" min="9 um" source="try it"/>
<rule kind="angle" layer="device" min="91 deg" source="try it"/>
<rule kind="edge" layer="device" of="outline" min="300 nm" source="try it" severity="warning"/>
<rule kind="density" layer="device" max="60 %" window="600 um" source="try it" severity="warning"/>
<rule kind="enclosure" layer="marks" inside="device" min="40 um" source="try it" severity="warning"/>
"""
COMB = """<device xmlns="urn:flexwright:device:1" name="drawn">
<material ref="silicon-100" thickness="50 um"/><limits safety-factor="2"/><flow ref="%s" carrier="insulating"/>
<mechanism>
<body id="stage" x="0 um" y="0 um"><bar x="0 um" y="0 um" to-x="0 um" to-y="900 um" width="120 um"/><plate x="0 um" y="950 um" width="500 um" height="300 um"/></body>
<revolute id="A" a="ground" a-x="0 um" a-y="0 um" b="stage" b-x="0 um" b-y="0 um" hinge="leaf"/></mechanism>
<flexure id="leaf" kind="leaf" length="300 um" width="10 um"/>
<scene name="push" duration="20 ms"><comb-drive id="comb" kind="comb" on="stage" x="0 um" y="1150 um" direction="90 deg" fingers="10" gap="%s um" overlap="20 um" length="50 um" voltage="10 V"/></scene></device>"""
ENDINGS = (".violations.gds", ".violations.json", ".violations.lyrdb")
READ = """
import json, pya
r = pya.ReportDatabase("")
r.load("{stem}.violations.lyrdb")
layout = pya.Layout()
layout.read("{stem}.violations.gds")
top = layout.top_cell()
shapes = {{}}
for i in layout.layer_indexes():
    info = layout.get_info(i)
    boxes = [s.dbbox() for s in top.shapes(i).each() if not s.is_text()]
    shapes["%d/%d" % (info.layer, info.datatype)] = [[b.left, b.bottom, b.right, b.top] for b in boxes]
items = [[r.category_by_id(i.category_id()).path(), [str(v) for v in i.each_value()]] for i in r.each_item()]
print(json.dumps({{"top": r.top_cell_name, "cell": top.name, "items": items, "shapes": shapes}}))
"""


class Violations(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.here = pathlib.Path(self.folder.name)

    def data(self, rules):
        data = self.here / "data"
        for part in ("masks", "processes"):
            shutil.copytree(ROOT / part, data / part, ignore=shutil.ignore_patterns("gallery"))
        table = data / "masks" / f"{FLOWS[0]}.xml"
        text = table.read_text().replace("</mask-table>", rules + "</mask-table>")
        table.write_text(text)
        return dict(os.environ, FLEXWRIGHT_DATA=str(data))

    def files(self, out):
        return {p.name[len(flow):] for flow in FLOWS[:1] for p in (out / "masks").iterdir() if p.name.startswith(flow)}

    def test_what_has_to_be_drawn_is_said(self):
        """of a space of 4 um and a bias of 1.1 um an edge 6.2 um; what the page's tool and its form take at first comes out in every flow"""
        fast = ("--corners", "none", "--advice", "none", "--hinge-model", "revolute")
        said = run("check", "-", *fast, input=COMB % (FLOWS[0], "5")).stderr
        self.assertRegex(said, r"space of 2\.8 um at .*\(the mask has 2\.2 um less than is drawn: 6\.2 um drawn will do\) \[FW-D145\]")
        first = {re.search(pattern, (ROOT / "web/src" / file).read_text()).group(1) for file, pattern in
                 (("tools.js", r'size\("gap", "gap", ([\d.]+)\)'), ("adding.js", r'"comb-drive": .*gap: "([\d.]+) um"'))}
        for flow in sorted(p.stem for p in (ROOT / "masks").glob("*.xml")):
            for gap in {"6.2"} | first if flow == FLOWS[0] else first:
                done = run("check", "-", *fast, input=COMB % (flow, gap))
                self.assertNotIn("FW-D145", done.stderr, (flow, gap))

    def test_a_frame_of_any_width_keeps_the_rules(self):
        """its brackets, marks and title: 17 widths from 40 to 140 um, in either flow"""
        fast = ["--corners", "none", "--advice", "none", "--accuracy", "3e-2", "--hinge-model", "revolute", "--mask-format", "gds"]
        for width in [40 + 6.25 * i for i in range(17)]:
            out = self.here / f"{width:g}"
            result = run("mask", GALLERY, "--force", *fast, "--set", f"die/@frame={width:g} um", "-o", out)
            self.assertNotRegex(result.stderr, r"FW-D1(4\d|5\d)\b", f"frame of {width:g} um")
            for flow in FLOWS:
                self.assertFalse(json.loads((out / "masks" / f"{flow}.json").read_text())["rejected"], (width, flow))

    def test_all_are_listed_and_klayout_reads_them(self):
        out = self.here / "out"
        result = run("mask", GALLERY, "-o", out, env=self.data(RULES))
        self.assertRegex(result.stdout, r"cannot be made: in al-masked-rie: its mask: .*try it.* \[FW-D145\]; and \d+ more among")
        self.assertEqual({n for n in self.files(out) if not n.startswith("-coupons")}, set(ENDINGS))
        self.assertTrue((out / "masks" / f"{FLOWS[1]}.gds").exists())
        listed = json.loads((out / "masks" / f"{FLOWS[0]}.violations.json").read_text())
        count = collections.Counter(f["rule"] for f in listed["findings"])
        self.assertTrue(all(count[k] for k in ("notch", "angle", "density", "enclosure")), count)
        errors = sum(f["severity"] == "error" for f in listed["findings"])
        self.assertEqual((listed["errors"], listed["warnings"]), (errors, len(listed["findings"]) - errors))
        self.assertEqual(errors, count["notch"] + count["angle"])
        page = (ROOT / "docs/reference/json.md").read_text()
        for f in listed["findings"]:
            self.assertFalse([key for key in f if f"`{key}`" not in page])
            self.assertEqual(f["reason"], "try it")
            self.assertLess(min(f["value"] / f["needed"], f["needed"] / f["value"]), 1)
        if not shutil.which("klayout"):
            self.skipTest("klayout is not installed")
        script = self.here / "read.py"
        script.write_text(READ.format(stem=out / "masks" / FLOWS[0]))
        read = subprocess.run(["klayout", "-b", "-r", script], capture_output=True, text=True, timeout=120,
                              env=dict(os.environ, QT_QPA_PLATFORM="offscreen", LC_ALL="C"))
        self.assertEqual(read.returncode, 0, read.stderr)
        found = json.loads(read.stdout.splitlines()[-1])
        self.assertEqual(found["top"], found["cell"])
        self.assertEqual(len(found["items"]), len(listed["findings"]))
        kinds = collections.Counter(path.strip("'").split()[0] for path, _ in found["items"])
        self.assertEqual(kinds, count)
        marker = listed["marker_layer"]
        marks = [box for name, boxes in found["shapes"].items() if name.startswith(f"{marker}/") for box in boxes]
        self.assertEqual(len(marks), len(listed["findings"]))
        for f in listed["findings"]:
            self.assertTrue(any(all(b[0] - 1e-3 <= x <= b[2] + 1e-3 and b[1] - 1e-3 <= y <= b[3] + 1e-3
                                    for x, y in f["at_um"]) for b in marks), f)
        self.assertGreater(len(found["shapes"]["1/0"]), 10)

    def test_forced_masks_say_so(self):
        out = self.here / "out"
        run("mask", GALLERY, "-o", out, "--force", env=self.data(RULES))
        self.assertLessEqual(set(ENDINGS) | {".gds", ".svg", ".json"}, self.files(out))
        certificate = json.loads((out / "masks" / f"{FLOWS[0]}.json").read_text())
        listed = json.loads((out / "masks" / f"{FLOWS[0]}.violations.json").read_text())
        self.assertTrue(certificate["rejected"])
        self.assertTrue(certificate["cell"].endswith("_REJECTED"))
        self.assertEqual(certificate["findings"], listed["findings"])
        self.assertFalse(any("above the rules" in p for p in certificate["proven"]))

    def test_warnings_let_the_mask_pass(self):
        out = self.here / "out"
        rules = "\n".join(r for r in RULES.splitlines() if "warning" in r)
        result = run("mask", GALLERY, "-o", out, "--json", env=self.data(rules))
        said = json.loads(result.stdout)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(len(said["masks"]), 2)
        self.assertEqual([v["flow"] for v in said["violations"]], [FLOWS[0]])
        certificate = said["masks"][0]
        self.assertFalse(certificate["rejected"])
        self.assertEqual(certificate["findings"], said["violations"][0]["findings"])
        self.assertEqual({f["severity"] for f in certificate["findings"]}, {"warning"})

    def test_the_report_lists_them(self):
        out = self.here / "out"
        run("plan", GALLERY, "-o", out, env=self.data(RULES))
        report = (out / "report.html").read_text()
        listed = json.loads((out / "masks" / f"{FLOWS[0]}.violations.json").read_text())
        self.assertIn("Where design rules are broken", report)
        rows = report.split("Where design rules are broken", 1)[1].split("</table>", 1)[0].count("<tr>") - 1
        self.assertEqual(rows, len(listed["findings"]))

    def test_a_clean_mask_has_none(self):
        out = self.here / "out"
        result = run("mask", GALLERY, "-o", out, "--json")
        said = json.loads(result.stdout)
        self.assertEqual(said["violations"], [])
        self.assertTrue(all(m["findings"] == [] for m in said["masks"]))
        self.assertFalse([p for p in out.rglob("*violations*")])

    def test_heads_of_leaves_beside_what_is_about_as_wide(self):
        """a block of 66 to 220 um, 40 um deep, and a plate or a bar beside it: a step of less than two corners, a slit before the plate's edge and a shoulder
        that met that edge left hollows that no mask has, in 25 of 90 devices"""
        device = '''<device xmlns="urn:flexwright:device:1" name="drawn"><material ref="silicon-100" thickness="50 um"/><limits safety-factor="2"/>
<flow ref="al-masked-rie"/><flexure id="leaf" kind="leaf" length="300 um" width="%g um"/><mechanism>%s
<revolute id="A" a="ground" b="stage" b-x="%g um" b-y="%g um" hinge="leaf" axis="0 deg"/></mechanism>
<scene name="push" duration="20 ms"><force on="stage" fx="1 uN"/></scene></device>'''
        plate = '<body id="stage" x="%g um" y="%g um" plate-width="%g um" plate-height="500 um"/>'
        bar = '<body id="stage" x="0 um" y="0 um"><bar x="0 um" y="0 um" to-x="0 um" to-y="900 um" width="%g um"/></body>'
        for leaf in (6, 10, 20):
            for wide in range(60, 240, 12):
                kinds = [(plate % (0, y, wide), 0, -y) for y in (400, 440, 500)] + [(plate % (-200, 440, 400 + wide), 200, -440), (bar % wide, 0, 0)]
                for body, x, y in kinds[wide % 24 // 12::2]:
                    done = run("check", "-", "--corners", "none", "--advice", "none", "--hinge-model", "revolute", "--effects", "none", input=device % (leaf, body, x, y))
                    for code in ("FW-D138", "FW-D144", "FW-D145"):
                        self.assertNotIn(code, done.stderr, (leaf, wide, body))

    def test_a_wrong_rule_is_told_at_its_place(self):
        result = run("mask", GALLERY, "-o", self.here / "out",
                     env=self.data('<rule kind="widht" layer="device" min="4 um" source="s"/>'))
        self.assertEqual(result.returncode, 3)
        self.assertIn("[FW-D135]", result.stderr)
        self.assertIn("did you mean 'width'", result.stderr)


if __name__ == "__main__":
    unittest.main()
