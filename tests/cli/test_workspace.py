#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The workspace through the program; its certificate verified, and refused when it was changed."""
import cmath
import copy
import json
import math
import pathlib
import random
import re
import sys
import tempfile
import unittest
import unittest.mock
import xml.etree.ElementTree as tree

from common import ALL, GALLERY, ROOT, run

sys.path.insert(0, str(ROOT / "tests/accept"))
import check_certificate  # noqa: E402
import check_volume  # noqa: E402
from check_certificate import Refused, Undecided  # noqa: E402


def bits(text, change):
    return change(float.fromhex(text)).hex()


class InTemporary(unittest.TestCase):
    """the workspace of the six-bar, once for all who look at it"""
    here = None

    @classmethod
    def setUpClass(cls):
        if InTemporary.here is None:
            InTemporary.first()

    @classmethod
    def first(cls):
        temporary = tempfile.TemporaryDirectory()
        unittest.addModuleCleanup(temporary.cleanup)
        cls.here = pathlib.Path(temporary.name)
        cls.out = cls.here / "out"
        cls.result = run("workspace", GALLERY, "-o", cls.out, "--json")
        cls.data = json.loads(cls.result.stdout)
        cls.certificate = json.loads((cls.out / "certificate.json").read_text())


class Workspace(InTemporary):
    def test_files_and_schema(self):
        self.assertEqual(self.result.returncode, 0, self.result.stderr)
        self.assertEqual(sorted(p.name for p in self.out.iterdir()),
                         ["certificate.json", "workspace.json", "workspace.svg"])
        self.assertEqual((self.out / "workspace.json").read_text(), self.result.stdout.rstrip("\n") + "\n")
        self.assertEqual(self.data["schema"], "flexwright.workspace/1")
        self.assertEqual([f["flow"] for f in self.data["flows"]],
                         ["al-masked-rie", "copper-on-porous-silicon"])
        picture = (self.out / "workspace.svg").read_text()
        tree.fromstring(picture)
        self.assertNotIn("nan", picture)

    def test_numbers_hang_together(self):
        for flow in self.data["flows"]:
            reach = flow["reachable"]
            low, high = reach["volume"]["m2_rad"]
            self.assertLess(0, low)
            self.assertLess(high, 1.02 * low)
            self.assertAlmostEqual(sum(reach["boundary_share"].values()), 1, delta=1e-9)
            extents = reach["extents"]
            box = math.prod(e[1][1] - e[0][0] for e in extents.values())
            self.assertLess(high, box)
            middle = reach["areas"][2]
            self.assertEqual(middle["phi_rad"], 0)
            self.assertGreater(middle["area_m2"][1] * (extents["phi_rad"][1][1] - extents["phi_rad"][0][0]), low)
            for required in flow["required"]:
                self.assertTrue(required["reachable"] and required["certified"])
                self.assertEqual(len(required["hinges"]), 6)
                for hinge in required["hinges"]:
                    self.assertEqual(hinge["within"], "yes")
                    self.assertLess(max(map(abs, hinge["angle_rad"])), hinge["limit_rad"])
                self.assertTrue(all(t["regular"] for t in required["singularities"]["parallel"]))

    def test_the_verdict_uses_the_proof(self):
        result = run("check", GALLERY, "--json")
        verdict = json.loads(result.stdout)
        self.assertTrue(verdict["workspace"]["certified"])
        self.assertTrue(all(b["certified"] for b in verdict["workspace"]["required"]))

    def test_same_bytes_twice(self):
        again = self.here / "again"
        run("workspace", GALLERY, "-o", again, "-q")
        for path in self.out.iterdir():
            self.assertEqual(path.read_bytes(), (again / path.name).read_bytes(), path.name)

    def test_beyond_the_limit_and_out_of_reach(self):
        """a box whose corner is beyond a limit is reachable, not within; a far one is not reachable"""
        text = GALLERY.read_text()
        wide = self.here / "wide.xml"
        wide.write_text(text.replace('x-min="-20 um" x-max="20 um"', 'x-min="-20 um" x-max="190 um"'))
        result = run("workspace", wide, "--flow", "copper-on-porous-silicon", "--json")
        box = json.loads(result.stdout)["flows"][0]["required"][0]
        self.assertTrue(box["certified"])
        self.assertIn("no", [h["within"] for h in box["hinges"]])
        far = self.here / "far.xml"
        far.write_text(text.replace('x-min="-20 um" x-max="20 um"', 'x-min="-20 um" x-max="3000 um"'))
        result = run("workspace", far, "--flow", "copper-on-porous-silicon", "--json")
        box = json.loads(result.stdout)["flows"][0]["required"][0]
        self.assertFalse(box["reachable"] or box["certified"])
        self.assertIn("NOT REACHABLE", run("workspace", far).stdout)

    def test_without_a_six_bar(self):
        result = run("workspace", ROOT / "docs/mechanisms/slider-crank.xml")
        self.assertEqual(result.returncode, 3)
        self.assertIn("FW-D217", result.stderr)

    def test_without_a_limit(self):
        """where a hinge has none there is no volume, and nothing is said of how well it is known"""
        text = GALLERY.read_text().replace(' flexure="A"', "")
        device = self.here / "limitless.xml"
        device.write_text(text)
        result = run("workspace", device, "-v")
        self.assertIn("a hinge has no elastic limit", result.stdout, result.stderr)
        self.assertNotIn("FW-D219", result.stderr)


