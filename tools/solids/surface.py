# SPDX-License-Identifier: GPL-3.0-or-later
"""Peak strain at the edges of a solid from the displacements of their nodes.

in: what solid_half says of the edges (um), CalculiX's displacements of their nodes (um), the material (compliances, 1/MPa)
out: rotation of the half (rad), and of the half's peak: |strain| or |stress|/150 GPa per radian of both halves, and where
The displacements' derivatives at the two-by-two Gauss points of every element's face, where those of quadratic elements converge
fastest (Barlow 1976), are the strain along the edge, through the depth and between; no stress acts on the edge, so that these three
give the stress (plane stress in the plane that touches it, with the crystal's compliances turned) and all six strains. Cubics through
four of those points in depth and, by least squares, six along the edge (of the same part: fillet or strip) give the peak.
error: 0.12 % rms of the peak between meshes 1 and 2 (tests/data/hinge/root_strain.csv); cost: 1 s."""
import itertools
import math

import numpy as np

YOUNGS_MPA = 150e3  # as in row.h, like these: c11, c12, c44
SILICON_MPA = (165700.0, 63900.0, 79600.0)
PAIRS = ((0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1))
GAUSS = 1 / math.sqrt(3)


def isotropic(poisson):
    s = np.zeros((6, 6))
    s[:3, :3] = -poisson / YOUNGS_MPA
    s[range(3), range(3)] = 1 / YOUNGS_MPA
    s[range(3, 6), range(3, 6)] = 2 * (1 + poisson) / YOUNGS_MPA
    return s


def silicon():
    c11, c12, c44 = SILICON_MPA
    c = np.zeros((6, 6))
    c[:3, :3] = c12
    c[range(3), range(3)] = c11
    c[range(3, 6), range(3, 6)] = c44
    return np.linalg.inv(c)


def tensor(compliance):
    """(6, 6) with engineering shears to (3, 3, 3, 3)"""
    out = np.zeros((3,) * 4)
    for (a, (i, j)), (b, (k, l)) in itertools.product(enumerate(PAIRS), repeat=2):
        value = compliance[a, b] / ((1 if a < 3 else 2) * (1 if b < 3 else 2))
        for (p, q), (r, s) in itertools.product({(i, j), (j, i)}, {(k, l), (l, k)}):
            out[p, q, r, s] = value
    return out


def lagrange(xs, ys, x):
    """the polynomial through these points"""
    return sum(y * math.prod((x - xs[j]) / (xs[i] - xs[j]) for j in range(len(xs)) if j != i) for i, y in enumerate(ys))


