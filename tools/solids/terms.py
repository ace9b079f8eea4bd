# SPDX-License-Identifier: GPL-3.0-or-later
"""The laws that are fitted, docs/theory/root-strain.md (11a) and docs/theory/flexure-silicon.md (14), and Chebyshev fits of their constants.

What is fitted is G, the solid's strain per moment over Kt times that of the beam (isotropic: times 1 + u): no row may come out
below 1 + margin, and the highest above its own `slack` be as low as it can be. slack: 0 within the range of the narrow band
(`inside`), 0.02 beyond it (silicon 0.03). The moment is that of the closed form with what the ends lose (13a).

Within the range of the narrow band isotropic strips and leaves of silicon have a law of their own: G a sum of terms, each the powers of

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


class Narrow:
    """rows within the range of the narrow band, and places between them: numpy arrays by the names of the powers, one for each fillet that
    may be the worst, and what is asked of each row. What lies between solids says a Gaussian process through them (kriging), whose own
    error is stated by leaving every solid out once; without it a sum of fifty terms is free between the rows, and at the range's corners"""

    CAPS = {"isotropic": ((5, 5, 2, 2, 4, 0, 0), 7, 50), "silicon": ((4, 4, 0, 0, 0, 2, 1), 6, 36)}  # powers, their sum, terms
    # lengths of the process, of z, p, nu, n, u or z, p, c, |s|; its noise
    KRIGING = {"isotropic": ((1.6, 1.5, 3, 3, 3), 1e-9), "silicon": ((1.5, 1.5, 4, 4), 1e-5)}

    def __init__(self, rows, margin):
        def column(name):
            return np.array([float(r[name]) for r in rows])

        t, h = column("width_um"), column("depth_um")
        leaf = np.array([r["kind"] == "leaf" for r in rows])
        self.material = rows[0]["material"]
        crystal = self.material == "silicon"
        x = column("fillet_um") / t
        z, p = 2 * np.log(x / 0.1) / math.log(12.5) - 1, 2 * (h / (h + 4 * t) - FLAT) / (DEEP - FLAT) - 1
        nu = column("nu")
        n = nu * column("bow")
        curved = np.where(leaf, 0.0, t / 3 / column("radius_or_length_um"))
        self.target = column("strain_per_rad") / (column("bending") * column("Kt"))
        self.inside = (x < 1.2501) & (h < 10.001 * t) & (x > (0.1499 if crystal else 0.0999))
        self.slack = np.zeros(len(x))
        self.floor = 1 + margin
        self.at, self.by = [], []
        if not crystal:
            self.at, self.by = [(z, p, nu, n, np.sqrt(20 * curved), z, z)], [1 + curved]
            return
        axis = np.radians(column("axis_from_100_deg"))
        for side in (1, -1):
            self.at.append((z, p, nu, n, 0 * z, np.cos(4 * axis), side * np.sin(4 * axis)))
            self.by.append(np.ones(len(z)))

    def between(self, many=500):
        """rows that no solid is of, at random in the range, a third of them at its ends: what the process makes of them is asked for"""
        rng = np.random.RandomState(88)

        def in_range(low, high):
            end = rng.rand(many)
            return np.where(end < 1 / 6, low, np.where(end > 5 / 6, high, rng.uniform(low, high, many)))

        z, p = in_range(-1, 1), in_range(-1, 1)
        out = object.__new__(Narrow)
        out.material, out.slack, out.inside, out.floor = self.material, np.zeros(many), np.ones(many, bool), self.floor
        if self.material == "isotropic":
            nu, curved = in_range(0.05, 0.4), np.where(rng.rand(many) < 0.3, 0, in_range(0, 0.05))
            flat = FLAT + (p + 1) / 2 * (DEEP - FLAT)
            free = np.array([bow(4 * f / (1 - f) * math.sqrt(3 * w), v) for f, w, v in zip(flat, curved, nu)])
            out.at, out.by = [(z, p, nu, nu * free, np.sqrt(20 * curved), z, z)], [1 + curved]
        else:
            psi = in_range(0, math.pi / 4)
            out.at, out.by = [(z, p, 0 * z, 0 * z, 0 * z, np.cos(4 * psi), k * np.sin(4 * psi)) for k in (1, -1)], [np.ones(many)] * 2
        lengths, noise = self.KRIGING[self.material]
        seen, places = self.places()[self.inside], out.places()
        value = (self.target / self.by[0])[self.inside]

        def kernel(a, b):
            return np.exp(-0.5 * (((a[:, None] - b[None]) / np.array(lengths))**2).sum(-1))

        inverse = np.linalg.inv(kernel(seen, seen) + noise * np.eye(len(seen)))
        weights = inverse @ (value - value.mean())
        missed = weights / np.diag(inverse)
        print(f"  kriging, each solid by the others: {100 * math.sqrt(np.mean(missed**2)):.2f} % (rms), {100 * np.abs(missed).max():.2f} % at most")
        out.target = (value.mean() + kernel(places, seen) @ weights) * out.by[0]
        return self.with_more(out)

    def places(self):
        z, p, nu, n, u, c, s = self.at[0]
        return np.array([z, p, nu, n, u] if self.material == "isotropic" else [z, p, c, np.abs(s)]).T

    def with_more(self, other):
        """those of self within the range, and other's"""
        out, mine = object.__new__(Narrow), self.inside
        out.material, out.floor = self.material, self.floor
        for name in ("target", "slack", "inside"):
            setattr(out, name, np.r_[getattr(self, name)[mine], getattr(other, name)])
        out.at = [tuple(np.r_[a[mine], b] for a, b in zip(one, two)) for one, two in zip(self.at, other.at)]
        out.by = [np.r_[a[mine], b] for a, b in zip(self.by, other.by)]
        return out

    def columns(self, powers):
        """of every fillet: rows by terms, over what is asked for"""
        out = []
        for values, by in zip(self.at, self.by):
            table = [[v**k for k in range(max(p[i] for p in powers) + 1)] for i, v in enumerate(values)]
            products = [np.prod([table[i][k] for i, k in enumerate(p) if k] or [np.ones(len(by))], axis=0) for p in powers]
            out.append(np.array(products).T * (by / self.target)[:, None])
        return out

    def over(self, powers, constants):
        """1 + how far the bound is above the rows, and which fillet it is of"""
        value = np.array([c @ constants for c in self.columns(powers)])
        return value.max(0) - 1, value.argmax(0)

    def solve(self, powers, worst=None):
        """Chebyshev's fit. Of every row one fillet, the worst by least squares, is to be above it, and all of them are not to be too far above
        it: a linear program, repeated with the worst of its own answer as long as that helps"""
        all_of, rows = np.array(self.columns(powers)), np.arange(len(self.target))
        upper = np.vstack([np.c_[a, -np.ones(len(a))] for a in all_of])
        worst, best = self.squares(powers) if worst is None else worst, None
        for _ in range(6):
            low = np.c_[-all_of[worst, rows], np.zeros(len(rows))]
            found = linprog(np.r_[np.zeros(len(powers)), 1], A_ub=np.vstack([upper, low]),
                            b_ub=np.r_[np.tile(self.slack, len(all_of)), np.full(len(rows), -self.floor)], bounds=(None, None), method="highs").x
            if best is not None and found[-1] > best[-1] - 1e-6:
                break
            best, worst = found, (all_of @ found[:-1]).argmax(0)
        return best[:-1]

    def squares(self, powers):
        """the worst fillets of a fit of least squares"""
        all_of, rows = np.array(self.columns(powers)), np.arange(len(self.target))
        weight, worst = np.ones((len(self.target), 1)), np.zeros(len(self.target), int)
        for _ in range(8 if len(all_of) > 1 else 0):
            constants = np.linalg.lstsq(all_of[worst, rows] * weight, weight[:, 0], rcond=None)[0]
            worst = (all_of @ constants).argmax(0)
        return worst

    def choice(self):
        """terms of at most the powers of CAPS, one after the other: the one that helps most with rows that are left out one at a time (least
        squares)"""
        caps, degree, many = self.CAPS[self.material]
        powers = [p for p in itertools.product(*(range(c + 1) for c in caps)) if sum(p) <= degree and p[5] + p[6] <= 2]
        weight, rows = np.ones(len(self.target)), np.arange(len(self.target))
        every, worst = np.array(self.columns(powers)), np.zeros(len(self.target), int)
        for _ in range(3 if len(self.at) > 1 else 1):
            columns = every[worst, rows] * weight[:, None]
            left, hat, found = weight.copy(), np.zeros(len(rows)), []
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
            constants = np.linalg.lstsq(every[worst, rows][:, found] * weight[:, None], weight, rcond=None)[0]
            worst = np.array([a[:, found] @ constants for a in every]).argmax(0)
        return [powers[j] for j in found]


def table(name, powers_of, constants):
    """a table as src/flexure/flexure_section.c has it"""
    kind, digits = ("root_term", 5) if len(powers_of[0]) == len(NAMES) else ("strip_term", 6)
    rows = [f"    {{{c:.{digits}g}, {{{', '.join(str(k) for k in p)}}}}}," for p, c in zip(powers_of, constants)]
    return [f"static const {kind} {name}[] = {{"] + rows + ["};"]
