#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Which lines and branches of each room of src/ are passed, as a table by room.

    coverage.py [--ctest ARGUMENT ...]     of the quick unit tests, or of what ctest is asked for ("-R ^unit.xml")
    coverage.py --rooms xml,drawing        of the unit tests of these rooms, which alone are built
    coverage.py --run "PROGRAM WORDS" ...  of these programs of the build instead: --run "tests/fuzz/fuzzed_files 20000"
    coverage.py --files ROOM               also the files of a room, those with most branches that are not passed first

Builds what is asked for in build-coverage with clang, whose counters are exact (-fprofile-instr-generate); the branches are
those of conditions, both ways of each. Not part of ./test: a whole build, and every quick test."""
import argparse
import collections
import json
import os
import pathlib
import shlex
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = ROOT / "build-coverage"
FLAGS = "-g1 -O1 -fprofile-instr-generate -fcoverage-mapping"


def tool(name):
    found = shutil.which(name) or shutil.which(name + "-14")
    return found or sys.exit(f"{name} is not installed (Debian: llvm)")


def build(targets):
    configure = ["cmake", "-S", ROOT, "-B", BUILD, "-G", "Ninja", "-DCMAKE_C_COMPILER=clang", "-DFW_TESTS=ON", "-DFW_PAGE=OFF",
                 "-DCMAKE_BUILD_TYPE=Debug", f"-DCMAKE_C_FLAGS_DEBUG={FLAGS}"]
    for command in (configure, ["cmake", "--build", BUILD, "--target", *targets]):
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode:
            sys.exit((done.stdout + done.stderr)[-3000:])


def measured(where, programs):
    """the summary of llvm-cov by file"""
    merged = where / "all.profdata"
    raw = sorted(map(str, where.glob("*.profraw")))
    if not raw:
        sys.exit("nothing that was run left a profile")
    subprocess.run([tool("llvm-profdata"), "merge", "-sparse", "-o", merged, *raw], check=True)
    objects = [word for p in programs[1:] for word in ("-object", p)]
    out = subprocess.run([tool("llvm-cov"), "export", "-summary-only", f"-instr-profile={merged}", programs[0], *objects], capture_output=True,
                         text=True, check=True).stdout
    return json.loads(out)["data"][0]["files"]


def share(counts, kind):
    passed, all_ = counts[kind]
    return f"{100 * passed / all_:5.1f} %" if all_ else "    -  "


def table(files, room):
    rooms = collections.defaultdict(lambda: {"lines": [0, 0], "branches": [0, 0]})
    single = {}
    for file in files:
        # what ccache took over from another tree has the name that it has there
        name = file["filename"]
        if "/src/" not in name or not (ROOT / "src" / name.rpartition("/src/")[2]).exists():
            continue
        place = pathlib.Path(name.rpartition("/src/")[2])
        for kind in ("lines", "branches"):
            for counts in (rooms[place.parts[0]], rooms["all"], single.setdefault(place, {"lines": [0, 0], "branches": [0, 0]})):
                counts[kind][0] += file["summary"][kind]["covered"]
                counts[kind][1] += file["summary"][kind]["count"]
    print(f"{'room':<12} {'lines':>7}  {'branches':>8}  branches not passed")
    for name in sorted(rooms, key=lambda r: (r == "all", r)):
        counts = rooms[name]
        print(f"{name:<12} {share(counts, 'lines')}  {share(counts, 'branches'):>8}  {counts['branches'][1] - counts['branches'][0]}")
    for place in sorted(single, key=lambda p: single[p]["branches"][0] - single[p]["branches"][1]):
        if room and place.parts[0] == room:
            print(f"  {place.as_posix():<32} {share(single[place], 'lines')} {share(single[place], 'branches')}")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--ctest", nargs=argparse.REMAINDER, default=[])
    parser.add_argument("--run", action="append", default=[])
    parser.add_argument("--rooms")
    parser.add_argument("--files")
    options = parser.parse_args()
    commands = [shlex.split(c) for c in options.run]
    rooms = options.rooms.split(",") if options.rooms else []
    build([pathlib.Path(c[0]).name for c in commands] or [f"unit_{room}" for room in rooms] or ["quick"])
    usual = ["-R", rf"^unit\.({'|'.join(rooms)})\."] if rooms else ["-L", "quick", "-R", "^(unit|hard)[.]"]
    with tempfile.TemporaryDirectory() as name:
        where = pathlib.Path(name)
        environment = {**os.environ, "LLVM_PROFILE_FILE": str(where / "%m.profraw")}  # one a program, merged as they end
        for command in commands or [["ctest", "--test-dir", str(BUILD), "-j", "2", *(options.ctest or usual)]]:
            words = [str(BUILD / command[0]) if commands else command[0], *command[1:]]
            done = subprocess.run(words, env=environment, cwd=ROOT, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
            if done.returncode:
                print(f"{' '.join(command[:1])} ended with {done.returncode}")
        programs = [BUILD / c[0] for c in commands] or [BUILD / f"tests/unit_{room}" for room in rooms] or sorted(p for p in (BUILD / "tests").iterdir() if p.name.startswith(("unit_", "test_hard_"))
                                                             and os.access(p, os.X_OK) and p.is_file())
        table(measured(where, programs), options.files)
    return 0


if __name__ == "__main__":
    sys.exit(main())
