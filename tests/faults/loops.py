#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every call of a command failed in turn: the n-th allocation, open, write, short write or read, fsync, rename, read,
close, mmap, fork, socket, opendir, mkdir and stat, with each error that Linux documents for it, once and from then on.

    loops.py PROGRAM PRELOAD [--seed N] [--most N] [--runs N] [--case NAME ...] [--kind NAME ...] [--all] [--kill] [--trace]
             [--json FILE]

Of each command (cases.py) and kind the calls are counted, then n is drawn by the seed, at most --most of them; --all
takes every n, every error, and both `once` and `from then on`. What must hold in each run:

  * the exit status is that without the fault, or 6 for memory, or 5 for files; never a crash, never a hang;
  * where it is that without the fault, standard output and every file are the same to the byte;
  * where it is not, the files are those of before, to the byte, and no other is there; where the error stays (a full
    disk does not let go of what a run began), what is left has the name of a leftover and the next run sweeps it;
  * a message says what could not be done, to what file and why.

With --kill the program is killed (SIGKILL) before the n-th call instead: every file is then the old one or the new one,
of a directory with a manifest all of them the one or all the other; what else is there has the name of a leftover, and the
next run gives what it always gives and sweeps it.
"""
import argparse
import collections
import concurrent.futures
import errno
import json
import os
import pathlib
import random
import re
import signal
import subprocess
import sys
import tempfile

from cases import CASES, Case, Room, without_times

ERRORS = {
    "memory": ["ENOMEM"],
    "pictures": ["ENOMEM"],  # only where it is asked for: preload.c says why
    "open": ["EACCES", "EMFILE", "EIO", "EINTR", "ENOSPC", "EDQUOT", "ENFILE", "EROFS"],
    "write": ["ENOSPC", "EIO", "EDQUOT", "EINTR", "EFBIG"],
    "short": ["ENOSPC"],
    "fsync": ["EIO", "ENOSPC", "EDQUOT"],
    "rename": ["ENOSPC", "EACCES", "EIO", "EDQUOT"],
    "read": ["EIO", "EINTR"],
    "close": ["EIO", "EINTR", "ENOSPC", "EDQUOT"],
    "mmap": ["ENOMEM", "EAGAIN"],
    "fork": ["EAGAIN", "ENOMEM"],
    "socket": ["EMFILE", "ENOBUFS", "EACCES", "EADDRINUSE"],
    "opendir": ["EMFILE", "EACCES", "EIO"],
    "unlink": ["EACCES", "EIO"],
    "mkdir": ["ENOSPC", "EACCES", "EDQUOT"],
    "stat": ["EACCES", "EIO"],
}
MEMORY = ("memory", "pictures")
SECONDS = 120  # far above what any of these commands takes: beyond is a hang
LEFTOVER = re.compile(r"\.tmp-\d+(-old|-journal)?$")


class Program:
    def __init__(self, program, preload):
        self.program, self.preload = program, preload

    def run(self, case, room, fault=None, trace=False):
        """status (negative: signal; None: hang), standard output, messages, counts of calls"""
        report = room.path.parent / (room.path.name + ".count")
        environment = {**os.environ, **case.environment, "OPENBLAS_NUM_THREADS": "1", "NO_COLOR": "1"}
        if fault:
            environment |= {"LD_PRELOAD": str(self.preload), "FW_FAULT_REPORT": str(report), **fault}
        if trace:
            environment["FW_FAULT_TRACE"] = "1"
        with subprocess.Popen([self.program, *case.arguments(room)], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, env=environment, cwd=room.path) as process:
            try:
                out, messages = process.communicate(timeout=SECONDS)
            except subprocess.TimeoutExpired:
                process.kill()
                process.communicate()
                return None, b"", "", {}
        counts = dict(line.split() for line in report.read_text().splitlines()) if report.exists() else {}
        report.unlink(missing_ok=True)
        return process.returncode, without_times(out), messages.decode(errors="replace"), counts


class Loop:
    """one command: what it gives without a fault, and what it gives with one"""

    def __init__(self, program, case, here):
        self.program, self.case, self.here = program, case, here
        self.first = case.prepare(program, here / case.name)
        room = Room(self.first, here / (case.name + "-clean"))
        self.status, self.out, self.said, counts = program.run(case, room, {"FW_FAULT_KIND": "none"})
        self.counts = {kind: int(n) for kind, n in counts.items()}
        self.before, self.after = self.first.state(), room.state()
        if self.status != case.status:
            raise SystemExit(f"{case.name}: without a fault the status is {self.status}: {self.said}")
        room.remove()

    def wrong(self, kind, error, ever, result, room):
        """what is wrong with what a run gave, or None"""
        status, out, said, _ = result
        if status is None:
            return f"did not end within {SECONDS} s"
        if status < 0:
            return f"ended by {signal.Signals(-status).name}"
        state = room.state()
        if status == self.status:
            if out != self.out:
                return "status as without the fault, another result on standard output"
            state = self.swept(kind, ever, state)
            return None if state == self.after else "status as without the fault, other files: " + differ(self.after, state)
        if status != (6 if kind in MEMORY else 5):
            return f"status {status}: {brief(said)}"
        reason = "out of memory" if kind in MEMORY else os.strerror(getattr(errno, error))
        if kind in MEMORY and reason not in said or kind not in MEMORY and not re.search(r"error: .*\S", said):
            return f"status {status} without a reason: {brief(said)!r}"
        # SQLite has another try where a file cannot be opened, and its last reason is of that; of other calls it keeps none
        sqlite = "disk I/O error" in said or "could not be removed" in said or not ever and re.search("unable to open database file|readonly database", said)
        if kind not in (*MEMORY, "short") and reason not in said and "[FW-D2" not in said and not sqlite:
            return f"does not say {reason!r}: {brief(said)!r}"
        state = self.swept(kind, ever, state)
        if "could not be taken back" in said or "could not be taken away" in said:
            return None if ever else "an error that came once was not made up for"
        if state == self.before or state == self.after and "standard output" in said:
            return None
        if self.case.resumes and "could not be removed" in said:
            return None
        if self.case.resumes:
            return self.not_resumed(room)
        return "files are not those of before: " + differ(self.before, state)

    def not_resumed(self, room):
        """of a study that is kept as far as it came: nothing beside its store is of another one, and it goes on to its end"""
        others = {n: h for n, h in room.state().items() if not n.startswith("out/study.sqlite")}
        for name, digest in others.items():
            if digest != self.after.get(name):
                return f"{name} is of another study, or torn"
        resumed = Case(self.case.name, [*self.case.command, "--resume"])
        status, _, said, _ = self.program.run(resumed, room)
        if status != self.status:
            return f"does not go on: status {status}: {brief(said)}"
        return None if room.state() == self.after else "went on to something else: " + differ(self.after, room.state())

    def swept(self, kind, ever, state):
        """where the error stays, or hits the removal itself, leftovers are allowed that the next run sweeps: without them"""
        if kind in MEMORY:
            return state
        return {n: h for n, h in state.items() if not LEFTOVER.search(n.split("/")[0]) and not LEFTOVER.search(n)}

    def killed(self, kind, n):
        """what is wrong after a kill before the n-th call, or None"""
        room = Room(self.first, self.here / f"{self.case.name}-kill-{kind}-{n}")
        fault = {"FW_FAULT_KIND": kind, "FW_FAULT_AT": str(n), "FW_FAULT_KILL": "1"}
        result = self.program.run(self.case, room, fault)
        state = {f: h for f, h in room.state().items() if not any(LEFTOVER.search(part) for part in f.split("/"))}
        what = None
        whole = any(f.endswith("manifest.json") for f in self.after)
        if result[0] != -signal.SIGKILL:
            what = f"was not killed: {result[0]}"
        elif whole and state not in (self.before, self.after):
            what = "neither the earlier nor the new: " + differ(self.before, state)
        elif self.case.resumes and any(h not in (self.before.get(f), self.after.get(f)) for f, h in state.items()
                                       if not f.startswith("out/study.sqlite")):
            what = "torn: " + differ(self.before, state)
        elif not self.case.resumes and (any(h not in (self.before.get(f), self.after.get(f)) for f, h in state.items())
                                        or set(self.before) - set(state)):
            what = "torn: " + differ(self.before, state)
        else:
            status, out, said, _ = self.program.run(self.case, room)
            if (status, out) != (self.status, self.out) and not self.case.grows:
                what = f"the next run: status {status}: {brief(said)}"
            elif self.case.grows and status != self.status:
                what = f"the next run: status {status}: {brief(said)}"
            elif room.state() != self.after and not self.case.grows:
                what = "the next run leaves: " + differ(self.after, room.state())
        room.remove()
        return what, result

    def try_one(self, kind, n, error, ever, trace=False):
        fault = {"FW_FAULT_KIND": kind, "FW_FAULT_AT": str(n), "FW_FAULT_EVER": str(int(ever)),
                 "FW_FAULT_ERRNO": str(getattr(errno, error))}
        room = Room(self.first, self.here / f"{self.case.name}-{kind}-{n}-{error}-{int(ever)}")
        result = self.program.run(self.case, room, fault, trace)
        what = self.wrong(kind, error, ever, result, room)
        if not what and room.leftovers(LEFTOVER):
            self.program.run(self.case, room)
            if room.leftovers(LEFTOVER):
                what = f"the next run does not sweep {room.leftovers(LEFTOVER)}"
        room.remove()
        return what, result


def brief(said):
    """what it says of errors, or its end"""
    return " / ".join(line for line in said.splitlines() if "error:" in line)[:300] or said.strip()[-200:]


def differ(wanted, found):
    names = [f"{n} {'is missing' if n not in found else 'is new' if n not in wanted else 'differs'}"
             for n in sorted(set(wanted) | set(found)) if wanted.get(n) != found.get(n)]
    return ", ".join(names[:4]) + (f" and {len(names) - 4} more" if len(names) > 4 else "")


def draw(kind, count, most, rng, everything):
    """(n, error, ever) to be tried"""
    points = range(1, count + 1)
    if everything:
        return [(n, e, ever) for n in points for e in ERRORS[kind] for ever in (False, True)
                if not (ever and e == "EINTR")]
    if count > most:
        points = sorted(rng.sample(points, most))
    drawn = [(n, rng.choice(ERRORS[kind]), rng.random() < 0.5) for n in points]
    return [(n, e, ever and e != "EINTR") for n, e, ever in drawn]  # interrupted again and again is no error of any file


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("preload", type=pathlib.Path)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--most", type=int, default=6, help="points of each command and kind")
    parser.add_argument("--runs", type=int, help="of these, at most so many of each command")
    parser.add_argument("--case", nargs="*")
    parser.add_argument("--kind", nargs="*")
    parser.add_argument("--all", action="store_true")
    parser.add_argument("--kill", action="store_true")
    parser.add_argument("--trace", action="store_true", help="for what is wrong, who called")
    parser.add_argument("--at", type=int, help="only this n")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--json", type=pathlib.Path)
    o = parser.parse_args()
    program = Program(o.program.resolve(), o.preload.resolve())
    counts, bad = collections.Counter(), []
    points = {}
    with tempfile.TemporaryDirectory() as here, concurrent.futures.ThreadPoolExecutor(o.jobs) as pool:
        for case in CASES:
            if o.case and case.name not in o.case:
                continue
            loop = Loop(program, case, pathlib.Path(here))
            rng = random.Random(f"{o.seed} {case.name}")
            tried = []
            for kind in o.kind or [k for k in ERRORS if k != "pictures"]:
                if kind in case.without:
                    continue
                count = loop.counts[kind]
                points[case.name, kind] = count
                tried += [(kind, *d) for d in draw(kind, count, o.most, rng, o.all) if o.at is None or d[0] == o.at]

            def attempt(one):
                return loop.killed(one[0], one[1]) if o.kill else loop.try_one(*one, trace=o.trace)

            if o.runs and len(tried) > o.runs:
                tried = sorted(rng.sample(tried, o.runs))
            if o.kill:
                tried = sorted({(kind, n, "KILL", False) for kind, n, _, _ in tried})
            for one, (what, result) in zip(tried, pool.map(attempt, tried)):
                kind, n, error, ever = one
                counts[kind] += 1
                if what:
                    bad.append((case.name, *one, what))
                    print(f"{case.name}: {kind} {n} of {points[case.name, kind]}, {error}{' and all later' if ever else ''}: "
                          f"{what}", flush=True)
                    if o.trace:
                        print(result[2][-6000:], flush=True)
            print(f"{case.name}: {len(tried)} runs, {sum(b[0] == case.name for b in bad)} wrong", flush=True)
    print("runs by kind: " + ", ".join(f"{k} {n}" for k, n in counts.items()))
    print(f"{sum(counts.values())} runs, {len(bad)} wrong")
    if o.json:
        o.json.write_text(json.dumps({"points": {f"{c} {k}": n for (c, k), n in points.items()}, "runs": counts,
                                      "wrong": bad}, indent=1) + "\n")
    return bool(bad)


if __name__ == "__main__":
    sys.exit(main())
