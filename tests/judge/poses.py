#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""poses.py [--judge PROGRAM] [--program FLEXWRIGHT] [--seed N] [--count N] [--given] [--keep DIR]

Random six-bars with a required workspace, their links scaled to 1, 0.6, 0.45 or 0.35 of the reference's: the judge's own
exact beams hold the platform in 26 poses of the box, by the wrench on the platform, by torques, or by torques
and a force, and find the most strained hinge; its limit is set so that this is at 0.9 to 1.1 of it. --given: a spring or
a cable between the ground and the platform, a strong field of weight, or something round or flat that the platform runs
against besides. Exit 1 on a false accept or reject, or where a hinge's truth is outside its band. README.md says what truth
is."""
import argparse
import itertools
import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import strip  # noqa: E402

REFERENCE = {"A": (-800, -1300), "B": (-1300, -50), "C": (-700, 1250), "D": (700, 1300), "E": (1350, 0), "F": (800, -1300)}
SCALES = (1, 0.6, 0.45, 0.35)
CHAIN = ((0, 1, "A"), (1, 2, "B"), (2, 3, "C"), (3, 4, "D"), (4, 5, "E"), (5, 0, "F"))  # bodies: AB, BC, CD, DE, EF
ENDS = {1: "AB", 2: "BC", 4: "DE", 5: "EF"}
LEGS = (("A", "B", "C", 1, 2), ("F", "E", "D", 5, 4))
NEAR, FAR = 3000.0, 1e6  # um, of the anchors of rods that give the pose, and of those that stand for a force


def um(value):
    return "%.6f um" % value


def even(value):
    return round(value * 500) / 500


def solved(rows, right):
    """3 x 3, by Gauss and Jordan"""
    a = [list(row) + [value] for row, value in zip(rows, right)]
    for c in range(3):
        best = max(range(c, 3), key=lambda i: abs(a[i][c]))
        a[c], a[best] = a[best], a[c]
        if a[c][c] == 0:
            return None
        for i in range(3):
            if i != c:
                share = a[i][c] / a[c][c]
                a[i] = [u - share * v for u, v in zip(a[i], a[c])]
    return [a[i][3] / a[i][i] for i in range(3)]


class SixBar:
    def __init__(self, seed, given=False):
        self.seed, self.source = seed, random.Random(seed)
        self.scale, self.h = self.source.choice(SCALES), self.between(20, 60)
        self.material = strip.Isotropic(self.between(70e3, 170e3), self.between(0.2, 0.3))
        self.safety = self.source.choice((1.0, 1.5))
        self.at = {k: (even((x + self.between(-100, 100)) * self.scale), even((y + self.between(-100, 100)) * self.scale))
                   for k, (x, y) in REFERENCE.items()}
        self.centre = even(self.between(-30, 30)), even((self.at["C"][1] + self.at["D"][1]) / 2 + self.between(-50, 150))
        self.texts, self.hinges = [], {}
        for k in "ABCDEF":
            self.flexure(k)
        size = self.between(0.02, 0.10)
        self.box = (even(size * self.between(300, 900) * self.scale), even(size * self.between(200, 600) * self.scale),
                    size * self.between(0.1, 0.8))
        self.held = self.source.choice(("none", "torques", "mixed"))
        angle = self.between(-math.pi, math.pi)
        self.force = (self.between(-200, 200) * self.scale, self.between(-80, 80) * self.scale, math.cos(angle), math.sin(angle))
        self.target = self.between(0.9, 1.1)
        self.given = Given(self) if given else None

    def between(self, low, high):
        return low + (high - low) * self.source.random()

    def flexure(self, name):
        length = self.between(200, 400)
        t = round(max(min(self.between(5, 10), length / 20), self.h / 10), 3)
        fillet, axis = round(t * self.between(0.25, 0.7), 3), round(self.between(-180, 180), 3)
        if self.source.random() < 0.2:
            length = even(length)
            text, pieces = 'kind="leaf" length="%s" width="%s"' % (um(length), um(t)), strip.leaf(length, t)
        else:
            angle = round(self.between(100, 280), 1)
            radius = round(max(length / math.radians(angle), t / 0.14), 3)
            text = 'kind="csfh" radius="%s" angle="%.9g deg" width="%s"' % (um(radius), angle, um(t))
            pieces = strip.csfh(radius, math.radians(angle), t)
        self.texts.append('  <flexure id="%s" %s fillet="%s"/>\n' % (name, text, um(fillet)))
        self.hinges[name] = strip.Strip(pieces, self.material, self.h, fillet), axis

    def middle(self, body):
        if body == 3:
            return self.centre
        (ax, ay), (bx, by) = (self.at[k] for k in ENDS[body])
        return (ax + bx) / 2, (ay + by) / 2

    def model(self):
        out = ["body %.15g %.15g 1e-9 1e-4\n" % self.middle(k) for k in range(1, 6)]
        return "".join(out + [self.hinges[k][0].model(a, b, self.at[k], math.radians(self.hinges[k][1])) for a, b, k in CHAIN])

    def turns(self, pose):
        """of the bodies with pins"""
        x, y, phi = pose
        c, s, out = math.cos(phi), math.sin(phi), {3: phi}
        for low, elbow, high, first, second in LEGS:
            (ox, oy), (mx, my), (qx, qy) = self.at[low], self.at[elbow], self.at[high]
            px, py = qx - self.centre[0], qy - self.centre[1]
            to = self.centre[0] + x + c * px - s * py, self.centre[1] + y + s * px + c * py
            a, b = math.dist((ox, oy), (mx, my)), math.dist((mx, my), (qx, qy))
            drawn, now = math.atan2(qy - oy, qx - ox), math.atan2(to[1] - oy, to[0] - ox)
            reach = math.dist((ox, oy), to)
            inner = math.acos((a * a + reach * reach - b * b) / (2 * a * reach))
            angle = now + math.copysign(inner, math.sin(math.atan2(my - oy, mx - ox) - drawn))
            nx, ny = ox + a * math.cos(angle), oy + a * math.sin(angle)
            wrap = lambda v: (v + math.pi) % (2 * math.pi) - math.pi
            out[first] = wrap(angle - math.atan2(my - oy, mx - ox))
            out[second] = wrap(math.atan2(to[1] - ny, to[0] - nx) - math.atan2(qy - my, qx - mx))
        return out

    def ways(self):
        """what may hold a pose: None the wrench on the platform, else three actuators"""
        if self.held == "none":
            return [None] + [[("turn", 1), ("turn", 5), ("turn", k)] for k in (3, 2, 4)]
        return [[("turn", 1), ("turn", 5), ("turn", 3) if self.held == "torques" else ("rod", 3) + self.force]]

    def xml(self, strength):
        out = ['<?xml version="1.0" encoding="UTF-8"?>\n<device xmlns="urn:flexwright:device:1" name="poses-%d">\n' % self.seed,
               '  <material ref="silicon-100" youngs-modulus="%.12g MPa" poisson="%.12g" thickness="%s" strength="%.12g MPa"/>\n'
               % (self.material.mean, self.material.nu, um(self.h), strength),
               '  <limits safety-factor="%g"/>\n  <flow ref="al-masked-rie"/>\n' % self.safety, *self.texts, "  <six-bar>\n"]
        out += ['    <hinge at="%s" x="%s" y="%s" flexure="%s" axis="%.9g deg"/>\n'
                % (k, um(self.at[k][0]), um(self.at[k][1]), k, self.hinges[k][1]) for k in "ABCDEF"]
        out += ['    <link id="%s" mass="0.02 mg" inertia="0.003 mg mm^2"/>\n' % k for k in ENDS.values()]
        out.append('    <platform id="CD" x="%s" y="%s" mass="0.06 mg" inertia="0.01 mg mm^2"/>\n  </six-bar>\n'
                   % (um(self.centre[0]), um(self.centre[1])))
        if self.given:
            out.append(self.given.mechanism())
        if self.held != "none":
            on = ["AB", "EF"] + ["CD"] * (self.held == "torques")
            acts = ['    <torque on="%s" value="0.1 nN mm"/>\n' % k for k in on]
            if self.held == "mixed":
                x, y, fx, fy = self.force
                acts.append('    <force on="CD" x="%s" y="%s" fx="%.12g nN" fy="%.12g nN"/>\n' % (um(x), um(y), fx, fy))
            acts.append(self.given.scene() if self.given else "")
            duration = "1 us" if self.given else "1 ms"  # nothing moves in it
            out.append('  <scene name="s" duration="%s">\n' % duration + "".join(acts) + "  </scene>\n")
        x, y, phi = self.box
        out.append('  <workspace x-min="%s" x-max="%s" y-min="%s" y-max="%s" phi-min="%.12g rad" phi-max="%.12g rad"/>\n</device>\n'
                   % (um(-x), um(x), um(-y), um(y), -phi, phi))
        return "".join(out)


class Given:
    """what acts on the platform, or on all bodies, whatever holds them"""

    def __init__(self, device):
        draw, (cx, cy) = device.between, device.centre
        self.kind = device.source.choice(("spring", "cable", "weight", "round", "flat"))
        self.held = device.held if device.held != "none" else "torques"
        device.held = self.held  # a wrench on the platform holds what acts on it by itself
        self.on = even(draw(-200, 200) * device.scale), even(draw(-100, 100) * device.scale)
        angle, away = draw(-math.pi, math.pi), draw(300, 900)
        self.normal = math.cos(angle), math.sin(angle)
        self.ground = tuple(even(c + p + away * n) for c, p, n in zip(device.centre, self.on, self.normal))
        drawn = math.dist(self.ground, (cx + self.on[0], cy + self.on[1]))
        self.stiffness = draw(1, 40) / device.scale ** 2
        self.length = drawn * (1 if self.kind != "spring" else draw(0.97, 1.03))
        if self.kind in ("round", "flat"):  # touched where the platform has come nearer by a micrometre
            self.length = even(drawn - 1)
            if self.kind == "flat":
                self.length = even(sum((c + p - g) * -n for c, p, g, n in zip(device.centre, self.on, self.ground, self.normal)) - 1)
        self.field = tuple(draw(2e3, 2e4) / device.scale ** 2 * n for n in self.normal)

    def loads(self, pose):
        """of the beams, uN and um"""
        if self.kind == "weight":
            return "".join("force %d 0 0 %.15g %.15g\n" % (k, *(mass * g for g in self.field))
                           for k, mass in ((1, 0.02), (2, 0.02), (3, 0.06), (4, 0.02), (5, 0.02)))
        c, s, (px, py) = math.cos(pose[2]), math.sin(pose[2]), self.on
        way = [p - g for p, g in zip((self.at[0] + pose[0] + c * px - s * py, self.at[1] + pose[1] + s * px + c * py), self.ground)]
        if self.kind == "flat":
            size = -self.stiffness * min(-sum(w * n for w, n in zip(way, self.normal)) - self.length, 0)
            return "force 3 %.15g %.15g %.15g %.15g\n" % (px, py, *(-size * n for n in self.normal))
        long = self.stiffness * (math.hypot(*way) - self.length)
        pull = {"spring": long, "cable": max(long, 0), "round": min(long, 0)}[self.kind]
        return "force 3 %.15g %.15g %.15g %.15g\n" % (px, py, *(-pull * w / math.hypot(*way) for w in way))

    def mechanism(self):
        if self.kind not in ("spring", "cable"):
            return ""
        return '  <mechanism><spring id="G" a="ground" a-x="%s" a-y="%s" b="CD" b-x="%s" b-y="%s" stiffness="%.12g N/m" length="%s"%s/></mechanism>\n' % (
            *map(um, self.ground + self.on), self.stiffness, um(self.length), ' cable="yes"' if self.kind == "cable" else "")

    def scene(self):
        if self.kind == "weight":
            return '    <gravity gx="%.12g m/s^2" gy="%.12g m/s^2"/>\n' % self.field
        if self.kind in ("spring", "cable"):
            return ""
        face = ' a-face="%.12g rad"' % math.atan2(-self.normal[1], -self.normal[0]) if self.kind == "flat" else ""
        return '    <contact id="G" a="ground" a-x="%s" a-y="%s"%s b="CD" b-x="%s" b-y="%s" side="outside" distance="%s" stiffness="%.12g N/m"/>\n' % (
            *map(um, self.ground), face, *map(um, self.on), um(self.length), self.stiffness)


class Beams:
    def __init__(self, program, device, path):
        self.program, self.device, self.path, self.base = program, device, path, device.model()
        self.given = ""

    def ask(self, more):
        self.path.write_text(self.base + self.given + more, encoding="utf-8")
        done = subprocess.run([self.program, "at", self.path, "1"], capture_output=True, text=True, check=False)
        return json.loads(done.stdout) if done.returncode == 0 else None

    def by_wrench(self, pose):
        (x, y, phi), (cx, cy) = pose, self.device.centre
        return self.ask("turn 3 %.15g\nrod 3 0 0 %.15g %.15g %.15g\nrod 3 0 0 %.15g %.15g %.15g\n" % (
            phi, cx - NEAR, cy, math.hypot(NEAR + x, y) - NEAR, cx, cy - NEAR, math.hypot(x, NEAR + y) - NEAR))

    def by_three(self, pose, acts):
        """what torques and a force hold is given by turns, and by a rod from far away; the pose by Newton's method"""
        turn, value = self.device.turns(pose), []
        for act in acts:
            if act[0] == "turn":
                value.append(turn[act[1]])
            else:
                px, py, dx, dy = act[2:]
                c, s = math.cos(pose[2]), math.sin(pose[2])
                value.append((pose[0] + c * px - s * py - px) * dx + (pose[1] + s * px + c * py - py) * dy)
        for _ in range(8):
            found, off = self.missed(pose, acts, value)
            if not found or max(map(abs, off)) < 1e-4:
                return found
            columns = []
            for i, act in enumerate(acts):
                step = 1e-4 if act[0] == "turn" else 0.05
                moved, by = self.missed(pose, acts, value[:i] + [value[i] + step] + value[i + 1:])
                if not moved:
                    return None
                columns.append([(b - o) / step for b, o in zip(by, off)])
            change = solved(zip(*columns), [-o for o in off])
            if not change:
                return None
            value = [v + d for v, d in zip(value, change)]
        return None

    def missed(self, pose, acts, value):
        more, (cx, cy) = "", self.device.centre
        for act, now in zip(acts, value):
            if act[0] == "turn":
                more += "turn %d %.15g\n" % (act[1], now)
            else:
                px, py, dx, dy = act[2:]
                more += "rod 3 %.15g %.15g %.15g %.15g %.15g\n" % (px, py, cx + px - FAR * dx, cy + py - FAR * dy, now)
        found = self.ask(more)
        at = found["bodies"][2] if found else pose
        return found, (at[0] - pose[0], at[1] - pose[1], 500 * (at[2] - pose[2]))

    def stresses(self):
        """largest of every hinge, MPa, and how many poses beams could not be brought to"""
        most, lost = dict.fromkeys("ABCDEF", 0.0), 0
        for way in self.device.ways():
            for step in itertools.product((-1, 0, 1), repeat=3):
                if not any(step) or (0 in step and self.device.held == "none" and way):
                    continue
                pose = [a * b for a, b in zip(step, self.device.box)]
                if self.device.given:
                    self.device.given.at = self.device.centre
                    self.given = self.device.given.loads(pose)
                found = self.by_three(pose, way) if way else self.by_wrench(pose)
                lost += not found
                for k, flexure in zip("ABCDEF", found["flexures"] if found else ()):
                    most[k] = max(most[k], flexure["stress"])
        return most, lost


