#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Devices whose parts meet, and the same ones where they do not: cases.py FLEXWRIGHT"""
import json
import os
import re
import subprocess
import sys
import tempfile

DATA = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "data", "clearance")
FAULTS = []


def check(program, path, *sets, corners="none", more=()):
    run = [program, "check", path, "--json", "--advice", "none", "--corners", corners, *more]
    for s in sets:
        run += ["--set", s]
    out = subprocess.run(run, capture_output=True, text=True, check=False)
    try:
        return json.loads(out.stdout)
    except ValueError:
        print(out.stderr)
        raise


def expect(what, truth):
    print("%s: %s" % ("ok" if truth else "FAULT", what))
    if not truth:
        FAULTS.append(what)


def codes(d):
    return [r["code"] for r in d["reasons"] if r["verdict"] == "reject"]


def jaws(program):
    path = os.path.join(DATA, "jaws.xml")
    d = check(program, path)
    c = d["clearances"][0]
    expect("jaws 60 um apart that close by more are rejected", d["verdict"] == "reject" and "FW-D294" in codes(d))
    expect("the jaws are named", {c["a"], c["b"]} == {"link left", "link right"} and c["meet"])
    expect("they meet before the motion ends", 0 < c["share"] < 0.5 and 0 < c["t_s"] < 0.02)
    d = check(program, path, "push=5 uN")
    c = d["clearances"][0]
    expect("pushed less they are accepted", d["verdict"] == "accept" and c["low_m"] > 5e-6)
    expect("the band holds what was found", c["low_m"] <= c["clearance_m"] <= c["high_m"])
    with open(path, encoding="utf-8") as f:
        text = f.read()
    with tempfile.TemporaryDirectory() as directory:
        touch = os.path.join(directory, "touch.xml")
        with open(touch, "w", encoding="utf-8") as f:
            f.write(text.replace("  </scene>", '    <contact id="tips" side="outside" a="left" a-x="0.5 mm" a-y="0.4 mm" b="right" '
                                 'b-x="-0.5 mm" b-y="0.4 mm" distance="1 um" stiffness="1e3 N/m"/>\n  </scene>'))
        d = check(program, touch)
        expect("with a <contact> of the two meeting is no fault",
               not any({c["a"], c["b"]} == {"link left", "link right"} for c in d["clearances"]))
        asked = os.path.join(directory, "asked.xml")
        with open(asked, "w", encoding="utf-8") as f:
            f.write(text.replace('safety-factor="1.5"', 'safety-factor="1.5" clearance="50 um"'))
        d = check(program, asked, "push=5 uN")
        expect("50 um that are asked for and not kept reject",
               d["verdict"] == "reject" and d["clearances"][0]["required_m"] == 50e-6)
        d = check(program, asked, "push=5 uN", "gap=200 um")
        expect("and accept where they are kept", d["verdict"] == "accept")


def eyelets(program):
    path = os.path.join(DATA, "eyelets.xml")
    d = check(program, path)
    worst = [c for c in d["clearances"] if c["scene"] == "workspace"][0]
    expect("a required pose in the frame is rejected",
           d["verdict"] == "reject" and worst["meet"] and "FW-D294" in codes(d))
    d = check(program, path, "up=20 um")
    worst = [c for c in d["clearances"] if c["scene"] == "workspace"][0]
    expect("one that stays below it is accepted", d["verdict"] == "accept" and 0 < worst["low_m"] < 10e-6)


def as_made(program):
    """walls that come nearer by more than what is left"""
    path = os.path.join(DATA, "jaws.xml")
    drawn = check(program, path, "gap=400 um")
    made = check(program, path, "gap=400 um", corners="auto")
    expect("what a corner of the flow closes is not accepted",
           drawn["verdict"] == "accept" and made["verdict"] != "accept")


def changed(directory, name, *changes):
    """a copy of a device with parts of its text replaced"""
    with open(os.path.join(DATA, name), encoding="utf-8") as f:
        text = f.read()
    for old, new in changes:
        assert old in text, old
        text = text.replace(old, new)
    path = os.path.join(directory, name)
    with open(path, "w", encoding="utf-8") as f:
        f.write(text)
    return path


