# SPDX-License-Identifier: GPL-3.0-or-later
"""What a flexure of a device file is for the judge: its centre line, its sections, its roots. Nothing here is read from
the program that is judged; formulas and tables are named where they stand. Units um, uN, MPa."""
import math

# Concentration of tension at a root with fillet rho in a wide block, by rho/t: plane stress, by tension.py; from 0.2 down
# lowered by what the same mesh has too much in bending against the table of finer solids (2 %).
TENSION = ((0.05, 3.64), (0.1, 2.72), (0.2, 2.08), (0.35, 1.71), (0.5, 1.53), (0.75, 1.36), (1.0, 1.27))

# Least squares over 321 isotropic solids of tests/data/hinge/root_strain*.csv (rho/t 0.1 to 1.05, h/t 1 to 12): their peak strain per
# radian over Kt (1 + t/3r) t/2 (L + 2 dL), with Kt of plane stress, as a sum of products; a row is a factor and the powers of ln(rho/t),
# h/(h + 4 t), nu, n, 20 t/3r. rms 0.11 %, largest 0.44 %, of a solid that is left out 0.14 and 0.63 %. The files have what solids gave,
# not what the program's formula makes of them; that formula is a bound from above, this is not.
SOLID = (
    (0.988407, 0, 0, 0, 0, 0), (-0.0196875, 0, 3, 0, 0, 0), (-0.23476, 2, 2, 0, 1, 0), (0.760249, 0, 3, 0, 1, 1), (-0.139219,
    1, 1, 1, 0, 1), (0.152913, 0, 0, 2, 2, 0), (-6.27554, 0, 4, 0, 1, 0), (-0.145135, 1, 1, 0, 0, 0), (-0.0373343, 0, 1, 2,
    1, 0), (0.164061, 2, 3, 0, 0, 0), (-0.0912538, 1, 0, 0, 1, 0), (0.0361629, 1, 1, 0, 0, 1), (-0.217082, 2, 2, 0, 0, 0),
    (-0.685616, 1, 2, 1, 1, 0), (0.0181233, 0, 0, 0, 0, 1), (-0.21516, 0, 2, 0, 1, 2), (0.208459, 1, 0, 1, 0, 1),
    (7.76992e-05, 0, 1, 0, 0, 1), (-0.845709, 0, 3, 1, 1, 0), (-4.84241, 1, 2, 0, 1, 0), (0.447988, 1, 3, 1, 0, 0),
    (-0.0168737, 3, 2, 0, 0, 0), (0.1834, 1, 0, 1, 2, 0), (-0.164071, 1, 0, 1, 0, 0), (-0.0861356, 2, 0, 1, 1, 0), (1.99952,
    1, 1, 0, 1, 0), (3.22907, 1, 3, 0, 1, 0), (0.0940726, 1, 2, 1, 0, 1), (-0.887802, 0, 1, 0, 2, 0), (0.011915, 2, 2, 0, 0,
    1), (-0.236215, 1, 0, 2, 0, 2), (0.0893935, 2, 0, 0, 2, 1), (12.3014, 0, 3, 0, 1, 0), (0.0942737, 0, 0, 0, 1, 1),
    (-6.16968, 0, 2, 0, 1, 0), (1.06868, 0, 1, 0, 1, 0), (-0.158071, 0, 0, 2, 0, 2), (0.1134, 1, 2, 0, 0, 0), (0.194792, 2,
    1, 0, 1, 0), (0.0316821, 1, 0, 0, 0, 0), (-0.0034296, 4, 1, 0, 0, 0), (0.0641105, 2, 1, 0, 0, 0))

# The same of stress in leaves of silicon, 139 solids, rms 0.17 %, largest 0.51 % (left out 0.22 and 0.64 %): powers of ln(rho/t),
# h/(h + 4 t), cosine and |sine| of four times the direction of the root.
CRYSTAL = (
    (1.0936, 0, 0, 0, 0), (-0.0335757, 1, 1, 0, 1), (1.64539, 0, 2, 0, 0), (-0.0864465, 0, 0, 1, 0), (0.0123693, 2, 1, 2, 0),
    (0.0817491, 0, 0, 0, 1), (-0.0250382, 3, 0, 1, 0), (0.0190104, 1, 0, 0, 0), (0.231941, 0, 3, 1, 0), (-0.0661098, 1, 0, 0,
    1), (-0.00691511, 4, 0, 1, 0), (0.0142092, 1, 0, 1, 0), (-0.00846695, 2, 0, 2, 1), (-0.100891, 2, 3, 0, 0), (0.250867, 0,
    1, 1, 0), (-0.669489, 0, 1, 0, 0), (-0.856625, 0, 3, 0, 0), (-0.0116279, 4, 1, 0, 0), (-0.00529116, 3, 1, 0, 0),
    (-0.47545, 0, 2, 1, 0), (-0.0217921, 0, 1, 2, 0), (-0.108272, 1, 1, 0, 0), (0.0781541, 1, 3, 0, 0), (0.0134324, 2, 0, 2,
    0), (-0.0428421, 3, 2, 0, 0), (0.00881449, 2, 0, 0, 0))


