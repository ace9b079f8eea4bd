#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Would a test fail if a sign, a factor of 2 or a limit were wrong? One operator or number of src/ is changed at a time; which test
notices it? Not part of ./test.

    mutants.py try [--count N] [--seed S] [--rooms ROOM,ROOM] [--each SECONDS] [--for SECONDS] [FILE ...]
    mutants.py together [--seed S] [--group N] [--for SECONDS]
    mutants.py table [--seed S]    how many of each room were noticed, with an interval of 95 %, and by which kind of test
    mutants.py left [--seed S]     what no test noticed, each with its line
    mutants.py measure REGEX       which lines the tests of this name pass, where that is not known yet
    mutants.py anew REGEX          the same once more, of tests that were changed; what was left is then asked of them again

try draws N changes over the rooms, each by how many it has and one at least, in an order that mixes them, so that what was tried so
far is a sample, too. A change meets the tests that pass its line (then its function), one case of a program at a time: first those that
notice much for their time. It ends with the first that fails, or takes many times its time. --each: the seconds of tests that it meets
at most; a later run with more goes on where this one ended. together asks every other test of what is left, of N changes of different
files in one program: where a test fails, halves of them tell which it notices. Everything is kept in build-mutants/: what was tried in changes-SEED.csv,
to which the next run adds. Only tests whose lines are measured are asked: `measure unit` before the first run.

