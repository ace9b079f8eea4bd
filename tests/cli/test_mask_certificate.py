#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""tests/accept/check_mask.py finds every certificate of the program right, and every change of the file or of the
certificate, made with hashes that fit: then only its own geometry can notice."""
import copy
import hashlib
import json
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
program = pathlib.Path(sys.argv[1]).resolve()
sys.path.insert(0, str(ROOT / "tests/accept"))
import check_mask  # noqa: E402

problems = []
GALLERY = ROOT / "docs/gallery"


def run(*arguments):
    return subprocess.run([program, *map(str, arguments)], cwd=ROOT, capture_output=True, text=True, timeout=300)


def refused(path):
    try:
        check_mask.check(path)
        return None
    except check_mask.Refused as why:
        return str(why)


def xy_records(data):
    """offset and points of every boundary's XY record"""
    at, inside = 0, False
    while at + 4 <= len(data):
        length, record = struct.unpack_from(">HH", data, at)
        inside = record == 0x0800 or (inside and record != 0x1100)
        if record == 0x1003 and inside:
            yield at + 4, (length - 4) // 8
        at += length


def moved(data, index, vertex, dx, dy):
    """one vertex of one boundary elsewhere"""
    offset, n = list(xy_records(data))[index]
    out = bytearray(data)
    for k in {vertex % (n - 1)} | ({n - 1} if vertex % (n - 1) == 0 else set()):
        x, y = struct.unpack_from(">2i", out, offset + 8 * k)
        struct.pack_into(">2i", out, offset + 8 * k, x + dx, y + dy)
    return bytes(out)


def same_vertex(data, index):
    """vertex 3 of a boundary onto vertex 5"""
    offset, _ = list(xy_records(data))[index]
    x, y = struct.unpack_from(">2i", data, offset + 40)
    u, v = struct.unpack_from(">2i", data, offset + 24)
    return moved(data, index, 3, x - u, y - v)


def changed(document, *way):
    out = copy.deepcopy(document)
    *path, change = way
    *path, last = path
    inner = out
    for key in path:
        inner = inner[key]
    inner[last] = change(inner[last])
    return out


def main():
    with tempfile.TemporaryDirectory() as work:
        work = pathlib.Path(work)
        runs = (("reference-six-bar", "inside", "4094"), ("reference-six-bar", "equal-area", "199"),
                ("comb-stage", "equal-area", "4094"))
        for number, (device, how, most) in enumerate(runs):
            out = work / str(number)
            result = run("mask", GALLERY / device / "device.xml", "--mask-flatten", how, "--mask-vertices", most,
                         "--mask-format", "all", "-o", out, "-q")
            if result.returncode != 0:
                problems.append("%s %s: exit status %d: %s" % (device, how, result.returncode, result.stderr))
                continue
            dies = [gds for gds in sorted((out / "masks").glob("*.gds")) if "-plate" not in gds.name and "-wafer" not in gds.name]
            for gds in dies:  # plates have the certificates of what is on them
                why = refused(gds.with_suffix(".json"))
                if why:
                    problems.append("%s %s: %s" % (device, how, why))
                flat = json.loads(gds.with_suffix(".json").read_text())["flattening"]
                if flat != how:
                    problems.append("the certificate says " + flat)
        if problems:
            return
        good = [g for g in sorted((work / "0/masks").glob("*.gds")) if "-coupons" not in g.name][0]
        data, document = good.read_bytes(), json.loads(good.with_suffix(".json").read_text())
        shape = max(range(len(document["shapes"])), key=lambda k: document["shapes"][k]["vertices"])
        layers = [k for k, y in enumerate(document["layers"]) if y["polygons"]]
        cases = {
            "a vertex moved by 1 nm": (moved(data, shape, 4, 1, 0), document),
            "a vertex moved across the polygon": (moved(data, shape, 4, 300000, 200000), document),
            "two vertices at one place": (same_vertex(data, shape), document),
            "an area": (data, changed(document, "shapes", shape, "area2_nm2", lambda v: v + 2)),
            "an exact area": (data, changed(document, "shapes", shape, "area_um2", lambda v: v * 1.001)),
            "a shortest edge": (data, changed(document, "shapes", shape, "shortest_edge_nm", lambda v: v + 1e-3)),
            "a corner": (data, changed(document, "shapes", shape, "sharpest_space_deg", lambda v: v + 1e-3)),
            "a count": (data, changed(document, "layers", layers[0], "vertices", lambda v: v + 1)),
            "a box": (data, changed(document, "layers", layers[0], "box_nm", lambda v: [v[0] - 1] + v[1:])),
            "a neck": (data, changed(document, "necks", 0, "vertices_nm", 0, lambda v: [v[0] + 1, v[1]])),
            "a shape left out": (data, changed(document, "shapes", lambda v: v[:-1])),
        }
        for name, (bytes_, said) in cases.items():
            folder = work / "case"
            shutil.rmtree(folder, ignore_errors=True)
            folder.mkdir()
            said = dict(said, files=[], gds_sha256=hashlib.sha256(bytes_).hexdigest())
            (folder / "x.gds").write_bytes(bytes_)
            (folder / "x.json").write_text(json.dumps(said))
            if refused(folder / "x.json") is None:
                problems.append(name + ": not noticed")
        (good.parent / good.with_suffix(".svg").name).write_text("<svg/>")
        if "hash" not in (refused(good.with_suffix(".json")) or ""):
            problems.append("another SVG: not noticed")


main()
for problem in problems:
    print(problem)
print("%d problems" % len(problems))
sys.exit(bool(problems))
