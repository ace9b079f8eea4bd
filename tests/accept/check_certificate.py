#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Verifies certificate.json of `flexwright workspace`: for every required box that every pose can be
assembled on the drawn branch with every hinge's angle in the stated range, and that the ends of the range
are nearly reached; and that no hinge is strained beyond what is said, whatever of the actuations holds the pose;
and, in check_volume.py, that the reachable volume lies in the stated bracket.
Standard library only, and nothing of the product: own interval arithmetic, other
formulas (law of cosines and derivatives carried along, where the product has a vector form and Taylor
remainders), so that a mistake in one of the two shows.

    check_certificate.py certificate.json     exit status 0: all is proved; 1: something is not

Rounding: IEEE doubles; every result is moved outward by one number in + - * /, by two more for the C
library's sin, cos, acos, atan2, which are assumed to err by less than two units in the last place."""
import json
import math
import sys

import check_volume
from claims import Refused, number, vector

INF = math.inf
next_to = math.nextafter


def down(x, n=1):
    for _ in range(n):
        x = math.nextafter(x, -INF)
    return x


def up(x, n=1):
    for _ in range(n):
        x = math.nextafter(x, INF)
    return x


class Interval:
    __slots__ = ("lo", "hi")

    def __init__(self, lo, hi=None):
        self.lo = lo
        self.hi = lo if hi is None else hi
        if not self.lo <= self.hi:
            raise Refused("not a number")

    def __neg__(self):
        return Interval(-self.hi, -self.lo)

    def __add__(self, other):
        return Interval(next_to(self.lo + other.lo, -INF), next_to(self.hi + other.hi, INF))

    def __sub__(self, other):
        return Interval(next_to(self.lo - other.hi, -INF), next_to(self.hi - other.lo, INF))

    def __mul__(self, other):
        a, b, c, d = self.lo, self.hi, other.lo, other.hi
        if c == d:
            if c == 0.0 and math.isfinite(a) and math.isfinite(b):
                return ZERO
            p, q = a * c, b * c
            if p > q:
                p, q = q, p
            return Interval(next_to(p, -INF), next_to(q, INF))
        p = (a * c, a * d, b * c, b * d)
        return Interval(next_to(min(p), -INF), next_to(max(p), INF))

    def __truediv__(self, other):
        if other.lo <= 0 <= other.hi:
            raise Undecided
        p = (self.lo / other.lo, self.lo / other.hi, self.hi / other.lo, self.hi / other.hi)
        return Interval(down(min(p)), up(max(p)))

    def square(self):
        p = self * self
        return Interval(max(p.lo, 0.0), p.hi) if self.lo <= 0 <= self.hi else p

    def root(self):
        if self.lo <= 0:
            raise Undecided
        return Interval(down(math.sqrt(self.lo)), up(math.sqrt(self.hi)))


class Undecided(Exception):
    """the box has to be halved"""


ZERO, ONE, TWO = Interval(0.0), Interval(1.0), Interval(2.0)


def wave(a, function, peaks):
    """sin or cos of a short interval; peaks: where it is +-1, in quarter turns modulo four"""
    quarter = math.pi / 2
    if a.hi - a.lo > 1:
        return Interval(-1.0, 1.0)
    values = [function(a.lo), function(a.hi)]
    lo, hi = down(min(values), 3), up(max(values), 3)
    for k in range(math.floor(a.lo / quarter) - 1, math.ceil(a.hi / quarter) + 2):
        if a.lo - 1e-12 <= k * quarter <= a.hi + 1e-12:
            lo = -1.0 if k % 4 == peaks[1] else lo
            hi = 1.0 if k % 4 == peaks[0] else hi
    return Interval(max(lo, -1.0), min(hi, 1.0))