Changes: + and - exchanged, * and / exchanged, a factor of 2 or 1/2 left out, a minus or fabs left out, fmax and fmin, < and >, && and ||
exchanged. Comments, strings, tables of fitted numbers (a line of more than three) and lines that only print are left alone. What
changes nothing that anyone could see is in mutants-equal.txt with its reason, and counts neither way."""
import argparse
import collections
import csv
import json
import math
import pathlib
import random
import re
import sys
import time

import mutants_ground as ground
from mutants_ground import GROUND, MAP, ROOT, TREE

EQUAL = ROOT / "tests/build/mutants-equal.txt"
FIELDS = "number file line change noticed seconds passed asked".split()
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


def marked(change):
    """the line of a change as it stands in lists: what is there and what comes in its place in brackets"""
    path, _, begin, end, by, _ = change
    text = (TREE / path).read_text()
    return (text[:begin].rsplit("\n", 1)[-1] + f"[{text[begin:end]}>{by}]" + text[end:].split("\n", 1)[0]).strip()


def draw(by_room, count, dice):
    """as many of each room as its share of all changes, and one at least; in an order that mixes the rooms"""
    total, chosen = sum(map(len, by_room.values())), []
    for changes in by_room.values():
        chosen += dice.sample(changes, min(len(changes), max(1, round(count * len(changes) / total))))
    dice.shuffle(chosen)
    return chosen


def sample(options):
    files = [pathlib.Path(f).resolve().relative_to(ROOT) for f in options.files] or \
        sorted(f.relative_to(TREE) for f in (TREE / "src").glob("*/*.c") if not options.rooms or f.parent.name in options.rooms.split(","))
    by_room = {}
    for file in files:
        by_room.setdefault(file.parts[1], []).extend(candidates(file))
    return draw(by_room, options.count, random.Random(options.seed)), sum(map(len, by_room.values()))


def kept(options):
    return GROUND / f"changes-{options.seed}.csv"


def rows(options):
    """{number: the last row of it}"""
    if not kept(options).exists():
        return {}
    with open(kept(options), newline="") as file:
        return {int(r["number"]): r for r in csv.DictReader(file, FIELDS)}


def known_equal():
    """{(file, marked line)} of mutants-equal.txt: FILE: MARKED LINE, and below it, indented, why"""
    found = set()
    for row in EQUAL.read_text().splitlines() if EQUAL.exists() else ():
        if row.startswith("src/"):
            found.add(tuple(row.split(": ", 1)))
    return found


class Order:
    """Which test next: the one that notices most for its time. How often it has noticed something is counted, with a guess before
    anything is: a test of the room itself and bytes of the gallery notice more than others."""

    def __init__(self, passed):
        self.passed, self.kept = passed, MAP / "notices.json"
        self.count = json.loads(self.kept.read_text()) if self.kept.exists() else {}
        # tests that were not measured may pass anything: many changes at once are asked of them, too
        self.others = set(passed.every) - set(ground.measured()) - {n for n, c in self.count.items() if c[0] < 0}

    def cost(self, name, room, near):
        asked, noticed = map(max, self.count.get(name, (0, 0)), (0, 0))
        guess = (0.35 if name.startswith(f"unit.{room}.") else 0.3 if name.startswith("golden") else 0.1) * (1 if near else 0.1)
        return (self.passed.seconds[name] + 0.02) / ((noticed + 3 * guess) / (asked + 3))

    def usable(self, name):
        """its seconds without a change, None where it does not pass; that one is not asked again"""
        ground.empty()
        status, seconds = ground.run(self.passed.every[name], 300)
        if status == 0:
            return seconds
        self.count[name] = (-1, 0)
        self.others.discard(name)
        return None

    def of(self, path, number):
        near, anywhere = self.passed.of(path, number)
        return sorted(anywhere, key=lambda n: self.cost(n, path.parts[1], n in near)), near

    def saw(self, name, noticed):
        asked, so_far = self.count.get(name, (0, 0))
        self.count[name] = (asked + 1, so_far + noticed)


def judged(change, order, how, each_s, asked):
    """(noticed by "compiler", a test, "time of" a test or "", how many tests pass it, names asked); asked: names that need not be again"""
    path, number, begin, end, by, _ = change
    text = (TREE / path).read_text()
    objects = ground.compiled(path, text[:begin] + by + text[end:], how, "changed")
    if not objects:
        return "compiler", 0, []
    ground.replace(objects)
    names, near = order.of(path, number)
    asked, left = set(asked), each_s
    for name in names:
        normal = order.passed.seconds[name]
        if name in asked:
            left -= normal
            continue
        if left < normal and left < each_s:
            continue  # the first is always asked, of later ones those for which there is time
        left -= normal
        status, _ = ground.run(order.passed.what[name], 2 + 5 * normal)
        asked.add(name)
        if name in near:
            order.saw(name, status != 0)
        if status != 0:
            return ("time of " if status == "time" else "") + name, len(names), []
    return "", len(names), sorted(asked)


def attempt(options):
    order, how = Order(ground.Passed()), ground.commands()
    chosen, of = sample(options)
    before, equal, until = rows(options), known_equal(), time.monotonic() + options.limit_s
    print(f"{len(chosen)} of {of} changes, {len(order.passed.seconds)} tests", flush=True)
    with open(kept(options), "a", newline="") as file:
        out = csv.DictWriter(file, FIELDS)
        for number, change in enumerate(chosen):
            path, line, *_ = change
            row = before.get(number)
            if row and (row["file"], row["change"]) != (str(path), marked(change)):
                sys.exit(f"{kept(options)} is of another tree: number {number}")
            if row and (row["noticed"] or (str(path), marked(change)) in equal):
                continue
            if options.again is False and row:
                continue
            if time.monotonic() > until:
                break
            begin = time.monotonic()
            former = row["asked"].split() if row else []
            by_whom, passed, asked = judged(change, order, how[str(path)], options.each, former)
            if by_whom or asked != former or not row:
                out.writerow({"number": number, "file": path, "line": line, "change": marked(change), "noticed": by_whom,
                              "seconds": round(time.monotonic() - begin, 2), "passed": passed, "asked": " ".join(asked)})
                file.flush()
                if not by_whom:
                    print(f"left: {path}:{line}: {marked(change)} ({len(asked)} of {passed} tests)", flush=True)
            order.kept.write_text(json.dumps(order.count))
    ground.empty()


def culprits(name, what, within_s, objects):
    """which of several changes the test notices: all at once first, then halves. {number: "" or "time of "}"""
    ground.replace([o for made in objects.values() for o in made])
    status, _ = ground.run(what, within_s)
    if status == 0:
        return {}
    if len(objects) == 1:
        return {n: "time of " if status == "time" else "" for n in objects}
    numbers, found = list(objects), {}
    for half in (numbers[:len(numbers) // 2], numbers[len(numbers) // 2:]):
        found |= culprits(name, what, within_s, {n: objects[n] for n in half})
    return found


def gather(options, chosen, before, equal, how):
    """what is left, one change of a file at most, and those first that fewest tests were asked of: {number: objects}"""
    files, group = set(), {}
    for number in sorted(before, key=lambda n: (len(before[n]["asked"]), n)):
        row, (path, _, begin, end, by, _) = before[number], chosen[number]
        if row["noticed"] or (row["file"], row["change"]) in equal or path in files or len(group) == options.group:
            continue
        text = (TREE / path).read_text()
        made = ground.compiled(path, text[:begin] + by + text[end:], how[str(path)], f"change{number}")
        if made:
            files.add(path)
            group[number] = made
    return group


def together(options):
    """asks the tests that were not asked yet of what is left, many changes of different files in one program: most tests notice none
    of them, and then all have their answer at once"""
    order, how, until = Order(ground.Passed()), ground.commands(), time.monotonic() + options.limit_s
    chosen, equal = sample(options)[0], known_equal()
    while time.monotonic() < until:
        before = rows(options)
        group = gather(options, chosen, before, equal, how)
        reach = {n: order.of(chosen[n][0], chosen[n][1]) for n in group}
        asked = {n: set(before[n]["asked"].split()) for n in group}
        alive, first, asks = dict(group), time.monotonic(), 0
        hope = collections.Counter()  # how much a test may notice for its time
        for n, (names, near) in reach.items():
            for name in set(names) - asked[n]:
                hope[name] += 1 / order.cost(name, chosen[n][0].parts[1], name in near)
            for name in order.others - asked[n]:
                hope[name] += 0.002 if ":" in name else 0.0005  # what takes how long is not known: cases of a script before whole ones
        if not hope:
            break
        print(f"{len(group)} changes together, {len(hope)} tests", flush=True)
        with open(kept(options), "a", newline="") as file:
            out = csv.DictWriter(file, FIELDS)

            def keep(n, by_whom):
                out.writerow({**before[n], "noticed": by_whom, "passed": len(reach[n][0]), "asked": "" if by_whom else " ".join(sorted(asked[n])),
                              "seconds": round(float(before[n]["seconds"]) + (time.monotonic() - first) / len(group), 2)})
                file.flush()

            for name, _ in hope.most_common(options.most):
                now = {n: made for n, made in alive.items() if (name in reach[n][0] or name in order.others) and name not in asked[n]}
                if not now or time.monotonic() > until:
                    continue
                found = culprits(name, order.passed.every[name], 2 + 5 * order.passed.seconds.get(name, 3), now)
                if found and name in order.others:
                    normal = order.usable(name)
                    if normal is None:
                        continue
                    if normal > 3:  # the limit above was of a shorter test
                        found = culprits(name, order.passed.every[name], 2 + 5 * normal, now)
                for n in now:
                    asked[n].add(name)
                    if name in reach[n][1]:
                        order.saw(name, n in found)
                for n, how_so in found.items():
                    keep(n, how_so + name)
                    del alive[n]
                asks += 1
                if asks % 10 == 0:
                    for n in alive:
                        keep(n, "")
            for n in alive:
                keep(n, "")
        order.kept.write_text(json.dumps(order.count))
    ground.empty()


def interval(noticed, of):
    """Wilson's, of 95 %"""
    if not of:
        return 0.0, 1.0
    z, p = 1.96, noticed / of
    middle, half = p + z * z / (2 * of), z * math.sqrt(p * (1 - p) / of + z * z / (4 * of * of))
    return (middle - half) / (1 + z * z / of), (middle + half) / (1 + z * z / of)


