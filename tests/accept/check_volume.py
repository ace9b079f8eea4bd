# SPDX-License-Identifier: GPL-3.0-or-later
"""Verifies the reachable volume in certificate.json of `flexwright workspace`: all poses at which the six hinges are
within their limits, on the drawn branch, fill a volume within the stated bracket. Standard library only, and nothing of
the product: other formulas, other remainders, another share of a box under a plane, another integral.

**The set** is that of the rotations (psi_A, psi_B, psi_C) of the left leg's hinges, dx dy dphi = |a x b| dpsi_A dpsi_B
dpsi_C. Limits of A, B, C are faces of a box. For the right leg no angle is computed. Let v be the way from a leg's one
end to the other, l and m its links, u the place that the first link's far end has at a limit (turned by that limit from
where it was drawn), s = sign of the elbow (of l x m) times u x v. Of the two circles about +u and -u

    the first link is on the near side of the limit  <=>  k (m^2 - |v - u|^2) >= 0  where s >= 0,
                                                          k (|v + u|^2 - m^2) >= 0  where s <= 0,

k = +-1 by the limit's end and the elbow: on the circle's rim the second link closes the leg with the first one at the
limit, on one branch where s > 0, on the other where s < 0. F is this from the ground with v = D - F, and D is this from
the platform with v = F - D. E is in its limits where |D - F|^2 is between two lengths. So every limit is the squared
distance f = |Z - G|^2 of a point Z of the platform from one G of the ground, with the hinges P_A = A, P_B, P_C

    z_i = Z - P_i,  df/dpsi_i = 2 z_i x (Z - G),  d2f/dpsi_i dpsi_j = 2 (G - P_i).z_j  (i <= j),

and since f is a constant and six cosines of sums of psi, what is left after the second order is at most sum |u||v|
(sum of the half widths in the cosine)^3/3. Nothing here is singular where a leg is stretched.

**Rounding.** S is the sum of all lengths. Angles are below 24, so that turned vectors and Z - G err by less than 2^-45
of S, f by 2^-43 S^2, the first order, by half widths of together 10, by 2^-39 S^2, the second by 2^-37 S^2: counted is
2^-36 S^2 in all. A share of a box errs by less than 1e-14, counted is 1e-13; sums are exact (fsum), products and widths
count with 1e-12. Assumed are IEEE doubles and sin, cos, atan2 that err by less than two units in the last place."""
import math
from fractions import Fraction

from claims import Refused, number, vector

INSIDE, OUTSIDE, CUT, HALVED = "ioch"
DEEPEST = 30  # halvings: a box of 1e-9 of the limits that is still not what the tree says of it


def turned(v, angle):
    c, s = math.cos(angle), math.sin(angle)
    return c * v[0] - s * v[1], s * v[0] + c * v[1]


def cross(u, v):
    return u[0] * v[1] - u[1] * v[0]


def length(v):
    return math.hypot(v[0], v[1])


# ---- the share of a box under a plane ----

def trapezoid(y, p, q):
    """share of |x|, |z| <= 1 with p x + q z <= y; 0 <= p <= q, q > 0: sums of terms of one sign"""
    if p - q <= y <= q - p:
        return 0.5 + 0.5 * y / q
    edge = p + q - abs(y)
    corner = (edge / p) * (edge / q) * 0.125 if edge > 0.0 else 0.0
    return corner if y < 0.0 else 1.0 - corner


def share(p, q, r, t):
    """share of the cube |x_i| <= 1 with p x_1 + q x_2 + r x_3 <= t: the mean of the trapezoid's over the coordinate
    with the least coefficient. Between its four corners that is a parabola, so Simpson's rule has no error."""
    if p > q:
        p, q = q, p
    if q > r:
        q, r = r, q
    if p > q:
        p, q = q, p
    if t >= p + q + r:
        return 1.0
    if t <= -(p + q + r):
        return 0.0
    start, high, total = t - p, t + p, 0.0
    width, first = high - start, trapezoid(start, q, r)
    for corner in (-q - r, q - r, r - q, q + r, high):
        end = corner if corner < high else high
        if end > start:
            last = trapezoid(end, q, r)
            total += (end - start) * (first + 4.0 * trapezoid(0.5 * (start + end), q, r) + last)
            start, first = end, last
    return total / (6.0 * width) if width > 0.0 else first


def least(found):
    return max(share(*found) - 1e-13, 0.0) if isinstance(found, tuple) else found


def most(found):
    return min(share(*found) + 1e-13, 1.0) if isinstance(found, tuple) else found


