# SPDX-License-Identifier: GPL-3.0-or-later
"""The formulas that are fitted, docs/theory/root-strain.md (11a) and docs/theory/flexure-silicon.md (14), and Chebyshev fits of their constants.

What is fitted is G, the solid's strain per radian over bending strain times Kt (isotropic: times 1 + u): no row may come out below
`floor`, and the highest above its own `slack` be as low as it can be. floor: the margin (what a solid may be off by itself, 0.003; for those
deeper than 10 t 0.4 of it), 0 for reference rows; these, whose strains scatter, do not count for the height, but isotropic ones are
below `at_most_above`. slack: 0.008 for those deeper than 10 t, which are few and at the end of the range."""
import math

import numpy as np
from scipy.optimize import linprog


class Fit:
    """columns: see flexure_section.c"""

    def __init__(self, rows, margin):
        def column(name):
            return np.array([float(r[name]) for r in rows])

        t, h, nu = column("width_um"), column("depth_um"), column("nu")
        leaf = np.array([r["kind"] == "leaf" for r in rows])
        self.leaf, self.reference = leaf, np.array([r["reference"] for r in rows])
        self.x = np.clip(column("fillet_um") / t, 0.1, 2.0)
        self.q, self.p, self.nu = self.x ** (-2 / 3), h / (h + 4 * t), nu
        self.u = np.where(leaf, 0.0, t / 3 / column("radius_or_length_um"))
        bow = np.where(leaf, 1.0, (1 - (1 - nu * nu) * column("depth_factor")) / nu**2)
        self.n = nu * bow
        self.axis, self.half_angle = np.radians(column("axis_from_100_deg")), np.radians(column("angle_deg")) / 2
        self.target = column("strain_per_rad") / (column("bending") * column("Kt"))
        self.deep = h / t > 10.001
        self.floor = np.where(self.reference, 0.0, np.where(self.deep, 0.4 * margin, margin))
        self.slack = np.where(self.deep, 0.008, 0.0)
        self.at_most = column("at_most_above")


class Isotropic(Fit):
    """linear in its constants: one linear program. The last unknown is 1 + how far the highest is above"""

    def __init__(self, rows, margin):
        super().__init__(rows, margin)
        x, q, p, nu, n, u = self.x, self.q, self.p, self.nu, self.n, self.u
        self.target = self.target / (1 + u)
        self.basis = np.array([x * 0 + 1, n * p**3, n * p, nu * q * p**2, nu * q * p**3, nu * x * p**3, u * p, n * x * u, u * q]).T

    def over(self, constants):
        return self.basis @ constants / self.target - 1

    def solve(self):
        g, up, capped = self.basis / self.target[:, None], ~self.reference, np.isfinite(self.at_most)
        above = [np.c_[g[capped], np.zeros(capped.sum())], np.c_[g[up], -np.ones(up.sum())], np.c_[-g, np.zeros(len(g))]]
        limit = np.r_[1 + self.at_most[capped], self.slack[up], -(1 + self.floor)]
        found = linprog(np.r_[np.zeros(g.shape[1]), 1], A_ub=np.vstack(above), b_ub=limit, bounds=(None, None), method="highs")
        return found.x[:-1]