def tension(x):
    x = min(max(x, TENSION[0][0]), TENSION[-1][0])
    for (x0, k0), (x1, k1) in zip(TENSION, TENSION[1:]):
        if x <= x1:  # straight in the logarithms
            return math.exp(math.log(k0) + math.log(k1 / k0) * math.log(x / x0) / math.log(x1 / x0))
    return TENSION[-1][1]


def root_length(t, rho):
    """strip that is as soft as a filleted root: own finite elements, rho/t from 0.05 to 1"""
    x = min(max(rho / t, 0.05), 1)
    return t * (0.4192 - 0.5972 * x - 0.1167 * x * x)


class Isotropic:
    crystal = False

    def __init__(self, modulus, nu):
        self.mean, self.nu = modulus, nu

    def at(self, psi):
        """modulus, shear modulus, number of Poisson across the depth, modulus over that across the depth"""
        return self.mean, self.mean / (2 * (1 + self.nu)), self.nu, 1.0


class Silicon:
    """(100) wafer with [100] at an angle from x; constants as in processes/base.xml"""

    crystal = True

    def __init__(self, first):
        c11, c12, c44 = 165.7e3, 63.9e3, 79.6e3
        below = (c11 - c12) * (c11 + 2 * c12)
        self.s11, self.s12, self.s44 = (c11 + c12) / below, -c12 / below, 1 / c44
        self.s0 = self.s11 - self.s12 - self.s44 / 2
        self.a0, self.a1, self.first = self.s11 - self.s0 / 4, self.s0 / 4, first
        self.mean, self.nu = 1 / self.a0, 0.31

    def at(self, psi):
        c = math.cos(4 * (psi - self.first))
        e = 1 / (self.a0 + self.a1 * c)
        return e, 1 / (self.s44 + self.s0 * (1 - c)), math.sqrt(self.s12 ** 2 * e / self.s11), e * self.s11


def depth(h, nu, radius, t, stretch=1.0):
    """(f, D, inner, outer): cylindrical strip with free edges; a straight strip has D = 1. stretch: of an orthotropic strip"""
    if math.isinf(radius):
        return 1.0, 1.0, 1.0, 1.0
    big = (3 * (1 - nu * nu) * stretch) ** 0.25 / math.sqrt(radius * t)
    x = big * h
    f = 2 / x * (math.cosh(x) - math.cos(x)) / (math.sinh(x) + math.sin(x))
    s, c, sh, ch = math.sin(x / 2), math.cos(x / 2), math.sinh(x / 2), math.cosh(x / 2)
    below = s * c + sh * ch
    c1 = nu * (sh * c - ch * s) / (2 * big * big * below)
    c2 = nu * (ch * s + sh * c) / (2 * big * big * below)
    inner = 1 - c1 / (radius * t / 2)
    outer = 1 + (c1 * ch * c + c2 * sh * s) / (radius * t / 2)
    return f, (1 - nu * nu * f) / (1 - nu * nu), inner, outer


def products(table, *values):
    return sum(row[0] * math.prod(v ** k for v, k in zip(values, row[1:])) for row in table)


def bend(x, h, t, nu, n, w):
    """peak of stress (modulus times strain) at a root over (1 +- w) M t/(2 I D); n = nu f, w = t/(3 r)"""
    return (0.944 + 0.2113 * x ** (-2 / 3)) * products(SOLID, math.log(x), h / (h + 4 * t), nu, n, 20 * w)


def bend_crystal(x, h, t, n, w, psi):
    """the same of silicon's stress; psi: direction of the root's tangent from [100]"""
    return (0.944 + 0.2113 * x ** (-2 / 3)) * products(CRYSTAL, math.log(x), h / (h + 4 * t), math.cos(4 * psi), abs(math.sin(4 * psi)))


def circle(points):
    """centre and radius through three points, None where they are in line"""
    (x1, y1), (x2, y2), (x3, y3) = points
    d = 2 * (x1 * (y2 - y3) + x2 * (y3 - y1) + x3 * (y1 - y2))
    if abs(d) < 1e-9 * ((x3 - x1) ** 2 + (y3 - y1) ** 2):
        return None
    a, b, c = x1 * x1 + y1 * y1, x2 * x2 + y2 * y2, x3 * x3 + y3 * y3
    x = (a * (y2 - y3) + b * (y3 - y1) + c * (y1 - y2)) / d
    y = (a * (x3 - x2) + b * (x1 - x3) + c * (x2 - x1)) / d
    return x, y, math.hypot(x1 - x, y1 - y)


