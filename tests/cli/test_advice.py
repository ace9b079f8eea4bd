#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What is proposed is followed, as a user would: with --set, in text, JSON and page. Every proposal accepts with a plain
`check`, and 2 % less of its change does not."""
import html
import json
import math
import os
import pathlib
import random
import re
import tempfile
import unittest

from common import ALL, ROOT, loose_gripper, only_all, run

NODDER = ROOT / "docs/gallery/copper-nodder/device.xml"
LEAF = ROOT / "docs/gallery/leaf-four-bar/device.xml"
COMB = ROOT / "docs/gallery/comb-stage/device.xml"
STRICT = "limits/@safety-factor=10"
SIX = ROOT / "docs/gallery/reference-six-bar/device.xml"
PLANS = os.environ.get("FW_GALLERY_PLANS")  # what tests/golden/plans.sh has left of the gallery


class Parameters(unittest.TestCase):
    def expect(self, result, status):
        self.assertEqual(result.returncode, status, result.stdout[-2000:] + result.stderr[-4000:])
        return result

    @classmethod
    def setUpClass(cls):
        """a rejected design, planned once"""
        here = tempfile.TemporaryDirectory()
        cls.addClassCleanup(here.cleanup)
        cls.leaf = pathlib.Path(here.name) / "leaf"
        cls.rejected = run("plan", LEAF, "--set", STRICT, "-o", cls.leaf)

    def follow(self, device, *sets, plan=None):
        """every proposal is accepted; returns what is said of each parameter"""
        arguments = [a for s in sets for a in ("--set", s)]
        if plan:
            document = (plan / "verdict.json").read_text()
        elif PLANS and not sets and device.is_relative_to(ROOT / "docs/gallery"):  # its verdict.json is what check --json prints
            plan = pathlib.Path(PLANS) / device.parent.name
            self.assertIn(int(plan.with_name(plan.name + ".status").read_text()), (1, 4))
            document = (plan / "verdict.json").read_text()
        else:
            result = run("check", device, *arguments, "--json")
            self.assertIn(result.returncode, (1, 4), result.stderr)
            document = result.stdout
        said = json.loads(document)["advice_parameters"]
        declared = re.findall(r'<parameter name="(\w+)"', device.read_text())
        self.assertEqual(sorted(p["set"] for p in said), sorted(declared))
        for p in said:
            self.assertEqual(p["found"] == "accepts", p["value"] is not None, p)
            if p["found"] == "accepts":
                self.expect(run("check", device, *arguments, "--set", f"{p['set']}={p['value']}"), 0)
                self.assertLessEqual(p["from_SI"], p["value_SI"])
                self.assertGreaterEqual(p["to_SI"], p["value_SI"])
                self.assertAlmostEqual(p["change"], abs(p["value_SI"] / p["now_SI"] - 1), places=9)
        changes = [p["change"] for p in said if p["found"] == "accepts"]
        self.assertEqual(changes, sorted(changes))
        self.assertEqual([p["found"] for p in said], sorted(p["found"] for p in said))
        return {p["set"]: p for p in said}

    def test_a_device_of_which_nothing_is_drawn_is_advised_all_the_same(self):
        """it cannot be drawn whatever is changed, and that its changes could not be either was the reason why none was proposed"""
        with tempfile.TemporaryDirectory() as here:
            device = pathlib.Path(here, "device.xml")
            device.write_text("""<device xmlns="urn:flexwright:device:1" name="rot">
  <parameter name="push" value="2e-8 N m" min="1e-9 N m" max="1e-7 N m"/>
  <material ref="silicon-100" thickness="50 um"/>
  <limits safety-factor="1"/>
  <flexure id="leaf" kind="leaf" length="600 um" width="8 um"/>
  <mechanism>
    <body id="arm" mass="0.02 mg" inertia="0.01 mg mm^2" x="0 mm" y="0 mm"/>
    <revolute id="A" a="ground" b="arm" hinge="leaf" axis="0 deg" damping="2e-12 N m s/rad"/>
  </mechanism>
  <scene name="shake" duration="6 ms"><torque on="arm" value="push" law="sine" frequency="1000 Hz"/></scene>
  <probe id="turn" kind="angle" on="arm"/>
  <require probe="turn" measure="peak" max="0.02 rad" scene="shake"/>
