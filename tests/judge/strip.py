# SPDX-License-Identifier: GPL-3.0-or-later
"""What a flexure of a device file is for the judge: its centre line, its sections, its roots. Nothing here is read from
the program that is judged; formulas and tables are named where they stand. Units um, uN, MPa."""
import math

# Concentration of tension at a root with fillet rho in a wide block, by rho/t: plane stress, by tension.py; from 0.2 down
# lowered by what the same mesh has too much in bending against the table of finer solids (2 %).
TENSION = ((0.05, 3.64), (0.1, 2.72), (0.2, 2.08), (0.35, 1.71), (0.5, 1.53), (0.75, 1.36), (1.0, 1.27))

# Least squares over 197 solids of tests/data/hinge/root_strain.csv (isotropic, rho/t 0.1 to 1.05, h/t 1 to 12): their peak
# strain per radian over Kt (1 + t/3r) t/2 (L + 2 dL), less 1, with Kt of plane stress; rms 0.56 %, largest 1.8 %. The file
# has what solids gave, not what the program's formula makes of them; that formula is a bound from above, this is not.
SOLID = (0.02855516205488328, -1.0737488380665015, 0.6523633503234405, 1.6418319025659949, 0.8082713293779616,
         -1.022453844742767, -0.17006207541829443, -0.4039397363878164, 1.0150954741117886, 3.5202442050434337,
         -0.229232608445042, 0.0026351444026185833, -0.07517024873449059, 0.5676914371281725)


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


def depth(h, nu, radius, t):
    """(f, D, inner, outer): cylindrical strip with free edges; a straight strip has D = 1"""
    if math.isinf(radius):
        return 1.0, 1.0, 1.0, 1.0
    big = (3 * (1 - nu * nu)) ** 0.25 / math.sqrt(radius * t)
    x = big * h
    f = 2 / x * (math.cosh(x) - math.cos(x)) / (math.sinh(x) + math.sin(x))
    s, c, sh, ch = math.sin(x / 2), math.cos(x / 2), math.sinh(x / 2), math.cosh(x / 2)
    below = s * c + sh * ch
    c1 = nu * (sh * c - ch * s) / (2 * big * big * below)
    c2 = nu * (ch * s + sh * c) / (2 * big * big * below)
    inner = 1 - c1 / (radius * t / 2)
    outer = 1 + (c1 * ch * c + c2 * sh * s) / (radius * t / 2)
    return f, (1 - nu * nu * f) / (1 - nu * nu), inner, outer


