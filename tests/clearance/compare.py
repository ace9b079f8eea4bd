#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Clearances of random devices against GEOS: dense samples of the motion, distances by shapely.

    tests/clearance/compare.py build/tests/clearance_outlines --seed 1 --count 300

The least distance over dense samples is never below what the verdict proves (no false clear), and
what the verdict calls the least is within 1 nm and its own error of it; a verdict that rejects a
device whose parts stay apart is a false alarm. README.md says what is compared."""
import argparse
import json
import math
import os
import random
import subprocess
import sys
import tempfile

try:
    from shapely.geometry import LineString, Point
    from shapely import affinity, ops
except ImportError:
    print("python3-shapely is not installed")
    sys.exit(77)

SAMPLES = 4001
HEAD = """<?xml version="1.0" encoding="UTF-8"?>
<device xmlns="urn:flexwright:device:1" name="random">
<material ref="silicon-100" thickness="50 um"/><limits safety-factor="1.5"/>
<flow ref="al-masked-rie"/>
<flexure id="f" {flexure}/>
<mechanism>
{mechanism}
</mechanism>
<scene name="s" duration="{ms} ms">
{loads}
</scene>
</device>
"""


def flexure(r):
    if r.random() < 0.6:
        return 'kind="leaf" length="%.1f um" width="%.2f um" gap="10 um"' % (
            r.uniform(250, 500), r.uniform(7, 12))
    return 'kind="csfh" length="%.1f um" angle="%.0f deg" width="%.2f um" gap="8 um"' % (
        r.uniform(240, 380), r.uniform(180, 250), r.uniform(7.5, 10))


def law(r):
    return r.choice(['', 'law="ramp" rise="%.2f ms"' % r.uniform(0.5, 4),
                     'law="sine" frequency="%.0f Hz"' % r.uniform(100, 900)])


def jaws(r):
    """two plates on the ground that move towards each other"""
    gap, width, tall = r.uniform(20, 250), r.uniform(0.6, 1.1), r.uniform(0.5, 0.9)
    high, at = r.uniform(1.0, 1.5), r.uniform(0.15, 0.35)
    right = width + gap * 1e-3
    body = '<body id="%s" x="%.5f mm" y="%.4f mm" plate-width="%.4f mm" plate-height="%.4f mm"/>'
    hinge = ('<revolute id="%s" a="ground" a-x="%.5f mm" a-y="0 mm" b="%s" b-x="%.5f mm" '
             'b-y="%.4f mm" hinge="f"/>')
    lines = [body % ('l', 0, high, width, tall), body % ('r', right, high, width, tall * r.uniform(0.8, 1)),
             hinge % ('A', -at, 'l', -at, -high), hinge % ('B', right + at, 'r', at, -high)]
    push = 10 ** r.uniform(-6, -4.2)
    loads = '<force on="l" fx="%.4g mN" fy="0 mN" %s/><force on="r" fx="%.4g mN" fy="0 mN" %s/>' % (
        1e3 * push, law(r), -1e3 * push * r.uniform(0, 1), law(r))
    return lines, loads


def four_bar(r):
    """links and a coupler within the frame"""
    w, h1, h2 = r.uniform(1.4, 2.2), r.uniform(1.1, 1.7), r.uniform(1.1, 1.7)
    lines = ['<body id="l" x="0 mm" y="%.4f mm" width="120 um"/>' % (h1 / 2),
             '<body id="c" x="%.4f mm" y="%.4f mm" width="%.0f um"/>' % (w / 2, (h1 + h2) / 2, r.uniform(120, 200)),
             '<body id="r" x="%.4f mm" y="%.4f mm" width="120 um"/>' % (w, h2 / 2)]
    joint = ('<revolute id="%s" a="%s" a-x="%.4f mm" a-y="%.4f mm" b="%s" b-x="%.4f mm" '
             'b-y="%.4f mm" hinge="f"/>')
    dy = (h2 - h1) / 2
    lines += [joint % ('A', 'ground', 0, 0, 'l', 0, -h1 / 2), joint % ('B', 'l', 0, h1 / 2, 'c', -w / 2, -dy),
              joint % ('C', 'c', w / 2, dy, 'r', 0, h2 / 2), joint % ('D', 'r', 0, -h2 / 2, 'ground', w, 0)]
    push = 10 ** r.uniform(-5.5, -3.7) * r.choice([-1, 1])
    return lines, '<force on="c" fx="%.4g mN" fy="0 mN" %s/>' % (1e3 * push, law(r))


def comb(r):
    """a plate that turns about a hinge below it, so that the fingers of its comb go sideways between the stator's"""
    wide, tall, high = r.uniform(0.5, 0.9), r.uniform(0.6, 0.9), r.uniform(1.0, 1.3)
    lines = ['<body id="p" x="0 mm" y="%.4f mm" plate-width="%.4f mm" plate-height="%.4f mm"/>' % (high, wide, tall),
             '<revolute id="A" a="ground" a-x="0 mm" a-y="0 mm" b="p" b-x="0 mm" b-y="%.4f mm" hinge="f"/>' % -high]
    gap = r.uniform(6, 14)
    push = 10 ** r.uniform(-6.6, -4.7) * r.choice([-1, 1])
    drive = ('<comb-drive id="c" kind="comb" on="p" x="%.4f mm" y="%.4f mm" direction="0 deg" fingers="%d" gap="%.2f um" '
             'overlap="%.1f um" length="%.1f um" voltage="1 V"/>')
    return lines, drive % (wide / 2 + r.uniform(0.05, 0.1), r.uniform(-0.1, 0.1), r.randint(3, 9), gap,
                           r.uniform(20, 50), r.uniform(90, 120)) + (
        '<force on="p" fx="%.4g mN" fy="0 mN" %s/>' % (1e3 * push, law(r)))


