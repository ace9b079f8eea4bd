#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""reference_check.py PROGRAM: the references of the accuracy page agree with what others have computed, and
tests/data/accuracy-reference.csv is what the program prints. They depend on nothing of src/: where the files that they come
from are those of the last time (tests/data/accuracy-reference.sha256, written with --update), ./test leaves it at that and
./test --all computes them anew."""
import csv
import hashlib
import io
import os
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
TABLE = ROOT / "tests/data/sixbar_ref_0p1ms.txt"
KEPT = ROOT / "tests/data/accuracy-reference.csv"
SUM = KEPT.with_suffix(".sha256")
FILES = (ROOT / "tests/accuracy/reference.c", pathlib.Path(__file__), TABLE, KEPT)
# the tables have 18 to 20 digits, those of the elliptic functions are doubles
ALLOWED = {("six-bar", "table"): 5e-15, ("squeezer", "table"): 5e-15, ("windows", "table"): 5e-14}


def run(*arguments):
    return list(csv.reader(io.StringIO(subprocess.run(arguments, capture_output=True, text=True, check=True).stdout)))


now = "".join("%s  %s\n" % (hashlib.sha256(f.read_bytes()).hexdigest(), f.resolve().relative_to(ROOT)) for f in FILES)
if SUM.exists() and now == SUM.read_text(encoding="utf-8") and not os.environ.get("FW_TEST_ALL") and "--update" not in sys.argv:
    print("nothing has changed since they were compared")
    sys.exit(0)
program, wrong = sys.argv[1], []
said = run(program, "check", TABLE)
for problem, what, off in said:
    if not float(off) <= ALLOWED.get((problem, what), 1e-15):
        wrong.append(f"{problem}, {what}: off by {off}")
if len(said) != 5:
    wrong.append("a comparison is missing")
fresh, kept = run(program), list(csv.reader(KEPT.open(encoding="utf-8")))
if [row[:3] for row in fresh] != [row[:3] for row in kept]:
    wrong.append(f"{KEPT.name} has other rows")
for new, old in zip(fresh, kept):
    if abs(float(new[3]) - float(old[3])) > 1e-15 * max(1, abs(float(old[3]))):
        wrong.append(f"{','.join(old[:3])}: {new[3]}, kept is {old[3]}")
if "--update" in sys.argv and not wrong:
    SUM.write_text(now, encoding="utf-8")
print("\n".join(wrong) or f"{len(kept)} values; " + ", ".join(f"{a}, {b}: {off}" for a, b, off in said))
sys.exit(1 if wrong else 0)