class Jet:
    """a function over a box: its range, and the ranges of its derivatives by x, y, phi"""
    __slots__ = ("v", "d")

    def __init__(self, v, d=(ZERO, ZERO, ZERO)):
        self.v, self.d = v, d

    def __add__(self, o):
        return Jet(self.v + o.v, tuple(a + b for a, b in zip(self.d, o.d)))

    def __sub__(self, o):
        return Jet(self.v - o.v, tuple(a - b for a, b in zip(self.d, o.d)))

    def __mul__(self, o):
        return Jet(self.v * o.v, tuple(a * o.v + self.v * b for a, b in zip(self.d, o.d)))

    def __truediv__(self, o):
        q = self.v / o.v
        return Jet(q, tuple((a - q * b) / o.v for a, b in zip(self.d, o.d)))

    def square(self):
        return Jet(self.v.square(), tuple(TWO * self.v * a for a in self.d))

    def scaled(self, k):
        return Jet(self.v * k, tuple(a * k for a in self.d))

    def root(self):
        r = self.v.root()
        return Jet(r, tuple(a / (TWO * r) for a in self.d))

    def sin(self):
        c = wave(self.v, math.cos, (0, 2))
        return Jet(wave(self.v, math.sin, (1, 3)), tuple(a * c for a in self.d))

    def cos(self):
        s = -wave(self.v, math.sin, (1, 3))
        return Jet(wave(self.v, math.cos, (0, 2)), tuple(a * s for a in self.d))

    def acos(self):
        if not (self.v.lo > -1 and self.v.hi < 1):
            raise Undecided
        slope = -(ONE / (ONE - self.v.square()).root())
        return Jet(Interval(down(math.acos(self.v.hi), 3), up(math.acos(self.v.lo), 3)),
                   tuple(a * slope for a in self.d))


def direction(y, x, near):
    """angle of (x, y), continued from the angle `near`"""
    c, s = Interval(math.cos(near)), Interval(math.sin(near))  # any rotation will do, so no rounding counts
    u, v = x.scaled(c) + y.scaled(s), y.scaled(c) - x.scaled(s)
    if u.v.lo <= 0:
        raise Undecided  # more than a quarter turn from `near`
    corners = [math.atan2(b, a) for b in (v.v.lo, v.v.hi) for a in (u.v.lo, u.v.hi)]
    # the rotation by `near` is not quite one: (c, s) has a direction of its own
    own = math.atan2(math.sin(near), math.cos(near))
    value = Interval(down(min(corners), 3), up(max(corners), 3)) + Interval(down(own, 3), up(own, 3))
    n = u.v.square() + v.v.square()
    return Jet(value, tuple((u.v * b - v.v * a) / n for a, b in zip(u.d, v.d)))


class Leg:
    def __init__(self, data, centre):
        self.base, self.a, self.b, self.to = (vector(data[k]) for k in
                                              ("base_m", "first_m", "second_m", "platform_m"))
        for i in range(2):  # the drawn pose is the pose 0, 0, 0
            gap = self.base[i] + self.a[i] + self.b[i] - centre[i] - self.to[i]
            if abs(gap) > 1e-15:
                raise Refused("the drawn leg does not close")
        exact = [[Interval(c) for c in v] for v in (self.a, self.b)]
        (ax, ay), (bx, by) = exact
        side = ax * by - ay * bx
        if side.lo <= 0 <= side.hi:
            raise Refused("a leg is stretched or folded as drawn")
        self.sign = 1 if side.lo > 0 else -1
        self.l2, self.m2 = ax.square() + ay.square(), bx.square() + by.square()
        self.lm2 = TWO * (self.l2 * self.m2).root()
        self.l, self.m = self.l2.root(), self.m2.root()
        # as drawn, from the same formulas: direction of the first link, elbow
        self.drawn = self.angles(Jet(Interval(self.base[0]) + ax + bx), Jet(Interval(self.base[1]) + ay + by))

    def angles(self, qx, qy):
        """directions of the first link, and of the second from it"""
        vx, vy = qx - Jet(Interval(self.base[0])), qy - Jet(Interval(self.base[1]))
        d2 = vx.square() + vy.square()
        beta = (d2 - Jet(self.l2) - Jet(self.m2)).scaled(ONE / self.lm2).acos()
        if self.sign < 0:
            beta = beta.scaled(Interval(-1.0))
        rise = beta.sin().scaled(self.m)
        run = beta.cos().scaled(self.m) + Jet(self.l)
        middle = [0.5 * (j.v.lo + j.v.hi) for j in (vx, vy)]
        toward = direction(vy, vx, math.atan2(middle[1], middle[0]))
        lean = direction(rise, run, math.atan2(0.5 * (rise.v.lo + rise.v.hi), 0.5 * (run.v.lo + run.v.hi)))
        return toward - lean, beta


