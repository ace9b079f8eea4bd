#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""test_package.py PROGRAM: the package of klayout/ in Debian's KLayout, without a display: PCells, errors, technologies, menu, markers."""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
PROGRAM = pathlib.Path(sys.argv.pop(1)).resolve()
PACKAGE = pathlib.Path(os.environ.get("FW_KLAYOUT_PACKAGE", ROOT / "klayout"))  # the installed one: tests/install
SIX_BAR = ROOT / "docs/gallery/reference-six-bar/device.xml"
LEAVES = ROOT / "docs/gallery/leaf-four-bar/device.xml"
sys.dont_write_bytecode = True


def klayout(home, script, *options, view=True, **variables):
    return subprocess.run(["klayout", *(["-z", "-nc"] if view else ["-b"]), "-r", script, *options], capture_output=True, text=True, timeout=280, check=False,
                          env=dict(os.environ, QT_QPA_PLATFORM="offscreen", LC_ALL="C", KLAYOUT_HOME=str(home), KLAYOUT_PATH=str(home), **variables))


class Package(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.here = here = pathlib.Path(cls.folder.name)
        (here / "salt").mkdir()
        shutil.copytree(PACKAGE, here / "salt/flexwright")
        if not (here / "salt/flexwright/devices").exists():  # the install puts the examples there
            for device in sorted((ROOT / "docs/gallery").glob("*/device.xml")):
                (here / "salt/flexwright/devices").mkdir(exist_ok=True)
                shutil.copy(device, here / "salt/flexwright/devices" / (device.parent.name + ".xml"))
        for name, more in (("reference", []), ("changed", ["--set", "link=130 um"])):
            out = here / ("out-" + name)
            subprocess.run([PROGRAM, "mask", SIX_BAR, "--flow", "al-masked-rie", "--mask-format", "gds", "--corners", "none", "--advice", "none", "--accuracy",
                            "3e-2", "--hinge-model", "revolute", "--force", "-q", *more, "-o", out], check=False, capture_output=True)
            shutil.copy(out / "masks/al-masked-rie.gds", here / (name + ".gds"))
        shutil.copy(SIX_BAR, here / "device.xml")
        (here / "devices").mkdir()
        (here / "devices/mine.xml").write_text(SIX_BAR.read_text().replace('name="reference-six-bar"', 'name="mine"'))
        (here / "narrow.xml").write_text(LEAVES.read_text().replace('gap="8 um"', 'gap="5 um"'))
        shutil.copy(ROOT / "tests/bad/dimension-wrong.xml", here / "bad.xml")
        done = klayout(here, HERE / "drive_package.py", "-rd", "work=%s" % here, FLEXWRIGHT_PROGRAM=str(PROGRAM),
                       FLEXWRIGHT_DEVICES=str(here / "devices"))
        if not (here / "result.json").exists():
            raise RuntimeError(done.stdout + done.stderr)
        cls.out = json.loads((here / "result.json").read_text())
        cls.said = done.stdout + done.stderr

    @classmethod
    def tearDownClass(cls):
        if "FW_KEEP" in os.environ:
            shutil.copytree(cls.here, os.environ["FW_KEEP"], dirs_exist_ok=True)
        cls.folder.cleanup()

    def test_nothing_failed(self):
        self.assertNotIn("trace", self.out, self.out.get("trace", "") + self.said)

    def test_is_there(self):
        self.assertIn("Flexwright", self.out["libraries"])
        for flow in (p.stem for p in (ROOT / "masks").glob("*.xml")):
            self.assertIn("flexwright-" + flow, self.out["technologies"])
        self.assertEqual([m.split(".")[-1] for m in self.out["menu"]], ["plan", "reload", "check", "settings"])
        self.assertLessEqual({p.parent.name for p in (ROOT / "docs/gallery").glob("*/device.xml")} | {"mine", "device file"}, set(self.out["cells"]))

    def test_parameters(self):
        self.assertEqual(self.out["parameters"]["p_link"], ["120 um", "link (110 um to 200 um): width of the four links"])
        self.assertEqual(self.out["parameters"]["flow"][0], "al-masked-rie")

    def test_draws_the_mask(self):
        self.assertEqual(self.out["xor"], [0, 0, 0, 0])
        self.assertEqual(self.out["xor_changed"], 0)
        self.assertEqual(self.out["xor_any"], 0)
        self.assertGreater(self.out["differs"], 0)
        self.assertEqual(self.out["only"][0], 0)
        self.assertGreater(self.out["only"][1], 0)
        self.assertLess(abs(self.out["coarse_um2"] / self.out["fine_um2"] - 1), 1e-4)
        before, after, changed = self.out["follows"]
        self.assertEqual(after, changed)
        self.assertNotEqual(before, after)

    def test_every_device_is_drawn(self):
        """each with its own parameters, beside the others"""
        self.assertGreater(len(self.out["gallery"]), 6)
        for name, (area, said) in self.out["gallery"].items():
            self.assertEqual(said, [], name)
            self.assertGreater(area, 0, name)

    def test_redraws_quickly(self):
        """a second on a quiet machine; what did not change is not drawn again"""
        print("first %(first_s).2f s, other parameter %(redraw_s).2f s, other layers %(again_s).2f s, plan %(plan_s).1f s" % self.out)
        self.assertLess(self.out["again_s"], 0.5 * max(0.5, self.out["redraw_s"]))

    def test_errors_are_in_the_cell(self):
        for name, code in (("wrong unit", "FW-D024"), ("unknown unit", "FW-D021"), ("out of range", "FW-D"), ("bad file", "FW-D025")):
            text = " ".join(self.out["errors"][name])
            self.assertIn("error: ", text, name)
            self.assertIn(code, text, name)
        self.assertIn("bad.xml:6:70", " ".join(self.out["errors"]["bad file"]))
        self.assertIn("cannot be read", " ".join(self.out["errors"]["absent"]))
        self.assertIn("NAME=VALUE", " ".join(self.out["errors"]["bad pairs"]))
        self.assertEqual([t for t in self.out["errors"]["any"] if "error" in t], [])

    def test_script_of_the_page(self):
        """what docs/klayout.md says of scripts without a window is run as it stands there"""
        code = re.search(r"^```python\n(import pya\n.*?)^```", (ROOT / "docs/klayout.md").read_text(), re.M | re.S).group(1)
        (self.here / "place.py").write_text(code.replace('"placed.gds"', repr(str(self.here / "placed.gds"))))
        done = klayout(self.here, self.here / "place.py", view=False, FLEXWRIGHT_PROGRAM=str(PROGRAM))
        self.assertIn("'p_arc': '230 deg'", done.stdout, done.stdout + done.stderr)
        self.assertGreater((self.here / "placed.gds").stat().st_size, 20000)

    def test_plan_and_markers(self):
        self.assertEqual(self.out["technologies_shown"], ["flexwright-al-masked-rie"] * self.out["views"])
        self.assertGreater(min(self.out["items"]), 0)
        self.assertTrue(any("space" in c for c in self.out["categories"][0]), self.out["categories"])
        same, items, views = self.out["reloaded"]
        self.assertTrue(same)
        self.assertEqual(items, [0] * len(items))
        self.assertEqual(views, self.out["views"])
        self.assertIn("bad.xml:6:70", " ".join(self.out["plan_error"]))
        self.assertGreater((self.here / "shown.png").stat().st_size, 5000)

    def test_technologies_are_current(self):
        """those of klayout/tech are what the program and the generator make; klayout/make_tech.py PROGRAM writes them anew"""
        sys.path.insert(0, str(ROOT / "klayout"))
        import make_tech
        made = make_tech.technologies(PROGRAM, sorted(p.stem for p in (ROOT / "masks").glob("*.xml")))
        there = {str(p.relative_to(ROOT / "klayout/tech")): p.read_text() for p in (ROOT / "klayout/tech").rglob("*.ly*")}
        self.assertEqual(sorted(made), sorted(there))
        for name, text in made.items():
            self.assertEqual(text, there[name], name)


if __name__ == "__main__":
    if not shutil.which("klayout"):
        print("SKIPPED: klayout is not installed (Debian: apt-get install klayout)")
        sys.exit(77)
    unittest.main()
