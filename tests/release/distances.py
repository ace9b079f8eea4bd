#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""distances.py PROGRAM [FIRST COUNT] [--device FILE ...]: what the program says of the release, against another program.

COUNT random devices that can be drawn (with FW_TEST_ALL=1: 300), from seed FIRST on, in the flows that release. The
polygons of the mask as it is written are read back and united, lettering and marks taken out, and eroded by GEOS with
round corners. Of every part with reach r, as the program says: eroded by r less 1 % some of it is left, eroded by r
and 1 % none; the worst point lies r from the nearest edge; and of what stays the area that is left after the planned
reach is the share that the program says, to 2 % of the part. Where the program sees a window, nothing of what moves
is left after the planned reach, and everything that must stay keeps its share to the end of the step. A device that
is drawn and has no mask is wrong, too, but where a rule of the mask names a hinge."""
import json
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "accept")]
import geos  # noqa: E402
import outlines  # noqa: E402
import random_devices  # noqa: E402

FLOWS = {  # flows that release, with the material of the device
    "soi-deep-rie": '<material ref="silicon-100" thickness="50 um"/>',
    "copper-on-porous-silicon": '<material ref="copper-plated" thickness="9 um"/>',
}
FAST = ["--corners", "none", "--accuracy", "3e-2", "--hinge-model", "revolute", "--effects", "none", "--advice", "none"]
MATERIAL = re.compile(r"<flow\b[^>]*/>")


def device_of(seed, where):
    """a random device of the acceptance tests, in a flow that releases, some with holes"""
    text = MATERIAL.sub("", random_devices.device(seed)[0])
    flow = list(FLOWS)[seed % len(FLOWS)]
    pitch = random.Random(seed).choice((None, 30, 40, 55, 80))
    text = re.sub(r"<material[^>]*/>", '%s\n  <flow ref="%s"/>' % (FLOWS[flow], flow), text, count=1)
    if pitch and "<die" in text:
        text = re.sub(r"<die\b", '<die release-pitch="%d um"' % pitch, text, count=1)
    elif pitch:
        text = text.replace("</device>", '  <die release-pitch="%d um"/>\n</device>' % pitch)
    path = pathlib.Path(where) / ("%d.xml" % seed)
    path.write_text(text, encoding="utf-8")
    return path


def run(program, device, where):
    out = pathlib.Path(where) / ("out-" + device.stem)
    done = subprocess.run([program, "plan", device, "-o", out, "--force", *FAST], capture_output=True, text=True)
    for flow in FLOWS:
        recipe, mask = out / "recipes" / (flow + ".json"), out / "masks" / (flow + ".gds")
        if recipe.exists() and mask.exists() and json.loads(recipe.read_text())["release"]:
            return (json.loads(recipe.read_text()), mask), done.stderr
    return None, done.stderr


def compare(g, name, recipe, mask):
    """yields what is wrong"""
    release = recipe["release"]
    layers = {key: [[(1e-3 * x, 1e-3 * y) for x, y in ring] for ring in rings] for key, rings in outlines.read_gds(mask).items()}
    solid = g.polygons(layers["1/0"])
    for other in ("2/0", "3/0"):
        if other in layers:
            solid = g.minus(solid, g.polygons(layers[other]))
    solid = g.buffer(g.buffer(solid, 0.003), -0.003)  # seams of polygons on a grid
    edge = g.boundary(solid)
    bias = recipe["bias_m"] * 1e6
    rings = layers["1/0"]

    def holders(x, y):
        """the pieces that a point lies in"""
        for ring in rings:
            xs, ys = [p[0] for p in ring], [p[1] for p in ring]
            if min(xs) - 0.01 < x < max(xs) + 0.01 and min(ys) - 0.01 < y < max(ys) + 0.01:
                piece = g.polygons([ring])
                if g.distance(g.point(x, y), piece) < 0.01:
                    yield piece, (min(xs), min(ys), max(xs), max(ys))

    def left(own, box, reach):
        """what is left of a piece: everything farther away than the reach has no part in it"""
        far = reach + 1.0
        here = g.within(solid, (box[0] - far, box[1] - far, box[2] + far, box[3] + far))
        return g.area(g.both(g.buffer(here, -reach), own))

    for part in release["parts"]:
        at = [1e6 * x for x in part["at_m"]]
        reach = 1e6 * part["reach_m"] + bias
        there = g.distance(g.point(*at), edge)
        slack = 0.01 * reach + 0.02
        if abs(there - reach) > slack:
            yield "%s: %s is %.3f um from an edge at its worst point, the program says %.3f" % (name, part["part"], there, reach)
        own = list(holders(*at))
        if len(own) != 1:
            continue  # on a seam: the other part may go on
        piece, box = own[0]
        if left(piece, box, reach + slack) > 1e-3:
            yield "%s: %s is not free after %.3f um" % (name, part["part"], reach + slack)
        if reach - slack > 0 and not left(piece, box, reach - slack) > 0:
            yield "%s: nothing of %s is left after %.3f um" % (name, part["part"], reach - slack)
        planned = 1e6 * (release["reach_m"] - release["foot_m"]) + bias
        if part["duty"] == "moves" and release["window"] and planned < reach and left(piece, box, planned + slack) > 1e-3:
            yield "%s: %s stays bonded after the planned %.3f um" % (name, part["part"], planned)
        if part["duty"] == "stays" and part["part"] != "frame":
            run_um = 1e6 * (release["run_m"] - release["foot_m"]) + bias
            share = left(piece, box, run_um) / (1e12 * part["area_m2"])
            if part["bonded_share"] and abs(share - part["bonded_share"]) > 0.02:
                yield "%s: %s keeps %.4f of its bond, the program says %.4f" % (name, part["part"], share, part["bonded_share"])
            if release["window"] and share < release["share"] - 0.02:
                yield "%s: %s keeps %.4f of its bond at the end, %.4f are asked for" % (name, part["part"], share, release["share"])


def seeds(first, count, where, compared):
    """random devices until so many were compared"""
    seed = first
    while len(compared) < count and seed < first + 20 * count:
        yield device_of(seed, where)
        seed += 1


def main():
    program = str(pathlib.Path(sys.argv[1]).resolve())
    where = tempfile.mkdtemp()
    wrong, compared, parts, refused, windows = [], [], 0, {}, 0
    if "--device" in sys.argv:
        devices = [pathlib.Path(p).resolve() for p in sys.argv[sys.argv.index("--device") + 1:]]
    else:
        first, count = (int(x) for x in (sys.argv[2:4] or ("1", "8")))
        devices = seeds(first, 300 if os.environ.get("FW_TEST_ALL") else count, where, compared)
    try:
        g = geos.Geos()
    except OSError:
        print("no GEOS here: skipped")
        return 77
    for device in devices:
        got, said = run(program, device, where)
        if not got:
            why = re.search(r"error: .*?\[(FW-D\d+)\]", said, re.S)
            refused.setdefault(why.group(1) if why else "no reason", []).append(device.stem)
            touches = why and why.group(1) == "FW-D147" and "whatever the tolerance" in why.group(0)
            if not why or (touches and "the place belongs to hinge" not in why.group(0)):
                wrong.append("%s: drawn, but no mask: %s" % (device.stem, said.strip()[:400]))
                print(wrong[-1], flush=True)
            continue
        compared.append(device)
        windows += got[0]["release"]["window"]
        parts += len(got[0]["release"]["parts"])
        for what in compare(g, device.stem, *got):
            wrong.append(what)
            print(what, flush=True)
        g.free()
        if len(compared) % 20 == 0:
            print("%d compared, last %s; %d wrong" % (len(compared), device.stem, len(wrong)), flush=True)
        shutil.rmtree(pathlib.Path(where) / ("out-" + device.stem), ignore_errors=True)
    shutil.rmtree(where, ignore_errors=True)
    print("not drawn: " + "; ".join("%s %d" % (code, len(which)) for code, which in sorted(refused.items())))
    print("%d devices compared, %d parts, %d with a window, %d refused; %d wrong"
          % (len(compared), parts, windows, sum(map(len, refused.values())), len(wrong)))
    return 1 if wrong or not compared else 0


if __name__ == "__main__":
    sys.exit(main())
