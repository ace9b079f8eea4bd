#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""record.py BUILD: solves every deck of the tests of solids with CalculiX and writes tests/data/ccx anew, but for the two that CalculiX
solves in every run. Some minutes. The status is 1 when a test fails or a deck has another answer than before."""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
ANSWERS = ROOT / "tests/data/ccx"
SOLVED = 2  # of test_continuum, the first


def main():
    build, solver = pathlib.Path(sys.argv[1]).resolve(), shutil.which("ccx")
    if not solver:
        sys.exit("CalculiX is not installed")
    status = 0
    with tempfile.TemporaryDirectory() as temporary:
        record, bin_ = pathlib.Path(temporary, "record"), pathlib.Path(temporary, "bin")
        record.mkdir()
        bin_.mkdir()
        (bin_ / "ccx").write_text(f'#!/bin/sh\nexec "{sys.executable}" "{HERE}/kept.py" "{solver}" "{record}" "{record}" "$@"\n')
        (bin_ / "ccx").chmod(0o700)
        environment = dict(os.environ, PATH=f"{bin_}:{os.environ['PATH']}", FW_CCX=str(bin_))
        for n, command in enumerate(([build / "tests/unit_continuum", "test_continuum"], [build / "tests/unit_continuum", "test_solid"],
                                     [sys.executable, ROOT / "tests/cli/test_hinge.py", build / "flexwright"],
                                     [sys.executable, ROOT / "tests/cli/test_sizing.py", build / "flexwright", "-k", "calculix"])):
            status |= subprocess.run(command, env=environment, cwd=ROOT, check=False).returncode != 0
            if n == 0:
                for path in sorted(record.iterdir(), key=lambda p: p.stat().st_mtime_ns)[:SOLVED]:
                    path.rename(pathlib.Path(temporary, path.name))  # asked again by none
        for path in ANSWERS.iterdir():
            new = record / path.name
            if path.suffix == "" and new.exists() and new.read_bytes() != path.read_bytes():
                print(f"{path.name}: another answer")
                status = 1
            if path.suffix == "":
                path.unlink()
        for path in record.iterdir():
            shutil.copy(path, ANSWERS)
    return status


if __name__ == "__main__":
    sys.exit(main())