def scaled(links, poses):
    """the reference design with its links scaled, and a required box that is scaled besides; no scenes"""
    text = GALLERY.read_text()
    head, rest = text.split("<six-bar>")
    bar, tail = rest.split("</six-bar>")
    bar = re.sub(r'\b(x|y|width|height)="([-\d.]+) mm"', lambda m: f'{m[1]}="{float(m[2]) * links:.5f} mm"', bar)
    bar = re.sub(r' (stiffness|damping|mass|inertia)="[^"]*"', "", bar).replace(' width="link"', "")
    bar = bar.replace("<link id", '<link mass="0.02 mg" inertia="0.003 mg mm^2" id')
    bar = bar.replace('<platform id="CD"', '<platform id="CD" mass="0.06 mg" inertia="0.01 mg mm^2"')
    tail = re.sub(r"<scene.*?</scene>", "", tail, flags=re.S)
    tail = re.sub(r"<(workspace|die)[^>]*>", "", tail)
    x, y, turn = 150 * links * poses, 60 * links * poses, 2 * poses
    box = (f'<workspace x-min="{-x} um" x-max="{x} um" y-min="{-y} um" y-max="{y} um" phi-min="{-turn} deg" '
           f'phi-max="{turn} deg"/>')
    head = re.sub(r"<flow[^>]*>", "", head)
    return head + "<six-bar>" + bar + "</six-bar>" + box + tail


