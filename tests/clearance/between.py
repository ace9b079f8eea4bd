#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Jaws that swing fast and meet between two saved samples only: between.py CLEARANCE_OUTLINES

The gap is set to 20 nm less than what the swing takes. At every saved sample of that motion the jaws are well apart;
a verdict that looks at samples accepts it."""
import json
import math
import os
import subprocess
import sys
import tempfile

DATA = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "data", "clearance")
SAMPLES, WIDE, LESS = 5, 100e-6, 20e-9


def run(program, directory, gap):
    with open(os.path.join(DATA, "jaws.xml"), encoding="utf-8") as f:
        text = f.read()
    text = text.replace(' law="ramp" rise="16 ms"', "").replace('duration="20 ms"', 'duration="3.7 ms"')
    text = text.replace('value="60 uN"', 'value="5 uN"').replace('value="60 um"', 'value="%.9g um"' % (1e6 * gap))
    path = os.path.join(directory, "swing.xml")
    with open(path, "w", encoding="utf-8") as f:
        f.write(text)
    out = subprocess.run([program, path, str(SAMPLES)], capture_output=True, text=True, check=False)
    if out.returncode != 0:
        sys.exit(out.stderr)
    return json.loads(out.stdout)


def to_segment(p, a, b):
    ax, ay = b[0] - a[0], b[1] - a[1]
    t = ((p[0] - a[0]) * ax + (p[1] - a[1]) * ay) / (ax * ax + ay * ay)
    t = min(1, max(0, t))
    return math.hypot(p[0] - a[0] - t * ax, p[1] - a[1] - t * ay)


def apart(d, row, gap):
    """of the two edges that face each other"""
    ends = []
    for body, x in ((0, 0.5e-3), (1, 0.5e-3 + gap)):
        x0, y0, f0 = d["centres"][body]
        cx, cy, f = row[1 + 3 * body: 4 + 3 * body]
        c, s = math.cos(f - f0), math.sin(f - f0)
        ends.append([(cx + c * (x - x0) - s * (y - y0), cy + s * (x - x0) + c * (y - y0)) for y in (0.8e-3, 1.6e-3)])
    p, q = ends
    return min(min(to_segment(e, *q) for e in p), min(to_segment(e, *p) for e in q))


def main():
    program = sys.argv[1]
    with tempfile.TemporaryDirectory() as directory:
        wide = run(program, directory, WIDE)["clearance"]
        taken = wide["start"] - wide["m"]
        meet = run(program, directory, taken - LESS)
        keep = run(program, directory, taken + 50 * LESS)
    sampled = min(apart(meet, row, taken - LESS) for row in meet["q"])
    c = meet["clearance"]
    print("taken %.4f um of the gap; nearest at %d samples %.4f um; the verdict: %.4g um at %.6f ms"
          % (1e6 * taken, len(meet["q"]), 1e6 * sampled, 1e6 * c["m"], 1e3 * c["t"]))
    faults = []
    if not sampled > 20 * LESS:
        faults.append("the samples see it, too: this is no test")
    if c["m"] > 0 or {c["a"], c["b"]} != {0, 1}:
        faults.append("jaws that meet between samples are not seen")
    if keep["clearance"]["m"] <= 0:
        faults.append("jaws that keep 1 um are said to meet")
    for f in faults:
        print("FAULT: " + f)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
