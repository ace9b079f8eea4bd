# SPDX-License-Identifier: GPL-3.0-or-later
"""Random devices: every one as a device file for the program and as a model for the judge, from the same numbers."""
import math
import random

import strip

FINGER = 8.0  # um, width of fingers where none is stated
EPS0 = 8.8541878128e-6  # uN per V^2 where lengths cancel
DENSITY = 2330e-18  # kg/um^3
SLOW = 20  # periods of the lowest mode in which slow loads come, as (1 - cos)/2: what swings behind them is 1e-3 at most

TOPOLOGIES = ("rotation", "guided", "fixed-fixed", "folded", "four-bar")
KINDS = ("leaf", "csfh", "path", "varying")
LOADS = {"rotation": ("moment", "force", "turn", "velocity", "voltage", "shock", "step", "fatigue"),
         "guided": ("force", "slide", "rod", "velocity", "voltage", "shock", "step", "heat", "fatigue"),
         "fixed-fixed": ("force", "slide", "rod", "velocity", "voltage", "shock", "step", "heat", "fatigue"),
         "folded": ("force", "slide", "rod", "velocity", "voltage", "shock", "heat", "fatigue"),
         "four-bar": ("moment", "force", "rod", "velocity", "shock", "fatigue")}
STRAIGHT = ("leaf", "varying")  # kinds that may be of silicon in stages, as solids of it are


def classes():
    """(topology, kind, load) of all classes, evenly mixed"""
    out = [(topology, kind, load) for topology in TOPOLOGIES
           for kind in KINDS for load in LOADS[topology]]
    random.Random(7).shuffle(out)
    return out


def um(value):
    return "%.6f um" % value


def even(value):
    """a whole number of 2 nm, so that halves of lengths and sums of places are the same to the last digit written"""
    return round(value / 2e-3) * 2e-3


class Hinge:
    def __init__(self, name, flexure, a, b, at, axis):
        self.name, self.flexure, self.a, self.b, self.at, self.axis = name, flexure, a, b, at, axis