class Judged(InTemporary):
    def test_short_links_are_judged_with_their_forces(self):
        """accepted by the rotation and 21 % for forces, beyond the limit by the strain"""
        device = self.here / "scaled.xml"
        for links, poses, more in ((1, 1.2, 1.2), (0.45, 1.3, 1.6), (0.35, 1.2, 1.8)):
            device.write_text(scaled(links, poses))
            result = run("check", device, "--json", "--advice", "none")
            verdict = json.loads(result.stdout)
            worst = verdict["governing"]
            rotation = abs(worst["peak_angle_rad"]) / worst["limit_angle_rad"]
            self.assertLess(rotation * 1.239, 1)
            self.assertGreater(worst["over_rotation"], more)
            self.assertEqual(worst["actuation"], "wrench on the platform")
            self.assertTrue(verdict["workspace"]["certified"])
            if links == 1:
                self.assertEqual(verdict["verdict"], "accept")
            else:
                self.assertGreater(worst["utilisation"], 1)
                self.assertIn(verdict["verdict"], ("inconclusive", "reject"))


    def test_scenes_that_hold_it_badly(self):
        """two forces side by side turn the platform by their distance only: a hundredth of its length is no hold"""
        device = self.here / "held.xml"
        text = scaled(1, 1)

        def judged(third, y):
            scene = (f'<scene name="held" duration="10 ms"><force on="CD" fx="1 uN" fy="0 N" y="{y}"/>'
                     f'<force on="CD" fx="0 N" fy="1 uN"/>{third}</scene>')
            device.write_text(text.replace("<workspace", scene + "<workspace"))
            result = run("check", device, "--json", "--advice", "none")
            return json.loads(result.stdout), result.stderr

        beside = '<force on="CD" fx="1 uN" fy="0 N"/>'
        for third, y, held in ((beside, "5 um", False), (beside, "400 um", True), ('<torque on="CD" value="1 uN mm"/>', "0 um", True),
                               ("", "0 um", True),  # fewer than three: the platform's wrench holds
                               (beside, "0 um", True)):  # likewise: the same force twice
            verdict, said = judged(third, y)
            reasons = [r for r in verdict["reasons"] if r["code"] == "FW-D536"]
            self.assertEqual(len(reasons), 0 if held else 1, (third, y, verdict["reasons"], said))
            self.assertEqual(verdict["verdict"], "accept" if held else "inconclusive", (third, y, verdict["reasons"]))


    def test_springs_weight_and_contacts(self):
        """a pose is held against them: what is accepted without is not with them, whichever way they are stated"""
        device = self.here / "against.xml"
        text = scaled(1, 1)
        torques = "".join(f'<torque on="{body}" value="1 nN mm"/>' for body in ("AB", "EF", "CD"))

        def judged(mechanism="", scene=""):
            device.write_text(text.replace("</six-bar>", f"</six-bar>{mechanism}").replace(
                "<workspace", f'<scene name="held" duration="1 us">{torques}{scene}</scene><workspace'))
            verdict = json.loads(run("check", device, "--json", "--advice", "none", "--corners", "none").stdout)
            return verdict, max(h["utilisation"] for h in verdict["hinges"])

        def spring(stiffness, more=""):
            return (f'<mechanism><spring id="S" a="ground" a-x="1.5 mm" a-y="6 mm" b="CD" stiffness="{stiffness} N/m" '
                    f'length="3.125 mm"{more}/></mechanism>')

        verdict, plain = judged()
        self.assertEqual(verdict["verdict"], "accept")
        for cable in ("", ' cable="yes"'):
            verdict, _ = judged(spring(3000, cable))
            self.assertNotEqual(verdict["verdict"], "accept")
            self.assertTrue(any("; against it spring S" in a["actuation"] for a in verdict["workspace"]["actuation"]))
        self.assertAlmostEqual(judged(spring(1e-6))[1], plain, delta=1e-6)
        touched = '<contact id="k" a="ground" a-x="1.5 mm" a-y="6 mm" b="CD" side="outside" distance="{} mm" stiffness="3000 N/m"/>'
        self.assertNotEqual(judged(scene=touched.format(3.125))[0]["verdict"], "accept")
        self.assertAlmostEqual(judged(scene=touched.format(2.9))[1], plain, delta=1e-6)  # never touched
        self.assertAlmostEqual(judged(scene='<gravity gy="-9.81 m/s^2"/>')[1], plain, delta=0.002)
        self.assertGreater(max(judged(scene=f'<gravity gy="{g} m/s^2"/>')[1] for g in (-98100, 98100)), 1.2 * plain)

    def judged_in(self, scene, mechanism=""):
        device = self.here / "in-scene.xml"
        device.write_text(scaled(1, 1).replace("</six-bar>", f"</six-bar>{mechanism}").replace("<workspace", f'<scene name="held" duration="1 us">{scene}</scene><workspace'))
        return json.loads(run("check", device, "--json", "--advice", "none", "--corners", "none").stdout)

    def test_friction_of_hinges(self):
        """takes a torque of either sign in each: more than a third above what holds the pose without, and said"""
        torques = "".join(f'<torque on="{body}" value="1 nN mm"/>' for body in ("AB", "EF", "CD"))

        def rubs(preload, hinges="ABCDEF", radius=100):
            return "".join(f'<friction on="{h}" coefficient="0.5" radius="{radius} um" preload="{preload} mN"/>' for h in hinges)

        def most(verdict):
            return {h["id"]: h["utilisation"] for h in verdict["hinges"]}

        plain, last = most(self.judged_in(torques)), None
        for preload in (0, 4, 40):
            verdict = self.judged_in(torques + rubs(preload))
            now = most(verdict)
            for hinge, used in now.items():
                self.assertGreater(used, (last or plain)[hinge])
            last = now
            held = [a["actuation"] for a in verdict["workspace"]["actuation"]]
            self.assertTrue(all("; against it friction of hinges A, B, C, D, E, F in scene held" in a for a in held), held)
        self.assertGreater(max(last.values()), 1.3 * max(plain.values()))
        self.assertNotEqual(verdict["verdict"], "accept")
        for h in verdict["hinges"]:  # of all ways to a pose: from below, too
            self.assertLess(h["utilisation_band"][0], h["utilisation"])
        one = most(self.judged_in(torques + rubs(40, "A")))
        self.assertTrue(all(plain[h] - 1e-3 < one[h] < last[h] for h in plain))
        jammed = self.judged_in(torques + rubs(1, radius=5000))
        self.assertIn("FW-D711", {r["code"] for r in jammed["reasons"]})
        self.assertEqual(jammed["verdict"], "inconclusive")

    def test_heat_moves_the_ground(self):
        """a layer that grows on its carrier: required poses have hinges turned further, and the scene is named"""
        heat = '<temperature change="{} K" expansion="17 ppm/K" substrate-expansion="3 ppm/K" modulus-change="0 ppm/K"/>'
        cold = self.judged_in(heat.format(0))
        for kelvin in (200, -200):
            hot = self.judged_in(heat.format(kelvin))
            for before, after in zip(cold["hinges"], hot["hinges"]):  # it is cold, too, before it is hot
                self.assertGreater(after["utilisation"], before["utilisation"] - 1e-3)
            if kelvin > 0:
                continue
            turned = [abs(b["peak_angle_rad"] / a["peak_angle_rad"]) for a, b in zip(cold["hinges"], hot["hinges"])]
            self.assertGreater(max(turned), 1.01)
            worst = max(zip(cold["hinges"], hot["hinges"]), key=lambda both: both[1]["utilisation"] / both[0]["utilisation"])
            self.assertGreater(worst[1]["utilisation"], 1.02 * worst[0]["utilisation"])
            self.assertTrue(any("the growth of the layer on its carrier in scene held" in a["actuation"]
                                for a in hot["workspace"]["actuation"]))

    def test_what_is_not_drawn_between_links_has_no_place(self):
        """a cable from link to link, whose frames nobody states: `(nan, nan) um` was said"""
        device = self.here / "cable.xml"
        text = re.sub(r' (mass|inertia)="[^"]*"', "", GALLERY.read_text())
        device.write_text(text.replace("</six-bar>", '</six-bar><mechanism><spring id="s1" a="AB" b="DE" stiffness="300 N/m" '
                                               'length="1.9 mm" cable="yes"/></mechanism>'))
        said = run("check", device, "--advice", "none", "--corners", "none")
        self.assertIn("cable s1 is not drawn", " ".join(said.stderr.split()))
        self.assertNotIn("nan", said.stdout + said.stderr)

    def test_what_required_poses_do_not_count(self):
        """is named, and nothing is accepted for which it may matter"""
        torque = '<torque on="AB" value="1 nN mm"/>'
        rider = ('<mechanism><body id="R" x="1.5 mm" y="3.5 mm" mass="1 ug" inertia="1 ug mm^2"/><revolute id="r" a="CD" a-y="0.325 mm" '
                 'b="R" b-y="-0.3 mm"/></mechanism>')
        for scene, told in (("", None), ('<base-motion ax="1 m/s^2"/>', "base-motion of scene held"),
                            ('<contact id="k" a="ground" b="R" side="outside" distance="9 um" stiffness="1 N/m"/>', "contact k of scene held"),
                            ('<initial body="CD" vx="1 nm/s"/>', None)):
            verdict = self.judged_in(torque + scene, mechanism=rider if 'b="R"' in scene else "")
            said = [r["text"] for r in verdict["reasons"] if r["code"] == "FW-D710"]
            self.assertEqual(len(said), 1 if told else 0, (scene, verdict["reasons"]))
            if told:
                self.assertIn(told, said[0])
                self.assertNotEqual(verdict["verdict"], "accept")

    def test_thin_layers_may_tip(self):
        """the same strain at any thickness, but forces across go with its cube and those in the plane with it"""
        device = self.here / "thin.xml"
        text = (ROOT / GALLERY).read_text()
        head = text[:text.index('  <scene name="step-load"')].replace('  <flow ref="al-masked-rie"/>\n', "")
        for thickness, flat in (("9 um", True), ("4 um", False), ("2 um", False)):
            device.write_text(head.replace('thickness="9 um"', f'thickness="{thickness}"') + """
  <workspace x-min="-20 um" x-max="20 um" y-min="-8 um" y-max="8 um" phi-min="-0.3 deg" phi-max="0.3 deg"/></device>""")
            verdict = json.loads(run("check", device, "--json", "--advice", "none", "--corners", "none").stdout)
            self.assertEqual(any(r["code"] == "FW-D647" for r in verdict["reasons"]), not flat, verdict["reasons"])
            self.assertAlmostEqual(max(h["utilisation"] for h in verdict["hinges"]), 0.47, delta=0.01)

    def straight(self, box, change=lambda text: text):
        """the verdict on a device whose legs of pins end 17.9 um above the drawn pose"""
        device = self.here / "straight.xml"
        text = re.sub("<workspace[^>]*>", f"<workspace {box}/>", (ROOT / "tests/data/straight-legs.xml").read_text())
        device.write_text(change(text))
        result = run("check", device, "--json", "--advice", "none", "--corners", "none")
        return json.loads(result.stdout) if result.stdout else result.stderr

    def test_what_pins_do_not_reach_and_flexures_may(self):
        """a scene with 1.592 mN reaches 20 um at a fifth of the limit; 0.6 mm nothing reaches"""
        pose = 'x-min="0 um" x-max="0 um" y-min="{0} um" y-max="{0} um" phi-min="0 deg" phi-max="0 deg"'
        for y, verdict, code in ((15, None, None), (20, "inconclusive", "FW-D727"), (600, "reject", "FW-D201")):
            data = self.straight(pose.format(y))
            said = {r["code"] for r in data["reasons"]} & {"FW-D727", "FW-D201"}
            self.assertEqual(said, {code} if code else set(), (y, data["reasons"]))
            if verdict:
                self.assertEqual(data["verdict"], verdict)
        # of a whole box the pose that is farthest counts, not the first that is found
        data = self.straight('x-min="0 um" x-max="0 um" y-min="0 um" y-max="600 um" phi-min="0 deg" phi-max="0 deg"')
        self.assertEqual(data["verdict"], "reject")
        up = '<scene name="up" duration="2000 ms"><force on="CD" fy="1.592 mN" law="ramp" rise="1900 ms"/></scene>' \
             '<probe id="dy" kind="displacement" on="CD" direction="90 deg"/><require probe="dy" measure="final" min="18 um"/>'
        data = self.straight("", lambda text: re.sub("<workspace[^>]*>", up, text))
        self.assertEqual(data["verdict"], "accept", data["reasons"])

    def test_a_platform_that_turns_all_the_way(self):
        """360 degrees were none: its hinges were at 0 %"""
        for box in ('x-min="0 um" x-max="0 um" y-min="0 um" y-max="0 um" phi-min="360 deg" phi-max="360 deg"',
                    'x-min="-5 um" x-max="5 um" y-min="-5 um" y-max="5 um" phi-min="-360 deg" phi-max="-359 deg"'):
            data = self.straight(box)
            self.assertEqual(data["verdict"], "reject")
            self.assertIn("turn it by no more than", [r["text"] for r in data["reasons"] if r["code"] == "FW-D201"][0])

    def test_a_second_joint_at_a_hinge_of_the_six_bar(self):
        """has no flexure and cannot have one: the advice says what is possible"""
        stop = '<mechanism><revolute id="st" a="ground" b="AB" a-x="0.7 mm" a-y="0.15 mm" b-x="0.075 mm" b-y="-0.625 mm" ' \
               'stop-min="-0.1 deg" stop-max="0.1 deg" stop-stiffness="1e-3 N m/rad"/></mechanism>'
        text = str(self.straight("", lambda text: re.sub("<workspace[^>]*>", stop + '<scene name="s" duration="1 ms"/>', text)))
        self.assertIn("those hinges take no stops", text)
        self.assertNotIn("give it hinge=", text)

    def test_what_is_sure_to_stay_flat_is_no_negative_multiple(self):
        """a layer far thicker than its flexures are wide: nothing of its buckling is known"""
        text = (ROOT / "tests/data/straight-legs.xml").read_text().replace('thickness="50 um"', 'thickness="1200 um"')
        text = re.sub(' width="120 um"| width="1.40 mm" height="0.40 mm"', ' mass="0.02 mg" inertia="0.003 mg mm^2"', text)
        device = self.here / "thick.xml"
        device.write_text(re.sub("<workspace[^>]*>", '<scene name="s" duration="5 ms"><force on="CD" fx="1 uN"/></scene>'
                                 '<workspace x-min="-1 um" x-max="1 um" y-min="-1 um" y-max="1 um" phi-min="0 deg" phi-max="0.1 deg"/>', text))
        result = run("check", device, "--advice", "none", "--corners", "none")
        self.assertNotRegex(result.stdout, "up to -")

    def test_a_spring_at_what_rides_on_it(self):
        device = self.here / "rides.xml"
        rider = ('<mechanism><body id="R" x="1.5 mm" y="3.5 mm" mass="1 ug" inertia="1 ug mm^2"/><revolute id="r" a="CD" a-y="0.325 mm" '
                 'b="R" b-y="-0.3 mm"/>{}</mechanism>')
        for spring, known in (("", True), ('<spring id="S" a="ground" b="R" stiffness="1 N/m"/>', False)):
            device.write_text(scaled(1, 1).replace("</six-bar>", "</six-bar>" + rider.format(spring)))
            verdict = json.loads(run("check", device, "--json", "--advice", "none", "--corners", "none").stdout)
            self.assertEqual(any(r["code"] == "FW-D646" for r in verdict["reasons"]), not known, verdict["reasons"])


