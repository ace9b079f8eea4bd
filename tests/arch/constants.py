#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Each constant stands once: the digits of the numbers in src/base/constants.h are in no other source
file, and nobody takes pi from the C library or from an arc cosine."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
HEADER = "base/constants.h"
SPELLED = [(r"\bM_(PI|1_PI|2_PI|PI_2|PI_4|E|SQRT2|SQRT1_2)\b", "a constant of <math.h>"),
           (r"\ba(cos\(-1(\.0?)?\)|tan2?\((0(\.0?)?, *-)?1(\.0?)?\))", "pi as an arc"),
           (r"\b1\.57079\d*|\b0\.78539\d*", "a part of pi"), (r"\b0\.0174532\d*", "radians per degree")]


def constants(text):
    """(name, pattern of its leading digits) of every row; short ones are matched whole."""
    for name, value in re.findall(r"#define (FW_\w+) +([0-9][0-9.]*)", text):
        digits = value.rstrip("0").rstrip(".")
        head = digits[:7] if len(digits) > 7 else digits
        yield name, re.compile(r"(?<![\d.])" + re.escape(head) + (r"\d*" if len(digits) > 7 else r"(?!\d)"))


def main():
    rows = list(constants((ROOT / "src" / HEADER).read_text()))
    if len(rows) < 12:
        print(f"only {len(rows)} constants found in {HEADER}: its rows changed their form")
        return 1
    names = {}
    for name, pattern in rows:
        names.setdefault(pattern.pattern, (pattern, name))
    # most files have none of these: asked once, and only of what begins alike
    likely = [re.compile("|".join(pattern.pattern.split(")", 1)[1] for pattern, _ in names.values())),
              re.compile("|".join(pattern for pattern, _ in SPELLED))]
    found = 0
    for path in sorted((ROOT / "src").rglob("*.[ch]")):
        room_file = path.relative_to(ROOT / "src").as_posix()
        if room_file == HEADER:
            continue
        code = re.sub(r'/\*.*?\*/|"(\\.|[^"\\\n])*"', lambda m: "\n" * m.group(0).count("\n"), path.read_text(),
                      flags=re.S)
        if not any(pattern.search(code) for pattern in likely):
            continue
        for number, line in enumerate(code.splitlines(), 1):
            for pattern, name in names.values():
                if pattern.search(line):
                    print(f"{room_file}:{number}: {pattern.search(line).group(0)} is {name} of {HEADER}")
                    found += 1
            for pattern, what in SPELLED:
                if re.search(pattern, line):
                    print(f"{room_file}:{number}: {re.search(pattern, line).group(0)} is {what}; {HEADER} has it")
                    found += 1
    print(f"{len(rows)} constants, {found} repeated")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
