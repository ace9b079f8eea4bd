# SPDX-License-Identifier: GPL-3.0-or-later
"""The plan of a whole device for tools/solids/gallery: the union of its bodies and flexures as drawn, cut where it is held, and gmsh's
triangles of six nodes in it. Edges on arcs lie on the arc: their middles too, so that a fillet has no kinks where strains are read."""
import math

import gmsh
import numpy as np
from scipy.spatial import cKDTree
from shapely.geometry import Polygon
from shapely.ops import unary_union
from shapely.vectorized import contains

from drawn import area

ROUGH = 1.5  # um by which outlines may be off where no flexure is near: corners there are rounded finely for the mask
HELD = 12.0  # widths of a flexure behind its root where the ground is held
ON_ARC = 5e-3  # um


def polygons(pieces):
    """[(body, joint, polygon, is it a hole?)]: an outline that runs clockwise is a hole of its body"""
    return [(b, j, Polygon(points), area(points) < 0) for b, j, points in pieces]


def joined(parts):
    solid = unary_union([p for p, hole in parts if not hole])
    holes = [p for p, hole in parts if hole]
    return solid.difference(unary_union(holes)) if holes else solid


class Plan:
    """the union, with the places of bodies and flexures; arcs: (cx, cy, radius) of the outlines"""

    def __init__(self, pieces, arcs):
        pieces = polygons(pieces)
        self.arcs = np.array(sorted(set(arcs))) if arcs else np.zeros((0, 3))
        self.flexures = {j: p for _, j, p, _ in pieces if j >= 0}
        self.width = {j: 2 * p.area / p.length for j, p in self.flexures.items()}
        parts, ground = {}, []
        for b, j, p, hole in pieces:
            if j < 0:
                (ground if b < 0 else parts.setdefault(b, [])).append((p, hole))
        self.bodies = {b: joined(p) for b, p in parts.items()}
        base, strips = joined(ground), self.flexures.items()
        self.near = unary_union([p.buffer(HELD * self.width[j]) for j, p in strips if p.distance(base) < 1e-3])
        self.thin = unary_union([p.buffer(-0.002) for _, p in strips])
        self.base = base.intersection(self.near)
        close = unary_union([p.buffer(2.5 * self.width[j]) for j, p in strips])
        plain = [b.intersection(close).union(b.simplify(ROUGH).difference(close)) for b in self.bodies.values()]
        whole = unary_union([*plain, *self.flexures.values(), self.base]).buffer(2e-4).buffer(-2e-4)
        if whole.geom_type != "Polygon":  # pieces of the ground that nothing hangs on
            whole = unary_union([g for g in whole.geoms if any(g.distance(p) < 1e-2 for p in self.flexures.values())])
        self.parts = [whole] if whole.geom_type == "Polygon" else list(whole.geoms)

    def sizes(self, size):
        """the length of an element at a place: along flexures, at fillets, and growing away from both"""
        least = min(self.width.values())
        strips = unary_union(list(self.flexures.values()))
        rings = [g.exterior for g in (strips.geoms if hasattr(strips, "geoms") else [strips])]
        tree = cKDTree([r.interpolate(s).coords[0] for r in rings for s in np.arange(0, r.length, 0.5 * least)])
        close = unary_union([p.buffer(self.width[j]) for j, p in self.flexures.items()])
        points, lengths = [], []
        for part in self.parts:
            for ring in [part.exterior, *part.interiors]:
                xy = np.array(ring.simplify(2e-3).coords)
                middle, d = (xy[:-1] + xy[1:]) / 2, np.hypot(*np.diff(xy, axis=0).T)
                short = (d < 0.6 * size * least) & contains(close, *middle.T)  # chords of a fillet
                points += list(middle[short])
                lengths += list(np.maximum(d[short], 0.05 * least))
        fillets = cKDTree(points) if points else None

        def fine(x, y):
            s = min(size * least + 0.5 * max(0.0, tree.query((x, y))[0] - least), 120.0)
            if fillets is not None:
                far, i = fillets.query((x, y))
                s = min(s, lengths[i] + 0.3 * far)
            return s
        return fine

    def mesh(self, size):
        """nodes (n, 2) and triangles of six nodes, their corners counter-clockwise"""
        gmsh.initialize()
        gmsh.option.setNumber("General.Terminal", 0)
        geo, fine = gmsh.model.geo, self.sizes(size)
        for part in self.parts:
            loops = []
            for ring in [part.exterior, *part.interiors]:
                points = [geo.addPoint(x, y, 0) for x, y in list(ring.simplify(2e-3).coords)[:-1]]
                lines = [geo.addLine(a, b) for a, b in zip(points, points[1:] + points[:1])]
                loops.append(geo.addCurveLoop(lines))
            geo.addPlaneSurface(loops)
        geo.synchronize()
        gmsh.model.mesh.setSizeCallback(lambda dim, tag, x, y, z: fine(x, y))
        gmsh.option.setNumber("Mesh.MeshSizeExtendFromBoundary", 0)
        gmsh.option.setNumber("Mesh.MeshSizeFromPoints", 0)
        gmsh.option.setNumber("Mesh.Algorithm", 6)
        gmsh.model.mesh.generate(2)
        gmsh.model.mesh.setOrder(2)
        tags, at, _ = gmsh.model.mesh.getNodes()
        place = {t: i for i, t in enumerate(tags)}
        _, _, nodes = gmsh.model.mesh.getElements(2)
        tri = np.array([place[t] for t in nodes[0]]).reshape(-1, 6)
        xy = at.reshape(-1, 3)[:, :2]
        gmsh.finalize()
        used, tri = np.unique(tri, return_inverse=True)
        tri, xy = tri.reshape(-1, 6), xy[used].copy()
        a, b, c = xy[tri[:, 0]], xy[tri[:, 1]], xy[tri[:, 2]]
        turned = (b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0] < 0
        tri[turned] = tri[turned][:, [0, 2, 1, 5, 4, 3]]
        edges = rim(tri)
        self.bend(xy, edges)
        return xy, tri, edges

    def bend(self, xy, edges):
        """middles of edges of the rim onto the arcs that both ends lie on"""
        for a, m, b in edges:
            for cx, cy, r in self.arcs:
                if abs(math.hypot(xy[a][0] - cx, xy[a][1] - cy) - r) > ON_ARC or abs(math.hypot(xy[b][0] - cx, xy[b][1] - cy) - r) > ON_ARC:
                    continue
                to = (xy[a] + xy[b]) / 2 - (cx, cy)
                far, chord = math.hypot(*to), math.hypot(*(xy[a] - xy[b]))
                if r - ON_ARC > far > 0 and r - far < 0.12 * chord:
                    xy[m] = np.array((cx, cy)) + to * (r / far)
                    break


def rim(tri):
    """[(corner, middle, corner)] of edges that one triangle alone has, the solid to their left"""
    seen = {}
    for t in tri:
        for a, m, b in ((t[0], t[3], t[1]), (t[1], t[4], t[2]), (t[2], t[5], t[0])):
            if (b, a) in seen:
                del seen[b, a]
            else:
                seen[a, b] = m
    return [(a, m, b) for (a, b), m in seen.items()]
