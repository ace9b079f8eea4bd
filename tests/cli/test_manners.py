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

    def test_doctor_knows_every_flow(self):
        listed = run("doctor").stdout
        for pack in (ROOT / "processes").glob("*.xml"):
            self.assertIn(f"processes/{pack.name}", listed)
        self.assertNotIn("MISSING", listed)


if __name__ == "__main__":
    unittest.main()
