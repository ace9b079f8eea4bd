#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A motion costs as many instructions per body in a large model as in a small one: N four-bar windows, 1 s at rtol 1e-8, counted
by callgrind, with all that is done before the first step. size.py PROGRAM, which is tests/accuracy/accuracy_motions."""
import csv
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "bench"))
sys.dont_write_bytecode = True
import callgrind  # noqa: E402

SMALL, LARGE = 50, 2000
MORE = 0.06  # one look at every <initial> for every coordinate made it 0.2; sorting the joint graph is 0.01
RHS = 6  # column of a row: see motions.c


def per_body(program, windows):
    said, status, parts = callgrind.count(program, [f"scale-{windows}", "by-integrator", "-", "-", "dop853", 8, 8, 1])
    row = next(csv.reader([said.strip()]))
    if status or len(parts) != 1 or not row[0].startswith("scale-"):
        sys.exit(f"{windows} windows: status {status}, {len(parts)} motions counted\n{said}")
    return parts[0].total / int(row[RHS]) / (2 * windows + 1)


def main():
    if callgrind.missing():
        print("valgrind is not installed: skipped")
        return callgrind.SKIPPED
    small, large = (per_body(sys.argv[1], windows) for windows in (SMALL, LARGE))
    print(f"{small:.0f} instructions per evaluation and body with {2 * SMALL + 1} bodies, {large:.0f} with {2 * LARGE + 1}")
    return 0 if large < (1 + MORE) * small else 1


if __name__ == "__main__":
    sys.exit(main())
