#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Would a test fail if a sign, a factor of 2 or a limit were wrong? All changes of a sample are in one build, and a variable of the
environment switches each on; which test notices it? Not part of ./test.

    mutants_switched.py begin [--each N] [--seed S] [--rooms ROOM,ROOM]   draws N changes of each room and builds them into build-switched/
    mutants_switched.py begin FILE:FROM-TO ...        all changes of these lines in place of a sample
    mutants_switched.py ask REGEX [--for SECONDS] [--most SECONDS] asks the tests of this name of all that no test has noticed yet
    mutants_switched.py anew REGEX                    forgets what these tests, which were changed, passed and did not notice
    mutants_switched.py table                         how many of each room were noticed, with an interval of 95 %, and by which test
    mutants_switched.py left                          what no test has noticed, each with its line and how many tests passed it

The changes are those of mutants.py, and what they leave alone is left alone here. A function with changes is there once as it is and
once with each of them: `if (fw_switched(4)) {changed} else {as it is}`, in build-switched/src/. ./test's own build in build/ gives
everything else, so that what is compiled is some files and what is linked is the programs of the tests that are asked. A test runs once as
it is, and writes to a file that all its processes share which functions it passes: servers and workers that are killed count, too. Then it
runs with all changes that are left and that it passes switched on at once; where it fails, halves of them tell which it notices.
A test that takes many times its time has noticed. Everything is kept in build-switched/; --name NAME: in build-switched-NAME/."""
import argparse
import collections
import csv
import json
import math
import pathlib
import re
import shlex
import subprocess
import sys
import time
import tempfile
import random

import mutants
import mutants_ground as ground

ROOT = ground.ROOT
BUILD, GROUND = ROOT / "build", ROOT / "build-switched"
SWITCH = """/* which changes are switched on, and which functions with changes were passed, in a file that processes share */
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>
#include "switch.h"
static unsigned char none[FW_SWITCHES];
unsigned char *fw_switched_passed = none, fw_switched_on[FW_SWITCHES];
__attribute__((constructor)) static void switches(void) {
    const char *on = getenv("FW_SWITCH_ON"), *to = getenv("FW_SWITCH_TO");
    while (on && *on) {
        fw_switched_on[strtoul(on, NULL, 10)] = 1;
        on = strchr(on, ',');
        if (on) on++;
    }
    int file = to ? open(to, O_RDWR | O_CLOEXEC) : -1;
    if (file < 0) return;
    void *shared = mmap(NULL, FW_SWITCHES, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    if (shared != MAP_FAILED) fw_switched_passed = shared;
    close(file);
}
"""
HEADER = """extern unsigned char *fw_switched_passed, fw_switched_on[];
static inline int fw_switched(int i) { return fw_switched_passed[i] = 1, fw_switched_on[i]; }
"""


def kept(name):
    path = GROUND / name
    return json.loads(path.read_text()) if path.exists() else {}


def keep(name, what):
    (GROUND / name).write_text(json.dumps(what, indent=0))


def commands():
    """{file of src/: how it is compiled}; without what is compiled in more than one way"""
    found = collections.defaultdict(list)
    for entry in json.loads(ground.quiet("ninja", "-C", BUILD, "-t", "compdb")):
        path = pathlib.Path(entry["file"])
        if ROOT / "src" in path.parents and "WITHOUT" not in entry["command"]:
            words = shlex.split(entry["command"])
            words = words[words.index(next(w for w in words if w.endswith("/cc"))):]
            found[str(path.relative_to(ROOT))].append(words[:words.index("-MD")])
    return {path: how[0] for path, how in found.items() if len({tuple(h) for h in how}) == 1}


def body(text, begin):
    """(begin, end) of what stands between the braces of the function that a place is in, None outside of one"""
    end = text.find("\n}", begin)
    before = text.rfind("\n}", 0, begin)
    open_ = re.compile(r"\)\s*\{\n", re.S).search(text, max(before, 0), begin)
    if not open_ or text.find("\n}", begin) < 0 or re.search(r"^\s*\w+:\s*$", text[open_.end():end], re.M):
        return None
    return open_.end(), end + 1


def switched(text, changes):
    """the text with every change; changes: [(number, begin, end, by)]"""
    by_body = collections.defaultdict(list)
    for number, begin, end, by in changes:
        by_body[body(text, begin)].append((number, begin, end, by))
    for (first, last), those in sorted(by_body.items(), reverse=True):
        made = ""
        for number, begin, end, by in those:
            made += f"if (fw_switched({number})) {{\n{text[first:begin]}{by}{text[end:last]}}} else "
        text = text[:first] + made + "{\n" + text[first:last] + "}\n" + text[last:]
    return text


def refused(how, path, text):
    with tempfile.NamedTemporaryFile("w", suffix=".c", dir=GROUND) as file:
        file.write(text)
        file.flush()
        return subprocess.run([*how, "-iquote", str((ROOT / path).parent), "-fsyntax-only", file.name], capture_output=True, check=False).returncode != 0


def drawn(options):
    """a sample of each room, or all changes of the lines that are named"""
    dice = random.Random(options.seed)
    for place in options.what:
        path, _, lines = place.partition(":")
        first, _, last = lines.partition("-")
        yield [c for c in mutants.candidates(pathlib.Path(path)) if int(first) <= c[1] <= int(last or first)]
    for room in () if options.what else options.rooms.split(","):
        every = [c for f in sorted((ROOT / "src" / room).glob("*.c")) for c in mutants.candidates(f.relative_to(ROOT))]
        yield dice.sample(every, min(len(every), options.each))


def begin(options):
    (GROUND / "src").mkdir(parents=True, exist_ok=True)
    ground.TREE = mutants.TREE = ROOT
    how, changes, left_out = commands(), [], 0
    for those in drawn(options):
        for path, line, first, last, by, _ in those:
            text = (ROOT / path).read_text()
            if str(path) not in how or not body(text, first):
                left_out += 1  # a table outside of functions, a function with labels, a file that is compiled in several ways
                continue
            changes.append({"file": str(path), "line": line, "begin": first, "end": last, "by": by,
                            "change": mutants.marked((path, line, first, last, by, None)), "noticed": "", "asked": [], "passed": 0})
    print(f"{len(changes)} changes, {left_out} left out", flush=True)
    for c in changes:
        text = (ROOT / c["file"]).read_text()
        if refused(how[c["file"]], c["file"], text[:c["begin"]] + c["by"] + text[c["end"]:]):
            c["noticed"] = "compiler"
    (GROUND / "switch.h").write_text(HEADER + f"enum {{ FW_SWITCHES = {len(changes) + 1} }};\n")
    (GROUND / "switch.c").write_text(SWITCH)
    subprocess.run(["cc", "-O2", "-fPIC", "-c", GROUND / "switch.c", "-o", GROUND / "switch.o"], check=True)
    objects = [GROUND / "switch.o"]
    for path in sorted({c["file"] for c in changes}):
        these = [(n, c["begin"], c["end"], c["by"]) for n, c in enumerate(changes) if c["file"] == path and c["noticed"] != "compiler"]
        if not these:
            continue
        source = GROUND / path
        source.parent.mkdir(parents=True, exist_ok=True)
        source.write_text(switched((ROOT / path).read_text(), these))
        objects.append(source.with_suffix(".o"))
        subprocess.run([*how[path], "-w", "-Wno-error", "-iquote", (ROOT / path).parent, "-include", GROUND / "switch.h", "-c", source, "-o", objects[-1]],
                       check=True)
    (GROUND / "libswitched.a").unlink(missing_ok=True)
    subprocess.run(["ar", "rcs", GROUND / "libswitched.a", *objects], check=True)
    keep("changes.json", changes)
    keep("tests.json", {})


def linked(target):
    """the program of ./test's build with the changes in it"""
    to = GROUND / target
    if to.exists() and to.stat().st_mtime > max((GROUND / "libswitched.a").stat().st_mtime, (BUILD / target).stat().st_mtime):
        return
    to.parent.mkdir(exist_ok=True)
    command = ground.quiet("ninja", "-C", BUILD, "-t", "commands", target).splitlines()[-1]
    words = shlex.split(command.removeprefix(": && ").removesuffix(" && :"))
    words[words.index("-o") + 1] = str(to)
    first = next(i for i, w in enumerate(words) if w.startswith("libfw_"))
    subprocess.run([*words[:first], GROUND / "libswitched.a", *words[first:]], cwd=BUILD, check=True)


def tests(regex):
    """{name: (command, environment, directory)} with the programs that have the changes"""
    ground.TREE, ground.BUILD = ROOT, BUILD
    found = {}
    for name, (command, environment, directory) in ground.tests((GROUND / "ctest.json").read_text()).items():
        if not re.search(regex, name):
            continue
        if not found.get(name) and any(w == str(BUILD) or (w.startswith(str(BUILD) + "/") and not pathlib.Path(w).is_file()) for w in command):
            continue  # asks the whole build
        new = []
        for word in command:
            path = pathlib.Path(word)
            if BUILD in path.parents and path.is_file() and "." not in path.name:
                linked(str(path.relative_to(BUILD)))
                word = str(GROUND / path.relative_to(BUILD))
            new.append(word)
        if BUILD in (place := pathlib.Path(directory)).parents:  # what it writes goes where it may
            place = GROUND / place.relative_to(BUILD)
            place.mkdir(parents=True, exist_ok=True)
        found[name] = (new, environment, str(place))
    return found


def passes(name, what, count):
    """(status, seconds, numbers of the changes whose functions it passes)"""
    with tempfile.NamedTemporaryFile(dir=GROUND / "work") as file:
        file.write(bytes(count + 1))
        file.flush()
        status, seconds = ground.run(what, 300, FW_SWITCH_TO=file.name)
        file.seek(0)
        return status, seconds, [n for n, byte in enumerate(file.read()) if byte]


def layers(changes, numbers):
    """of each function one change at a time: of two that are switched on, only the first is there"""
    of, found = collections.Counter(), collections.defaultdict(list)
    for n in numbers:
        c = changes[n]
        place = c["file"], body((ROOT / c["file"]).read_text(), c["begin"])
        found[of[place]].append(n)
        of[place] += 1
    return found.values()


def culprits(what, within_s, numbers):
    """{number: "" or "time of "} of those that the test notices, all at once first, then halves"""
    status, _ = ground.run(what, within_s, FW_SWITCH_ON=",".join(map(str, numbers)))
    if status == 0:
        return {}
    if len(numbers) == 1:
        return {numbers[0]: "time of " if status == "time" else ""}
    half = len(numbers) // 2
    return culprits(what, within_s, numbers[:half]) | culprits(what, within_s, numbers[half:])


def ask(options):
    (GROUND / "work").mkdir(exist_ok=True)
    ground.WORK = GROUND / "work"
    changes, known, until = kept("changes.json"), kept("tests.json"), time.monotonic() + options.limit_s
    every = tests("|".join(options.what) or ".")
    other = ROOT / f"build-switched-{options.like}/tests.json"
    times = {n: t["seconds"] for n, t in ((json.loads(other.read_text()) if options.like else {}) | known).items()}
    for name in sorted(every, key=lambda n: times.get(n, 1)):
        what = every[name]
        if time.monotonic() > until:
            break
        if times.get(name, 0) > options.most_s:
            continue
        if name not in known:
            status, seconds, passed = passes(name, what, len(changes))
            known[name] = {"status": status, "seconds": round(seconds, 3), "passed": passed}
            keep("tests.json", known)
        test = known[name]
        if test["seconds"] > options.most_s:
            continue
        those = [n for n in test["passed"] if not changes[n]["noticed"] and name not in changes[n]["asked"]]
        if test["status"] != 0 or not those:
            if test["status"] != 0:
                print(f"{name} fails without a change", flush=True)
            continue
        random.Random(name).shuffle(those)
        found = {}
        for layer in layers(changes, those):
            found |= culprits(what, 2 + 5 * test["seconds"], layer)
        for n in those:
            changes[n]["asked"].append(name)
        for n, how_so in found.items():
            changes[n]["noticed"] = how_so + name
        if found:
            print(f"{name} ({test['seconds']} s): {len(found)} of {len(those)}", flush=True)
        keep("changes.json", changes)


def anew(options):
    changes, known, regex = kept("changes.json"), kept("tests.json"), "|".join(options.what) or "."
    for c in changes:
        c["asked"] = [n for n in c["asked"] if not re.search(regex, n)]
    keep("changes.json", changes)
    keep("tests.json", {n: t for n, t in known.items() if not re.search(regex, n)})


def table(_):
    equal, count, by = mutants.known_equal(), collections.defaultdict(collections.Counter), collections.Counter()
    for c in kept("changes.json"):
        what = ("refused" if c["noticed"] == "compiler" else "noticed" if c["noticed"] else
                "equal" if (c["file"], c["change"]) in equal else "left" if c["asked"] else "not passed")
        for key in (c["file"].split("/")[1], "all"):
            count[key][what] += 1
        if what == "noticed":
            by[c["noticed"].removeprefix("time of ").split(":")[0]] += 1
    print(f"{'room':12} {'tried':>5} {'noticed':>7} {'left':>4} {'not passed':>10} {'equal':>5} {'refused':>7}  share, 95 %")
    for room in [*sorted(r for r in count if r != "all"), "all"]:
        c = count[room]
        of = c["noticed"] + c["left"] + c["not passed"]
        low, high = mutants.interval(c["noticed"], of)
        print(f"{room:12} {of + c['equal'] + c['refused']:5} {c['noticed']:7} {c['left']:4} {c['not passed']:10} {c['equal']:5} {c['refused']:7}  "
              f"{100 * c['noticed'] / max(of, 1):.0f} % ({100 * low:.0f} to {100 * high:.0f})")
    print("by " + ", ".join(f"{name} {n}" for name, n in by.most_common()))


def left(_):
    equal = mutants.known_equal()
    for n, c in enumerate(kept("changes.json")):
        if not c["noticed"] and (c["file"], c["change"]) not in equal:
            print(f"{n} {c['file']}:{c['line']}: {c['change']} ({len(c['asked'])} tests)")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("do", choices=("begin", "ask", "anew", "table", "left"))
    parser.add_argument("what", nargs="*")
    parser.add_argument("--name")
    parser.add_argument("--each", type=int, default=12)
    parser.add_argument("--seed", type=int, default=271)
    parser.add_argument("--rooms", default=",".join(sorted(d.name for d in (ROOT / "src").iterdir() if d.is_dir())), help="all by themselves")
    parser.add_argument("--for", type=float, dest="limit_s", default=math.inf)
    parser.add_argument("--most", type=float, dest="most_s", default=math.inf, help="leaves out tests that take longer than these seconds")
    parser.add_argument("--like", help="the name of another sample, whose tests' times are taken before they are known here")
    options = parser.parse_intermixed_args()
    global GROUND
    GROUND = ROOT / f"build-switched-{options.name}" if options.name else GROUND
    if options.do == "ask" and not ground.isolated():
        ground.GROUND, ground.BUILD = GROUND, BUILD
        (GROUND / "ctest.json").write_text(ground.listed())  # which writes into the build
        ground.isolate()
    globals()[options.do](options)


if __name__ == "__main__":
    main()
