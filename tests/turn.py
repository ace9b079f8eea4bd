#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""turn.py FILE ARGUMENTS...: the tests of a file of unittest whose turn it is.

Tests that run programs for long take turns (docs/decisions/0214-tests-take-turns.md): ./test runs every short one and of the long ones
an eighth, which one the commit says. FW_TURN is its number, 0 to 7; without it, or "all", every test runs, as with
`python3 FILE ARGUMENTS...`. Of a file the tests take turns in the order in which they are loaded, and files begin with
different turns, so that each turn has about as much of all."""
import importlib.util
import os
import pathlib
import sys
import unittest
import zlib

TURNS = 8


def turn():
    """the number of the turn; None: all"""
    asked = os.environ.get("FW_TURN", "all")
    if asked == "all":
        return None
    if not asked.isdecimal() or int(asked) >= TURNS:
        sys.exit(f"FW_TURN is a number from 0 to {TURNS - 1}, or all; it is '{asked}'")
    return int(asked)


def of_turn(tests, name, now):
    """those of a list whose turn it is; what is empty has no turn"""
    first = zlib.crc32(name.encode())
    return [t for i, t in enumerate(tests) if now is None or (first + i) % TURNS == now]


def cases(suite):
    for part in suite:
        if isinstance(part, unittest.TestSuite):
            yield from cases(part)
        else:
            yield part


def main():
    path = pathlib.Path(sys.argv[1]).resolve()
    sys.argv = sys.argv[1:]
    sys.path.insert(0, str(path.parent))
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(spec)
    sys.modules[path.stem] = module
    spec.loader.exec_module(module)
    every = list(cases(unittest.defaultTestLoader.loadTestsFromModule(module)))
    mine = of_turn(every, path.name, turn())
    if not every:
        sys.exit(f"{path.name} has no tests")
    print(f"{len(mine)} of {len(every)} tests", file=sys.stderr)
    result = unittest.TextTestRunner(verbosity=1).run(unittest.TestSuite(mine))
    return 0 if result.wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main())
