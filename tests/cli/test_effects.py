#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every scene of tests/data/effects runs in simulate and statics, with the effects that it is about."""
import json
import pathlib
import re
import tempfile
import unittest

from common import ROOT, run

EXAMPLES = ROOT / "tests/data/effects"
EFFECTS = len(re.findall(r"^FW_EFFECT(?:_ELEMENT)?\(\w+", (ROOT / "src/device/effects.def").read_text(), re.M))
ABOUT = {
    ("tendons", "pulled"): {"tendon"},
    ("tendons", "drawn"): {"tendon"},
    ("comb", "drive"): {"comb-drive", "fringe-field", "air", "material-damping"},
    ("comb", "oscillate"): {"comb-drive", "fringe-field", "material-damping"},
    ("comb", "pull-back"): {"comb-drive", "joint-damping"},
    ("shaken", "shock"): {"base-motion", "gravity", "air"},
    ("shaken", "vibration"): {"base-motion", "air"},
    ("shaken", "warm"): {"temperature", "residual-stress", "applied-load"},
    ("shaken", "cold"): {"temperature"},
    ("rubbing", "pressed"): {"contact", "friction", "nonlinear-hinge"},
    ("rubbing", "slipping"): {"friction", "gravity"},
    ("rubbing", "bumping"): {"contact"},
    ("closing-film", "pressed-home"): {"air"},
}
BEYOND = ("comb", "pull-in")


def example(name):
    return EXAMPLES / f"{name}.xml"


