#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""rules.py PROGRAM [--keep DIR]: the DRC script of a flow's rules before the program's own checker, on random devices.

FW_DRC_COUNT (2; with FW_TEST_ALL=1, as in ./test --all, 24; 200 on demand) devices of random_devices.py from seed FW_DRC_FIRST (40) on,
whose masks break rules: limits are larger than the tables', as warnings. What the script finds lies in places of the certificate, and
each of its places has something of the script's in it."""
import collections
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path[:0] = [str(ROOT / "tests/accept"), str(ROOT / "klayout/python")]
sys.dont_write_bytecode = True
import random_devices  # noqa: E402
import random_masks  # noqa: E402
from flexwright_klayout import rules as drc  # noqa: E402

ROWS = """
<rule kind="width" layer="{device}" min="12 um" source="t" severity="warning"/>
<rule kind="space" layer="{device}" min="11 um" source="t" severity="warning"/>
{notch}
<rule kind="width" layer="text" min="4.5 um" source="t" severity="warning"/>
<rule kind="feature" layer="marks" wavelength="405 nm" gap="60 um" resist="8 um" min="1.5*sqrt(wavelength*(gap + resist/2))" source="t" severity="warning"/>
<rule kind="enclosure" layer="text" inside="{device}" min="30 um" source="t" severity="warning"/>
<rule kind="enclosure" layer="marks" inside="{device}" min="15 um" source="t" severity="warning"/>
<rule kind="separation" layer="marks" from="text" min="90 um" source="t" severity="warning"/>
<rule kind="area" layer="text" of="island" min="700 um2" source="t" severity="warning"/>
<rule kind="area" layer="{device}" of="hole" min="9000 um2" source="t" severity="warning"/>
<rule kind="angle" layer="{device}" of="polygon" min="100 deg" source="t" severity="warning"/>
<rule kind="angle" layer="{device}" of="outline" min="85 deg" source="t" severity="warning"/>
<rule kind="edge" layer="{device}" of="polygon" min="700 nm" source="t" severity="warning"/>
<rule kind="density" layer="{device}" min="12 %" max="70 %" window="700 um" step="350 um" source="t" severity="warning"/>
"""
CHORDS = ("width", "space", "notch", "feature", "enclosure", "separation")


def data_with(where):
    """FLEXWRIGHT_DATA whose tables have the rows above only; every other one with notches"""
    where.mkdir()
    os.symlink(ROOT / "processes", where / "processes")
    (where / "masks").mkdir()
    for k, table in enumerate(sorted((ROOT / "masks").glob("*.xml"))):
        text = re.sub(r' min-(?:width|space)="[^"]*"', "", table.read_text(encoding="utf-8"))
        head, tail = text.split("<rule ", 1)[0], text[text.rindex("<rule "):].split("/>", 1)[1]
        device = re.search(r'gds="1/0" id="(\w+)"', text).group(1)
        notch = '<rule kind="notch" layer="%s" min="9 um" source="t" severity="warning"/>' % device if k % 2 else ""
        (where / "masks" / table.name).write_text(head + ROWS.format(device=device, notch=notch) + tail, encoding="utf-8")
    return where


def off_edge(x, y, edge):
    (ax, ay), (bx, by) = edge
    dx, dy = bx - ax, by - ay
    square = dx * dx + dy * dy
    t = max(0.0, min(1.0, ((x - ax) * dx + (y - ay) * dy) / square)) if square else 0
    return math.hypot(x - ax - t * dx, y - ay - t * dy)


def box_of(points):
    x, y = [p[0] for p in points], [p[1] for p in points]
    return min(x), min(y), max(x), max(y)


