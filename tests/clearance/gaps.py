#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Gaps between outlines (<probe kind="gap">) of random devices against GEOS: dense samples, distances by shapely.

    tests/clearance/gaps.py build/tests/clearance_outlines --seed 1 --count 60

At every row the gap is the distance of the outlines; no sample is below the least, or above the largest, by more than
max(1 nm, 0.1 %), and samples come as near to both as their spacing allows. README.md says what is compared."""
import argparse
import json
import os
import random
import subprocess
import sys
import tempfile

import compare

SAMPLES = 1601


def probes(text):
    """a gap for every pair of bodies, and of every body and the ground"""
    bodies = [part.split('"')[0] for part in text.split('<body id="')[1:]]
    pairs = [(a, b) for i, a in enumerate(bodies) for b in bodies[i + 1:] + ["ground"]]
    lines = ['<probe id="g%d" kind="gap" a="%s" b="%s"/>' % ((i,) + (pair if i % 2 else pair[::-1]))
             for i, pair in enumerate(pairs)]
    return text.replace("</mechanism>", "</mechanism>\n" + "\n".join(lines))


def faults_of(gap, truth, q, every):
    n = truth.n
    a, b = gap["a"] % (n + 1), gap["b"] % (n + 1)
    p, o = truth.outlines(a, b)

    def at(i):
        return truth.placed(p, a, q[i]).distance(truth.placed(o, b, q[i]))
    # arcs are flattened to 0.5 nm; rows lie on the constraints where the dense output does not
    off = 1.5e-9 + 1e-6 * gap["moved"]
    rows = set(range(0, len(q), every))
    for extreme in (min(gap["m"]), max(gap["m"])):  # and all about both
        i = gap["m"].index(extreme)
        rows |= set(range(max(0, i - 4), min(len(q), i + 5)))
    for i in sorted(rows):
        seen = at(i)
        if abs(seen - gap["m"][i]) > off:
            yield "row %d: %.4f um, by GEOS %.4f um" % (i, 1e6 * gap["m"][i], 1e6 * seen)
        open_ = max(1e-9, 1.001e-3 * gap["m"][i])
        if seen < gap["minimum"] - open_ - off:
            yield "row %d: %.4f um is below the least, %.4f um" % (i, 1e6 * seen, 1e6 * gap["minimum"])
        if seen > gap["maximum"] + open_ + off:
            yield "row %d: %.4f um is above the largest, %.4f um" % (i, 1e6 * seen, 1e6 * gap["maximum"])
    step = max(abs(x - y) for x, y in zip(gap["m"], gap["m"][1:]))  # between two rows it goes no further
    if not min(gap["m"]) - step - off <= gap["minimum"] <= min(gap["m"]) + off:
        yield "least %.4f um, of rows %.4f um" % (1e6 * gap["minimum"], 1e6 * min(gap["m"]))
    if not max(gap["m"]) - off <= gap["maximum"] <= max(gap["m"]) + step + off:
        yield "largest %.4f um, of rows %.4f um" % (1e6 * gap["maximum"], 1e6 * max(gap["m"]))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=60)
    args = parser.parse_args()
    done, seed, gaps, faults, meet = 0, args.seed, 0, 0, 0
    with tempfile.TemporaryDirectory() as directory:
        while done < args.count and seed < args.seed + 20 * args.count:
            path = os.path.join(directory, "device.xml")
            kinds = [compare.comb] if random.Random(seed).random() < 0.2 else [compare.jaws, compare.four_bar]
            with open(path, "w", encoding="ascii") as f:
                f.write(probes(compare.device(seed, kinds)))
            run = subprocess.run([args.program, path, str(SAMPLES)], capture_output=True, text=True, check=False)
            seed += 1
            if run.returncode != 0:
                continue
            d = json.loads(run.stdout)
            truth = compare.Truth(d)
            done += 1
            for gap in d["gaps"]:
                gaps += 1
                meet += gap["minimum"] <= 0
                for text in faults_of(gap, truth, d["q"], 80):
                    faults += 1
                    print("seed %d, %d and %d: %s" % (seed - 1, gap["a"], gap["b"], text))
    print("%d devices of %d seeds, %d gaps, %d of which close: %d faults" % (done, seed - args.seed, gaps, meet, faults))
    return 1 if faults or done < args.count or gaps == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