# ---- one limit ----

class Distance:
    """k (limit - |Z - G|^2) >= 0 over a box of rotations; w: from C to Z as drawn"""

    def __init__(self, volume, w, ground, limit, k):
        self.volume, self.w, self.limit, self.k = volume, w, limit, k
        self.from_base = (volume.base[0] - ground[0], volume.base[1] - ground[1])
        self.rests = {}

    def rest(self, level):
        """what the third order leaves and rounding adds"""
        a, b, c = self.volume.half(level)
        n, la, lb, lw = length(self.from_base), self.volume.la, self.volume.lb, length(self.w)
        third = (n * (la * a ** 3 + lb * (a + b) ** 3 + lw * (a + b + c) ** 3)
                 + la * (lb * b ** 3 + lw * (b + c) ** 3) + lb * lw * c ** 3) / 3.0
        out = self.rests[level] = third * (1 + 1e-9) + self.volume.slack
        return out

    def look(self, at, level):
        """(True, False or None where it is not decided, least and largest share of the box where it holds)"""
        ha, hb, hc = at[0]
        wx, wy = self.w
        cos, sin = at[1]
        wx, wy = cos * wx - sin * wy, sin * wx + cos * wy
        bx, by, ax, ay = wx + at[2], wy + at[3], wx + at[4], wy + at[5]  # z_B, z_A; z_C is w
        yx, yy = ax + self.from_base[0], ay + self.from_base[1]
        pa = abs(ax * yy - ay * yx) * 2.0 * ha + 1e-40  # far below the slack; no share divides by nothing
        pb = abs(bx * yy - by * yx) * 2.0 * hb
        pc = abs(wx * yy - wy * yx) * 2.0 * hc
        ux, uy = bx - yx, by - yy  # G - P_B
        nx, ny = ax - yx, ay - yy  # G - P_A
        aa = (nx * ax + ny * ay) * ha * ha
        bb = (ux * bx + uy * by) * hb * hb
        cc = ((wx - yx) * wx + (wy - yy) * wy) * hc * hc
        rest = (self.rests.get(level) or self.rest(level)) + 2.0 * (
            abs(nx * bx + ny * by) * ha * hb + abs(nx * wx + ny * wy) * ha * hc + abs(ux * wx + uy * wy) * hb * hc)
        up = (aa if aa > 0 else 0.0) + (bb if bb > 0 else 0.0) + (cc if cc > 0 else 0.0) + rest
        down = (aa if aa < 0 else 0.0) + (bb if bb < 0 else 0.0) + (cc if cc < 0 else 0.0) - rest
        gap = self.limit - yx * yx - yy * yy
        low, high = (gap - up, gap - down) if self.k > 0 else (down - gap, up - gap)
        linear = (pa + pb + pc) * (1 + 1e-12)
        if low >= linear:
            return True, 1.0, 1.0
        if high < -linear:
            return False, 0.0, 0.0
        return None, (pa, pb, pc, low), (pa, pb, pc, high)


class Side:
    """the first link of a leg is on the near side of one of its limits: see above. Two distances, and where s >= 0"""

    def __init__(self, near, far, sign, lever, reach):
        self.near, self.far, self.sign, self.lever, self.reach = near, far, sign, lever, reach

    def look(self, at, level):
        """lever: u, `reach`: how fast v and u turn about each other with psi_A, psi_B, psi_C"""
        volume = self.near.volume
        ha, hb, hc = at[0]
        ra, rb, rc = self.reach
        s, spread = self.sign * self.lever(at), (ha * ra + hb * rb + hc * rc) * (1 + 1e-9) + volume.slack
        if s >= spread:
            return self.near.look(at, level)
        if s <= -spread:
            return self.far.look(at, level)
        one, other = self.near.look(at, level)[0], self.far.look(at, level)[0]
        if one is not None and one == other:
            return one, float(one), float(one)
        return None, 0.0, 1.0


class Either:
    """a range of more than half a turn: one of two sides is enough"""

    def __init__(self, sides):
        self.sides = sides

    def look(self, at, level):
        found = [side.look(at, level) for side in self.sides]
        if any(f[0] is True for f in found):
            return True, 1.0, 1.0
        if all(f[0] is False for f in found):
            return False, 0.0, 0.0
        return None, max(least(f[1]) for f in found), min(1.0, sum(most(f[2]) for f in found))


# ---- the volume ----

