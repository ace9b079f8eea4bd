#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""test_manners.py PROGRAM: progress on a terminal alone, refusals before the work, what was probably meant,
diagnostics as JSON."""
import json
import os
import pathlib
import pty
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = str(pathlib.Path(sys.argv.pop(1)).resolve())
SIX_BAR = str(ROOT / "docs/gallery/reference-six-bar/device.xml")
LONG = ["simulate", SIX_BAR, "--rtol", "1e-13", "--integrator", "rk4", "--samples", "300000"]


def run(*arguments, **named):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, check=False, cwd=ROOT, **named)


def on_terminal(*arguments, term="xterm"):
    """What the program writes to a terminal that is its standard error."""
    ours, theirs = pty.openpty()
    with subprocess.Popen([PROGRAM, *arguments], stdout=subprocess.DEVNULL, stderr=theirs, cwd=ROOT,
                          env={**os.environ, "TERM": term}) as child:
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
        assert child.wait() == 0, seen
    return seen.decode()


class Manners(unittest.TestCase):
    """As clig.dev asks for them."""

    def test_progress(self):
        seen = on_terminal(*LONG)
        self.assertRegex(seen, r"\r\x1b\[Kmotion of a scene: [\d.e-]+ of 0\.01 s")
        self.assertTrue(seen.endswith("\r\x1b[K") or "\x1b[K" in seen.split("motion of a scene")[-1])
        self.assertEqual(on_terminal(*LONG, "--no-progress"), "")
        self.assertEqual(on_terminal(*LONG, "-q"), "")
        self.assertEqual(on_terminal(*LONG, term="dumb"), "")
        self.assertNotIn("motion of a scene", run(*LONG).stderr)

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
        text = pathlib.Path(SIX_BAR).read_text().replace('ref="al-masked-rie"', 'ref="al-mask-rie"')
        self.assertIn("did you mean 'al-masked-rie'?", run("check", "-", input=text).stderr)
        text = pathlib.Path(SIX_BAR).read_text().replace('ref="al-masked-rie"', 'ref="xyz"')
        self.assertIn("silicon-on-glass, soi-deep-rie", run("check", "-", input=text).stderr)
        for command, options, near in (("simulate", ("--scene", "step-laod"), "'step-load'?"), ("simulate", ("--method", "chian"), "did you mean chain?"),
                                       ("simulate", ("--integrator", "radua5"), "did you mean radau5?"), ("check", ("--effects", "fricton"), "'friction'?")):
            done = run(command, SIX_BAR, *options)
            self.assertNotEqual(done.returncode, 0)
            self.assertIn(near, done.stderr)

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

    def test_explain(self):
        want = run("explain", "FW-D204").stdout
        for code in ("fw-d204", "Fw-D204", "D204", "d204", "204"):
            self.assertEqual(run("explain", code).stdout, want)
        for code in ("FW-D999", "fw-dd204", "fw-x204", "dfw-204"):
            self.assertEqual(run("explain", code).returncode, 2)

    def test_diagnostics_as_json(self):
        done = run("check", "-", "--json", input="<device xmlns='urn:flexwright:device:1' name='x' nme='y'/>")
        self.assertEqual(done.returncode, 3)
        first = next(d for d in json.loads(done.stdout)["diagnostics"] if d["code"] == "FW-D042")
        self.assertEqual((first["severity"], first["line"], first["column"]), ("error", 1, 50))
        self.assertIn("did you mean 'name'?", first["message"])
        self.assertEqual(json.loads(run("check", SIX_BAR, "--json").stdout)["schema"], "flexwright.verdict/1")

    def test_figures_as_pdf(self):
        """every kind of picture becomes one page with all its shapes and letters, the same bytes twice; a file whose parts are
        where its table says; what is not ours is named"""
        leaf, comb = (str(ROOT / "docs/gallery" / n / "device.xml") for n in ("leaf-four-bar", "comb-stage"))
        with tempfile.TemporaryDirectory() as where:
            run("plan", leaf, "-o", where + "/plan", "--corners", "none", "-q")
            run("modes", leaf, "-o", where + "/modes", "-q")
            run("statics", comb, "-o", where + "/statics", "-q")
            run("workspace", SIX_BAR, "-o", where + "/workspace", "-q")
            figures = [p for p in sorted(pathlib.Path(where).rglob("*.svg")) if p.parent.name != "masks"]
            self.assertGreaterEqual(len(figures), 8)
            for svg in figures:
                pdf = svg.with_suffix(".pdf")
                for out in (pdf, svg.with_suffix(".again")):
                    done = run("figure", str(svg), "-o", str(out))
                    self.assertEqual((done.returncode, done.stderr), (0, ""), svg)
                data = pdf.read_bytes()
                self.assertEqual(data, svg.with_suffix(".again").read_bytes())
                self.assertNotRegex(data, b"Date|ID|" + where.encode())
                table = int(re.search(rb"startxref\n(\d+)", data).group(1))
                rows = data[table:].split(b"\n")
                for number in range(1, 8):
                    at = int(rows[2 + number].split()[0])
                    self.assertTrue(data[at:].startswith(b"%d 0 obj" % number), (svg, number))
                length, start = re.search(rb"4 0 obj<</Length (\d+)>>stream\n", data).group(1), data.index(b"stream\n") + 7
                page = data[start:start + int(length)].decode("ascii")
                self.assertEqual(data[start + int(length):][:10], b"\nendstream")
                known = set("m l c h re W n S f B f* B* rg RG w J d gs cm q Q BT ET Tr Tm Tf Tj".split())
                for word in re.sub(r"\[[^\]]*\]|<[0-9a-f]*>", "0", page).split():
                    self.assertTrue(word in known or re.fullmatch(r"-?[0-9.]+|/[GF][0-9]+", word), (svg, word))
                self.assertEqual(page.split().count("q"), page.split().count("Q"))
                text = re.sub(r"(?s)<(title|desc|style)\b.*?</\1>", "", svg.read_text(encoding="utf-8"))
                shapes = len(re.findall(r"<(?:path|rect|circle|line)\b(?![^>]*visibility=\"hidden\")", text))
                drawn = sum(word in ("S", "f", "B", "f*", "B*", "n") for word in page.split()) - page.count("re W n")
                self.assertLessEqual(abs(drawn - shapes), text.count("hidden"), svg)
                for word in ("leaf-four-bar", "Schedule"):
                    if re.search(r">[^<]*%s" % word, text):
                        self.assertIn(word.encode().hex(), page, svg)
            for bad, says in (("<svg width='1' height='1'/>", "no picture"), ('<svg width="9" height="9"><image/></svg>', "image"),
                              ('<svg width="9" height="9"><text x="1">\u6f22</text></svg>', "\u6f22"), ("<svg", "no picture"),
                              ('<svg width="9" height="9"><path d="M1 1Z5"/></svg>', "path"), ('<svg width="9" height="9"><g transform="rotate', None), ('<svg width="9" height="9"><text x="1" text-anchor="end">a<tspan', None)):
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

    def test_doctor_knows_every_flow(self):
        listed = run("doctor").stdout
        for pack in (ROOT / "processes").glob("*.xml"):
            self.assertIn(f"processes/{pack.name}", listed)
        self.assertNotIn("MISSING", listed)


if __name__ == "__main__":
    unittest.main()
