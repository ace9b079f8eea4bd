# SPDX-License-Identifier: GPL-3.0-or-later
"""The laws that are fitted, docs/theory/root-strain.md (11a) and docs/theory/flexure-silicon.md (14), and Chebyshev fits of their constants.

What is fitted is G, the solid's strain per moment over Kt times that of the beam (isotropic: times 1 + u): no row may come out
below 1 + margin, and the highest above its own `slack` be as low as it can be. slack: 0 within the range of the narrow band
(`inside`), 0.02 beyond it (silicon 0.03). The moment is that of the closed form with what the ends lose (13a).

Within the range of the narrow band there are laws of their own (class Narrow): G a sum of terms, each the powers of

    z = 2 ln(x/0.1)/ln 12.5 - 1, p = 2 (h/(h + 4 t) - 1/9)/(10/14 - 1/9) - 1 (-1 to 1 over the range), nu, n = nu f,
    u = sqrt(20 t/3R), and c, s = cosine and sine of four times the direction from [100] (class Narrow).

Beyond it G goes as a former law does, below, whose terms are the powers of x, q, p, nu, n, u, c, s. An isotropic G is a sum of terms; one of silicon the product of a sum (what the
direction does) and 1 + a sum (what the depth does), the larger of either fillet of either root."""
import itertools
import math

import numpy as np
from scipy.optimize import linprog

NAMES = ("x", "q", "p", "nu", "n", "u", "c", "s")
FLAT, DEEP = 1 / 9, 10 / 14  # h/(h + 4 t) of h = t/2 and 10 t
SHIFT = 1.35  # fillet radii before the root where the crystal's direction counts
SILICON_REACH = 0.31990  # sqrt(s11/(3 s44)), as fw_flexure_crystal.reach


def powers(text):
    """'x2 p n2' as a tuple of powers"""
    found = dict.fromkeys(NAMES, 0)
    for word in text.split():
        name = word.rstrip("0123456789")
        found[name] = int(word[len(name):] or 1)
    return tuple(found[n] for n in NAMES)


ISOTROPIC = ("", "p3", "x2 p n2 u", "x p3", "p4", "p", "x p4", "q u2", "p n2", "p3 n", "x u", "q2", "x p4 n u", "x2 p2 n2 u", "q p2 n2",
             "q2 p3 n2 u2", "x p3 nu u", "q2 p nu2 u")
DIRECTION = ("", "x", "q", "c", "x c", "q c", "s", "x s", "q s", "q2", "q2 s")
LEVEL = ("p3 n", "p n", "x p2 nu", "x p3 nu", "p2 n", "x p c")
ARC_DIRECTION = DIRECTION + ("s u", "q s c", "s c", "x2 c")
ARC_LEVEL = LEVEL[:4] + ("q u", "p2 n", "p u", "x n u", "n u", "q n u", "p2 c n", "x p u", "x p2 n", "p2 n2", "p c n", "p2 c")


class Rows:
    """columns of one kind and material: numpy arrays by the names of the powers, and what is asked of each row"""

    def __init__(self, rows, margin):
        def column(name):
            return np.array([float(r[name]) for r in rows])

        t, h = column("width_um"), column("depth_um")
        self.leaf = np.array([r["kind"] == "leaf" for r in rows])
        self.crystal = rows[0]["material"] == "silicon"
        x = column("fillet_um") / t
        self.x = np.clip(x, 0.1, 2.0)
        self.q, self.p, self.nu = self.x ** (-2 / 3), h / (h + 4 * t), column("nu")
        self.u = np.where(self.leaf, 0.0, t / 3 / column("radius_or_length_um"))
        self.n = self.nu * column("bow")
        self.target = column("strain_per_rad") / (column("bending") * column("Kt"))
        if not self.crystal:
            self.target /= 1 + self.u
        self.inside = (x < 1.2501) & (h < 10.001 * t) & (x > (0.1499 if self.crystal else 0.0999))
        self.slack = np.where(self.inside, 0.0, 0.03 if self.crystal else 0.02)
        self.floor = 1 + margin
        self.axis, self.half_angle = np.radians(column("axis_from_100_deg")), np.radians(column("angle_deg")) / 2

    def term(self, exponents, u=None, c=0.0, s=0.0):
        values = (self.x, self.q, self.p, self.nu, self.n, self.u if u is None else u, c, s)
        out = np.ones(len(self.x))
        for value, k in zip(values, exponents):
            if k:
                out = out * value**k
        return out