class Shapes:
    """shapes by where their own boxes are, so that those near a box are found without looking at all"""

    CELL, MOST = 20000, 4096  # nm; cells of one shape, beyond which it is looked at always

    def __init__(self, shapes):
        self.all, self.large, self.at = shapes, [], collections.defaultdict(list)
        self.boxes = [box_of(s) for s in shapes]
        for i, box in enumerate(self.boxes):
            cells = self.cells(box, 0)
            for cell in cells or ():
                self.at[cell].append(i)
            if cells is None:
                self.large.append(i)

    def cells(self, box, near):
        """of a box; None: too many"""
        x0, y0, x1, y1 = (int((v + d) // self.CELL) for v, d in zip(box, (-near, -near, near, near)))
        if (x1 - x0 + 1) * (y1 - y0 + 1) > self.MOST:
            return None
        return [(i, j) for i in range(x0, x1 + 1) for j in range(y0, y1 + 1)]

    def reach(self, box, near):
        """each shape, some twice, whose own box meets that one"""
        cells = self.cells(box, near)
        some = range(len(self.all)) if cells is None else (i for c in (self.large, *(self.at.get(c, ()) for c in cells)) for i in c)
        for i in some:
            x0, y0, x1, y1 = self.boxes[i]
            if x0 <= box[2] + near and x1 >= box[0] - near and y0 <= box[3] + near and y1 >= box[1] - near:
                yield self.all[i], self.boxes[i]


class Verdict:
    def __init__(self):
        self.wrong, self.missed, self.count, self.edge_error_nm = [], [], collections.Counter(), 0

    def say(self, text):
        self.wrong.append(text)
        print("FAIL  " + text, flush=True)

    def edges(self):
        """KLayout drops vertices that hardly leave the line between their neighbours when it reads a file, so that an edge which
        ends there is longer than as written: of a thousand short edges one may be missed for that"""
        self.count["edges at straight vertices"] = len(self.missed)
        if len(self.missed) > 1e-3 * self.count["edge places"]:
            for text in self.missed:
                self.say(text)

    def compare(self, name, rule, findings, found):
        kind, near = rule["kind"], 1.5
        if kind in CHORDS:
            near += 0.25e3 * rule["min"]
        if kind in ("area", "density"):  # of outlines, whose boxes chords do not reach
            near += self.edge_error_nm
        name = "%s: %s" % (name, drc.category(rule))
        places = Shapes([[[1e3 * v for v in f["box_um"][k:k + 2]] for k in (0, 2)] for f in findings])
        shapes = Shapes(found)
        self.count[kind + " places"] += len(findings)
        self.count[kind + " shapes"] += len(found)
        for shape, box in zip(shapes.all, shapes.boxes):
            if not any(True for _ in places.reach(box, near)):
                self.say("%s: KLayout alone has %s" % (name, shape))
        for f, (low, high) in zip(findings, places.all):
            box = (*low, *high)
            ends = [[1e3 * v for v in p] for p in f["at_um"]]
            if kind in CHORDS and f["value"] > 0:
                there = any(len(s) == 4 and min(max(off_edge(*ends[0], s[:2]), off_edge(*ends[1], s[2:])),
                                                max(off_edge(*ends[0], s[2:]), off_edge(*ends[1], s[:2]))) < 1 for s, _ in shapes.reach(box, near))
            elif kind in CHORDS:
                there = any(True for _ in shapes.reach(box, near))
            else:  # a corner, an edge, an island or hole, of a place's windows the worst: the very same
                if kind == "density":
                    box = (*ends[0], *ends[1])
                there = any(max(abs(a - b) for a, b in zip(own, box)) < near for _, own in shapes.reach(box, near))
            if not there and kind == "edge":
                self.missed.append("%s: KLayout has not %s" % (name, f["at_um"]))
            elif not there:
                self.say("%s: KLayout has not %s" % (name, {k: f[k] for k in ("value", "at_um", "pieces")}))


def draw(program, seed, where, data):
    """[(name, certificate, gds)] of the device's masks"""
    text, options = random_devices.device(seed)
    if seed % 3 == 2:
        text = text.replace('ref="al-masked-rie"', 'ref="soi-deep-rie"')
    file, out = where / ("%d.xml" % seed), where / str(seed)
    file.write_text(text, encoding="utf-8")
    fast = [o for o in random_masks.FAST if o not in ("--mask-format", "all")]
    done = subprocess.run([program, "mask", file, *fast, *options, "--mask-format", "gds", "-o", out], capture_output=True, text=True, check=False,
                          env=dict(os.environ, FLEXWRIGHT_DATA=str(data)))
    found = []
    if "[FW-D592]" in done.stderr:  # so many places that not all were looked for, as it says
        return found, done
    for path in sorted((out / "masks").glob("*.json")) if out.exists() else []:
        if "." in path.stem or not path.with_suffix(".gds").exists() or path.stem.endswith("-coupons"):
            continue
        found.append(("seed %d %s" % (seed, path.stem), json.loads(path.read_text(encoding="utf-8")), path.with_suffix(".gds")))
    return found, done


def asked_of_klayout(masks, where):
    """what the scripts find in masks, of each {"categories", "s"}; KLayout starts once for a few tens of them: what one finds
    may be some megabytes"""
    for start in range(0, len(masks), 25):
        some, jobs = masks[start:start + 25], []
        for _, certificate, gds in some:
            gds.with_suffix(".lydrc").write_text(drc.script(certificate), encoding="utf-8")
            jobs.append({"script": str(gds.with_suffix(".lydrc")), "gds": str(gds), "result": str(gds.with_suffix(".found.json"))})
        (where / "jobs.json").write_text(json.dumps(jobs))
        (where / "home").mkdir(exist_ok=True)
        done = subprocess.run(["klayout", "-b", "-r", HERE / "run_rules.rb", "-rd", "jobs=%s" % (where / "jobs.json")], capture_output=True,
                              text=True, check=False, env=dict(os.environ, QT_QPA_PLATFORM="offscreen", LC_ALL="C",
                                                               KLAYOUT_HOME=str(where / "home"), KLAYOUT_PATH=str(where / "home")))
        for (name, certificate, _), job in zip(some, jobs):
            result = pathlib.Path(job["result"])
            if not result.exists():
                sys.exit("KLayout does not run: " + done.stdout + done.stderr)
            yield name, certificate, json.loads(result.read_text(encoding="utf-8"))
            result.unlink()


def main():
    asked, first, count = random_masks.asked_of(__doc__, "DRC", first=40, few=2, every=24)
    verdict, masks, seed = Verdict(), [], first
    devices, seconds = 0, []
    with tempfile.TemporaryDirectory() as temporary:
        where = asked.keep or pathlib.Path(temporary)
        where.mkdir(parents=True, exist_ok=True)
        data = data_with(where / "data")
        while devices < count and seed < first + 3 * count + 10:
            found, done = draw(asked.program, seed, where, data)
            if not found and not re.search(r"error: .*\[FW-D\d+\]", done.stderr):
                verdict.say("seed %d: status %d: %s" % (seed, done.returncode, done.stderr[-500:]))
            seed, devices = seed + 1, devices + bool(found)
            masks += found
        for name, certificate, result in asked_of_klayout(masks, where):
            seconds.append(result["s"])
            for rule in certificate["rules"]:
                what = drc.category(rule)
                shapes = [s for path, some in result["categories"].items() if path == what or path.startswith(what + ", ") for s in some]
                own = [f for f in certificate["findings"] if f["rule"] == rule["kind"] and f["layer"] == rule["layer"] and f["other"] == rule["other"]
                       and f["limit"] in (rule["min"], rule["max"])]
                verdict.edge_error_nm = certificate["edge_error_nm"]
                verdict.compare(name, rule, own, shapes)
    verdict.edges()
    print("%d devices, seeds %d to %d, %d masks: %s; %d wrong; %.1f s a mask in KLayout, at most %.1f" %
          (devices, first, seed - 1, len(masks), ", ".join("%s %d" % c for c in sorted(verdict.count.items())), len(verdict.wrong),
           sum(seconds) / len(seconds), max(seconds)))
    enough = devices == count and all(verdict.count[k + " places"] for k in (*CHORDS, "area", "angle", "edge", "density"))
    if not enough:
        print("too few devices or kinds of findings")
    return 0 if enough and not verdict.wrong else 1


if __name__ == "__main__":
    sys.exit(main())