def device(seed, kinds):
    r = random.Random(seed)
    kind = r.choice(kinds)
    lines, loads = kind(r)
    text = HEAD.format(flexure=flexure(r), mechanism="\n".join(lines), loads=loads, ms="%.2f" % r.uniform(3, 12))
    return text.replace('rie"/>', 'rie" carrier="insulating"/>') if kind is comb else text


class Truth:
    def __init__(self, d):
        self.d, self.n = d, len(d["centres"])
        solids = [[] for _ in range(self.n + 1)]
        for p in d["pieces"]:
            solids[p["body"]].append(LineString(p["outline"]))  # -1: the ground, last
        self.joined = {}
        for low, up, x, y, radius in d["hinges"]:
            self.joined.setdefault(frozenset((low % (self.n + 1), up % (self.n + 1))), []).append(
                Point(x, y).buffer(radius + 1e-7, 512))
        self.solid = [ops.unary_union(s) for s in solids]

    def outlines(self, a, b):
        """of two solids without what lies in a hinge between them"""
        p, q = self.solid[a], self.solid[b]
        for disc in self.joined.get(frozenset((a, b)), []):
            p, q = p.difference(disc), q.difference(disc)
        return p, q

    def placed(self, shape, body, row):
        if body == self.n:
            return shape
        x0, y0, f0 = self.d["centres"][body]
        x, y, f = row[1 + 3 * body: 4 + 3 * body]
        c, s = math.cos(f - f0), math.sin(f - f0)
        return affinity.affine_transform(shape, [c, -s, s, c, x - c * x0 + s * y0, y - s * x0 - c * y0])

    def near(self, shapes, pair, row, distance):
        """parts of both outlines about where they are nearest in a row; they move little about it"""
        p, o = [self.placed(s, b, row) for s, b in zip(shapes, pair)]
        at = ops.nearest_points(p, o)[0].buffer(distance + 150e-6, 4).envelope
        out = []
        for shape, body in zip(shapes, pair):
            part = self.placed(shape, body, row).intersection(at)
            out.append(self.back(part, body, row))
        return out

    def back(self, shape, body, row):
        if body == self.n:
            return shape
        x0, y0, f0 = self.d["centres"][body]
        x, y, f = row[1 + 3 * body: 4 + 3 * body]
        c, s = math.cos(f - f0), math.sin(f - f0)
        return affinity.affine_transform(shape, [c, s, -s, c, x0 - c * x - s * y, y0 + s * x - c * y])

    def least(self, said, when):
        """of every pair, over all samples: coarse first, then all between the nearest of them"""
        q, best = self.d["q"], {}
        rows = list(range(0, len(q), 80)) + [len(q) - 1]
        for a in range(self.n):
            for b in range(a + 1, self.n + 1):
                p, o = self.outlines(a, b)
                if p.is_empty or o.is_empty:
                    continue

                def at(i):
                    return self.placed(p, a, q[i]).distance(self.placed(o, b, q[i]))
                d = [at(i) for i in rows]
                if max(d) - min(d) < 1e-10:
                    continue
                low = min(d), rows[d.index(min(d))]
                lows = sorted(range(len(rows)), key=lambda k: d[k])[:4]
                if (a, b) == said:  # and where the verdict has seen it
                    lows.append(min(range(len(rows)), key=lambda k: abs(q[rows[k]][0] - when)))
                if low[0] < 150e-6 or (a, b) == said:
                    whole = p, o
                    for k in lows:
                        p, o = self.near(whole, (a, b), q[rows[k]], d[k])
                        for i in range(max(0, rows[k] - 80), min(len(q), rows[k] + 81), 4):
                            low = min(low, (at(i), i))
                    p, o = self.near(whole, (a, b), q[low[1]], low[0])
                    fine = {i: at(i) for i in range(max(0, low[1] - 5), min(len(q), low[1] + 6))}
                    i = min(fine, key=fine.get)
                    bend = 0
                    if i - 1 in fine and i + 1 in fine:  # what the least between samples may be below
                        bend = max(0, fine[i - 1] + fine[i + 1] - 2 * fine[i]) / 8
                    low = min(low[0], fine[i]), i, bend
                best[(a, b)] = low if len(low) == 3 else low + (0,)
        return best


