#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""test_manners.py PROGRAM: progress on a terminal alone, refusals before the work, what was probably meant,
diagnostics as JSON."""
import json
import math
import os
import pathlib
import pty
import random
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ET

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = str(pathlib.Path(sys.argv.pop(1)).resolve())
SIX_BAR = str(ROOT / "docs/gallery/reference-six-bar/device.xml")
COMB = ROOT / "docs/gallery/comb-stage/device.xml"
LONG = ["simulate", SIX_BAR, "--rtol", "1e-13", "--integrator", "rk4", "--samples"]  # how many: test_progress


def run(*arguments, **named):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, check=False, cwd=ROOT, **{"text": True, **named})


def on_terminal(*arguments, term="xterm", path=os.environ["PATH"], expected=(0,)):
    """What the program writes to a terminal that is its standard error."""
    ours, theirs = pty.openpty()
    with subprocess.Popen([PROGRAM, *arguments], stdout=subprocess.DEVNULL, stderr=theirs, cwd=ROOT,
                          env={**os.environ, "TERM": term, "PATH": path}) as child:
        os.close(theirs)
        seen = b""
        while True:
            try:
                part = os.read(ours, 4096)
            except OSError:  # the other end is closed
                break
            if not part:
                break
            seen += part
        os.close(ours)
        assert child.wait() in expected, seen
    return seen.decode()


class Manners(unittest.TestCase):
    """As clig.dev asks for them."""

    def test_progress(self):
        # what is over within a second says nothing on the way: as many samples as last longer on this machine
        samples, seen = 150000, ""
        while "motion of a scene" not in seen and samples < 20000000:
            samples *= 2
            seen = on_terminal(*LONG, str(samples))
        motion = [*LONG, str(samples)]
        self.assertRegex(seen, r"\r\x1b\[Kmotion of a scene: [\d.e-]+ of 0\.01 s")
        self.assertTrue(seen.endswith("\r\x1b[K") or "\x1b[K" in seen.split("motion of a scene")[-1])
        self.assertEqual(on_terminal(*motion, "--no-progress"), "")
        self.assertEqual(on_terminal(*motion, "-q"), "")
        self.assertEqual(on_terminal(*motion, term="dumb"), "")
        self.assertNotIn("motion of a scene", run(*motion).stderr)

    def test_searches_say_how_much_is_left_at_most(self):
        seen = on_terminal("check", str(COMB), "--set", "volts=100 V", "--time-limit", "6", expected=(1, 4, 6))
        said = re.findall(r"looking for changes that would be accepted: ([\d.]+) of at most 100 %, at most (\d+) s left", seen)
        self.assertGreater(len(said), 1, seen[-400:])
        self.assertTrue(all(float(a[0]) <= float(b[0]) for a, b in zip(said, said[1:])))
        self.assertLessEqual(float(said[-1][0]), 100)

    def test_sizes_say_how_much_is_left_at_most(self):
        """over all rounds of two goals, one count; and the same devices whoever is told"""
        with tempfile.TemporaryDirectory() as scratch:
            study = pathlib.Path(scratch, "size.xml")
            study.write_text('<study xmlns="urn:flexwright:study:1" name="s" kind="size" as="drawn" samples="320" device="%s">'
                             '<vary what="flexure[C]/@width" from="6 um" to="12 um"/><vary what="arc" from="190 deg" to="250 deg"/>'
                             '<respond name="used" value="governing.utilisation" goal="minimise"/>'
                             '<respond name="soft" value="hinges[C].limit_angle_rad" goal="maximise"/></study>' % SIX_BAR)
            for jobs in ("1", "2"):
                out = pathlib.Path(scratch, jobs)
                seen = on_terminal("study", str(study), "-o", str(out), "--jobs", jobs, expected=(0, 1))
                said = re.findall(r"\r(\d+) of at most 320 devices, [\d.e+]+ a second, at most (\d+) s left", seen)
                self.assertGreater(len(said), 2, seen[-400:])
                self.assertTrue(all(int(a[0]) <= int(b[0]) for a, b in zip(said, said[1:])))
                self.assertGreater(int(said[-1][0]), 40)  # beyond the first look
                self.assertLessEqual(int(said[-1][0]), 320)
            self.assertEqual(pathlib.Path(scratch, "1/study.json").read_text(), pathlib.Path(scratch, "2/study.json").read_text())

    def test_another_program_has_a_limit(self):
        """what waits for it says how long at most"""
        with tempfile.TemporaryDirectory() as scratch:
            ccx = pathlib.Path(scratch, "ccx")
            ccx.write_text("#!/bin/sh\nsleep 3\nexit 1\n")
            ccx.chmod(0o755)
            seen = on_terminal("hinge", SIX_BAR, "--level", "continuum", path=f"{scratch}:{os.environ['PATH']}", expected=(0, 5, 7))
            self.assertRegex(seen, r"waiting for another program: [\d.]+ of at most 600 s, at most 59\d s left")

    def test_a_laboratory_pack_of_no_flow(self):
        with tempfile.TemporaryDirectory() as scratch:
            pack = pathlib.Path(scratch, "ours.xml")
            text = (ROOT / "tests/fuzz/seeds/laboratory.xml").read_text()
            pack.write_text(text.replace('flow="al-masked-rie"', 'flow="al-maskd-rie"'))
            said = run("recipe", SIX_BAR, "--lab", str(pack), "-o", f"{scratch}/out").stderr
            self.assertRegex(said, r"ours\.xml:2:\d+: warning: this laboratory pack has no effect: .*'al-maskd-rie'.*did you mean 'al-masked-rie'\?")

    def test_no_pdf_on_a_terminal(self):
        ours, theirs = pty.openpty()
        with subprocess.Popen([PROGRAM, "figure", "docs/pictures/theory-masks.svg"], stdout=theirs, stderr=subprocess.PIPE, cwd=ROOT) as child:
            said = child.communicate()[1].decode()
        os.close(theirs)
        os.close(ours)
        self.assertEqual(child.returncode, 2)
        self.assertIn("name a file with -o", said)
        self.assertTrue(run("figure", "docs/pictures/theory-masks.svg", "-o", "-", text=None).stdout.startswith(b"%PDF"))

    def test_directory_refused_before_the_work(self):
        with tempfile.TemporaryDirectory() as scratch:
            pathlib.Path(scratch, "mine.txt").write_text("notes")
            for command in ("plan", "check", "mask", "recipe", "tradeoff"):
                for target in (scratch, f"{scratch}/mine.txt", f"{scratch}/mine.txt/below"):
                    done = run(command, SIX_BAR, "-v", "-o", target)
                    self.assertEqual(done.returncode, 5, (command, target, done.stderr))
                    self.assertRegex(done.stderr, r"FW-D22[23]")
                    self.assertNotIn("layout, mechanism, motion", done.stderr)
                    self.assertNotIn("by every method", done.stderr)
                    self.assertNotIn("tmp-", done.stderr)
            self.assertEqual(os.listdir(scratch), ["mine.txt"])

    def test_meant(self):
        done = run("check", SIX_BAR, "--flow", "al-maskd-rie")
        self.assertEqual(done.returncode, 3)
        self.assertIn("did you mean 'al-masked-rie'?", done.stderr)
        # a device without any, a flow that there is and one that there is not
        bare = re.sub(r'\s*<flow [^>]*/>|\s+flow="[^"]*"', "", pathlib.Path(SIX_BAR).read_text())
        self.assertNotIn("<flow", bare)
        for command, name in (("check", "nope"), ("check", "al-masked-rie"), ("modes", "nope"), ("simulate", "nope")):
            done = run(command, "-", "--flow", name, input=bare)
            self.assertEqual(done.returncode, 3, command)
            self.assertIn(f"the device has no flow '{name}': it has none", done.stderr)
            self.assertIn("FW-D228", done.stderr)
        text = pathlib.Path(SIX_BAR).read_text().replace('ref="al-masked-rie"', 'ref="al-mask-rie"')
        self.assertIn("did you mean 'al-masked-rie'?", run("check", "-", input=text).stderr)
        text = pathlib.Path(SIX_BAR).read_text().replace('ref="al-masked-rie"', 'ref="xyz"')
        self.assertIn("silicon-on-glass, soi-deep-rie", run("check", "-", input=text).stderr)
        text = pathlib.Path(SIX_BAR).read_text().replace('ref="silicon-100"', 'ref="silicon-10"')
        self.assertIn("did you mean 'silicon-100'?", run("check", "-", input=text).stderr)
        fast = ("--corners", "none", "--advice", "none", "--hinge-model", "revolute", "--accuracy", "3e-2")
        for command, options, near in (("mask", ("--mask-format", "svg,gdz"), "did you mean gds?"), ("check", ("--hinge-model", "elastika"), "mean elastica?"),
                                       ("hinge", ("--level", "continum"), "did you mean continuum?"), ("check", ("--corners", "non"), "did you mean none?"),
                                       ("modes", ("--at", "equilibrum"), "did you mean equilibrium?"), ("recipe", ("--planned", "S3=1 s", *fast), "'S03'?"),
                                       ("simulate", ("--scene", "step-laod"), "'step-load'?"), ("simulate", ("--method", "chian"), "did you mean chain?"),
                                       ("simulate", ("--integrator", "radua5"), "did you mean radau5?"), ("check", ("--effects", "fricton"), "'friction'?"),
                                       ("check", ("--set", "flexure[AA]/@length=1 um"), "has this id; there are A B C D E F;"), ("chek", (), "mean check? See flexwright --help"),
                                       ("recipe", ("--cut", "flexure:AA", *fast), "that id; there are A B C D E F")):
            done = run(command, SIX_BAR, *options)
            self.assertNotEqual(done.returncode, 0)
            self.assertIn(near, done.stderr)

        whole = pathlib.Path(SIX_BAR).read_text()
        self.assertIn("did you mean 'ground'?", run("check", "-", input=COMB.read_text().replace('a="ground"', 'a="grond"')).stderr)
        # nothing is a letter or two off, but one name begins alike
        for wrong, near in ((("<require ", "<requirment "), "did you mean <require>?"), (("<probe ", "<prob-point "), "did you mean <probe>?")):
            text = whole.replace("<die ", '<probe id="tip" on="CD" x="0" y="0"/><require name="x" probe="tip" at-least="1 um"/><die ')
            self.assertIn(near, run("check", "-", input=text.replace(*wrong)).stderr)
        self.assertIn("'step-load'?", run("simulate", SIX_BAR, "--scene", "step").stderr)
        with tempfile.TemporaryDirectory() as scratch:
            layers = pathlib.Path(scratch, "layers")
            for line, near in (("structre 7/0\n", "did you mean 'structure'?"), ("devic 7/0\n", "did you mean 'device'?"), ("flow al-maskd-rie\nstructure 7/0\n", "did you mean 'al-masked-rie'?")):
                layers.write_text(line)
                self.assertIn(near, run("mask", SIX_BAR, "--layers", layers, "-o", scratch + "/out", *fast).stderr)
            laboratory = pathlib.Path(scratch, "laboratory.xml")
            pack = (ROOT / "tests/fuzz/seeds/laboratory.xml").read_text()
            for right, wrong in (("pan.R", "pan.Rr"), ('<q id="', '<tool equipment="rie" closd="2026-12-25"/><q id="')):
                laboratory.write_text(pack.replace(right, wrong))
                self.assertIn("did you mean", run("check", SIX_BAR, "--lab", laboratory, *fast).stderr)
        self.assertIn("'hand-made'?", run("study", "docs/studies/largest-workspace.xml", "--study", "hand-mad", "--plan").stderr)

        for value, near in (("hinges[C].limit_angle_rd", "did you mean 'limit_angle_rad'? There are"), ("hinge[C].limit_angle_rad", "did you mean 'hinges'?")):
            study = ('<study name="s" kind="size" samples="4"><vary what="flexure[C]/@width" from="8 um" to="13 um"/>'
                     '<respond name="r" value="%s" goal="minimise"/></study></device>' % value)
            with tempfile.TemporaryDirectory() as scratch:
                file = pathlib.Path(scratch, "device.xml")
                file.write_text(whole.replace("</device>", study))
                self.assertIn(near, run("study", file, "--plan").stderr)

    def test_report_is_folded(self):
        with tempfile.TemporaryDirectory() as scratch:
            out = pathlib.Path(scratch, "out")
            run("plan", SIX_BAR, "-o", out, "--flow", "al-masked-rie", "--corners", "none", "--advice", "none", "--hinge-model", "revolute", "--accuracy",
                "3e-2", "-q")
            page = (out / "report.html").read_text()
        main = page[page.index("<main>"):page.index("</main>")]
        folds = re.findall(r'<section id="([\w-]+)" aria-labelledby="h-\1"><details( open="open")?><summary><h2', main)
        self.assertEqual(len(folds), main.count("<section "))
        self.assertEqual([name for name, opened in folds if opened], ["device", "hinges"])
        # within them what few want is folded once more
        self.assertRegex(main, r"<details><summary><h3>The hinges by models")

    def test_a_base_is_drawn_whichever_way_the_device_stands(self):
        """an arm on an arc whose base found no way at 222 degrees, and one at 227, until bases went to the side beside them (decision 213)"""
        def device(degrees):
            c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
            x, y = -1284 * s, 1284 * c  # from the hinge, across its axis
            return (f"""<?xml version="1.0" encoding="UTF-8"?>
