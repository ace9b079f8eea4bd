#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The solids behind the peak strain, without solving any: the table of errors in docs/theory/flexure-errors.md is what the closed form gives beside
them, and the meshes of rows of every sort in tests/data/hinge/root_strain.csv still have the table's bricks (tools/solids/solve would
solve something else than the table has). Of devices of the gallery as whole solids (tools/solids/gallery) only what they are made of: an arc's chords
lie close to it, of the long arcs along a strip of varying width too, and a rotor that is drawn is weighed by the program as well.

    tests/docs/solids.py DIRECTORY-OF-THE-PROGRAMS"""
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
# line: mesh, layers more. Isotropic arcs and leaves, silicon, two meshes, deeper than 10 t
LINES = {2: (1, 1), 9: (1, 1), 184: (2, 2), 185: (2, 2), 430: (1, 1), 490: (1, 3), 510: (1, 2), 548: (1, 1)}

programs = pathlib.Path(sys.argv[1])
problems = []
page = (ROOT / "docs/theory/flexure-errors.md").read_text(encoding="utf-8").splitlines()
for row in subprocess.run([programs / "solid_errors"], capture_output=True, text=True, check=True).stdout.splitlines():
    if row not in page:
        problems.append("docs/theory/flexure-errors.md lacks " + row)
table = (ROOT / "tests/data/hinge/root_strain.csv").read_text(encoding="ascii").splitlines()
with tempfile.TemporaryDirectory() as room:
    for line, (mesh, layers) in LINES.items():
        row, name = table[line - 1].split(","), pathlib.Path(room) / "half"
        done = subprocess.run([programs / "solid_half", name, str(mesh), str(layers)], input=table[line - 1] + "\n", text=True, check=False)
        bricks = 0 if done.returncode else 2 * int(name.with_suffix(".edges").read_text(encoding="ascii").split()[3])
        if bricks != int(row[10]):
            problems.append(f"root_strain.csv line {line}: a mesh of {bricks} bricks")
sys.path.insert(0, str(ROOT / "tools/solids"))
import drawn  # noqa: E402  (after its path)

gallery = ROOT / "docs/gallery"
_, _, pieces = drawn.outlines(programs / "solid_whole", gallery / "free-form-four-bar/device.xml")
# hinge A narrows from 14 um to 7 um and widens again over 360 um: its edges are arcs of millimetres
hourglass = next(drawn.area(points) for _, joint, points in pieces if joint == 0)
drawn.CHORD = 1e-5
_, _, pieces = drawn.outlines(programs / "solid_whole", gallery / "free-form-four-bar/device.xml")
exact = next(drawn.area(points) for _, joint, points in pieces if joint == 0)
if abs(hourglass / exact - 1) > 5e-3:
    problems.append(f"tools/solids/gallery draws hinge A of free-form-four-bar with {hourglass:.1f} um2 of {exact:.1f}")
if drawn.rotors_of((gallery / "comb-stage/device.xml").read_text(encoding="utf-8")).count('voltage="1 mV"') != 2:
    problems.append("tools/solids/gallery leaves out rotors of comb-stage, which its solid has")
print("\n".join(problems) or f"{len(LINES)} meshes")
sys.exit(1 if problems else 0)