class Silicon(Fit):
    """the larger of two to four candidates, either fillet of either root; a linear program around the last constants, within a
    reach that grows and shrinks (sequential linear programming), from a least-squares start"""

    START = (1.0987, -0.0163, -0.0022, -0.0772, 0.0052, 0.0196, 0.125, -0.0414, 0.017, 0, 0, 0, 3.0234, -1.222, 0.7201, -1.0859, -0.1873, 0, 0, 0, 0)
    OF_LEVEL = 12  # the first so many are of A + B c + D u s + C s, the others of H and V

    def __init__(self, rows, margin, shift):
        super().__init__(rows, margin)
        self.shift = shift
        x, q, p, nu, n = self.x, self.q, self.p, self.nu, self.n
        turned = 12 * shift * x * self.u
        direction, bend = [], []
        for root in (1, -1):
            cos, sin = self.heading(root, turned)
            for side in (1, -1):
                U, s, one = side * self.u, side * sin, x * 0 + 1
                columns = [one, x, q, cos, cos * x, cos * q, s, s * x, s * q, q * q, s * q * q, 10 * s * U]
                direction.append((1 + U)[:, None] * np.array(columns).T)
                bend.append(np.array([n * p**3, n * p, nu * x * p**2, nu * x * p**3, U * q, n * p * p, U * p, n * x * U, n * U]).T)
        self.direction, self.bend = np.array(direction), np.array(bend)

    def heading(self, root, turned):
        """cosine and sine of 4 psi where the bound takes it, as fillets_at of flexure_section.c has them"""
        at = 4 * (self.axis + np.where(self.leaf, 0, root * self.half_angle))
        cos, sin = np.cos(at), np.where(self.leaf, 1, root) * np.sin(at)
        z = turned * turned
        S, C = turned * (1 - z * (1 / 6 - z / 120)), 1 - z * (0.5 - z * (1 / 24 - z / 720))
        return cos * C + sin * S, sin * C - cos * S

    def value(self, constants):
        """G and its derivatives by the constants"""
        along, level = self.direction @ constants[:self.OF_LEVEL], 1 + self.bend @ constants[self.OF_LEVEL:]
        worst, i = (along * level).argmax(0), np.arange(len(self.target))
        a, g = along[worst, i], level[worst, i]
        return a * g, np.hstack([g[:, None] * self.direction[worst, i], a[:, None] * self.bend[worst, i]])

    def over(self, constants):
        return self.value(constants)[0] / self.target - 1

    def least_squares(self, chosen):
        """Levenberg-Marquardt, of powers 2 and 6 of the distance from 2 % above"""
        c = np.array(self.START)
        those = chosen & ~self.reference
        for power in (2, 6):
            damping = 1e-3

            def cost(at):
                return np.sum(np.abs((self.over(at) - 0.02)[those] * 30) ** power)

            least = cost(c)
            for _ in range(60):
                value, slopes = self.value(c)
                r = value / self.target - 1.02
                weight = np.abs(30 * r) ** ((power - 2) / 2) + 1e-3
                J = (slopes / self.target[:, None])[those] * weight[those][:, None]
                square = J.T @ J
                step = c - np.linalg.solve(square + damping * np.diag(np.diag(square) + 1e-9), J.T @ (r * weight)[those])
                now = cost(step)
                if now < least * (1 - 1e-9):
                    c, least, damping = step, now, max(damping / 5, 1e-9)
                else:
                    damping *= 5
                if damping > 1e6:
                    break
        return c

    def on_floor(self, constants, chosen):
        """the same, scaled until the lowest is on its floor"""
        out = constants.copy()
        out[:self.OF_LEVEL] /= np.min(((1 + self.over(constants)) / (1 + self.floor))[chosen])
        return out

    def solve(self, chosen=None, steps=80):
        chosen = np.ones(len(self.target), bool) if chosen is None else chosen
        up = chosen & ~self.reference

        def height(at):
            ratio = 1 + self.over(at)
            return (ratio / (1 + self.slack))[up].max() / (ratio / (1 + self.floor))[chosen].min() - 1

        best = self.least_squares(chosen)
        least, reach = height(best), 0.2
        for _ in range(steps):
            here = self.on_floor(best, chosen)
            value, slopes = self.value(here)
            over, J = value / self.target - 1, slopes / self.target[:, None]
            found = linprog(np.r_[np.zeros(len(here)), 1],
                            A_ub=np.vstack([np.c_[J[up], -np.ones(up.sum())], np.c_[-J[chosen], np.zeros(chosen.sum())]]),
                            b_ub=np.r_[(self.slack - over)[up], (over - self.floor)[chosen]],
                            bounds=[(-reach, reach)] * len(here) + [(None, None)], method="highs")
            if found.status:
                break
            now = height(here + found.x[:-1])
            if now < least - 1e-7:
                best, least, reach = here + found.x[:-1], now, min(1.5 * reach, 0.5)
            else:
                reach *= 0.5
            if reach < 1e-5:
                break
        return least, self.on_floor(best, chosen)


def first(value):
    text = f"{value:.4f}".rstrip("0")
    return text + "0" if text.endswith(".") else text


def more(value):
    return ("- " if value < 0 else "+ ") + first(abs(value))


def isotropic_text(c):
    return [f"return {first(c[0])} + n * p * ({first(c[1])} * p2 {more(c[2])}) +",
            f"nu * p2 * (q * ({first(c[3])} {more(c[4])} * p) {more(c[5])} * x * p) +",
            f"u * ({first(c[6])} * p {more(c[7])} * n * x {more(c[8])} * q);"]


def silicon_text(c, shift):
    a, h = c[:12], c[12:]
    return [f".even = {first(a[0])} {more(a[1])} * x + q * ({first(a[2])} {more(a[9])} * q)",
            f".along = share * ({first(a[3])} {more(a[4])} * x {more(a[5])} * q)",
            f".across = share * ({first(a[6])} {more(a[7])} * x + q * ({first(a[8])} {more(a[10])} * q))",
            f".lean = share * {first(10 * a[11])} * u",
            f"double e = {12 * shift:g} * x * u",
            f"level = 1 + n * p * ({first(h[0])} * p2 {more(h[5])} * p {more(h[1])}) + nu * p2 * x * ({first(h[2])} {more(h[3])} * p);",
            f"tilt = u * ({first(h[6])} * p + n * ({first(h[7])} * x {more(h[8])}) {more(h[4])} * q);"]
