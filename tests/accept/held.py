#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""held.py PROGRAM [FIRST COUNT]: nothing of an accepted device is loose, and what should be held by tethers is.

Random devices in every flow: those of the acceptance tests, and plates within rings that are open on one side by 20 to
140 um, the only way for a tether. From the polygons as they are written (GEOS, by shapely):

* a flow that stands on nothing leaves one piece; where the carrier insulates, one for each net of the certificate;
* every plate and every body of shapes that is to be held meets a tether, and that tether meets the frame, or the
  device is rejected with FW-D127, which names a place and a change;
* a tether fits through an opening as wide as itself and its clearance, 60 um, and through none that is narrower; where a
  message names a part in the way, that part is in the way."""
import json
import pathlib
import random
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE)]
import outlines  # noqa: E402
import random_devices  # noqa: E402

try:
    from shapely.geometry import Polygon
    from shapely.ops import unary_union
except ImportError:
    print("python3-shapely is not installed")
    sys.exit(77)

FAST = ["--corners", "none", "--accuracy", "3e-2", "--hinge-model", "revolute", "--effects", "none", "--advice", "none"]
FLOWS = {"al-masked-rie": ("silicon-100", 50), "soi-deep-rie": ("silicon-100", 50), "soi-double-sided": ("silicon-100", 50),
         "silicon-on-glass": ("silicon-100", 50), "copper-on-porous-silicon": ("copper-plated", 9)}
SEAM, FINGER, CLEAR = 0.004, 20.0, 20.0  # um
HEAD = '<device xmlns="urn:flexwright:device:1" name="held-%d">\n  <material ref="%s" thickness="%d um"/>\n  <flow ref="%s"/>\n'


def um(x):
    return "%.3f um" % x


def gimbal(r, wider=0):
    """a plate within a ring that is open on one side"""
    leaf, bar = r.uniform(220, 380), r.uniform(80, 140)
    w, h = r.uniform(300, 600), r.uniform(400, 900)
    stem = r.uniform(110, 160)  # between a hinge and what it holds: hinges keep a circle of their own
    x, y = w / 2 + leaf + 2 * stem, h / 2 + r.uniform(90, 250)  # inner edges of the ring
    outer, inner = x + bar + stem + leaf / 2, w / 2 + stem + leaf / 2  # of both hinges
    gap, side = r.uniform(20, 140) + wider, r.choice((-1, 1))
    at = r.uniform(-0.25, 0.25) * w
    rows = [(-x - bar / 2, -y - bar, -x - bar / 2, y + bar), (x + bar / 2, -y - bar, x + bar / 2, y + bar),
            (-x - bar / 2, -side * (y + bar / 2), x + bar / 2, -side * (y + bar / 2)),
            (-x - bar / 2, side * (y + bar / 2), at - gap / 2, side * (y + bar / 2)),
            (at + gap / 2, side * (y + bar / 2), x + bar / 2, side * (y + bar / 2)),
            (-x - bar / 2, 0, -x - bar - stem, 0), (x + bar / 2, 0, x - stem, 0)]
    text = '  <flexure id="f" kind="leaf" length="%s" width="%s"/>\n  <mechanism>\n' % (um(leaf), um(r.uniform(7, 11)))
    text += '    <body id="ring" x="0 um" y="0 um">\n'
    for x0, y0, x1, y1 in rows:
        text += '      <bar x="%s" y="%s" to-x="%s" to-y="%s" width="%s"/>\n' % (um(x0), um(y0), um(x1), um(y1), um(bar))
    text += '    </body>\n    <body id="plate" x="0 um" y="0 um">\n'
    text += '      <bar x="0 um" y="%s" to-x="0 um" to-y="%s" width="%s"/>\n' % (um(-h / 2), um(h / 2), um(w))
    text += '      <bar x="0 um" y="0 um" to-x="%s" to-y="0 um" width="%s"/>\n    </body>\n' % (um(w / 2 + stem), um(bar))
    text += '    <revolute id="A" a="ground" a-x="%s" b="ring" b-x="%s" hinge="f" axis="0 deg"/>\n' % (um(-outer), um(-outer))
    text += '    <revolute id="B" a="plate" a-x="%s" b="ring" b-x="%s" hinge="f" axis="0 deg"/>\n  </mechanism>\n' % (um(inner), um(inner))
    text += '  <scene name="s" duration="0.1 ms">\n    <force on="plate" fx="1 nN" fy="0 mN"/>\n  </scene>\n'
    return text, gap, side


def device(seed, wider=0):
    """(text, flow, opening in um or None)"""
    r = random.Random(seed)
    flow = list(FLOWS)[seed % len(FLOWS)]
    material, thick = FLOWS[flow]
    if seed % 2:
        body, gap, _ = gimbal(r, wider)
        return HEAD % (seed, material, thick, flow) + body + "</device>\n", flow, gap
    text = random_devices.device(seed // 2)[0]
    text = re.sub(r"<flow\b[^>]*/>\s*", "", text)
    text = re.sub(r"<material[^>]*/>", '<material ref="%s" thickness="%d um"/>\n  <flow ref="%s"/>' % (material, thick, flow), text, count=1)
    return text, flow, None


def solid(rings):
    return unary_union([Polygon(ring).buffer(0) for ring in rings]).buffer(SEAM).buffer(-SEAM)


def pieces(shape):
    return list(shape.geoms) if shape.geom_type.startswith("Multi") else [shape]


def labels_of(svg):
    """label: outlines in um, chords of what the SVG draws; enough to say what meets what"""
    found = {}
    for path, label in re.findall(r'<path[^>]* d="([^"]*)"[^>]*>\s*<title>([^<]*)</title>', svg):
        points, at = [], None
        for letter, numbers in re.findall(r"([MLA])([^MLAZ]*)", path):
            values = [float(v) for v in numbers.replace(",", " ").split()]
            points.append((values[-2], -values[-1]))
        found.setdefault(label, []).append(points)
    return found


def check(program, seed, where):
    """(what it was, what is wrong)"""
    text, flow, gap = device(seed)
    path, out = pathlib.Path(where) / ("%d.xml" % seed), pathlib.Path(where) / str(seed)
    path.write_text(text, encoding="utf-8")
    run = subprocess.run([program, "plan", path, "-q", "--force", "-o", out, *FAST], capture_output=True, text=True, check=False)
    mask, report = out / "masks" / (flow + ".gds"), out / "verdict.json"
    if not mask.exists() or not report.exists():
        why = re.search(r"error: .*?\[(FW-D\d+)\]", run.stderr, re.S)
        return "not drawn", [] if why else ["seed %d: no mask and no reason: %s" % (seed, run.stderr[:300])]
    said = json.loads(report.read_text())
    reasons = [r for r in said["reasons"] if r["code"] == "FW-D127"]
    verdict, wrong = said["verdict"], []
    layers = {k: [[(1e-3 * x, 1e-3 * y) for x, y in ring] for ring in rings] for k, rings in outlines.read_gds(mask).items()}
    left = solid(layers["1/0"])
    for other in ("2/0", "3/0"):
        if other in layers:
            left = left.difference(solid(layers[other]))
    parts = [p for p in pieces(left) if p.area > 1e-3]
    certificate = json.loads(mask.with_suffix(".json").read_text())
    wiring = certificate.get("wiring")
    insulates = bool(wiring and wiring["carrier"]["insulates"])
    allowed = len(wiring["nets"]) if insulates else 1
    if len(parts) != allowed:
        wrong.append("seed %d, %s: %d pieces, %d nets: the others are %s" % (
            seed, flow, len(parts), allowed, sorted(((round(p.area, 1), p.representative_point().coords[0]) for p in parts))[:3]))
    tethers_asked = 'tethers="no"' not in text
    svg = mask.with_suffix(".svg")
    if not svg.exists():
        return "no svg", wrong
    drawn = labels_of(svg.read_text())
    held = {label[len("tether of "):] for label in drawn if label.startswith("tether of ")}
    bodies = set(re.findall(r'<body id="(\w+)"[^>]*(?:plate-width|>\s*<bar)', text)) | set(re.findall(r'<platform id="(\w+)"', text))
    for body in bodies if tethers_asked else ():
        has = any(h.split()[-1] == body for h in held)
        about = [r for r in reasons if re.search(r"tethers of \w+ %s\b" % body, r["text"])]
        if has == bool(about):
            wrong.append("seed %d, %s: body %s %s, reasons %s" % (seed, flow, body, "has a tether" if has else "has none", about))
        if about and (verdict != "reject" or not re.search(r"\(.*\) um", about[0]["text"]) or "tethers=" not in about[0]["text"]):
            wrong.append("seed %d, %s: %s without a tether, %s: %s" % (seed, flow, body, verdict, about[0]["text"]))
    if gap is not None:
        has = any(h.split()[-1] == "plate" for h in held)
        if has and gap < FINGER + 2 * CLEAR - 0.01:
            wrong.append("seed %d: a tether goes through an opening of %.1f um" % (seed, gap))
        if not has and gap > FINGER + 2 * CLEAR + 0.1:
            wrong.append("seed %d: no tether goes through an opening of %.1f um: %s" % (seed, gap, [r["text"] for r in reasons]))
        wrong += [w for r in reasons if "link plate" in r["text"] for w in wider(program, seed, gap, r["text"], where)]
    return verdict + (" missing" if reasons else ""), wrong


def wider(program, seed, gap, text, where):
    """the room that is named for a plate in a ring: what is wrong with it"""
    named = re.search(r"the opening beside [^;]*? (\d+) um wider", text)
    if not named:
        return ["seed %d: an opening of %.1f um is not named: %s" % (seed, gap, text)]
    if gap + int(named[1]) > FINGER + 2 * CLEAR + 2:
        return ["seed %d: an opening of %.1f um needs no %s um more" % (seed, gap, named[1])]
    path = pathlib.Path(where) / ("wider-%d.xml" % seed)
    path.write_text(device(seed, int(named[1]))[0], encoding="utf-8")
    run = subprocess.run([program, "check", path, "--json", *FAST], capture_output=True, text=True, check=False)
    left = [r["text"] for r in json.loads(run.stdout)["reasons"] if r["code"] == "FW-D127" and "link plate" in r["text"]]
    return ["seed %d: %.1f um and %s um do not do: %s" % (seed, gap, named[1], left)] if left else []


def main():
    program = sys.argv[1]
    first, count = (int(x) for x in sys.argv[2:4]) if len(sys.argv) > 3 else (1, 10)
    seen, bad = {}, 0
    with tempfile.TemporaryDirectory() as where:
        for seed in range(first, first + count):
            what, wrong = check(program, seed, where)
            seen[what] = seen.get(what, 0) + 1
            bad += len(wrong)
            for w in wrong:
                print(w, flush=True)
    print("; ".join("%s %d" % x for x in sorted(seen.items())) + "; %d wrong" % bad)
    return 1 if bad or len(seen) < 2 else 0


if __name__ == "__main__":
    sys.exit(main())