def judge(program, seed, directory, kinds):
    """None: the device cannot be drawn, or nothing moves; else what was compared"""
    path = os.path.join(directory, "device.xml")
    with open(path, "w", encoding="ascii") as f:
        f.write(device(seed, kinds))
    run = subprocess.run([program, path, str(SAMPLES)], capture_output=True, text=True, check=False)
    if run.returncode != 0:
        return None
    d = json.loads(run.stdout)
    c = d["clearance"]
    if c is None:
        return None
    n = len(d["centres"])
    said = tuple(sorted((c["a"] % (n + 1), c["b"] % (n + 1))))
    best = Truth(d).least(said, c["t"])
    if not best:
        return None
    pair = min(best, key=lambda k: best[k][0])
    truth = best[pair][0]
    # the arcs' flattening, and rows that lie on the constraints where the dense output does not
    slack = 1e-9 + 1e-9 + 1e-6 * c["moved"]
    faults = []
    if truth < c["low"] - slack:
        faults.append("false clear: %.4f um proved, %.4f um seen" % (1e6 * c["low"], 1e6 * truth))
    if c["m"] > 0 and truth <= 0:
        faults.append("meets, and was not seen")
    if c["m"] <= 0 and truth > slack:
        faults.append("false alarm: %.4f um apart" % (1e6 * truth))
    if c["m"] > 0 and said in best:
        off = best[said][0] - c["m"]  # samples only miss the least, they are never below it
        error = max(1e-9, 2.1e-3 * max(c["m"], abs(c["left"]))) + slack + best[said][2]
        if abs(off) > error:
            faults.append("%s %.4f um, said %.4f um" % (said, 1e6 * best[said][0], 1e6 * c["m"]))
    return {"seed": seed, "truth": truth, "said": c["m"], "faults": faults, "decision": c["decision"],
            "looked": c["looked"], "closer": truth < best.get(said, (truth,))[0] - slack}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=300)
    parser.add_argument("--combs", action="store_true", help="devices with a comb, and no others")
    args = parser.parse_args()
    kinds = [comb] if args.combs else [jaws, jaws, four_bar]
    done, faults, meet, seed, looked = 0, 0, 0, args.seed, 0
    worst = 0.0
    with tempfile.TemporaryDirectory() as directory:
        while done < args.count and seed < args.seed + 20 * args.count:
            r = judge(args.program, seed, directory, kinds)
            seed += 1
            if r is None:
                continue
            done += 1
            meet += r["said"] <= 0
            looked += r["looked"]
            if r["said"] > 0 and not r["closer"]:
                worst = max(worst, abs(r["truth"] - r["said"]))
            for text in r["faults"]:
                faults += 1
                print("seed %d: %s" % (r["seed"], text))
    print("%d devices of %d seeds: %d meet, %d faults; the least distance was off by at most %.2f nm; "
          "%d distances on average" % (done, seed - args.seed, meet, faults, 1e9 * worst,
                                       looked / max(1, done)))
    return 1 if faults or done < args.count else 0


if __name__ == "__main__":
    sys.exit(main())
