# SPDX-License-Identifier: GPL-3.0-or-later
"""Plane meshes of flexures with their fillets and a block at either end, of quadratic quadrangles, and devices of them as
decks of CalculiX. The frame of a flexure has its first root at the origin and its strip along +x there."""
import math

import strip

ALONG, ACROSS = 24, 10  # elements along a fillet and from there to the strip's middle, at density 1
# What bodies are made of, over the strips' modulus. They are wide, and Newton's method turns them along tangents: far stiffer
# ones get so much stress from a step that it does not come to rest.
STIFFER = 10
# Depth of the solid, um. ccx makes plane stress of bricks whose faces may bulge but bear shear when they do so unevenly: where
# the depth is not small beside a width, a strip bends as in plane strain (nu^2 = 5 % stiffer). Forces go with it.
THIN = 0.5


class Line:
    """centre line and edges of a strip by the way from its first root"""

    def __init__(self, pieces):
        self.pieces, self.starts, x, y, turned, way = pieces, [], 0.0, 0.0, 0.0, 0.0
        for piece in pieces:
            self.starts.append((way, x, y, turned))
            x, y = self.ahead(piece, piece.length, x, y, turned)
            turned, way = turned + piece.curvature * piece.length, way + piece.length
        self.length, self.end = way, (x, y, turned)

    @staticmethod
    def ahead(piece, s, x, y, turned):
        k = piece.curvature
        if k == 0:
            return x + s * math.cos(turned), y + s * math.sin(turned)
        return x + (math.sin(turned + k * s) - math.sin(turned)) / k, y + (math.cos(turned) - math.cos(turned + k * s)) / k

    def reverse(self):
        return Line([strip.Piece(p.length, -p.curvature, *p.widths[::-1]) for p in self.pieces[::-1]])

    def point(self, s, side):
        """place on the left edge (side 1), the right edge (-1) or the centre line (0)"""
        i = max(k for k, start in enumerate(self.starts) if k == 0 or s >= start[0])
        piece, (way, x, y, turned) = self.pieces[i], self.starts[i]
        x, y = self.ahead(piece, s - way, x, y, turned)
        if side == 0:
            return x, y
        psi, outside = turned + piece.curvature * (s - way), -side if piece.curvature > 0 else side
        off = side * piece.widths[0] / 2 if piece.even else abs(piece.edge(outside, (s - way) / piece.length)) * side
        return x - off * math.sin(psi), y + off * math.cos(psi)

    def fillet(self, rho, side):
        """(way of its end on the edge, its centre, direction from there to that end) beside the block at x < 0"""
        def at(s):
            (x0, y0), (x1, y1), (x, y) = (self.point(v, side) for v in (s - 1e-4, s + 1e-4, s))
            size = math.hypot(x1 - x0, y1 - y0) * side
            nx, ny = -(y1 - y0) / size, (x1 - x0) / size
            return x + rho * (nx - 1), (x + rho * nx, y + rho * ny), math.atan2(-ny, -nx)

        low, high = 1e-3 * rho, 4 * rho
        for _ in range(60):
            middle = (low + high) / 2
            low, high = (middle, high) if at(middle)[0] < 0 else (low, middle)
        return low, *at(low)[1:]


