#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Ten million files of strangers, under AddressSanitizer and UndefinedBehaviorSanitizer, guided by what they reach.

    fuzz_long.py [--count 10000000] [--kind NAME ...] [--minutes N] [--again]

Builds tests/fuzz/fuzz_files in build-fuzz (clang, FW_FUZZ_LONG: every room that reads guides the fuzzer), then runs it one kind at a time,
each its share of --count by WEIGHTS, in pieces of a minute or so. What was done is kept in build-fuzz/fuzz with the inputs that were
found, and the next call goes on from there (--again: from nothing). Prints a table of kinds; ends with 1 where one input crashed,
leaked, took 20 s or 1 GiB, or was wrong as fuzz_files.c says: it is kept as build-fuzz/fuzz/found-*.

coverage.py --run "tests/fuzz/fuzzed_files inputs $PWD/build-fuzz/fuzz/*" says which lines of which rooms that reached. Not part of ./test,
which has a short run of the same (fuzz.files, fuzz.device)."""
import argparse
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD, PLACE = ROOT / "build-fuzz", ROOT / "build-fuzz/fuzz"
CONFIGURE = ["cmake", "-S", ROOT, "-B", BUILD, "-G", "Ninja", "-DCMAKE_C_COMPILER=clang", "-DFW_SANITIZE=ON", "-DFW_FUZZ=ON", "-DFW_FUZZ_LONG=ON",
             "-DFW_TESTS=ON", "-DFW_PAGE=OFF", "-DFW_TOGETHER=ON", "-DCMAKE_BUILD_TYPE=Debug", "-DCMAKE_C_FLAGS_DEBUG=-g1 -O1"]
# parts of a thousand, by how long one takes (3 us to 9 ms) and how much there is to reach
WEIGHTS = {"device": 25, "flow": 1.5, "laboratory": 8, "layers": 10, "study": 40, "materials": 3, "map": 150, "log": 40, "coupons": 8,
           "drawing": 280, "expression": 290, "request": 144.5}
PIECE_S = 120
SECONDS, MIB = 20, 1024


def build():
    for command in (CONFIGURE, ["cmake", "--build", BUILD, "--target", "fuzz_files", "fuzzed_files"]):
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode:
            sys.exit((done.stdout + done.stderr)[-3000:])


def prepare(again):
    """the names of the kinds by number; a directory of first inputs for each, and what was done"""
    if again:
        shutil.rmtree(PLACE, ignore_errors=True)
    names = subprocess.run([BUILD / "tests/fuzz/fuzzed_files", "kinds"], capture_output=True, text=True, check=True).stdout.split()
    for number in range(len(names)):
        (PLACE / str(number)).mkdir(parents=True, exist_ok=True)
    subprocess.run([BUILD / "tests/fuzz/fuzzed_files", "corpus", PLACE], check=True)
    state = PLACE / "done.json"
    return names, json.loads(state.read_text()) if state.exists() else {}


def piece(number, count, seed):
    """executions and seconds of one run, and what it said where it found something"""
    largest = max(p.stat().st_size for p in (PLACE / str(number)).iterdir())
    start = time.monotonic()
    run = subprocess.run([BUILD / "tests/fuzz/fuzz_files", f"-runs={count}", f"-seed={seed}", f"-timeout={SECONDS}", f"-rss_limit_mb={MIB}",
                          f"-max_total_time={PIECE_S}", f"-max_len={min(2 * largest, 1 << 18)}", "-len_control=0", "-print_final_stats=1",
                          f"-artifact_prefix={PLACE}/found-{number}-", str(PLACE / str(number))], capture_output=True, text=True, errors="replace",
                         check=False, env={**os.environ, "FUZZ_KIND": str(number), "ASAN_OPTIONS": "detect_leaks=1"})
    executed = re.search(r"stat::number_of_executed_units: *(\d+)", run.stderr)
    return int(executed[1]) if executed else 0, time.monotonic() - start, run.stderr[-4000:] if run.returncode else None


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--count", type=int, default=10_000_000)
    parser.add_argument("--kind", nargs="*", choices=sorted(WEIGHTS))
    parser.add_argument("--minutes", type=float, default=1e9)
    parser.add_argument("--again", action="store_true")
    o = parser.parse_args()
    build()
    names, done = prepare(o.again)
    end, bad = time.monotonic() + 60 * o.minutes, 0
    left = True
    while left and time.monotonic() < end:
        left = False
        for number, name in enumerate(names):
            here = done.setdefault(f"{number} {name}", {"runs": 0, "seconds": 0.0, "pieces": 0, "found": 0})
            wanted = int(o.count * WEIGHTS[name] / 1000 / names.count(name)) - here["runs"]
            if wanted <= 0 or (o.kind and name not in o.kind) or time.monotonic() >= end:
                continue
            runs, took_s, said = piece(number, wanted, here["pieces"] + 1)
            here["runs"] += runs
            here["seconds"] += took_s
            here["pieces"] += 1
            if said:
                bad += 1
                here["found"] += 1
                print(f"{name}: {said}", flush=True)
            left = left or wanted > runs
            (PLACE / "done.json").write_text(json.dumps(done, indent=1) + "\n")
    for kind, here in done.items():
        print(f"{kind}: {here['runs']} executions in {here['seconds']:.0f} s, {here['found']} found, "
              f"{sum(1 for _ in (PLACE / kind.split()[0]).iterdir())} inputs kept")
    print(f"{sum(h['runs'] for h in done.values())} executions, {sum(h['found'] for h in done.values())} found")
    return bool(bad)


if __name__ == "__main__":
    sys.exit(main())
