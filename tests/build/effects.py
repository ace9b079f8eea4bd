#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What effects cost, in instructions per right-hand side, counted by callgrind.

effects.py absent BUILD       an absent effect costs nothing: a build without it executes exactly as many
                              instructions, and gives the same bits, for every scene that does not call
                              for it. BUILD is a directory of its own; only the rooms up to multibody are
                              built, and for the next effect one file is compiled again.
effects.py costs PROGRAM      what every effect costs when it is on, against what its row states (25 %,
                              because compilers differ); PROGRAM is tests/bench/effect_cost
effects.py write PROGRAM      the same, into docs/data/effect-costs.csv and docs/theory/effects/costs.md

To add an effect: a row in COSTS. To prove more scenes free of it: a row in SCENES."""
import csv
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
DATA = ROOT / "tests/data"
CSV = ROOT / "docs/data/effect-costs.csv"
PAGE = ROOT / "docs/theory/effects/costs.md"
COUNT, LIMIT = 100, 0.25
SKIPPED = 77

# scenes that must not feel an effect that they do not call for: file in tests/data, scene, options
SCENES = [
    ("effect-costs/pins", "step", []),  # pins with springs: the fast kernel
    ("effect-costs/pins", "step", ["--general"]),
    ("effect-costs/pins", "swaying", []),  # loads with laws
    ("effect-costs/damped", "step", []),
    ("effect-costs/held", "step", []),  # stops and point springs
    ("effect-costs/joints", "steady", []),  # prismatic joint, rod, weld
    ("effect-costs/joints", "falling", []),
    ("effect-costs/pulled", "pulled", []),  # an element of another effect: tendons
]

# an effect, the scene that it is measured in (on, and as if it were not called for), options. All in the
# general code, where every effect can act; what the fast kernel does is in the page.
COSTS = [
    ("joint-elasticity", "effect-costs/pins", "step", ["--general"]),
    ("joint-damping", "effect-costs/damped", "step", ["--general"]),
    ("joint-stop", "effect-costs/held", "step", ["--general"]),
    ("point-spring", "effect-costs/held", "step", ["--general"]),
    ("applied-load", "effect-costs/pins", "swaying", ["--general"]),
    ("gravity", "effect-costs/pins", "weight", ["--general"]),
    ("initial-velocity", "effect-costs/pins", "moving", ["--general"]),
    ("inertia", "effect-costs/pins", "step", ["--general"]),
    ("tendon", "effect-costs/pulled", "pulled", []),
]


def run(*arguments):
    done = subprocess.run([str(a) for a in arguments], capture_output=True, text=True, check=False)
    if done.returncode:
        sys.exit(f"{' '.join(map(str, arguments))}\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
    return done.stdout


def effects(program):
    """id: (removable, instructions as stated)"""
    rows = [line.split() for line in run(program, "--list").splitlines()]
    return {name: (kind == "removable", float(cost)) for name, kind, cost in rows}


def readable(name, known):
    """A scene's file, when this version knows all that it names."""
    file = DATA / f"{name}.xml"
    wanted = re.search(r"<!-- needs: ([a-z -]*) -->", file.read_text(encoding="utf-8")) if file.exists() else None
    return file.exists() and not (set(wanted.group(1).split()) - set(known) if wanted else ())


class Count:
    """One run under callgrind: instructions of COUNT right-hand sides, and what the program says."""

    def __init__(self, program, file, scene, options):
        with tempfile.TemporaryDirectory() as work:
            out = pathlib.Path(work) / "out"
            text = run("valgrind", "--tool=callgrind", f"--callgrind-out-file={out}", "--toggle-collect=measured",
                       program, DATA / f"{file}.xml", scene, COUNT, *options)
            counted = re.search(r"^(?:summary|totals): (\d+)", out.read_text(encoding="utf-8"), re.M)
        self.total = int(counted.group(1))
        self.each = self.total / COUNT
        self.calls = {m[0]: int(m[1]) for m in re.findall(r"^calls (\S+) (\d+)$", text, re.M)}
        self.kernel = "kernel yes" in text
        self.sum = re.search(r"^sum (\S+)$", text, re.M).group(1)


# ---- absent ----

def build(where, without):
    run("cmake", "-S", ROOT, "-B", where, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
        f"-DFW_WITHOUT_EFFECTS={';'.join(without)}")
    run("cmake", "--build", where, "--target", "effect_cost", "-j", "2")
    program = where / "tests/bench/effect_cost"
    left = set(without) & set(effects(program))
    if left:
        sys.exit(f"built without {without}, and still has {left}")
    return program


