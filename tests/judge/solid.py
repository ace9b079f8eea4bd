#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""solid.py [--judge PROGRAM] [--seed N] [--count N]: leaves of `slide` devices as solids in CalculiX (ccx), in plane stress and
at finite displacement, with fillets and blocks of five by six widths at both ends; before the judge with plane stress, too.

The first block is held at its far face, that of the second is moved across the leaf and kept on its line: what a leaf of a
guided stage or of a fixed-fixed one meets under a driver, whose stretch and bending both count. Printed: peak stress of the
solid over the judge's, the same of the force along the leaf, and what the stretch has of the judge's peak."""
import argparse
import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import strip  # noqa: E402

ALONG, ACROSS, STRIP = 24, 10, 14
E, NU = 160e3, 0.22


class Mesh:
    def __init__(self):
        self.number, self.nodes, self.elements = {}, [], []

    def node(self, x, y):
        key = (round(x, 6), round(y, 6))
        if key not in self.number:
            self.number[key] = len(self.nodes) + 1
            self.nodes.append((x, y))
        return self.number[key]

    def patch(self, place, n, m):
        """quadratic elements, their middle nodes half way in the patch's own coordinates"""
        grid = [[self.node(*place(i / (2 * n), j / (2 * m))) if i % 2 == 0 or j % 2 == 0 else 0 for j in range(2 * m + 1)]
                for i in range(2 * n + 1)]
        for i in range(0, 2 * n, 2):
            for j in range(0, 2 * m, 2):
                ring = [grid[i][j], grid[i][j + 1], grid[i][j + 2], grid[i + 1][j + 2], grid[i + 2][j + 2],
                        grid[i + 2][j + 1], grid[i + 2][j], grid[i + 1][j]]
                x = [self.nodes[k - 1] for k in ring[::2]]
                if sum(x[k - 1][0] * x[k][1] - x[k][0] * x[k - 1][1] for k in range(4)) < 0:
                    ring = [ring[0]] + ring[:0:-1]
                self.elements.append(ring[::2] + ring[1::2])


def quarter(length, t, rho):
    """places of a quarter of the leaf: of its block beside a fillet, and of its half strip; the middle of the leaf is at 0"""
    wide, high, half = rho + 5 * t, 6 * t, length / 2 - rho
    finer = 3 + 3.5 * math.log10(max(1, 0.5 * t / rho))
    graded = lambda v: math.expm1(finer * v) / math.expm1(finer)

    def block(u, v):
        a, g = u * math.pi / 2, graded(v)
        inner = rho * math.sin(a), t / 2 + rho - rho * math.cos(a)
        side, part = min(int(3 * u + 1e-9), 2), 3 * u
        outer = ((part * wide, 0.0), (wide, (part - 1) * high), (wide - (part - 2) * (wide - rho), high))[side]
        return half + inner[0] + g * (outer[0] - inner[0]), inner[1] + g * (outer[1] - inner[1])

    def half_strip(u, v):
        near = math.expm1(2 * u) / math.expm1(2)
        return half * (1 - near), t / 2 * (1 - graded(v))

    return block, half_strip, half + wide


