#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""labels.py BUILD: which tests ./test runs, and ./test --all. A regular expression of ctest leaves out every label that it occurs
in: "long" left out "longer", two dozen tests, for four days. Every test is run by --all but for first parts whose whole is there, and by
./test but for wholes, of which a first part is there or which are long themselves. Of long tests each has one turn (tests/turn.py), and
each turn has some."""
import json
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests"))
from turn import TURNS  # noqa: E402


def main():
    script = (ROOT / "test").read_text(encoding="utf-8")
    usual, every = re.findall(r"^ *skipped='(.*)'$", script, re.M)
    turns = {str(t) for t in range(TURNS)}
    listed = subprocess.run(["ctest", "--test-dir", sys.argv[1], "--show-only=json-v1"], capture_output=True, text=True, check=True)
    labels = {t["name"]: next((p["value"] for p in t["properties"] if p["name"] == "LABELS"), [])
              for t in json.loads(listed.stdout)["tests"]}
    left_out = [{name for name, own in labels.items() if any(re.search(r, x) for x in own)} for r in (usual, every)]
    wrong = ["%s: left out of ./test, and is no whole of a first part" % n for n in sorted(left_out[0]) if "long" not in labels[n]]
    wrong += ["%s: left out of ./test --all, and is no first part" % n for n in sorted(left_out[1]) if "part" not in labels[n]]
    wrong += ["%s: nothing runs it" % n for n in sorted(left_out[0] & left_out[1])]
    of = {n: [x[-1] for x in own if re.fullmatch(r"turn-.", x)] for n, own in labels.items()}
    wrong += ["%s has more than one turn" % n for n, own in of.items() if len(own) > 1]
    wrong += ["no test has turn %s" % t for t in sorted(turns - {x for own in of.values() for x in own})]
    wrong += ["there is no turn %s" % t for t in sorted({x for own in of.values() for x in own} - turns)]
    digits = "".join(sorted(turns))
    wrong += ["build.sanitized has another turn than every even one"] if [x for x in labels["build.sanitized"] if "turn" in x] != ["turn-even"] else []
    others = ((ROOT / "test", (f"0x$commit % {TURNS}))", f"echo {digits} |")),
              (ROOT / "tests/build/sanitized_beside.sh", (f"number % {TURNS // 2})) -eq $((FW_TURN / 2))",)),
              (ROOT / "tests/build/sanitized_unit.sh", (f"other++ % {TURNS // 2} == int(turn / 2)",)))
    wrong += [f"{file.name} knows another number of turns than tests/turn.py: no '{part}'" for file, parts in others for part in parts
              if part not in file.read_text(encoding="utf-8")]
    wrong += ["%s has no label" % n for n, own in labels.items() if not own]
    print("\n".join(wrong) or "%d tests, %d of them not in ./test and %d not in ./test --all" % (len(labels), *map(len, left_out)))
    return 1 if wrong or not all(left_out) else 0


if __name__ == "__main__":
    sys.exit(main())
