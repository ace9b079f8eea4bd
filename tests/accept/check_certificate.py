#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Verifies certificate.json of `flexwright workspace`: for every required box that every pose can be
assembled on the drawn branch with every hinge's angle in the stated range, and that the ends of the range
are nearly reached. Standard library only, and nothing of the product: own interval arithmetic, other
formulas (law of cosines and derivatives carried along, where the product has a vector form and Taylor
remainders), so that a mistake in one of the two shows.

    check_certificate.py certificate.json     exit status 0: all is proved; 1: something is not

Rounding: IEEE doubles; every result is moved outward by one number in + - * /, by two more for the C
library's sin, cos, acos, atan2, which are assumed to err by less than two units in the last place."""
import json
import math
import sys

INF = math.inf


class Refused(Exception):
    """the certificate does not prove what it says"""


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
        return Interval(down(self.lo + other.lo), up(self.hi + other.hi))

    def __sub__(self, other):
        return Interval(down(self.lo - other.hi), up(self.hi - other.lo))

    def __mul__(self, other):
        p = (self.lo * other.lo, self.lo * other.hi, self.hi * other.lo, self.hi * other.hi)
        return Interval(down(min(p)), up(max(p)))

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


def number(text):
    if not isinstance(text, str):
        raise Refused("numbers are written as their bits")
    value = float.fromhex(text)
    if not math.isfinite(value):
        raise Refused("a number is not finite")
    return value


def vector(pair):
    x, y = (number(t) for t in pair)
    return x, y


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
        axis = [Jet(b, tuple(ONE if i == k else ZERO for k in range(3))) for i, b in enumerate(box)]
        s, c = axis[2].sin(), axis[2].cos()
        out = [None] * 6
        for number_, leg in enumerate(self.legs):
            x, y = (Interval(t) for t in leg.to)
            qx = axis[0] + Jet(Interval(self.centre[0])) + c.scaled(x) - s.scaled(y)
            qy = axis[1] + Jet(Interval(self.centre[1])) + s.scaled(x) + c.scaled(y)
            alpha, beta = leg.angles(qx, qy)
            first, elbow = wrapped(alpha - leg.drawn[0]), wrapped(beta - leg.drawn[1])
            last = wrapped(axis[2] - first - elbow)
            for place, jet in enumerate((first, elbow, last)):
                hinge = 5 - place if number_ else place
                if number_:
                    jet = jet.scaled(Interval(-1.0))
                out[hinge] = jet + Jet(Interval(self.start[hinge]))
        return out

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

    def walk(self):
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


def check(document, most=200000):
    """boxes that were looked at, per required box; Refused where something is not proved"""
    if document.get("schema") != "flexwright.workspace-certificate/1":
        raise Refused("not a certificate of a workspace")
    counts = []
    for data in document["boxes"]:
        one = Check(data, most)
        one.walk()
        one.ends()
        counts.append((one.leaves, one.boxes))
    return counts


def main():
    try:
        with open(sys.argv[1], encoding="utf-8") as file:
            counts = check(json.load(file))
    except (Refused, Undecided, KeyError, TypeError, ValueError, OverflowError) as why:
        print("REFUSED: %s: %s" % (type(why).__name__, why))
        return 1
    for leaves, boxes in counts:
        print("proved: %d leaves, %d boxes here" % (leaves, boxes))
    print("all %d required boxes are proved" % len(counts))
    return 0


if __name__ == "__main__":
    sys.exit(main())