class Volume:
    def __init__(self, data, most):
        self.most, self.boxes, self.leaves = most, 0, 0
        mechanism = data["mechanism"]
        centre = vector(mechanism["centre_m"])
        left, right = ({k: vector(mechanism[side][k + "_m"]) for k in ("base", "first", "second", "platform")}
                       for side in ("left", "right"))
        for leg in (left, right):
            for i in range(2):  # the drawn pose is the rotations 0, 0, 0
                if abs(leg["base"][i] + leg["first"][i] + leg["second"][i] - centre[i] - leg["platform"][i]) > 1e-15:
                    raise Refused("the drawn leg does not close")
        self.start = [number(t) for t in mechanism["start_rad"]]
        self.limits = [tuple(number(t) for t in pair) for pair in data["limits_rad"]]
        self.box = [tuple(number(t) for t in pair) for pair in data["joint_box"]]
        self.claim = tuple(number(t) for t in data["m2_rad"])
        if (len(self.start), len(self.limits), len(self.box), len(self.claim)) != (6, 6, 3, 2):
            raise Refused("six hinges, three rotations, one bracket")
        if any(hi - lo >= 2 * math.pi - 1e-9 for lo, hi in self.limits + self.box):
            raise Refused("a range of a turn")
        if any(abs(v) > 8 for pair in self.box + self.limits + [self.start] for v in pair):
            raise Refused("an angle beyond a turn")
        self.tree, self.cut = data["tree"], []
        self.base, self.a, self.b = left["base"], left["first"], left["second"]
        self.p = tuple(d - c for c, d in zip(left["platform"], right["platform"]))
        self.la, self.lb = length(self.a), length(self.b)
        lengths = [self.la, self.lb, length(self.p), length(right["first"]), length(right["second"]),
                   length((self.base[0] - right["base"][0], self.base[1] - right["base"][1]))]
        self.slack = sum(lengths) ** 2 * 2.0 ** -36
        self.side = self.branch(self.a, self.b)
        self.halves, self.slices = {}, {}
        self.covered()
        self.conditions = self.of_right_leg(right["base"], right["first"], right["second"])

    def branch(self, a, b):
        if abs(cross(a, b)) <= self.slack:
            raise Refused("a leg is stretched or folded as drawn")
        return 1 if cross(a, b) > 0 else -1

    def range(self, hinge):
        """of psi: the joint angle less the drawn one, for D, E, F the other way round; exact"""
        low, high = (Fraction(v) - Fraction(self.start[hinge]) for v in self.limits[hinge])
        return (low, high) if hinge < 3 else (-high, -low)

    def covered(self):
        """The box has all rotations that the limits of A, B, C and the branch leave, and not more of them than rounding
        makes: by how much more, as a part of its volume, is `excess`"""
        self.empty, self.excess = False, 0.0
        elbow = math.atan2(cross(self.a, self.b), self.a[0] * self.b[0] + self.a[1] * self.b[1])
        for i, (lo, hi) in enumerate(self.box):
            low, high = self.range(i)
            if i == 1:  # elbow + psi between 0 and half a turn, on its side
                ends = (-elbow, math.pi - elbow) if self.side > 0 else (-math.pi - elbow, -elbow)
                low, high = max(low, Fraction(ends[0] - 4e-15)), min(high, Fraction(ends[1] + 4e-15))
            if low >= high:
                self.empty = True
                continue
            if Fraction(lo) > low or Fraction(hi) < high:
                raise Refused("the box leaves out what the limits of A, B, C allow")
            beyond = float((low - Fraction(lo)) + (Fraction(hi) - high)) / float(high - low)
            if beyond > 1e-9:
                raise Refused("the box is not that of the limits of A, B, C")
            self.excess += beyond + 1e-12

    def of_right_leg(self, base, a, b):
        sign, out = self.branch(a, b), []
        l2, m2, along, side = (a[0] ** 2 + a[1] ** 2, b[0] ** 2 + b[1] ** 2, a[0] * b[0] + a[1] * b[1], cross(a, b))
        elbow = math.atan2(side, along)
        # E: |elbow + psi| between 0 and half a turn; |D - F|^2 falls with it
        ends = sorted(sign * (elbow + float(psi)) for psi in self.range(4))
        if ends[1] <= 0 or ends[0] >= math.pi:
            self.empty = True
        reach2 = [l2 + m2 + 2 * math.sqrt(l2 * m2) * math.cos(min(max(e, 0.0), math.pi)) for e in ends]
        out.append(Distance(self, self.p, base, reach2[0], 1))
        out.append(Distance(self, self.p, base, reach2[1], -1))
        # F from the ground: D turns about it with the left leg's rotations
        arms = [self.la + self.lb + length(self.p), self.lb + length(self.p), length(self.p)]
        way = arms[0] + length((self.base[0] - base[0], self.base[1] - base[1]))
        sides = []
        for end, psi in zip((-1, 1), self.range(5)):
            u = turned(a, float(psi))
            near, far = ((base[0] + e * u[0], base[1] + e * u[1]) for e in (1, -1))

            def from_ground(at, u=u, base=base):
                return cross(u, (at[6] + at[7][0] - base[0], at[8] + at[7][1] - base[1]))
            sides.append(Side(Distance(self, self.p, near, m2, end * sign),
                              Distance(self, self.p, far, m2, -end * sign),
                              sign, from_ground, [math.sqrt(l2) * r for r in arms]))
        out += sides if self.range(5)[1] - self.range(5)[0] < math.pi else [Either(sides)]
        # D from the platform: the links the other way round, F turns about it
        sides = []
        for end, psi in zip((1, -1), self.range(3)):
            u = turned((-b[0], -b[1]), -float(psi))
            near, far = ((self.p[0] + e * u[0], self.p[1] + e * u[1]) for e in (1, -1))

            def from_platform(at, u=u, base=base):
                cos, sin = at[1]
                return cross((cos * u[0] - sin * u[1], sin * u[0] + cos * u[1]),
                             (base[0] - at[6] - at[7][0], base[1] - at[8] - at[7][1]))
            sides.append(Side(Distance(self, near, base, l2, -end * sign),
                              Distance(self, far, base, l2, end * sign),
                              -sign, from_platform, [math.sqrt(m2) * (r + way) for r in arms]))
        out += sides if self.range(3)[1] - self.range(3)[0] < math.pi else [Either(sides)]
        return out

    def half(self, level):
        out = self.halves[level] = [0.5 * (hi - lo) / 2 ** level for lo, hi in self.box]
        return out

    def middle(self, place, level):
        """what all limits need of a box: half widths, the platform's turn, C and B's links, C"""
        (i, j, k), part, box = place, 2.0 ** -(level + 1), self.box
        t1 = box[0][0] + (box[0][1] - box[0][0]) * ((2 * i + 1) * part)
        t2 = box[1][0] + (box[1][1] - box[1][0]) * ((2 * j + 1) * part) + t1
        t3 = box[2][0] + (box[2][1] - box[2][0]) * ((2 * k + 1) * part) + t2
        c, s = math.cos(t1), math.sin(t1)
        ax, ay = c * self.a[0] - s * self.a[1], s * self.a[0] + c * self.a[1]
        c, s = math.cos(t2), math.sin(t2)
        bx, by = c * self.b[0] - s * self.b[1], s * self.b[0] + c * self.b[1]
        c, s = math.cos(t3), math.sin(t3)
        platform = (c * self.p[0] - s * self.p[1], s * self.p[0] + c * self.p[1])
        return (self.halves.get(level) or self.half(level), (c, s), bx, by, ax + bx, ay + by,
                self.base[0] + ax + bx, platform, self.base[1] + ay + by)

    def slice(self, i, level):
        """of a box's range of B: integral of |a x b| = -d(a.b)/dpsi and what it errs by, least and largest |a x b|"""
        if (i, level) not in self.slices:
            lo, hi = self.box[1]
            ends = [turned(self.b, lo + (hi - lo) * (n * 2.0 ** -level)) for n in (i, i + 1)]
            along = [self.a[0] * b[0] + self.a[1] * b[1] for b in ends]
            over = [self.side * cross(self.a, b) for b in ends]
            error = self.la * self.lb * 2.0 ** -48
            most = max(over) if along[0] * along[1] > 0 else self.la * self.lb
            self.slices[i, level] = (max(self.side * (along[0] - along[1]), 0.0), error * (1 + 1e-3),
                                     max(min(over) - error, 0.0), most + error)
        return self.slices[i, level]

    def judged(self, place, level, conditions):
        """INSIDE, OUTSIDE or CUT; what is not decided of the box; and how"""
        self.boxes += 1
        at, still, how = self.middle(place, level), [], []
        for condition in conditions:
            found = condition.look(at, level)
            if found[0] is False:
                return OUTSIDE, (), ()
            if found[0] is None:
                still.append(condition)
                how.append(found)
        return (CUT if still else INSIDE), still, how

    def keep(self, place, level, still, how):
        """a box that is cut: its part of the volume between these"""
        some = max(1.0 - sum(1.0 - least(low) for _, low, _ in how), 0.0)
        all_ = min(most(high) for _, _, high in how)
        whole, error, thin, thick = self.slice(place[1], level)
        ha, hb, hc = (2.0 * h for h in self.half(level))
        low = max(thin * hb * some, whole - error - thick * hb * (1.0 - some), 0.0)
        high = min(thick * hb * all_, whole + error - thin * hb * (1.0 - all_))
        self.cut.append((ha * hc * low, ha * hc * max(high, low), place, level, still))

    def count(self, place, level):
        whole, error = self.slice(place[1], level)[:2]
        ha, _, hc = (2.0 * h for h in self.half(level))
        self.inside.append(ha * hc * whole)
        self.errors += ha * hc * error

    def must(self, said, place, level, conditions):
        """a leaf is inside or outside as the tree says; halved where it is not seen at once"""
        found, still, _ = self.judged(place, level, conditions)
        if found == said:
            if said == INSIDE:
                self.count(place, level)
            return
        if found != CUT or level >= DEEPEST or self.boxes > self.most:
            raise Refused("a box is not %sside" % ("in" if said == INSIDE else "out"))
        for part in parts(place):
            self.must(said, part, level + 1, still)

    def whole(self):
        """every box of the tree is a leaf or has eight parts, nothing is left out"""
        missing = 1
        for n, c in enumerate(self.tree):
            if c not in (INSIDE, OUTSIDE, CUT, HALVED):
                raise Refused("the tree has a node of no kind")
            missing += 7 if c == HALVED else -1
            if missing == 0 and n + 1 < len(self.tree):
                raise Refused("the tree has too many nodes")
        if missing:
            raise Refused("the tree leaves a part of the box out")

    def walk(self):
        """every leaf of the tree is what the tree says of it"""
        self.whole()
        self.inside, self.errors = [], 0.0
        stack = [((0, 0, 0), 0, self.conditions)]
        for c in self.tree:
            place, level, conditions = stack.pop()
            if c == HALVED:
                # nothing is believed of a box that is halved; what is decided of it saves work below
                found, still, _ = self.judged(place, level, conditions)
                if found == OUTSIDE:
                    still = conditions
                stack += [(part, level + 1, still) for part in reversed(list(parts(place)))]
                continue
            self.leaves += 1
            if c == CUT:
                self.either(place, level, conditions)
            else:
                self.must(c, place, level, conditions)

    def either(self, place, level, conditions):
        found, still, how = self.judged(place, level, conditions)
        if found == INSIDE:
            self.count(place, level)
        elif found == CUT:
            self.keep(place, level, still, how)

    def bracket(self):
        inside = math.fsum(self.inside)
        low = inside - self.errors + math.fsum(c[0] for c in self.cut)
        high = inside + self.errors + math.fsum(c[1] for c in self.cut)
        (alo, ahi), (blo, bhi), (clo, chi) = self.box
        whole = (ahi - alo) * (bhi - blo) * (chi - clo) * self.la * self.lb
        return max(low * (1 - 1e-12) - whole * self.excess, 0.0), high * (1 + 1e-12)

    def against(self, claim):
        """The own bracket lies in the claim. Until it does, the cut boxes that leave most open are halved further."""
        while True:
            low, high = self.bracket()
            if claim[0] <= low and high <= claim[1]:
                return low, high
            if low > claim[1] or high < claim[0] or not claim[0] <= claim[1]:
                raise Refused("the volume is between %.9g and %.9g m2 rad" % (low, high))
            if self.boxes > self.most or not self.cut:
                raise Refused("proved is only that the volume is between %.9g and %.9g m2 rad" % (low, high))
            self.cut.sort(key=lambda c: c[1] - c[0])
            again, self.cut = self.cut[-(len(self.cut) // 4 + 1):], self.cut[:-(len(self.cut) // 4 + 1)]
            for _, _, place, level, still in again:
                for part in parts(place):
                    self.either(part, level + 1, still)


def parts(place):
    a, b, c = (2 * i for i in place)
    for n in range(8):
        yield a + (n & 1), b + (n >> 1 & 1), c + (n >> 2)


def check(data, most):
    """what proved it and the own bracket; Refused where the volume is not proved to lie in the claim"""
    volume = Volume(data, most + 4 * len(data["tree"]))
    if volume.empty:
        if not volume.claim[0] <= 0.0 <= volume.claim[1]:
            raise Refused("the limits leave nothing")
        return volume, (0.0, 0.0)
    volume.walk()
    return volume, volume.against(volume.claim)
