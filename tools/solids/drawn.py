# SPDX-License-Identifier: GPL-3.0-or-later
"""What tools/solids takes from a device: its description without loads, and its outlines as points (of solid_whole, whose
head says what it prints). Needs nothing but Python, so that tests/docs/solids.py can look at it."""
import math
import re
import subprocess

UM = 1e6  # um, uN, s: stresses in MPa, masses in kg
CHORD = 0.02  # um between an arc and the chords that stand for it: the edges of a strip of varying width are arcs of millimetres


def bare(text):
    """the device alone, with one scene whose force the caller states"""
    text = re.sub(r"<scene.*?</scene>", "", text, flags=re.S)
    for gone in (r"<spring[^>]*?/>", r"<flow[^>]*?/>", r"<workspace.*?</workspace>", r"<workspace[^>]*?/>", r"<require[^>]*?/>",
                 r"<require[^>]*?>.*?</require>", r"<probe[^>]*?/>", r"<wafer.*?</wafer>", r"<study.*?</study>",
                 r"<resist[^>]*?/>", r"<cell[^>]*?/>"):
        text = re.sub(gone, "", text, flags=re.S)
    return text


def rotors_of(text):
    """the comb drives of the first scene, as good as without a voltage (none is refused): their fingers are drawn, and weigh"""
    first = re.search(r"<scene.*?</scene>", text, flags=re.S)
    return "".join(re.sub(r'voltage="[^"]*"', 'voltage="1 mV"', c) for c in re.findall(r"<comb-drive[^>]*?/>", first[0] if first else ""))


def close(radius):
    """the angle of a chord"""
    return min(math.radians(9), math.sqrt(8 * CHORD / radius))


def arc(x0, y0, x1, y1, cx, cy, sweep, step=close):
    radius, start = math.hypot(x0 - cx, y0 - cy), math.atan2(y0 - cy, x0 - cx)
    n = max(2, math.ceil(abs(sweep) / step(radius)))
    return [(cx + radius * math.cos(start + sweep * i / n), cy + radius * math.sin(start + sweep * i / n)) for i in range(1, n)]


def outlines(program, device, step=close, arcs=None):
    """layer; bodies' names; [(body, joint, points in um)]; step: angle of a chord by its radius; arcs: gets (cx, cy, radius) of all"""
    return outlines_in(subprocess.run([program, device], capture_output=True, text=True, check=True).stdout, step, arcs)


def outlines_in(text, step=close, arcs=None):
    """of what solid_whole has printed"""
    layer, bodies, pieces = None, {}, []
    for line in text.splitlines():
        word, *rest = line.split()
        if word == "layer":
            layer = [float(v) for v in rest]
        elif word == "body":
            bodies[int(rest[0])] = rest[1]
        elif word == "piece":
            pieces.append((int(rest[0]), int(rest[1]), []))
        elif word in ("line", "arc"):
            v = [float(x) * UM for x in rest]
            points = pieces[-1][2]
            points.append((v[0], v[1]))
            if word == "arc":
                points += arc(*v[:6], float(rest[6]), step)
                if arcs is not None:
                    arcs.append((v[4], v[5], math.hypot(v[0] - v[4], v[1] - v[5])))
    return layer, bodies, pieces


def area(points):
    """positive where it runs counter-clockwise"""
    return sum(x0 * y1 - x1 * y0 for (x0, y0), (x1, y1) in zip(points, points[1:] + points[:1])) / 2