def corners(program):
    """the corner that takes the last of a clearance is none that a hinge asks for"""
    with open(os.path.join(DATA, "../../../docs/gallery/free-form-gripper/device.xml"), encoding="utf-8") as f:
        text = re.sub(r"\s*<(probe|require|contact) [^>]*/>", "", f.read()).replace('"14 ms"', '"20 ms"')
    with tempfile.TemporaryDirectory() as directory:
        path = os.path.join(directory, "gripper.xml")
        with open(path, "w", encoding="utf-8") as f:
            f.write(text)
        for width, verdict in (("9.3 um", "inconclusive"), ("9.52 um", "inconclusive"), ("10.5 um", "accept")):
            d = check(program, path, "pull=40 uN", "copper_pull=1.8 uN", "flexure[pivot]/@width=" + width, corners="auto")
            met = not reasons(d, "FW-D238") or all("meet" in r["text"] for r in reasons(d, "FW-D238"))
            expect("jaws on hinges %s wide, as made: %s" % (width, d["verdict"]), d["verdict"] == verdict and met)


def roots(program):
    """what takes most of its way is not the nearest pair: a comb's fingers come to their roots at one side gap"""
    path = os.path.join(DATA, "comb-root.xml")
    for push, verdict in (("4 uN", "accept"), ("12 uN", "inconclusive")):
        d = check(program, path, "push=" + push, corners="auto")
        c = d["clearances"][0]
        expect("the nearest pair keeps its side gap", c["drawn_m"] > 0.97 * c["start_m"] and c["start_m"] < 10.1e-6)
        expect("pushed by %s, as made: %s" % (push, d["verdict"]), d["verdict"] == verdict)
        expect("only the larger push uses much of the way to the root",
               (c["way_share"] or 0) > 0.4 if push == "12 uN" else c["way_share"] is None)
        said = subprocess.run([program, "check", path, "--set", "push=" + push, "--corners", "none", "--advice", "none",
                               "--no-progress"], capture_output=True, text=True, check=False).stdout
        way = re.search(r"^nearest: .*; (.*) and (.*) take ([\d.]+) % of the way until they meet", said, re.M)
        if push == "12 uN":
            expect("the line of the nearest names the pair and its share of the way",
                   way and {way[1], way[2]} == {c["way_a"], c["way_b"]}
                   and abs(float(way[3]) - 100 * c["way_share"]) < 0.1)
        else:
            expect("of less than half of a way nothing is said", way is None)


def reasons(d, code):
    return [r for r in d["reasons"] if r["code"] == code]


def warned(program, path, code, *more):
    out = subprocess.run([program, "check", path, "--advice", "none", "--corners", "none", *more],
                         capture_output=True, text=True, check=False)
    return code in out.stderr


def jumps(program):
    """without inertia loads that are there at once make a jump, whose two ends are not all of it"""
    with tempfile.TemporaryDirectory() as directory:
        path = changed(directory, "jaws.xml", (' law="ramp" rise="16 ms"', ""))
        still = ("--effects", "none")
        d = check(program, path, more=still)
        expect("jaws that jump over their gap are rejected", d["verdict"] == "reject" and "FW-D294" in codes(d))
        expect("and the jump is said", warned(program, path, "FW-D296", *still))
        path = os.path.join(DATA, "jaws.xml")
        d = check(program, path, "push=5 uN", more=still)
        expect("loads that rise jump nowhere", d["verdict"] == "accept" and
               not warned(program, path, "FW-D296", "--set", "push=5 uN", *still))


def lane(program):
    """a <contact> with the ground lets a body meet what stands there, but not leave the die"""
    contact = ('    <contact id="tips" side="inside" a="left" a-x="0.5 mm" a-y="0.4 mm" b="ground" b-x="0 mm" '
               'b-y="3 mm" distance="10 mm" stiffness="1e3 N/m"/>\n  </scene>\n  <die frame="120 um"/>')
    with tempfile.TemporaryDirectory() as directory:
        path = changed(directory, "jaws.xml", ("  </scene>", contact), ('fx="push"', 'fx="-1*push"'),
                       ('<force on="right" fx="-push" fy="0 mN" law="ramp" rise="16 ms"/>', ""))
        d = check(program, path, "push=150 uN", "gap=400 um")
        met = [c for c in d["clearances"] if c["meet"]]
        expect("a body that leaves the die is rejected",
               d["verdict"] == "reject" and met and "dicing lane" in (met[0]["a"], met[0]["b"]))
        d = check(program, path, "push=20 uN", "gap=400 um")
        expect("one that stays is not", not any(c["meet"] for c in d["clearances"]))


