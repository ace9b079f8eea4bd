# SPDX-License-Identifier: GPL-3.0-or-later
"""A whole device as one elastic solid for tools/solids/gallery: half of its depth in quadratic wedges, the middle of the layer held
across (motion in the plane) or along it (motion across), which its symmetry allows; CalculiX's frequencies, its pose under loads with
large displacements, and the peak strain at the edge of a flexure.

The strain is of the edge's own displacements: their derivatives along it and through the depth give Green's strains of the face, no
stress acts on the face, and so all six follow (surface.py says more). um, uN, s, MPa, kg."""
import itertools
import math
import re
import subprocess
import sys

import numpy as np
from scipy.spatial import Delaunay
from shapely.geometry import Point, Polygon
from shapely.vectorized import contains

import surface
from plan import ROUGH

UM = 1e6
FACE = surface.GAUSS  # a Gauss point of an edge's face


def grams(name, nodes):
    return [f"*NSET,NSET={name}", *(",".join(map(str, nodes[i:i + 10])) for i in range(0, len(nodes), 10))]


class Solid:
    def __init__(self, plan, layer, size, layers):
        self.plan, self.layer = plan, layer
        self.half = layer[0] * UM / 2
        self.xy, self.tri, self.edges = plan.mesh(size)
        # thinner towards the free surface, where a section bows
        w = np.linspace(1.3, 0.7, layers) if layers > 1 else np.ones(1)
        corners = np.r_[0, np.cumsum(w) / w.sum()] * self.half
        self.z = np.empty(2 * layers + 1)
        self.z[::2], self.z[1::2] = corners, (corners[1:] + corners[:-1]) / 2
        corner = np.zeros(len(self.xy), bool)
        corner[np.unique(self.tri[:, :3])] = True
        self.number, self.at = {}, []
        for k in range(2 * layers + 1):
            for i in range(len(self.xy)):
                if k % 2 == 0 or corner[i]:  # middles of vertical edges stand at corners alone
                    self.number[k, i] = len(self.at) + 1
                    self.at.append((*self.xy[i], self.z[k]))
        n = self.number
        self.wedges = [[n[k, i] for i in t[:3]] + [n[k + 2, i] for i in t[:3]] + [n[k, i] for i in t[3:]] + [n[k + 2, i] for i in t[3:]] +
                       [n[k + 1, i] for i in t[:3]] for k in range(0, 2 * layers, 2) for t in self.tri]
        x, y = self.xy.T
        held = contains(plan.base.buffer(0.02), x, y) & ~contains(plan.near.buffer(-0.05), x, y)
        self.held = [v for (_, i), v in n.items() if held[i]]
        self.middle = [v for (k, i), v in n.items() if k == 0 and not held[i]]
        self.inside = {b: contains(p.buffer(0.002 + ROUGH), x, y) & ~contains(plan.thin, x, y) & corner for b, p in plan.bodies.items()}
        self.extra, self.extra_at = [], []  # points that loads act at

    def material(self):
        _, density, youngs, nu, c11, c12, c44, turn = self.layer
        out = ["*MATERIAL,NAME=M"]
        if c11 > 0:
            c, s = math.cos(math.radians(turn)), math.sin(math.radians(turn))
            a, b, d = c11 / 1e6, c12 / 1e6, c44 / 1e6
            out += ["*ELASTIC,TYPE=ORTHO", f"{a},{b},{a},{b},{b},{a},{d},{d},", f"{d}",
                    "*ORIENTATION,NAME=O,SYSTEM=RECTANGULAR", f"{c},{s},0,{-s},{c},0"]
        else:
            out += ["*ELASTIC", f"{youngs / 1e6},{nu}"]
        return [*out, "*DENSITY", f"{density * 1e-18:.9g}", "*SOLID SECTION,ELSET=EALL,MATERIAL=M" + (",ORIENTATION=O" if c11 > 0 else "")]

    def point(self, body, x, y):
        """a node at this place that goes with the body: with three of its nodes around it, whatever the layer"""
        here = np.flatnonzero(self.inside[body])
        far = np.hypot(*(self.xy[here] - (x, y)).T)
        near = here[np.argsort(far)[:60]]
        net = Delaunay(self.xy[near])
        s = int(net.find_simplex((x, y)))
        if s < 0:
            near = here
            net = Delaunay(self.xy[near])
            s = int(net.find_simplex((x, y)))
        three = near[net.simplices[s]]
        share = np.linalg.solve(np.vstack([self.xy[three].T, np.ones(3)]), (x, y, 1))
        node = len(self.at) + len(self.extra_at) + 1
        self.extra_at.append((x, y, 0.0))
        ks = range(len(self.z))
        weight = np.gradient(self.z)
        weight = weight / weight.sum()
        for axis in (1, 2):
            terms = [(node, axis, -1.0)] + [(self.number[k, i], axis, a * weight[k]) for k in ks for i, a in zip(three, share)]
            self.extra += ["*EQUATION", str(len(terms))]
            self.extra += [",".join(f"{n},{d},{v:.12g}" for n, d, v in terms[i:i + 4]) for i in range(0, len(terms), 4)]
        return node

    def deck(self, steps, fixed, springs=()):
        out = ["*NODE,NSET=ALL", *(f"{n + 1},{x:.9g},{y:.9g},{z:.9g}" for n, (x, y, z) in enumerate([*self.at, *self.extra_at])),
               "*ELEMENT,TYPE=C3D15,ELSET=EALL"]
        for e, nodes in enumerate(self.wedges):
            text = [str(e + 1), *map(str, nodes)]
            out += [",".join(text[:10]) + ",", ",".join(text[10:])]
        e = len(self.wedges)
        for i, (a, b, table) in enumerate(springs):
            out += [f"*ELEMENT,TYPE=SPRINGA,ELSET=S{i}", f"{e + i + 1},{a},{b}", f"*SPRING,ELSET=S{i},NONLINEAR", "",
                    *(f"{f:.9e},{u:.9e}" for u, f in table)]  # without a point a number were a direction
        out += [*grams("HELD", self.held), *grams("MIDDLE", self.middle), *self.extra, *self.material(), "*BOUNDARY", "HELD,1,3", *fixed]
        out += [f"{len(self.at) + i + 1},3,3" for i in range(len(self.extra_at))]
        return "\n".join([*out, *steps]) + "\n"

    def solve(self, folder, name, *deck):
        (folder / f"{name}.inp").write_text(self.deck(*deck))
        done = subprocess.run(["ccx", name], cwd=folder, capture_output=True, text=True, check=False)
        text = (folder / f"{name}.dat").read_text() if (folder / f"{name}.dat").exists() else ""
        (folder / f"{name}.log").write_text(done.stdout)
        if done.returncode or not text or "*ERROR" in done.stdout:
            sys.exit(f"ccx {name}: {done.stdout[-1500:]}")
        for end in ("frd", "12d", "cvg", "sta", "eig"):
            (folder / f"{name}.{end}").unlink(missing_ok=True)
        return text

    def modes(self, folder, across, count=3):
        keep, self.extra, self.extra_at = (self.extra, self.extra_at), [], []
        text = self.solve(folder, "across" if across else "inner", ["*STEP", "*FREQUENCY", str(count + 1), "*END STEP"],
                          ["MIDDLE,1,2"] if across else ["MIDDLE,3,3"])
        self.extra, self.extra_at = keep
        rows = re.findall(r"^ +\d+ +[-0-9.E+]+ +[-0-9.E+]+ +[-0-9.E+]+ +[-0-9.E+]+$", text, re.M)
        return [float(r.split()[3]) for r in rows[:count]]

    def pushed(self, folder, loads, springs, anchors, gravity):
        """displacements of all nodes: loads [(node, fx, fy)] of the whole device, springs, anchors [(node, ux, uy)], gravity (gx, gy)"""
        lines = [f"{n},{axis},{f / 2:.9g}" for n, fx, fy in loads for axis, f in ((1, fx), (2, fy)) if f]
        steps = ["*STEP,NLGEOM,INC=400", "*STATIC", "0.5,1.,1e-4,0.5"]
        fixed = ["MIDDLE,3,3"]
        moves = [f"{n},{axis},{axis},{u:.9g}" for n, ux, uy in anchors for axis, u in ((1, ux), (2, uy))]
        steps += ["*BOUNDARY", *moves] if moves else []
        steps += ["*CLOAD", *lines] if lines else []
        size = math.hypot(*gravity)
        steps += ["*DLOAD", f"EALL,GRAV,{size:.9g},{gravity[0] / size:.9g},{gravity[1] / size:.9g},0"] if size else []
        text = self.solve(folder, "pushed", [*steps, "*NODE PRINT,NSET=ALL,FREQUENCY=400", "U", "*END STEP"], fixed, springs)
        u = np.zeros((len(self.at) + len(self.extra_at) + 1, 3))
        for block in re.split(r"displacements \(vx,vy,vz\)[^\n]*\n", text)[1:]:
            for row in block.splitlines():
                words = row.split()
                if len(words) == 4 and words[0].isdigit():
                    u[int(words[0])] = [float(v) for v in words[1:]]
        return u

    def pose(self, u, body, x, y):
        """way (um) of the body's point and turn (rad), by the way of its nodes that fits best, each by the area around it"""
        area = np.zeros(len(self.xy))
        a, b, c = (self.xy[self.tri[:, i]] for i in range(3))
        size = ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]) / 6
        for i in range(3):
            np.add.at(area, self.tri[:, i], size)
        here = np.flatnonzero(self.inside[body])
        w = area[here][:, None] / area[here].sum()
        at, v = self.xy[here], np.array([u[self.number[0, i]][:2] for i in here])
        middle, way = (w * at).sum(0), (w * v).sum(0)
        d = at - middle
        now = d + v - way
        turn = math.atan2((w[:, 0] * (d[:, 0] * now[:, 1] - d[:, 1] * now[:, 0])).sum(), (w * d * now).sum())
        arm = np.array((x, y)) - middle
        c, s = math.cos(turn), math.sin(turn)
        return (*(way + (c * arm[0] - s * arm[1], s * arm[0] + c * arm[1]) - arm), turn)

    def peak(self, u, joint, of_stress):
        """largest principal strain (or stress over the mean modulus) at the edges of a flexure and its fillets, and where"""
        _, _, youngs, nu, c11, c12, c44, turn = self.layer
        c = np.zeros((6, 6))
        if c11 > 0:
            c[:3, :3] = c12
            c[range(3), range(3)] = c11
            c[range(3, 6), range(3, 6)] = c44
            s = np.linalg.inv(c / 1e6)
        else:
            s = surface.isotropic(nu) * (surface.YOUNGS_MPA / (youngs / 1e6))
        compliance = surface.tensor(s)
        cos, sin = math.cos(math.radians(turn)), math.sin(math.radians(turn))
        crystal = np.array([[cos, -sin, 0], [sin, cos, 0], [0, 0, 1]])
        strip = self.plan.flexures[joint].buffer(2.0 * self.plan.width[joint])
        chains, best = chained([e for e in self.edges if strip.contains(Point(*self.xy[e[1]]))]), (0.0,)
        for chain in chains:
            values, arc, at, part, behind, before = [], [], [], [0], 0.0, 0.0
            for edge in chain:
                x = self.xy[list(edge)]
                bent = turning(x)
                part.append(part[-1] + (abs(bent - before) > 0.5 * max(abs(bent), abs(before))))
                before = bent
                for g in (-FACE, FACE):
                    tangent = np.array([g - 0.5, -2 * g, g + 0.5]) @ x
                    point = np.array([g * (g - 1) / 2, 1 - g * g, g * (g + 1) / 2]) @ x
                    length = math.hypot(*tangent)
                    t = np.array([*tangent / length, 0])
                    axes = np.array([t, [0, 0, 1], [t[1], -t[0], 0]]) @ crystal
                    turned = np.einsum("ia,jb,kc,ld,abcd->ijkl", axes, axes, axes, axes, compliance, optimize=True)
                    row = []
                    for k, r in itertools.product(range(0, len(self.z) - 1, 2), (-FACE, FACE)):
                        ds, dr = self.slopes(u, edge, k, g, r)
                        ds, dr = ds / length, dr / ((self.z[k + 2] - self.z[k]) / 2)
                        row.append(surface.largest(turned, ds @ t + ds @ ds / 2, dr[2] + dr @ dr / 2, ds[2] + dr @ t + ds @ dr, of_stress))
                    values.append(row)
                    arc.append(behind + math.hypot(*(point - x[0])))
                    at.append(point)
                behind += math.hypot(*(x[1] - x[0])) + math.hypot(*(x[2] - x[1]))
            if len(values) >= 8:
                best = max(best, self.summit(np.array(values), np.array(arc), np.array(at), np.repeat(part[1:], 2)))
        return best[0] * (surface.YOUNGS_MPA / (youngs / 1e6) if of_stress else 1), *best[1:]

    def slopes(self, u, edge, k, g, r):
        """derivatives of the displacement along (g) and through the depth (r) of the face of an edge"""
        ds, dr = np.zeros(3), np.zeros(3)
        n = self.number
        for (i, a), b in itertools.product(((0, -1), (2, 1)), (-1, 1)):
            at = u[n[k + 1 + b, edge[i]]]
            ds += at * (0.25 * a * (1 + b * r) * (2 * a * g + b * r))
            dr += at * (0.25 * b * (1 + a * g) * (2 * b * r + a * g))
        for (i, a), b in (((0, -1), -1), ((2, 1), 1)):
            at, over = u[n[k + 1, edge[i]]], u[n[k + 1 + b, edge[1]]]
            ds += at * (0.5 * a * (1 - r * r)) - over * (g * (1 + b * r))
            dr += over * (0.5 * b * (1 - g * g)) - at * (r * (1 + a * g))
        return ds, dr

    def summit(self, values, arc, at, part):
        """in depth polynomials through four points, along the edge a cubic of the six around the largest that lie on the same line or arc"""
        z = np.array([(self.z[k] + self.z[k + 2] + r * (self.z[k + 2] - self.z[k])) / 2 for k in range(0, len(self.z) - 1, 2) for r in (-FACE, FACE)])
        depth, both = np.linspace(0, self.half, 41), np.r_[-z[::-1], z]
        fine = np.array([[surface.nearby(both, np.r_[row[::-1], row], v) for v in depth] for row in values])
        i, k = np.unravel_index(fine.argmax(), fine.shape)
        same = np.flatnonzero(part == part[i])
        first = max(0, min(int(np.flatnonzero(same == i)[0]) - 3, len(same) - 6))
        six = same[first:first + 6]
        cubic = np.polyfit(arc[six] - arc[i], fine[six, k], min(3, len(six) - 1))
        s = np.linspace(arc[max(six[0], i - 1)], arc[min(six[-1], i + 1)], 81)
        value = np.polyval(cubic, s - arc[i])
        b = int(value.argmax())
        return float(value[b]), float(np.interp(s[b], arc, at[:, 0])), float(np.interp(s[b], arc, at[:, 1])), float(depth[k])


def turning(x):
    """curvature of an edge by its three nodes"""
    (ax, ay), (bx, by) = x[1] - x[0], x[2] - x[1]
    return 2 * (ax * by - ay * bx) / (math.hypot(ax, ay) * math.hypot(bx, by) * math.hypot(ax + bx, ay + by))


def chained(edges):
    """runs of edges, one behind the other"""
    after, starts = {e[0]: e for e in edges}, {e[0] for e in edges} - {e[2] for e in edges}
    out = []
    for s in starts:
        run = []
        while s in after and len(run) < len(edges):
            run.append(after[s])
            s = after[s][2]
        out.append(run)
    return out
