#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""solid.py [--judge PROGRAM] [--program FLEXWRIGHT] [--seed N] [--count N] [--class TOPOLOGY/KIND/LOAD] [--density N]

Devices of the random judge as solids in CalculiX (ccx): all flexures with their fillets and blocks in plane stress and at
finite displacement, the bodies between them rigid, under the load at which the judge is. The seeds are taken in their
order; motions (velocity, shock, step) and silicon are left out. README.md says what is compared."""
import argparse
import collections
import json
import math
import os
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile
import time

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import devices  # noqa: E402
import judge  # noqa: E402
import mesh  # noqa: E402
import strip  # noqa: E402

CCX_S = 240  # that long, and a device is left out
COARSE = 0.25  # density of the flexures that do not govern


def plane_stress(device, path, program, share):
    """what the judge says of the device where nothing has depth; the flexures stay where they are"""
    kept = strip.SOLID, strip.depth
    strip.SOLID, strip.depth = ((1.0, 0, 0, 0, 0, 0),), lambda *_: (1.0, 1.0, 1.0, 1.0)
    try:
        path.write_text(device.model(), encoding="utf-8")
        roots = {name: [flexure.root(piece, end, 0) for piece, end in ((flexure.pieces[0], 0), (flexure.pieces[-1], 1))]
                 for name, (_, flexure) in device.flexures.items()}
    finally:
        strip.SOLID, strip.depth = kept
    status, out, why, _ = judge.run([program, "at", path, "%.15g" % share])
    return (json.loads(out), roots) if status == 0 else (None, why or "the judge has no stable state in plane stress")


def turned(angle, x, y):
    return math.cos(angle) * x - math.sin(angle) * y, math.sin(angle) * x + math.cos(angle) * y


def start_of(device, hinge):
    """place and direction of the first root, as drawn"""
    flexure = device.flexures[hinge.flexure][1]
    dx, dy = turned(hinge.axis, *flexure.start)
    return hinge.at[0] + dx, hinge.at[1] + dy, hinge.axis + flexure.direction


def build(device, said, governing, share, density):
    """(deck, meshes with their first nodes, hubs of the bodies)"""
    flexures, load = device.flexures, device.load
    first_flexure = flexures[device.hinges[0].flexure][1]
    deck = mesh.Deck(first_flexure.material.mean, first_flexure.material.nu, first_flexure.h)
    act, _, point, direction = device.act
    hubs = {0: None}
    for k, (_, x, y, _, _) in enumerate(device.bodies, 1):
        px, py = point if k == act else (0.0, 0.0)
        arm = turned(direction, 0, 400) if k == act else (0, 400)
        hubs[k] = deck.node(x + px, y + py), deck.node(x + px + arm[0], y + py + arm[1])
    meshes = []
    for i, hinge in enumerate(device.hinges):
        made = mesh.Mesh(flexures[hinge.flexure][1], density * (1 if i == governing else COARSE))
        x, y, angle = start_of(device, hinge)
        first = deck.add(made, x, y, angle)
        meshes.append((made, first))
        ex, ey, _ = mesh.Line(made.flexure.pieces).end
        for body, face, root in ((hinge.a, made.faces[0], (0, 0)), (hinge.b, made.faces[1], (ex, ey))):
            nodes = [first + k for k in face]
            if body:
                deck.tie(nodes, hubs[body])
                continue
            strain = (1 + device.substrate * share) / (1 + device.expansion * share) - 1 if load == "heat" else 0.0
            dx, dy = turned(angle, *root)
            deck.fixed += [(k, way, strain * at) for k in nodes for way, at in ((1, x + dx), (2, y + dy))]
    # what holds, and what acts
    (one, two), pose = hubs[act], said["bodies"][act - 1]
    places = [deck.nodes[k - 1] for k in (one, two)]
    dx, dy = turned(pose[2], places[1][0] - places[0][0], places[1][1] - places[0][1])
    size = math.hypot(dx, dy)
    if load == "slide":
        deck.fixed += [(k, way, v * share) for k in (one, two)
                       for way, v in ((1, math.cos(direction)), (2, math.sin(direction)))]
    elif load == "turn":  # the second node stays on a line through the first
        mx, my = -dy / size, dx / size
        deck.given([(two, 1, mx), (two, 2, my), (one, 1, -mx), (one, 2, -my)],
                   -mx * (places[1][0] - places[0][0]) - my * (places[1][1] - places[0][1]))
    elif load == "rod":  # on the circle about the rod's far end, whose tangent is taken where the judge is
        dx, dy = turned(pose[2], *point)
        x, y = device.bodies[act - 1][1] + pose[0] + dx, device.bodies[act - 1][2] + pose[1] + dy
        length = math.hypot(x - device.far[0], y - device.far[1])
        nx, ny = (x - device.far[0]) / length, (y - device.far[1]) / length
        deck.given([(one, 1, nx), (one, 2, ny)],
                   length - nx * (places[0][0] - device.far[0]) - ny * (places[0][1] - device.far[1]))
    for k, (fx, fy, moment) in enumerate(said["loads"], 1):
        if (fx, fy, moment) == (0, 0, 0):
            continue
        if k == act:  # a force turns about the place where it acts
            lx, ly = turned(pose[2], *point)
            moment -= lx * fy - ly * fx
        couple = moment / size ** 2
        deck.forces += [(hubs[k][0], 1, fx + dy * couple), (hubs[k][0], 2, fy - dx * couple)]
        if abs(moment) > 1e-9 * size * math.hypot(fx, fy):
            deck.forces += [(hubs[k][1], 1, -dy * couple), (hubs[k][1], 2, dx * couple)]
    return deck, meshes, hubs


def solve(deck, where):
    """displacements and stresses (xx, yy, xy) of the nodes"""
    (where / "device.inp").write_text(deck.text(), encoding="ascii")
    done = subprocess.run(["ccx", "-i", "device"], cwd=where, capture_output=True, text=True, check=False,
                          env=dict(os.environ, OMP_NUM_THREADS="1"), timeout=CCX_S)
    if done.returncode or "ERROR" in done.stdout:
        raise RuntimeError("ccx: " + done.stdout[-200:].strip())
    moved, stress, block = {}, {}, ""
    for line in (where / "device.frd").read_text(encoding="ascii").splitlines():
        if line.startswith(" -4"):
            block = line.split()[1]
        elif line.startswith(" -1") and block == "DISP":
            moved[int(line[3:13])] = float(line[13:25]), float(line[25:37])
        elif line.startswith(" -1") and block == "STRESS":
            stress[int(line[3:13])] = float(line[13:25]), float(line[25:37]), float(line[49:61])
    return moved, stress


def nominal(sigma, modulus, nu):
    """modulus times engineering strain of a free edge, where ccx gives Cauchy's stress of St. Venant's material"""
    grow = 1 + sigma / modulus
    for _ in range(30):
        green = (grow * grow - 1) / 2
        slope = modulus * (green + grow * grow) / (1 - 2 * nu * green)
        grow -= (modulus * green * grow / (1 - 2 * nu * green) - sigma) / slope
    return modulus * (grow - 1)


def wrench(deck, meshed, solved):
    """(fx, fy, moment about the origin) that the second half puts on the section in the middle of the strip"""
    (made, first), (moved, stress) = meshed, solved
    depth, total = deck.material[2], [0.0, 0.0, 0.0]
    nodes = [first + k for k in made.middle]
    at = {k: tuple(a + b for a, b in zip(deck.nodes[k - 1], moved[k])) for k in nodes}
    for i in range(0, len(nodes) - 2, 2):
        three = nodes[i:i + 3]
        for share, weight in ((0.5 - math.sqrt(0.15), 5 / 18), (0.5, 8 / 18), (0.5 + math.sqrt(0.15), 5 / 18)):
            form = (2 * (share - 0.5) * (share - 1), 4 * share * (1 - share), 2 * share * (share - 0.5))
            slope = (4 * share - 3, 4 - 8 * share, 4 * share - 1)
            x, y = (sum(f * at[k][d] for f, k in zip(form, three)) for d in (0, 1))
            # to the left of the way from the right edge is the first half
            tx, ty = (sum(f * at[k][d] for f, k in zip(slope, three)) for d in (0, 1))
            xx, yy, xy = (sum(f * stress[k][d] for f, k in zip(form, three)) for d in range(3))
            part = depth * weight * (1 - deck.material[1] * (xx + yy) / deck.material[0])  # what is pulled grows thinner
            fx, fy = part * (xx * ty - xy * tx), part * (xy * ty - yy * tx)
            total = [total[0] + fx, total[1] + fy, total[2] + x * fy - y * fx]
    return total


def at_roots(device, hinge, bodies, total):
    """[(force along, moment) of the first and the second root], bodies where `bodies` says"""
    x, y, angle = start_of(device, hinge)
    ex, ey, psi = mesh.Line(device.flexures[hinge.flexure][1].pieces).end
    ex, ey = turned(angle, ex, ey)
    out = []
    for body, px, py, turn in ((hinge.a, x, y, angle), (hinge.b, x + ex, y + ey, angle + psi)):
        if body:
            _, cx, cy, _, _ = device.bodies[body - 1]
            ux, uy, way = bodies[body - 1]
            dx, dy = turned(way, px - cx, py - cy)
            px, py, turn = cx + ux + dx, cy + uy + dy, turn + way
        fx, fy, moment = total
        out.append((fx * math.cos(turn) + fy * math.sin(turn), moment - px * fy + py * fx))
    return out


def judged(device, hinge, said, index):
    """the same of the judge"""
    moment, along, across = said["wrenches"][index]
    x, y, angle = start_of(device, hinge)
    if hinge.a:
        _, cx, cy, _, _ = device.bodies[hinge.a - 1]
        ux, uy, way = said["bodies"][hinge.a - 1]
        dx, dy = turned(way, x - cx, y - cy)
        x, y, angle = cx + ux + dx, cy + uy + dy, angle + way
    fx, fy = turned(angle, along, across)
    return at_roots(device, hinge, said["bodies"], (fx, fy, moment + x * fy - y * fx))


def compare(options, seed, wanted, where, density):
    """a row, or why there is none"""
    drawn = devices.Device(seed, wanted)
    if drawn.moving:
        return "a motion"
    if drawn.material.crystal:
        return "silicon"
    made, why = judge.make(options, seed, wanted, where)
    if not made:
        return why
    device, share, duration, truths, _ = made
    index = truths.index(max(truths))
    hinge = device.hinges[index]
    said, roots = plane_stress(device, where / "plane.model", options.judge, share)
    if said is None:
        return roots
    begun = time.monotonic()
    deck, meshes, hubs = build(device, said, index, share, density)
    moved, stress = solved = solve(deck, where)
    modulus, nu, _ = deck.material
    (mesh_of, first) = meshes[index]
    peaks, signed = [0.0, 0.0, 0.0], [0.0, 0.0]
    for k, place in mesh_of.edges.items():
        value = nominal(sum(stress[first + k][:2]), modulus, nu)
        peaks[place] = max(peaks[place], abs(value))
        signed = [max(signed[0], value), min(signed[1], value)]
    poses = []
    for k, (_, x, y, _, _) in enumerate(device.bodies, 1):
        (x0, y0), (x1, y1) = (deck.nodes[n - 1] for n in hubs[k])
        (u0, v0), (u1, v1) = (moved[n] for n in hubs[k])
        turn = math.atan2(y1 + v1 - y0 - v0, x1 + u1 - x0 - u0) - math.atan2(y1 - y0, x1 - x0)
        turn = (turn + math.pi) % (2 * math.pi) - math.pi
        dx, dy = turned(turn, x - x0, y - y0)
        poses.append((x0 + u0 + dx - x, y0 + v0 + dy - y, turn))
    total = wrench(deck, meshes[index], solved)
    mine, theirs = at_roots(device, hinge, poses, total), judged(device, hinge, said, index)
    row = {"seed": seed, "name": "/".join((device.topology, device.kind, device.load)), "hinge": hinge.name,
           "peaks": peaks, "signed": signed, "judge": said["flexures"][index], "roots": list(zip(mine, theirs)),
           "poses": [poses, said["bodies"]], "truth": max(truths), "seconds": time.monotonic() - begun}
    row["stress"] = max(peaks) / said["flexures"][index]["stress"]
    worst = max((0, 1), key=lambda k: abs(theirs[k][1]))
    row["stretch"] = abs(theirs[worst][0] * roots[hinge.flexure][worst][3]) / said["flexures"][index]["stress"]
    most = 0 if row["stretch"] > 0.5 else 1  # of the force along and the moment
    row["reaction"] = mine[worst][most] / theirs[worst][most]
    # what the judge makes of the solid's own wrench, at its roots and where their fillets end
    within = []
    for (along, _), k in zip(mine, mesh_of.begins):
        (x, y), (ux, uy), (fx, fy, moment) = deck.nodes[first + k - 1], moved[first + k], total
        within.append((along, moment - (x + ux) * fy + (y + uy) * fx))
    for name, pairs in (("same wrench", mine), ("within", within)):
        row[name] = max(peaks[:2]) / max(max(abs(n * tension - m * left), abs(n * tension + m * right))
                                         for (n, m), (_, left, right, tension) in zip(pairs, roots[hinge.flexure]))
    if options.program:
        path = where / ("%d.xml" % seed)
        path.write_text(device.xml(share, duration), encoding="utf-8")
        for model in ("default", "elastica"):
            answer, why, _ = judge.verdict(options, path, model == "elastica")
            row[model] = {h["id"]: h for h in answer["hinges"]}[hinge.name]["utilisation_band"] if answer else why
    return row


def held(row, model):
    """whether the solid's peak lies in the program's band: the judge's truth at finite depth times solid over judge"""
    band = row[model]
    if not isinstance(band, list):
        return "error"
    value = row["truth"] * row["stress"]
    return "in" if band[0] <= value <= band[1] else "below" if value < band[0] else "above"


