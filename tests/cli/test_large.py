#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Equilibria and modes of thousands of bodies, against closed forms; a wafer of thousands of holes in little memory."""
import json
import math
import pathlib
import re
import tempfile
import unittest

from common import ROOT, run

WEIGHT = 9.81e-6  # N of a milligram


def device(bodies, scene):
    return ('<device xmlns="urn:flexwright:device:1" name="test"><mechanism>\n' + "\n".join(bodies) +
            f'</mechanism>\n<scene name="hang" duration="1 s">{scene}</scene></device>\n')


def pendula(n, stiffness=0.0, side=0.0, twice=()):
    """n rods of 1 mm without mass, a point of 1 mg at the lower end of each; the joints in `twice` are written twice"""
    rows = [f'<body id="b{i}" mass="1 mg" inertia="1e-6 mg mm^2" x="0 mm" y="{-(i + 1)} mm"/>' for i in range(n)]
    for i in range(n):
        above = 'a="ground"' if i == 0 else f'a="b{i - 1}"'
        for name in ("p", "again")[:1 + (i in twice)]:
            rows.append(f'<revolute id="{name}{i}" {above} b="b{i}" b-y="1 mm" stiffness="{stiffness} N m/rad"/>')
    push = f'<force on="b{n - 1}" fx="{side} N"/>' if side else ""
    return device(rows, '<gravity gy="-9.81 m/s^2"/>' + push)


def carts(n, side):
    """n masses of 1 mg in a row on springs of 10 N/m, the first one held"""
    rows = [f'<body id="b{i}" mass="1 mg" inertia="1 mg mm^2" x="{i} mm" y="0 mm"/>' for i in range(n)]
    for i in range(n):
        before = f'a="ground" a-x="{i} mm"' if i == 0 else f'a="b{i - 1}" a-x="1 mm"'
        rows.append(f'<prismatic id="g{i}" {before} b="b{i}" axis="0 deg" stiffness="10 N/m"/>')
    return device(rows, f'<force on="b{n - 1}" fx="{side} N"/>')


def laguerre(n, x):
    """scaled against overflow: only its sign counts"""
    before, now = 1.0, 1 - x
    for k in range(1, n):
        before, now = now, ((2 * k + 1 - x) * now - k * before) / (k + 1)
    return now


def zeros_of_laguerre(n, count):
    """the lowest: they lie near (j/2)^2/(n + 1/2), j of Bessel's function, some pi apart"""
    found, at, step = [], 0.0, 0.2 / (4 * n + 2)
    last = 1.0
    while len(found) < count:
        root = math.sqrt(at) + math.sqrt(step)
        to = root * root
        value = laguerre(n, to)
        if value * last < 0:
            low, high = at, to
            for _ in range(60):
                middle = (low + high) / 2
                low, high = (middle, high) if laguerre(n, middle) * last > 0 else (low, middle)
            found.append((low + high) / 2)
        at, last = to, value
    return found


