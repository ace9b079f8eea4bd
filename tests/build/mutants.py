#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Would a test fail if a sign, a factor of 2 or a limit were wrong? Changes one operator or number of a source at a
time, builds, runs the unit tests of its room and the quick ones of all others, and lists what no test noticed. Not part of ./test:
some ten seconds for each change, two minutes where nothing notices.

    mutants.py [--count N] [--seed S] [--tests REGEX] [--jobs J] FILE ...
    mutants.py --rooms all|ROOM,ROOM ... --count N [--near] [--seed S] [--for SECONDS]

The second way draws over rooms: each by how many changes it has, and at least one of each room. --near builds and runs the unit
tests of the room alone, some seconds for each change: what they do not notice others may, so that its share is a lower bound.
At the end it prints how many of each room were noticed. --for: no change is begun behind so many seconds.

Works on a copy of the tree in build-mutants (kept; a second run starts at once). Changes: + and - exchanged, * and /
exchanged, a factor of 2 or 1/2 left out, a minus or fabs left out, fmax and fmin, < and >, && and || exchanged. Comments,
strings, tables of fitted numbers (a line of more than three) and lines that only print are left alone. What is not
noticed may be a change that changes nothing: look at each. Exit status 1: something was not noticed."""
import argparse
import collections
import pathlib
import random
import re
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
TREE, BUILD = ROOT / "build-mutants/tree", ROOT / "build-mutants/build"
CHANGES = [
    (re.compile(r"(?<=[\w)\]]) \+ (?=[\w(])"), " - ", "sign"),
    (re.compile(r"(?<=[\w)\]]) - (?=[\w(])"), " + ", "sign"),
    (re.compile(r"(?<=[=(,] )-(?=[\w(])"), "", "sign"),
    (re.compile(r"(?<=[\w)\]]) \* (?=[\w(])"), " / ", "factor"),
    (re.compile(r"(?<=[\w)\]]) / (?=[\w(])"), " * ", "factor"),
    (re.compile(r"\b0\.5 \* "), "", "factor 2"),
    (re.compile(r"\b2(\.0)? \* "), "", "factor 2"),
    (re.compile(r"\bfmax\("), "fmin(", "limit"),
    (re.compile(r"\bfmin\("), "fmax(", "limit"),
    (re.compile(r"\bfabs\("), "(", "sign"),
    (re.compile(r"(?<=[\w)\]]) < (?=[\w(])"), " > ", "limit"),
    (re.compile(r"(?<=[\w)\]]) > (?=[\w(])"), " < ", "limit"),
    (re.compile(r" && "), " || ", "condition"),
    (re.compile(r" \|\| "), " && ", "condition"),
]
SKIP = re.compile(r"printf|diag_|FW_NEED|FW_TRY|fw_arena|for \(|static const|^\s*(#|\*|/\*|\{|\")|sizeof|message")


def bare(text):
    """the same length, with comments and strings blanked"""
    def blank(match):
        return re.sub(r"[^\n]", " ", match.group())
    return re.sub(r'/\*.*?\*/|//[^\n]*|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\'', blank, text, flags=re.S)


def candidates(path):
    text = (TREE / path).read_text()
    clean, found, start = bare(text), [], 0
    for number, line in enumerate(clean.splitlines(keepends=True), 1):
        shown = text[start:start + len(line)]
        tables = len(re.findall(r"\d\.\d{3,}", line)) > 3
        if not SKIP.search(shown) and not tables:
            for pattern, by, kind in CHANGES:
                for match in pattern.finditer(line):
                    found.append((path, number, start + match.start(), start + match.end(), by, kind))
        start += len(line)
    return found


def quiet(*command, timeout=None):
    try:
        return subprocess.run(list(map(str, command)), capture_output=True, text=True, timeout=timeout, check=False)
    except subprocess.TimeoutExpired:
        return None


def prepare(rooms=None):
    """the tree as it is now, in TREE; what did not change keeps its time, so that little is built"""
    listed = quiet("git", "-C", ROOT, "ls-files", "-z").stdout.split("\0")
    for name in filter(None, listed):
        source, copy = ROOT / name, TREE / name
        if not source.is_file() or (copy.exists() and copy.read_bytes() == source.read_bytes()):
            continue
        copy.parent.mkdir(parents=True, exist_ok=True)
        copy.write_bytes(source.read_bytes())
        copy.chmod(source.stat().st_mode)
    subprocess.run(["cmake", "-S", str(TREE), "-B", str(BUILD), "-G", "Ninja", "-DFW_TESTS=ON", "-DFW_PAGE=OFF",
                    "-DCMAKE_BUILD_TYPE=Release"], check=True, stdout=subprocess.DEVNULL)
    targets = ["--target", *(f"unit_{room}" for room in rooms)] if rooms else []
    subprocess.run(["cmake", "--build", str(BUILD), *targets], check=True, stdout=subprocess.DEVNULL)


def rooms_of(asked):
    """rooms that have sources and unit tests: {room: files}"""
    found = {}
    for directory in sorted((ROOT / "src").iterdir()):
        if directory.is_dir() and (ROOT / "tests/unit" / directory.name).is_dir() and (asked == "all" or directory.name in asked.split(",")):
            found[directory.name] = sorted(f.relative_to(ROOT) for f in directory.glob("*.c"))
    return found


def draw(by_room, count, dice):
    """as many of each room as its share of all changes, and one at least; in an order that mixes the rooms"""
    total, chosen = sum(map(len, by_room.values())), []
    for room, changes in by_room.items():
        chosen += dice.sample(changes, min(len(changes), max(1, round(count * len(changes) / total))))
    dice.shuffle(chosen)
    return chosen


def verdict_near(change):
    """by the unit tests of its room alone"""
    path, _, begin, end, by, _ = change
    file, room = TREE / path, path.parts[1]
    text = file.read_text()
    try:
        file.write_text(text[:begin] + by + text[end:])
        if quiet("cmake", "--build", BUILD, "--target", f"unit_{room}").returncode:
            return "compiler"
        done = quiet("ctest", "--test-dir", BUILD, "-L", "quick|longer", "-R", rf"^unit\.{room}\.", "--stop-on-failure", "--timeout", 60, timeout=200)
        if done is None:
            return "time"
        failed = re.search(r"\d+ - (\S+) \(", done.stdout)
        return (failed.group(1) if failed else "a test") if done.returncode else None
    finally:
        file.write_text(text)


def verdict(change, tests, jobs):
    """noticed by: "compiler", a test's name, "time"; None: by nothing"""
    path, _, begin, end, by, _ = change
    file = TREE / path
    text = file.read_text()
    try:
        file.write_text(text[:begin] + by + text[end:])
        if quiet("cmake", "--build", BUILD).returncode:
            return "compiler"
        # all of its room first, where most end, then the quick ones of the others
        for label, which in ((".", rf"unit\.{path.parts[1]}\."), ("quick", tests)):
            done = quiet("ctest", "--test-dir", BUILD, "-L", label, "-R", which, "-j", jobs, "--stop-on-failure", "--timeout", 60,
                         timeout=400)
            if done is None:
                return "time"
            if done.returncode:
                failed = re.search(r"\d+ - (\S+) \(", done.stdout)
                return failed.group(1) if failed else "a test"
        return None
    finally:
        file.write_text(text)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--count", type=int, default=40)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--tests", default="unit|hard|docs")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--rooms")
    parser.add_argument("--near", action="store_true")
    parser.add_argument("--for", type=float, dest="limit_s", default=float("inf"))
    parser.add_argument("files", nargs="*")
    options = parser.parse_args()
    rooms, dice = rooms_of(options.rooms) if options.rooms else {}, random.Random(options.seed)
    prepare(rooms if options.near else None)
    by_room = {room: [c for f in files for c in candidates(f)] for room, files in rooms.items()}
    found = [c for f in options.files for c in candidates(pathlib.Path(f).resolve().relative_to(ROOT))]
    found += [c for changes in by_room.values() for c in changes]
    chosen = draw(by_room, options.count, dice) if rooms else dice.sample(found, min(options.count, len(found)))
    print(f"{len(chosen)} of {len(found)} changes", flush=True)
    left, tried, noticed, start = 0, collections.Counter(), collections.Counter(), time.monotonic()
    for change in chosen:
        if time.monotonic() - start > options.limit_s:
            break
        path, number, begin, end, by, kind = change
        text = (TREE / path).read_text()
        line = text[:begin].rsplit("\n", 1)[-1] + f"[{text[begin:end]}>{by}]" + text[end:].split("\n", 1)[0]
        by_whom = verdict_near(change) if options.near else verdict(change, options.tests, options.jobs)
        left += by_whom is None
        tried[path.parts[1]] += 1
        noticed[path.parts[1]] += by_whom is not None
        print(f"{'noticed by ' + by_whom if by_whom else 'NOT NOTICED'}: {path}:{number}: {kind}: {line.strip()}", flush=True)
    for room in sorted(tried, key=lambda r: noticed[r] / tried[r]):
        print(f"{room}: {noticed[room]} of {tried[room]}")
    print(f"{left} of {sum(tried.values())} not noticed")
    return 1 if left else 0


if __name__ == "__main__":
    sys.exit(main())