def beads(program):
    """a bead that stands in the open is no part of the frame, which a jaw that holds the bead may not meet"""
    bead = ('    <contact id="bead" side="outside" a="left" a-x="0.5 mm" a-y="0 mm" b="ground" b-x="0.51 mm" '
            'b-y="1.2 mm" distance="10 um" stiffness="10 N/m"/>\n  </scene>\n  <die frame="120 um"/>')
    with tempfile.TemporaryDirectory() as directory:
        path = changed(directory, "jaws.xml", ("  </scene>", bead), ('fx="push"', 'fx="-1*push"'),
                       ('<force on="right" fx="-push" fy="0 mN" law="ramp" rise="16 ms"/>', ""))
        d = check(program, path, "push=150 uN", "gap=400 um")
        met = [c for c in d["clearances"] if c["meet"]]
        expect("a jaw that meets the frame, away from its bead, is rejected",
               d["verdict"] == "reject" and bool(met) and "dicing lane" not in (met[0]["a"], met[0]["b"]))
        d = check(program, path, "push=5 uN", "gap=400 um")
        expect("one that does not is accepted", d["verdict"] == "accept")


def riders(program):
    path = os.path.join(DATA, "rider.xml")
    d = check(program, path)
    worst = [c for c in d["clearances"] if c["scene"] == "workspace"][0]
    expect("what rides on the platform goes with it into the frame",
           d["verdict"] == "reject" and worst["meet"] and "link rider" in (worst["a"], worst["b"]))
    d = check(program, path, "up=15 um")
    expect("and stays below it where the platform does", not reasons(d, "FW-D294") and not reasons(d, "FW-D295"))
    with tempfile.TemporaryDirectory() as directory:
        pulled = changed(directory, "rider.xml", (
            "  </mechanism>", '    <spring id="k" a="rider" a-x="0 mm" a-y="0 mm" b="AB" b-x="0 mm" b-y="0 mm" '
            'stiffness="0.1 N/m" length="3 mm"/>\n  </mechanism>'))
        d = check(program, pulled, "up=15 um")
        said = reasons(d, "FW-D295")
        expect("one that a spring pulls is said, once, not to be known",
               d["verdict"] != "accept" and len(said) == 1 and "rider" in said[0]["text"])


def folds(program):
    """a long thin leaf comes to its own root before the solids of its hinge meet"""
    with tempfile.TemporaryDirectory() as directory:
        path = changed(directory, "jaws.xml", ('length="400 um" width="8 um"', 'length="900 um" width="4.5 um"'),
                       ('max="500 um" doc="between', 'max="5 mm" doc="between'))
        d = check(program, path, "push=16 uN", "gap=3 mm")
        expect("a leaf that bends by 20 degrees keeps off its root", d["verdict"] == "accept")
        d = check(program, path, "push=30 uN", "gap=3 mm")
        expect("one that bends by 33 degrees is not proved to",
               d["verdict"] == "inconclusive" and len(reasons(d, "FW-D295")) == 2)