class Certificate(InTemporary):
    def test_accepted(self):
        changed = copy.deepcopy(self.certificate)
        self.assertTrue(changed["boxes"][0].pop("strain"))  # takes a minute
        counts = check_certificate.check(changed)
        self.assertEqual(len(counts), 3)

    def refused(self, change):
        changed = copy.deepcopy(self.certificate)
        changed["boxes"] = changed["boxes"][1:]  # the smaller one
        change(changed["boxes"][0])
        with self.assertRaises((Refused, Undecided, KeyError, ValueError)):
            check_certificate.check(changed, most=3000)

    def test_untouched_part_is_accepted(self):
        changed = copy.deepcopy(self.certificate)
        changed["boxes"] = changed["boxes"][1:]
        check_certificate.check(changed, most=3000)

    def test_smaller_angle(self):
        for hinge in range(6):
            for end in (0, 1) if ALL else (hinge % 2,):
                def change(box, hinge=hinge, end=end):
                    claim = box["hinges"][hinge]["angle_rad"]
                    claim[end] = bits(claim[end], lambda v: v * 0.995)
                self.refused(change)

    def test_larger_angle(self):
        def change(box):
            claim = box["hinges"][2]["angle_rad"]
            claim[1] = bits(claim[1], lambda v: v * 1.05)
        self.refused(change)

    def test_other_strain(self):
        """below what a pose has, far above it, or of another hinge's stiffness"""
        for factor in (0.99, 1.1):
            def change(box, factor=factor):
                claim = box["strain"]["hinges"][2]["strain"]
                claim[1] = bits(claim[1], lambda v: v * factor)
            self.refused(change)

        def stiffer(box):
            spring = box["strain"]["hinges"][1]["stiffness_Nm_per_rad"]
            spring[0] = bits(spring[0], lambda v: v * 1.01)
        self.refused(stiffer)

    def test_strain_with_a_part_left_out(self):
        def change(box):
            box["strain"]["tree"] = box["strain"]["tree"][:-1]
        self.refused(change)

    def test_larger_box(self):
        for axis in range(3):
            def change(box, axis=axis):
                box["box"][axis][1] = bits(box["box"][axis][1], lambda v: v * 1.05)
            self.refused(change)

    def test_tree(self):
        self.refused(lambda box: box.update(tree=box["tree"][:-1]))
        self.refused(lambda box: box.update(tree=box["tree"] + "."))
        self.refused(lambda box: box.update(tree=box["tree"].replace("p", "q")))
        self.refused(lambda box: box.update(tree=""))

    def test_mechanism(self):
        for side in ("left", "right"):
            for key in ("base_m", "first_m", "second_m", "platform_m"):
                def change(box, side=side, key=key):
                    place = box["mechanism"][side][key]
                    place[0] = bits(place[0], lambda v: v + 5e-6)
                self.refused(change)

        def both(box):  # closes again, but is another mechanism
            for key, step in (("first_m", 2e-5), ("second_m", -2e-5)):
                place = box["mechanism"]["left"][key]
                place[1] = bits(place[1], lambda v, step=step: v + step)
        self.refused(both)

    def test_rest_angle(self):
        def change(box):
            start = box["mechanism"]["start_rad"]
            start[4] = bits(start[4], lambda v: v + 1e-3)
        self.refused(change)

    def test_witness(self):
        def outside(box):
            pose = box["hinges"][0]["most"]["pose"]
            pose[0] = bits(pose[0], lambda v: v * 1.5 + 1e-4)

        def elsewhere(box):
            box["hinges"][0]["most"] = box["hinges"][0]["least"]
        self.refused(outside)
        self.refused(elsewhere)

    def test_not_a_number(self):
        def change(box):
            box["hinges"][0]["angle_rad"][1] = "nan"
        self.refused(change)
        with self.assertRaises(Refused):
            check_certificate.check({"schema": "flexwright.workspace/1", "boxes": []})