def deck(length, t, rho, across):
    mesh = Mesh()
    block, half_strip, far = quarter(length, t, rho)
    fillets = set()
    for sx in (1, -1):
        for sy in (1, -1):
            turned = lambda place: lambda u, v: (sx * place(u, v)[0], sy * place(u, v)[1])
            mesh.patch(turned(block), ALONG, ACROSS)
            mesh.patch(turned(half_strip), STRIP, ACROSS)
            fillets |= {mesh.node(*turned(block)(i / (2 * ALONG), 0)) for i in range(2 * ALONG + 1)}
    ends = [[k + 1 for k, (x, _) in enumerate(mesh.nodes) if abs(x - s * far) < 1e-6] for s in (-1, 1)]
    out = ["*NODE"] + ["%d, %.12g, %.12g, 0" % (k + 1, *p) for k, p in enumerate(mesh.nodes)]
    out.append("*ELEMENT, TYPE=CPS8, ELSET=ALL")
    out += ["%d, %s" % (k + 1, ", ".join(map(str, e))) for k, e in enumerate(mesh.elements)]
    out += ["*NSET, NSET=FIRST"] + ["%d," % k for k in ends[0]] + ["*NSET, NSET=SECOND"] + ["%d," % k for k in ends[1]]
    out += ["*MATERIAL, NAME=M", "*ELASTIC", "%g, %g" % (E, NU), "*SOLID SECTION, ELSET=ALL, MATERIAL=M", "1"]
    out += ["*BOUNDARY", "FIRST, 1, 2", "*STEP, NLGEOM, INC=200", "*STATIC", "0.25, 1", "*BOUNDARY", "SECOND, 1, 1, 0",
            "SECOND, 2, 2, %.12g" % across, "*NODE PRINT, NSET=SECOND, TOTALS=ONLY, FREQUENCY=1000", "RF",
            "*EL FILE, FREQUENCY=1000", "S", "*END STEP"]
    return "\n".join(out) + "\n", fillets


def solve(length, t, rho, across):
    """(peak stress on the fillets, force along the leaf)"""
    text, fillets = deck(length, t, rho, across)
    with tempfile.TemporaryDirectory() as where:
        path = pathlib.Path(where) / "leaf"
        path.with_suffix(".inp").write_text(text, encoding="ascii")
        done = subprocess.run(["ccx", "-i", "leaf"], cwd=where, capture_output=True, text=True, check=False)
        if done.returncode:
            raise RuntimeError(done.stdout[-400:])
        most, stress = 0.0, False
        for line in path.with_suffix(".frd").read_text(encoding="ascii").splitlines():
            if line.startswith(" -4"):
                stress = line.split()[1] == "STRESS"
                most = 0.0 if stress else most
            elif stress and line.startswith(" -1") and int(line[3:13]) in fillets:
                most = max(most, abs(float(line[13:25]) + float(line[25:37])))
        rows = [line.split() for line in path.with_suffix(".dat").read_text(encoding="ascii").splitlines()]
        numbers = [row for row in rows if len(row) == 3 and row[0][-1].isdigit()]
        return most, float(numbers[-1][0])


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--judge", default="build/tests/judge")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=30)
    options = parser.parse_args()
    strip.SOLID = (0.0,) * len(strip.SOLID)  # plane stress
    ratios = []
    for seed in range(options.seed, options.seed + options.count):
        draw = random.Random(seed)
        length, t = 200 + 400 * draw.random(), 5 + 7 * draw.random()
        rho, across = t * (0.25 + 0.4 * draw.random()), length * (0.01 + 0.04 * draw.random())
        leaf = strip.Strip(strip.leaf(length, t), strip.Isotropic(E, NU), 1.0, rho)
        with tempfile.TemporaryDirectory() as where:
            model = pathlib.Path(where) / "model"
            model.write_text("body 0 0 1 1\n" + leaf.model(0, 1, (0, 0), -math.pi / 2) + "slide 1 0 %.15g\n" % across)
            said = json.loads(subprocess.run([options.judge, "at", model, "1"], capture_output=True, text=True,
                                             check=True).stdout)
        peak, force = solve(length, t, rho, across)
        stretch = said["wrenches"][0][1]
        ratios.append(peak / said["most"])
        print("%d: L %.1f t %.2f rho %.2f across %.2f um: stress %.1f MPa, solid over judge %.4f; force along %.4f; "
              "stretch has %.0f %%"
              % (seed, length, t, rho, across, said["most"], ratios[-1], force / stretch,
                 100 * stretch / t * strip.tension(rho / t) / said["most"]), flush=True)
    print("solid over judge: %.4f to %.4f" % (min(ratios), max(ratios)))


if __name__ == "__main__":
    main()
