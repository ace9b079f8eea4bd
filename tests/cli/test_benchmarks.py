#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The published multibody benchmarks from XML files through the program, against reference values
(independent: elliptic functions with 22 digits for the pendulum and the windows, two programs in quad
precision for the squeezer and the six-bar)."""
import json
import math
import pathlib
import tempfile
import unittest

from common import ROOT, run

HEAD = '<device xmlns="urn:flexwright:device:1" name="benchmark">\n<mechanism>\n'


def device(bodies, joints, scene, duration):
    return (HEAD + "".join(bodies) + "".join(joints) +
            f'</mechanism>\n<scene name="s" duration="{duration}">{scene}</scene>\n</device>\n')


def pendulum(duration):
    """A01: a point mass on a massless rod, released horizontally at x = -1."""
    return device(['<body id="bob" mass="1 kg" inertia="1 kg m^2" x="-1 m" y="0 m"/>\n'],
                  ['<distance id="rod" a="ground" b="bob" length="1 m"/>\n'],
                  '<gravity gy="-9.81 m/s^2"/>', duration)


def windows(n, duration):
    """A02: n four-bar windows of uniform bars, 1 m and 1 kg each, cranks upright at 1 rad/s."""
    bodies, joints, start = [], [], ['<gravity gy="-9.81 m/s^2"/>']
    for i in range(n + 1):
        bodies.append(f'<body id="B{i}" mass="1 kg" inertia="1/12 * 1 kg m^2" x="{i} m" y="0.5 m" '
                      f'phi="90 deg"/>\n')
        joints.append(f'<revolute id="O{i}" a="ground" a-x="{i} m" b="B{i}" b-x="-0.5 m"/>\n')
        start.append(f'<initial body="B{i}" vx="0.5 m/s" omega="-1 rad/s"/>')
    for i in range(1, n + 1):
        bodies.append(f'<body id="C{i}" mass="1 kg" inertia="1/12 * 1 kg m^2" x="{i - 0.5} m" '
                      f'y="1 m"/>\n')
        joints.append(f'<revolute id="L{i}" a="B{i - 1}" a-x="0.5 m" b="C{i}" b-x="-0.5 m"/>\n')
        joints.append(f'<revolute id="R{i}" a="C{i}" a-x="0.5 m" b="B{i}" b-x="0.5 m"/>\n')
        start.append(f'<initial body="C{i}" vx="1 m/s"/>')
    return device(bodies, joints, "".join(start), duration)


class Benchmarks(unittest.TestCase):
    def simulate(self, text, *options):
        with tempfile.TemporaryDirectory() as here:
            path = pathlib.Path(here) / "device.xml"
            path.write_text(text)
            result = run("simulate", path, "--json", "--samples", "2", *options)
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads(result.stdout)

    def test_pendulum(self):
        final = self.simulate(pendulum("10 s"), "--rtol", "1e-13")
        x, y, _ = final["final"]["q"]["bob"]
        self.assertAlmostEqual(x, -0.2750874625761168600544, delta=1e-11)
        self.assertAlmostEqual(y, -0.9614192050991250642651, delta=1e-11)
        self.assertLess(final["stats"]["energy_error"], 1e-12)

    def test_pendulum_2000_s(self):
        """845 periods: an energy error of 1e-12 is a phase error of some 1e-9"""
        x, y, _ = self.simulate(pendulum("2000 s"), "--rtol", "1e-13")["final"]["q"]["bob"]
        self.assertLess(math.hypot(x - 0.8146030685890321521218, y + 0.5800188278369354615919), 5e-8)

    def test_windows(self):
        exact = {1: (0.4783850577609705590054, 0.8781501787912093011639),
                 2: (0.3284581115408153786522, 0.9445185381786009621613),
                 10: (0.2043535609897709854665, 0.978897145828304042303),
                 40: (0.1805122266867283901032, 0.9835727405823115748813),
                 100: (0.175710972790979040638, 0.9844417981987801716697)}
        for n, (x, y) in exact.items():
            q = self.simulate(windows(n, "10 s"), "--rtol", "1e-10")["final"]["q"]
            phi = q["B0"][2]
            self.assertLess(math.hypot(math.cos(phi) - x, math.sin(phi) - y), 1e-6, n)
            for i in range(n + 1):  # no crank has left the branch
                self.assertAlmostEqual(q[f"B{i}"][2], phi, delta=1e-9)

    def test_squeezer(self):
        text = (ROOT / "docs/mechanisms/squeezer.xml").read_text()
        out = self.simulate(text, "--rtol", "1e-13")
        q, v = out["final"]["q"], out["final"]["v"]
        # beta, Theta, gamma, delta, epsilon at 0.03 s
        self.assertAlmostEqual(q["K1"][2], 15.810771195153707097, delta=1e-11)
        self.assertAlmostEqual(q["K2"][2] - q["K1"][2], -15.75637105841183947, delta=1e-11)
        self.assertAlmostEqual(q["K3"][2], 0.040822240119645804858, delta=1e-12)
        self.assertAlmostEqual(q["K5"][2], 0.52440996587995406937, delta=1e-12)
        self.assertAlmostEqual(q["K7"][2], 1.0480807410419378731, delta=1e-12)
        self.assertAlmostEqual(v["K1"][2] / 1139.9203022591060642, 1, delta=1e-9)
        self.assertLess(out["stats"]["energy_error"], 1e-11)

    def test_every_method_and_integrator_on_the_six_bar(self):
        """the same answer whichever way; loose for the baselines, whose own error is larger"""
        device_xml = (ROOT / "tests/data/six-bar-benchmark.xml").read_text()
        exact = -0.430737118021172193  # phi_EF at 1 ms
        for method in ("chain", "minimal", "augmented", "coordinate-partitioning", "udwadia-kalaba",
                       "svd", "qr", "schur", "block-least-squares"):
            q = self.simulate(device_xml, "--rtol", "1e-12", "--method", method)["final"]["q"]
            self.assertAlmostEqual(q["EF"][2], exact, delta=1e-10, msg=method)
        for integrator, error in (("dop853", 1e-9), ("dopri5", 1e-8), ("radau5", 1e-7),
                                  ("generalised-alpha", 1e-4), ("rk4", 1e-6), ("gsl-rkf45", 1e-7),
                                  ("gsl-rk8pd", 1e-9), ("gsl-msadams", 1e-5), ("gsl-bsimp", 1e-6)):
            q = self.simulate(device_xml, "--rtol", "1e-10", "--integrator", integrator)["final"]["q"]
            self.assertAlmostEqual(q["EF"][2], exact, delta=error, msg=integrator)


if __name__ == "__main__":
    unittest.main()
