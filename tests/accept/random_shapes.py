#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""random_shapes.py PROGRAM [--keep DIR]: bodies that somebody drew, in masks, before KLayout.

FW_SHAPES_COUNT (40; with FW_TEST_ALL=1 400) jaws of plates, bars, discs, outlines and lettering at any angle, some cut out, with
copies and mirror images, from seed FW_SHAPES_FIRST (1000) on; before them windows at every few degrees and letters with dots.
KLayout unites the same shapes, cuts the holes out and takes the bias: above the hinge the mask may differ from that by 60 nm
(chords), and no width or space but at corners may be below the rule. A jaw that is refused must have a reason that KLayout's
union has too: it falls apart, a hole is not inside, a corner has no room, a width or space is too small."""
import json
import math
import os
import pathlib
import random
import re
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
import random_masks  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent
DEVICE = """<device xmlns="urn:flexwright:device:1" name="jaw-%s">
<material ref="silicon-100" thickness="50 um" strength="2.5 GPa"/>
<flow ref="al-masked-rie"/>
<flexure id="f" kind="csfh" radius="80 um" angle="240 deg" width="8 um" gap="10 um"/>
<mechanism>
<body id="jaw" x="0 mm" y="0.1 mm">
%s
</body>
<revolute id="A" a="ground" b="jaw" b-y="-0.1 mm" hinge="f"/>
</mechanism>
<scene name="push" duration="0.1 ms"><force on="jaw" x="1 mm" fy="1 nN"/></scene>
<die tethers="no"%s/>
</device>
"""
FAST = ["--corners", "none", "--accuracy", "3e-2", "--hinge-model", "revolute", "--advice", "none", "-q"]
RULES = {143, 144, 145, 156}  # of the mask
DRAWN = {308, 316, 318}  # of what is drawn


def um(value):
    return "%.6g um" % value


def turned(points, deg):
    c, s = math.cos(math.radians(deg)), math.sin(math.radians(deg))
    return [(x * c - y * s, x * s + y * c) for x, y in points]


def moved(points, x, y):
    return [(a + x, b + y) for a, b in points]


def arc(x, y, radius, start, end):
    n = max(2, math.ceil(math.radians(end - start) / (2 * math.acos(1 - 1e-3 / radius))))
    at = [math.radians(start + (end - start) * i / n) for i in range(n + 1)]
    return [(x + radius * math.cos(a), y + radius * math.sin(a)) for a in at]


def rectangle(width, height, corner=0):
    w, h = width / 2, height / 2
    if not corner:
        return [(-w, -h), (w, -h), (w, h), (-w, h)]
    return [p for k, (x, y) in enumerate([(w, h), (-w, h), (-w, -h), (w, -h)])
            for p in arc(math.copysign(w - corner, x), math.copysign(h - corner, y), corner, 90 * k, 90 * k + 90)]


class Jaw:
    """shapes as elements, and as polygons in the body's frame, um"""

    def __init__(self, name):
        self.name, self.elements, self.polygons, self.letters, self.holes = name, [], [], False, ""

    def add(self, element, points, hole=False, copies=1, pitch=(0, 0), mirror=False):
        more = ' copies="%d" pitch-x="%s" pitch-y="%s"' % (copies, *map(um, pitch)) if copies > 1 else ""
        more += (' symmetry="y"' if mirror else "") + (' hole="yes"' if hole else "")
        self.elements.append(re.sub(r"(/?>)", lambda m: more + m.group(1), element, count=1))
        for i in range(copies):
            here = moved(points, i * pitch[0], i * pitch[1])
            self.polygons += [(hole, p) for p in ([here, [(-x, y) for x, y in here]] if mirror else [here])]

    def plate(self, x, y, width, height, angle=0, corner=0, **more):
        text = ' corner="%s"' % um(corner) if corner else ""
        self.add('<plate x="%s" y="%s" width="%s" height="%s" angle="%.6g deg"%s/>' % (um(x), um(y), um(width), um(height), angle, text),
                 moved(turned(rectangle(width, height, corner), angle), x, y), **more)

    def bar(self, x, y, to_x, to_y, width, ends, **more):
        length, angle = math.hypot(to_x - x, to_y - y), math.degrees(math.atan2(to_y - y, to_x - x))
        points = [(0, -width / 2), (length, -width / 2), (length, width / 2), (0, width / 2)]
        if ends == "round":
            points = arc(length, 0, width / 2, -90, 90) + arc(0, 0, width / 2, 90, 270)
        self.add('<bar x="%s" y="%s" to-x="%s" to-y="%s" width="%s" ends="%s"/>' % (um(x), um(y), um(to_x), um(to_y), um(width), ends),
                 moved(turned(points, angle), x, y), **more)

    def disc(self, x, y, radius, **more):
        self.add('<disc x="%s" y="%s" radius="%s"/>' % (um(x), um(y), um(radius)), moved(arc(0, 0, radius, 0, 360)[:-1], x, y), **more)

    def outline(self, x, y, points, **more):
        lines = "".join('<line to-x="%s" to-y="%s"/>' % (um(a), um(b)) for a, b in points[1:] + points[:1])
        self.add('<outline x="%s" y="%s" start-x="%s" start-y="%s">%s</outline>' % (um(x), um(y), um(points[0][0]), um(points[0][1]), lines),
                 moved(points, x, y), **more)

    def lettering(self, text, x, y, height):
        self.letters = True
        self.elements.append('<lettering text="%s" x="%s" y="%s" height="%s"/>' % (text, um(x), um(y), um(height)))

    def text(self):
        return DEVICE % (self.name, "\n".join(self.elements), self.holes)


