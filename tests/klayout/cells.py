#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""cells.py PROGRAM: drawings of others on our masks, against KLayout, which draws them, places them and compares.

A cell with references, arrays, paths and holes goes onto the mask, onto lettering and onto a layer of its own; masks that the program wrote come back
as they are (GDSII) and within the tolerance of arcs (DXF); every format and the plate as it is written have it, and the manifest its hash; what must
not be touched, is too large, damaged or misplaced is refused with the line of the device file and the byte of the drawing, and nothing is written."""
import hashlib
import json
import math
import pathlib
import random
import resource
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "accept"))
import kl_asked  # noqa: E402

PROGRAM = pathlib.Path(sys.argv.pop(1)).resolve()
ROOT = pathlib.Path(__file__).resolve().parents[2]
SIX = ROOT / "docs/gallery/reference-six-bar/device.xml"
FLOW = "al-masked-rie"
FAST = ["--flow", FLOW, "--corners", "none", "--advice", "none", "--hinge-model", "revolute", "--accuracy", "3e-2", "--force", "-q"]
DRAW = """
import pya
l = pya.Layout(); l.dbu = 0.001
a = l.layer(1, 0); b = l.layer(2, 0); c = l.layer(5, 2)
leaf = l.create_cell("LEAF")
leaf.shapes(a).insert(pya.Box(0, 0, 60000, 40000))
leaf.shapes(b).insert(pya.Box(12000, 12000, 48000, 28000))
leaf.shapes(a).insert(pya.Path([pya.Point(0, 60000), pya.Point(40000, 60000), pya.Point(40000, 90000)], 12000, 6000, 6000))
leaf.shapes(a).insert(pya.Region(pya.Box(100000, 0, 160000, 60000)) - pya.Region(pya.Box(115000, 15000, 145000, 45000)))
leaf.shapes(c).insert(pya.Text("not a shape", pya.Trans(0, 0)))
top = l.create_cell("LOGO")
top.insert(pya.CellInstArray(leaf.cell_index(), pya.Trans(1, True, 0, 0)))
top.insert(pya.CellInstArray(leaf.cell_index(), pya.ICplxTrans(1.5, 180, True, 200000, 0)))
top.insert(pya.CellInstArray(leaf.cell_index(), pya.Trans(0, False, 400000, 0), pya.Vector(200000, 0), pya.Vector(0, 120000), 2, 2))
o = pya.SaveLayoutOptions(); l.write("logo.gds", o)
o.format = "OASIS"; l.write("logo.oas", o)
pya.Application.instance().exit(0)
"""
# areas of differences in nm2: of layers of a file against what is expected, both merged
COMPARE = """
import json, pya
known = {}
def layer(file, number, at=None):
    if file not in known:
        known[file] = pya.Layout(); known[file].read(file)
    l = known[file]; i = l.find_layer(*number)
    r = pya.Region() if i is None else pya.Region(l.top_cell().begin_shapes_rec(i))
    r.merged_semantics = True
    if at: r = r.transformed(pya.ICplxTrans(at[4] if len(at) > 4 else 1, at[2], at[3], at[0], at[1]))
    return r.merged()
out = []
for file, number, parts in json.loads(open(jobs).read()):
    want = pya.Region()
    for p in parts: want += layer(*p)
    got = layer(file, number); want.merge()
    x = got ^ want
    out.append([got.area(), x.area(), x.sized(-4, 2).area()])
