# SPDX-License-Identifier: GPL-3.0-or-later
"""The table of solids of the gallery (gallery.csv) and the page that it makes beside what the program says now (docs/gallery/truth.md).
Needs nothing but Python."""
import collections
import csv
import pathlib
import tempfile

import said

TABLE = pathlib.Path(__file__).with_name("gallery.csv")
PAGE = said.GALLERY / "truth.md"
HEAD = ("device", "quantity", "unit", "coarse_nodes", "coarse", "fine_nodes", "fine", "solid")
RATIO = 0.7  # of the two meshes' elements

NOTES = {
    "reference-six-bar": "Its stated masses, stiffnesses and dampings define the benchmark and are of no solid: without them the program "
    "takes all from the drawing, and that is compared here, with the material's stated modulus.",
    "copper-nodder": "Its force with its amplitude, for good; the layer is the flow's, 9 um.",
    "free-form-gripper": "Silicon. The beads are springs between tooth and middle that push alone.",
    "four-tendons": "Cables are springs that are drawn in.",
    "comb-stage": "Combs pull with the force that they have in the program's equilibrium; their rotors weigh on both sides.",
}
# (device, quantity): why it is outside its band
KNOWN = {}
INTRO = """# The gallery as whole solids

Written by `tools/solids/gallery` of the sources, which solves them again (CalculiX, minutes of one core a device); with `--page` from the
table of what was solved alone. `tests/docs/gallery_solids.py` compares that table with what the program says today, and fails where a solid
lies outside the program's band without a reason below.

Each device is one elastic solid of all that its drawing has, in its material with its directions, held twelve widths behind the roots at
the ground. Half of its depth is solved, in quadratic wedges of 15 nodes; elements of flexures are 1.4 times as long as these are wide in
the first mesh and as long as wide in the second, fillets are divided by 11.4 and 8 degrees, half the depth by one and two. *solid* is Richardson's estimate from both,
for errors of the second power of the size; *meshes %* how far they are apart.

- **Pose**: what the first scene's load, put on for good, makes of the origin and angle of the body that it acts on first, with large
  displacements. Tendons of one pull and combs pull with the force, and along the line, that they have in the program's equilibrium.
  Program and band: displacement and angle as `check` judges them, `--effects` without inertia.
- **Peak strain** there, of the hinge that uses most of its limit: from the displacements of the solid's edge (`tools/solids/README.md`); of a
  crystal the largest principal stress over the mean modulus, as the program has it. Band: the verdict's.
- **Frequencies** of the device without load, springs, drives and air. In the plane: as required frequencies are judged, with what bodies
  give; across it: the verdict's.
"""
TOP = """| quantity | unit | two meshes | solid | meshes % | program | band | solid over program | band % | inside |
|---|---|---|---|---|---|---|---|---|---|"""


def read():
    if not TABLE.exists():
        return []
    with TABLE.open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def write(rows):
    with TABLE.open("w", newline="", encoding="utf-8") as file:
        out = csv.DictWriter(file, HEAD, lineterminator="\n")
        out.writeheader()
        out.writerows(rows)


def with_rows(rows, name, quantities, found):
    """those of a device instead of its former ones; solid: Richardson's estimate for errors of the second power of the size"""
    (n0, coarse), (n1, fine) = found
    new = [{"device": name, "quantity": q, "unit": of[0], "coarse_nodes": n0, "coarse": f"{coarse[q]:.6g}", "fine_nodes": n1, "fine": f"{fine[q]:.6g}",
            "solid": f"{fine[q] + (fine[q] - coarse[q]) / (RATIO ** -2 - 1):.6g}"} for q, of in quantities.items()]
    return sorted([r for r in rows if r["device"] != name] + new, key=lambda r: r["device"])


def line(row, said_of):
    """a row of the page, and whether the solid lies within the band"""
    unit, value, low, high = said_of
    solid, apart = float(row["solid"]), abs(float(row["fine"]) - float(row["coarse"]))
    inside = low <= solid <= high
    off = f"{100 * (solid / value - 1):+.2f} %" if value else "-"
    off_band = f"{100 * (low / value - 1):+.2f} to {100 * (high / value - 1):+.2f}" if value > 0 else f"{100 * (high / value - 1):+.2f} to {100 * (low / value - 1):+.2f}"
    meshes = f"{float(row['coarse']):.5g}, {float(row['fine']):.5g}"
    return f"| {row['quantity']} | {unit} | {meshes} | {solid:.5g} | {apart / abs(solid) * 100:.2g} | {value:.5g} | {low:.5g} to {high:.5g} | {off} | {off_band} | {'yes' if inside else 'NO'} |", inside


def compared(program, rows):
    """what is wrong, and the page"""
    problems, out, of = [], [INTRO], collections.defaultdict(list)
    for row in rows:
        of[row["device"]].append(row)
    for name, its in of.items():
        with tempfile.TemporaryDirectory() as folder:
            now, _ = said.said(program, said.Device(name), pathlib.Path(folder))
        nodes = f"{its[0]['coarse_nodes']} and {its[0]['fine_nodes']}"
        out += [f"\n## {name}\n", f"Nodes of the two meshes: {nodes}. {NOTES.get(name, '')}".rstrip() + "\n", TOP]
        for row in its:
            if row["quantity"] not in now:
                problems.append(f"{name}: the program does not say {row['quantity']} any more: run tools/solids/gallery {name}")
                continue
            text, inside = line(row, now[row["quantity"]])
            out.append(text)
            known = KNOWN.get((name, row["quantity"]))
            if not inside and not known:
                problems.append(f"{name}: {row['quantity']} of the solid lies outside: {text}")
            if inside and known:
                problems.append(f"{name}: {row['quantity']} lies inside now: take it out of KNOWN in tools/solids/truth.py")
        for q in (q for q in now if q not in {r["quantity"] for r in its}):
            problems.append(f"{name}: the solid has no {q}: run tools/solids/gallery {name}")
        why = [f"- {q}: {text}" for (d, q), text in KNOWN.items() if d == name]
        out += ["\nOutside, and why:\n", *why] if why else []
    left = sorted({p.parent.name for p in said.GALLERY.glob("*/device.xml")} - set(of))
    out += [f"\nNot solved yet: {', '.join(left)}."] if left else []
    return problems, "\n".join(out) + "\n"