def table(options):
    equal, count = known_equal(), collections.defaultdict(collections.Counter)
    for row in rows(options).values():
        room = row["file"].split("/")[1]
        what = ("refused" if row["noticed"] == "compiler" else "noticed" if row["noticed"] else
                "equal" if (row["file"], row["change"]) in equal else "left" if int(row["passed"]) else "not passed")
        for key in (room, "all"):
            count[key][what] += 1
            if what == "noticed":
                count[key][row["noticed"].removeprefix("time of ").split(".")[0]] += 1
    print(f"{'room':12} {'tried':>5} {'noticed':>7} {'left':>4} {'not passed':>10} {'equal':>5} {'refused':>7}  share, 95 %")
    for room in [*sorted(r for r in count if r != "all"), "all"]:
        c = count[room]
        of = c["noticed"] + c["left"] + c["not passed"]
        low, high = interval(c["noticed"], of)
        tried = of + c["equal"] + c["refused"]
        print(f"{room:12} {tried:5} {c['noticed']:7} {c['left']:4} {c['not passed']:10} {c['equal']:5} {c['refused']:7}  "
              f"{100 * c['noticed'] / max(of, 1):.1f} % ({100 * low:.0f} to {100 * high:.0f})")
    kinds = [k for k in count["all"] if k not in ("refused", "noticed", "equal", "left", "not passed")]
    print("by " + ", ".join(f"{k} {count['all'][k]}" for k in sorted(kinds, key=lambda k: -count["all"][k])))
    return 0


