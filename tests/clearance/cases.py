#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Devices whose parts meet, and the same ones where they do not: cases.py FLEXWRIGHT"""
import json
import os
import subprocess
import sys
import tempfile

DATA = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "data", "clearance")
FAULTS = []


def check(program, path, *sets, corners="none"):
    run = [program, "check", path, "--json", "--advice", "none", "--corners", corners]
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


def main():
    for case in (jaws, eyelets, as_made):
        case(sys.argv[1])
    return 1 if FAULTS else 0


if __name__ == "__main__":
    sys.exit(main())