def wrapped(jet):
    """the same angle within half a turn of zero"""
    middle = 0.5 * (jet.v.lo + jet.v.hi)
    turns = round(middle / (2 * math.pi))
    if turns:
        full = Interval(down(2 * math.pi, 2), up(2 * math.pi, 2)) * Interval(float(turns))
        jet = Jet(jet.v - full, jet.d)
    if jet.v.lo <= -math.pi or jet.v.hi >= math.pi:
        raise Undecided
    return jet


class Mechanism:
    def __init__(self, data):
        self.centre = vector(data["centre_m"])
        self.legs = [Leg(data[side], self.centre) for side in ("left", "right")]
        self.start = [number(t) for t in data["start_rad"]]
        if len(self.start) != 6:
            raise Refused("six hinges")

    def turns(self, box):
        """joint angles A..F over the box as jets"""
        return self.posture(box)[0]

    def posture(self, box):
        """joint angles A..F; rotations of the five bodies"""
        axis = [Jet(b, tuple(ONE if i == k else ZERO for k in range(3))) for i, b in enumerate(box)]
        s, c = axis[2].sin(), axis[2].cos()
        out, bodies = [None] * 6, [None, None, axis[2], None, None]
        for number_, leg in enumerate(self.legs):
            x, y = (Interval(t) for t in leg.to)
            qx = axis[0] + Jet(Interval(self.centre[0])) + c.scaled(x) - s.scaled(y)
            qy = axis[1] + Jet(Interval(self.centre[1])) + s.scaled(x) + c.scaled(y)
            alpha, beta = leg.angles(qx, qy)
            first, elbow = wrapped(alpha - leg.drawn[0]), wrapped(beta - leg.drawn[1])
            last = axis[2] - first - elbow  # all else that the platform turns by
            bodies[4 if number_ else 0], bodies[3 if number_ else 1] = first, first + elbow
            for place, jet in enumerate((first, elbow, last)):
                hinge = 5 - place if number_ else place
                if number_:
                    jet = jet.scaled(Interval(-1.0))
                out[hinge] = jet + Jet(Interval(self.start[hinge]))
        return out, bodies

    def ranges(self, box):
        """enclosures of the joint angles: natural, mean value, and at the corner where all is monotone"""
        jets = self.turns(box)
        middle = [0.5 * (b.lo + b.hi) for b in box]
        at = self.turns([Interval(m) for m in middle])
        out, corners = [], {}
        for hinge, jet in enumerate(jets):
            mean = at[hinge].v
            for d, b, m in zip(jet.d, box, middle):
                mean = mean + d * (b - Interval(m))
            lo, hi = max(mean.lo, jet.v.lo), min(mean.hi, jet.v.hi)
            if all(d.lo >= 0 or d.hi <= 0 for d in jet.d):
                for upper in (False, True):
                    corner = tuple(b.hi if (d.lo >= 0) == upper else b.lo for d, b in zip(jet.d, box))
                    if corner not in corners:
                        corners[corner] = self.turns([Interval(t) for t in corner])
                    value = corners[corner][hinge].v
                    lo, hi = (lo, min(hi, value.hi)) if upper else (max(lo, value.lo), hi)
            out.append((lo, hi))
        return out


def halves(box, axis):
    middle = 0.5 * (box[axis].lo + box[axis].hi)
    for part in (Interval(box[axis].lo, middle), Interval(middle, box[axis].hi)):
        yield box[:axis] + [part] + box[axis + 1:]


def walk(self):
    """every box of the tree is a leaf, or halved; nothing is left out"""
    stack = [self.box]
    for c in self.tree:
        if not stack:
            raise Refused("the tree has too many nodes")
        box = stack.pop()
        if c == ".":
            self.leaves += 1
            self.leaf(box, 0)
        elif c in "xyp":
            lower, upper = halves(box, "xyp".index(c))
            stack += [upper, lower]
        else:
            raise Refused("the tree has a node of no kind")
    if stack:
        raise Refused("the tree leaves a part of the box out")