open(result, "w").write(json.dumps(out))
pya.Application.instance().exit(0)
"""


def klayout(script, where, **variables):
    Cells.klayout.run(script, where, variables)


class Cells(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.where = pathlib.Path(tempfile.mkdtemp())
        cls.klayout = kl_asked.Open()
        klayout(DRAW, cls.where)
        cls.own("plain", "")
        for ending in ("gds", "dxf"):
            shutil.copy(cls.where / ("plain/masks/%s.%s" % (FLOW, ending)), cls.where / ("own." + ending))

    @classmethod
    def tearDownClass(cls):
        cls.klayout.close()
        shutil.rmtree(cls.where)

    @classmethod
    def make(cls, name, cells, wafer="", options=(), source=SIX, formats="all", fast=FAST):
        text = source.read_text().replace("<die ", cells + "\n" + wafer + "<die ")
        (cls.where / (name + ".xml")).write_text(text)
        return subprocess.run([PROGRAM, "mask", name + ".xml", "-o", name, "--mask-format", formats, *fast, *options], cwd=cls.where, capture_output=True,
                              text=True, check=False, timeout=240)

    @classmethod
    def own(cls, name, cells, wafer="", formats="all"):
        done = cls.make(name, cells, wafer, formats=formats)
        assert done.returncode == 0, done.stderr
        return done

    def compare(self, jobs):
        (self.where / "jobs.json").write_text(json.dumps(jobs))
        klayout(COMPARE, self.where, jobs="jobs.json", result="result.json")
        return json.loads((self.where / "result.json").read_text())

    def test_it_is_on_the_mask_as_it_was_drawn(self):
        self.own("logo", '<cell file="logo.gds" x="-0.6 mm" y="3.2 mm" layers="1/0>mask; 1/0>77/3; 2/0>text"/>')
        self.own("turned", '<cell file="logo.gds" cell="LEAF" x="-0.6 mm" y="3.3 mm" angle="90 deg" mirror="yes" layers="1/0>mask"/>')
        at, plain = [-600000, 3200000, 0, False], "plain/masks/%s.gds" % FLOW
        jobs = []
        for file in ("logo/masks/%s.gds", "logo/masks/%s.oas"):
            file = file % FLOW
            jobs += [[file, [1, 0], [[plain, [1, 0]], ["logo.gds", [1, 0], at]]], [file, [77, 3], [["logo.gds", [1, 0], at]]],
                     [file, [2, 0], [[plain, [2, 0]], ["logo.gds", [2, 0], at]]]]
        # LEAF alone: KLayout mirrors about x and then turns, as we do
        (self.where / "leaf.json").write_text("")
        klayout("import pya\nl = pya.Layout(); l.read('logo.gds')\nl.prune_cell(l.cell('LOGO').cell_index(), 0)\nl.write('leaf.gds')\n"
                "pya.Application.instance().exit(0)\n", self.where)
        jobs.append(["turned/masks/%s.gds" % FLOW, [1, 0], [[plain, [1, 0]], ["leaf.gds", [1, 0], [-600000, 3300000, 90, True]]]])
        for (area, off, _), job in zip(self.compare(jobs), jobs):
            self.assertGreater(area, 0, job)
            self.assertEqual(off, 0, job)
        masks = self.where / "logo/masks"
        svg, dxf = (masks / (FLOW + ".svg")).read_text(), (masks / (FLOW + ".dxf")).read_text()
        for text, says in ((svg, 'data-gds="77/3"'), (dxf, "CELL_77_3"), ((masks / (FLOW + ".lyp")).read_text(), "77/3")):
            self.assertTrue(says in text, says)
        certificate = {y["gds"]: y for y in json.loads((masks / (FLOW + ".json")).read_text())["layers"]}
        before = {y["gds"]: y for y in json.loads((self.where / "plain/masks" / (FLOW + ".json")).read_text())["layers"]}
        logo = self.compare([["logo.gds", [1, 0], []]])[0][0] * 1e-6
        self.assertAlmostEqual(certificate["1/0"]["area_um2"] - before["1/0"]["area_um2"], logo, delta=1e-3)
        self.assertAlmostEqual(certificate["77/3"]["area_um2"], logo, delta=1e-3)
        manifest = json.loads((self.where / "logo/manifest.json").read_text())
        self.assertIn(hashlib.sha256((self.where / "logo.gds").read_bytes()).hexdigest(), json.dumps(manifest))

    def test_own_files_come_back(self):
        numbers = {1: 101, 2: 102, 3: 103, 4: 104}
        self.own("back", '<cell file="own.gds" layers="%s"/><cell id="dxf" file="own.dxf" layers="AL_MASK>111/0; TEXT>112/0"/>' %
                 "; ".join("%d/0>%d/0" % p for p in numbers.items()))
        file = "back/masks/%s.gds" % FLOW
        jobs = [[file, [to, 0], [["own.gds", [of, 0]]]] for of, to in numbers.items()]
        for area, off, _ in self.compare(jobs):
            self.assertGreater(area, 0)
            self.assertEqual(off, 0)
        for area, off, wide in self.compare([[file, [111, 0], [["own.gds", [1, 0]]]], [file, [112, 0], [["own.gds", [2, 0]]]]]):
            self.assertGreater(area, 0)
            self.assertLess(off, 1e-5 * area)
            self.assertEqual(wide, 0)  # nothing wider than the chords of both, 5 nm each

    def test_own_coupons_come_back(self):
        """a die of test structures, more than four thousand lines on one layer of its DXF file"""
        shutil.copy(self.where / ("plain/masks/%s-coupons.dxf" % FLOW), self.where / "coupons.dxf")
        self.own("coupons", '<cell file="coupons.dxf" layers="AL_MASK>111/0; TEXT>112/0"/>', formats="gds")
        drawn = "plain/masks/%s-coupons.gds" % FLOW
        for area, off, _ in self.compare([["coupons/masks/%s.gds" % FLOW, [110 + k, 0], [[drawn, [k, 0]]]] for k in (1, 2)]):
            self.assertGreater(area, 0)
            self.assertLess(off, 1e-5 * area)

    def test_blocks_of_dxf_are_placed(self):
        """blocks within blocks, turned, mirrored, larger and in rows, as KLayout has them"""
        def insert(name, x, y, **more):
            codes = {"sx": 41, "sy": 42, "dx": 44, "dy": 45, "turn": 50, "columns": 70, "rows": 71}
            return "0\nINSERT\n8\nA\n2\n%s\n10\n%g\n20\n%g\n" % (name, x, y) + "".join("%d\n%g\n" % (codes[k], v) for k, v in more.items())

        def block(name, x, y, content):
            return "0\nBLOCK\n8\n0\n2\n%s\n70\n0\n10\n%g\n20\n%g\n3\n%s\n%s0\nENDBLK\n8\n0\n" % (name, x, y, name, content)

        flag = "0\nLWPOLYLINE\n8\n%s\n90\n5\n70\n1\n10\n0\n20\n0\n10\n40\n20\n0\n42\n0.5\n10\n40\n20\n30\n10\n12\n20\n17\n10\n0\n20\n60\n"
        text = ("0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n13\n0\nENDSEC\n0\nSECTION\n2\nBLOCKS\n" + block("FLAG", 3, 5, flag % "A")
                + block("ROW", 10, 0, insert("FLAG", 0, 0, columns=3, dx=90, rows=2, dy=120, turn=20) + insert("FLAG", 500, 40, sx=-1.5, sy=1.5, turn=250))
                + "0\nENDSEC\n0\nSECTION\n2\nENTITIES\n" + insert("ROW", 100, 200, turn=-35) + insert("ROW", 900, 900, sx=0.5, sy=-0.5)
                + insert("FLAG", -300, 0) + "0\nENDSEC\n0\nEOF\n")
        (self.where / "blocks.dxf").write_text(text)
        klayout("import pya\no = pya.LoadLayoutOptions(); o.dxf_dbu = 0.001; o.dxf_unit = 1.0; o.dxf_circle_points = 1000; o.dxf_polyline_mode = 3\n"
                "l = pya.Layout(); l.read('blocks.dxf', o)\n"
                "i = [k for k in l.layer_indexes() if not pya.Region(l.top_cell().begin_shapes_rec(k)).is_empty()][0]\n"
                "m = pya.Layout(); m.dbu = l.dbu\nm.create_cell('T').shapes(m.layer(9, 0)).insert(pya.Region(l.top_cell().begin_shapes_rec(i)).merged())\n"
                "m.write('blocks.gds')\npya.Application.instance().exit(0)\n", self.where)
        self.own("blocks", '<cell file="blocks.dxf" x="0.2 mm" y="0.4 mm" layers="A>77/0"/>')
        (area, off, wide), = self.compare([["blocks/masks/%s.gds" % FLOW, [77, 0], [["blocks.gds", [9, 0], [200000, 400000, 0, False]]]]])
        self.assertGreater(area, 14 * 1000 * 1e6)
        self.assertLess(off, 2e-3 * area)
        self.assertEqual(wide, 0)

    def test_what_is_passed_over_is_told(self):
        """of a cell as of an outline: fillings, remarks and what the drawing does not show are told with their lines"""
        square = "0\nLWPOLYLINE\n8\nA\n90\n4\n70\n1\n%s" + "".join("10\n%d\n20\n%d\n" % p for p in ((0, 0), (50, 0), (50, 50), (0, 50)))
        (self.where / "told.dxf").write_text("0\nSECTION\n2\nENTITIES\n" + square % "" + square.replace("10\n", "10\n1") % "60\n1\n"
                                             + "0\nHATCH\n8\nA\n0\nXLINE\n8\nA\n0\nENDSEC\n0\nEOF\n")
        done = self.make("told", '<cell file="told.dxf" unit="um" layers="A>77/0"/>', formats="gds", fast=[o for o in FAST if o != "-q"])
        for says in ("told.dxf, line 29: LWPOLYLINE on layer 'A' is invisible", "HATCH on layer 'A' is not taken", "XLINE on layer 'A' is not taken"):
            self.assertIn(says, done.stderr)

    def test_wafer(self):
        wafer = '<wafer diameter="50.8 mm"><cell file="logo.gds" x="%s mm" y="-32 mm" layers="1/0>mask"/></wafer>'
        self.own("wafer", "", wafer % "5", "gds")
        self.own("empty", "", '<wafer diameter="50.8 mm"/>', "gds")
        at = [5000000, -32000000, 0, False]
        (area, off, _), = self.compare([["wafer/masks/%s-wafer.gds" % FLOW, [1, 0], [["empty/masks/%s-wafer.gds" % FLOW, [1, 0]], ["logo.gds", [1, 0], at]]]])
        self.assertGreater(area, 0)
        self.assertEqual(off, 0)
        done = self.make("over", "", (wafer % "0").replace("-32", "0"))
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("FW-D571", done.stderr)

    def test_scaled_wafer(self):
        """a cell on the wafer is as large on the written plate as the order's scale has it, mirrored as it is; one beyond the wafer stays, and that is told"""
        wafer = '<wafer diameter="50.8 mm">%s</wafer><order scale="1.0008" mirror="yes"/>'
        self.own("bare", "", wafer % "", "gds")
        rows = [row.split(",") for row in (self.where / "bare/masks" / (FLOW + "-wafer.csv")).read_text().splitlines()[1:]]
        grid = json.loads((self.where / "bare/masks" / (FLOW + "-wafer.json")).read_text())["grid"]
        w, h = 0.5 * grid["die_x_mm"] + 0.1, 0.5 * grid["die_y_mm"] + 0.1
        middles = [(float(row[3]), float(row[4])) for row in rows]
        x, y = max(((x, y) for x in range(-20, 20) for y in range(10, 24) if math.hypot(max(abs(x), abs(x + 0.9)), y + 0.4) < 25  # of the logo's box
                    and not any(x < a + w and x + 0.9 > a - w and y - 0.2 < b + h and y + 0.4 > b - h for a, b in middles)),
                   key=lambda p: math.hypot(*p))
        cell = '<cell id="%s" file="logo.gds" x="%g mm" y="%g mm" layers="1/0>mask"/>'
        done = self.make("scaled", "", wafer % (cell % ("on", x, y) + cell % ("beyond", 5, -32)), formats="gds,oasis", fast=[o for o in FAST if o != "-q"])
        told = [line for line in done.stderr.splitlines() if "FW-D704" in line]
        self.assertEqual((len(told), "cell beyond" in "".join(told)), (1, True), done.stderr)
        bare, k = ["bare/masks/%s-plate.gds" % FLOW, [1, 0]], 1.0008
        parts = [bare, ["logo.gds", [1, 0], [round(-1e6 * k * x), round(1e6 * k * y), 180, True, k]], ["logo.gds", [1, 0], [-5000000, -32000000, 180, True]]]
        for ending in ("gds", "oas"):
            (area, off, thick), (before, _, _) = self.compare([["scaled/masks/%s-plate.%s" % (FLOW, ending), [1, 0], parts], [*bare, []]])
            self.assertGreater(area, before)
            self.assertEqual(thick, 0)
            self.assertLess(off, 1e7)  # the grid along the logo's edges: it is 1.6 um larger, as they are long 5e9 nm2
        far = self.make("far", "", wafer.replace("1.0008", "1.1") % (cell % ("on", x, y)), formats="gds")
        self.assertIn("cell on of <wafer> reaches", far.stderr)

    def test_bad_ones_are_refused(self):
        good = (self.where / "logo.gds").read_bytes()
        (self.where / "cut.gds").write_bytes(good[: len(good) // 2])
        (self.where / "block.dxf").write_text("0\nSECTION\n2\nENTITIES\n0\nINSERT\n8\nA\n2\nB\n10\n0\n20\n0\n0\nENDSEC\n0\nEOF\n")
        (self.where / "empty.gds").write_bytes(b"")
        (self.where / "words.gds").write_bytes(b"a note\n" * 9)
        klayout("""
import pya
l = pya.Layout(); l.dbu = 0.001; c = l.create_cell("T"); c.shapes(l.layer(1, 0)).insert(pya.Polygon([pya.Point(x, 0) for x in (0, 50000, 90000)], True))
l.write("flat.gds")
pya.Application.instance().exit(0)
""", self.where)
        for cell, number, says in (
                ('file="empty.gds" layers="1/0>text"', 565, "no GDSII file as it should be: it is empty"),
                ('file="words.gds" layers="1/0>text"', 565, "no GDSII file as it should be: it does not begin"),
                ('file="flat.gds" layers="1/0>text"', 568, "has no area"),
                ('file="block.dxf" unit="um" layers="A>77/0"', 565, "line 5, byte 21: block 'B' is not in the file"),
                ('file="cut.gds" layers="1/0>77/0"', 565, "byte "),
                ('file="logo.oas" layers="1/0>77/0"', 569, "KLayout"),
                ('file="logo.gds" layers="1/0>77/0"  x="20 mm"', 571, "leaves the die"),
                ('file="logo.gds" layers="1/0>mask" x="1.4 mm" y="2.9 mm"', 572, "touches"),
                ('file="logo.gds" layers="1/0>nowhere"', 570, "mask, "),
                ('file="logo.gds" layers="9/0>mask"', 568, "on layer 9/0"),
                ('file="logo.gds" layers="1/0"', 568, "without '>'"),
                ('file="logo.gds"', 568, "say which go where"),
                ('file="../logo.gds"', 310, "beside the device file"),
                ('file="missing.gds"', 310, "missing.gds"),
                ('file="logo.gds" layers="1/0>63/0"', 570, "never exposed")):
            shutil.rmtree(self.where / "bad", ignore_errors=True)
            done = self.make("bad", "<cell %s/>" % cell)
            self.assertEqual(done.returncode, 3, (cell, done.stderr))
            lines = [y for y in done.stderr.splitlines() if "FW-D%d" % number in y]
            self.assertTrue(lines and says in lines[0], (cell, done.stderr))
            line = 1 + (self.where / "bad.xml").read_text().split("<cell")[0].count("\n")
            self.assertTrue(lines[0].startswith("bad.xml:%d:" % line), (cell, lines[0]))
            self.assertFalse((self.where / "bad").exists())

    def test_a_dense_one_is_told_in_time(self):
        """a saw of 4000 teeth of 20 nm: millions of pairs break the rules; that is said, before its corners, and not looked for to the end"""
        klayout("""
import pya
l = pya.Layout(); l.dbu = 0.001; c = l.create_cell("T")
c.shapes(l.layer(1, 0)).insert(pya.Polygon([pya.Point(20 * k, 5000 * (k % 2)) for k in range(4000)] + [pya.Point(80000, 90000)]))
l.write("saw.gds")
pya.Application.instance().exit(0)
""", self.where)
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        done = self.make("saw", '<cell file="saw.gds" x="-0.6 mm" y="3.2 mm" layers="1/0>text"/>')
        self.assertLess(resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before, 6)  # 0.8 s here; minutes where all pairs are looked at, 8 s where each proposed gap draws it anew
        self.assertIn("FW-D592", done.stderr)
        self.assertEqual(done.stderr.count("FW-D153"), 0)  # a warning, and -q
        self.make("saw", '<cell file="saw.gds" x="-0.6 mm" y="3.2 mm" layers="1/0>text"/>', options=("--force",))
        masks = self.where / "saw" / "masks"
        cut = [p for p in masks.glob("*.order.txt") if "edges are too many to be looked through (FW-D592)" in p.read_text()]
        sure = [p for p in masks.glob("*.json") if '"unfinished": true' in p.read_text()]
        self.assertTrue(cut and any(p.name.endswith(".order.json") for p in sure), (cut, sure))

    def test_it_becomes_one_with_the_frame(self):
        """random pads, rings and stars over edges, corners and the seam of the frame: on the mask their union, each place once; a
        layer of the cell's own has the cell whole"""
        rng = random.Random(16)
        cells, parts, script = "", [["plain/masks/%s.gds" % FLOW, [1, 0]]], "import pya\nl = pya.Layout(); l.dbu = 0.001; a = l.layer(1, 0)\n"
        for k, (x, y) in enumerate(((-897, 3000), (-895, 3690), (200, 3697), (3300, 3690), (4000, 2400), (-897, 1548), (-900, 700), (2500, -500), (4001, 400))):
            rays = rng.randint(4, 9)
            star = [(round(1e3 * r * math.cos(w)), round(1e3 * r * math.sin(w))) for r, w in
                    ((rng.uniform(45, 75), 2 * math.pi * (n + rng.uniform(-0.2, 0.2)) / rays) for n in range(rays))]
            script += "c = l.create_cell('T%d'); r = pya.Region(pya.Polygon([pya.Point(x, y) for x, y in %r]))\n" % (k, star)
            if k % 2:
                script += "r -= pya.Region(pya.Polygon.ellipse(pya.Box(-22000, -22000, 22000, 22000), 24))\n"
            script += "c.shapes(a).insert(r); o = pya.Layout(); o.dbu = 0.001; t = o.create_cell('T%d'); t.shapes(o.layer(1, 0)).insert(r); o.write('t%d.gds')\n" % (k, k)
            at = (x + rng.uniform(-30, 30), y + rng.uniform(-30, 30))
            at = [round(1e3 * v) for v in at]
            cells += '<cell file="stars.gds" cell="T%d" x="%d nm" y="%d nm" layers="1/0>mask; 1/0>77/3"/>' % (k, *at)
            parts.append(["t%d.gds" % k, [1, 0], [*at, 0, False]])
        klayout(script + "l.write('stars.gds')\npya.Application.instance().exit(0)\n", self.where)
        done = self.make("united", cells)
        self.assertNotIn("FW-D152", done.stderr)
        self.assertNotIn("FW-D146", done.stderr)
        self.assertNotIn("FW-D574", done.stderr)
        file = "united/masks/%s.gds" % FLOW
        (area, off, thick), (own, off_own, _) = self.compare([[file, [1, 0], parts], [file, [77, 3], parts[1:]]])
        self.assertLess(off, 20000)  # nm2: where a leaning edge ends on the frame it turns by less than 1 nm
        self.assertEqual((thick, off_own), (0, 0))
        layers = {y["gds"]: y for y in json.loads((self.where / "united/masks" / (FLOW + ".json")).read_text())["layers"]}
        self.assertAlmostEqual(layers["1/0"]["polygon_area_um2"], 1e-6 * area, delta=1e-3)  # counted once

    def test_bias_of_holes(self):
        """rings, plates with several holes and islands in holes, turned: biased as KLayout sizes them, though holes are cut open; what would vanish is refused"""
        rng, cells, parts = random.Random(31), "", [["plain/masks/%s.gds" % FLOW, [1, 0]]]
        script = ("import pya\nl = pya.Layout(); l.dbu = 0.001\ndef ring(x, y, r, n, turn):\n  import math\n"
                  "  return pya.Polygon([pya.Point(round(x + r * math.cos(turn + 6.283185307 * k / n)), round(y + r * math.sin(turn + 6.283185307 * k / n))) for k in range(n)])\n")
        bias = json.loads((self.where / "plain/masks" / (FLOW + ".json")).read_text())["bias_um_per_edge"]
        for k in range(5):
            rings = [(0, 0, 70000, rng.randint(6, 24)), (-25000, 5000, rng.randint(15000, 24000), rng.randint(5, 20)), (30000, -4000, 20000, rng.randint(5, 20))]
            rings.append((30000, -4000, 9000, rng.randint(5, 9)))
            at = (round(1e3 * (-820 + 160 * k)), 3450000)
            turn = rng.choice((0, 17, 90, 211.5))
            script += "c = l.create_cell('T%d'); r = pya.Region(); put = pya.ICplxTrans(1, %g, False, %d, %d)\n" % (k, turn, *at)
            for i, (x, y, radius, n) in enumerate(rings):
                script += "r %s= pya.Region(ring(%d, %d, %d, %d, %g))\n" % ("+--+"[i], x, y, radius, n, rng.uniform(0, 1))
            script += ("c.shapes(l.layer(1, 0)).insert(r); w = pya.Layout(); w.dbu = 0.001\n"
                       "w.create_cell('T').shapes(w.layer(1, 0)).insert(r.transformed(put).sized(%d, 2)); w.write('sized%d.gds')\n" % (round(1e3 * bias), k))
            cells += '<cell file="holes.gds" cell="T%d" x="%d nm" y="%d nm" angle="%g deg" bias="yes" layers="1/0>mask"/>' % (k, *at, turn)
            parts.append(["sized%d.gds" % k, [1, 0]])
        script += "c = l.create_cell('FINE'); c.shapes(l.layer(1, 0)).insert(pya.Region(pya.Box(0, 0, 60000, 60000)) - pya.Region(pya.Box(20000, 20000, 22000, 40000)))\n"
        klayout(script + "l.write('holes.gds')\npya.Application.instance().exit(0)\n", self.where)
        done = self.make("holes", cells, formats="gds")
        for number in (143, 144, 145, 146, 152):
            self.assertNotIn("FW-D%d" % number, done.stderr)
        (area, off, thick), (whole, _, _) = self.compare([["holes/masks/%s.gds" % FLOW, [1, 0], parts], ["plain/masks/%s.gds" % FLOW, [1, 0], []]])
        self.assertGreater(area, whole + 5 * 8e9)
        self.assertEqual(thick, 0)
        self.assertLess(off, 1e7)  # nm2: turned points are rounded here before they are moved, there behind it
        done = self.make("fine", '<cell file="holes.gds" cell="FINE" x="-0.8 mm" y="3.4 mm" bias="yes" layers="1/0>mask"/>', formats="gds", options=())
        self.assertIn("cell FINE cannot take the bias of 1.1 um", done.stderr)

    def test_rules_hold_for_it(self):
        """two micrometres beside the frame: refused; a strip of the frame of two micrometres that sticks out of it, too"""
        for k, at in enumerate(("-0.8952 mm", "-0.9 mm")):
            klayout("import pya\nl = pya.Layout(); l.dbu = 0.001; c = l.create_cell('BAR')\n"
                    "c.shapes(l.layer(1, 0)).insert(pya.Box(0, 0, 60000, %d))\nl.write('bar.gds')\npya.Application.instance().exit(0)\n"
                    % (2000 if k else 40000), self.where)
            done = self.make("near", '<cell file="bar.gds" x="%s" y="3.0 mm" layers="1/0>mask"/>' % at, options=())
            self.assertIn("cell BAR", done.stderr)
            self.assertIn("FW-D144" if k else "FW-D145", done.stderr)
            self.assertNotIn("FW-D152", done.stderr)

    def test_what_lies_within_the_frame_is_told(self):
        """a logo in the frame is as dark as the frame: on text it is seen, and beside the frame; and so is a bias of a layer that has none"""
        klayout("import pya\nl = pya.Layout(); l.dbu = 0.001; c = l.create_cell('BAR')\n"
                "c.shapes(l.layer(1, 0)).insert(pya.Box(0, 0, 40000, 40000))\nl.write('bar.gds')\npya.Application.instance().exit(0)\n", self.where)
        for to, x, told in (("mask", "-0.95 mm", "FW-D722"), ("text", "-0.95 mm", None), ("mask", "-0.88 mm", None),
                            ('mask" bias="yes', "-0.88 mm", None), ('text" bias="yes', "-0.95 mm", "FW-D724")):
            self.make("within", '<cell file="bar.gds" x="%s" y="3.0 mm" layers="1/0>%s"/>' % (x, to))
            done = subprocess.run([PROGRAM, "mask", "within.xml", "-o", "within", *(w for w in FAST if w != "-q")], cwd=self.where,
                                  capture_output=True, text=True, check=False, timeout=240)  # -q leaves warnings out
            for code in ("FW-D722", "FW-D724"):
                self.assertEqual(code in done.stderr, code == told, (to, x, done.stderr))

    def test_parts_that_nothing_holds_are_told(self):
        """each part of a cell is looked at by itself: one beside what lies on the frame falls out, one that another cell holds does not"""
        boxes = {"half": [(-60, -20, 60, 20), (80, -20, 120, 20)], "bridge": [(50, -10, 90, 10)], "island": [(0, 0, 40, 40)]}
        klayout("import pya\nfor n, boxes in %r.items():\n"
                "  l = pya.Layout(); l.dbu = 0.001; c = l.create_cell('C')\n"
                "  c.shapes(l.layer(1, 0)).insert(pya.Region([pya.Box(*[1000 * v for v in b]) for b in boxes])); l.write(n + '.gds')\n"
                "pya.Application.instance().exit(0)\n" % boxes, self.where)
        for cells, told in ((("half",), "cell half: 1 of its 2 parts, from (-820, 3580) to (-780, 3620) um, hangs together with nothing"),
                            (("half", "bridge"), None), (("island",), None), (("half", "bridge", "island"), None)):
            text = "".join('<cell id="%s" file="%s.gds" x="-0.9 mm" y="3.6 mm" layers="1/0>mask"/>' % (n, n) for n in cells)
            done = self.make("parts", text, formats="gds", fast=[o for o in FAST if o != "-q"])
            said = [line for line in done.stderr.splitlines() if "FW-D574" in line]
            self.assertEqual(len(said), int(told is not None), (cells, done.stderr))
            self.assertTrue(told is None or told in said[0], said)

    def test_cells_around_what_is_there(self):
        """cells around others, one of them with an arm over the frame and two cells in it: one region with them, whatever their order"""
        drawn = {"small": [(-20, -20, 20, 20)], "large": [(-90, -90, 90, 90)], "long": [(-300, -90, 300, 90)],
                 "arm": [(-90, -90, 90, 90), (80, -30, 400, 30)]}
        small, away = ("small", -0.7, 3.4), ("small", -0.55, 3.42)
        rng, boxes = random.Random(22), []
        for k in range(4):  # of any size, upon each other
            half = [(rng.randint(5, 200), rng.randint(5, 80)) for _ in range(rng.randint(2, 5))]
            drawn.update({"b%d-%d" % (k, i): [(-w, -h, w, h)] for i, (w, h) in enumerate(half)})
            boxes.append([("b%d-%d" % (k, i), 1e-3 * rng.randint(-760, -560), 1e-3 * rng.randint(3330, 3440)) for i in range(len(half))])
        klayout("import pya\nfor n, boxes in %r.items():\n"
                "  l = pya.Layout(); l.dbu = 0.001; c = l.create_cell('C')\n"
                "  r = pya.Region([pya.Box(*[1000 * v for v in b]) for b in boxes]).merged()\n"
                "  c.shapes(l.layer(1, 0)).insert(r); l.write(n + '.gds')\npya.Application.instance().exit(0)\n" % drawn, self.where)
        groups = ([small, ("large", -0.7, 3.4)], [("large", -0.7, 3.4), small], [small, away, ("long", -0.6, 3.4)],
                  [small, ("arm", -0.7, 3.4)], [("small", -0.7, 3.4), ("large", -0.69, 3.41), ("long", -0.62, 3.4)], *boxes)
        jobs = []
        for k, cells in enumerate(groups):
            done = self.make("around%d" % k, "".join('<cell id="c%d" file="%s.gds" x="%g mm" y="%g mm" layers="1/0>mask"/>' % (i, *c)
                                                     for i, c in enumerate(cells)), formats="gds")
            self.assertNotIn("FW-D152", done.stderr, cells)
            self.assertNotIn("FW-D146", done.stderr, cells)
            parts = [["plain/masks/%s.gds" % FLOW, [1, 0]]]
            parts += [["%s.gds" % name, [1, 0], [round(1e6 * x), round(1e6 * y), 0, False]] for name, x, y in cells]
            jobs.append(["around%d/masks/%s.gds" % (k, FLOW), [1, 0], parts])
        for k, (area, off, thick) in enumerate(self.compare(jobs)):
            self.assertEqual(thick, 0, groups[k])
            self.assertLess(off, 20000, groups[k])
            layers = {y["gds"]: y for y in json.loads((self.where / ("around%d" % k) / "masks" / (FLOW + ".json")).read_text())["layers"]}
            self.assertAlmostEqual(layers["1/0"]["polygon_area_um2"], 1e-6 * area, delta=1e-3)  # counted once


if __name__ == "__main__":
    if not shutil.which("klayout"):
        print("SKIPPED: klayout is not installed (Debian: apt-get install klayout)")
        sys.exit(77)
    unittest.main()
