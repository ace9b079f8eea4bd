#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""written_rules.py PROGRAM [--keep DIR]: width and space rules of random devices before KLayout, in both directions.

FW_RULES_COUNT (3; with FW_TEST_ALL=1, as in ./test --all, 24) devices of random_devices.py from seed FW_RULES_FIRST (3) on, in
every flow that they name and, of every third one each, in soi-deep-rie or silicon-on-glass; with tolerances from 0.5 to 1000 nm, both ways of flattening
and every vertex limit; the test die with one of three. Rules are rows of the layer tables, as warnings, so that the masks are written. Each is judged
  - with a limit of 12 um: every pair of edges that KLayout finds lies in a place that the certificate lists, and every place
    has a pair in it with the value of the certificate, to 1e-3 nm;
  - with the whole nanometres just below and just above the least value on each layer: nothing is found, and something is.
Layers of which the program says that it could not end (FW-D592) are left out. Left out are pairs that are square but for the grid, where neither edge is of an arc (docs/theory/masks.md); they are counted."""
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ET

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(HERE))
sys.dont_write_bytecode = True
import random_devices  # noqa: E402
import random_masks  # noqa: E402

WIDE_NM = 12000
STEP_NM = WIDE_NM / 4  # of what a place covers of its edges
TOLERANCES = ("5", "1000", "1.5", "100", "20", "300", "0.5", "2.5")
VERTICES = ("4094", "199", "8190")
KINDS = ("width", "space")
DROPPED = re.compile(r' min-(?:width|space)="[^"]*"')


def data_with(where, limits):
    """FLEXWRIGHT_DATA with tables that have these rows only: limits(layer, kind) in nm or None"""
    where.mkdir()
    os.symlink(ROOT / "processes", where / "processes")
    (where / "masks").mkdir()
    for table in (ROOT / "masks").glob("*.xml"):
        rows = ""
        for e in ET.parse(table).getroot():
            if not e.tag.endswith("}layer") or e.get("documentation") == "yes":
                continue
            for kind in KINDS:
                nm = limits(table.stem, e.get("gds"), kind)
                if nm:
                    rows += '<rule kind="%s" layer="%s" min="%d nm" source="test" severity="warning"/>\n' % (kind, e.get("id"), nm)
        text = table.read_text(encoding="utf-8")
        head, tail = text.split("<rule ", 1)[0], text[text.rindex("<rule "):].split("/>", 1)[1]
        (where / "masks" / table.name).write_text(DROPPED.sub("", head) + rows + tail, encoding="utf-8")
    return where


class Mask:
    """one device and its options; its flows are drawn with rules as they are wanted"""

    def __init__(self, program, seed, where):
        self.program, self.seed, self.where, self.runs = program, seed, where, 0
        text, self.options = random_devices.device(seed)
        if seed % 3:  # of three plates, two of them with lengths that an etch takes
            text = text.replace('ref="al-masked-rie"', 'ref="%s"' % ("soi-deep-rie" if seed % 3 == 2 else "silicon-on-glass"))
        self.file = where / ("%d.xml" % seed)
        self.file.write_text(text, encoding="utf-8")
        self.more = ["--mask-tolerance", TOLERANCES[seed % len(TOLERANCES)], "--mask-vertices", VERTICES[seed % 3],
                     "--mask-flatten", "equal-area" if seed % 2 else "inside", "--mask-format", "gds"]
        for option in self.more[::2]:  # those of this test instead
            while option in self.options:
                at = self.options.index(option)
                del self.options[at:at + 2]

    def name(self, flow, gds):
        return "seed %d, tolerance %s nm, %s %s" % (self.seed, self.more[1], flow, gds)

    def draw(self, limits):
        """{(flow, gds): (file, layer of the certificate, findings)} of all layers that have polygons"""
        self.runs += 1
        data = data_with(self.where / ("data-%d-%d" % (self.seed, self.runs)), limits)
        out = self.where / ("%d-%d" % (self.seed, self.runs))
        fast = [o for o in random_masks.FAST if not o.startswith("--mask") and o != "all"]
        done = subprocess.run([self.program, "mask", self.file, *fast, *self.options, *self.more, "-o", out], capture_output=True,
                              text=True, check=False, env=dict(os.environ, FLEXWRIGHT_DATA=str(data)))
        found = {}
        for path in sorted((out / "masks").glob("*.json")) if out.exists() else []:
            if "." in path.stem or not path.with_suffix(".gds").exists():
                continue
            if path.stem.endswith("-coupons") and (self.runs > 1 or self.seed % 3):
                continue  # the test die of one device of three
            said = json.loads(path.read_text(encoding="utf-8"))
            for layer in said["layers"]:
                if layer.get("unfinished"):  # with these limits too many edges are near each other, which is an error
                    assert "[FW-D592]" in done.stderr, path
                elif layer["polygons"]:
                    own = [f for f in said["findings"] if f["layer"] == layer["gds"] and f["rule"] in KINDS]
                    found[path.stem, layer["gds"]] = (path.with_suffix(".gds"), layer, own)
        return found, done


def klayout(jobs, where):
    (where / "jobs.json").write_text(json.dumps(jobs), encoding="utf-8")
    done = subprocess.run(["klayout", "-b", "-r", HERE / "kl_written.py", "-rd", "jobs=%s" % (where / "jobs.json"), "-rd",
                           "result=%s" % (where / "result.json")], capture_output=True, text=True, check=False,
                          env=dict(os.environ, QT_QPA_PLATFORM="offscreen", LC_ALL="C"))
    if not (where / "result.json").exists():
        sys.exit("KLayout does not run: " + done.stdout + done.stderr)
    return json.loads((where / "result.json").read_text(encoding="utf-8"))


def off_edge(edge, x, y):
    dx, dy = edge[2] - edge[0], edge[3] - edge[1]
    t = max(0.0, min(1.0, ((x - edge[0]) * dx + (y - edge[1]) * dy) / (dx * dx + dy * dy)))
    return math.hypot(x - edge[0] - t * dx, y - edge[1] - t * dy)


class Verdict:
    def __init__(self):
        self.wrong, self.pairs, self.places, self.square, self.limits = [], 0, 0, 0, 0

    def say(self, text):
        self.wrong.append(text)
        print("FAIL  " + text, flush=True)

    def places_of(self, name, kind, pairs, findings):
        """pairs of KLayout in places of the certificate, and places with a pair that has their chord; the least pair that counts, and
        those that do not"""
        boxes, least, left_out = [[1e3 * v for v in f["box_um"]] for f in findings], math.inf, set()
        for nm, square, *at in pairs:
            x, y = (sorted((at[k], at[k + 2], at[k + 4], at[k + 6])) for k in (0, 1))
            inside = any(b[0] - STEP_NM <= x[2] and x[1] <= b[2] + STEP_NM and b[1] - STEP_NM <= y[2] and y[1] <= b[3] + STEP_NM
                         for b in boxes)
            if not inside and square:
                self.square += 1
                left_out.add(tuple(at))
                continue
            self.pairs += 1
            least = min(least, nm)
            if not inside:
                self.say("%s: %s of %.3f nm between %s and %s is missed" % (name, kind, nm, at[:4], at[4:]))
        for f in findings:
            self.places += 1
            (x, y), (u, v) = ((1e3 * c for c in p) for p in f["at_um"])
            if not any(nm <= 1e3 * f["value"] + 1e-3 and min(max(off_edge(at[:4], x, y), off_edge(at[4:], u, v)),
                                                            max(off_edge(at[:4], u, v), off_edge(at[4:], x, y))) < 1
                       for nm, _, *at in pairs):
                self.say("%s: %s of %.6f um at %s um is false" % (name, kind, f["value"], f["at_um"]))
        if findings and abs(1e3 * min(f["value"] for f in findings) - least) > 1e-3:
            self.say("%s: least %s %.6f um, of KLayout's pairs %.4f nm" % (name, kind, min(f["value"] for f in findings), least))
        return least, left_out


def main():
    asked, first, count = random_masks.asked_of(__doc__, "RULES", first=3, few=3, every=24)
    verdict, masks, jobs, asked_of, seed = Verdict(), [], [], [], first
    with tempfile.TemporaryDirectory() as temporary:
        where = asked.keep or pathlib.Path(temporary)
        where.mkdir(parents=True, exist_ok=True)
        while len(masks) < count and seed < first + 3 * count + 10:
            mask = Mask(asked.program, seed, where)
            found, done = mask.draw(lambda flow, layer, kind: WIDE_NM)
            seed += 1
            if not found:
                if not re.search(r"error: .*\[FW-D\d+\]", done.stderr):
                    verdict.say("seed %d: status %d: %s" % (seed - 1, done.returncode, done.stderr[-500:]))
                continue
            masks.append(mask)
            for (flow, gds), (file, layer, own) in found.items():
                for kind in KINDS:
                    jobs.append({"gds": str(file), "layer": gds, "kind": kind, "limit": WIDE_NM, "shielded": False})
                    asked_of.append((mask, flow, gds, kind, [f for f in own if f["rule"] == kind]))
        again, more = {}, []
        for job, (mask, flow, gds, kind, own), pairs in zip(jobs, asked_of, klayout(jobs, where)):
            least, left_out = verdict.places_of(mask.name(flow, gds), kind, pairs, own)
            if 2 < least < math.inf and not flow.endswith("-coupons"):  # a test die has the same table
                for at in (math.floor(least), math.floor(least) + 2):  # KLayout rounds distances of parallel edges
                    more += [(dict(job, limit=at, shielded=shielded), mask.name(flow, gds), at <= least, left_out)
                             for shielded in (False, True)]
                    again.setdefault((mask, at <= least), {})[flow, gds, kind] = at
        for (job, name, below, left_out), pairs in zip(more, klayout([m[0] for m in more], where)):
            count_of = sum(tuple(at) not in left_out for _, _, *at in pairs)
            if below != (count_of == 0):
                verdict.say("%s: KLayout finds %d of %s below %d nm" % (name, count_of, job["kind"], job["limit"]))
        for (mask, below), limits in again.items():
            found, done = mask.draw(lambda flow, layer, kind: limits.get((flow, layer, kind)))
            for (flow, gds, kind), at in limits.items():
                own = [f for f in found[flow, gds][2] if f["rule"] == kind]
                verdict.limits += 1
                if bool(own) == below:
                    verdict.say("%s: %d of %s below %d nm" % (mask.name(flow, gds), len(own), kind, at))
    print("%d devices, seeds %d to %d: %d pairs in %d places, %d limits, %d pairs square but for the grid; %d wrong"
          % (len(masks), first, seed - 1, verdict.pairs, verdict.places, verdict.limits, verdict.square, len(verdict.wrong)))
    enough = len(masks) == count and verdict.pairs > 100 * count and verdict.limits >= 4 * count
    if not enough:
        print("too few devices, pairs or limits")
    return 0 if enough and not verdict.wrong and verdict.square <= verdict.pairs // 100 else 1


if __name__ == "__main__":
    sys.exit(main())