class Check:
    def __init__(self, data, most):
        self.mechanism = Mechanism(data["mechanism"])
        self.box = [Interval(*(number(t) for t in pair)) for pair in data["box"]]
        if len(self.box) != 3 or len(data["hinges"]) != 6:
            raise Refused("three coordinates and six hinges")
        self.claim = [tuple(number(t) for t in h["angle_rad"]) for h in data["hinges"]]
        self.hinges, self.tree = data["hinges"], data["tree"]
        self.most, self.boxes, self.leaves = most, 0, 0

    def leaf(self, box, depth):
        """true of every pose of the box? Halved where these formulas are not sharp enough"""
        self.boxes += 1
        if self.boxes > self.most:
            raise Refused("not proved within %d boxes" % self.most)
        try:
            found = self.mechanism.ranges(box)
            if all(c[0] <= f[0] and f[1] <= c[1] for c, f in zip(self.claim, found)):
                return
        except Undecided:
            pass
        if depth == 24:
            raise Refused("cannot be proved near " + str([b.lo for b in box]))
        widths = [(b.hi - b.lo) / max(w.hi - w.lo, 1e-300) for b, w in zip(box, self.box)]
        for part in halves(box, widths.index(max(widths))):
            self.leaf(part, depth + 1)

    def ends(self):
        """each end of a range is nearly reached by the pose that is named for it"""
        for hinge, (data, claim) in enumerate(zip(self.hinges, self.claim)):
            size = max(abs(claim[0]), abs(claim[1]))
            for end, name in enumerate(("least", "most")):
                pose = [number(t) for t in data[name]["pose"]]
                said = [number(t) for t in data[name]["angle_rad"]]
                if not all(b.lo <= p <= b.hi for b, p in zip(self.box, pose)):
                    raise Refused("the pose of an end lies outside of the box")
                try:
                    found = self.mechanism.turns([Interval(p) for p in pose])[hinge].v
                except Undecided:
                    raise Refused("the pose of an end cannot be assembled") from None
                if found.hi < said[0] or said[1] < found.lo:
                    raise Refused("the pose of an end has another angle")
                if abs(found.lo - claim[end]) > 1e-2 * size + 1e-9:
                    raise Refused("a range is wider than what is reached")


GROUND = -1


class Vector:
    """two jets"""
    __slots__ = ("x", "y")

    def __init__(self, x, y):
        self.x, self.y = x, y

    def __add__(self, o):
        return Vector(self.x + o.x, self.y + o.y)

    def __sub__(self, o):
        return Vector(self.x - o.x, self.y - o.y)

    def times(self, k):
        return Vector(self.x * k, self.y * k)

    def dot(self, o):
        return self.x * o.x + self.y * o.y

    def cross(self, o):
        return self.x * o.y - self.y * o.x


def fixed(x, y):
    return Vector(Jet(Interval(x)), Jet(Interval(y)))


def rotated(turn, x, y):
    """a fixed vector; turn: (cos, sin)"""
    x, y = Interval(x), Interval(y)
    return Vector(turn.x.scaled(x) - turn.y.scaled(y), turn.x.scaled(y) + turn.y.scaled(x))


def total(jets):
    out = Jet(ZERO)
    for jet in jets:
        out = out + jet
    return out


def determinant(p, q, r):
    return (p[0] * (q[1] * r[2] - q[2] * r[1]) + p[1] * (q[2] * r[0] - q[0] * r[2])
            + p[2] * (q[0] * r[1] - q[1] * r[0]))


