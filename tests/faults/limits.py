#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Limits of time and memory: `--time-limit` and `--memory` drawn by the seed, on every device of the tree and on devices
with an extreme number, for every command that computes.

    limits.py PROGRAM [--seed N] [--count N] [--longest SECONDS] [--first N]

What must hold: the run ends, by itself, with a status of the contract; with 6 there is a message that says which limit,
and neither a directory nor a leftover; with another status the result is there. The processor time that a run took beyond its limit is
printed, the largest with its command; nothing is asserted of it but that a run ends within HANG_S, since other work may take the
machine."""
import argparse
import functools
import math
import pathlib
import random
import re
import resource
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
COMMANDS = ["check", "plan", "mask", "recipe", "statics", "modes", "assemble", "simulate", "workspace", "hinge"]
STATUSES = (0, 1, 3, 4, 6, 7)
HANG_S = 100
NUMBER = r"[-+]?\d+(?:\.\d*)?(?:e[-+]?\d+)?"
LENGTHS = ["1 nm", "10 nm", "1 um", "7 um", "33 um", "400 um", "2 mm", "10 mm", "1 m"]
ANGLES = ["0.001 deg", "1 deg", "89.999 deg", "180 deg", "270 deg", "359 deg", "359.999 deg"]
WHOLE = ["1", "2", "50000", "1000000"]


@functools.cache
def devices():
    found = [*ROOT.glob("docs/gallery/*/device.xml"), *ROOT.glob("tests/data/effects/*.xml"),
             *ROOT.glob("tests/data/wafer/*.xml")]
    return sorted(found)


def extreme(text, rng):
    """one to three attributes of the description with another value of their kind, and what was changed"""
    places = [m for m in re.finditer(r'(\w[-\w]*)="([^"]*)"', text)
              if m[1] not in ("xmlns", "id", "ref", "name", "version", "encoding", "on", "at", "doc", "kind", "body")]
    changed = []
    for place in sorted(rng.sample(places, min(len(places), rng.randint(1, 3))), key=lambda m: -m.start()):
        value = place[2]
        if re.fullmatch(NUMBER + " *(nm|um|mm|m)", value):
            new = rng.choice(LENGTHS)
        elif re.fullmatch(NUMBER + " *(deg|rad)", value):
            new = rng.choice(ANGLES)
        elif re.fullmatch(r"\d+", value):
            new = rng.choice(WHOLE)
        elif re.fullmatch(NUMBER + " *[a-zA-Z].*", value):
            new = re.sub("^" + NUMBER, lambda m: f"{float(m[0]) * 10 ** rng.randint(-6, 6):.6g}", value)
        else:
            continue
        changed.append(f'{place[1]}="{new}"')
        text = text[:place.start(2)] + new + text[place.end(2):]
    return text, changed


def chain(rng):
    """so many bodies that what grows with their square or cube takes hours"""
    n = round(10 ** rng.uniform(1, 4.7))
    bodies = "".join(f'<body id="b{i}" mass="0.02 mg" inertia="0.003 mg mm^2" x="{0.5 + i} mm" y="0 mm"/>' for i in range(n))
    joints = '<revolute id="r0" a="ground" b="b0" b-x="-0.5 mm"/>' + "".join(
        f'<revolute id="r{i}" a="b{i - 1}" a-x="0.5 mm" b="b{i}" b-x="-0.5 mm"/>' for i in range(1, n))
    scene = '<scene name="s" duration="1 ms"><gravity gy="-9.81 m/s^2"/></scene>'
    return (f'<?xml version="1.0"?>\n<device xmlns="urn:flexwright:device:1" name="many"><mechanism>{bodies}{joints}</mechanism>{scene}'
            f'</device>\n'), [f"{n} bodies"]


def command(rng, here, device, longest):
    name = rng.choice(COMMANDS)
    arguments = [name, str(device), "-o", str(here / "out"), "-q"]
    if rng.random() < 0.2:
        arguments += ["--hinge-model", rng.choice(["revolute", "compliance", "elastica"])]
    if rng.random() < 0.2:
        arguments += ["--accuracy", rng.choice(["1e-9", "1e-6", "0.1"])]
    if rng.random() < 0.2:
        arguments += ["--memory", str(rng.choice([16, 20, 40, 100, 300]))]
    limit = 10 ** rng.uniform(-2, math.log10(longest))
    return arguments + ["--time-limit", f"{limit:.3f}"], limit


def wrong_with(status, said, here):
    there = sorted(p.name for p in here.iterdir() if p.name != "device.xml" and p.suffix not in (".dxf", ".gds"))
    if status not in STATUSES:
        return f"status {status}: {said[-300:]}"
    if status == 6 and "time limit" not in said and "--memory" not in said and "limit" not in said:
        return f"6 without a word of the limit: {said[-300:]}"
    if status in (3, 6) and there not in ([], ["out"]) or [t for t in there if "tmp-" in t]:
        return f"left {there}"
    if status == 6 and there and not (here / "out" / "manifest.json").exists():
        return f"status 6 and {there}"
    return None


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=20)
    parser.add_argument("--keep", type=int, help="only writes the description of this run to kept.xml and its command")
    parser.add_argument("--longest", type=float, default=5, help="of the limits of time, s; with 0.5 some thirty runs a second")
    parser.add_argument("--first", type=int, default=0, help="the runs before this one are drawn, and not done")
    o = parser.parse_args()
    rng, bad, statuses, most = random.Random(o.seed), 0, {}, (0.0, "")
    for i in range(o.count):
        with tempfile.TemporaryDirectory() as name:
            here = pathlib.Path(name)
            source = rng.choice(devices())
            for drawing in source.parent.glob("*.dxf"):
                (here / drawing.name).write_bytes(drawing.read_bytes())
            text, changed = source.read_text(), []
            if rng.random() < 0.7:
                text, changed = extreme(text, rng)
            if rng.random() < 0.01:
                text, changed = chain(rng)
            (here / "device.xml").write_text(text)
            arguments, limit = command(rng, here, here / "device.xml", o.longest)
            if i < o.first:
                continue
            if o.keep is not None:
                if i == o.keep:
                    pathlib.Path("kept.xml").write_text(text)
                    print(*arguments)
                continue
            start, before = time.monotonic(), resource.getrusage(resource.RUSAGE_CHILDREN)
            what = None
            try:
                run = subprocess.run([o.program.resolve(), *arguments], capture_output=True, text=True, errors="replace",
                                     timeout=limit + HANG_S, stdin=subprocess.DEVNULL)
                what = wrong_with(run.returncode, run.stderr, here)
                statuses[run.returncode] = statuses.get(run.returncode, 0) + 1
            except subprocess.TimeoutExpired:
                what = f"did not end within {HANG_S} s of its limit"
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
            # of the processor: what other work takes from a busy machine does not count
            over = min(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, time.monotonic() - start) - limit
            line = f"{i}: {source.relative_to(ROOT)} {' '.join(changed)}: {' '.join(arguments[:1] + arguments[5:])}"
            if over > most[0]:
                most = over, line
            if over > 1:
                print(f"{over:.1f} s of the processor beyond its limit: {line}", flush=True)
            if what:
                bad += 1
                print(f"{line}: {what}", flush=True)
    if o.keep is not None:
        return 0
    print("statuses: " + ", ".join(f"{s} {n}" for s, n in sorted(statuses.items())))
    print(f"{o.count - o.first} runs, {bad} wrong; longest beyond its limit {most[0]:.2f} s: {most[1]}")
    return bool(bad)


if __name__ == "__main__":
    sys.exit(main())
