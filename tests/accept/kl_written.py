# SPDX-License-Identifier: GPL-3.0-or-later
# kl_written.py: klayout -b -r kl_written.py -rd jobs=JOBS.json -rd result=RESULT.json
# Of each {"gds": FILE, "layer": "1/0", "kind": "width" or "space", "limit": NM, "shielded": BOOL} the pairs of whole edges of the
# merged layer that KLayout's Euclidian check with an ignore angle of 90 degrees finds: a list of [VALUE, SQUARE, X1, Y1, .., Y4].
# VALUE: the greater of the two distances that the check asks for, nm, from whole numbers. SQUARE: the two edges enclose 90 degrees but
# for what rounding their ends to the grid can do.
import json
import math

import pya


def left(e, p):
    return (e[2] - e[0]) * (p[1] - e[1]) - (e[3] - e[1]) * (p[0] - e[0])


def distance(e, p):
    dx, dy = e[2] - e[0], e[3] - e[1]
    ux, uy, square = p[0] - e[0], p[1] - e[1], dx * dx + dy * dy
    along = ux * dx + uy * dy
    if along <= 0:
        return math.hypot(ux, uy)
    if along >= square:
        return math.hypot(p[0] - e[2], p[1] - e[3])
    return abs(dx * uy - dy * ux) / math.sqrt(square)


def apart(e, f):
    return min(distance(e, f[:2]), distance(e, f[2:]), distance(f, e[:2]), distance(f, e[2:]))


def cut(e, f, sign):
    """what of e is on that side of f"""
    a, b = sign * left(f, e[:2]), sign * left(f, e[2:])
    if a >= 0 and b >= 0:
        return e
    x, y = e[0] + a / (a - b) * (e[2] - e[0]), e[1] + a / (a - b) * (e[3] - e[1])
    return (x, y, e[2], e[3]) if a < 0 else (e[0], e[1], x, y)


def value(e, f, sign):
    return max(apart(cut(e, f, sign), f), apart(e, cut(f, e, sign)))


def numbers(edge):
    return edge.p1.x, edge.p1.y, edge.p2.x, edge.p2.y


def is_square(e, f):
    u, v = (e[2] - e[0], e[3] - e[1]), (f[2] - f[0], f[3] - f[1])
    return abs(u[0] * v[0] + u[1] * v[1]) <= math.sqrt(2) * (math.hypot(*u) + math.hypot(*v)) + 2


regions = {}


def region(gds, layer):
    if (gds, layer) not in regions:
        layout = pya.Layout()
        layout.read(gds)
        number, kind = (int(v) for v in layer.split("/"))
        regions[gds, layer] = pya.Region(layout.top_cell().begin_shapes_rec(layout.layer(number, kind))).merged()
    return regions[gds, layer]


def judge(job):
    where = region(job["gds"], job["layer"])
    run, sign = (where.width_check, -1) if job["kind"] == "width" else (where.space_check, 1)  # material on the right of edges
    out = []
    for pair in run(job["limit"], True, pya.Region.Euclidian, 90.0, None, None, job["shielded"]).each():
        e, f = sorted((numbers(pair.first), numbers(pair.second)))
        out.append([value(e, f, sign), is_square(e, f), *e, *f])
    return out


json.dump([judge(job) for job in json.load(open(jobs, encoding="utf-8"))], open(result, "w", encoding="utf-8"))