def absent(where):
    program, status, compared = build(where, []), 0, 0
    known = effects(program)
    scenes = [s for s in SCENES if readable(s[0], known)]
    for name, scene, _ in SCENES[:]:
        if not readable(name, known):
            print(f"{name} {scene}: not in this version, skipped")
    full = [Count(program, *s) for s in scenes]
    removable = [name for name, (gone, _) in known.items() if gone]
    # all at once, then each alone; inertia is in every motion: without its row it acts as it always did
    for without in [removable, *[[name] for name in removable]]:
        program = build(where, without)
        for (file, scene, options), before in zip(scenes, full):
            if set(before.calls) & set(without) - {"inertia"}:
                continue
            now = Count(program, file, scene, options)
            compared += 1
            if now.total != before.total or now.sum != before.sum:
                print(f"{file} {scene} {' '.join(options)}: {now.total - before.total:+d} instructions of "
                      f"{before.total} without {', '.join(without)}, though it calls for none of them")
                status = 1
        print(f"without {', '.join(without)}: compared", flush=True)
    if compared < len(removable):
        sys.exit("too few scenes are free of effects: nothing is proved")
    print(f"{compared} comparisons of {COUNT} right-hand sides each")
    return status


# ---- costs ----

def measure(program):
    known, rows = effects(program), []
    for name, file, scene, options in COSTS:
        if name not in known or not readable(file, known):
            print(f"{name}: not in this version, skipped")
            continue
        on = Count(program, file, scene, options)
        off = Count(program, file, scene, [*options, "--off", name])
        many = on.calls.get(name, 0)
        if not many:
            sys.exit(f"{file} {scene} does not call for {name}")
        rows.append({"effect": name, "file": file, "scene": scene, "off": off.each, "on": on.each,
                     "instances": many, "each": (on.each - off.each) / many, "stated": known[name][1]})
    return known, rows


def costs(program):
    known, rows = measure(program)
    status = 0
    for row in rows:
        # a handful of instructions more or less is nothing that a choice could depend on
        good = abs(row["each"] - row["stated"]) <= max(LIMIT * row["each"], 5)
        print(f"{row['effect']:20} {row['each']:8.1f} instructions, stated {row['stated']:g}{'' if good else '  WRONG'}")
        status |= not good
    missing = set(known) - {row["effect"] for row in rows}
    if missing:
        print(f"no scene in COSTS measures: {', '.join(sorted(missing))}")
        status = 1
    return status


def fast(program):
    """the six-bar on the fast kernel and in the general code: what the first effect beyond it costs"""
    return Count(program, "effect-costs/pins", "step", []).each, Count(program, "effect-costs/pins", "step", ["--general"]).each


def provenance():
    compiler = run("cc", "--version").splitlines()[0]
    return [("command", "tests/build/effects.py write BUILD/tests/bench/effect_cost"), ("compiler", compiler),
            ("flags", "-O2, portable"), ("counted by", run("valgrind", "--version").strip() + " (callgrind)"),
            ("right-hand sides", str(COUNT))]


def write(program):
    _, rows = measure(program)
    quick, general = fast(program)
    facts = provenance()
    CSV.parent.mkdir(parents=True, exist_ok=True)
    with CSV.open("w", encoding="utf-8", newline="") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(["effect", "file", "scene", "off", "on", "instances", "each"])
        for key, value in facts:
            out.writerow(["provenance", key, value, "", "", "", ""])
        out.writerow(["fast kernel", "effect-costs/pins", "step", f"{quick:.2f}", f"{general:.2f}", 1, f"{general - quick:.2f}"])
        for r in rows:
            out.writerow([r["effect"], r["file"], r["scene"], f"{r['off']:.2f}", f"{r['on']:.2f}", r["instances"],
                          f"{r['each']:.2f}"])
    lines = ["| effect | scene | off | on | instances | each |", "|---|---|---:|---:|---:|---:|"]
    lines += [f"| {r['effect']} | `{r['file']}.xml` {r['scene']} | {r['off']:.0f} | {r['on']:.0f} | {r['instances']} | "
              f"{r['each']:.0f} |" for r in rows]
    lines += ["", f"The six-bar of `pins.xml` takes {quick:.0f} instructions on the fast kernel and {general:.0f} in "
              "the general code.", "", *[f"- {key}: {value}" for key, value in facts]]
    page = PAGE.read_text(encoding="utf-8")
    begin, end = "<!-- measured: begin -->", "<!-- measured: end -->"
    head, tail = page.split(begin)[0], page.split(end)[1]
    PAGE.write_text(head + begin + "\n\n" + "\n".join(lines) + "\n\n" + end + tail, encoding="utf-8")
    return 0


def main():
    if len(sys.argv) != 3 or sys.argv[1] not in ("absent", "costs", "write"):
        sys.exit(__doc__)
    if not shutil.which("valgrind"):
        print("valgrind is not installed: skipped")
        sys.exit(SKIPPED)
    where = pathlib.Path(sys.argv[2]).resolve()
    sys.exit({"absent": absent, "costs": costs, "write": write}[sys.argv[1]](where))


if __name__ == "__main__":
    main()
