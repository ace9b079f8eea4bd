#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""step.py PROGRAM: Open CASCADE (through gmsh) reads the solids that the program writes as STEP. Each is closed, their number is that of the outlines that
nothing joins, the volume is the certificate's area times the thickness, the box is that of the mask, and every face is a plane or a cylinder."""
import json
import pathlib
import subprocess
import sys
import tempfile

try:
    import gmsh
except ImportError:
    print("SKIPPED: gmsh is not installed (Debian: apt-get install python3-gmsh)")
    sys.exit(77)

ROOT = pathlib.Path(__file__).resolve().parents[2]
DEVICES = (("reference-six-bar", "al-masked-rie", 0.050), ("comb-stage", "silicon-on-glass", None), ("free-form-gripper", "al-masked-rie", None))


def solids(file):
    """[volume], kinds of faces, box, edges that belong to other than two faces"""
    gmsh.clear()
    gmsh.model.occ.importShapes(str(file))
    gmsh.model.occ.synchronize()
    volumes = [gmsh.model.occ.getMass(3, tag) for _, tag in gmsh.model.getEntities(3)]
    kinds = {gmsh.model.getType(2, tag) for _, tag in gmsh.model.getEntities(2)}
    edges = [len(gmsh.model.getAdjacencies(1, tag)[0]) for _, tag in gmsh.model.getEntities(1)]
    return volumes, kinds, gmsh.model.getBoundingBox(-1, -1), sum(n != 2 for n in edges)


def main():
    wrong = []
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    for name, flow, thickness in DEVICES:
        with tempfile.TemporaryDirectory() as where:
            out = pathlib.Path(where, "out")
            done = subprocess.run([sys.argv[1], "mask", ROOT / "docs/gallery" / name / "device.xml", "--force", "--flow", flow, "--corners", "none",
                                   "--advice", "none", "--mask-format", "step", "-q", "-o", out], capture_output=True, text=True, check=False)
            file = out / ("masks/%s.step" % flow)
            if not file.exists():
                sys.exit("%s: %s" % (name, done.stderr))
            if "walls vertical" not in file.read_text().split("ENDSEC")[0]:
                wrong.append("%s does not say how its walls stand" % name)
            certificate = json.loads((out / ("masks/%s.json" % flow)).read_text())
            (layer,) = [y for y in certificate["layers"] if y["biased"]]
            volumes, kinds, box, loose = solids(file)
            high = box[5] - box[2] - 2e-7  # Open CASCADE's box is wider by its tolerance
            thick = thickness or round(high, 6)
            if thickness and abs(high - thickness) > 1e-6:
                wrong.append("%s is %.9g mm thick, not %.9g" % (name, high, thickness))
            volume, want = sum(volumes), layer["area_um2"] * 1e-6 * thick
            if not volumes or abs(volume - want) > 1e-9 * want or min(volumes) <= 0:
                wrong.append("%s: %d solids of %.12g mm3, the certificate has %.12g" % (name, len(volumes), volume, want))
            if loose:
                wrong.append("%s: %d edges are not shared by two faces" % (name, loose))
            if kinds - {"Plane", "Cylinder"}:
                wrong.append("%s has faces of kind %s" % (name, kinds))
            edge = [x * 1e-6 for x in layer["box_nm"]]
            if max(abs(box[0] - edge[0]), abs(box[1] - edge[1]), abs(box[3] - edge[2]), abs(box[4] - edge[3])) > 3e-6:
                wrong.append("%s lies in %s, not in %s" % (name, box, edge))
            print("%s: %d solid(s), %.12g mm3, %s" % (name, len(volumes), volume, sorted(kinds)))
    gmsh.finalize()
    sys.exit("\n".join(wrong) if wrong else 0)


main()