</device>
""")
            said = self.follow(device)
            self.assertEqual({what: p["found"] for what, p in said.items()}, {"push": "accepts"})
            none = run("check", device, "--set", "push=1e-7 N m", "--set", "limits/@safety-factor=1000")
            self.assertNotIn("can be drawn", none.stdout)

    def test_what_cannot_be_made_is_another_matter(self):
        """of a device that its flow cannot make, for a layer that no parameter changes: each proposal says so, and is accepted by its
        motion when it is followed"""
        text = LEAF.read_text().replace('<flow ref="al-masked-rie"/>',
                                        '<flow ref="copper-on-porous-silicon" material="copper-plated" thickness="25 um"/>')
        with tempfile.TemporaryDirectory() as place:
            path = pathlib.Path(place) / "d.xml"
            path.write_text(text)
            found = json.loads(self.expect(run("check", path, "--json", "--measurements", "none"), 1).stdout)
            said = found["advice"] + [p for p in found["advice_parameters"] if p["found"] == "accepts"]
            self.assertGreater(len(said), 1)
            for p in said:
                self.assertIn("that it cannot be made in copper-on-porous-silicon is another matter", p["text"])
            changed = run("check", path, "--measurements", "none", *(x for c in found["advice"][0]["set"]
                                                                      for x in ("--set", f'{c["path"]}={c["value"]}')))
            self.assertIn("ACCEPT, but cannot be made", self.expect(changed, 1).stdout)

    def test_how_far_each_parameter_comes(self):
        """of a stroke that no change reaches: what was tried, and the value that comes nearest, which another run finds too"""
        text = (ROOT / "docs/gallery/straight-stage/device.xml").read_text()
        text = re.sub(r'<require .*?/>', "", text).replace(
            "  <scene ", '  <require probe="stroke" measure="final" min="3 mm"/>\n  <scene ', 1)
        with tempfile.TemporaryDirectory() as place:
            path = pathlib.Path(place) / "d.xml"
            path.write_text(text)
            found = json.loads(run("check", path, "--json", "--corners", "none").stdout)
            self.assertEqual(found["advice"], [])
            told = 0
            for p in found["advice_parameters"]:
                nearest = re.search(r"the nearest that was looked at, (.*?), misses what is asked by a factor of (\S+) "
                                    r"\(now (\S+)\)$", p["text"])
                if not nearest:
                    self.assertRegex(p["text"], "none that was looked at comes nearer|does not go with it|was tried")
                    continue
                told += 1
                self.assertLess(float(nearest[2]), float(nearest[3]))
                at = json.loads(run("check", path, "--json", "--corners", "none", "--advice", "none", "--set",
                                    f"{p['set']}={nearest[1]}").stdout)["requirements"][0]["value"]
                self.assertAlmostEqual(3e-3 / at, float(nearest[2]), delta=0.1 * float(nearest[2]))
            self.assertGreater(told, 0)

    @only_all
    def test_of_a_design_that_tires(self):
        said = self.follow(NODDER)
        self.assertEqual(said["leaf"]["found"], "none")
        self.assertIn("from 200 um to 600 um", said["leaf"]["text"])
        self.assertEqual({n: said[n]["found"] for n in ("width", "push")}, {"width": "accepts", "push": "accepts"})

    def test_of_other_designs(self):
        said = self.follow(LEAF, STRICT, plan=self.leaf)
        self.assertEqual(said["width"]["found"], "accepts")
        if ALL:  # pass four other edges of all that the tests of this file do not pass elsewhere, and none of what proposes
            said = self.follow(COMB, "volts=100 V")
            self.assertLess(said["volts"]["value_SI"], 100)
            self.assertGreater(said["volts"]["value_SI"], 50)
            self.follow(SIX, "limits/@safety-factor=2.6")

    def test_text_and_page_say_the_same(self):
        self.expect(self.rejected, 1)
        text = self.rejected.stdout.split("what to change, the least first")[1]
        said = json.loads((self.leaf / "verdict.json").read_text())
        page = html.unescape((self.leaf / "report.html").read_text())
        for p in said["advice"] + said["advice_parameters"]:
            self.assertIn(p["text"], text)
            self.assertIn(p["text"], page)
        printed = re.findall(r'--set "([^"]*)"', text)
        self.assertEqual(printed, [f"{s['path']}={s['value']}" for p in said["advice"] for s in p["set"]])
        self.assertEqual(set(re.findall(r"--set '([^']*)'", page)), set(printed))
        self.assertIn(f"do: {said['advice'][0]['text']}", self.rejected.stdout)

    def test_accepted_designs_are_told_nothing(self):
        result = self.expect(run("check", LEAF), 0)
        self.assertNotIn("parameter", result.stdout)
        printed = run("check", LEAF, "--json").stdout
        self.assertEqual(json.loads(printed)["advice_parameters"], [])
        self.assertEqual(json.loads(printed)["advice"], [])
        if PLANS:
            self.assertEqual(printed, (pathlib.Path(PLANS) / "leaf-four-bar/verdict.json").read_text())


STAGE = ROOT / "docs/gallery/straight-stage/device.xml"
UNIT = {"": 1, "%": 0.01, "um": 1e-6, "mm": 1e-3, "uN": 1e-6, "mN": 1e-3, "N": 1, "V": 1, "rad": 1, "mrad": 1e-3, "deg": math.pi / 180, "nm": 1e-9,
        "m": 1, "mN mm": 1e-6, "uN mm": 1e-9}


def number(text):
    value, _, unit = text.partition(" ")
    return float(value) * UNIT[unit]


class Proposals(unittest.TestCase):
    def setUp(self):
        self.directory = tempfile.TemporaryDirectory()
        self.addCleanup(self.directory.cleanup)

    def changed(self, device, *changes):
        text = device.read_text()
        for old, new in changes:
            self.assertIn(old, text)
            text = text.replace(old, new)
        path = pathlib.Path(self.directory.name) / device.name
        path.write_text(text)
        return path

    def judged(self, device, *sets, more=()):
        arguments = [a for s in sets for a in ("--set", s)]
        return run("check", device, "--advice", "none", "--json", *arguments, *more).returncode

    def now(self, device, path):
        """the value that the file has, of a parameter or an attribute of a flexure or a load"""
        text = device.read_text()
        found = re.search(rf'<parameter name="{path}" value="([^"]*)"', text)
        if not found:
            element, id_, attribute = re.fullmatch(r"(?:.*/)?([\w-]+)\[([\w-]+)\]/@([\w-]+)", path).groups()
            tags = [t for t in re.findall(rf"<{element}\b[^>]*>", text)]
            tag = tags[int(id_) - 1] if id_.isdigit() else next(t for t in tags if f'id="{id_}"' in t)
            found = re.search(rf'\b{attribute}="([^"]*)"', tag)
        value = found.group(1)
        return self.now(device, value) if re.fullmatch(r"[a-z_]\w*", value) else number(value)

    def follow(self, device, least=("parameter", "flexures", "several"), more=()):
        """every proposal accepts; of these kinds 2 % less of the change does not, or of a small change 0.2 % of the value, which is
        searched for to 0.1 % and then given as one would type it, or a last digit"""
        result = run("check", device, "--json", *more)
        self.assertIn(result.returncode, (1, 4), result.stderr)
        document = json.loads(result.stdout)
        advice = document["advice"]
        changes = [round(p["change"], 3) for p in advice]
        self.assertEqual(changes, sorted(changes))
        for p in advice:
            sets = [f"{s['path']}={s['value']}" for s in p["set"]]
            self.assertEqual(self.judged(device, *sets, more=more), 0, p)
            if p["kind"] not in least:
                continue
            less = []
            for s in p["set"]:
                was, to, unit = self.now(device, s["path"]), number(s["value"]), s["value"].partition(" ")[2]
                part = to * (was / to) ** 0.02 if was > 0 else to - 0.02 * (to - was)
                if abs(part - to) < 2e-3 * abs(was):
                    part = to + math.copysign(min(2e-3 * abs(was), abs(was - to)), was - to)
                if s["path"].startswith("flexure") and abs(part - to) < 1e-7:
                    part = to + (1e-7 if was > to else -1e-7)
                less.append(f"{s['path']}={part / UNIT[unit]:.9g} {unit}")
            self.assertNotEqual(self.judged(device, *less, more=more), 0, (p, less))
        return document

    @only_all
    def test_lengths_are_the_least(self):
        """strain under a given rotation: a six-bar whose hinges are too short by random parts"""
        rng = random.Random(1)
        for _ in range(2 if ALL else 1):
            text = SIX.read_text()
            for name in rng.sample("ABCDEF", 2):
                text = re.sub(rf'(<flexure id="{name}"[^>]*length=)"([0-9.]+) um"',
                              lambda m: f'{m[1]}"{float(m[2]) * rng.uniform(0.3, 0.5):.0f} um"', text)
            device = pathlib.Path(self.directory.name) / "short.xml"
            device.write_text(text)
            document = self.follow(device)
            self.assertIn("flexures", [p["kind"] for p in document["advice"]])

    def test_two_at_once(self):
        """neither the pull nor the width alone reaches stroke and frequency; without corners none of pull, width and leg does, in a
        quarter of the time, and that proposals hold at the corners is seen of the others here"""
        rng = random.Random(2)
        pull = rng.uniform(55, 65)
        narrow = () if ALL else (('min="8 um" max="16 um"', 'min="11.3 um" max="16 um"'), ('max="2.6 mm"', 'max="2.3 mm"'))
        most = 90 if ALL else 70
        device = self.changed(STAGE, ('value="115 uN" min="0 uN" max="200 uN"', f'value="{pull:.1f} uN" min="0 uN" max="{most} uN"'),
                              ('min="400 Hz"', f'min="{rng.uniform(540, 570):.0f} Hz"'), *narrow)
        document = self.follow(device, more=() if ALL else ("--corners", "none"))
        self.assertTrue(all(p["found"] != "accepts" for p in document["advice_parameters"]))
        proposal, = document["advice"]
        self.assertEqual(proposal["kind"], "several")
        self.assertGreaterEqual(len(proposal["set"]), 2)

    @only_all
    def test_of_opposite_corners(self):
        """a frequency fails of thin walls and a stroke of thick ones: a search that looks at one corner of the flow at a time goes
        from the one to the other, and finds neither; 14 um and 200 uN is a device that holds both"""
        device = self.changed(STAGE, ('min="400 Hz"', 'min="700 Hz"'))
        self.assertEqual(self.judged(device, "width=14 um", "pull=200 uN"), 0)
        document = self.follow(device, least=())
        self.assertTrue(document["advice"], document["advice_note"])
        proposal = document["advice"][0]
        self.assertEqual((proposal["kind"], len(proposal["set"])), ("several", 2))
        self.assertLess(proposal["change"], 0.12)

    @only_all
    def test_parameters_hold_what_hangs_on_them(self):
        """a width or a pull goes no farther than min and max of its parameter, by whichever name it is set; a length that hangs on
        none is free"""
        device = self.changed(STAGE, ('measure="final" min="40 um"', 'measure="final" min="75 um"'), ('max="200 uN"', 'max="120 uN"'),
                              ('max="2.6 mm"', 'max="2.21 mm"'), ('min="8 um" max="16 um"', 'min="11.9 um" max="16 um"'))
        document = json.loads(run("check", device, "--corners", "none", "--json").stdout)
        self.assertTrue(document["advice"])
        sets = [s for p in document["advice"] for s in p["set"]]
        for s in sets:
            value = number(s["value"])
            if s["path"] in ("width", "flexure[leaf]/@width"):
                self.assertTrue(11.9e-6 - 1e-12 <= value <= 16e-6 + 1e-12, s)
            if s["path"] == "pull" or "tendon" in s["path"]:
                self.assertLessEqual(value, 120e-6 + 1e-12, s)
        self.assertIn("flexure[leaf]/@length", [s["path"] for s in sets])

    @only_all
    def test_a_value_between_two_ends_that_are_worse(self):
        """a pull that is too much, of which the least is far too little: what it may be lies between, and corners are worse than the
        present value, of which the drawing alone was judged. "No value was found, and none comes nearer" was said"""
        device = self.changed(STAGE, ('value="115 uN"', 'value="200 uN"'))
        document = json.loads(run("check", device, "--json").stdout)
        pull, = [p for p in document["advice_parameters"] if p["set"] == "pull"]
        self.assertEqual(pull["found"], "accepts", pull)
        self.assertTrue(110e-6 < pull["value_SI"] < 130e-6, pull)

    @only_all
    def test_units_are_those_of_the_file(self):
        """a required box in degrees and in parameters, loads in units of any size, and lengths in millimetres come back in them"""
        text = SIX.read_text()
        for old, new in (('phi-min="-2 deg" phi-max="2 deg"', 'phi-min="-tilt" phi-max="2*(1 deg)"'), ('x-min="-150 um"', 'x-min="-0.15 mm"'),
                         ('fx="0.25 mN"', 'fx="0.00025 N"'), ('<parameter name="link"', '<parameter name="tilt" value="2 deg"/>\n  <parameter name="link"'),
                         ('length="200 um"', 'length="0.2 mm"'), ("safety-factor=\"1.5\"", "safety-factor=\"2.6\"")):
            self.assertIn(old, text)
            text = text.replace(old, new)
        device = pathlib.Path(self.directory.name) / "units.xml"
        device.write_text(text)
        document = json.loads(run("check", device, "--corners", "none", "--json").stdout)
        unit = {s["path"]: s["value"].partition(" ")[2] for p in document["advice"] for s in p["set"]}
        said = {"workspace[1]/@phi-min": "deg", "workspace[1]/@phi-max": "deg", "workspace[1]/@x-min": "mm", "workspace[1]/@x-max": "um",
                "scene[step-load]/force[1]/@fx": "N", "scene[step-load]/force[1]/@fy": "mN", "scene[step-load]/torque[1]/@value": "mN mm",
                "flexure[C]/@length": "mm"}
        self.assertEqual({path: unit.get(path) for path in said}, said, document["advice"])
        lengths, = [p["text"] for p in document["advice"] if p["kind"] == "flexures"]
        self.assertRegex(lengths, r"flexure C: arc length >= 0\.2\d+ mm is accepted; now 0\.2 mm")
        for p in document["advice"]:
            self.assertEqual(self.judged(device, *(f"{s['path']}={s['value']}" for s in p["set"]), more=("--corners", "none")), 0, p)

    @only_all
    def test_of_what_meets(self):
        """jaws that close too far (trials look at clearances at more corners than a check does)"""
        device = pathlib.Path(self.directory.name) / "gripper.xml"
        device.write_text(loose_gripper(pull="40 uN"))
        document = self.follow(device, least=("parameter",))
        self.assertEqual({r["code"] for r in document["reasons"]}, {"FW-D294"})
        self.assertGreaterEqual({p["kind"] for p in document["advice"]}, {"parameter", "loads"})

    def test_of_mixed_reasons(self):
        """a hinge beyond its limit, jaws that meet, and no parameter: settings all the same"""
        text = loose_gripper()
        for name, value in (("span", "0.6 mm"), ("face", "570 um"), ("pull", "500 uN"), ("copper_pull", "1.8 uN")):
            text = re.sub(rf'  <parameter name="{name}"[^>]*>\n', "", text)
            text = re.sub(rf"\b{name}\b(?=[^<>]*>)(?!=)", f"({value})", text)
        device = pathlib.Path(self.directory.name) / "mixed.xml"
        device.write_text(text)
        document = self.follow(device, least=())
        self.assertTrue(document["advice"], document["advice_note"])
        self.assertTrue(all(p["set"] for p in document["advice"]))


if __name__ == "__main__":
    unittest.main()
