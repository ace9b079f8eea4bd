#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""stators.py OUTLINES PROGRAM [FIRST COUNT]: no two nets touch in the poses that are required.

Random six-bars with one or two combs on their platform and a required box of poses. The least distance of every stator
from all that moves, as the certificate's wiring says it of the workspace, against a search over poses of that box: the
platform is put there, the links follow from the circles about their hinges, distances are those of GEOS. The search
never comes below what the program says, nor does it stay above by more than 0.5 % and 5 nm; and where parts touch in a
required pose the device is rejected."""
import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile

try:
    from shapely.geometry import LineString
    from shapely import affinity, ops
except ImportError:
    print("python3-shapely is not installed")
    sys.exit(77)

FAST = ["--corners", "none", "--accuracy", "3e-2", "--hinge-model", "revolute", "--effects", "none", "--advice", "none"]
POINTS = {"A": (700, 150), "B": (200, 1400), "C": (800, 2700), "D": (2200, 2750), "E": (2850, 1450), "F": (2300, 150)}
LENGTHS = {"A": 300, "B": 250, "C": 200, "D": 240, "E": 350, "F": 400}
LINKS = ("AB", "BC", "CD", "DE", "EF")


def device(seed):
    r = random.Random(seed)
    size, um = r.uniform(1.0, 1.4), lambda x: "%.3f um" % x
    text = ('<device xmlns="urn:flexwright:device:1" name="stators-%d">\n  <material ref="silicon-100" strength="2.5 GPa" '
            'thickness="50 um"/>\n  <flow ref="%s"%s/>\n'
            % (seed, *r.choice((("al-masked-rie", ' carrier="insulating"'), ("soi-deep-rie", "")))))
    for k, length in LENGTHS.items():
        text += ('  <flexure id="%s" kind="csfh" length="%s" angle="%.3f deg" width="%s" gap="9 um"/>\n'
                 % (k, um(length * size), r.uniform(200, 250), um(r.uniform(7, 9))))
    text += "  <six-bar>\n"
    for k, (x, y) in POINTS.items():
        text += ('    <hinge at="%s" x="%s" y="%s" flexure="%s"/>\n'
                 % (k, um(size * x + r.uniform(-40, 40)), um(size * y + r.uniform(-40, 40)), k))
    for k in ("AB", "BC", "DE", "EF"):
        text += '    <link id="%s" width="%s"/>\n' % (k, um(r.uniform(110, 160)))
    width, height = size * r.uniform(1400, 1550), size * r.uniform(400, 480)
    text += ('    <platform id="CD" width="%s" height="%s" x="%s" y="%s"/>\n  </six-bar>\n  <scene name="s" duration="0.1 ms">\n'
             % (um(width), um(height), um(1500 * size), um(2900 * size)))
    gaps = []
    for side in r.choice(((0,), (-1, 1), (1,), (-1, 1))):
        overlap, more, gap = r.uniform(15, 60), r.uniform(40, 80), r.uniform(6, 14)
        gaps.append(gap)
        text += ('    <comb-drive id="drive%d" kind="comb" on="CD" x="%s" y="%s" direction="90 deg" fingers="%d" gap="%s" '
                 'overlap="%s" length="%s" voltage="5 V"/>\n'
                 % (side + 2, um(side * width * 0.17), um(height / 2 + more + overlap / 2), r.randint(4, 9), um(gap), um(overlap),
                    um(overlap + more)))
    room = min(gaps) * r.choice((0.4, 0.8, 1.3, 1.6))  # the last two of them mostly touch
    share = r.uniform(0.2, 0.8)
    box = (room * share, r.uniform(3, 30), math.degrees((1 - share) * room / 600))
    text += ('  </scene>\n  <workspace x-min="%s" x-max="%s" y-min="%s" y-max="%s" phi-min="%.5f deg" phi-max="%.5f deg"/>\n</device>\n'
             % (um(-box[0]), um(box[0] * r.random()), um(-box[1] * r.random()), um(box[1]), -box[2], box[2] * r.random()))
    return text


class Poses:
    def __init__(self, drawn):
        self.centres = drawn["centres"]
        self.solid, self.stator = [[] for _ in LINKS], {}
        for p in drawn["pieces"]:
            line = LineString(p["outline"])
            if p["body"] >= 0:
                self.solid[p["body"]].append(line)
            elif p["label"].startswith("stator"):
                self.stator.setdefault(p["label"], []).append(line)
        self.solid = [ops.unary_union(s) for s in self.solid]
        self.at = {}
        for low, up, x, y, _ in drawn["hinges"]:
            ends = [LINKS[b] if b >= 0 else "" for b in (low, up)]
            self.at[next(k for k in "ABCDEF" if all(k in e or not e and k in "AF" for e in ends))] = (x, y)

    def moved(self, dx, dy, turn):
        """(turn, from, to) of every link; None: out of reach"""
        x0, y0, _ = self.centres[2]
        c, s = math.cos(turn), math.sin(turn)

        def on_platform(p):
            x, y = p[0] - x0, p[1] - y0
            return (x0 + dx + c * x - s * y, y0 + dy + s * x + c * y)
        out = {2: (turn, (x0, y0), (x0 + dx, y0 + dy))}
        for base, knee, end, lower, upper in (("A", "B", "C", 0, 1), ("F", "E", "D", 4, 3)):
            a, b, e = (self.at[k] for k in (base, knee, end))
            to = on_platform(e)
            l1, l2, far = math.dist(a, b), math.dist(b, e), math.dist(a, to)
            if not abs(l1 - l2) < far < l1 + l2:
                return None
            side = math.copysign(1, (e[0] - a[0]) * (b[1] - a[1]) - (e[1] - a[1]) * (b[0] - a[0]))
            along = (l1 * l1 - l2 * l2 + far * far) / (2 * far)
            off = side * math.sqrt(max(0, l1 * l1 - along * along))
            ux, uy = (to[0] - a[0]) / far, (to[1] - a[1]) / far
            now = (a[0] + along * ux - off * uy, a[1] + along * uy + off * ux)

            def angle(p, q):
                return math.atan2(q[1] - p[1], q[0] - p[0])
            out[lower] = (angle(a, now) - angle(a, b), a, a)
            out[upper] = (angle(now, to) - angle(b, e), e, to)
        return out

    def near(self, stator):
        """of every body what is drawn within 150 um of the stator: nothing else comes nearer than 100 um in boxes of 50 um"""
        about = stator.buffer(150e-6, 2)
        found = {body: solid.intersection(about) for body, solid in enumerate(self.solid)}
        return {body: part for body, part in found.items() if not part.is_empty}

    def distance(self, stator, near, pose):
        moved = self.moved(*pose)
        if not moved:
            return math.inf
        least = math.inf
        for body, part in near.items():
            turn, start, end = moved[body]
            c, s = math.cos(turn), math.sin(turn)
            put = affinity.affine_transform(part, [c, -s, s, c, end[0] - c * start[0] + s * start[1],
                                                               end[1] - s * start[0] - c * start[1]])
            least = min(least, put.distance(stator))
        return least


def search(poses, stator, box, r):
    """the least distance: a grid, then ever nearer about the best poses"""
    def clip(p):
        return tuple(min(max(x, lo), hi) for x, (lo, hi) in zip(p, box))
    grid = [[lo + k * (hi - lo) / 4 for k in range(5)] for lo, hi in box]
    near = poses.near(stator)
    found = sorted((poses.distance(stator, near, (x, y, t)), (x, y, t)) for x in grid[0] for y in (grid[1][0], grid[1][2], grid[1][4])
                   for t in grid[2])[:3]
    for k, best in enumerate(found):
        step = 0.25
        while step > 1e-3 and best[0] > 0:
            tries = [clip([x + step * r.uniform(-1, 1) * (hi - lo) for x, (lo, hi) in zip(best[1], box)]) for _ in range(10)]
            now = min((poses.distance(stator, near, p), p) for p in tries)
            best, step = (now, step) if now[0] < best[0] else (best, step / 2)
        found[k] = best
    return min(found)


def compare(outlines, program, seed, where):
    """(stators compared, touching, what is wrong)"""
    path = pathlib.Path(where) / ("%d.xml" % seed)
    path.write_text(device(seed), encoding="utf-8")
    shown = subprocess.run([outlines, path, "3"], capture_output=True, text=True, check=False)
    out = pathlib.Path(where) / str(seed)
    run = subprocess.run([program, "plan", path, "-q", "--force", "-o", out, *FAST], capture_output=True, text=True, check=False)
    masks = sorted((out / "masks").glob("*.json")) if (out / "masks").exists() else []
    masks = [m for m in masks if "wiring" in json.loads(m.read_text())]
    if not shown.stdout or not masks:
        return 0, 0, [], run.stderr.strip()[:300]
    wiring = json.loads(masks[0].read_text())["wiring"]
    verdict = json.loads((out / "verdict.json").read_text()).get("verdict")
    poses, r, wrong, touch = Poses(json.loads(shown.stdout)), random.Random(seed), [], 0
    text = path.read_text()
    limit = [float(x.split()[0]) for x in (text.split("<workspace")[1].split('"')[1::2])]
    box = [(1e-6 * limit[0], 1e-6 * limit[1]), (1e-6 * limit[2], 1e-6 * limit[3]), tuple(math.radians(x) for x in limit[4:6])]
    for label, lines in poses.stator.items():
        least, at = search(poses, ops.unary_union(lines), box, r)
        said = [g for g in wiring["gaps"] if g["b"] == label or g["a"] == label]
        said = [g for g in said if g["moved_m"] is not None]
        if not said:
            wrong.append("seed %d: nothing is said of %s in the poses required; there are %s" % (seed, label, [(g["a"], g["b"]) for g in wiring["gaps"]]))
            continue
        m = min(g["moved_m"] for g in said)
        touch += least <= 0
        if least < m * 0.998 - 2e-9:
            wrong.append("seed %d: %s comes to %.4f um at %s, the program says %.4f" % (seed, label, 1e6 * least, at, 1e6 * m))
        if least > m * 1.005 + 5e-9:
            wrong.append("seed %d: the search finds %.4f um for %s, the program %.4f" % (seed, 1e6 * least, label, 1e6 * m))
        if least <= 0 and verdict == "accept":
            wrong.append("seed %d: %s touches what moves at %s and the device is accepted" % (seed, label, at))
    return len(poses.stator), touch, wrong, ""


def main():
    outlines, program = sys.argv[1:3]
    first, count = (int(x) for x in sys.argv[3:5]) if len(sys.argv) > 4 else (1, 3)
    stators, touches, wrong, refused, seed = 0, 0, 0, 0, first
    with tempfile.TemporaryDirectory() as where:
        done = 0
        while done < count and seed < first + 5 * count:
            n, touch, faults, why = compare(outlines, program, seed, where)
            seed += 1
            if not n:
                refused += 1
                print("seed %d: %s" % (seed - 1, why), flush=True)
                continue
            done += 1
            stators, touches, wrong = stators + n, touches + touch, wrong + len(faults)
            for f in faults:
                print(f, flush=True)
    print("%d devices, %d stators, %d touch; %d not drawn; %d wrong" % (done, stators, touches, refused, wrong))
    return 1 if wrong or not done else 0


if __name__ == "__main__":
    sys.exit(main())
