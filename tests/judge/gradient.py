#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""gradient.py [RHO/T[,T/R[,MIDDLE]]...]: where the moment stands that a filleted root is strained by, as a share of the width from
the block's face, in plane stress by CalculiX (ccx), where it falls to nothing over 15 widths.

One strip of mesh.py is held by its first block and loaded through the second one by a moment and by a force across it. Both
are added so that the moment at the face is 1 and s from there 1 - s/(15 t): the peak is less than that of an even moment by s/(15 t).
MIDDLE: width in the middle over that at the ends."""
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import mesh  # noqa: E402
import solid  # noqa: E402
import strip  # noqa: E402

WIDTH, LENGTH, OVER = 10.0, 300.0, 15


def edge(flexure, density, force, moment):
    """stresses along the first root's edges per unit of what acts about that root"""
    made = mesh.Mesh(flexure, density)
    deck = mesh.Deck(150e3, 0.25, mesh.THIN)
    x, y, _ = mesh.Line(flexure.pieces).end
    hub = deck.node(x + 40, y), deck.node(x + 40, y + 400)
    first = deck.add(made, 0, 0, 0)
    deck.fixed += [(first + k, way, 0.0) for k in made.faces[0] for way in (1, 2)]
    deck.tie([first + k for k in made.faces[1]], hub)
    couple = (moment - (x + 40) * force) / 400
    deck.forces = [(hub[0], 1, couple), (hub[1], 1, -couple)] + ([(hub[0], 2, force)] if force else [])
    with tempfile.TemporaryDirectory() as where:
        _, stress = solid.solve(deck, pathlib.Path(where))
    return {k: sum(stress[first + k][:2]) / (force or moment) for k, place in made.edges.items() if place == 0}


def place(x, thick=0.0, middle=1.0, density=0.6):
    """share of the width"""
    if thick:
        radius = WIDTH / thick
        pieces = strip.csfh(radius, min(LENGTH / radius, 5), WIDTH, None if middle == 1 else middle * WIDTH)
    else:
        pieces = strip.leaf(LENGTH, WIDTH, None if middle == 1 else middle * WIDTH)
    flexure = strip.Strip(pieces, strip.Isotropic(150e3, 0.25), 30.0, x * WIDTH)
    even, across = edge(flexure, density, 0, 1e-2), edge(flexure, density, 1e-4, 0)
    # the force has M(0) = 0 and takes from what the moment has along the strip
    fallen = max(abs(even[k] + across[k] / (OVER * WIDTH)) for k in even)
    return OVER * (1 - fallen / max(map(abs, even.values())))


def main():
    for text in sys.argv[1:] or ["0.1", "0.2", "0.35", "0.5", "0.7", "1", "1.25"]:
        print("%s %.3f" % (text, place(*map(float, text.split(",")))), flush=True)


if __name__ == "__main__":
    main()
