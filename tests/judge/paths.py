#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""paths.py [--seed N] [--count N] [--density N] [--forces] [--one] [--silicon]: random strips of several pieces as solids of full depth
in CalculiX (ccx), as lines of tests/data/hinge/paths.csv: their stiffness and the peak of their strain per radian under a pure moment.
With --forces as lines of forces.csv: how far the second block's strip end turns and goes under a moment and two forces there, in the
frame of the first one (tangent +x); --one: of one line or arc whose width varies; --silicon: of a (100) wafer turned by a random angle.

Two or three lines and arcs, of either sense, whose widths go on from one to the next; half the depth (its middle plane stays
plane) of C3D20R, the plane mesh of mesh.py in layers that grow thinner towards the free face; one block's far face is held, the
other's turns as a rigid one. The strain is that of the sides of the elements along the edges, a quadratic side's in its middle.
Linear. What such a mesh has too little is said in README.md."""
import argparse
import math
import os
import pathlib
import random
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import mesh  # noqa: E402
import strip  # noqa: E402

MODULUS = 150e3  # MPa


def one_piece(seed):
    """the same of one line or arc, 0.62 to 1.6 times as wide in its middle as at its ends"""
    source = random.Random(seed)
    between = lambda low, high: low + (high - low) * source.random()
    t, curvature = round(between(4, 12), 3), 0.0
    middle = round(t * between(0.62, 1.6), 3)
    if source.random() < 0.5:
        radius, angle = round(between(8, 30) * t, 3), math.radians(round(between(100, 300), 1))
        curvature, length = 1 / radius, radius * angle
    else:
        length = round(between(17, 70) * t, 3)
    narrow = min(t, middle)
    return ([strip.Piece(length, curvature, t, middle, t)], round(narrow * between(0.12, 1), 3), round(between(0.8, 14) * narrow, 2),
            round(between(0.15, 0.35), 3))


def shape(seed):
    """(pieces, fillet, depth, Poisson's ratio), um"""
    source = random.Random(seed)
    between = lambda low, high: low + (high - low) * source.random()
    n, t = 2 + (source.random() < 0.5), between(4, 12)
    narrow, width, pieces = t, t, []
    for _ in range(n):
        last = width if source.random() < 0.4 else min(max(width * between(0.8, 1.25), 0.7 * t), 1.4 * t)
        last, length = round(last, 3), between(6, 22) * t
        curvature = 0.0
        if source.random() < 0.6 or (pieces and pieces[-1].curvature == 0):
            radius = max(between(8, 30) * t, length / math.radians(190))
            curvature = (1 if source.random() < 0.5 else -1) / round(radius, 3)
        pieces.append(strip.Piece(round(length, 3), curvature, round(width, 3), (round(width, 3) + last) / 2, last))
        width, narrow = last, min(narrow, last)
    fillet = round(narrow * between(0.12, 1), 3)
    return pieces, fillet, round(between(0.8, 10) * narrow, 2), round(between(0.15, 0.35), 3)


def heights(h, t):
    """of the nodes over the middle plane; every second one is between two layers"""
    n = max(5, min(9, round(4 + h / 2 / t)))  # three have 4 % less strain
    sizes = [1 / (1 + 0.6 * i) for i in range(n)]
    levels = [sum(sizes[:i]) / sum(sizes) * h / 2 for i in range(n + 1)]
    return [v for low, high in zip(levels, levels[1:]) for v in (low, (low + high) / 2)] + [h / 2]


def group(name, numbers):
    numbers = sorted(numbers)
    return ["*NSET, NSET=" + name] + [", ".join(map(str, numbers[i:i + 12])) for i in range(0, len(numbers), 12)]


def elastic(nu, first):
    """(what comes before the material, its stiffness) for ccx; first: [100] of a (100) wafer of silicon from x, or None: isotropic"""
    if first is None:
        return [], ["*ELASTIC", "%g, %g" % (MODULUS, nu)]
    c11, c12, c44 = 165.7e3, 63.9e3, 79.6e3  # as in strip.Silicon
    c, s = math.cos(first), math.sin(first)
    return (["*ORIENTATION, NAME=CRYSTAL", "%.12g, %.12g, 0, %.12g, %.12g, 0" % (c, s, -s, c)],
            ["*ELASTIC, TYPE=ORTHO", "%g, %g, %g, %g, %g, %g, %g, %g," % (c11, c12, c11, c12, c12, c11, c44, c44), "%g" % c44])


def deck(made, end, h, nu, first=None, forces=False):
    """(input of ccx, number of a plane node at a height, node that turns); forces: a step for the moment and one for each force"""
    z = heights(h, made.width)
    corners = {k for e in made.elements for k in e[:4]}
    number, nodes, elements = {}, [], []
    for k, (x, y) in enumerate(made.nodes):
        for i in range(0, len(z), 1 if k in corners else 2):
            nodes.append((x, y, z[i]))
            number[k, i] = len(nodes)
    for e in made.elements:
        (x0, y0), (x1, y1), (x2, y2) = (made.nodes[k] for k in e[:3])
        c, sides = list(e[:4]), list(e[4:])
        if (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0) < 0:
            c, sides = [c[0], c[3], c[2], c[1]], sides[::-1]
        for i in range(0, len(z) - 1, 2):
            elements.append([number[k, i] for k in c] + [number[k, i + 2] for k in c] + [number[k, i] for k in sides]
                            + [number[k, i + 2] for k in sides] + [number[k, i + 1] for k in c])
    faces = [{number[k, i] for k in face for i in range(len(z)) if (k, i) in number} for face in made.faces]
    nodes += [(*end, 0.0)] * 2
    place, turn = len(nodes) - 1, len(nodes)
    out = ["*NODE"] + ["%d, %.10g, %.10g, %.10g" % (k + 1, *p) for k, p in enumerate(nodes)]
    out.append("*ELEMENT, TYPE=C3D20R, ELSET=ALL")
    for k, e in enumerate(elements):
        out += ["%d, %s," % (k + 1, ", ".join(map(str, e[:10]))), ", ".join(map(str, e[10:]))]
    out += group("HELD", faces[0]) + group("TURNED", faces[1])
    out += group("MIDDLE", {number[k, 0] for k in range(len(made.nodes))} - faces[0] - faces[1])
    out += group("SEEN", {number[k, i] for k in made.edges for i in range(0, len(z), 2)} | {place, turn})
    turned, moduli = elastic(nu, first)
    out += [*turned, "*MATERIAL, NAME=M", *moduli, "*SOLID SECTION, ELSET=ALL, MATERIAL=M" + (", ORIENTATION=CRYSTAL" if turned else ""),
            "*RIGID BODY, NSET=TURNED, REF NODE=%d, ROT NODE=%d" % (place, turn), "*BOUNDARY", "HELD, 1, 3", "MIDDLE, 3, 3",
            "%d, 3, 3" % place, "%d, 1, 2" % turn]
    for node, axis in ((turn, 3), (place, 1), (place, 2)) if forces else ((turn, 3),):
        out += ["*STEP", "*STATIC", "*CLOAD, OP=NEW", "%d, %d, 1" % (node, axis), "*NODE PRINT, NSET=SEEN", "U", "*END STEP"]
    return "\n".join(out) + "\n", number, turn


def ran(text):
    """lines of what ccx prints, as words"""
    with tempfile.TemporaryDirectory() as where:
        (pathlib.Path(where) / "path.inp").write_text(text, encoding="ascii")
        done = subprocess.run(["ccx", "-i", "path"], cwd=where, capture_output=True, text=True, check=False,
                              env=dict(os.environ, OMP_NUM_THREADS="1"))
        if done.returncode or "ERROR" in done.stdout:
            raise RuntimeError("ccx: " + done.stdout[-200:].strip())
        return [line.split() for line in (pathlib.Path(where) / "path.dat").read_text(encoding="ascii").splitlines()]


def compliance(pieces, fillet, h, nu, density, first):
    """turn, x and y of the end under a moment, a force along x and one along y there, um, uN"""
    made = mesh.Mesh(strip.Strip(pieces, strip.Isotropic(MODULUS, nu), h, fillet), density)
    text, _, turn = deck(made, mesh.Line(made.flexure.pieces).end[:2], h, nu, first, True)
    rows = [r for r in ran(text) if len(r) == 4 and r[0] in (str(turn - 1), str(turn))]
    place, turned = ([r for r in rows if r[0] == str(n)] for n in (turn - 1, turn))
    return made.flexure.pieces, [[float(t[3]) / 2, float(p[1]) / 2, float(p[2]) / 2] for p, t in zip(place, turned)]


def solve(pieces, fillet, h, nu, density):
    """(stiffness in uN um/rad, peak strain per radian)"""
    made = mesh.Mesh(strip.Strip(pieces, strip.Isotropic(MODULUS, nu), h, fillet), density)
    text, number, turn = deck(made, mesh.Line(made.flexure.pieces).end[:2], h, nu)
    rows = ran(text)
    moved = {int(r[0]): tuple(map(float, r[1:])) for r in rows if len(r) == 4 and r[0].isdigit()}
    angle, peak = moved[turn][2], 0.0
    for e in made.elements:
        for one, two, middle in zip(e[:4], e[1:4] + e[:1], e[4:]):
            if not all(k in made.edges for k in (one, two, middle)):
                continue
            (x0, y0), (x1, y1) = made.nodes[one], made.nodes[two]
            for (k, i), n in ((key, number[key]) for key in ((one, i) for i in range(0, 99, 2)) if key in number):
                (u0, v0, _), (u1, v1, _) = moved[n], moved[number[two, i]]
                along = (u1 - u0) * (x1 - x0) + (v1 - v0) * (y1 - y0)
                peak = max(peak, abs(along) / ((x1 - x0) ** 2 + (y1 - y0) ** 2))
    return 2 / angle, peak / angle


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=40)
    parser.add_argument("--density", type=float, default=1, help="of the elements; 1: 24 along a fillet")
    for option in ("forces", "one", "silicon"):
        parser.add_argument("--" + option, action="store_true")
    options = parser.parse_args()
    for seed in range(options.seed, options.seed + options.count):
        pieces, fillet, h, nu = (one_piece if options.one else shape)(seed)
        degrees = round(random.Random(seed + 77).uniform(-45, 45), 1) if options.silicon else "-"
        try:
            if options.forces:
                pieces, c = compliance(pieces, fillet, h, nu, options.density, math.radians(degrees) if options.silicon else None)
                found = ",".join("%.7g" % v for v in (c[0][0], *((a + b) / 2 for a, b in ((c[0][1], c[1][0]), (c[0][2], c[2][0]))),
                                                     c[1][1], (c[1][2] + c[2][1]) / 2, c[2][2]))
                print("%d,%s,%g,%g,%g,%s,%s" % (seed, degrees, fillet, h, 0 if options.silicon else nu, found, ";".join(
                    "%g:%.9g:%g:%g:%g" % (p.length, p.curvature, *p.widths) for p in pieces)), flush=True)
                continue
            stiffness, peak = solve(pieces, fillet, h, nu, options.density)
        except RuntimeError as error:
            print("seed %d: %s" % (seed, error), file=sys.stderr, flush=True)
            continue
        print("%d,%g,%g,%g,%.6e,%.6g,%s" % (seed, fillet, h, nu, stiffness * 1e-12, peak, ";".join(
            "%g:%.9g:%g:%g" % (p.length, p.curvature, p.widths[0], p.widths[2]) for p in pieces)), flush=True)


if __name__ == "__main__":
    main()