def certificate_of(device, where, *more):
    run("workspace", device, "-o", where, "-q", *more)
    return json.loads((where / "certificate.json").read_text())


def leaf(tree, kind, n):
    """place of the n-th node of this kind"""
    return [m.start() for m in re.finditer(kind, tree)][n]


def behind(tree, node):
    """place behind a node and all that is below it"""
    open_ = 1
    while open_:
        open_ += 7 if tree[node] == "h" else -1
        node += 1
    return node


class Volume(InTemporary):
    def accepted(self, certificate, **more):
        return [(flow, volume, own) for flow, volume, own in check_certificate.check_volumes(certificate, **more)]

    def test_the_reported_bracket_is_proved(self):
        found = self.accepted(self.certificate)
        self.assertEqual([f[0] for f in found], [f["flow"] for f in self.data["flows"]])
        for (_, volume, (low, high)), flow in zip(found, self.data["flows"]):
            claim = flow["reachable"]["volume"]["m2_rad"]
            self.assertEqual(list(volume.claim), claim)
            self.assertTrue(claim[0] <= low < high <= claim[1])
        self.assertLess((self.out / "certificate.json").stat().st_size, 1e6)

    def test_stretched_legs(self):
        """limits that let both legs be stretched, two hinges turn by more than half a turn altogether"""
        for strength, width in (("6", 1.05), ("9", 2)):
            device = self.here / f"wide-{strength}.xml"
            device.write_text(GALLERY.read_text().replace('strength="2.5 GPa"', f'strength="{strength} GPa"'))
            flow = ("--flow", "al-masked-rie")
            (_, volume, own), = self.accepted(certificate_of(device, self.here / f"wide-{strength}", *flow))
            self.assertGreater(volume.claim[1], width * volume.claim[0])
            self.assertTrue(volume.claim[0] <= own[0] < own[1] <= volume.claim[1])

    def test_another_device(self):
        found = self.accepted(certificate_of(ROOT / "docs/gallery/four-tendons/device.xml", self.here / "four"))
        self.assertEqual(len(found), 1)

    def test_no_volume_has_a_reason(self):
        device = self.here / "held.xml"
        text = GALLERY.read_text().replace(' flexure="E"', "")
        device.write_text(text)
        certificate = certificate_of(device, self.here / "held")
        for found in self.accepted(certificate):
            self.assertIn("elastic limit", found[1])
            self.assertIsNone(found[2])
        certificate["volumes"][0]["none"] = None
        with self.assertRaises(Refused):
            self.accepted(certificate)
        with self.assertRaises(Refused):
            self.accepted({"volumes": []})

    def smaller(self):
        """the flow whose limits are the smaller ones"""
        return copy.deepcopy(self.certificate["volumes"][1]["volume"])

    def refused(self, change, why=None):
        data = self.smaller()
        change(data)
        with self.assertRaises((Refused, KeyError, ValueError)) as caught:
            check_volume.check(data, most=1000)
        if why:
            self.assertIn(why, str(caught.exception))

    def test_another_bracket(self):
        """narrower, wider than nothing, beside the truth; what no bracket changes is looked at once"""
        volume = check_volume.Volume(self.smaller(), 60000)
        volume.walk()
        low, high = volume.claim
        self.assertTrue(volume.against((low * 0.999, high * 1.001)))
        middle = 0.5 * (low + high)
        for claim in ((middle, high), (low, middle), (middle, middle), (high, high * 1.01), (low * 0.99, low),
                      (high, low), (0.0, 0.0), (-high, -low)):
            with self.assertRaises(Refused, msg=str(claim)):
                volume.against(claim)

    def test_another_limit(self):
        for hinge in range(6):
            for end in (0, 1):
                for factor in (0.99, 1.01):
                    def change(data, hinge=hinge, end=end, factor=factor):
                        limit = data["limits_rad"][hinge]
                        limit[end] = bits(limit[end], lambda v: v * factor)
                    self.refused(change, "box")

    def test_another_box(self):
        for axis in range(3):
            for end in (0, 1):
                for factor in (1 - 1e-6, 1 + 1e-6):
                    def change(data, axis=axis, end=end, factor=factor):
                        side = data["joint_box"][axis]
                        side[end] = bits(side[end], lambda v: v * factor)
                    self.refused(change, "limits of A, B, C")

    def test_another_mechanism(self):
        for side in ("left", "right"):
            for key in ("base_m", "first_m", "second_m", "platform_m"):
                def change(data, side=side, key=key):
                    place = data["mechanism"][side][key]
                    place[0] = bits(place[0], lambda v: v + 5e-6)
                self.refused(change, "does not close")
            for keys in (("first_m", "second_m"), ("base_m", "first_m"), ("second_m", "platform_m")):
                def both(data, side=side, keys=keys):  # closes again, but is another mechanism
                    for key, step in zip(keys, (2e-5, 2e-5 if keys[1] == "platform_m" else -2e-5)):
                        place = data["mechanism"][side][key]
                        place[1] = bits(place[1], lambda v, step=step: v + step)
                self.refused(both)

        def start(data):
            start = data["mechanism"]["start_rad"]
            start[4] = bits(start[4], lambda v: v + 1e-3)
        self.refused(start)

    def test_a_node_is_something_else(self):
        for kind, other, why in (("o", "i", "not inside"), ("i", "o", "not outside")):
            for n in (1, 1000, -1):
                def change(data, kind=kind, other=other, n=n):
                    at = leaf(data["tree"], kind, n)
                    data["tree"] = data["tree"][:at] + other + data["tree"][at + 1:]
                self.refused(change, why)
            # some boxes that were cut are all inside or outside, but not twenty of them
            self.refused(lambda data, other=other: data.update(tree=data["tree"].replace("c", other, 20)), why)

    def test_a_subtree_is_missing(self):
        for n in (1, 40, 400):
            for instead in ("", "o", "i", "h"):
                def change(data, n=n, instead=instead):
                    at = leaf(data["tree"], "h", n)
                    data["tree"] = data["tree"][:at] + instead + data["tree"][behind(data["tree"], at):]
                self.refused(change)
        self.refused(lambda data: data.update(tree=data["tree"][:-1]), "leaves a part")
        self.refused(lambda data: data.update(tree=data["tree"] + "o"), "too many")
        self.refused(lambda data: data.update(tree="x"), "of no kind")
        self.refused(lambda data: data.update(tree=""), "leaves a part")
        self.refused(lambda data: data.update(tree="c"), "proved is only")

    def test_not_a_number(self):
        for key in ("limits_rad", "joint_box"):
            def change(data, key=key):
                data[key][2][1] = "nan"
            self.refused(change)
        self.refused(lambda data: data.pop("limits_rad"))
        self.refused(lambda data: data["m2_rad"].append("0x1p-3"))

    def test_limits_without_angles(self):
        """what the checker says of a point of the box is what angles say, also of wide limits and of stretched legs"""
        numbers = random.Random(8)
        for wide in (0.1, 0.5, 1.5, 2.9):
            data = self.smaller()
            data["limits_rad"] = [[(-wide).hex(), wide.hex()]] * 6
            data["joint_box"] = [[(-wide).hex(), wide.hex()]] * 3
            with unittest.mock.patch.object(check_volume.Volume, "covered"):
                volume = check_volume.Volume(data, 1000)
            volume.box, volume.empty, inside = [(-wide, wide)] * 3, False, 0
            for _ in range(3000):
                place = [numbers.randrange(1 << 40) for _ in range(3)]
                psi = [wide * ((2 * i + 1) / (1 << 40) - 1) for i in place]
                said = volume.judged(place, 40, volume.conditions)[0]
                self.assertEqual(said, "i" if by_angles(data["mechanism"], psi, wide) else "o")
                inside += said == "i"
            self.assertGreater(inside, 300)


