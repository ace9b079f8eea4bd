#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What effects cost, in instructions per right-hand side, counted by callgrind.

effects.py absent BUILD       an absent effect costs nothing: a program without it executes exactly as many
                              instructions, and gives the same bits, for every scene that does not call
                              for it. BUILD is the build directory; its libraries are linked once more for
                              every effect, with a table that does not name it
effects.py costs PROGRAM      what every effect costs when it is on, against what its row states (25 %,
                              because compilers differ); PROGRAM is tests/bench/effect_cost
effects.py write PROGRAM      the same, into docs/data/effect-costs.csv, docs/theory/effects/costs.md and its
                              picture; says which rows state another cost

To add an effect: a row in COSTS. To prove more scenes free of it: a row in SCENES."""
import concurrent.futures
import csv
import os
import pathlib
import re
import subprocess
import sys

sys.path[:0] = [str(pathlib.Path(__file__).resolve().parents[1] / folder) for folder in ("bench", "docs")]
sys.dont_write_bytecode = True
import callgrind  # noqa: E402
import effect_costs_picture  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
DATA = ROOT / "tests/data/effect-costs"
CSV = ROOT / "docs/data/effect-costs.csv"
PAGE = ROOT / "docs/theory/effects/costs.md"
COUNT, LIMIT = 100, 0.25
ALL, FEW = bool(os.environ.get("FW_TEST_ALL")), 6  # scenes that are too few to leave any out

# scenes that must not feel an effect that they do not call for: file, scene, options
SCENES = [
    ("pins", "step", []),  # pins with springs: the fast kernel
    ("pins", "step", ["--general"]),
    ("pins", "swaying", []),  # loads with laws
    ("damped", "step", []),
    ("held", "step", []),  # stops and point springs
    ("joints", "steady", []),  # prismatic joint, rod, weld
    ("joints", "falling", []),
    ("free", "falling", []),  # nothing elastic, and no load but weight
    ("free", "swinging", []),
    # elements of one effect each, for the absence of all others
    ("free", "rubbing", []),
    ("free", "rubbing", ["--still"]),  # sticks
    ("pulled", "pulled", []),  # tendons
    ("pulled", "rubbed", []),
    ("arms", "pulled", []),
    ("drawn", "comb", []),
    ("drawn", "plate", []),
    ("giving", "plain", []),  # hinges that give
    ("giving", "touching", []),
    ("lossy", "damped", []),
    ("stated", "shaken", ["--pins"]),
    ("stated", "warming", ["--pins"]),
    ("stated", "growing", ["--pins"]),
    ("stated", "stressed", ["--pins"]),
    ("stated", "slide", ["--pins"]),
    ("stated", "squeeze", ["--pins"]),
    ("stated", "drag", ["--pins"]),
    ("stated", "rubbing", ["--pins"]),
]

# an effect, the scene that it is measured in (on, and as if it were not called for), options, and which
# kind of it this is. All in the general code, where every effect can act. The row of an effect of more
# kinds states the dearest.
COSTS = [
    ("joint-elasticity", "pins", "step", [], "hinge or slide"),
    ("joint-damping", "damped", "step", [], "hinge or slide"),
    ("material-damping", "lossy", "damped", ["--pins"], "hinge"),
    ("joint-stop", "held", "step", [], "side of a stop"),
    ("point-spring", "held", "step", [], "spring"),
    ("applied-load", "pins", "step", [], "constant: nothing"),
    ("applied-load", "pins", "swaying", [], "load with a law"),
    ("gravity", "pins", "weight", [], "weight of all bodies: nothing"),
    ("initial-velocity", "pins", "moving", [], "set once: nothing"),
    ("base-motion", "stated", "pushed", ["--pins"], "constant: nothing"),
    ("base-motion", "stated", "shaken", ["--pins"], "body and law"),
    ("nonlinear-hinge", "giving", "plain", [], "hinge"),
    ("contact", "giving", "touching", [], "conjugate surfaces that touch"),
    ("contact", "giving", "apart", [], "conjugate surfaces with a gap"),
    ("contact", "giving", "bumping", [], "two round things"),
    ("friction", "stated", "rubbing", ["--pins"], "joint that slips"),
    ("friction", "stated", "rubbing", ["--pins", "--still"], "joint that sticks"),
    ("friction", "stated", "rubbing-twice", ["--pins"], "joint of two that slip"),
    ("tendon", "pulled", "pulled", [], "pull over two eyelets"),
    ("eyelet-friction", "pulled", "rubbed", [], "in no motion: nothing"),
    ("body-compliance", "arms", "pulled", [], "spring on an arm"),
    ("comb-drive", "drawn", "comb", ["--off", "fringe-field"], "comb, constant voltage"),
    ("comb-drive", "drawn", "driven", ["--off", "fringe-field"], "comb, voltage with a law"),
    ("comb-drive", "drawn", "plate", ["--off", "fringe-field"], "plate, constant voltage"),
    ("fringe-field", "drawn", "comb", [], "comb, constant voltage"),
    ("fringe-field", "drawn", "driven", [], "comb, voltage with a law"),
    ("fringe-field", "drawn", "plate", [], "plate, constant voltage"),
    ("finger-bending", "drawn", "comb", [], "in no motion: nothing"),
    ("levitation", "drawn", "comb", [], "in no motion: nothing"),
    ("temperature", "stated", "warm", ["--pins"], "constant: nothing"),
    ("temperature", "stated", "warming", ["--pins"], "hinge that softens with a law"),
    ("temperature", "stated", "growing", ["--pins"], "ground that grows with a law, per hinge"),
    ("residual-stress", "stated", "stressed", ["--pins"], "lengths at the start: nothing"),
    ("out-of-plane", "stated", "stressed", ["--pins"], "judged beside the motion: nothing"),
    ("adhesion", "giving", "touching", [], "judged beside the motion: nothing"),
    ("air", "stated", "slide", ["--pins"], "body on a film"),
    ("air", "stated", "squeeze", ["--pins"], "film between walls"),
    ("air", "stated", "drag", ["--pins"], "body in open air"),
    ("inertia", "pins", "step", [], "the integration itself"),
]


def run(*arguments):
    done = subprocess.run([str(a) for a in arguments], capture_output=True, text=True, check=False)
    if done.returncode:
        sys.exit(f"{' '.join(map(str, arguments))}\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
    return done.stdout


def effects(program):
    """id: instructions as stated"""
    return {name: float(cost) for name, cost in (line.split() for line in run(program, "--list").splitlines())}


class Count:
    """Of one scene: instructions of COUNT right-hand sides, and what the program said."""

    def __init__(self, total, text):
        self.total, self.each = total, total / COUNT
        self.calls = {m[0]: int(m[1]) for m in re.findall(r"^calls (\S+) (\d+)$", text, re.M)}
        self.kernel = "kernel yes" in text
        self.sum = re.search(r"^sum (\S+)$", text, re.M).group(1)


def count(program, scenes):
    """All of them in one run under callgrind, which writes a file for each."""
    wanted = []
    for file, scene, options in scenes:
        wanted += ["--then", DATA / f"{file}.xml", scene, COUNT, *options]
    text, status, parts = callgrind.count(program, wanted[1:])
    if status:
        sys.exit(f"{program}: status {status}\n{text[-2000:]}")
    return [Count(part.total, about) for part, about in zip(parts, re.split(r"^scene ", text, flags=re.M)[1:], strict=True)]


# ---- absent ----

def look(program, gone, before, turn):
    """The scenes that call for nothing of what is gone, against the whole program: what is wrong, and how many. Of them every
    third, by turns, so that each effect meets eight scenes or so and each scene seven effects; all with ./test --all"""
    left = set(re.findall(r" fw_effect_(\w+)$", run("nm", program), re.M)) & {name.replace("-", "_") for name in gone}
    wrong = [f"{program.name} still has {', '.join(left)}"] if left or gone & set(effects(program)) else []
    # inertia is in every motion: without its row it acts as it always did
    pairs = [(scene, was) for scene, was in zip(SCENES, before) if not set(was.calls) & (gone - {"inertia"})]
    if not ALL and len(pairs) > FEW:
        pairs = pairs[turn % 3::3]
    free, old = [scene for scene, _ in pairs], [was for _, was in pairs]
    for (file, scene, options), was, now in zip(free, old, count(program, free) if free else [], strict=True):
        if now.total != was.total or now.sum != was.sum:
            wrong.append(f"{file} {scene} {' '.join(options)}: {now.total - was.total:+d} instructions of {was.total} "
                         f"without {', '.join(sorted(gone))}, though it calls for none of them")
    if not free:
        wrong.append(f"every scene calls for {', '.join(sorted(gone))}: nothing is proved")
    return wrong, len(free)


def absent(where):
    run("cmake", "--build", where, "--target", "effect_cost", "effect_cost_without", "-j", "2")
    whole = where / "tests/bench/effect_cost"
    known, before, status, compared = set(effects(whole)), count(whole, SCENES), 0, 0
    missing = known - {name for was in before for name in was.calls}
    if missing:  # a scene with each, so that there is something to compare it with
        print(f"no scene in SCENES calls for {', '.join(sorted(missing))}")
        status = 1
    others = whole.with_name("effect_cost_without_others")
    jobs = [(whole.with_name(f"effect_cost_without_{name.replace('-', '_')}"), {name}) for name in sorted(known)]
    jobs.append((others, known - set(effects(others))))
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        for (_, gone), (wrong, free) in zip(jobs, pool.map(lambda job: look(*job[1], before, job[0]), enumerate(jobs))):
            print(f"without {', '.join(sorted(gone))}: {free} scenes")
            for line in wrong:
                print(line)
            compared += free
            status |= bool(wrong)
    print(f"{compared} comparisons of {COUNT} right-hand sides each")
    return status


# ---- costs ----

def measure(program):
    """rows of the table; what the rows of the effects should state, with what they do: {effect: (stated, dearest)}"""
    known, scenes, rows = effects(program), [], []
    for name, file, scene, options, _ in COSTS:
        scenes += [(file, scene, [*options, "--general"]), (file, scene, [*options, "--general", "--off", name])]
    counted = count(program, scenes)
    for (name, file, scene, options, kind), on, off in zip(COSTS, counted[0::2], counted[1::2], strict=True):
        if name not in on.calls:
            sys.exit(f"{file} {scene} does not call for {name}")
        many = on.calls[name]
        if many == 0 and on.total != off.total:
            sys.exit(f"{file} {scene}: {name} counts no instance, and costs {on.each - off.each:g}")
        rows.append({"effect": name, "kind": kind, "file": file, "scene": " ".join([scene, *options]), "off": off.each,
                     "on": on.each, "instances": many, "each": (on.each - off.each) / max(many, 1)})
    dearest = {name: max([row["each"] for row in rows if row["effect"] == name], default=None) for name in known}
    return rows, {name: (known[name], dearest[name]) for name in known}


def judge(stated):
    """says what the rows of the effects state; 1 where that is off"""
    status = 0
    for name, (said, found) in stated.items():
        if found is None:
            print(f"{name:20} no scene in COSTS measures it")
            status = 1
            continue
        # a handful of instructions more or less is nothing that a choice could depend on
        good = abs(found - said) <= max(LIMIT * found, 5)
        off = "" if good else f"  OFF by {said - found:+.0f}: set .cost in src/effects/{name.replace('-', '_')}.c"
        print(f"{name:20} {found:8.0f} instructions, stated {said:g}{off}")
        status |= not good
    return status


def costs(program):
    return judge(measure(program)[1])


def provenance():
    compiler = run("cc", "--version").splitlines()[0]
    return [("command", "tests/build/effects.py write BUILD/tests/bench/effect_cost"), ("compiler", compiler),
            ("flags", "-O2, portable"), ("counted by", run("valgrind", "--version").strip() + " (callgrind)"),
            ("right-hand sides", str(COUNT))]


def table(rows):
    lines = ["| effect | what is counted | scene | without | with | instances | each | of the whole |",
             "|---|---|---|---:|---:|---:|---:|---:|"]
    for r in rows:
        share = (r["on"] - r["off"]) / r["off"]
        lines.append(f"| {r['effect']} | {r['kind']} | `{r['file']}.xml` {r['scene']} | {r['off']:.0f} | {r['on']:.0f} | "
                     f"{r['instances']} | {r['each']:.0f} | {f'+{100 * share:.1f} %' if share else '0'} |")
    return lines


def write(program):
    rows, stated = measure(program)
    # what the first effect beyond the fast kernel costs
    quick, general = [c.each for c in count(program, [("pins", "step", []), ("pins", "step", ["--general"])])]
    facts = provenance()
    CSV.parent.mkdir(parents=True, exist_ok=True)
    with CSV.open("w", encoding="utf-8", newline="") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(["effect", "kind", "file", "scene", "off", "on", "instances", "each"])
        for key, value in facts:
            out.writerow(["provenance", key, value, "", "", "", "", ""])
        out.writerow(["fast kernel", "six-bar", "pins", "step", f"{quick:.2f}", f"{general:.2f}", 1, f"{general - quick:.2f}"])
        for r in rows:
            out.writerow([r["effect"], r["kind"], r["file"], r["scene"], f"{r['off']:.2f}", f"{r['on']:.2f}",
                          r["instances"], f"{r['each']:.2f}"])
    lines = [f"The six-bar of `pins.xml` takes **{quick:.0f}** instructions on the fast kernel and **{general:.0f}** in the",
             f"general code, {general / quick:.1f} times as many.", "", *table(rows), "",
             *[f"- {key}: {value}" for key, value in facts]]
    page = PAGE.read_text(encoding="utf-8")
    begin, end = "<!-- measured: begin -->", "<!-- measured: end -->"
    head, tail = page.split(begin)[0], page.split(end)[1]
    PAGE.write_text(head + begin + "\n\n" + "\n".join(lines) + "\n\n" + end + tail, encoding="utf-8")
    effect_costs_picture.PICTURE.write_text(effect_costs_picture.draw(), encoding="utf-8")
    if judge(stated):
        print("the table is written; the ledger states these rows' costs until they are set and built again")
    return 0


def main():
    if len(sys.argv) != 3 or sys.argv[1] not in ("absent", "costs", "write"):
        sys.exit(__doc__)
    if callgrind.missing():
        print("valgrind is not installed: skipped")
        sys.exit(callgrind.SKIPPED)
    where = pathlib.Path(sys.argv[2]).resolve()
    sys.exit({"absent": absent, "costs": costs, "write": write}[sys.argv[1]](where))


if __name__ == "__main__":
    main()