class Statics:
    """Joint forces at the poses of a box. Of every leg the force at its elbow follows from the moments of the lower link
    about the ground hinge and of the upper one about the platform's (the product takes moments about the elbow)."""

    def __init__(self, mechanism, length, box):
        self.length = length
        self.theta, bodies = mechanism.posture(box)
        self.turn = [Vector(b.cos(), b.sin()) for b in bodies]
        self.half = [total((p, q)).scaled(Interval(0.5)) for p, q in zip([Jet(ZERO)] + bodies, bodies + [Jet(ZERO)])]
        left, right = mechanism.legs
        self.a = [rotated(self.turn[0], *left.a), rotated(self.turn[4], *right.a)]
        self.b = [rotated(self.turn[1], *left.b), rotated(self.turn[3], *right.b)]
        pins = []
        for leg, a, b in zip((left, right), self.a, self.b):
            ground = fixed(*leg.base)
            pins.append((ground, ground + a, ground + a + b))
        self.pin = pins[0] + pins[1][::-1]  # A..F
        axis = [Jet(v, tuple(ONE if i == k else ZERO for k in range(3))) for i, v in enumerate(box)]
        self.centre = Vector(axis[0] + Jet(Interval(mechanism.centre[0])), axis[1] + Jet(Interval(mechanism.centre[1])))
        # of every body a point and where it was drawn, and the hinge that its moments are about
        drawn = [left.base, (left.base[0] + left.a[0], left.base[1] + left.a[1]), mechanism.centre,
                 (right.base[0] + right.a[0], right.base[1] + right.a[1]), right.base]
        self.place = list(zip((self.pin[0], self.pin[1], self.centre, self.pin[4], self.pin[5]), drawn))
        self.about = (self.pin[0], self.pin[2], self.centre, self.pin[3], self.pin[5])

    def point(self, body, at):
        if body == GROUND:
            return fixed(*at)
        place, drawn = self.place[body]
        return place + rotated(self.turn[body], at[0] - drawn[0], at[1] - drawn[1])

    def solve(self, moment, force, outer):
        """moment: of the hinges, or zeros; force, outer: on the bodies, moments about self.about. Joint forces A..F, and
        what the platform lacks"""
        zero, m, out = Jet(ZERO), moment, []
        left = (m[1] - m[0] + outer[0], m[2] - m[1] + outer[1])
        right = (m[4] - m[5] - outer[4], m[3] - m[4] - outer[3])
        for a, b, (of_a, of_b) in zip(self.a, self.b, (left, right)):
            side = a.cross(b)
            out.append(Vector((b.x * of_a - a.x * of_b) / side, (b.y * of_a - a.y * of_b) / side))
        r_b, r_e = out
        forces = [r_b - force[0], r_b, r_b + force[1], r_e - force[3], r_e, r_e + force[4]]
        push = forces[2] - forces[3] + force[2]
        turn = ((self.pin[2] - self.centre).cross(forces[2]) - (self.pin[3] - self.centre).cross(forces[3])
                + m[3] - m[2] + outer[2])
        scale = Interval(1.0) / self.length
        return forces, (push.x, push.y, turn.scaled(scale)), zero

    def act(self, actuator):
        """forces on the five bodies and their moments"""
        force, outer = [fixed(0.0, 0.0) for _ in range(5)], [Jet(ZERO) for _ in range(5)]

        def push(body, at, f):
            if body != GROUND:
                force[body] = force[body] + f
                outer[body] = outer[body] + (at - self.about[body]).cross(f)
        kind, points = actuator["kind"], [(p["body"], vector(p["at_m"])) for p in actuator["points"]]
        x, y = vector(actuator["direction"])
        if kind == "torque":
            outer[actuator["body"]] = Jet(self.length)
        elif kind == "force":
            push(points[0][0], self.point(*points[0]), fixed(x, y))
        elif kind == "electrodes":
            against, at = actuator["against"], self.point(*points[0])
            f = fixed(x, y) if against == GROUND else rotated(self.turn[against], x, y)
            push(points[0][0], at, f)
            push(against, at, fixed(0.0, 0.0) - f)
        elif kind == "tendon":
            for p, q in zip(points, points[1:]):
                if p[0] == q[0]:
                    continue
                way = self.point(*q) - self.point(*p)
                length = (way.x.square() + way.y.square()).root()
                e = Vector(way.x / length, way.y / length)
                push(p[0], self.point(*p), e)
                push(q[0], self.point(*q), fixed(0.0, 0.0) - e)
        else:
            raise Refused("an actuator of no kind")
        return force, outer


