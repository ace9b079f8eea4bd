# SPDX-License-Identifier: GPL-3.0-or-later
"""The laws that are fitted, docs/theory/root-strain.md (11a) and docs/theory/flexure-silicon.md (14), and Chebyshev fits of their constants.

What is fitted is G, the solid's strain per moment over Kt times that of the beam (isotropic: times 1 + u): no row may come out
below 1 + margin, and the highest above its own `slack` be as low as it can be. slack: 0 within the range of the narrow band
(`inside`), 0.02 beyond it (silicon 0.03). The moment is that of the closed form with what the ends lose (13a).

A term is the powers of x, q, p, nu, n, u, c, s. An isotropic G is a sum of terms; one of silicon the product of a sum (what the
direction does) and 1 + a sum (what the depth does), the larger of either fillet of either root."""
import math

import numpy as np
from scipy.optimize import linprog

NAMES = ("x", "q", "p", "nu", "n", "u", "c", "s")
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


def table(name, texts, constants):
    """a table as src/flexure/flexure_section.c has it"""
    rows = [f"    {{{c:.5g}, {{{', '.join(str(k) for k in powers(t))}}}}}," for t, c in zip(texts, constants)]
    return [f"static const root_term {name}[] = {{"] + rows + ["};"]
