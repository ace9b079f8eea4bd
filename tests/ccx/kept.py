#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Stands where a test wants ccx: kept.py CCX ANSWERS RECORD NAME. A deck that CalculiX has answered before, byte for byte, is answered
from ANSWERS (tests/data/ccx, a file for each SHA-256 of a deck): CalculiX in one thread gives the same again, and takes ten seconds.
Any other deck is solved by CCX in this directory; where RECORD is not empty, that directory gets the answer.

An answer is NAME.dat whole and, of NAME.frd, what is read of it: of each field the nodes with the largest principal value and
the largest equivalent one, and those within 1e-6 of them. The first line says which CalculiX it was."""
import ctypes
import hashlib
import math
import pathlib
import re
import signal
import subprocess
import sys

DIE_WITH_PARENT = 1  # PR_SET_PDEATHSIG of prctl(2)
BETWEEN = "==== frd\n"
NEAR = 1 - 1e-6


def sizes(row):
    """of the largest principal value and of the equivalent one, in a row of six components in columns of twelve"""
    xx, yy, zz, xy, yz, zx = (float(row[13 + 12 * i:25 + 12 * i]) for i in range(6))
    mean = (xx + yy + zz) / 3
    x, y, z = xx - mean, yy - mean, zz - mean
    p = math.sqrt((x * x + y * y + z * z + 2 * (xy * xy + yz * yz + zx * zx)) / 6)
    det = x * (y * z - yz * yz) - xy * (xy * z - yz * zx) + zx * (xy * yz - y * zx)
    phi = math.acos(max(-1.0, min(1.0, 0.5 * det / p**3 if p > 0 else 0.0))) / 3
    most, least = mean + 2 * p * math.cos(phi), mean + 2 * p * math.cos(phi + 2 * math.pi / 3)
    return max(abs(most), abs(least)), p


def thinned(frd):
    kept, rows = [], None
    for line in frd.splitlines():
        if line.startswith("  100CL"):
            kept.append(line)
        elif line.startswith(" -4"):
            rows = [] if re.match(" -4  (TOSTRAIN|STRESS )", line) else None
            if rows is not None:
                kept.append(line)
        elif line.startswith(" -1") and rows is not None:
            rows.append((sizes(line), line))
        elif line.startswith(" -3") and rows is not None:
            most = [max(s[k] for s, _ in rows) for k in (0, 1)]
            kept += [row for s, row in rows if s[0] >= most[0] * NEAR or s[1] >= most[1] * NEAR]
            kept.append(line)
            rows = None
    return "\n".join(kept) + "\n"


def solve(solver, name, here, record):
    libc = ctypes.CDLL(None)
    done = subprocess.run([solver, name], check=False, stdout=subprocess.PIPE, text=True,
                          preexec_fn=lambda: libc.prctl(DIE_WITH_PARENT, signal.SIGKILL))
    sys.stdout.write(done.stdout)
    if done.returncode == 0 and record:
        version = re.search(r"Version \S+", done.stdout).group()
        digest = hashlib.sha256((here / f"{name}.inp").read_bytes()).hexdigest()
        text = f"CalculiX {version}\n" + (here / f"{name}.dat").read_text() + BETWEEN + thinned((here / f"{name}.frd").read_text())
        pathlib.Path(record, digest).write_text(text)
    return done.returncode


def main():
    solver, answers, record, name = sys.argv[1:]
    here = pathlib.Path.cwd()
    known = pathlib.Path(answers) / hashlib.sha256((here / f"{name}.inp").read_bytes()).hexdigest()
    if not known.exists():
        return solve(solver, name, here, record)
    printed, fields = known.read_text().split("\n", 1)[1].split(BETWEEN)
    (here / f"{name}.dat").write_text(printed)
    (here / f"{name}.frd").write_text(fields)
    return 0


if __name__ == "__main__":
    sys.exit(main())