class Strains:
    """no hinge is strained beyond the claim at any pose of the box, whatever of the actuations holds it"""

    def __init__(self, data, mechanism, box, most):
        self.mechanism, self.box, self.most, self.boxes, self.leaves = mechanism, box, most, 0, 0
        self.length = Interval(number(data["length_m"][0]))
        self.hinges = []
        for h in data["hinges"]:
            spring, own = (number(t) for t in h["stiffness_Nm_per_rad"])
            stations = [tuple(number(t) for t in s) for s in h["stations"]]
            if any(s[2] < 0 or s[3] < 0 for s in stations):
                raise Refused("a station that relieves")
            self.hinges.append((spring, own, vector(h["axis"]), stations, tuple(number(t) for t in h["strain"])))
        self.actuators, self.actuations = data["actuators"], data["actuations"]
        if len(self.hinges) != 6 or not self.actuations:
            raise Refused("six hinges and something that holds them")
        self.data, self.tree = data, data["tree"]

    def loads(self, box):
        """what each actuation makes of the box: of every hinge K theta and its force along and across the axis. None where
        it would have to pull the wrong way; `certain`: it does not anywhere"""
        s = Statics(self.mechanism, self.length, box)
        nothing = [fixed(0.0, 0.0)] * 5, [Jet(ZERO)] * 5
        moment = [t.scaled(Interval(h[0])) for t, h in zip(s.theta, self.hinges)]
        own, lacks, zero = s.solve(moment, *nothing)
        answers = [s.solve([zero] * 6, *s.act(a)) for a in self.actuators]
        frames = [Vector(h.cos(), h.sin()) for h in s.half]
        for which in self.actuations:
            wrench = [answers[i][1] for i in which]
            below = determinant(*wrench)
            forces, wrong, certain = list(own), False, True
            for k, i in enumerate(which):
                column = [lacks if k == j else w for j, w in enumerate(wrench)]
                size = (determinant(*column) / below).scaled(Interval(-1.0))
                if self.actuators[i]["pulls"]:
                    wrong, certain = wrong or size.v.hi < 0, certain and size.v.lo >= 0
                forces = [f + g.times(size) for f, g in zip(forces, answers[i][0])]
            if wrong:
                yield None
                continue
            out = []
            for f, t, h, frame in zip(forces, s.theta, self.hinges, frames):
                axis = rotated(frame, *h[2])
                out.append((t.scaled(Interval(h[1])), axis.dot(f), axis.cross(f), f))
            yield out, certain

    @staticmethod
    def station(at, load):
        """jet of the bending part"""
        x, y, bending, _ = at
        return (load[0] - load[1].scaled(Interval(x)) - load[2].scaled(Interval(y))).scaled(Interval(bending))

    @staticmethod
    def size(load):
        """upper bound of |F|"""
        x, y = (max(-j.v.lo, j.v.hi) for j in (load[3].x, load[3].y))
        return up(math.hypot(x, y), 3)

    def over(self, box, load, middle, hinge, force):
        """0 where the hinge's strain is below the claim as it stands, else an upper bound of it by the mean value of every
        station"""
        worst, claim = 0.0, self.hinges[hinge][4][1]
        for at in self.hinges[hinge][3]:
            pull = up(at[3] * force)
            plain = load[hinge]
            v = (plain[0].v - plain[1].v * Interval(at[0]) - plain[2].v * Interval(at[1])) * Interval(at[2])
            if up(max(-v.lo, v.hi) + pull) <= claim:
                continue
            bound = self.station(at, load[hinge])
            mean = self.station(at, middle[hinge]).v
            for d, b in zip(bound.d, box):
                mean = mean + d * (b - Interval(0.5 * (b.lo + b.hi)))
            lo, hi = max(mean.lo, bound.v.lo), min(mean.hi, bound.v.hi)
            worst = max(worst, up(max(-lo, hi) + pull))
            if worst > claim:
                break
        return worst

    def proved(self, box):
        try:
            whole = list(self.loads(box))
            middle = list(self.loads([Interval(0.5 * (b.lo + b.hi)) for b in box]))
        except Undecided:
            return False
        for one, at in zip(whole, middle):
            if one is None:
                continue
            if at is None:
                return False
            for hinge in range(6):
                load, claim = one[0][hinge], self.hinges[hinge][4][1]
                # |F| at the middle and what it may grow by, or the range itself
                grow = sum(max(-d.lo, d.hi) * 0.5 * (b.hi - b.lo) for part in (load[3].x, load[3].y)
                           for d, b in zip(part.d, box))
                force = min(self.size(load), up(self.size(at[0][hinge]) + up(grow * (1 + 1e-12))))
                if self.over(box, one[0], at[0], hinge, force) > claim:
                    return False
        return True

    def leaf(self, box, depth):
        self.boxes += 1
        if self.boxes > self.most:
            raise Refused("strains are not proved within %d boxes" % self.most)
        if self.proved(box):
            return
        if depth == 24:
            raise Refused("strains cannot be proved near " + str([b.lo for b in box]))
        widths = [(b.hi - b.lo) / max(w.hi - w.lo, 1e-300) for b, w in zip(box, self.box)]
        for part in halves(box, widths.index(max(widths))):
            self.leaf(part, depth + 1)

    def ends(self):
        """each bound is nearly reached by the pose and the actuation that are named for it"""
        for hinge, data in enumerate(self.data["hinges"]):
            if not self.hinges[hinge][3]:
                continue
            said, claim = self.hinges[hinge][4]
            pose = [number(t) for t in data["pose"]]
            if not all(b.lo <= p <= b.hi for b, p in zip(self.box, pose)):
                raise Refused("the pose of a strain lies outside of the box")
            found = list(self.loads([Interval(p) for p in pose]))[data["actuation"]]
            if found is None or not found[1]:
                raise Refused("that actuation does not hold the pose")
            load, most = found[0][hinge], 0.0
            force = math.hypot(load[3].x.v.lo, load[3].y.v.lo)
            for at in self.hinges[hinge][3]:
                bent = self.station(at, load).v
                most = max(most, min(abs(bent.lo), abs(bent.hi)) + at[3] * force)
            if abs(most - said) > 1e-9 * said or claim > 1.02 * said:
                raise Refused("a strain is larger than what is reached")
            if claim < said * (1 - 1e-12):
                raise Refused("a pose is strained beyond what is said")