def bend(x, h, t, nu, radius):
    """peak of stress (modulus times strain) over M t/(2 I) at a root, on the inner and on the outer face"""
    f, stiff, _, _ = depth(h, nu, radius, t)
    w = 0.0 if math.isinf(radius) else t / (3 * radius)
    n, p, q = nu * f, h / (h + 4 * t), x ** (-2 / 3)
    terms = (1, n * p, n * p * p, n * p ** 3, nu * p * p * q, nu * p ** 3 * q, nu * p * p * x, w, w * p, w * n * x, w * q, x,
             nu * p * p, w * n)
    k = (0.944 + 0.2113 * q) * (1 + sum(a * b for a, b in zip(SOLID, terms))) / stiff
    return k * (1 + w), k * (1 - w)


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

    def __init__(self, pieces, modulus, nu, h, fillet):
        self.pieces, self.modulus, self.nu, self.h, self.fillet = pieces, modulus, nu, h, fillet
        self.place()
        if self.centre < -1e-6:  # walked from its other end
            self.pieces = [Piece(p.length, -p.curvature, *p.widths[::-1]) for p in pieces[::-1]]
            self.place()

    def stiffness(self, piece, t):
        i = self.h * t ** 3 / 12
        return self.modulus * i * depth(self.h, self.nu, piece.radius, t)[1]

    def rows(self, piece, turned):
        """(steps, length of one, rows of sections at every half step)"""
        n = max(24, int(math.degrees(abs(piece.curvature) * piece.length) / 4) + 1, int(piece.length / 10) + 1)
        n = min(n, 80)
        out = []
        for i in range(2 * n + 1):
            share = i / (2 * n)
            t = piece.width(share)
            _, stiff, inner, outer = depth(self.h, self.nu, piece.radius, t)
            w = 0.0 if math.isinf(piece.radius) else t / (3 * piece.radius)
            z = self.h * t * t / 6
            faces = ((1 + w) * inner / stiff / z, (1 - w) * outer / stiff / z)
            left, right = faces if piece.curvature >= 0 else faces[::-1]
            out.append((turned + piece.curvature * share * piece.length, self.stiffness(piece, t),
                        self.modulus * self.h * t, 5 / 6 * self.modulus / (2 * (1 + self.nu)) * self.h * t, self.h * t,
                        left, right))
        return n, piece.length / n, out

    def root(self, piece, share):
        t = piece.width(share)
        inner, outer = (k / (self.h * t * t / 6) for k in bend(self.fillet / t, self.h, t, self.nu, piece.radius))
        left, right = (inner, outer) if piece.curvature >= 0 else (outer, inner)
        return (root_length(t, self.fillet) / self.stiffness(piece, t), left, right,
                tension(self.fillet / t) / (self.h * t))

    def place(self):
        """spans, and the frame: ends on the y axis, the centre of elastic weights on the x axis at x >= 0"""
        x = y = turned = 0.0
        weight = wx = wy = 0.0
        self.spans = []

        def add(w, px, py):
            nonlocal weight, wx, wy
            weight, wx, wy = weight + w, wx + w * px, wy + w * py

        first, last = self.pieces[0], self.pieces[-1]
        add(root_length(first.width(0), self.fillet) / self.stiffness(first, first.width(0)), 0, 0)
        for piece in self.pieces:
            n, step, rows = self.rows(piece, turned)
            self.spans.append((n, step, rows))
            many = 400
            for i in range(many):
                share = (i + 0.5) / many
                k, s = piece.curvature, share * piece.length
                angle = turned + k * s
                px = x + (s * math.cos(turned) if k == 0 else (math.sin(angle) - math.sin(turned)) / k)
                py = y + (s * math.sin(turned) if k == 0 else (math.cos(turned) - math.cos(angle)) / k)
                t = piece.width(share)
                bracket = 1.0
                if k:  # neutral line, and Golovin's exact stiffness
                    u = t / (2 * piece.radius)
                    off = piece.radius * (1 - u / math.atanh(u)) * (1 if k > 0 else -1)
                    px, py = px - math.sin(angle) * off, py + math.cos(angle) * off
                    bracket = 1 - 2 / 15 * u * u - u ** 4 / 21
                add(piece.length / many / (self.stiffness(piece, t) * bracket), px, py)
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
        self.roots = (self.root(first, 0), self.root(last, 1))

    def model(self, a, b, at, axis):
        """lines of the judge's model for a hinge with W at `at` and its axis (rad) from x"""
        c, s = math.cos(axis), math.sin(axis)
        x, y = at[0] + c * self.start[0] - s * self.start[1], at[1] + s * self.start[0] + c * self.start[1]
        out = ["flexure %d %d %d" % (a, b, len(self.spans)),
               " %.15g %.15g %.15g" % (x, y, axis + self.direction)]
        out += [" %.15g %.15g %.15g %.15g" % root for root in self.roots]
        for n, step, rows in self.spans:
            out.append(" %d %.15g" % (n, step))
            out += [" %.12g %.12g %.12g %.12g %.12g %.12g %.12g" % row for row in rows]
        return "\n".join(out) + "\n"


def leaf(length, width, middle=None):
    return [Piece(length, 0.0, width, middle or width, width)]


def csfh(radius, angle, width, middle=None):
    return [Piece(radius * angle, 1 / radius, width, middle or width, width)]