class Effects(unittest.TestCase):
    def result(self, done):
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    def test_every_scene_is_here(self):
        found = {(f.stem, scene) for f in EXAMPLES.glob("*.xml")
                 for scene in re.findall(r'<scene name="([^"]+)"', f.read_text())}
        self.assertEqual(found, set(ABOUT) | {BEYOND})

    def test_simulate(self):
        for (name, scene), about in ABOUT.items():
            with self.subTest(device=name, scene=scene):
                r = self.result(run("simulate", example(name), "--scene", scene, "--json"))
                self.assertLess(r["stats"]["energy_error"], 1e-3)
                ledger = {e["id"]: e for e in r["effects"]}
                self.assertEqual(len(ledger), EFFECTS)
                self.assertEqual({i for i in about if ledger[i]["active"] and ledger[i]["called_for"]}, about)
                self.assertTrue(any(p["angle_rad"] != 0 for p in r["peaks"]))

    def drawn(self, name, old="", new=""):
        """what the program says of a gallery device with one change, and its mask"""
        text = (ROOT / "docs/gallery" / name / "device.xml").read_text()
        self.assertTrue(not old or old in text)
        with tempfile.TemporaryDirectory() as here:
            device = pathlib.Path(here) / "device.xml"
            device.write_text(text.replace(old, new) if old else text)
            asked = ("--corners", "none", "--advice", "none", "-o", pathlib.Path(here) / "out")
            done = run("mask", device, *asked)
            flow = re.search('flow ref="([^"]*)"', text).group(1)
            if old:  # what is not drawn is rejected, and has no mask unless it is forced
                self.assertEqual(done.returncode, 1, done.stderr)
                self.assertFalse((pathlib.Path(here) / f"out/masks/{flow}.svg").exists())
                done = run("mask", device, "--force", *asked)
            self.assertEqual(done.returncode, 1 if old else 0, done.stderr)
            masks = pathlib.Path(here) / "out/masks"
            if old:
                self.reason_stands(masks, flow)
            picture = (masks / f"{flow}.svg").read_text()
            return done.stderr, "".join(re.findall(r"""\bd=["']([^"']*)["']""", picture))  # what is drawn, without titles

    def reason_stands(self, masks, flow):
        """on certificate and order sheet, with part, place and nearest room"""
        sheets = sorted(masks.glob(f"{flow}*.order.json"))
        self.assertTrue(sheets)
        for file in (masks / f"{flow}.json", *sheets):
            sheet = json.loads(file.read_text())
            self.assertTrue(sheet["rejected"])
            self.assertTrue(any(re.search(r"line \d+, column \d+.*not in the masks.*nearest room: .*FW-D131", r)
                                for r in sheet["rejected_because"]), sheet["rejected_because"])
        self.assertRegex(sheets[-1].with_suffix(".txt").read_text(),
                         r"^REJECTED: .*Do not order\.\n  because .* at \([-0-9.]+, [-0-9.]+\) um.*nearest room: ")

    def test_what_is_not_drawn_is_rejected(self):
        """check and plan, their JSON and the run sheet"""
        text = (ROOT / "docs/gallery/comb-stage/device.xml").read_text()
        with tempfile.TemporaryDirectory() as here:
            device = pathlib.Path(here) / "device.xml"
            device.write_text(text.replace('x="0.43 mm" y="0.44 mm"', 'x="0.75 mm" y="0.1 mm"'))
            done = run("check", device, "--corners", "none", "--advice", "none", "--json")
            self.assertEqual(done.returncode, 1, done.stderr)
            said = json.loads(done.stdout)
            self.assertEqual((said["verdict"], said["drawn"]), ("reject", "reject"))
            part = said["not_drawn"][0]
            self.assertEqual((part["part"], part["code"]), ("comb drive upper", "FW-D131"))
            self.assertIn("link right", part["why"])
            x, y = re.search(r'x="([-0-9.]+ um)" y="([-0-9.]+ um)"', part["nearest_room"]).groups()
            self.assertEqual([r["code"] for r in said["reasons"]], ["FW-D131"])
            out = pathlib.Path(here) / "out"
            done = run("plan", device, "--corners", "none", "--advice", "none", "--force", "-o", out)
            self.assertEqual(done.returncode, 1, done.stderr)
            for name in ("report.html", "recipes/silicon-on-glass.html", "recipes/silicon-on-glass.csv",
                         "recipes/silicon-on-glass.json", "masks/silicon-on-glass.device.order.txt"):
                self.assertIn("comb drive upper at (", (out / name).read_text(), name)
            # moved to the room that is named it is accepted
            device.write_text(text.replace('x="0.43 mm" y="0.44 mm"', f'x="{x}" y="{y}"'))
            done = run("check", device, "--corners", "none", "--advice", "none")
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_what_moves_a_device_is_in_its_mask(self):
        said, whole = self.drawn("comb-stage")
        self.assertNotIn("FW-D131", said)
        # fingers in the midst of another link: named with the place
        said, less = self.drawn("comb-stage", 'x="0.43 mm" y="0.44 mm"', 'x="0.75 mm" y="0.1 mm"')
        self.assertRegex(said, r"comb drive upper .* not drawn: .*link right at \([-0-9.]+, [-0-9.]+\) um.*FW-D131")
        self.assertEqual(len(re.findall("FW-D131", said)), 1)
        self.assertLess(len(less), len(whole))
        # fingers so narrow that no mask shows their tips: named with the width, and the width that is named is drawn
        text = (ROOT / "docs/gallery/comb-stage/device.xml").read_text()
        said, less = self.drawn("comb-stage", 'overlap="40 um"', 'width="5.5 um" overlap="40 um"')
        self.assertRegex(said, r"its fingers are 5.5 um wide, so that their tips are rounded with 2.2 um only")
        self.assertNotIn("steps or slits", said)
        with tempfile.TemporaryDirectory() as here:
            device = pathlib.Path(here) / "device.xml"
            enough = re.search(r"make them ([\d.]+) um wide", said).group(1)
            device.write_text(text.replace('overlap="40 um"', f'width="{enough} um" overlap="40 um"'))
            self.assertNotIn("FW-D131", run("mask", device, "--force", "--corners", "none", "--advice", "none",
                                            "-o", pathlib.Path(here) / "out").stderr)
        said, whole = self.drawn("four-tendons")
        self.assertNotIn("FW-D131", said)
        said, less = self.drawn("four-tendons", 'x="0.6 mm" y="0.12 mm"', 'x="0.65 mm" y="0.12 mm"')
        self.assertRegex(said, r"eyelet of tendon T2 at .* not drawn: .*hinge D at \([-0-9.]+, [-0-9.]+\) um")
        self.assertLess(len(less), len(whole))

    def test_explicit_steps_are_given_up(self):
        """not stiff at its start, later explicit steps would never end; where they would, implicit ones are still cheaper"""
        r = self.result(run("simulate", example("closing-film"), "--json"))
        self.assertEqual(r["integrator"], "radau5")
        short = ("simulate", example("closing-film"), "--json", "--scene", "pressed-home",
                 "--set", "scene[pressed-home]/@duration=0.3 ms")
        tried, explicit = self.result(run(*short)), self.result(run(*short, "--integrator", "dop853"))
        self.assertEqual(tried["integrator"], "radau5")
        self.assertIn("tried", tried["reason"])
        self.assertLess(tried["accuracy"]["rhs"], explicit["accuracy"]["rhs"])

    def test_load_that_ends(self):
        """a jump of the joint force is no peak between two instants"""
        used = []
        for off in ("0.1 ms", "0.173 ms"):
            done = run("check", ROOT / "tests/data/load-that-ends.xml", "--advice", "none", "--json", "--set", f"off={off}")
            self.assertIn(done.returncode, (0, 1), done.stderr)  # 1: no flow can make it
            hinge = json.loads(done.stdout)["hinges"][0]
            used.append(hinge["utilisation"])
            self.assertEqual(hinge["t_s"], 0)
        self.assertAlmostEqual(used[0], used[1], delta=1e-6)

    def test_statics(self):
        for name, scene in ABOUT:
            if name == "closing-film":
                continue  # at rest its walls touch
            with self.subTest(device=name, scene=scene):
                r = self.result(run("statics", example(name), "--scene", scene, "--json"))
                for entry in r["pull_in"]:
                    self.assertGreater(entry["margin"], 2)

    def test_pull_in(self):
        name, scene = BEYOND
        done = run("simulate", example(name), "--scene", scene, "--json")
        self.assertEqual(done.returncode, 7)
        self.assertIn("FW-D242", done.stderr)
        self.assertIn("FW-D248", done.stderr)
        text = run("statics", example(name), "--scene", scene).stderr
        self.assertIn("FW-D248", text)

    def test_table_groups_what_is_not_called_for(self):
        text = run("simulate", example("tendons"), "--scene", "pulled").stdout
        table = text[text.index("  effect "):].splitlines()
        self.assertTrue(table[-1].startswith("  not called for: ") or table[-2].startswith("  not called for: "))
        self.assertFalse([line for line in table if "not called for by the scene" in line])
        self.assertIn("friction", [line for line in table if line.startswith("  not called for: ")][0])
        self.assertIn("  tendon             yes", text)


if __name__ == "__main__":
    unittest.main()