def check(document, most=200000):
    """boxes that were looked at, per required box and for its strains; Refused where something is not proved"""
    if document.get("schema") != "flexwright.workspace-certificate/2":
        raise Refused("not a certificate of a workspace")
    counts = []
    for data in document["boxes"]:
        one = Check(data, most)
        walk(one)
        one.ends()
        counts.append((one.leaves, one.boxes))
        if data.get("strain"):
            strains = Strains(data["strain"], one.mechanism, one.box, most)
            strains.ends()
            walk(strains)
            counts.append((strains.leaves, strains.boxes))
    return counts


def check_volumes(document, most=20000):
    """per flow: its name, why it has no volume, or what proved it (check_volume.Volume) and the own bracket in m2 rad"""
    found = []
    for data in document["volumes"]:
        if data["volume"] is None:
            if not data["none"]:
                raise Refused("no volume, and no reason")
            found.append((data["flow"], data["none"], None))
        else:
            found.append((data["flow"], *check_volume.check(data["volume"], most)))
    if not found:
        raise Refused("no flow has a volume")
    return found


def main():
    try:
        with open(sys.argv[1], encoding="utf-8") as file:
            document = json.load(file)
        counts = check(document)
        for flow, volume, bracket in check_volumes(document):
            if bracket is None:
                print("%s: no volume: %s" % (flow, volume))
                continue
            print("%s: the volume lies in [%.7g, %.7g] m2 rad as stated: %d leaves, %d boxes here, own bracket "
                  "[%.7g, %.7g]" % (flow, *volume.claim, volume.leaves, volume.boxes, *bracket))
    except (Refused, Undecided, KeyError, TypeError, ValueError, OverflowError) as why:
        print("REFUSED: %s: %s" % (type(why).__name__, why))
        return 1
    for leaves, boxes in counts:
        print("proved: %d leaves, %d boxes here" % (leaves, boxes))
    print("all %d required boxes and strains are proved" % len(counts))
    return 0


if __name__ == "__main__":
    sys.exit(main())