def judged(options, seed, where):
    """(text, wrong)"""
    device = SixBar(seed, options.given)
    try:
        stress, lost = Beams(options.judge, device, where / ("%d.model" % seed)).stresses()
    except ValueError:
        return "out of reach", False
    worst = max(stress, key=stress.get)
    if stress[worst] == 0:
        return "no pose is held", False
    strength = stress[worst] * device.safety / device.target
    path = where / ("%d.xml" % seed)
    path.write_text(device.xml(strength), encoding="utf-8")
    done = subprocess.run([options.program, "check", path, "--json", "--corners", "none", "--advice", "none", "--no-progress"],
                          capture_output=True, text=True, check=False)
    said = json.loads(done.stdout)
    if device.given and lost:
        return "%d poses cannot be held: not judged" % lost, False
    if device.held != "none" and any("on the platform along" in a["actuation"] for a in said["workspace"]["actuation"]):
        return "held badly: the platform's wrench supplies the rest", False
    hinges, out = {h["id"]: h for h in said["hinges"]}, []
    for k in "ABCDEF":
        truth, (low, high) = stress[k] * device.safety / strength, hinges[k]["utilisation_band"]
        if not low <= truth <= (math.inf if high is None else high):
            out.append("%s %.4f outside %.4f..%s" % (k, truth, low, high))
    truth, hinge = device.target, hinges[worst]
    if (said["verdict"] == "accept" and truth > 1) or (hinge["verdict"] == "reject" and truth <= 1):
        out.append("FALSE " + said["verdict"])
    held = device.held + (" " + device.given.kind if device.given else "")
    return "scale %g, %s, %d lost: truth %.4f %s, %s %.4f %.4f..%s%s" % (
        device.scale, held, lost, truth, worst, said["verdict"], hinge["utilisation"], *hinge["utilisation_band"],
        "".join(", WRONG " + o for o in out)), bool(out)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--judge", default="build/tests/judge")
    parser.add_argument("--program", default="build/flexwright")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=10)
    parser.add_argument("--given", action="store_true")
    parser.add_argument("--keep", default="")
    options = parser.parse_args()
    wrong = 0
    with tempfile.TemporaryDirectory() as own:
        where = pathlib.Path(options.keep or own)
        where.mkdir(parents=True, exist_ok=True)
        for seed in range(options.seed, options.seed + options.count):
            text, bad = judged(options, seed, where)
            wrong += bad
            print(seed, text, flush=True)
    print("%d of %d devices are wrong" % (wrong, options.count))
    return wrong > 0


if __name__ == "__main__":
    sys.exit(main())
