# SPDX-License-Identifier: GPL-3.0-or-later
"""Own readers of the masks' files, from their specifications, and the distance between exact outlines and polygons.

An outline is an array with one row per line or arc: start x y, end x y, centre x y, radius, start angle, sweep (radius 0: a
line), in um. Formulas: SVG 1.1 appendix F.6.5 (centre of an arc from its ends); bulge = tan(sweep / 4) (AutoCAD R12)."""
import math
import re
import struct
import xml.etree.ElementTree as ET

import numpy as np

SVG = "{http://www.w3.org/2000/svg}"
XLINK = "{http://www.w3.org/1999/xlink}"
MARGIN_UM = 150.0  # of the page around the drawing


def line(a, b):
    return (*a, *b, 0.0, 0.0, 0.0, 0.0, 0.0)


def arc(a, b, centre, sweep):
    return (*a, *b, *centre, math.dist(a, centre), math.atan2(a[1] - centre[1], a[0] - centre[0]), sweep)


def svg_arc(a, b, radius, large, positive):
    """F.6.5 for a circle; y still points down: `positive` sweeps are clockwise to the eye"""
    chord = math.dist(a, b)
    lift = math.sqrt(max(radius * radius - chord * chord / 4, 0.0)) * (-1 if large == positive else 1)
    middle = ((a[0] + b[0]) / 2, (a[1] + b[1]) / 2)
    centre = (middle[0] - lift * (b[1] - a[1]) / chord, middle[1] + lift * (b[0] - a[0]) / chord)
    sweep = math.atan2(b[1] - centre[1], b[0] - centre[0]) - math.atan2(a[1] - centre[1], a[0] - centre[0])
    if positive and sweep < 0:
        sweep += 2 * math.pi
    if not positive and sweep > 0:
        sweep -= 2 * math.pi
    return arc(a, b, centre, sweep)


def path_outline(text):
    """M, L, A and Z, absolute, as the mask's writer uses them"""
    rows, at, first = [], None, None
    for letter, numbers in re.findall(r"([A-Za-z])([^A-Za-z]*)", text):
        value = [float(n) for n in re.findall(r"[-+0-9.eE]+", numbers)]
        if letter == "M":
            at = first = tuple(value)
        elif letter == "L":
            rows.append(line(at, tuple(value)))
            at = tuple(value)
        elif letter == "A":
            if value[0] != value[1]:
                raise ValueError("an arc that is no circle")
            rows.append(svg_arc(at, tuple(value[5:7]), value[0], value[3] != 0, value[4] != 0))
            at = tuple(value[5:7])
        elif letter == "Z":
            if math.dist(at, first) > 1e-9:
                rows.append(line(at, first))
        else:
            raise ValueError("path command " + letter)
    return np.array(rows)


def read_svg(path, extent):
    """{layer/datatype: [outline]} in the world; extent: x0 y0 x1 y1 of the certificate"""
    found, named = {}, {}
    root = ET.parse(path).getroot()
    for element in root.iter(SVG + "path"):
        named["#" + element.get("id", "")] = element
    for group in root.iter(SVG + "g"):
        if group.get("data-gds") is None:
            continue
        shapes = found.setdefault(group.get("data-gds"), [])
        for element in group:
            if element.tag == SVG + "path":
                o = path_outline(element.get("d"))
            elif element.tag == SVG + "use":  # a copy, moved
                o = path_outline(named[element.get(XLINK + "href")].get("d"))
                o[:, [0, 2, 4]] += float(element.get("x"))
                o[:, [1, 3, 5]] += float(element.get("y"))
            else:
                continue
            o[:, [0, 2, 4]] += extent[0] - MARGIN_UM
            o[:, [1, 3, 5]] = extent[3] + MARGIN_UM - o[:, [1, 3, 5]]
            o[:, 7:9] = -o[:, 7:9]  # y turned round
            shapes.append(o)
    return found


def read_dxf(path, layers):
    """the same of POLYLINEs with bulges; layers: {name: layer/datatype}"""
    with open(path, encoding="ascii") as file:
        text = file.read().split("\n")
    groups = [(int(text[i]), text[i + 1]) for i in range(0, len(text) - 1, 2)]
    found, points, layer, kind = {}, None, None, None
    for code, value in groups:
        if code == 0:
            if value == "POLYLINE":
                points, layer = [], None
            elif value == "VERTEX":
                points.append([0.0, 0.0, 0.0])
            elif value == "SEQEND":
                found.setdefault(layers[layer], []).append(bulged(points))
                points = None
            kind = value
        elif kind == "POLYLINE" and code == 8:
            layer = value
        elif kind == "VERTEX" and code in (10, 20, 42):
            points[-1][(10, 20, 42).index(code)] = float(value)
    return found


def bulged(points):
    rows = []
    for (ax, ay, bulge), (bx, by, _) in zip(points, points[1:] + points[:1]):
        if bulge == 0:
            rows.append(line((ax, ay), (bx, by)))
            continue
        h = (1 - bulge * bulge) / (4 * bulge)  # of the centre above the chord, in chords: cot(sweep / 2) / 2
        centre = ((ax + bx) / 2 - h * (by - ay), (ay + by) / 2 + h * (bx - ax))
        rows.append(arc((ax, ay), (bx, by), centre, 4 * math.atan(bulge)))
    return np.array(rows)