def nearby(xs, ys, x, n=4):
    """that through the n of them around x"""
    i = max(0, min(int(np.searchsorted(xs, x)) - n // 2, len(xs) - n))
    return lagrange(xs[i:i + n], ys[i:i + n], x)


class Edges:
    """what solid_half wrote"""

    def __init__(self, path):
        lines = [line.split() for line in path.read_text().splitlines()]
        self.along, self.layers, self.fillet, self.bricks, self.reference = map(int, lines[0][:5])
        self.rotation_um = float(lines[0][5])
        self.z = np.array(lines[1], float)
        count = 2 * self.along + 1
        self.side = []
        for rows in (lines[2:2 + count], lines[2 + count:]):
            self.side.append((np.array([r[:2] for r in rows], float), [[int(n) for n in r[2:]] for r in rows]))


def displacements(path):
    """node: displacement, of a .dat file with one step"""
    found = {}
    for line in path.read_text().splitlines():
        words = line.split()
        if len(words) == 4 and words[0].isdigit():
            found[int(words[0])] = np.array(words[1:], float)
    return found


def face_slopes(u, node, e, k, s, r):
    """derivatives of the displacement along (s) and through the depth (r) of an eight-node face, elements e and k half steps on"""
    ds, dr = np.zeros(3), np.zeros(3)
    for a, b in itertools.product((-1, 1), repeat=2):
        at = u[node[e + 1 + a][k + 1 + b]]
        ds += at * (0.25 * a * (1 + b * r) * (2 * a * s + b * r))
        dr += at * (0.25 * b * (1 + a * s) * (2 * b * r + a * s))
    for a in (-1, 1):
        at, over = u[node[e + 1 + a][k + 1]], u[node[e + 1][k + 1 + a]]
        ds += at * (0.5 * a * (1 - r * r)) - over * (s * (1 + a * r))
        dr += over * (0.5 * a * (1 - s * s)) - at * (r * (1 + a * s))
    return ds, dr


def largest(compliance, along, depth, shear, of_stress):
    """|principal| stress over 150 GPa, or strain; compliance in axes along the edge, through the depth, out of the face"""
    c = compliance
    plane = np.array([[c[0, 0, 0, 0], c[0, 0, 1, 1], 2 * c[0, 0, 0, 1]], [c[1, 1, 0, 0], c[1, 1, 1, 1], 2 * c[1, 1, 0, 1]],
                      [2 * c[0, 1, 0, 0], 2 * c[0, 1, 1, 1], 4 * c[0, 1, 0, 1]]])
    s = np.linalg.solve(plane, [along, depth, shear])
    if of_stress:
        mean, radius = (s[0] + s[1]) / 2, math.hypot((s[0] - s[1]) / 2, s[2])
        return max(abs(mean + radius), abs(mean - radius)) / YOUNGS_MPA
    stress = np.array([[s[0], s[2], 0], [s[2], s[1], 0], [0, 0, 0]])
    return np.abs(np.linalg.eigvalsh(np.einsum("ijkl,kl->ij", c, stress))).max()


def edge_values(edges, side, u, compliance, crystal_rad, of_stress):
    """values (points along, points in depth), arc length and place of the former, z of the latter"""
    place, node = edges.side[side]
    cos, sin = math.cos(crystal_rad), math.sin(crystal_rad)
    crystal = np.array([[cos, -sin, 0], [sin, cos, 0], [0, 0, 1]])
    values, arc, at, behind = [], [], [], 0.0
    for e in range(0, 2 * edges.along, 2):
        x = place[e:e + 3]
        for s in (-GAUSS, GAUSS):
            tangent = np.array([s - 0.5, -2 * s, s + 0.5]) @ x
            point = np.array([s * (s - 1) / 2, 1 - s * s, s * (s + 1) / 2]) @ x
            length = math.hypot(*tangent)
            t = np.array([*tangent / length, 0])
            axes = np.array([t, [0, 0, 1], [t[1], -t[0], 0]]) @ crystal
            turned = np.einsum("ia,jb,kc,ld,abcd->ijkl", axes, axes, axes, axes, compliance, optimize=True)
            row = []
            for k, r in itertools.product(range(0, 2 * edges.layers, 2), (-GAUSS, GAUSS)):
                ds, dr = face_slopes(u, node, e, k, s, r)
                ds, dr = ds / length, dr / ((edges.z[k + 2] - edges.z[k]) / 2)
                row.append(largest(turned, ds @ t, dr[2], ds[2] + dr @ t, of_stress))
            values.append(row)
            arc.append(behind + math.hypot(*(point - x[0])))
            at.append(point)
        behind += math.hypot(*(x[2] - x[0]))
    z = [(edges.z[k] + edges.z[k + 2] + r * (edges.z[k + 2] - edges.z[k])) / 2
         for k in range(0, 2 * edges.layers, 2) for r in (-GAUSS, GAUSS)]
    return np.array(values), np.array(arc), np.array(at), np.array(z)


def edge_peak(edges, values, arc, at, z):
    """the peak of one edge, and where"""
    depth, both = np.linspace(0, edges.z[-1], 81), np.r_[-z[::-1], z]
    fine = np.array([[nearby(both, np.r_[row[::-1], row], v) for v in depth] for row in values])
    i, k = np.unravel_index(fine.argmax(), fine.shape)
    element = i // 2
    first, last = (0, edges.fillet - 1) if element < edges.fillet else (edges.fillet, edges.along - 1)
    start = 2 * max(first, min(element - 1, last - 2))
    six = np.arange(start, min(start + 6, 2 * (last + 1)))
    cubic = np.polyfit(arc[six] - arc[i], fine[six, k], 3)
    low, high = max(arc[max(0, i - 1)], arc[six[0]]), min(arc[min(len(arc) - 1, i + 1)], arc[six[-1]])
    s = np.linspace(low, high, 81)
    value = np.polyval(cubic, s - arc[i])
    best = int(value.argmax())
    return value[best], (nearby(arc, at[:, 0], s[best]), nearby(arc, at[:, 1], s[best]), depth[k])


def half_peaks(edges, u, compliance, crystal_rad=0.0, of_stress=False, beside_middle_um=0.0):
    """rotation of the half, and the peaks of its right and left edge per radian if both halves turned alike, with their places; points
    nearer to the middle section than stated are left out: a crystal's section that is held plane is not what stands there"""
    rotation = u[edges.reference][1] / edges.rotation_um
    peaks = []
    for side in range(2):
        values, arc, at, z = edge_values(edges, side, u, compliance, crystal_rad, of_stress)
        if beside_middle_um:
            near = at[:, 1] > -beside_middle_um
            values[near] = values[np.flatnonzero(~near)[-1]]
        peaks.append(edge_peak(edges, values / (2 * abs(rotation)), arc, at, z))
    return rotation, peaks