class Isotropic(Rows):
    """linear in its constants: one linear program. The last unknown is 1 + how far the highest is above"""

    def __init__(self, rows, margin):
        super().__init__(rows, margin)
        self.basis = np.array([self.term(powers(t)) for t in ISOTROPIC]).T

    def over(self, constants):
        return self.basis @ constants / self.target - 1

    def solve(self):
        g = self.basis / self.target[:, None]
        found = linprog(np.r_[np.zeros(g.shape[1]), 1], A_ub=np.vstack([np.c_[g, -np.ones(len(g))], np.c_[-g, np.zeros(len(g))]]),
                        b_ub=np.r_[self.slack, np.full(len(g), -self.floor)], bounds=(None, None), method="highs")
        return found.x[:-1]


class Silicon(Rows):
    """the larger of two to four candidates, either fillet of either root; a linear program around the last constants, within a
    reach that grows and shrinks (sequential linear programming)"""

    START = {"": 1.0987, "x": -0.0163, "q": -0.0022, "c": -0.0772, "x c": 0.0052, "q c": 0.0196, "s": 0.125, "x s": -0.0414, "q s": 0.017}
    START_LEVEL = {"p3 n": 3.0234, "p n": -1.222, "x p2 nu": 0.7201, "x p3 nu": -1.0859, "q u": -0.1873}

    def __init__(self, rows, margin, direction, level):
        super().__init__(rows, margin)
        self.names = direction, level
        turned = 12 * SHIFT * self.x * self.u
        along, depth = [], []
        for root in (1, -1):
            at = 4 * (self.axis + np.where(self.leaf, 0, root * self.half_angle))
            cos, sin = np.cos(at), np.where(self.leaf, 1, root) * np.sin(at)
            c, s = cos * np.cos(turned) + sin * np.sin(turned), sin * np.cos(turned) - cos * np.sin(turned)
            for side in (1, -1):
                u = side * self.u
                along.append((1 + u)[:, None] * np.array([self.term(powers(t), u, c, side * s) for t in direction]).T)
                depth.append(np.array([self.term(powers(t), u, c, side * s) for t in level]).T)
        self.along, self.depth = np.array(along), np.array(depth)

    def value(self, constants):
        """G and its derivatives by the constants"""
        many = len(self.names[0])
        along, depth = self.along @ constants[:many], 1 + self.depth @ constants[many:]
        worst, i = (along * depth).argmax(0), np.arange(len(self.target))
        a, g = along[worst, i], depth[worst, i]
        return a * g, np.hstack([g[:, None] * self.along[worst, i], a[:, None] * self.depth[worst, i]])

    def over(self, constants):
        return self.value(constants)[0] / self.target - 1

    def on_floor(self, constants):
        """the same, scaled until the lowest is on its floor"""
        out = constants.copy()
        out[:len(self.names[0])] *= self.floor / (1 + self.over(constants)).min()
        return out

    def height(self, constants):
        ratio = 1 + self.over(constants)
        return (ratio / (1 + self.slack)).max() / ratio.min() - 1

    def solve(self, steps=120):
        """the terms are taken in one after the other, as they were found: from all at once it ends in worse places"""
        many, few = len(self.names[0]), (len(DIRECTION) + 1, len(LEVEL))
        first = np.array([i < few[0] or many <= i < many + few[1] for i in range(many + len(self.names[1]))])
        later = [k for k in range(len(first)) if not first[k]]
        start = np.array([self.START.get(t, 0.0) for t in self.names[0]] + [self.START_LEVEL.get(t, 0.0) for t in self.names[1]])
        best, free = self.refined(start, first, steps), first.copy()
        for k in later:
            free[k] = True
            best = self.refined(best, free, steps)
        return best

    def refined(self, start, free, steps):
        best = start
        least, reach = self.height(best), 0.2
        for _ in range(steps):
            here = self.on_floor(best)
            value, slopes = self.value(here)
            over, J = value / self.target - 1, slopes / self.target[:, None]
            found = linprog(np.r_[np.zeros(len(here)), 1], A_ub=np.vstack([np.c_[J, -np.ones(len(J))], np.c_[-J, np.zeros(len(J))]]),
                            b_ub=np.r_[self.slack - over, over - (self.floor - 1)], bounds=[(-reach * f, reach * f) for f in free] + [(None, None)],
                            method="highs")
            if found.status:
                break
            now = self.height(here + found.x[:-1])
            if now < least - 1e-7:
                best, least, reach = here + found.x[:-1], now, min(1.5 * reach, 0.5)
            else:
                reach *= 0.5
            if reach < 1e-5:
                break
        return self.on_floor(best)