def drawn_by_chance(seed):
    source = random.Random(seed)
    jaw, snap = Jaw("%d" % seed), source.choice((1, 10, 50))
    between = lambda low, high: low + (high - low) * source.random()
    on_grid = lambda low, high: round(between(low, high) / snap) * snap
    width, height = max(300, on_grid(300, 900)), max(200, on_grid(200, 700))
    middle = 400 + height / 2 + (0 if source.random() < 0.5 else between(0, 30))
    jaw.plate(0, middle, width, height)
    jaw.bar(0, 150, 0, middle, 140, "square")
    for _ in range(source.randint(1, 6)):
        kind, hole = source.choice(("plate", "bar", "disc", "outline")), source.random() < 0.4
        x, y, size = on_grid(-width / 2, width / 2), on_grid(middle - height / 2 + 50, middle + height / 2), 1
        if hole:
            x, y, size = between(80 - width / 2, width / 2 - 80), between(middle - height / 2 + 80, middle + height / 2 - 80), 1 / 3
        more = {"hole": hole}
        if kind != "outline" and source.random() < 0.3:
            more.update(copies=source.randint(2, 4), pitch=(on_grid(-150, 150) or 50, on_grid(-60, 150)))
        more["mirror"] = source.random() < 0.25
        if kind == "plate":
            w, h = size * max(15, on_grid(10, 400)), size * max(15, on_grid(10, 400))
            jaw.plate(x, y, w, h, source.choice((0, 0, 45, 90, between(-180, 180))), source.choice((0, 0, min(w, h) / 4)), **more)
        elif kind == "bar":
            jaw.bar(x, y, x + size * (on_grid(-400, 400) or 100), y + size * on_grid(-60, 400), max(5, size * on_grid(8, 120)),
                    source.choice(("square", "round")), **more)
        elif kind == "disc":
            jaw.disc(x, y, max(3, size * max(5, on_grid(5, 200))), **more)
        else:
            n, radius = source.randint(3, 7), size * between(40, 250)
            jaw.outline(x, y, [(round(radius * between(0.5, 1) * math.cos(2 * math.pi * i / n), 1),
                                round(radius * between(0.5, 1) * math.sin(2 * math.pi * i / n), 1)) for i in range(n)], **more)
    if source.random() < 0.2:
        jaw.lettering(source.choice(("AB8", "R1.5", "Ä µ", "Q#", "i:0")), -60, middle, source.choice((72, 90)))
    if source.random() < 0.2:
        jaw.holes = ' release-pitch="%s"' % um(source.choice((30, 60, 100)))
    return jaw