def read_gds(path):
    """{layer/datatype: [array of vertices in nm]}: boundaries of a file with one cell"""
    with open(path, "rb") as file:
        data = file.read()
    found, at, inside, layer, kind = {}, 0, False, 0, 0
    while at + 4 <= len(data):
        length, record = struct.unpack(">HB", data[at:at + 3])
        if length < 4:
            break
        body = data[at + 4:at + length]
        if record == 0x08:
            inside = True
        elif record == 0x11:
            inside = False
        elif record == 0x0d:
            layer = struct.unpack(">H", body)[0]
        elif record == 0x0e:
            kind = struct.unpack(">H", body)[0]
        elif record == 0x10 and inside:
            points = np.frombuffer(body, ">i4").astype(np.int64).reshape(-1, 2)
            if (points[0] != points[-1]).any():
                raise ValueError("a boundary that is not closed")
            found.setdefault("%d/%d" % (layer, kind), []).append(points[:-1])
        at += length
    return found


def area(outline):
    """Green's theorem: of the polygon of the ends, and the circular segments; um2"""
    ax, ay, bx, by, r, s = outline[:, 0], outline[:, 1], outline[:, 2], outline[:, 3], outline[:, 6], outline[:, 8]
    ox, oy = ax[0], ay[0]
    return float(np.sum((ax - ox) * (by - oy) - (bx - ox) * (ay - oy) + r * r * (s - np.sin(s))) / 2)


def to_lines(px, py, ax, ay, dx, dy):
    """distance of every point, a column, to the nearest line, um"""
    t = ((px - ax) * dx + (py - ay) * dy) / np.maximum(dx * dx + dy * dy, 1e-30)
    np.minimum(np.maximum(t, 0, out=t), 1, out=t)
    ex, ey = px - ax - t * dx, py - ay - t * dy
    return np.sqrt((ex * ex + ey * ey).min(axis=1))


def to_arcs(px, py, rows):
    ax, ay, bx, by, cx, cy, r, start, sweep = rows.T
    qx, qy = px - cx, py - cy
    turn = np.mod((np.arctan2(qy, qx) - start) * np.sign(sweep), 2 * math.pi)
    ends = np.minimum((px - ax) ** 2 + (py - ay) ** 2, (px - bx) ** 2 + (py - by) ** 2)
    on = (np.sqrt(qx * qx + qy * qy) - r) ** 2
    return np.sqrt(np.where(turn <= np.abs(sweep), np.minimum(on, ends), ends).min(axis=1))


def to_outline(points, outline):
    """distance of every point (n, 2) to an outline, um"""
    straight = outline[outline[:, 6] == 0]
    round_ = outline[outline[:, 6] != 0]
    best = np.full(len(points), np.inf)
    step = max(1, 200000 // len(outline))
    for i in range(0, len(points), step):
        px, py, here = points[i:i + step, :1], points[i:i + step, 1:], best[i:i + step]
        if len(straight):
            ax, ay, bx, by = straight[:, :4].T
            here[:] = to_lines(px, py, ax, ay, bx - ax, by - ay)
        if len(round_):
            np.minimum(here, to_arcs(px, py, round_), out=here)
    return best


def to_polygon(points, polygon):
    """distance of every point to a polygon's edges, um"""
    d = np.roll(polygon, -1, axis=0) - polygon
    step = max(1, 200000 // len(polygon))
    return np.concatenate([to_lines(points[i:i + step, :1], points[i:i + step, 1:], polygon[:, 0], polygon[:, 1], d[:, 0], d[:, 1])
                           for i in range(0, len(points), step)])


def samples(outline, parts=3):
    """points on it, the middles of so many parts of every row"""
    t = (np.arange(parts) + 0.5) / parts
    out = []
    for ax, ay, bx, by, cx, cy, r, start, sweep in outline:
        if r == 0:
            out.append(np.column_stack((ax + t * (bx - ax), ay + t * (by - ay))))
        else:
            out.append(np.column_stack((cx + r * np.cos(start + t * sweep), cy + r * np.sin(start + t * sweep))))
    return np.concatenate(out)


def flat(outline, sagitta_um):
    """vertices of chords no farther than that from the arcs, in nm, rounded"""
    out = []
    for ax, ay, _, _, cx, cy, r, start, sweep in outline:
        n = 1 if r == 0 else max(1, math.ceil(abs(sweep) / (2 * math.acos(1 - min(sagitta_um / r, 1)))))
        if n == 1:
            out.append((ax, ay))
        else:
            t = start + sweep / n * np.arange(n)
            out.append(np.column_stack((cx + r * np.cos(t), cy + r * np.sin(t))))
    return np.rint(np.vstack(out) * 1000).astype(int).tolist()


def compare(outlines, polygons, nearest_um):
    """Polygons (um) against outlines in the same order, a polygon being whole or one of the parts of an outline: largest distance
    of a vertex from its outline, of an edge from it, of the outline from the edges (whole ones only), um; and whether each
    outline was met."""
    vertex = edge = back = 0.0
    k, parts = 0, [[] for _ in outlines]
    for polygon in polygons:
        while k < len(outlines):
            d = to_outline(polygon, outlines[k]).max()
            if d <= nearest_um:
                break
            if not parts[k]:
                return d, edge, back, False
            k += 1
        if k == len(outlines):
            return math.inf, edge, back, False
        vertex = max(vertex, d)
        parts[k].append(polygon)
    for outline, group in zip(outlines, parts):
        if not group:
            return vertex, edge, back, False
        if len(group) == 1:
            polygon, after = group[0], np.roll(group[0], -1, axis=0)
            for t in (0.25, 0.5, 0.75):
                edge = max(edge, to_outline(polygon + t * (after - polygon), outline).max())
            back = max(back, to_polygon(samples(outline), polygon).max())
    return vertex, edge, back, True


def same(first, second):
    """largest distance of the ends and middles of the rows of the first outlines from the second, in their order, um; infinite
    where the numbers differ"""
    if len(first) != len(second):
        return math.inf
    return max(to_outline(np.vstack((p[:, :2], samples(p, 1))), q).max() for p, q in zip(first, second)) if first else 0.0