def large_boxes(program):
    """the band of required poses is a share of what links are moved by, however large the box is; where a leg is all but
    stretched that has no bound, and nothing is said of it"""
    path = os.path.join(DATA, "..", "..", "..", "docs", "gallery", "reference-six-bar", "device.xml")
    with open(path, encoding="utf-8") as f:
        text = f.read()
    asked = re.search(r'<workspace flow="al-masked-rie"[^>]*/>', text).group(0)
    with tempfile.TemporaryDirectory() as directory:
        at = os.path.join(directory, "six-bar.xml")

        def box(by):
            ends = " ".join('%s-min="%.9g %s" %s-max="%.9g %s"' % (c, -by * most, u, c, by * most, u)
                            for c, most, u in (("x", 150, "um"), ("y", 60, "um"), ("phi", 2, "deg")))
            with open(at, "w", encoding="utf-8") as f:
                f.write(text.replace(asked, '<workspace flow="al-masked-rie" %s/>' % ends))
            d = check(program, at, more=("--flow", "al-masked-rie"))
            return d, [c for c in d["clearances"] if c["scene"] == "workspace"][0]

        for by in (1, 1.2, 1.4, 1.6, 1.8, 2, 2.2):
            d, c = box(by)
            up, down = c["high_m"] - c["drawn_m"], c["drawn_m"] - c["low_m"]
            expect("a box %g times as large has a band of %.3g um to either side" % (by, 1e6 * up),
                   8e-6 < up < 25e-6 and abs(up - down) < 0.1 * up)
            expect("and is decided by it", c["verdict"] == "accept" and not reasons(d, "FW-D294"))
        d, c = box(2.294)
        said = [r for r in reasons(d, "FW-D295") if "come within" in r["text"]]
        expect("at the limit of reach it is not known", c["verdict"] == "inconclusive" and c["low_m"] is None and
               c["high_m"] is None and len(said) == 1 and "not bounded" in said[0]["text"] and "inf" not in said[0]["text"])


def thin_posts(program):
    """a tether is no part that its own body may meet, however thick that is where the tether ends"""
    with open(os.path.join(DATA, "post.xml"), encoding="utf-8") as f:
        text = f.read()
    with tempfile.TemporaryDirectory() as directory:
        for width in (24, 29, 29.5, 30, 30.5, 31, 36, 50):
            at = os.path.join(directory, "post.xml")
            with open(at, "w", encoding="utf-8") as f:
                f.write(text.replace('width="30 um"', 'width="%g um"' % width))
            d = check(program, at)
            expect("a post %g um thick meets nothing" % width, not reasons(d, "FW-D294"))


LONG = '''<device xmlns="urn:flexwright:device:1" name="long">
<material ref="silicon-100" youngs-modulus="150 GPa" poisson="0.25" thickness="50 um" strength="2 GPa"/>%s
<flow ref="al-masked-rie"/><die tethers="no"/><flexure id="leaf" kind="leaf" length="300 um" width="14 um"/><mechanism>
<body id="p" x="0.4 mm" y="0 mm" plate-width="0.2 mm" plate-height="0.3 mm">
<bar x="0.05 mm" y="0.1 mm" to-x="0.05 mm" to-y="0.9 mm" width="24 um"/><bar x="0.038 mm" y="0.888 mm" to-x="0.6 mm" to-y="0.888 mm" width="24 um"/>
<plate x="0.6 mm" y="0.85 mm" width="150 um" height="150 um"/></body>
<revolute id="A" a="ground" a-x="0 mm" a-y="0 mm" b="p" b-x="-0.4 mm" hinge="leaf" axis="90 deg"/></mechanism>
<scene name="shock" duration="%s"><base-motion ax="2000 m/s^2" law="half-sine" rise="0.02 ms"/></scene></device>'''


def long_scenes(program):
    """A scene of a hundred milliseconds is followed in parts before it is known that bodies give by 60 % of what hinges do: where 150 um are
    left and nothing moves by more than one that decides nothing, and where less is missing it does"""
    with tempfile.TemporaryDirectory() as directory:
        path = os.path.join(directory, "long.xml")
        for asked, lasts, verdict in (("", "5 ms", "accept"), ("", "100 ms", "accept"),
                                      ('<limits clearance="149.5 um"/>', "100 ms", "inconclusive")):
            with open(path, "w", encoding="utf-8") as f:
                f.write(LONG % (asked, lasts))
            d = check(program, path)
            expect("%s after %s is %s" % (asked, lasts, verdict),
                   d["verdict"] == verdict and bool(reasons(d, "FW-D295")) == (verdict != "accept"))


def main():
    for case in (jaws, eyelets, as_made, corners, roots, jumps, lane, beads, riders, folds, large_boxes, thin_posts, long_scenes):
        case(sys.argv[1])
    return 1 if FAULTS else 0


if __name__ == "__main__":
    sys.exit(main())
