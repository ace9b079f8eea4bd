#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The same devices in many environments: what is the same to the last byte, and what differs by how much.

    environments.py PROGRAM [--build NAME ...] [--blas NAME=DIRECTORY ...] [--under NAME=WORDS ...] [--device FILE ...] [--valgrind]
                    [--only PATTERN]

Environments of PROGRAM itself: the mathematical library without AVX-512, FMA, AVX2 and AVX (GLIBC_TUNABLES; what the program chooses by
itself among its own lanes is as the processor has it: for that, --under "Nehalem=qemu-x86_64 -cpu Nehalem" and --valgrind, which
has no AVX-512), languages (made by localedef where the system has them not), zones, another working directory, umask, number of
threads, little stack. --build: programs built here, of gcc-O0, gcc-O3,
clang-O2, clang-O0, clang-O3 (some minutes each, kept in build-NAME). --blas: another libblas.so.3 and liblapack.so.3, from that directory.

Of each it compares: masks (all formats), recipes, certificates of masks and workspaces, and decisions, byte for byte: a
difference there is a failure, status 1, but for what EXCUSED names with its reason. Other files (verdict, motion, report) are listed
with the largest relative difference of their numbers. Not part of ./test, which has a sample (cli.reproducible, build.bytes)."""
import argparse
import collections
import json
import math
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
DEVICES = [ROOT / "docs/gallery" / name / "device.xml" for name in ("reference-six-bar", "leaf-four-bar", "free-form-gripper", "copper-nodder")]
BUILDS = {"gcc-O0": ("gcc", "-O0"), "gcc-O3": ("gcc", "-O3"), "clang-O2": ("clang", "-O2"), "clang-O0": ("clang", "-O0"),
          "clang-O3": ("clang", "-O3")}
FAST = ["--corners", "none", "--accuracy", "3e-2", "--advice", "none", "--force", "--mask-format", "all", "-q"]
NUMBER = re.compile(rb"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
STRICT = re.compile(r"masks/|recipes/|certificate\.json$")
EXCUSED = {}  # a pattern of names: why it may differ


def built(name):
    compiler, level = BUILDS[name]
    directory = ROOT / ("build-" + name)
    for command in (["cmake", "-S", ROOT, "-B", directory, "-G", "Ninja", "-DFW_TESTS=OFF", "-DFW_PAGE=OFF", "-DCMAKE_BUILD_TYPE=Debug",
                     f"-DCMAKE_C_COMPILER={compiler}", f"-DCMAKE_C_FLAGS_DEBUG={level}"],
                    ["cmake", "--build", directory, "--target", "flexwright"]):
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode:
            sys.exit("%s does not build:\n%s" % (name, (done.stdout + done.stderr)[-3000:]))
    return directory / "flexwright"


def localised(where):
    """German and Turkish, whatever the system has: a comma in numbers, and an i that is no lower case of I"""
    for name in ("de_DE", "tr_TR"):
        subprocess.run(["localedef", "-i", name, "-f", "UTF-8", where / (name + ".UTF-8")], capture_output=True, check=False)
    return {"LOCPATH": str(where)}


def environments(program, options, where):
    """name: (words before the program's, program, variables, preparation of the child)"""
    off = {"without AVX-512": "-AVX512F,-AVX512VL,-AVX512BW,-AVX512DQ,-AVX512CD", "without FMA": "-FMA,-FMA4,-AVX512F", "without AVX2": "-FMA,-FMA4,-AVX512F,-AVX2", "without AVX": "-FMA,-FMA4,-AVX512F,-AVX2,-AVX"}
    yield "as it is", ([], program, {}, None)
    yield "again", ([], program, {}, None)
    for name, what in off.items():
        yield name, ([], program, {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=" + what}, None)
    languages = localised(where)
    yield "German, Auckland", ([], program, {**languages, "LC_ALL": "de_DE.UTF-8", "TZ": "Pacific/Auckland", "HOME": "/nonexistent"}, None)
    yield "Turkish, no zone", ([], program, {**languages, "LC_ALL": "tr_TR.UTF-8", "TZ": ""}, None)
    yield "umask 077", ([], program, {}, lambda: os.umask(0o77))
    yield "eight threads", ([], program, {"OPENBLAS_NUM_THREADS": "8", "OMP_NUM_THREADS": "8"}, None)
    yield "a stack of 512 KiB", ([], program, {}, lambda: resource.setrlimit(resource.RLIMIT_STACK, (1 << 19, 1 << 19)))
    for given in options.under:
        name, words = given.split("=", 1)
        yield name, (words.split(), program, {}, None)
    for given in options.blas:
        name, directory = given.split("=", 1)
        yield "BLAS " + name, ([], program, {"LD_LIBRARY_PATH": str(pathlib.Path(directory).resolve()), "OPENBLAS_NUM_THREADS": "2"}, None)
    for name in options.build:
        yield name, ([], built(name), {}, None)
    if options.valgrind and shutil.which("valgrind"):
        yield "valgrind", (["valgrind", "-q"], program, {}, None)


def results(environment, device, where):
    """{file: bytes} of plan and workspace; the exit status is one of them"""
    before, program, variables, prepare = environment
    where.mkdir()
    shutil.copytree(device.parent, where / "device")
    found = {}
    for command in ("plan", "workspace"):
        words = [*before, str(program), command, "device/device.xml", *(FAST if command == "plan" else ["--accuracy", "3e-2", "-q"]), "-o", command]
        done = subprocess.run(words, cwd=where, env={"PATH": os.environ["PATH"], **variables}, capture_output=True, check=False, preexec_fn=prepare)
        found[f"{command}: status"] = str(done.returncode).encode()
        found.update({f"{command}/{p.relative_to(where / command).as_posix()}": re.sub(rb'"cpu_s": ?[-+.e\d]+', b"", p.read_bytes())
                      for p in sorted((where / command).rglob("*")) if p.is_file()})
    if "plan/verdict.json" in found:
        verdict = json.loads(found["plan/verdict.json"])
        found["decisions"] = json.dumps([verdict.get("verdict"), [r.get("code") for r in verdict.get("reasons", [])]]).encode()
    return found


def largest(a, b):
    """the largest relative difference of the numbers of two texts; inf: the words differ, too"""
    if NUMBER.sub(b"0", a) != NUMBER.sub(b"0", b):
        return math.inf
    pairs = zip(map(float, NUMBER.findall(a)), map(float, NUMBER.findall(b)))
    return max((abs(x - y) / max(abs(x), abs(y)) for x, y in pairs if x != y), default=0.0)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--build", action="append", default=[], choices=sorted(BUILDS))
    parser.add_argument("--blas", action="append", default=[])
    parser.add_argument("--device", action="append", type=pathlib.Path, default=[])
    parser.add_argument("--under", action="append", default=[])
    parser.add_argument("--valgrind", action="store_true")
    parser.add_argument("--only", default="", help="beside the first, only environments whose names fit this pattern")
    options = parser.parse_args()
    devices, failed, first = [d.resolve() for d in options.device] or DEVICES, 0, {}
    with tempfile.TemporaryDirectory() as name:
        for title, environment in environments(options.program.resolve(), options, pathlib.Path(name)):
            if first and not re.search(options.only, title):
                continue
            same, differs = 0, collections.defaultdict(list)
            for device in devices:
                place = pathlib.Path(name) / re.sub(r"\W+", "-", title + device.parent.name)
                got = results(environment, device, place)
                shutil.rmtree(place)
                want = first.setdefault(device, got)
                for file in sorted(set(got) | set(want)):
                    if got.get(file) == want.get(file):
                        same += 1
                    elif file in got and file in want:
                        differs[file].append((largest(want[file], got[file]), device.parent.name))
                    else:
                        differs[file].append((math.inf, device.parent.name + ", one has it and one has not"))
            print(f"{title}: {same} files the same, {sum(map(len, differs.values()))} differ", flush=True)
            for file, found in sorted(differs.items()):
                reason = next((why for pattern, why in EXCUSED.items() if re.search(pattern, file)), None)
                strict = (STRICT.search(file) or ": status" in file or file == "decisions") and not reason
                failed += bool(strict)
                by, device = max(found)
                print(f"  {'FAILED ' if strict else ''}{file}: by up to {by:.2g} ({device}){': ' + reason if reason else ''}")
    return bool(failed)


if __name__ == "__main__":
    sys.exit(main())