class Device:
    """what a seed draws; load and motion are added by its class"""

    def __init__(self, seed, wanted=None):
        self.seed, self.source = seed, random.Random(seed)
        all_classes = classes()
        self.topology, self.kind, self.load = wanted or all_classes[seed % len(all_classes)]
        self.h = self.between(20, 60)
        self.material = strip.Isotropic(self.between(70e3, 170e3), self.between(0.2, 0.3))
        if self.kind in STRAIGHT and self.topology not in ("rotation", "four-bar") and self.often(0.25):
            self.material = strip.Silicon(math.radians(round(self.between(0, 90), 3)))
        self.safety = self.of(1.0, 1.5, 2.0)
        self.strength = self.between(300, 1500)  # MPa
        self.target = self.between(0.9, 1.1)
        self.stated = self.often(0.2) and self.kind in ("leaf", "csfh") and self.load != "heat"
        self.stated = self.stated and not self.material.crystal
        self.flexures, self.hinges, self.bodies, self.shapes = {}, [], [], {}
        self.drawn = self.topology in ("rotation", "four-bar") and self.often(0.3)
        self.loads, self.scene, self.extra = [], "", ""
        getattr(self, self.topology.replace("-", "_"))()

    def between(self, low, high):
        return low + (high - low) * self.source.random()

    def of(self, *things):
        return things[int(self.source.random() * len(things))]

    def often(self, share):
        return self.source.random() < share

    # ------------------------------------------------------------------ flexures
    def flexure(self, name, kind, length):
        length = even(length)
        t = min(self.between(4, 12), length / 20)
        h = self.h
        t = max(t, h / 10, 2)  # no deeper than the solids of the fit
        fillet = round(t * self.between(0.2, 0.7), 3)
        t = round(t, 3)
        if kind == "leaf":
            text, pieces = 'kind="leaf" length="%s" width="%s"' % (um(length), um(t)), strip.leaf(length, t)
        elif kind == "varying" and (self.often(0.5) or self.topology in ("guided", "fixed-fixed", "folded")):
            middle = round(t * self.between(0.6, 1.3), 3)
            text = 'kind="leaf" length="%s" width="%s" width-middle="%s"' % (um(length), um(t), um(middle))
            pieces = strip.leaf(length, t, middle)
        elif kind in ("csfh", "varying"):
            angle = round(self.between(100, 290), 1)
            radius = round(max(length / math.radians(angle), t / 0.14), 3)
            text = 'kind="csfh" radius="%s" angle="%.9g deg" width="%s"' % (um(radius), angle, um(t))
            middle = None
            if kind == "varying":
                middle = round(t * self.between(0.75, 1.25), 3)
                text += ' width-middle="%s"' % um(middle)
            pieces = strip.csfh(radius, math.radians(angle), t, middle)
        else:
            text, pieces = self.path(t, length)
        if "<" not in text:
            text = '  <flexure id="%s" %s fillet="%s"/>\n' % (name, text, um(fillet))
        else:
            text = '  <flexure id="%s" %s' % (name, text.replace("FILLET", um(fillet)))
        self.flexures[name] = (text, strip.Strip(pieces, self.material, h, fillet))

    def path(self, t, length):
        piece = strip.Piece
        head = 'kind="path" width="%s" fillet="FILLET">\n' % um(t)
        if self.often(0.5):  # hairpin
            radius = round(max(length * 0.15, 8 * t), 3)
            leg = round(max((length - math.pi * radius) / 2, 20), 3)
            text = ('    <line length="%s"/>\n    <arc radius="%s" angle="180 deg"/>\n    <line length="%s"/>\n'
                    % (um(leg), um(radius), um(leg)))
            pieces = [piece(leg, 0.0, t, t, t), piece(math.pi * radius, 1 / radius, t, t, t), piece(leg, 0.0, t, t, t)]
        else:  # hook that grows thinner along its line
            thin, angle = round(t * self.between(0.75, 1), 3), round(self.between(50, 120), 1)
            radius, leg = round(max(length * 0.35, 8 * t), 3), round(length * 0.4, 3)
            middle = (t + thin) / 2
            text = ('    <line length="%s" width-end="%s"/>\n    <arc radius="%s" angle="%.9g deg" width-end="%s"/>\n'
                    % (um(leg), um(thin), um(radius), angle, um(thin)))
            pieces = [piece(leg, 0.0, t, middle, thin), piece(radius * math.radians(angle), 1 / radius, thin, thin, thin)]
        return head + text + "  </flexure>\n", pieces

    # ------------------------------------------------------------------ topologies
    def body(self, name, x, y, width, height):
        x, y, mass = even(x), even(y), width * height * self.h * DENSITY
        self.bodies.append((name, x, y, mass, mass * (width * width + height * height) / 12))
        return len(self.bodies)

    def hinge(self, name, flexure, a, b, x, y, axis):
        self.hinges.append(Hinge(name, flexure, a, b, (even(x), even(y)), axis))

    def rotation(self):
        self.flexure("F", self.kind, self.between(150, 500))
        reach, angle = self.between(150, 700), self.between(0, 2 * math.pi)
        axis = self.between(-math.pi, math.pi)
        if self.drawn:  # the ground's side of the hinge lies behind it, the arm's before it
            reach, axis = self.between(900, 1400), angle - math.pi / 2
            self.shapes["arm"] = ('width="150 um" plate-width="400 um" plate-height="300 um" plate-x="%s" plate-y="%s" '
                                  'plate-angle="%.9g deg"' % (um(reach * math.cos(angle)), um(reach * math.sin(angle)),
                                     math.degrees(angle)))
        self.body("arm", reach * math.cos(angle), reach * math.sin(angle), 2 * reach, self.between(80, 200))
        self.hinge("H", "F", 0, 1, 0.0, 0.0, axis)
        # across the arm at its centre, which is what moves most
        self.apply(1, (0.0, 0.0), angle + math.pi / 2)

    def guided(self):
        length, apart = even(self.between(200, 600)), self.between(150, 700)
        self.flexure("F", self.kind, length)
        height = self.between(100, 300)
        self.body("stage", 0, length + height / 2, apart + 60, height)
        for i, x in enumerate((-apart / 2, apart / 2)):
            self.hinge("H%d" % i, "F", 0, 1, x, length / 2, 0.0)
        self.apply(1, (0.0, even(self.between(-0.3, 0.3) * height)), 0.0)

    def fixed_fixed(self):
        length = even(self.between(200, 600))
        self.flexure("F", self.kind, length)
        width, rows = self.between(200, 600), self.of(1, 2)
        apart = self.between(100, 400) if rows == 2 else 0
        self.body("stage", 0, 0, width, apart + 100)
        for i in range(rows):
            y = (i - (rows - 1) / 2) * apart
            # from the ground to the stage on the left, from the stage to the ground on the right: along +x both
            self.hinge("L%d" % i, "F", 0, 1, -width / 2 - length / 2, y, -math.pi / 2)
            self.hinge("R%d" % i, "F", 1, 0, width / 2 + length / 2, y, -math.pi / 2)
        self.apply(1, (0.0, 0.0), math.pi / 2)

    def folded(self):
        length, inner, outer = even(self.between(200, 500)), self.between(60, 150), self.between(200, 400)
        self.flexure("F", self.kind, length)
        truss = self.between(60, 120)
        self.body("stage", 0, -60, 2 * inner + 60, 120)
        self.body("truss", 0, length + truss / 2, 2 * outer + 60, truss)
        for i, side in enumerate((-1, 1)):
            self.hinge("G%d" % i, "F", 0, 2, side * outer, length / 2, 0.0)
            self.hinge("S%d" % i, "F", 1, 2, side * inner, length / 2, 0.0)
        self.apply(1, (0.0, even(self.between(-40, 40))), 0.0)

    def four_bar(self):
        width, height = self.between(500, 1200), self.between(500, 1200)
        lean = self.between(-150, 150)
        if self.drawn:
            width, height, lean = self.between(1200, 1600), self.between(1200, 1600), 0.0
            self.shapes = {name: 'width="150 um"' for name in ("left", "coupler", "right")}
        for i in range(4):
            self.flexure("F%d" % i, self.kind, self.between(150, 350))
        self.body("left", lean / 2, height / 2, 80, height)
        self.body("coupler", lean + width / 2, height, width, 150)
        self.body("right", lean / 2 + width, height / 2, 80, height)
        axis = lambda: self.of(0.0, 0.0 if self.drawn else self.between(-0.5, 0.5))
        self.hinge("A", "F0", 0, 1, 0, 0, axis())
        self.hinge("B", "F1", 1, 2, lean, height, axis())
        self.hinge("C", "F2", 3, 2, lean + width, height, axis())
        self.hinge("D", "F3", 0, 3, width, 0, axis())
        self.apply(2, (0.0, even(self.between(-60, 60))), 0.0, everyone=True)

    # ------------------------------------------------------------------ loads
    def apply(self, body, point, direction, everyone=False):
        """what acts: model lines with {0} for nothing, and the scene with SIZE where the share belongs"""
        name = self.bodies[body - 1][0]
        c, s = math.cos(direction), math.sin(direction)
        self.pulse, self.moving = 0.0, self.load in ("velocity", "shock", "step")
        load, self.act = self.load, (body, name, point, direction)
        if load == "moment":
            self.loads.append("torque %d 1" % body)
        elif load in ("force", "fatigue", "step"):
            direction += self.between(-0.4, 0.4) if load == "force" and self.topology in ("rotation", "four-bar") else 0
            self.pull = (math.cos(direction), math.sin(direction))
            self.loads.append("force %d %.15g %.15g %.15g %.15g" % ((body,) + point + self.pull))
        elif load == "slide":
            self.loads.append("slide %d %.15g %.15g" % (body, c, s))
        elif load == "turn":
            self.loads.append("turn %d 1" % body)
        elif load == "rod":
            _, x, y, _, _ = self.bodies[body - 1]
            reach = self.between(300, 2000)
            self.far = (even(x + point[0] - reach * c), even(y + point[1] - reach * s))
            self.loads.append("rod %d %.15g %.15g %.15g %.15g 1" % ((body,) + point + self.far))
        elif load == "voltage":
            # an arm carries its fingers along a circle, and leaves lower what they carry
            if self.topology == "rotation":
                self.strength *= 0.15
            wide = {"rotation": (15, 30), "guided": (6, 12), "folded": (6, 12)}.get(self.topology, (3, 6))
            self.comb = (int(self.between(10, 80)), round(self.between(*wide), 3), round(self.between(20, 60), 3))
            n, gap, overlap = self.comb
            self.loads.append("comb %d %.15g %.15g %.15g %.15g %.15g %.15g %.15g %.15g"
                              % ((body,) + point + (direction, 0.5 * EPS0 * self.h * n, gap, overlap, FINGER, self.h)))
        elif load == "shock":
            self.pull = (c, s)
            self.loads.append("shake %.15g %.15g" % (c * 1e6, s * 1e6))  # per m/s^2
        elif load == "velocity":
            self.start = []
            self.turning = self.topology == "rotation"
            for k, (who, x, y, _, _) in enumerate(self.bodies, 1):
                if self.turning:
                    v = (-y, x, 1.0)  # about the hinge, per rad/s
                elif not everyone and self.topology != "folded":
                    v = (c, s, 0.0)
                elif self.topology == "folded":
                    v = (c if k == 1 else c / 2, 0.0, 0.0)
                else:  # cranks turn about their feet, the coupler goes along
                    rise = self.bodies[1][2]
                    foot = (0.0 if k == 1 else x - self.bodies[0][1], 0.0)
                    crank = (y - foot[1]) / rise, -(x - foot[0]) / rise, -1 / rise
                    v = (1.0, -2 * self.bodies[0][1] / rise, 0.0) if k == 2 else crank
                self.start.append((who, v))
                self.loads.append("start %d %.15g %.15g %.15g" % ((k,) + v))
        elif load == "heat":
            if self.topology == "guided":  # the stage grows with the layer and bends its leaves but little
                self.strength *= 0.1
            self.expansion = self.between(10e-6, 25e-6)
            # what is held at both ends must be stretched: pressed, it buckles far below any limit
            self.substrate = self.expansion * (self.between(1.5, 3) if self.topology == "fixed-fixed" else self.between(0, 0.6))
            self.loads.append("heat %.15g %.15g 0 0 0" % (self.expansion, self.substrate))

    # ------------------------------------------------------------------ the judge's model
    def model(self, duration=0.0):
        out = []
        for _, x, y, mass, inertia in self.bodies:
            out.append("body %.15g %.15g %.15g %.15g\n" % (x, y, mass, inertia))
        for hinge in self.hinges:
            out.append(self.flexures[hinge.flexure][1].model(hinge.a, hinge.b, hinge.at, hinge.axis))
        out += [line + "\n" for line in self.loads]
        if self.moving and duration:
            out.append("motion %.15g\n" % duration)
            if self.pulse:
                out.append("pulse %.15g\n" % self.pulse)
        return "".join(out)

    def timing(self, omega):
        """duration in s, from the lowest frequency that what acts can excite"""
        period = 2 * math.pi / omega
        if not self.moving:
            return SLOW * period
        if self.load == "shock":
            self.pulse = period * self.between(0.2, 1.5)
            return self.pulse + 0.6 * period
        return (0.6 if self.load == "velocity" else 1.1) * period

    # ------------------------------------------------------------------ the device file
    def joint(self, hinge):
        def end(k):
            if k == 0:
                return "ground", hinge.at
            name, x, y, _, _ = self.bodies[k - 1]
            return name, (hinge.at[0] - x, hinge.at[1] - y)

        (a, (ax, ay)), (b, (bx, by)) = end(hinge.a), end(hinge.b)
        stated = ' stiffness="%.12g N m/rad"' % (self.flexures[hinge.flexure][1].stiff * 1e-12) if self.stated else ""
        return ('    <revolute id="%s" a="%s" a-x="%s" a-y="%s" b="%s" b-x="%s" b-y="%s" hinge="%s" axis="%.12g deg"%s/>\n'
                % (hinge.name, a, um(ax), um(ay), b, um(bx), um(by), hinge.flexure, math.degrees(hinge.axis), stated))

    def drive(self, share, duration):
        """(joint and driver, what the scene holds)"""
        body, name, (px, py), direction = self.act
        slow = 'law="expression" factor="(1 - cos(pi*time/(%.12g s)))/2"' % duration
        value = "%.12g %s * (1 - cos(pi*time/(%.12g s)))/2"
        at = 'on="%s" x="%s" y="%s"' % (name, um(px), um(py))
        load = self.load
        if load == "moment":
            return "", '    <torque on="%s" value="%.12g pN m" %s/>\n' % (name, share, slow)
        if load in ("force", "fatigue", "step"):
            fx, fy = (share * v for v in self.pull)
            return "", '    <force %s fx="%.12g uN" fy="%.12g uN" %s/>\n' % (at, fx, fy, "" if load == "step" else slow)
        if load == "slide":
            _, x, y, _, _ = self.bodies[body - 1]
            return ('    <prismatic id="P" a="ground" a-x="%s" a-y="%s" b="%s" axis="%.12g deg"/>\n'
                    '    <driver joint="P" value="%s"/>\n'
                    % (um(x), um(y), name, math.degrees(direction), value % (share, "um", duration))), ""
        if load == "rod":
            _, x, y, _, _ = self.bodies[body - 1]
            fx, fy = self.far
            length = math.hypot(x + px - fx, y + py - fy)
            return ('    <distance id="P" a="ground" a-x="%s" a-y="%s" b="%s" b-x="%s" b-y="%s"/>\n'
                    '    <driver joint="P" value="%s + %s"/>\n'
                    % (um(fx), um(fy), name, um(px), um(py), um(length), value % (share, "um", duration))), ""
        if load == "turn":
            return '    <driver joint="H" value="%s"/>\n' % (value % (share, "rad", duration)), ""
        if load == "voltage":
            n, gap, overlap = self.comb
            return "", ('    <comb-drive id="V" kind="comb" %s direction="%.12g deg" fingers="%d" gap="%s" overlap="%s" '
                        'length="%s" voltage="%.12g V" %s/>\n' % (at, math.degrees(direction), n, um(gap), um(overlap),
                                                                  um(overlap + 150), share, slow))
        if load == "shock":
            ax, ay = (share * v for v in self.pull)
            return "", ('    <base-motion ax="%.12g m/s^2" ay="%.12g m/s^2" law="half-sine" rise="%.12g s"/>\n'
                        % (ax, ay, self.pulse))
        if load == "velocity":
            return "", "".join('    <initial body="%s" vx="%.12g mm/s" vy="%.12g mm/s" omega="%.12g rad/s"/>\n'
                               % (who, share * vx * 1e-3, share * vy * 1e-3, share * w) for who, (vx, vy, w) in self.start)
        return "", ('    <temperature change="%.12g K" expansion="%.12g ppm/K" substrate-expansion="%.12g ppm/K" '
                    'modulus-change="0 ppm/K" %s/>\n' % (share, self.expansion * 1e6, self.substrate * 1e6, slow))

    def strength_of(self):
        """stress that the fatigue or the static limit allows at the peak, MPa, safety factor included"""
        if self.load != "fatigue":
            return self.strength / self.safety
        # every scene goes from 0 to the peak and back: sigma_ar = peak/sqrt 2; Basquin at 1e6 of 1e7 cycles with b = -0.1
        return self.strength / self.safety

    def xml(self, share, duration):
        joint, scene = self.drive(share, duration)
        material = 'strength="%.12g MPa"' % self.strength
        limits = 'safety-factor="%.6g"' % self.safety
        if self.load == "fatigue":
            # the amplitude that lasts 1e6 cycles is strength/sqrt 2, and the static limit lies far above
            material = ('strength="%.12g MPa" fatigue-strength="%.12g MPa" fatigue-cycles="1e7" fatigue-exponent="-0.1"'
                        % (3 * self.strength, self.strength / math.sqrt(2) * 10 ** -0.1))
            limits += ' cycles="1e6"'
        elastic = ('orientation="%.12g deg"' % math.degrees(self.material.first) if self.material.crystal else
                   'youngs-modulus="%.12g MPa" poisson="%.12g"' % (self.material.mean, self.material.nu))
        out = ['<?xml version="1.0" encoding="UTF-8"?>\n<device xmlns="urn:flexwright:device:1" name="judge-%d">\n' % self.seed,
               '  <material ref="silicon-100" %s thickness="%s" %s/>\n' % (elastic, um(self.h), material),
               "  <limits %s/>\n" % limits, '  <flow ref="al-masked-rie"/>\n']
        out += [text for text, _ in self.flexures.values()]
        out.append("  <mechanism>\n")
        for name, x, y, mass, inertia in self.bodies:
            out.append('    <body id="%s" x="%s" y="%s" mass="%.12g ug" inertia="%.12g ug mm^2" %s/>\n'
                       % (name, um(x), um(y), mass * 1e9, inertia * 1e3, self.shapes.get(name, "")))
        out += [self.joint(hinge) for hinge in self.hinges]
        out += [joint, "  </mechanism>\n", '  <scene name="s" duration="%.12g s">\n' % duration, scene, "  </scene>\n</device>\n"]
        return "".join(out)
