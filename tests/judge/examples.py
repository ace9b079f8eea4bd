#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""examples.py PROGRAM: the devices of examples/, whose truths are in their comments, as PROGRAM judges them, by exact beams,
too, where the comment asks for them: no false accept, no false reject, the truth inside the band, and that no wider than the comment
says."""
import json
import pathlib
import re
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent


def judged(program, path, text, more):
    truth, hinge = re.search(r"truth ([\d.]+).*?(?: at| of) (\w+) -->", text, re.S).groups()
    done = subprocess.run([program, "check", path, "--json", "--advice", "none", "--corners", "none", *more],
                          capture_output=True, text=True, timeout=240)
    verdict = json.loads(done.stdout)
    band = next(h["utilisation_band"] for h in verdict["hinges"] if h["id"] == hinge)
    wide = re.search(r"at most ([\d.]+) of the limit wide", text)
    return float(truth), band, verdict["verdict"], float(wide[1]) if wide else float("inf")


def main(program):
    wrong = 0
    for path in sorted((HERE / "examples").glob("*.xml")):
        text = path.read_text()
        for more in ([], ["--hinge-model", "elastica"])[:1 + ("exact beams" in text)]:
            truth, (low, high), verdict, wide = judged(program, path, text, more)
            false = (verdict == "accept" and truth > 1) or (verdict == "reject" and truth < 1)
            bad = false or not low <= truth <= high or high - low > wide
            wrong += bad
            print(f"{'WRONG ' if bad else ''}{path.name}{' by exact beams' if more else ''}: truth {truth:.4f}, band {low:.4f} "
                  f"to {high:.4f}, {verdict}")
    return wrong > 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
