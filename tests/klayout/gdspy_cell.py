#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""gdspy_cell.py PROGRAM: the mask of the gallery's comb stage as a cell in another layout, by gdspy, as docs/klayout.md says: its name, its
layers, and the contacts of the order sheet as ports, the same as its labels. After placing, turning and mirroring each port lies in metal of its
own net with the whole of its pad."""
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import warnings

try:
    import gdspy
except ImportError:
    print("SKIPPED: gdspy is not installed (Debian: apt-get install python3-gdspy)")
    sys.exit(77)

ROOT = pathlib.Path(__file__).resolve().parents[2]
DEVICE = ROOT / "docs/gallery/comb-stage/device.xml"
PLACES = (((0, 0), 0, False), ((5000, -3000), 90, False), ((-1234.5, 800), 180, True), ((700, 900), 270, True))


def ports(order):
    """{name: (x, y)} in um, in the cell's own coordinates"""
    return {c["net"]: tuple(c["centre_um"]) for c in order["contacts"]}


def labelled(cell):
    """what gdsfactory's add_ports_from_labels reads with the arguments of docs/klayout.md: {name: (x, y)}"""
    return {y.text: tuple(y.position) for y in cell.labels if (y.layer, y.texttype) == (63, 0) and y.text.startswith("port=")}


def moved(point, origin, degrees, mirrored):
    x, y = point[0], -point[1] if mirrored else point[1]
    c, s = round(math.cos(math.radians(degrees))), round(math.sin(math.radians(degrees)))
    return origin[0] + c * x - s * y, origin[1] + s * x + c * y


def main():
    wrong, checks = [], 0
    with tempfile.TemporaryDirectory() as where:
        done = subprocess.run([sys.argv[1], "mask", DEVICE, "--force", "--corners", "none", "--advice", "none", "--mask-format", "gds", "-q", "-o",
                               pathlib.Path(where, "out")], capture_output=True, text=True, check=False)
        masks = pathlib.Path(where, "out/masks")
        files = [p for p in sorted(masks.glob("*.gds")) if (masks / (p.stem + ".json")).exists() and not p.stem.endswith(("-coupons", "-wafer"))]
        if not files:
            sys.exit(done.stderr)
        for file in files:
            certificate = json.loads((masks / (file.stem + ".json")).read_text())
            order = json.loads(min(masks.glob(file.stem + "*.order.json"), key=lambda p: len(p.name) if "coupons" not in p.name else 999).read_text())
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                library = gdspy.GdsLibrary(infile=str(file))
            (cell,) = library.top_level()
            if cell.name != certificate["cell"]:
                wrong.append("cell %s, not %s" % (cell.name, certificate["cell"]))
            if cell.get_layers() - {int(y["gds"].split("/")[0]) for y in certificate["layers"]}:
                wrong.append("layers %s" % cell.get_layers())
            mine = ports(order)
            if len(mine) < 3:
                wrong.append("%s has ports %s" % (file.stem, mine))
            labels = labelled(cell)
            if set(labels) != {"port=" + name for name in mine} or any(math.dist(labels["port=" + n], mine[n]) > 0.002 for n in mine):
                wrong.append("%s has labels %s" % (file.stem, labels))
            half = {c["net"]: c["side_um"] / 2 - 0.01 for c in order["contacts"]}
            for k, (origin, degrees, mirrored) in enumerate(PLACES):
                top = gdspy.Cell("TOP_%d" % k, exclude_from_current=True)
                top.add(gdspy.CellReference(cell, origin, rotation=degrees, x_reflection=mirrored))
                metal = top.get_polygons(by_spec=True)[(1, 0)]
                pieces = gdspy.boolean(metal, None, "or", precision=1e-4, max_points=0).polygons
                on = {}
                for name, point in mine.items():
                    at = moved(point, origin, degrees, mirrored)
                    pad = [(at[0] + u * half[name], at[1] + v * half[name]) for u in (-1, 0, 1) for v in (-1, 0, 1)]
                    within = [i for i, p in enumerate(pieces) if all(gdspy.inside(pad, [p]))]
                    on[name] = tuple(within)
                    checks += 1
                    if not within:
                        wrong.append("%s at %s: port %s lies beside the metal" % (file.stem, origin, name))
                if certificate["nets_on_mask"]["nets"] >= len(mine) and len(set(on.values())) != len(mine):
                    wrong.append("%s at %s: ports on one piece: %s" % (file.stem, origin, on))
    print("%d masks, %d ports placed, %d wrong" % (len(files), checks, len(wrong)))
    print("\n".join(wrong))
    return 0 if not wrong and checks >= 12 else 1


if __name__ == "__main__":
    sys.exit(main())
