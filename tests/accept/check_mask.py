#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Verifies a mask's certificate from its GDSII file, with an own reader and own integer geometry, standard
library only: hashes and sizes of the files beside it, counts, grid limits, every polygon simple (an own sweep),
no vertex twice, shortest edge, sharpest corners on both sides, straight vertices, exact areas against the closed
forms and their bounds, boxes, sums of layers, necks, and that no edges of two polygons of a layer cross.

    check_mask.py masks/FLOW.json     exit status 0: all of it holds; 1: something does not"""
import hashlib
import json
import math
import pathlib
import struct
import sys


class Refused(Exception):
    """the file is not what the certificate says"""


def need(fine, what):
    if not fine:
        raise Refused(what)


# ---- GDSII ----
def boundaries(data):
    """[(layer/datatype, [(x, y), ..])] in the order of the file"""
    out, at, layer, kind, points, inside, ended = [], 0, None, None, None, False, False
    while at + 4 <= len(data) and not ended:
        length, record = struct.unpack_from(">HH", data, at)
        need(length >= 4 and length % 2 == 0 and at + length <= len(data), "a record does not fit")
        body, at = data[at + 4:at + length], at + length
        if record == 0x0800:
            inside, points = True, None
        elif record == 0x0D02:
            layer = struct.unpack(">h", body)[0]
        elif record in (0x0E02, 0x1602):
            kind = struct.unpack(">h", body)[0]
        elif record == 0x1003 and inside:
            need(points is None, "a boundary in two records")
            n = len(body) // 8
            values = struct.unpack(">%di" % (2 * n), body)
            points = list(zip(values[::2], values[1::2]))
        elif record == 0x1100 and inside:
            need(points and len(points) >= 4 and points[0] == points[-1], "a boundary is not closed")
            out.append(("%d/%d" % (layer, kind), points[:-1]))
            inside = False
        elif record in (0x0A00, 0x0B00, 0x0900):
            raise Refused("references and paths are not expected")
        elif record == 0x0305:
            need(body == bytes.fromhex("3E4189374BC6A7F03944B82FA09B5A54"), "the grid is not 1 nm")
        elif record == 0x0400:
            ended = True
    need(ended, "the file has no end")
    return out


# ---- integer geometry ----
def cross(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def sign(v):
    return (v > 0) - (v < 0)


def on(a, b, c):
    """c on the closed edge"""
    return (cross(a, b, c) == 0 and min(a[0], b[0]) <= c[0] <= max(a[0], b[0])
            and min(a[1], b[1]) <= c[1] <= max(a[1], b[1]))


def meet(a, b, c, d):
    if sign(cross(a, b, c)) * sign(cross(a, b, d)) < 0 and sign(cross(c, d, a)) * sign(cross(c, d, b)) < 0:
        return "cross"
    return "touch" if on(a, b, c) or on(a, b, d) or on(c, d, a) or on(c, d, b) else None


def pairs(edges):
    """pairs of edges whose boxes meet, each once, by a grid about as fine as the edges are long"""
    if not edges:
        return
    lengths = sorted(max(abs(b[0] - a[0]), abs(b[1] - a[1])) for a, b in edges)
    size = max(lengths[len(lengths) // 2] * 2, 1)
    cells, long_ones = {}, []
    for i, (a, b) in enumerate(edges):
        x0, x1 = sorted((a[0] // size, b[0] // size))
        y0, y1 = sorted((a[1] // size, b[1] // size))
        if (x1 - x0 + 1) * (y1 - y0 + 1) > 64:
            long_ones.append(i)
            continue
        for x in range(x0, x1 + 1):
            for y in range(y0, y1 + 1):
                cells.setdefault((x, y), []).append(i)
    seen = set()
    for members in cells.values():
        for k, i in enumerate(members):
            for j in members[k + 1:]:
                if (i, j) not in seen:
                    seen.add((i, j))
                    yield i, j
    boxes = [(min(a[0], b[0]), max(a[0], b[0]), min(a[1], b[1]), max(a[1], b[1])) for a, b in edges]
    is_long = set(long_ones)
    for i in long_ones:
        x0, x1, y0, y1 = boxes[i]
        for j, (u0, u1, v0, v1) in enumerate(boxes):
            if j != i and not (j in is_long and j < i) and u0 <= x1 and x0 <= u1 and v0 <= y1 and y0 <= v1:
                yield i, j


def sides(polygon):
    return list(zip(polygon, polygon[1:] + polygon[:1]))


def is_simple(polygon):
    n, edges = len(polygon), sides(polygon)
    if len(set(polygon)) != n:
        return False  # a vertex twice, or an edge without length
    for i in range(n):  # spikes
        a, b, c = polygon[i - 1], polygon[i], polygon[(i + 1) % n]
        if cross(a, b, c) == 0 and (a[0] - b[0]) * (c[0] - b[0]) + (a[1] - b[1]) * (c[1] - b[1]) >= 0:
            return False
    return not any((j - i) % n not in (1, n - 1) and meet(*edges[i], *edges[j]) for i, j in pairs(edges))


def area2(polygon):
    return sum(a[0] * b[1] - a[1] * b[0] for a, b in sides(polygon))


def measure(polygon):
    """shortest edge (nm), sharpest corners in material and space (degrees), straight vertices"""
    shortest, sharpest, straight = None, [180.0, 180.0], 0
    for i, b in enumerate(polygon):
        a, c = polygon[i - 1], polygon[(i + 1) % len(polygon)]
        ux, uy, vx, vy = a[0] - b[0], a[1] - b[1], c[0] - b[0], c[1] - b[1]
        turn, dot, square = ux * vy - uy * vx, ux * vx + uy * vy, vx * vx + vy * vy
        shortest = square if shortest is None else min(shortest, square)
        straight += turn == 0
        if turn:
            sharpest[turn > 0] = min(sharpest[turn > 0], math.degrees(math.atan2(abs(turn), dot)))
    return math.sqrt(shortest), sharpest[0], sharpest[1], straight


def box(polygons):
    xs, ys = [p[0] for q in polygons for p in q], [p[1] for q in polygons for p in q]
    return [min(xs), min(ys), max(xs), max(ys)]


def near(a, b, relative=1e-9):
    return abs(a - b) <= relative * max(abs(a), abs(b), 1e-300)


# ---- the certificate ----
def check_shape(shape, parts):
    name = shape["piece"]
    need(all(is_simple(p) for p in parts), name + ": a polygon is not simple")
    need(all(area2(p) > 0 for p in parts), name + ": a polygon runs the wrong way")
    total = sum(area2(p) for p in parts)
    need(total == shape["area2_nm2"], name + ": area")
    need(abs(total * 0.5e-6 - shape["area_um2"]) <= shape["area_bound_um2"] * (1 + 1e-5), name + ": area bound")
    need(box(parts) == shape["box_nm"], name + ": box")
    if len(parts) > 1:
        return  # cut for the reader: edges and corners are said of the whole
    shortest, material, space, straight = measure(parts[0])
    need(len(parts[0]) == shape["vertices"], name + ": vertices")
    need(near(shortest, shape["shortest_edge_nm"]), name + ": shortest edge")
    need(near(material, shape["sharpest_material_deg"]), name + ": sharpest corner in material")
    need(near(space, shape["sharpest_space_deg"]), name + ": sharpest corner in space")
    need(straight == shape["straight_vertices"], name + ": straight vertices")


def check_layer(layer, shapes, parts):
    name = "layer " + layer["gds"]
    need(layer["polygons"] == len(shapes) and layer["vertices"] == sum(s["vertices"] for s in shapes), name + ": counts")
    if not shapes:
        return
    need(near(layer["polygon_area_um2"], sum(s["area2_nm2"] for s in shapes) * 0.5e-6), name + ": area")
    need(near(layer["area_um2"], sum(s["area_um2"] for s in shapes)), name + ": exact area")
    need(abs(layer["polygon_area_um2"] - layer["area_um2"]) <= layer["area_bound_um2"] * (1 + 1e-5), name + ": bound")
    need(near(layer["shortest_edge_nm"], min(s["shortest_edge_nm"] for s in shapes), 1e-5), name + ": shortest edge")
    for key in ("sharpest_material_deg", "sharpest_space_deg"):
        need(near(layer[key], min(s[key] for s in shapes)), name + ": " + key)
    need(near(layer["edge_error_nm"], max(s["edge_error_nm"] for s in shapes)), name + ": edge error")
    need(layer["straight_vertices"] == sum(s["straight_vertices"] for s in shapes), name + ": straight vertices")
    need(layer["box_nm"] == box(parts), name + ": box")
    edges, owner = [], []
    for k, polygon in enumerate(parts):
        edges += sides(polygon)
        owner += [k] * len(polygon)
    for i, j in pairs(edges):
        need(owner[i] == owner[j] or meet(*edges[i], *edges[j]) != "cross", name + ": two polygons overlap")


def check_necks(document, vertices):
    for neck in document["necks"]:
        name, ends, found = "neck of " + neck["piece"], neck["ends_um"], neck["vertices_nm"]
        need(near(math.dist(*ends), neck["width_um"], 1e-6), name + ": width")
        for end, vertex in zip(ends, found):
            if vertex is None:
                continue
            need(tuple(vertex) in vertices, name + ": there is no such vertex")
            need(all(abs(v - 1e3 * e) <= 0.501 for v, e in zip(vertex, end)), name + ": vertex is not the nearest")


def check(path):
    document = json.loads(path.read_text(encoding="utf-8"))
    need(document.get("schema") == "flexwright.mask/1", "not a certificate of a mask")
    for file in document["files"]:
        data = (path.parent / file["name"]).read_bytes()
        need(len(data) == file["bytes"] and hashlib.sha256(data).hexdigest() == file["sha256"], file["name"] + ": hash")
    data = path.with_suffix(".gds").read_bytes()
    need(hashlib.sha256(data).hexdigest() == document["gds_sha256"], "hash of the GDSII file")
    found = boundaries(data)
    need(all(abs(v) < 1 << 30 for _, p in found for q in p for v in q), "a coordinate is too large")
    at, by_layer = 0, {layer["gds"]: ([], []) for layer in document["layers"]}
    for shape in document["shapes"]:
        here = found[at:at + shape["boundaries"]]
        at += shape["boundaries"]
        need(len(here) == shape["boundaries"] and all(name == shape["gds"] for name, _ in here), "order of the polygons")
        check_shape(shape, [p for _, p in here])
        by_layer[shape["gds"]][0].append(shape)
        by_layer[shape["gds"]][1].extend(p for _, p in here)
    need(at == len(found), "there are more polygons in the file")
    for layer in document["layers"]:
        check_layer(layer, *by_layer[layer["gds"]])
    check_necks(document, {v for _, p in found for v in p})
    for line in document["checks"]:
        for key in ("not_simple", "zero_edges", "spikes", "doubled_vertices"):
            need(line.get(key, 0) == 0, "the certificate itself says: " + line["statement"])
        need(line.get("worst_part", 0) <= 1, "an area is out of its bound")
    return len(found), sum(len(p) for _, p in found), len(document["files"])


def main():
    try:
        print("%d polygons, %d vertices, %d files: all is as the certificate says" % check(pathlib.Path(sys.argv[1])))
    except (Refused, KeyError, IndexError, TypeError, ValueError, OSError, struct.error) as why:
        print("REFUSED: %s: %s" % (type(why).__name__, why))
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
