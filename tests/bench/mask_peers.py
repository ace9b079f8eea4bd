#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Masks beside other tools: 1000 hinges of 1000 vertices, none like another, written, and moved outward by 1.5 um, by Flexwright,
gdspy, KLayout and GEOS. Writes docs/data/mask-benchmarks.csv and docs/mask-benchmarks.md.

    tests/bench/mask_peers.py BUILD-DIRECTORY [--date 2026-11-20] [--rounds 5]
    tests/bench/mask_peers.py --report      the page from the CSV again

Each hinge is two half circles on either side of a neck, with known centres and radii, so that the error of every vertex of what
a tool makes of it is known. Times are CPU times of the operation alone, inside each tool's own process; the processes take
turns, and the median of the rounds counts."""
import argparse
import csv
import math
import os
import pathlib
import platform
import re
import statistics
import struct
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(ROOT / "tests/accept"))
sys.dont_write_bytecode = True

DATA, PAGE = ROOT / "docs/data/mask-benchmarks.csv", ROOT / "docs/mask-benchmarks.md"
HINGES, VERTICES, ROW, PITCH, BIAS = 1000, 1000, 100, 300.0, 1.5  # um
CORNERS = 8
FIELDS = ("task", "tool", "setting", "cpu_ms", "vertices", "error_low_nm", "error_high_nm", "short_edges", "shortest_nm", "clearance_nm",
          "bytes")
TOOLS = (("flexwright-1.42", "Flexwright", "tolerance 1.42 nm"), ("flexwright-5", "Flexwright", "tolerance 5 nm, the default"),
         ("geos", "GEOS", "mitre"), ("klayout", "KLayout", "sized, mode 2"),
         ("gdspy-0.001", "gdspy", "miter, precision 1e-3 um, the default"), ("gdspy-1e-06", "gdspy", "miter, precision 1e-6 um"))


def radii():
    return [80 + 30 * (k * 0.6180339887 % 1) for k in range(HINGES)]


def centres(k, r):
    x, y = k % ROW * PITCH, k // ROW * PITCH
    return (x, y - r - 4), (x, y + r + 4)


def write_input(where):
    """the hinges with 495 chords to each half circle: as doubles, and on the grid"""
    import numpy as np
    out, chords = np.empty((HINGES, VERTICES, 2)), VERTICES // 2 - 5
    for k, r in enumerate(radii()):
        (x, low), (_, high) = centres(k, r)
        w, angle = r + 20, math.pi * np.arange(chords + 1) / chords
        first = np.column_stack((x - r * np.cos(angle), low + r * np.sin(angle)))
        second = np.column_stack((x + r * np.cos(angle), high - r * np.sin(angle)))
        corners = [(x - w, low), (x + w, low), (x + w, high), (x - w, high)]
        points = np.vstack(([corners[0]], first, corners[1:3], second, corners[3:]))
        # the block's sides are filled up with vertices, so that there are 1000
        more = VERTICES - len(points)
        side = np.column_stack((np.full(more, x - w), np.linspace(high, low, more + 2)[1:-1]))
        out[k] = np.vstack((points, side))
    out.tofile(where / "input.f64")
    np.floor(out * 1000 + 0.5).astype(np.int32).tofile(where / "input.bin")
    (where / "radii.txt").write_text("".join("%r\n" % r for r in radii()), encoding="utf-8")


def polygons_of(where, name):
    """list of arrays in nm"""
    import numpy as np
    import outlines
    if name != "geos":
        return outlines.read_gds(where / (name + ".gds"))["1/0"]
    data, at, found = np.fromfile(where / "geos.bin", np.int32), 0, []
    while at < len(data):
        found.append(data[at + 1:at + 1 + 2 * data[at]].reshape(-1, 2))
        at += 1 + 2 * data[at]
    return found


def write_gds(path, polygons):
    """for the reader of geos_check alone"""
    import numpy as np

    def record(kind, payload=b""):
        return struct.pack(">HH", 4 + len(payload), kind) + payload

    parts = [record(0x0305, bytes.fromhex("3e4189374bc6a7f03944b82fa09b5a54"))]
    for p in polygons:
        closed = np.vstack((p, p[:1])).astype(">i4").tobytes()
        parts += [record(0x0800), record(0x0d02, b"\0\1"), record(0x0e02, b"\0\0"), record(0x1003, closed), record(0x1100)]
    path.write_bytes(b"".join(parts) + record(0x0400))


def quality(where, name, checker):
    """vertices, signed error of those on the arcs against the exact biased arcs, short edges, GEOS clearance"""
    import numpy as np
    polygons, list_ = polygons_of(where, name), radii()
    low = high = 0.0
    edges, total = [], 0
    for p in polygons:
        middle = (p.min(axis=0) + p.max(axis=0)) / 2000.0
        k = int(round(middle[0] / PITCH) + ROW * round(middle[1] / PITCH))
        total += len(p)
        edges.append(np.hypot(*(np.roll(p, -1, axis=0) - p).T))
        for number, (x, y) in enumerate(centres(k, list_[k])):
            q = p / 1000.0 - (x, y)
            inner = q[:, 1] * (1 if number == 0 else -1) > 2.0  # off the ends, where the corners are
            r = np.hypot(q[:, 0], q[:, 1])
            off = 1000 * (r[inner & (r < list_[k] + 5)] - (list_[k] - BIAS))
            low, high = min(low, off.min()), max(high, off.max())
    edges = np.concatenate(edges)
    write_gds(where / "check.gds", polygons)
    said = subprocess.run([checker, where / "check.gds", "1", "0", "0"], capture_output=True, text=True, check=True).stdout
    return {"vertices": total, "error_low_nm": low, "error_high_nm": high, "short_edges": int((edges < 5).sum()),
            "shortest_nm": edges.min(), "clearance_nm": 1000 * float(re.search(r"clearance ([\d.]+)", said)[1])}


def one_round(where, programs):
    """{what: (cpu_ms, bytes)}"""
    environment = dict(os.environ, QT_QPA_PLATFORM="offscreen", LC_ALL="C")
    found = {}
    for command in programs:
        done = subprocess.run(command, capture_output=True, text=True, check=False, env=environment)
        if done.returncode:
            sys.exit("%s: %s" % (command, (done.stdout + done.stderr)[-2000:]))
        for line in done.stdout.splitlines():
            if match := re.fullmatch(r"((?:bias|write) [^,]*),([^,]*),(\d+)", line):
                found[match[1]] = float(match[2]), int(match[3])
    return found


def measure(build, rounds, where):
    subprocess.run(["cmake", "--build", build, "--target", "bench_mask_peers"], check=True, capture_output=True)
    for source, name in ((HERE / "peers/geos_bias.c", "geos_bias"), (ROOT / "tests/accept/geos_check.c", "geos_check")):
        subprocess.run(["cc", "-O2", source, "-lgeos_c", "-lm", "-o", where / name], check=True)
    write_input(where)
    programs = ([build / "tests/bench/bench_mask_peers", where / "radii.txt", where],
                ["/usr/bin/python3", HERE / "peers/gdspy_bias.py", where],
                ["klayout", "-b", "-r", HERE / "peers/kl_bias.py", "-rd", "dir=%s" % where],
                [where / "geos_bias", where / "input.f64", where / "geos.bin"])
    took = [one_round(where, programs) for _ in range(rounds)]

    def middle(what):
        return statistics.median(r[what][0] for r in took)

    rows = []
    for name, tool, setting in TOOLS:
        rows.append({"task": "bias", "tool": tool, "setting": setting, "cpu_ms": middle("bias " + name),
                     **quality(where, name, where / "geos_check")})
    for tool, formats in (("flexwright", ("gds", "oasis")), ("gdspy", ("gds",)), ("klayout", ("gds", "oasis"))):
        for kind in formats:
            what = "write %s-input %s" % (tool, kind)
            rows.append({"task": "write " + kind, "tool": {"flexwright": "Flexwright", "klayout": "KLayout"}.get(tool, tool), "setting": "",
                         "cpu_ms": middle(what), "vertices": HINGES * VERTICES, "bytes": took[0][what][1]})
    return rows


def version(command, pattern):
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    match = re.search(pattern, done.stdout + done.stderr)
    return match[1] if match else "unknown"


def provenance(asked):
    cpu = re.search(r"^model name\s*:\s*(.*)$", pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8"), re.M)
    facts = {"command": "tests/bench/mask_peers.py build --rounds %d" % asked.rounds, "date": asked.date,
             "processor": cpu[1] if cpu else platform.machine(),
             "system": platform.freedesktop_os_release().get("PRETTY_NAME", platform.system()),
             "compiler": version(["cc", "--version"], r"(.*)\n"),
             "KLayout": version(["klayout", "-v"], r"KLayout (\S+)"),
             "gdspy": version(["/usr/bin/python3", "-c", "import gdspy; print('v', gdspy.__version__)"], r"v (\S+)"),
             "GEOS": version(["geos-config", "--version"], r"(\S+)")}
    return [{"task": "provenance", "tool": k, "setting": v} for k, v in facts.items()]


def shown(value, digits):
    """digits that count, or behind the point where below 0; whole numbers from 1000 on"""
    number = float(value)
    return "%.0f" % number if number >= 1000 else ("%.*g" if digits > 0 else "%.*f") % (abs(digits), number)


def page(rows):
    """from the rows of the CSV, texts"""
    facts = {r["tool"]: r["setting"] for r in rows if r["task"] == "provenance"}
    yield "# Masks beside other tools\n\n"
    yield ("Written by `tests/bench/mask_peers.py` from [the measured rows](data/mask-benchmarks.csv); do not edit. 1000 hinges, none "
           "like another: two half circles of 80 to 110 um on either side of a neck of 8 um. Other tools get them as polygons of 1000 "
           "vertices, KLayout on its grid of 1 nm, gdspy and GEOS as doubles; Flexwright keeps lines and arcs to the end. "
           "Times are CPU times of the operation alone, in the tool's own process, without start-up; the tools take turns, median of the rounds.\n\n")
    yield ("## Moved outward by 1.5 um, on the 1 nm grid\n\nThe exact arcs are known: error of a vertex, along the radius, on any half "
           "circle. Clearance: the least move of a vertex that would break a polygon (GEOS). The grid alone allows 0.71 nm.\n\n")
    yield ("| tool | setting | CPU ms | vertices | vertex error nm | edges below 5 nm | shortest edge nm | clearance nm |\n"
           "|---|---|---|---|---|---|---|---|\n")
    for r in rows:
        if r["task"] == "bias":
            yield ("| %s | %s | %s | %s | %s to +%s | %s | %s | %s |\n"
                   % (r["tool"], r["setting"], shown(r["cpu_ms"], 3), r["vertices"], shown(r["error_low_nm"], -2),
                      shown(r["error_high_nm"], -2), r["short_edges"], shown(r["shortest_nm"], 3), shown(r["clearance_nm"], 3)))
    yield "\n## The same 1000 x 1000 vertices, written\n\n| tool | format | CPU ms | bytes |\n|---|---|---|---|\n"
    for r in rows:
        if r["task"].startswith("write "):
            yield "| %s | %s | %s | %s |\n" % (r["tool"], r["task"][6:].upper() if r["task"] == "write oasis" else "GDSII",
                                              shown(r["cpu_ms"], 3), r["bytes"])
    yield ("\nKLayout's OASIS is compressed (CBLOCK, level 2), as Flexwright's is. GEOS writes no masks.\n\n## Measured with\n\n"
           + "".join("- %s: %s\n" % (k, v) for k, v in facts.items()))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", nargs="?", type=pathlib.Path)
    parser.add_argument("--date", default="undated")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--report", action="store_true")
    asked = parser.parse_args()
    if not asked.report:
        with tempfile.TemporaryDirectory() as temporary:
            rows = provenance(asked) + measure(asked.build.resolve(), asked.rounds, pathlib.Path(temporary))
        with DATA.open("w", newline="", encoding="utf-8") as out:
            writer = csv.DictWriter(out, FIELDS, lineterminator="\n", restval="")
            writer.writeheader()
            writer.writerows({k: "%.6g" % v if isinstance(v, float) else v for k, v in r.items()} for r in rows)
    with DATA.open(newline="", encoding="utf-8") as file:
        PAGE.write_text("".join(page(list(csv.DictReader(file)))), encoding="utf-8")


if __name__ == "__main__":
    main()
