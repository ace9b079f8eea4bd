#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a device of a study costs beside `check` of the same device, and how far one machine is from a million of them.

    tests/bench/study.py build/flexwright [--designs 1000] [--checks 30] [--rounds 3] [--jobs N]
    tests/bench/study.py build/flexwright --instructions 10 [--as hinges]
    tests/bench/study.py build/flexwright --designs 1000000 --checks 6 --rounds 1 --jobs 2 --as hinges --fitted 0.01
    tests/bench/study.py build/flexwright --designs 100000 --checks 2000 --jobs 2 --as die --fitted 0.02 [--inputs 12]

The reference six-bar as drawn, the width and the arc of every hinge at random, a step load, accuracy 1e-3, the
verdict of every hinge. Rounds take turns, so that all meet the same noise; times are of the processor, user and
system, of whole commands, less those of a study of two devices where it says "each". The median of the rounds is
told, and all of them. --instructions counts those of so many devices by valgrind, which no noise changes, and what
of them is spent where.

--as die: the gallery's six-bar as its first flow makes it, each device one die with a sample of the process of its own, and
as many of the widths and arcs at random as --inputs says; --checks of them are judged as well, and compared."""
import argparse
import json
import os
import pathlib
import re
import resource
import sqlite3
import statistics
import subprocess
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
GALLERY = ROOT / "docs/gallery/reference-six-bar/device.xml"
WIDTHS = dict(zip("ABCDEF", (9, 8.5, 8, 8, 9, 10)))


def device():
    text = re.sub(r'\s*<(flow|workspace|parameter name="arc") [^>]*/>', "", GALLERY.read_text())
    text = re.sub(r'\s*<scene name="gentle-step".*?</scene>', "", text, flags=re.S)
    return text.replace(' flow="al-masked-rie"', "").replace('angle="arc"', 'angle="240 deg"')


def study(designs, judged, fitted=None):
    rows = "".join(f'<vary what="flexure[{h}]/@width" from="{0.8 * w:g} um" to="{1.2 * w:g} um"/>'
                   f'<vary what="flexure[{h}]/@angle" from="200 deg" to="250 deg"/>\n' for h, w in WIDTHS.items())
    hinges = "".join(f'<respond name="{h}" value="hinges[{h}].utilisation"/>' for h in WIDTHS)
    return ('<study xmlns="urn:flexwright:study:1" name="six-bars" kind="sweep" points="sobol" '
            f'as="{judged}" samples="{designs}"{f""" fitted="{fitted}" """ if fitted else ""} device="device.xml">\n{rows}{hinges}</study>\n')


def run(*command):
    """seconds of the processor and of the wall; bytes of memory at most, over all children so far"""
    before, began = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    subprocess.run(list(map(str, command)), check=True, stdout=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return cpu, time.monotonic() - began, after.ru_maxrss * 1024


STAGES = {"motions": "fw_statics_move_scene", "of that, integrated and looked at": "fw_dynamics_simulate_compiled",
          "drawing": "fw_layout_build", "what bodies give": "fw_verdict_body_arms",
          "clearances": "fw_verdict_clearance_judge", "strips": "fw_verdict_clearance_strips",
          "out of the plane": "fw_verdict_out_of_plane_judge", "stability": "fw_statics_stability_find",
          "mechanism": "fw_mechanism_build", "description": "fw_plan_kept_again",
          "documents": "fw_study_responses_take"}


def count(program, place, designs, judged):
    """instructions of a study, and of those below each of STAGES"""
    (place / "count.xml").write_text(study(designs, judged))
    out = place / f"callgrind-{designs}"
    subprocess.run(["valgrind", "--tool=callgrind", f"--callgrind-out-file={out}", str(program), "study",
                    str(place / "count.xml"), "-o", str(place / f"count-{designs}"), "--jobs", "1"], check=True,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    text = subprocess.run(["callgrind_annotate", "--inclusive=yes", "--threshold=100", str(out)], check=True,
                          capture_output=True, text=True).stdout
    spent = {}
    for line in text.splitlines():
        found = re.match(r"\s*([\d,]+) .*?:(\w+)(?:'\d+)?(?: \[|$)", line)
        if found:
            spent.setdefault(found[2], int(found[1].replace(",", "")))
    # files are looked at once a second of the clock, which valgrind makes a hundred times slower
    total = int(re.search(r"([\d,]+) .*PROGRAM TOTALS", text)[1].replace(",", "")) - spent["fw_study_design"]
    return total, {what: spent.get(name, 0) for what, name in STAGES.items()}


def instructions(program, place, designs, judged):
    few, many = (count(program, place, n, judged) for n in (2, designs + 2))
    print(f"{'a device of a study':38} {(many[0] - few[0]) / designs / 1e6:9.2f} million instructions")
    for what in STAGES:
        print(f"  {what:36} {(many[1][what] - few[1][what]) / designs / 1e6:9.2f}")


def dies(program, place, given):
    """time of a study of dies, and those that are judged as well against what was told of them"""
    rows = [row for h, w in WIDTHS.items() for row in (
        f'<vary what="flexure[{h}]/@width" from="{0.8 * w:g} um" to="{1.2 * w:g} um"/>',
        f'<vary what="flexure[{h}]/@angle" from="200 deg" to="250 deg"/>')][:given.inputs]
    hinges = "".join(f'<respond name="{h}" value="hinges[{h}].utilisation"/>' for h in WIDTHS)
    fitted = f'fitted="{given.fitted}"' if given.fitted else ""
    for name, more in (("told", fitted), ("judged", "")):
        (place / f"{name}.xml").write_text(
            f'<study xmlns="urn:flexwright:study:1" name="dies" kind="sweep" points="sobol" as="die" '
            f'samples="{given.designs}" {more} device="{GALLERY}">{"".join(rows)}{hinges}</study>')
    options = ("--flow", "al-masked-rie", "--jobs", given.jobs)
    cpu, wall, memory = run(program, "study", place / "told.xml", "-o", place / "told", *options)
    print(f"{given.designs} dies: {wall:.1f} s, {cpu:.1f} s of a processor, {memory / 1e6:.0f} MB")
    said = json.loads((place / "told/study.json").read_text())
    if "fitted" not in said:
        return
    print(", ".join(f"{key} {said['fitted'][key]}" for key in ("judged", "left_open", "told")))
    run(program, "study", place / "judged.xml", "-o", place / "judged", *options, "--shard",
        f"1/{max(1, given.designs // given.checks)}")

    def rows_of(name):
        with sqlite3.connect(place / name / "study.sqlite") as store:
            return {row[0]: row for row in store.execute("SELECT * FROM sample")}
    told, off = rows_of("told"), [r["told_within"] for r in said["responses"]]
    pairs = [(row, told[i]) for i, row in rows_of("judged").items() if told[i][2]]
    print(f"{len(pairs)} of those told were judged as well: {sum(a[1] != b[1] for a, b in pairs)} decided otherwise")
    for k, (h, far) in enumerate(zip(WIDTHS, off)):
        worst = max(abs(a[k - 6] - b[k - 6]) for a, b in pairs)
        print(f"  hinge {h}: {min(r[k - 6] for r in told.values()):.3f} to {max(r[k - 6] for r in told.values()):.3f}, "
              f"told to within {far:.4f}, off by {worst:.4f} at most")


def main():
    ask = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    ask.add_argument("program", type=pathlib.Path)
    for name, usual in (("designs", 1000), ("checks", 30), ("rounds", 3), ("jobs", 1)):
        ask.add_argument(f"--{name}", type=int, default=usual)
    ask.add_argument("--instructions", type=int, default=0, metavar="DESIGNS")
    ask.add_argument("--as", dest="judged", choices=("drawn", "hinges", "die"), default="drawn")
    ask.add_argument("--inputs", type=int, default=0, help="of --as die: how many widths and arcs are at random")
    ask.add_argument("--fitted", metavar="SHARE", help="devices that response surfaces tell are not judged")
    given = ask.parse_args()
    program = given.program.resolve()
    os.environ["OPENBLAS_NUM_THREADS"] = "1"
    with tempfile.TemporaryDirectory(prefix="fw-bench-") as name:
        place = pathlib.Path(name)
        (place / "device.xml").write_text(device())
        if given.judged == "die":
            dies(program, place, given)
            return
        if given.instructions:
            instructions(program, place, given.instructions, given.judged)
            return
        for n in (2, given.designs):
            (place / f"study-{n}.xml").write_text(study(n, given.judged, given.fitted))
        each, checks, walls, memory = [], [], [], 0
        for turn in range(given.rounds):
            few = run(program, "study", place / "study-2.xml", "-o", place / f"two-{turn}", "--jobs", given.jobs)
            many = run(program, "study", place / f"study-{given.designs}.xml", "-o", place / f"all-{turn}", "--jobs",
                       given.jobs)
            memory = max(memory, many[2])
            each.append((many[0] - few[0]) / (given.designs - 2))
            walls.append((many[1] - few[1]) / (given.designs - 2))
            with sqlite3.connect(place / f"all-{turn}/study.sqlite") as store:
                names = [row[1] for row in store.execute("PRAGMA table_info(sample)")]
                inputs = [n for n in names if n.startswith("flexure[")]
                rows = store.execute("SELECT " + ",".join(f'"{n}"' for n in inputs) + " FROM sample ORDER BY i LIMIT ?",
                                     (given.checks,)).fetchall()
            spent = 0
            for row in rows:
                sets = [w for n, v in zip(inputs, row)
                        for w in ("--set", f"{n}={v!r} {'m' if n.endswith('width') else 'rad'}")]
                spent += run(program, "check", place / "device.xml", "--corners", "none", "--advice", "none", "--quiet",
                             *sets)[0]
            checks.append(spent / len(rows))
    ratios = [b / a for a, b in zip(each, checks)]

    def tell(what, values, unit, by=1e3):
        print(f"{what:38} {by * statistics.median(values):9.3f} {unit}   "
              f"({', '.join(f'{by * v:.3f}' for v in values)})")

    tell("a device of a study, processor", each, "ms")
    tell(f"a device of a study, wall, {given.jobs} jobs", walls, "ms")
    tell("one `check`, processor", checks, "ms")
    tell("`check` over a device of a study", ratios, "times", 1)
    tell("a million devices, processor", each, "s", 1e6)
    print(f"{'memory, at most':38} {memory / 1e6:9.1f} MB")


if __name__ == "__main__":
    main()