class Large(unittest.TestCase):
    def setUp(self):
        keep = tempfile.TemporaryDirectory()
        self.addCleanup(keep.cleanup)
        self.path = pathlib.Path(keep.name) / "device.xml"

    def answer(self, command, text, *more):
        self.path.write_text(text)
        ran = run(command, self.path, "--json", *more)
        self.assertEqual(ran.returncode, 0, ran.stderr)
        return json.loads(ran.stdout)

    def test_a_swept_wafer_with_release_holes(self):
        """what is joined for one plate is given back before the next: each takes as much as all that was computed"""
        with tempfile.TemporaryDirectory() as out:
            done = run("mask", ROOT / "tests/data/swept-holes.xml", "-o", pathlib.Path(out) / "masks", "-q", "--memory", 100, "--corners", "none",
                       "--advice", "none")
            self.assertEqual(done.returncode, 4, done.stderr)  # a comb and a stage may not be accepted; the masks are there
            self.assertIn("soi-deep-rie-plate.gds", " ".join(str(p) for p in pathlib.Path(out).rglob("*.gds")))

    def test_modes_of_hanging_chains(self):
        """of n pendula in a row omega^2 = g/l times the zeros of Laguerre's polynomial L_n"""
        for n, most in ((401, 2e-7), (10000, 1e-8)):
            modes = self.answer("modes", pendula(n))["modes"]
            self.assertEqual(len(modes), 24)
            for mode, zero in zip(modes, zeros_of_laguerre(n, 3 if n > 1000 else 20)):
                omega = 2 * math.pi * mode["f_Hz"]
                # what the inertia of the points leaves grows with the square of the mode
                self.assertAlmostEqual(omega / math.sqrt(9.81e3 * zero), 1, delta=most)

    def test_modes_of_carts(self):
        for n in (500, 10000):
            modes = self.answer("modes", carts(n, 0))["modes"]
            for k, mode in enumerate(modes):
                omega = 2 * math.sqrt(10 / 1e-6) * math.sin((2 * k + 1) * math.pi / (2 * (2 * n + 1)))
                self.assertAlmostEqual(2 * math.pi * mode["f_Hz"] / omega, 1, delta=1e-8)

    def test_a_chain_that_is_drawn_aside(self):
        """each rod points where its tension does: tan = side force over what hangs below"""
        for n, share in ((120, 0.3), (1000, 0.3), (10000, 0.001)):
            side = share * n * WEIGHT
            rest = self.answer("statics", pendula(n, side=side))
            self.assertTrue(rest["stable"])
            self.assertEqual(rest["degrees_of_freedom"], n)
            x = y = 0.0
            for i in range(n):
                angle = math.atan2(side, (n - i) * WEIGHT)
                x, y = x + 1e-3 * math.sin(angle), y - 1e-3 * math.cos(angle)
                at = rest["q"][f"b{i}"]
                self.assertAlmostEqual(at[0], x, delta=1e-9 * n * 1e-3)
                self.assertAlmostEqual(at[1], y, delta=1e-9 * n * 1e-3)

    def test_carts_that_are_drawn(self):
        rest = self.answer("statics", carts(10000, 1e-4))
        for i in (0, 17, 5000, 9999):
            self.assertAlmostEqual(rest["q"][f"b{i}"][0], i * 1e-3 + (i + 1) * 1e-5, delta=1e-10)

    def test_a_chain_that_stands(self):
        """a column on the springs of its joints bends under its own weight from n^3 m g l/k = 7.837 on (Greenhill)"""
        for n, command in ((150, "statics"), (450, "modes")):
            for stiff, straight in ((1.03, True), (0.95, False)):
                k = stiff * n ** 3 * WEIGHT * 1e-3 / 7.837
                text = pendula(n, stiffness=k).replace('gy="-9.81', 'gy="9.81')
                found = self.answer(command, text)
                if command == "modes":
                    self.assertEqual(found["modes"][0]["kind"], "oscillation" if straight else "unstable")
                    continue
                self.assertTrue(found["stable"])
                self.assertEqual(abs(found["q"][f"b{n - 1}"][0]) < 1e-9, straight)

    def test_friction_of_one_joint(self):
        """of many bodies one joint rubs: a torque of its size there, as statics is without friction"""
        text = pendula(300, stiffness=1e-4, side=1e-4)
        rubs = '<friction on="p40" coefficient="0.3" radius="0.01 mm" preload="1 mN"/></scene>'
        rest = self.answer("statics", text.replace("</scene>", rubs))["friction_range"]
        self.assertTrue(rest["known"])
        torque = rest["limits"][0]["torque_Nm"]
        at = {}
        for sign in (-1, 1):
            push = "".join(f'<torque on="{b}" value="{s * sign * torque!r} N m"/>' for b, s in (("b40", 1), ("b39", -1)))
            at[sign] = self.answer("statics", text.replace("</scene>", push + "</scene>"))["q"]
        for i in (10, 40, 41, 299):
            half = (at[1][f"b{i}"][0] - at[-1][f"b{i}"][0]) / 2
            self.assertAlmostEqual(rest["within"][f"b{i}"][0] / abs(half), 1, delta=2e-3)

    def test_joints_that_repeat_each_other(self):
        rest = self.answer("statics", pendula(300, side=1e-4, twice=(50, 200)))
        self.assertEqual((rest["constraints"]["rows"], rest["constraints"]["rank"]), (604, 600))
        named = re.findall(r"\w+", str(rest["constraints"]["redundant"]))
        for k in (50, 200):
            self.assertTrue({f"p{k}", f"again{k}"} & set(named), named)
        self.assertLessEqual(set(named), {"p50", "again50", "p200", "again200"})

    def test_what_is_refused_is_refused_by_name(self):
        self.path.write_text(pendula(500))
        ran = run("statics", self.path, "--path")
        self.assertEqual(ran.returncode, 6)
        self.assertIn("[FW-D599]", ran.stderr)
        self.assertIn("400 bodies", ran.stderr)


if __name__ == "__main__":
    unittest.main()
