#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""tension.py [RHO/T...]: concentration of stress where a strip in tension enters a wide block through fillets, in plane stress,
by CalculiX (ccx): the table TENSION of strip.py. With --bend the same for bending, which says how good the meshes are:
docs/theory/root-strain.md has 0.944 + 0.2113 (t/rho)^(2/3) for it.

Half of a strip of width 1, three long, with half of a block of twelve by six; quadratic elements, as many in depth of the fillet
as along a third of it, finer towards it. The peak is the trace of the stress on the fillet, where nothing acts across."""
import math
import pathlib
import subprocess
import sys
import tempfile

ALONG, ACROSS, STRIP = 60, 30, 24


def deck(rho, bend):
    """input of ccx and the nodes of the fillet"""
    number, nodes, elements = {}, [], []

    def node(x, y):
        key = (round(x, 9), round(y, 9))
        if key not in number:
            number[key] = len(nodes) + 1
            nodes.append((x, y))
        return number[key]

    def patch(place, n, m):
        grid = [[node(*place(i / (2 * n), j / (2 * m))) if i % 2 == 0 or j % 2 == 0 else 0 for j in range(2 * m + 1)]
                for i in range(2 * n + 1)]
        for i in range(0, 2 * n, 2):
            for j in range(0, 2 * m, 2):
                ring = [grid[i][j], grid[i][j + 1], grid[i][j + 2], grid[i + 1][j + 2], grid[i + 2][j + 2], grid[i + 2][j + 1],
                        grid[i + 2][j], grid[i + 1][j]]
                x = [nodes[k - 1] for k in ring[::2]]
                area = sum(x[k - 1][0] * x[k][1] - x[k][0] * x[k - 1][1] for k in range(4))
                if area < 0:
                    ring = [ring[0]] + ring[:0:-1]
                elements.append(ring[::2] + ring[1::2])

    wide, high = 6 + rho, 6.0
    finer = 3 + 3.5 * math.log10(max(1, 0.5 / rho))
    graded = lambda v: math.expm1(finer * v) / math.expm1(finer)

    def block(u, v):
        a = u * math.pi / 2
        inner = rho * math.sin(a), 0.5 + rho - rho * math.cos(a)
        side, part = min(int(3 * u + 1e-9), 2), 3 * u  # corners between two elements
        outer = ((part * wide, 0.0), (wide, (part - 1) * high), (wide - (part - 2) * (wide - rho), high))[side]
        g = graded(v)
        return inner[0] + g * (outer[0] - inner[0]), inner[1] + g * (outer[1] - inner[1])

    patch(block, ALONG, ACROSS)
    patch(lambda u, v: (-3 * graded(u), 0.5 * (1 - graded(v))), STRIP, ACROSS)
    fillet = [node(*block(i / (2 * ALONG), 0)) for i in range(2 * ALONG + 1)]
    out = ["*NODE"] + ["%d, %.12g, %.12g, 0" % (k + 1, *p) for k, p in enumerate(nodes)]
    out.append("*ELEMENT, TYPE=CPS8, ELSET=ALL")
    out += ["%d, %s" % (k + 1, ", ".join(map(str, e))) for k, e in enumerate(elements)]
    out += ["*MATERIAL, NAME=M", "*ELASTIC", "1000, 0.22", "*SOLID SECTION, ELSET=ALL, MATERIAL=M", "1"]
    out.append("*BOUNDARY")
    for k, (x, y) in enumerate(nodes):
        if abs(x - wide) < 1e-9:
            out.append("%d, 1, 2" % (k + 1))
        elif abs(y) < 1e-9:
            out.append("%d, %d" % (k + 1, 1 if bend else 2))
    out += ["*STEP", "*STATIC", "*CLOAD"]
    end = sorted((y, k + 1) for k, (x, y) in enumerate(nodes) if abs(x + 3) < 1e-9)
    for i in range(0, len(end) - 2, 2):  # consistent loads of a quadratic edge, its middle node in the middle
        size = end[i + 2][0] - end[i][0]
        pull = [-(y / 0.5 if bend else 1) for y, _ in end[i:i + 3]]
        for a in range(3):
            w = (((4, 2, -1), (2, 16, 2), (-1, 2, 4))[a])
            out.append("%d, 1, %.12g" % (end[i + a][1], size / 30 * sum(x * y for x, y in zip(w, pull))))
    out += ["*EL PRINT, ELSET=ALL", "S", "*NODE FILE", "U", "*EL FILE", "S", "*END STEP"]
    return "\n".join(out) + "\n", set(fillet)


def peak(rho, bend):
    text, fillet = deck(rho, bend)
    with tempfile.TemporaryDirectory() as where:
        path = pathlib.Path(where) / "root"
        path.with_suffix(".inp").write_text(text, encoding="ascii")
        subprocess.run(["ccx", "-i", "root"], cwd=where, capture_output=True, check=True)
        most, stress = 0.0, False
        for line in path.with_suffix(".frd").read_text(encoding="ascii").splitlines():
            if line.startswith(" -4"):
                stress = line.split()[1] == "STRESS"
            elif stress and line.startswith(" -1") and int(line[3:13]) in fillet:
                most = max(most, abs(float(line[13:25]) + float(line[25:37])))
        return most


def main():
    bend = "--bend" in sys.argv
    wanted = [float(v) for v in sys.argv[1:] if v != "--bend"] or [0.05, 0.1, 0.2, 0.35, 0.5, 0.75, 1.0]
    for x in wanted:
        more = "  (fit %.4f)" % (0.944 + 0.2113 * x ** (-2 / 3)) if bend else ""
        print("%g %.4f%s" % (x, peak(x, bend), more), flush=True)


if __name__ == "__main__":
    main()