def windows():
    """what has to be drawn: windows at any angle, and letters with dots"""
    for angle in (*range(0, 91, 6), 40, 44, 45, 46, 50):
        jaw = Jaw("window-%d" % angle)
        jaw.plate(0, 600, 600, 600)
        jaw.plate(0, 600, 100, 200, angle, hole=True)
        jaw.outline(150, 800, turned([(12, 0), (5, 12), (-6, 11), (-13, 1), (-7, -11), (6, -12)], angle), hole=True)
        yield jaw
    for text in ("R1.5", "i:0", "Ä.µ", "10%"):
        jaw = Jaw("letters-%d" % len(text.encode()))
        jaw.plate(0, 600, 600, 600)
        jaw.lettering(text, -200, 550, 72)
        yield jaw


def draw(program, jaw, where):
    """{"gds", "bias"} or {"refused": {numbers}, "said"}"""
    file, out = where / (jaw.name + ".xml"), where / jaw.name
    file.write_text(jaw.text(), encoding="utf-8")
    done = subprocess.run([program, "mask", file, *FAST, "--mask-format", "gds", "-o", out], capture_output=True, text=True, check=False)
    gds = out / "masks" / "al-masked-rie.gds"
    if done.returncode in (0, 4) and gds.exists():
        return {"gds": str(gds), "bias": json.loads(gds.with_suffix(".json").read_text(encoding="utf-8"))["bias_um_per_edge"]}
    return {"refused": sorted({int(n) for n in re.findall(r"error: .*\[FW-D(\d+)\]", done.stderr)}), "said": done.stderr.strip()[:400]}


def judge(jaw, job, result, windows_too):
    """yields what is wrong"""
    if "gds" in job:
        yield from result["wrong"]
        return
    numbers = set(job["refused"])
    if 152 in numbers:  # parts that meet do so on the grid of 1 nm, too
        numbers -= {147, 152}
    if not numbers or not numbers <= RULES | DRAWN or not windows_too:
        yield "refused: " + job["said"]
    elif 318 in numbers and result["pieces"] == 1:
        yield "KLayout has one piece: " + job["said"]
    elif 316 in numbers and not jaw.letters and result["holes inside"] and "fall out" not in job["said"]:
        yield "KLayout has all holes inside: " + job["said"]


def main():
    asked, first, count = random_masks.asked_of(__doc__, "SHAPES", first=1000, few=40, every=400)
    named, wrong = list(windows()), 0
    with tempfile.TemporaryDirectory() as temporary:
        where = asked.keep or pathlib.Path(temporary)
        where.mkdir(parents=True, exist_ok=True)
        jaws = named + [drawn_by_chance(seed) for seed in range(first, first + count)]
        jobs = [dict(draw(asked.program, jaw, where), polygons=jaw.polygons, alike=not (jaw.letters or jaw.holes)) for jaw in jaws]
        (where / "jobs.json").write_text(json.dumps(jobs))
        done = subprocess.run(["klayout", "-b", "-r", HERE / "kl_shapes.py", "-rd", "jobs=%s" % (where / "jobs.json"), "-rd",
                               "result=%s" % (where / "result.json")], capture_output=True, text=True, check=False,
                              env=dict(os.environ, QT_QPA_PLATFORM="offscreen", LC_ALL="C", KLAYOUT_HOME=str(where)))
        if not (where / "result.json").exists():
            sys.exit("KLayout does not run: " + done.stdout + done.stderr)
        for i, (jaw, job, result) in enumerate(zip(jaws, jobs, json.loads((where / "result.json").read_text()))):
            for what in judge(jaw, job, result, i >= len(named)):
                wrong += 1
                print("FAIL  %s: %s" % (jaw.name, what), flush=True)
        good = sum("gds" in job for job in jobs)
    print("%d jaws, %d of them drawn, %d alike to the shape; %d wrong"
          % (len(jaws), good, sum("gds" in job and job["alike"] for job in jobs), wrong))
    return 1 if wrong or good < len(named) + count // 10 else 0


if __name__ == "__main__":
    sys.exit(main())