def by_angles(mechanism, psi, limit):
    """the right leg within the limits, by the law of cosines"""
    def place(side, key):
        return complex(*map(float.fromhex, mechanism[side][key + "_m"]))

    def turn(z):
        return cmath.phase(z)
    base, a, b = (place("right", key) for key in ("base", "first", "second"))
    start = list(map(float.fromhex, mechanism["start_rad"]))
    rotation = [cmath.exp(1j * sum(psi[:n + 1])) for n in range(3)]
    d = (place("left", "base") + place("left", "first") * rotation[0] + place("left", "second") * rotation[1]
         + (place("right", "platform") - place("left", "platform")) * rotation[2])
    v, drawn = d - base, turn(b / a)
    cosine = (abs(v) ** 2 - abs(a) ** 2 - abs(b) ** 2) / (2 * abs(a) * abs(b))
    if abs(cosine) > 1:
        return False
    elbow = math.copysign(math.acos(cosine), drawn)
    first = v / (abs(a) + abs(b) * cmath.exp(1j * elbow))
    second = first * cmath.exp(1j * elbow) * abs(b)
    angles = (turn(second / b / rotation[2]), drawn - elbow, turn(a / first))  # of the joints D, E, F
    return all(-limit <= angle + start[3 + i] <= limit for i, angle in enumerate(angles))


if __name__ == "__main__":
    unittest.main()