def left(options):
    equal = known_equal()
    for number, row in sorted(rows(options).items(), key=lambda r: (r[1]["file"], int(r[1]["line"]))):
        if not row["noticed"] and (row["file"], row["change"]) not in equal:
            print(f"{number} {row['file']}:{row['line']}: {row['change']} ({len(row['asked'].split())} of {row['passed']})")
    return 0


def anew(options):
    """forgets what these tests passed, and that what is left was asked of them"""
    regex = re.compile(options.files[0])
    measured = MAP / "cases.jsonl"
    measured.write_text("".join(r + "\n" for r in measured.read_text().splitlines() if not regex.search(json.loads(r)["name"])))
    for file in GROUND.glob("changes-*.csv"):
        with open(file, newline="") as text:
            everything = list(csv.DictReader(text, FIELDS))
        with open(file, "w", newline="") as to:
            out = csv.DictWriter(to, FIELDS)
            for row in everything:
                row["asked"] = " ".join(n for n in row["asked"].split() if not regex.search(n))
                out.writerow(row)
    ground.chart(options.files[0], math.inf)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("try", "together", "table", "left", "measure", "anew"))
    parser.add_argument("--count", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=26)
    parser.add_argument("--rooms")
    parser.add_argument("--each", type=float, default=20)
    parser.add_argument("--most", type=int, help="tests that a group is asked at a time")
    parser.add_argument("--group", type=int, default=16)
    parser.add_argument("--new", dest="again", action="store_false", help="only what was not tried yet")
    parser.add_argument("--for", type=float, dest="limit_s", default=math.inf)
    parser.add_argument("files", nargs="*")
    options = parser.parse_args()
    if options.what in ("table", "left"):
        return {"table": table, "left": left}[options.what](options)
    if not ground.isolated():
        ground.prepare(options.what == "anew")
        ground.isolate()
    if options.what == "measure":
        ground.chart((options.files or ["."])[0], time.monotonic() + options.limit_s)
    elif options.what == "anew":
        anew(options)
    elif options.what == "together":
        together(options)
    else:
        attempt(options)
    return 0


if __name__ == "__main__":
    sys.exit(main())