class Mesh:
    """nodes and elements of a flexure; `edges` are the nodes of fillets and strip, by their place on it"""

    def __init__(self, flexure, density):
        self.flexure, self.number, self.nodes, self.elements, self.edges = flexure, {}, [], [], {}
        self.along, self.across, self.density = 3 * max(2, round(ALONG * density / 3)), max(3, round(ACROSS * density)), density
        line, rho, self.width = Line(flexure.pieces), flexure.fillet, flexure.pieces[0].widths[0]
        x, y, psi = line.end
        c, s = math.cos(psi), math.sin(psi)
        # of two roots: the strip as seen from there, and where that is
        ends = (line, lambda p: p), (line.reverse(), lambda p: (x - c * p[0] + s * p[1], y - s * p[0] - c * p[1]))
        self.faces, self.begins, shift = [], [], []
        for which, (seen, place) in enumerate(ends):
            fillets = {side: seen.fillet(rho, side) for side in (1, -1)}
            begin = max(found[0] for found in fillets.values())
            shift.append((begin, {side: found[0] - begin for side, found in fillets.items()}))
            self.block(which, seen, place, rho, begin, fillets)
            self.begins.append(self.node(place(seen.point(begin, 0))))  # where the fillets end, in the middle
        self.strip(line, *shift)
        self.check()

    def check(self):
        """sides of elements that have no neighbour are one closed line: nothing is cracked, and all turn the same way"""
        sides = {side for e in self.elements for side in zip(e[:4], e[1:4] + e[:1])}
        free = {one: two for one, two in sides if (two, one) not in sides}
        first = place = next(iter(free))
        for count in range(1, len(free) + 1):
            place = free[place]
            if place == first:
                break
        if count != len(free) or len(sides) != 4 * len(self.elements):
            raise RuntimeError("the mesh of a flexure is cracked")

    def node(self, p):
        """number of the place, which patches that meet there may know a little differently"""
        i, j = round(p[0] * 1e4), round(p[1] * 1e4)
        for key in ((i + a, j + b) for a in (0, 1, -1) for b in (0, 1, -1)):
            k = self.number.get(key)
            if k is not None and abs(self.nodes[k][0] - p[0]) + abs(self.nodes[k][1] - p[1]) < 1e-5:
                return k
        self.number[i, j] = len(self.nodes)
        self.nodes.append(p)
        return self.number[i, j]

    def patch(self, place, n, m):
        """quadratic elements; place(i, j) of half steps"""
        grid = [[self.node(place(i, j)) if i % 2 == 0 or j % 2 == 0 else 0 for j in range(2 * m + 1)]
                for i in range(2 * n + 1)]
        for i in range(0, 2 * n, 2):
            for j in range(0, 2 * m, 2):
                ring = [grid[i][j], grid[i][j + 1], grid[i][j + 2], grid[i + 1][j + 2], grid[i + 2][j + 2],
                        grid[i + 2][j + 1], grid[i + 2][j], grid[i + 1][j]]
                x = [self.nodes[k] for k in ring[::2]]
                if sum(x[k - 1][0] * x[k][1] - x[k][0] * x[k - 1][1] for k in range(4)) < 0:
                    ring = [ring[0]] + ring[:0:-1]
                self.elements.append(ring[::2] + ring[1::2])
        return grid

    def graded(self, j):
        """share of the way from the edge to the middle, the same at both roots and between them"""
        finer = 3 + 3.5 * math.log10(max(1, 0.5 * self.width / self.flexure.fillet))
        return math.expm1(finer * j / (2 * self.across)) / math.expm1(finer)

    def block(self, which, line, place, rho, begin, fillets):
        t = line.pieces[0].widths[0]
        wide, high, n = rho + 5 * t, 6 * t, self.along
        jx, jy = line.point(begin, 0)
        grow = lambda v: math.expm1(3 * v) / math.expm1(3)
        for side, (_, centre, first) in fillets.items():
            sweep = (math.pi - first + math.pi) % (2 * math.pi) - math.pi

            def spot(i, j, sweep=sweep, centre=centre, first=first):
                """between the fillet and the middle of the block up to its far face, and that as high as the fillet"""
                g, a, part = self.graded(j), first + i / (2 * n) * sweep, 3 * i / (4 * n)
                x0, y0 = centre[0] + rho * math.cos(a), centre[1] + rho * math.sin(a)
                near = grow(min(part, 1))  # or elements beside the fillet's end lean
                x1, y1 = (jx - near * (wide + jx), jy * (1 - near)) if part < 1 else (-wide, (2 * part - 2) * centre[1])
                return place((x0 + g * (x1 - x0), y0 + g * (y1 - y0)))

            def above(i, j, side=side, centre=centre):
                """the rest of the half, beside the face that the strip stands on"""
                return place((-wide * self.graded(j), centre[1] + side * high * grow(i / (2 * n / 3))))

            grid = self.patch(spot, n, self.across)
            for row in grid:
                self.edges[row[0]] = which
            far = grid[4 * n // 3:] + self.patch(above, n // 3, self.across)[1:]
            self.faces.append([row[2 * self.across] for row in far])
        one, two = self.faces[-2:]  # a far face: from its middle out, to both sides
        self.faces[-2:] = [two[:0:-1] + one]

    def stations(self, line, first, last):
        """ways of the elements' ends, fine at the roots"""
        finest, most = 0.06 * self.width / self.density, (2.5 if self.density > 0.4 else 4) * self.width / max(1, self.density)
        out = [first]
        for k, piece in enumerate(line.pieces):
            low, high = max(first, line.starts[k][0]), min(last, line.starts[k][0] + piece.length)
            cap = min(most, piece.radius * math.radians(8) / max(1, self.density))
            n = 2000
            at = [low + (high - low) * (i + 0.5) / n for i in range(n)]
            dense = [1 / min(cap, finest + 0.4 / self.density * min(s - first, last - s),
                             0.3 * self.width + 0.5 * abs(s - (first + last) / 2)) for s in at]
            parts = max(1, math.ceil(sum(dense) * (high - low) / n))
            total, done, goal = sum(dense), 0.0, 1
            for s, d in zip(at, dense):
                done += d
                while goal < parts and done >= total * goal / parts:
                    out.append(s - (done - total * goal / parts) / d * (high - low) / n + (high - low) / n / 2)
                    goal += 1
            out.append(high)
        return out

    def strip(self, line, one, two):
        begin, end, t = one[0], line.length - two[0], self.width
        ways = self.stations(line, begin, end)
        ways = [ways[i // 2] if i % 2 == 0 else (ways[i // 2] + ways[i // 2 + 1]) / 2 for i in range(2 * len(ways) - 1)]
        self.middle = []  # nodes of the section in the middle of the strip
        half = min(range(0, len(ways), 2), key=lambda i: abs(ways[i] - (begin + end) / 2))
        for side in (1, -1):
            def spot(i, j, side=side):
                s = ways[i]
                near = max(0, 1 - (s - begin) / (3 * t)) * one[1][side] - max(0, 1 - (end - s) / (3 * t)) * two[1][-side]
                (x0, y0), (x1, y1), g = line.point(s + near, side), line.point(s, 0), self.graded(j)
                return x0 + g * (x1 - x0), y0 + g * (y1 - y0)

            grid = self.patch(spot, len(ways) // 2, self.across)
            for row in grid:
                self.edges.setdefault(row[0], 2)
            self.middle.append(grid[half])
        self.middle = self.middle[1] + self.middle[0][-2::-1]  # from the right edge to the left


class Deck:
    """input of ccx: strips of one material and depth, bodies of stiff triangles, and what acts on them"""

    def __init__(self, modulus, nu, depth):
        self.nodes, self.elements, self.stiff, self.fixed, self.rows, self.forces = [], [], [], [], [], []
        self.material = modulus, nu, depth  # of the device

    def node(self, x, y):
        self.nodes.append((x, y))
        return len(self.nodes)

    def add(self, mesh, x, y, angle):
        """number of the mesh's first node"""
        c, s, first = math.cos(angle), math.sin(angle), len(self.nodes) + 1
        self.nodes += [(x + c * p - s * q, y + s * p + c * q) for p, q in mesh.nodes]
        self.elements += [[first + k for k in element] for element in mesh.elements]
        return first

    def tie(self, face, hub):
        """holds the nodes of a face on a body, which has two nodes"""
        wanted = [[one, two, node] for one, two in zip(face, face[1:]) for node in hub] + [[face[len(face) // 2], *hub]]
        for (x0, y0), (x1, y1), (x2, y2), triangle in ([self.nodes[k - 1] for k in three] + [three] for three in wanted):
            if abs((x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)) > 1e-3 * math.hypot(x1 - x0, y1 - y0) * 10:
                self.stiff.append(triangle)  # one whose nodes are in line holds nothing

    def given(self, terms, value):
        """sum of factor * displacement over (node, way, factor) is `value`"""
        spare = self.node(0, 0)
        terms = sorted(terms, key=lambda v: -abs(v[2]))  # the first is what the others are made to give
        self.rows.append(["%d, %d, %.12g" % v for v in terms + [(spare, 1, -1.0)]])
        self.fixed.append((spare, 1, value))

    def text(self):
        modulus, nu, depth = self.material
        out = ["*NODE"] + ["%d, %.12g, %.12g, 0" % (k + 1, *p) for k, p in enumerate(self.nodes)]
        for name, kind, elements, first in (("ALL", "CPS8R", self.elements, 1),
                                            ("STIFF", "CPS3", self.stiff, len(self.elements) + 1)):
            if elements:
                out.append("*ELEMENT, TYPE=%s, ELSET=%s" % (kind, name))
                out += ["%d, %s" % (first + k, ", ".join(map(str, e))) for k, e in enumerate(map(self.turn, elements))]
        for name, of, number in (("ALL", modulus, nu), ("STIFF", STIFFER * modulus, 0)):
            out += ["*MATERIAL, NAME=" + name, "*ELASTIC", "%.12g, %g" % (of, number),
                    "*SOLID SECTION, ELSET=%s, MATERIAL=%s" % (name, name), "%.12g" % THIN]
        for row in self.rows:
            out += ["*EQUATION", str(len(row))] + row
        # no increment is given up before Newton's method has had its time: slender strips take many rounds
        out += ["*STEP, NLGEOM, INC=400", "*CONTROLS, PARAMETERS=TIME INCREMENTATION", "20, 30, 9, 80, 10, 4, , 80, , ",
                "*STATIC", "0.25, 1", "*BOUNDARY"] + ["%d, %d, %d, %.12g" % (k, i, i, v) for k, i, v in self.fixed]
        if self.forces:
            out += ["*CLOAD"] + ["%d, %d, %.12g" % (k, way, v * THIN / depth) for k, way, v in self.forces]
        out += ["*NODE FILE, FREQUENCY=1000", "U", "*EL FILE, FREQUENCY=1000", "S", "*END STEP"]
        return "\n".join(out) + "\n"

    def turn(self, element):
        """triangles counted the right way round"""
        if len(element) > 3:
            return element
        (x0, y0), (x1, y1), (x2, y2) = (self.nodes[k - 1] for k in element)
        return element if (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0) > 0 else [element[0], element[2], element[1]]
