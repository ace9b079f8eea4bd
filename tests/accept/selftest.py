#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""selftest.py PROGRAM: judge.py can fail. A good mask passes, and copies of it with one small defect each fail in the checks
that are there for it: a vertex moved by 2 nm, a sliver, an arc in the SVG or the DXF a little off, a missing shape, wrong numbers
in the certificate, a file changed behind the order sheet."""
import contextlib
import io
import json
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
sys.dont_write_bytecode = True
import judge  # noqa: E402
import random_devices  # noqa: E402
from random_masks import FAST  # noqa: E402

SEED = 4  # a chain of bars: one flow, arcs, nothing that is cut


def text_of(path, change):
    path.write_text(change(path.read_text(encoding="utf-8")), encoding="utf-8")


def largest_xy(data):
    """offset and length of the longest XY record"""
    best, at = (0, 0), 0
    while at + 4 <= len(data):
        length, record = struct.unpack(">HB", data[at:at + 3])
        if record == 0x10 and length > best[1]:
            best = at, length
        at += length
    return best


def moved_vertex(stem):
    path = stem.with_suffix(".gds")
    data = bytearray(path.read_bytes())
    at = largest_xy(data)[0] + 4 + 8 * 20  # its 21st vertex
    data[at:at + 4] = struct.pack(">i", struct.unpack(">i", data[at:at + 4])[0] + 2)
    path.write_bytes(data)


def sliver(stem):
    path = stem.with_suffix(".gds")
    data = path.read_bytes()
    at, length = largest_xy(data)
    x, y = struct.unpack(">2i", data[at + 4 + 8 * 20:at + 12 + 8 * 20])
    cut = at + 12 + 8 * 20
    path.write_bytes(data[:at] + struct.pack(">H", length + 8) + data[at + 2:cut] + struct.pack(">2i", x + 2, y + 1) + data[cut:])


def svg_arc(stem):
    def larger(match):
        return "A%s %s" % (2 * ("%.6f" % (float(match[1]) + 0.1),))
    text_of(stem.with_suffix(".svg"), lambda s: re.sub(r"A(\d{2,}\.\d+) \1", larger, s, count=1))


def svg_shape(stem):
    text_of(stem.with_suffix(".svg"), lambda s: re.sub(r"<path .*\n", "", s, count=1))


def dxf_bulge(stem):
    def larger(match):
        return "\n42\n%.9f\n" % (float(match[1]) * 1.02)
    text_of(stem.with_suffix(".dxf"), lambda s: re.sub(r"\n42\n(0\.[1-9]\d*)\n", larger, s, count=1))


def number(name, change):
    def apply(stem):
        path = stem.with_suffix(".json")
        said = json.loads(path.read_text(encoding="utf-8"))
        said["layers"][0][name] = change(said["layers"][0][name])
        path.write_text(json.dumps(said), encoding="utf-8")
    return apply


def changed_file(stem):
    text_of(stem.with_suffix(".lyp"), lambda s: s + "\n")


DEFECTS = {  # name: what is done, and the checks that have to see it
    "moved-vertex": (moved_vertex, ("within rounding", "OASIS equal", "certificate", "order sheet")),
    "sliver": (sliver, ("GEOS", "OASIS equal", "width 4.0")),
    "svg-arc": (svg_arc, ("within rounding", "same arcs", "SVG and GDSII")),
    "svg-shape": (svg_shape, ("within rounding", "same arcs", "SVG and GDSII", "certificate")),
    "dxf-bulge": (dxf_bulge, ("same arcs", "DXF by KLayout")),
    "area": (number("polygon_area_um2", lambda a: a * 1.00002), ("gdspy", "merged areas", "certificate")),
    "exact-area": (number("area_um2", lambda a: a + 1), ("certificate",)),
    "vertices": (number("vertices", lambda n: n + 1), ("certificate",)),
    "changed-file": (changed_file, ("order sheet",)),
}


def main():
    if not shutil.which("klayout"):
        print("SKIPPED: klayout is not installed (Debian: apt-get install klayout python3-gdspy libgeos-dev)")
        return 77
    problems = []
    with tempfile.TemporaryDirectory() as temporary:
        where = pathlib.Path(temporary)
        text, _ = random_devices.device(SEED)
        (where / "device.xml").write_text(text, encoding="utf-8")
        subprocess.run([sys.argv[1], "mask", where / "device.xml", *FAST, "-q", "-o", where / "good"], check=True, capture_output=True)
        flow = next((where / "good/masks").glob("*.gds")).stem
        for name, (apply, _) in DEFECTS.items():
            shutil.copytree(where / "good", where / name)
            for other in (where / name / "masks").glob("*.gds"):
                if other.stem != flow:
                    other.unlink()
            before = {p: p.read_bytes() for p in (where / name / "masks").iterdir()}
            apply(where / name / "masks" / flow)
            if all(p.read_bytes() == data for p, data in before.items()):
                problems.append(name + ": the defect was not made")
        out = io.StringIO()
        with contextlib.redirect_stdout(out):
            _, failed = judge.judge([where / n / "masks" for n in ("good", *DEFECTS)])
    problems += [f for f in failed if f.startswith("good ")]
    for name, (_, checks) in DEFECTS.items():
        seen = [f for f in failed if f.startswith(name + " ")]
        problems += ["%s was not seen by the check '%s'" % (name, c) for c in checks if not any(c in f for f in seen)]
    if problems:
        print(out.getvalue()[-6000:])
    print("\n".join(problems) or "%d defects, each seen by the checks for it" % len(DEFECTS))
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
