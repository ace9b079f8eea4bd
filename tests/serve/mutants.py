#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Each defence of the server built out in turn (targets flexwright_without_DEFENCE): the test that is there for it must fail.

    mutants.py BUILD_DIRECTORY DEFENCE ..."""
import concurrent.futures
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent


def run(build, defence):
    """the last lines of the test against the program without the defence, and whether it noticed"""
    program = build / f"flexwright_without_{defence}"
    if defence == "REAPER":
        command = [HERE / "robust.py", program, "drip_alone"]
    else:
        command = [HERE / "hostile.py", program, "--only", defence]
    found = subprocess.run([sys.executable, *map(str, command)], capture_output=True, text=True, timeout=120, check=False)
    noticed = found.returncode == 1 and ("they still drip" in found.stdout if defence == "REAPER" else
                                         " 0 served" not in found.stdout and " served" in found.stdout)
    return noticed, found.stdout[-400:] + found.stderr[-2000:]


def main():
    build, defences = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2:]
    subprocess.run(["cmake", "--build", str(build), "--target", *[f"flexwright_without_{d}" for d in defences]], check=True,
                   stdout=subprocess.DEVNULL)
    wrong = 0
    defences.sort(key=lambda d: d != "REAPER")  # it waits longest
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        for defence, (noticed, text) in zip(defences, pool.map(lambda d: run(build, d), defences)):
            print(f"without {defence}: {'noticed' if noticed else 'NOT NOTICED'}")
            if not noticed:
                wrong += 1
                print(text)
    return 1 if wrong or not defences else 0


if __name__ == "__main__":
    sys.exit(main())