<device xmlns="urn:flexwright:device:1" name="arm"><material ref="silicon-100" thickness="50 um"/><flow ref="al-masked-rie"/>
<flexure id="F" kind="csfh" radius="132.689 um" angle="191.4 deg" width="5.341 um" fillet="1.985 um"/>
<mechanism><body id="arm" x="{x} um" y="{y} um" width="150 um" plate-width="400 um" plate-height="300 um"
plate-angle="{degrees + 90} deg"/><revolute id="H" a="ground" a-x="0 um" a-y="0 um" b="arm" b-x="{-x} um" b-y="{-y} um" hinge="F"
axis="{degrees} deg"/></mechanism>
<scene name="s" duration="10 ms"><torque on="arm" value="10000 pN m" law="ramp" rise="10 ms"/></scene></device>""")
        with tempfile.TemporaryDirectory() as place:
            path = pathlib.Path(place) / "d.xml"
            for degrees in (222.173, 227.173):
                path.write_text(device(degrees))
                done = run("check", str(path), "--corners", "none", "--advice", "none")
                self.assertNotIn("FW-D126", done.stderr)

    def test_one_mistake_is_one_message(self):
        """and what it says is what a user may do; each a change of the gallery's straight stage or gripper"""
        gallery = {d: (ROOT / f"docs/gallery/{d}/device.xml").read_text() for d in ("straight-stage", "free-form-gripper")}
        cases = (
            ("straight-stage", 'width="120 um"', 'width="120 N"', "FW-D025", "a length is wanted"),
            ("straight-stage", 'plate-width="0.9 mm"', 'plate-width="-0.9 mm"', "FW-D047", "must be at least 1 um"),
            # as it is written, of which body, and no 300000 um
            ("straight-stage", 'plate-width="0.9 mm"', 'plate-width="-0.9 mm"', "FW-D047",
             "body 'stage': plate-width is -0.9 mm; it must be at least 1 um and at most 300 mm ("),
            ("straight-stage", 'plate-width="0.9 mm"', 'plate-width="0.9 mm - 2 mm"', "FW-D047",
             "plate-width is 0.9 mm - 2 mm, which is -1100 um; it"),
            ("free-form-gripper", '<disc x="20 um" y="820 um"', '<disc copies="0" x="20 um" y="820 um"', "FW-D047",
             "<disc> of body 'left': copies is 0; it must be at least 1 and at most 500 (1 is the shape alone"),
            ("free-form-gripper", '<body id="left" x="-span" y="0 mm"', '<body id="left" x="-span" y="299.9 mm + 400 um"', "FW-D047",
             "give its bodies mass and inertia in place of a width, a plate or shapes"),
            ("straight-stage", 'width="120 um"', 'width="120 V/m"', "FW-D025", "this is a quantity in 'm kg s^-3 A^-1', and a"),
            ("free-form-gripper", '<disc x="20 um" y="820 um"', '<disc x="900 um" y="820 um"', "FW-D316",
             "move it into the body"),
        )
        with tempfile.TemporaryDirectory() as place:
            for device, was, now, code, says in cases:
                self.assertIn(was, gallery[device])
                path = pathlib.Path(place) / "d.xml"
                path.write_text(gallery[device].replace(was, now, 1))
                done = run("check", str(path), "--corners", "none")
                said = [line for line in done.stderr.splitlines() if " error: " in line]
                self.assertEqual(len(said), 1, said)
                self.assertIn(f"[{code}]", said[0])
                self.assertIn(says, said[0])
                self.assertRegex(said[0], r"d\.xml:\d+:\d+: error: ")

    def test_explain(self):
        want = run("explain", "FW-D204").stdout
        for code in ("fw-d204", "Fw-D204", "D204", "d204", "204"):
            self.assertEqual(run("explain", code).stdout, want)
        self.assertEqual({run("explain", code).stdout for code in ("fwd204", "FW 204", "d204")}, {run("explain", "FW-D204").stdout})
        for code in ("FW-D999", "fw-dd204", "fw-x204", "dfw-204"):
            self.assertEqual(run("explain", code).returncode, 2)

    def test_diagnostics_as_json(self):
        done = run("check", "-", "--json", input="<device xmlns='urn:flexwright:device:1' name='x' nme='y'/>")
        self.assertEqual(done.returncode, 3)
        first = next(d for d in json.loads(done.stdout)["diagnostics"] if d["code"] == "FW-D042")
        self.assertEqual((first["severity"], first["line"], first["column"]), ("error", 1, 50))
        self.assertIn("did you mean 'name'?", first["message"])
        self.assertEqual(json.loads(run("check", SIX_BAR, "--json").stdout)["schema"], "flexwright.verdict/1")
        wrong = "<device xmlns='urn:flexwright:device:1' name='x' nme='y'/>"
        for command in ("plan", "simulate", "assemble", "statics", "modes", "mask", "recipe", "hinge", "workspace", "tradeoff", "study", "log"):
            done = run(command, "-", "--json", input=wrong)
            self.assertEqual((command, done.returncode, json.loads(done.stdout)["schema"]), (command, 3, "flexwright.diagnostics/1"))

    def test_the_drawing_alone(self):
        """the bytes of masks/FLOW.gds, on standard output too; of one flow, and in place of a directory"""
        comb = ROOT / "docs/gallery/comb-stage/device.xml"
        fast = ("--corners", "none", "--advice", "none", "--hinge-model", "revolute", "--accuracy", "3e-2", "-q")
        with tempfile.TemporaryDirectory() as where:
            run("mask", comb, *fast, "-o", where + "/all")
            done = subprocess.run([PROGRAM, "mask", comb, *fast, "--gds", "-"], capture_output=True, check=False)
            self.assertEqual((done.returncode, done.stderr), (0, b""))
            self.assertEqual(done.stdout, pathlib.Path(where, "all/masks/silicon-on-glass.gds").read_bytes())
            self.assertIn("--flow", run("mask", SIX_BAR, *fast, "--gds", where + "/x.gds").stderr)
            self.assertEqual(run("mask", comb, "--gds", where + "/x.gds", "-o", where + "/both").returncode, 2)
            self.assertEqual(sorted(os.listdir(where)), ["all"])

    KNOWN = set("m l c h re W W* n S f B f* B* rg RG w J j d gs cm q Q BT ET Tr Tm Tf Ts Tj Do".split())

    def streams_of(self, data, what):
        """[page, forms it repeats ...] of a PDF as text, its parts being where its table says"""
        table = int(re.search(rb"startxref\n(\d+)", data).group(1))
        rows = data[table:].split(b"\n")
        count = int(rows[1].split()[1])
        found = []
        for number in range(1, count):
            at = int(rows[2 + number].split()[0])
            self.assertTrue(data[at:].startswith(b"%d 0 obj" % number), (what, number))
            head = data[at:data.index(b"obj", at + 20)]
            length = re.search(rb"/Length (\d+)>>stream\n", head)
            if length:
                start = at + length.end()
                found.append(data[start:start + int(length.group(1))].decode("ascii"))
                self.assertEqual(data[start + int(length.group(1)):][:10], b"\nendstream")
                for word in re.sub(r"\[[^\]]*\]|<[0-9a-f]*>", "0", found[-1]).split():
                    self.assertTrue(word in self.KNOWN or re.fullmatch(r"-?[0-9.]+|/[GFX][0-9]+", word), (what, word))
                self.assertEqual(found[-1].split().count("q"), found[-1].split().count("Q"))
        self.assertEqual(len(found) + 7, count - 1, what)
        return found

    def test_figures_as_pdf(self):
        """every kind of picture becomes one page with all its shapes and letters, the same bytes twice; a file whose parts are
        where its table says; what is not ours is named"""
        leaf, comb = (str(ROOT / "docs/gallery" / n / "device.xml") for n in ("leaf-four-bar", "comb-stage"))
        shape = ("path", "rect", "circle", "ellipse", "line", "polyline", "polygon")
        with tempfile.TemporaryDirectory() as where:
            run("plan", leaf, "-o", where + "/plan", "--corners", "none", "-q")
            run("modes", leaf, "-o", where + "/modes", "-q")
            run("statics", comb, "-o", where + "/statics", "-q")
            run("workspace", SIX_BAR, "-o", where + "/workspace", "-q")
            run("study", str(ROOT / "docs/studies/width-and-arc.xml"), "-o", where + "/study", "-q")
            (pathlib.Path(where) / "kept").mkdir()
            for kept in ("masks/gallery/comb-stage/silicon-on-glass-wafer.svg", "masks/gallery/comb-stage/silicon-on-glass-wafer-map.svg",
                         "masks/gallery/reference-six-bar/al-masked-rie-coupons.svg", "docs/pictures/tradeoff-reference-six-bar.svg",
                         "docs/pictures/effect-fringe-field.svg", "docs/pictures/theory-masks.svg"):
                shutil.copy(ROOT / kept, where + "/kept")
            figures = sorted(pathlib.Path(where).rglob("*.svg"))
            self.assertGreaterEqual(len(figures), 20)
            self.assertTrue(any("study" in str(p) for p in figures))
            for svg in figures:
                pdf = svg.with_suffix(".pdf")
                for out in (pdf, svg.with_suffix(".again")):
                    done = run("figure", str(svg), "-o", str(out))
                    self.assertEqual((done.returncode, done.stderr), (0, ""), svg)
                data = pdf.read_bytes()
                self.assertEqual(data, svg.with_suffix(".again").read_bytes())
                self.assertNotRegex(data, b"Date|ID|" + where.encode())
                page, *forms = self.streams_of(data, svg)
                tree = ET.parse(svg).getroot()
                below = {child: parent for parent in tree.iter() for child in parent}

                def up(e):
                    while e is not None:
                        yield e
                        e = below.get(e)
                local = {e: e.tag.split("}")[-1] for e in tree.iter()}
                here = [e for e in tree.iter() if not any(local[u] == "defs" or u.get("visibility") == "hidden" for u in up(e))]
                words = page.split()
                drawn = sum(word in ("S", "f", "B", "f*", "B*", "n") for word in words) - page.count("re W n")
                self.assertLessEqual(abs(drawn - sum(local[e] in shape for e in here)), len(list(tree.iter())) - len(here), svg)
                uses = [e for e in here if local[e] == "use"]
                self.assertEqual(words.count("Do"), len(uses), svg)
                self.assertLessEqual(len(forms), sum(local[e] == "use" for e in tree.iter()))
                for form in forms:
                    self.assertTrue(any(word in ("S", "f", "B", "f*", "B*", "Do") for word in form.split()), svg)
                for word in ("leaf-four-bar", "Schedule"):
                    if any(word in (e.text or "") for e in here if local[e] in ("text", "tspan")):
                        self.assertIn(word.encode().hex(), page, svg)
                side = re.search(rb"MediaBox\[0 0 ([0-9.]+) ([0-9.]+)", data)
                self.assertGreaterEqual(max(map(float, side.groups())), 72)
                if (tree.get("width") or "").endswith("mm"):  # true, or so many times ten
                    times = float(side.group(1)) / (float(tree.get("width")[:-2]) * 72 / 25.4)
                    self.assertLess(abs(math.log10(times) - round(math.log10(times))), 1e-5, svg)
            for bad, says in (("<svg width='1' height='1'", "no picture"), ("<html/>", "no picture"), ('<svg width="9" height="9"><image/></svg>', "image"),
                              ('<svg width="9" height="9"><text x="1">\u6f22</text></svg>', "\u6f22"), ("<svg", "no picture"),
                              ('<svg width="9" height="9"><path d="M1 1Z5"/></svg>', "path"), ('<svg width="9" height="9"><g transform="rotate', "no picture"),
                              ('<svg width="9" height="9"><g id="a"><use href="#a"/></g></svg>', "use"), ('<svg width="9" height="9"><use href="#b"/></svg>', "#b"),
                              ('<svg width="9" height="9"><circle r="1" clip-path="url(#a)"/></svg>', "clip-path"),
                              ('<!DOCTYPE svg [<!ENTITY a "b">]><svg width="9" height="9"><text>&a;</text></svg>', "no picture"),
                              ('<svg width="9" height="9"><polygon points="1 1 2"/></svg>', "polygon"), ('<svg width="9" height="9"><text x="1" text-anchor="end">a<tspan', "no picture"),
                              ('<svg width="1e-300" height="9" viewBox="0 0 1 1"/>', "no picture"), ('<svg width="9" height="9"><g transform="rotate"/></svg>', None)):
                path = pathlib.Path(where, "bad.svg")
                path.write_text(bad, encoding="utf-8")
                done = run("figure", str(path), "-o", where + "/bad.pdf")
                if says:
                    self.assertEqual(done.returncode, 3, (bad, done.stderr))
                    self.assertIn("FW-D549", done.stderr)
                    self.assertIn(says, done.stderr)
                    self.assertFalse(pathlib.Path(where, "bad.pdf").exists())
                self.assertIn(done.returncode, (0, 3), bad)
                pathlib.Path(where, "bad.pdf").unlink(missing_ok=True)

    def figure(self, body):
        """the operators of a picture of 1000 by 1000 with that in it"""
        done = run("figure", "-", "-o", "-", input='<svg xmlns="http://www.w3.org/2000/svg" width="1000" height="1000">%s</svg>' % body)
        self.assertEqual((done.returncode, done.stderr), (0, ""), body)
        return self.streams_of(done.stdout.encode(), body)

    def test_curves_of_figures(self):
        """elliptic arcs by their equation and the flags' meaning; curves of second order as those of third, and mirrored ones as written out"""
        draw = random.Random(7)
        for _ in range(60):
            rx, ry, turn, p = draw.uniform(20, 200), draw.uniform(20, 200), draw.uniform(-90, 90), [draw.uniform(300, 700) for _ in range(2)]
            large, sweep = draw.random() < 0.5, draw.random() < 0.5
            a, span = draw.uniform(0, 2 * math.pi), draw.uniform(0.1, 3.0)
            span = (2 * math.pi - span if large else span) * (1 if sweep else -1)
            co, si = math.cos(math.radians(turn)), math.sin(math.radians(turn))

            def on(t):
                return [p[0] + co * rx * math.cos(t) - si * ry * math.sin(t), p[1] + si * rx * math.cos(t) + co * ry * math.sin(t)]
            q, r = on(a), on(a + span)
            relative = draw.random() < 0.5
            end = [r[0] - q[0], r[1] - q[1]] if relative else r
            page = self.figure('<path d="M%r %r%s%r %r %r %d %d %r,%r"/>' % (*q, "a" if relative else "A", rx, ry, turn, large, sweep, *end))[0]
            pieces = [list(map(float, m.split())) for m in re.findall(r"^((?:\S+ ){6})c$", page, re.M)]
            self.assertEqual(len(pieces), math.ceil(abs(span) / (math.pi / 2) - 1e-9))
            at, total = q, 0
            for x1, y1, x2, y2, x3, y3 in pieces:
                angles = []
                for k in range(9):
                    t = k / 8
                    b = ((1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t * t * (1 - t), t ** 3)
                    x = sum(c * v for c, v in zip(b, (at[0], x1, x2, x3))) - p[0]
                    y = sum(c * v for c, v in zip(b, (at[1], y1, y2, y3))) - p[1]
                    u, w = (co * x + si * y) / rx, (co * y - si * x) / ry
                    self.assertLess(abs(math.hypot(u, w) - 1), 3e-4)
                    angles.append(math.atan2(w, u))
                total += (angles[-1] - angles[0] + math.pi) % (2 * math.pi) - math.pi
                at = [x3, y3]
            self.assertLess(math.dist(at, r), 1e-4)
            self.assertLess(abs(total - span), 1e-4)
        self.assertEqual(self.figure('<path d="M10 20Q40 80 70 20T130 20"/>'), self.figure('<path d="M10 20C30 60 50 60 70 20C90 -20 110 -20 130 20"/>'))
        self.assertEqual(self.figure('<path d="M10 20c0 10 20 20 30 0s30-20 30 0"/>'),
                         self.figure('<path d="M10,20 C10,30 30,40 40,20 C50,0 70,0 70,20"/>'))
        self.assertEqual(self.figure('<polygon points="1,2 3,4 5 6"/>'), self.figure('<path d="M1 2L3 4L5 6Z"/>'))
        self.assertEqual(self.figure('<rect x="1" y="2" width="8" height="6" rx="9"/>')[0].count(" c\n"), 4)

    def test_what_figures_repeat(self):
        """in one style once, in each style of its own; blanks of lettering as one; raised figures"""
        two = self.figure('<defs><g id="a"><path d="M0 0L1 1"/></g></defs><use href="#a" x="3"/><use href="#a" y="4"/><use href="#a" fill="#f00"/>')
        self.assertEqual(len(two), 3)
        self.assertEqual(two[0].count("Do"), 3)
        self.assertIn("1 0 0 1 3 0 cm", two[0])
        self.assertEqual(self.figure("<text> a \n  b<tspan> c </tspan></text>"), self.figure("<text>a b<tspan> c</tspan></text>"))
        page = self.figure("<text font-size='10'>10\u207b\u2079 m</text>")[0]
        self.assertRegex(page, r"<3130> Tj\n3\.3 Ts\n/F3 6 Tf\n<2d> Tj\n/F1 6 Tf\n<39> Tj\n0 Ts\n/F1 10 Tf\n<206d> Tj")

    def test_clipped_figures(self):
        """what a clip path leaves is drawn, of the element that names it alone; what is no single outline is named; every picture of
        these pages can be a figure"""
        path = '<defs><clipPath id="a"><rect x="1" y="2" width="3" height="4"/></clipPath></defs>'
        for named in ('clip-path="url(#a)"', 'style="fill:none;clip-path:url(#a)"'):
            page = self.figure(path + '<g transform="translate(5 6)" %s><path d="M0 0L1 1"/><path d="M2 2L3 3"/></g><path d="M4 4L5 5"/>' % named)[0]
            self.assertEqual(page.count("W n"), 1)
            words = page.split()
            within = words[words.index("W"):words.index("Q", words.index("W"))]
            self.assertIn("1 0 0 1 5 6 cm 1 2 3 4 re W n", " ".join(words))  # in the space of the group itself
            self.assertEqual((within.count("m"), words.count("m")), (2, 3))
            self.assertNotIn("q", within)
        even = self.figure('<clipPath id="a"><path clip-rule="evenodd" d="M0 0L9 0L9 9Z"/></clipPath><circle r="3" clip-path="url(#a)"/>')[0]
        self.assertIn("W* n", even)
        self.assertEqual(self.figure(path + '<circle r="3" clip-path="none"/>'), self.figure('<circle r="3"/>'))
        for inside, says in (('<clipPath id="a"><circle r="1"/><circle r="2"/></clipPath>', "clip-path"),
                             ('<clipPath id="a" clipPathUnits="objectBoundingBox"><rect/></clipPath>', "clip-path"),
                             ('<clipPath id="a"><circle r="1" transform="scale(2)"/></clipPath>', "clip-path"),
                             ('<clipPath id="a"><text>b</text></clipPath>', "clip-path"), ('<g id="a"><circle r="1"/></g>', "clip-path"),
                             ('<clipPath id="a"/>', "clip-path"), ('<clipPath id="a"><path d="M1 1Z5"/></clipPath>', "clip-path"),
                             ('<clipPath id="a"><rect/></clipPath><path style="filter:url(#b)"/>', "filter"),
                             ('<clipPath id="a"><rect/></clipPath><g mask="url(#b)"/>', "mask")):
            done = run("figure", "-", "-o", "-", input='<svg width="9" height="9">%s<circle r="1" clip-path="url(#a)"/></svg>' % inside)
            self.assertEqual(done.returncode, 3, inside)
            self.assertIn(f"'{says}'", done.stderr)
        for picture in sorted(ROOT.glob("docs/**/*.svg")):
            done = run("figure", str(picture), "-o", "-")
            self.assertEqual((done.returncode, done.stderr), (0, ""), picture)

    def test_doctor_knows_every_flow(self):
        listed = run("doctor").stdout
        for pack in (ROOT / "processes").glob("*.xml"):
            self.assertIn(f"processes/{pack.name}", listed)
        self.assertNotIn("MISSING", listed)


if __name__ == "__main__":
    unittest.main()