def line(row):
    where = ("first root", "second root", "strip")
    text = "%4d %-28s %-2s %s / %s: stress %.4f, same wrench %.4f, within %.4f, reaction %.4f, stretch %2.0f %%" % (
        row["seed"], row["name"], row["hinge"], where[row["peaks"].index(max(row["peaks"]))], where[row["judge"]["at"]],
        row["stress"], row["same wrench"], row["within"], row["reaction"], 100 * row["stretch"])
    if "default" in row:
        text += "; %.4f" % (row["truth"] * row["stress"]) + "".join(
            " %s %s %s" % (held(row, m), m, "%.4f..%.4f" % tuple(row[m]) if isinstance(row[m], list) else row[m][:60])
            for m in ("default", "elastica"))
    return text + " (%.0f s)" % row["seconds"]


def summary(rows):
    groups = collections.defaultdict(list)
    for row in rows:
        groups[row["name"].split("/")[1]].append(row)
        groups["all"].append(row)
    print("\n%-8s %3s  %-26s %-26s %-26s %-26s %s" % ("", "n", "stress: least median most", "same wrench", "within", "reaction",
                                                   "in the band"))
    for kind in [k for k in devices.KINDS if k in groups] + ["all"]:
        cells = []
        for key in ("stress", "same wrench", "within", "reaction"):
            values = [row[key] for row in groups[kind]]
            cells.append("%-26s" % ("%.4f %.4f %.4f" % (min(values), statistics.median(values), max(values))))
        inside = "" if "default" not in rows[0] else " ".join("%s %d" % (m, sum(held(r, m) == "in" for r in groups[kind]))
                                                              for m in ("default", "elastica"))
        print("%-8s %3d  %s %s" % (kind, len(groups[kind]), " ".join(cells), inside))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--judge", default="build/tests/judge")
    parser.add_argument("--program", default="", help="flexwright: its bands are looked at, too")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=30)
    parser.add_argument("--class", dest="wanted", default="")
    parser.add_argument("--density", type=float, default=0.75, help="of the elements; 1: 24 along a fillet")
    parser.add_argument("--most", type=int, default=60, help="seconds of processor time for one verdict")
    parser.add_argument("--json", default="", help="file that gets a line of JSON for every device")
    options = parser.parse_args()
    pattern = re.compile(options.wanted.replace("*", ".*") + "$") if options.wanted else None
    fitting = [c for c in devices.classes() if not pattern or pattern.match("/".join(c))]
    rows, left, seed = [], collections.Counter(), options.seed
    while len(rows) < options.count and seed < options.seed + 50 * options.count:
        with tempfile.TemporaryDirectory() as where:
            try:
                row = compare(options, seed, fitting[seed % len(fitting)] if pattern else None, pathlib.Path(where),
                              options.density)
            except subprocess.TimeoutExpired:
                row = "ccx finds no state in time"
            except RuntimeError as error:
                row = str(error)
        if isinstance(row, str):
            left["a motion" if row == "a motion" else "silicon" if row == "silicon" else "seed %d: %s" % (seed, row)] += 1
        else:
            rows.append(row)
            print(line(row), flush=True)
            if options.json:
                with open(options.json, "a", encoding="utf-8") as file:
                    file.write(json.dumps(row) + "\n")
        seed += 1
    print("left out: " + "; ".join("%d %s" % (n, why) for why, n in left.items()))
    if rows:
        summary(rows)
    return 0 if len(rows) == options.count else 1


if __name__ == "__main__":
    sys.exit(main())