class Piece:
    """a line (radius inf) or an arc of the centre line; each edge is one circle through start, middle and end"""

    def __init__(self, length, curvature, start, middle, end):
        self.length, self.curvature, self.widths = length, curvature, (start, middle, end)
        self.even = start == middle == end
        self.radius = math.inf if curvature == 0 else 1 / abs(curvature)

    def edge(self, side, share):
        """distance of an edge from the centre line on its normal; side 1: outside of the arc"""
        t0, t1, t2 = (side * w / 2 for w in self.widths)
        if math.isinf(self.radius):
            found = circle(((0, t0), (self.length / 2, t1), (self.length, t2)))
            s = share * self.length
            if not found:
                return t0 + (t2 - t0) * share
            x, y, r = found
            root = math.sqrt(r * r - (s - x) ** 2)
            return y + root if abs(y + root - t1) < abs(y - root - t1) else y - root
        angle = self.length / self.radius
        at = [(self.radius + t, k * angle / 2) for t, k in ((t0, 0), (t1, 1), (t2, 2))]
        found = circle([(r * math.cos(b), r * math.sin(b)) for r, b in at])
        if not found:
            return t0 + (t2 - t0) * share
        x, y, r = found
        b = share * angle
        along = x * math.cos(b) + y * math.sin(b)
        root = math.sqrt(r * r - (x * x + y * y - along * along))
        return min((along + root, along - root), key=lambda v: abs(v - self.radius - t1)) - self.radius

    def width(self, share):
        return self.widths[0] if self.even else self.edge(1, share) - self.edge(-1, share)


