#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""bytes.py PROGRAM: the masks of the gallery and of three (./test --all: a dozen) random devices are the same bytes from gcc -O2 (PROGRAM) and from clang,
some rooms -O0 and some -O1, under the sanitizers (build-asan, where build.sanitized has left it; else clang -O2, in build-clang).
FW_BYTES_LEVELS=1: from clang -O2, gcc -O0 and -O3, too, in directories beside it, which takes some minutes. Only the programs are
built. Motion is not compared: masks depend on the description and the process alone."""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/accept"))
sys.dont_write_bytecode = True
import random_devices  # noqa: E402

FAST = ["--force", "--corners", "none", "--accuracy", "3e-2", "--hinge-model", "revolute", "--mask-format", "all", "-q"]
COUNT = int(os.environ.get("FW_BYTES_COUNT", "12" if os.environ.get("FW_TEST_ALL") else "3"))
GALLERY = len(list((ROOT / "docs/gallery").glob("*/device.xml")))


def build(name, *options):
    """the program of a build directory beside the sources"""
    directory = ROOT / name
    for command in (["cmake", "-S", ROOT, "-B", directory, "-G", "Ninja", *options],
                    ["cmake", "--build", directory, "--target", "flexwright"]):
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode:
            sys.exit("%s does not build:\n%s" % (name, (done.stdout + done.stderr)[-3000:]))
    return directory / "flexwright"


def level(flags):
    return ("-DFW_TESTS=OFF", "-DFW_PAGE=OFF", "-DCMAKE_BUILD_TYPE=Debug", "-DCMAKE_C_COMPILER=gcc", "-DCMAKE_C_FLAGS_DEBUG=" + flags)


def programs(own):
    found, levels = {"gcc -O2": own}, os.environ.get("FW_BYTES_LEVELS")
    sanitized = ROOT / "build-asan/flexwright"
    if sanitized.exists() and sanitized.stat().st_mtime >= pathlib.Path(own).stat().st_mtime:
        found["clang, sanitizers"] = sanitized
    if levels or len(found) == 1:
        found["clang -O2"] = build("build-clang", "-DCMAKE_C_COMPILER=clang", "-DFW_TESTS=OFF", "-DFW_PAGE=OFF")
    for flags in ("-O0", "-O3") if levels else ():
        found["gcc " + flags] = build("build" + flags, *level(flags))
    return found


def devices(where):
    """(name, file, options); the gallery's scenes are cut short, since nothing that moves is in a mask"""
    for path in sorted((ROOT / "docs/gallery").glob("*/device.xml")):
        file = where / (path.parent.name + ".xml")
        file.write_text(re.sub(r'(<scene [^>]*duration=)"[^"]*"', r'\1"0.1 ms"', path.read_text(encoding="utf-8")), encoding="utf-8")
        yield path.parent.name, file, []
    for seed in range(5000, 5000 + 4 * COUNT):
        text, options = random_devices.device(seed)
        file = where / ("%d.xml" % seed)
        file.write_text(text, encoding="utf-8")
        yield str(seed), file, options


def masks(program, file, options, out):
    """{name: bytes}; empty: refused"""
    subprocess.run([program, "mask", file, *FAST, *options, "-o", out], capture_output=True, check=False)
    if not (out / "masks").exists():
        return {}
    return {p.name: p.read_bytes() for p in sorted((out / "masks").iterdir())}


def main():
    wrong, files, drawn = [], 0, 0
    with tempfile.TemporaryDirectory() as temporary:
        where = pathlib.Path(temporary)
        (_, own), *others = programs(pathlib.Path(sys.argv[1])).items()
        names = ["gcc -O2"] + [n for n, _ in others]
        for name, file, options in devices(where):
            if drawn == COUNT + GALLERY:
                break
            first = masks(own, file, options, where / name)
            if not first:
                continue  # random, and it cannot be drawn
            for number, (build_name, program) in enumerate(others):
                made = masks(program, file, options, where / ("%s-%d" % (name, number)))
                wrong += ["%s: %s differs (%s)" % (name, k, build_name) for k in sorted(set(first) | set(made))
                          if first.get(k) != made.get(k)]
            files += len(first)
            drawn += 1
    if drawn < COUNT + GALLERY:
        wrong.append("only %d devices were drawn" % drawn)
    print("\n".join(wrong) or "%d files of %d devices: the same bytes from %s" % (files, drawn, ", ".join(names)))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