def bow(deep, nu):
    """share of the cross-bow that is free, (8); deep = h/sqrt(r t)"""
    x = deep * (3 * (1 - nu * nu)) ** 0.25
    return 1.0 if x < 1e-2 else 2 / x * (math.cosh(x) - math.cos(x)) / (math.sinh(x) + math.sin(x))


def ranges(rng, many):
    """draws `many` between two bounds, a third of them at these"""

    def in_range(low, high):
        end = rng.rand(many)
        return np.where(end < 1 / 6, low, np.where(end > 5 / 6, high, rng.uniform(low, high, many)))

    return in_range


class Narrow:
    """Fillets within the range of the narrow band, and places between them: numpy arrays by the names of the powers and what is asked of
    each. A solid has one value of each of its fillets that is known: of an isotropic strip the larger one, of a leaf of silicon that of the
    fillet that turns towards the stiff direction, of an arc of silicon either (class Fillets). What lies between solids says a Gaussian
    process through them (kriging), whose own error is stated by leaving every solid out once; without it a sum of a hundred terms is free
    between the solids, and at the range's corners"""

    # powers of z, p, nu, n, u, c, s, their sum, terms
    CAPS = {"STRIP": ((5, 5, 2, 2, 4, 0, 0), 7, 90), "LEAF": ((5, 5, 0, 0, 0, 2, 2), 7, 50)}
    # lengths of the process along z, p, nu, n, u, c, s; its noise
    KRIGING = {"STRIP": ((1.6, 1.5, 3, 3, 3, 1, 1), 1e-9), "LEAF": ((1.2, 1.2, 1, 1, 1, 4, 4), 1e-4)}
    SHORT = 2.45  # depths: where both ends of a crystal's strip reach each other it is strained less, and no law is fitted to that

    def __init__(self, name, rows, margin):
        def column(of):
            return np.array([float(r[of]) for r in rows])

        self.name, self.floor = name, 1 + margin
        t, h, x, z, p = self.section(column)
        leaf = np.array([r["kind"] == "leaf" for r in rows])
        crystal = name != "STRIP"
        self.poisson = nu = column("nu")
        curved = np.where(leaf, 0.0, t / 3 / column("radius_or_length_um"))
        four = 4 * np.radians(column("axis_from_100_deg")) if crystal else 0 * z
        self.at = np.array([z, p, 0 * z if crystal else nu, 0 * z if crystal else nu * column("bow"), np.sqrt(20 * curved), np.cos(four), np.abs(np.sin(four))])
        self.by = 1 + curved
        self.target = column("strain_per_rad") / (column("bending") * column("Kt"))
        short = crystal & (column("radius_or_length_um") < self.SHORT * h)
        self.inside = (x < 1.2501) & (h < 10.001 * t) & (x > (0.1499 if crystal else 0.0999)) & ~short
        self.known = np.ones(len(z), bool)

    @staticmethod
    def section(column):
        t, h = column("width_um"), column("depth_um")
        x = column("fillet_um") / t
        return t, h, x, 2 * np.log(x / 0.1) / math.log(12.5) - 1, 2 * (h / (h + 4 * t) - FLAT) / (DEEP - FLAT) - 1

    def places(self, rng, many):
        """at random in the range, a third of them at its ends: at, by"""
        in_range = ranges(rng, many)
        z, p = in_range(-1, 1), in_range(-1, 1)
        if self.name == "STRIP":
            nu, curved = in_range(0.05, 0.4), np.where(rng.rand(many) < 0.3, 0, in_range(0, 0.05))
            return np.array([z, p, nu, nu * self.free(p, curved, nu), np.sqrt(20 * curved), 1 + 0 * z, 0 * z]), 1 + curved
        psi = in_range(0, math.pi / 4)
        return np.array([z, p, 0 * z, 0 * z, 0 * z, np.cos(4 * psi), np.abs(np.sin(4 * psi))]), np.ones(many)

    @staticmethod
    def free(p, curved, nu):
        """f of (8)"""
        flat = FLAT + (p + 1) / 2 * (DEEP - FLAT)
        return np.array([bow(4 * f / (1 - f) * math.sqrt(3 * w), v) for f, w, v in zip(flat, curved, nu + 0 * curved)])

    def seen(self):
        return self.inside & self.known

    def between(self, many=500):
        """with rows that no solid is of: what the process makes of them is asked for"""
        lengths, noise = self.KRIGING[self.name]
        at, by = self.places(np.random.RandomState(88), many)
        solids, value = self.at[:, self.seen()], (self.target / self.by)[self.seen()]

        def kernel(a, b):
            return np.exp(-0.5 * (((a[:, :, None] - b[:, None]) / np.array(lengths)[:, None, None])**2).sum(0))

        inverse = np.linalg.inv(kernel(solids, solids) + noise * np.eye(len(value)))
        weights = inverse @ (value - value.mean())
        missed = weights / np.diag(inverse)
        print(f"  kriging, each solid by the others: {100 * math.sqrt(np.mean(missed**2)):.2f} % (rms), {100 * np.abs(missed).max():.2f} % at most")
        out = object.__new__(type(self))
        out.name, out.floor = self.name, self.floor
        out.at, out.by = np.hstack([self.at[:, self.inside], at]), np.r_[self.by[self.inside], by]
        out.target = np.r_[self.target[self.inside], (value.mean() + kernel(at, solids) @ weights) * by]
        out.known = np.r_[self.known[self.inside], np.ones(many, bool)]
        out.inside = np.ones(len(out.by), bool)
        return out

    def columns(self, powers):
        """rows by terms, over what is asked for"""
        table = [[v**k for k in range(max(p[i] for p in powers) + 1)] for i, v in enumerate(self.at)]
        products = [np.prod([table[i][k] for i, k in enumerate(p) if k] or [np.ones(len(self.by))], axis=0) for p in powers]
        return np.array(products).T * (self.by / self.target)[:, None]

    def over(self, powers, constants):
        """how far the bound is above the rows"""
        return self.columns(powers) @ constants - 1

    def solve(self, powers):
        """Chebyshev's fit, one linear program: no known row below its floor, the highest as low as can be. Of the fillet that is strained
        less (not `known`) the bound is only not to be above the other's"""
        all_of = self.columns(powers)
        upper = np.c_[all_of, -np.ones(len(all_of))]
        low = np.c_[-all_of[self.known], np.zeros(self.known.sum())]
        found = linprog(np.r_[np.zeros(len(powers)), 1], A_ub=np.vstack([upper, low]), b_ub=np.r_[np.zeros(len(upper)), np.full(len(low), -self.floor)],
                        bounds=(None, None), method="highs")
        return found.x[:-1]

    def choice(self):
        """terms of at most the powers of CAPS, one after the other: the one that helps most with rows that are left out one at a time (least
        squares)"""
        caps, degree, many = self.CAPS[self.name]
        powers = [p for p in itertools.product(*(range(c + 1) for c in caps)) if sum(p) <= degree and p[5] + p[6] <= max(caps[5:])]
        columns = self.columns(powers)[self.known]
        left, hat, found = np.ones(len(columns)), np.zeros(len(columns)), []
        columns = columns / np.linalg.norm(columns, axis=0)
        for _ in range(many):
            size = np.sqrt((columns**2).sum(0))
            free = size > 3e-4
            helps = np.where(free, np.abs(columns.T @ left) / np.where(free, size, 1), 0)

            def left_out(j):
                q = columns[:, j] / size[j]
                return np.mean(((left - q * (q @ left)) / (1 - hat - q * q))**2)

            j = min((j for j in np.argsort(-helps)[:40] if free[j]), key=left_out)
            q = columns[:, j] / size[j]
            left, hat, columns = left - q * (q @ left), hat + q * q, columns - np.outer(q, q @ columns)
            found.append(j)
        return [powers[j] for j in found]

    def constants(self, powers):
        """as they are printed, the first raised until no solid is more than one in ten thousand below its floor"""
        found = np.array([float(f"{c:.6g}") for c in self.solve(powers)])
        while (self.over(powers, found)[self.seen()] < self.floor - 1 - 1e-4).any():
            found[0] = float(f"{found[0] + 1e-4:.6g}")
        return found