class Strip:
    """pieces in their order, of a material (modulus, nu) and a depth, with a fillet at either root"""

    def __init__(self, pieces, material, h, fillet):
        self.pieces, self.material, self.h, self.fillet = pieces, material, h, fillet
        self.place()
        if self.centre < -1e-6:  # walked from its other end
            self.pieces = [Piece(p.length, -p.curvature, *p.widths[::-1]) for p in pieces[::-1]]
            self.place()

    def stiffness(self, piece, t):
        """of the uniform material that the drawing has its centre from"""
        return self.material.mean * self.h * t ** 3 / 12 * depth(self.h, self.material.nu, piece.radius, t)[1]

    @staticmethod
    def bracket(piece, t):
        """Golovin's exact stiffness of an arc over that of the straight strip"""
        u = t / (2 * piece.radius)
        return 1 - 2 / 15 * u * u - u ** 4 / 21

    def held(self):
        """of a crystal: (what either end takes off 1/E at its face, way over which that fades). The block holds the end straight that
        would bow across; least energy of a bow that comes back as exp(-s/far). Where a force bends the strip its moment has
        fallen there, so that this is no shorter strip: stiffness of guided leaves as solids within 0.6 % (self_test.py), as
        shorter strips 1.3 % above them"""
        if not self.material.crystal:
            return []
        m, out, length = self.material, [], sum(p.length for p in self.pieces)
        for piece, share in ((self.pieces[0], 0), (self.pieces[-1], 1)):
            t = piece.width(share)
            f = depth(self.h, m.nu, piece.radius, t)[0]
            far = min(self.h * f * math.sqrt(m.s11 / (3 * m.s44)), length / 3)
            out.append((m.s12 ** 2 / m.s11 * f * far / (far + 0.4192 * t), far))
        return out

    def rows(self, piece, turned, world, before, length):
        """(steps, length of one, rows of sections at every half step); world: direction of the strip's start; before: strip up to
        the piece, of length in all"""
        held = self.held()
        n = min(48, max(16, int(math.degrees(abs(piece.curvature) * piece.length) / 6) + 1, int(piece.length / 20) + 1))
        out = []
        for i in range(2 * n + 1):
            share = i / (2 * n)
            t = piece.width(share)
            psi = turned + piece.curvature * share * piece.length
            e, g, nu, ratio = self.material.at(world + psi)
            _, stiff, inner, outer = depth(self.h, nu, piece.radius, t, ratio)
            at = before + share * piece.length
            bent = 1 / (1 / e - sum(less * math.exp(-s / far) for (less, far), s in zip(held, (at, length - at))))
            w = 0.0 if math.isinf(piece.radius) else t / (3 * piece.radius)
            z = self.h * t * t / 6
            faces = ((1 + w) * inner / stiff / z, (1 - w) * outer / stiff / z)
            left, right = faces if piece.curvature >= 0 else faces[::-1]
            out.append((psi, bent * self.h * t ** 3 / 12 * stiff * self.bracket(piece, t), e * self.h * t, 5 / 6 * g * self.h * t, self.h * t, left, right))
        return n, piece.length / n, out

    def root(self, piece, share, psi):
        t, x, m = piece.width(share), self.fillet / piece.width(share), self.material
        e, _, nu, ratio = m.at(psi)
        f, stiff, _, _ = depth(self.h, nu, piece.radius, t, ratio)
        inertia = self.h * t ** 3 / 12
        give = root_length(t, self.fillet) / (e * inertia * stiff)
        if m.crystal:  # the block gives with the mean
            give += 0.4192 * t * (m.a0 - 1 / e) / (inertia * stiff)
        w = 0.0 if math.isinf(piece.radius) else t / (3 * piece.radius)
        inner, outer = (k / (self.h * t * t / 6) / stiff * (1 + s * w) for s, k in zip(
            (1, -1), (bend_crystal(x, self.h, t, nu * f, w, psi - m.first) if m.crystal else
                      bend(x, self.h, t, nu, nu * f, w),) * 2))
        left, right = (inner, outer) if piece.curvature >= 0 else (outer, inner)
        return give, left, right, tension(x) / (self.h * t)

    def place(self):
        """spans, and the frame: ends on the y axis, the centre of elastic weights on the x axis at x >= 0"""
        x = y = turned = 0.0
        weight = wx = wy = 0.0
        def add(w, px, py):
            nonlocal weight, wx, wy
            weight, wx, wy = weight + w, wx + w * px, wy + w * py

        first, last = self.pieces[0], self.pieces[-1]
        add(root_length(first.width(0), self.fillet) / self.stiffness(first, first.width(0)), 0, 0)
        for piece in self.pieces:
            many = 400
            for i in range(many):
                share = (i + 0.5) / many
                k, s = piece.curvature, share * piece.length
                angle = turned + k * s
                px = x + (s * math.cos(turned) if k == 0 else (math.sin(angle) - math.sin(turned)) / k)
                py = y + (s * math.sin(turned) if k == 0 else (math.cos(turned) - math.cos(angle)) / k)
                t = piece.width(share)
                if k:  # neutral line
                    u = t / (2 * piece.radius)
                    off = piece.radius * (1 - u / math.atanh(u)) * (1 if k > 0 else -1)
                    px, py = px - math.sin(angle) * off, py + math.cos(angle) * off
                add(piece.length / many / (self.stiffness(piece, t) * self.bracket(piece, t)), px, py)
            k, s = piece.curvature, piece.length
            x += s * math.cos(turned) if k == 0 else (math.sin(turned + k * s) - math.sin(turned)) / k
            y += s * math.sin(turned) if k == 0 else (math.cos(turned) - math.cos(turned + k * s)) / k
            turned += k * s
        add(root_length(last.width(1), self.fillet) / self.stiffness(last, last.width(1)), x, y)
        self.stiff = 1 / weight
        cx, cy = wx / weight, wy / weight
        # the chord from the first end to the last becomes +y of the frame
        chord = math.atan2(y, x) if math.hypot(x, y) > 1e-6 else math.pi / 2
        rotate = math.pi / 2 - chord
        c, s = math.cos(rotate), math.sin(rotate)
        wx, wy = c * cx - s * cy, s * cx + c * cy
        self.direction, self.centre = rotate, wx
        self.start = (-wx, -wy)  # as seen from W

    def model(self, a, b, at, axis):
        """lines of the judge's model for a hinge with W at `at` and its axis (rad) from x"""
        c, s, world, turned, spans = math.cos(axis), math.sin(axis), axis + self.direction, 0.0, []
        before, length = 0.0, sum(p.length for p in self.pieces)
        for piece in self.pieces:
            spans.append(self.rows(piece, turned, world, before, length))
            before += piece.length
            turned += piece.curvature * piece.length
        roots = self.root(self.pieces[0], 0, world), self.root(self.pieces[-1], 1, world + turned)
        x, y = at[0] + c * self.start[0] - s * self.start[1], at[1] + s * self.start[0] + c * self.start[1]
        out = ["flexure %d %d %d" % (a, b, len(spans)), " %.15g %.15g %.15g" % (x, y, world)]
        out += [" %.15g %.15g %.15g %.15g" % root for root in roots]
        for n, step, rows in spans:
            out.append(" %d %.15g" % (n, step))
            out += [" %.12g %.12g %.12g %.12g %.12g %.12g %.12g" % row for row in rows]
        return "\n".join(out) + "\n"


def leaf(length, width, middle=None):
    return [Piece(length, 0.0, width, middle or width, width)]


def csfh(radius, angle, width, middle=None):
    return [Piece(radius * angle, 1 / radius, width, middle or width, width)]