class Fillets(Narrow):
    """arcs of silicon, side 1: the fillet inside of the arc, -1: outside. Rows of root_fillets.csv are halves with a value of each; the
    other one than the worst is known where it has 95 % of that. Leaves are arcs without curvature: of them the fillet is known that turns
    towards the stiff direction"""

    CAPS = {"INNER": ((5, 5, 0, 1, 4, 4, 3), 7, 110), "OUTER": ((5, 5, 0, 1, 4, 4, 3), 7, 110)}
    KRIGING = {name: ((1.5, 1.5, 1, 0.4, 2, 2, 2), 1e-5) for name in CAPS}

    def __init__(self, side, halves, leaves, margin):
        def column(of):
            return np.array([float(r[of]) for r in halves])

        self.name, self.floor = "INNER" if side > 0 else "OUTER", 1 + margin
        t, h, x, z, p = self.section(column)
        curved = t / 3 / column("radius_or_length_um")
        four = 4 * (np.radians(column("angle_deg")) / 2 - np.radians(column("axis_from_100_deg"))) - 12 * SHIFT * x * curved
        n = column("nu") * column("bow")
        own, worst = (np.array([pair(r) for r in halves]) for pair in (
            lambda r: float(r["inner_per_rad"] if side > 0 else r["outer_per_rad"]), lambda r: max(float(r["inner_per_rad"]), float(r["outer_per_rad"]))))
        self.known = own > 0.95 * worst
        self.at = np.array([z, p, 0 * z, n, np.sqrt(20 * curved), np.cos(four), side * np.sin(four)])
        self.by = 1 + side * curved
        self.target = np.where(self.known, own, worst) / (column("bending") * column("Kt"))
        long = np.radians(column("angle_deg")) * column("radius_or_length_um") > self.SHORT * h
        self.inside = (x < 1.2501) & (h < 10.001 * t) & (x > 0.1499) & long
        if leaves is None:
            return
        self.at = np.hstack([self.at, leaves.at + np.outer(np.eye(7)[3], leaves.poisson)])
        self.by, self.target = np.r_[self.by, leaves.by], np.r_[self.target, leaves.target]
        self.known, self.inside = np.r_[self.known, leaves.known], np.r_[self.inside, leaves.inside]

    def places(self, rng, many):
        in_range = ranges(rng, many)
        side = 1 if self.name == "INNER" else -1
        z, p, curved, four = in_range(2 * math.log(1.5) / math.log(12.5) - 1, 1), in_range(-1, 1), in_range(0, 0.05), rng.uniform(0, 2 * math.pi, many)
        n = 0.312 * self.free(p, curved, 0.28)
        return np.array([z, p, 0 * z, n, np.sqrt(20 * curved), np.cos(four), side * np.sin(four)]), 1 + side * curved


def table(name, powers_of, constants):
    """rows as src/flexure/roots.def has them"""
    digits = 5 if len(powers_of[0]) == len(NAMES) else 6
    return [f"{name}({c:.{digits}g}, {', '.join(str(k) for k in p)})" for p, c in zip(powers_of, constants)]
