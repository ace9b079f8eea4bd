#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the gate on instruction counts lets through and what not, and that callgrind's files are read rightly."""
import copy
import importlib.machinery
import importlib.util
import pathlib
import sys
import unittest

BENCH = pathlib.Path(__file__).resolve().parents[1] / "bench"
sys.path.insert(0, str(BENCH))
sys.dont_write_bytecode = True
import callgrind  # noqa: E402

loader = importlib.machinery.SourceFileLoader("gate", str(BENCH / "gate"))
gate = importlib.util.module_from_spec(importlib.util.spec_from_loader("gate", loader))
loader.exec_module(gate)

THEN = {"built": {"compiler": "GNU 12.2.0", "type": "Release", "flags": "-O2"}, "processor": "avx avx2 fma", "libc": "2.36",
        "libraries": ["libm.so.6"], "cases": {"a": {"own": 100000, "total": 200000}, "b": {"own": 5000, "total": 5000}}}

DUMP = """events: Ir
ob=(1) /program
fn=(1) measured
10 5
+2 7
cob=(2) /lib/libm.so.6
cfn=(2) sin
calls=3 0
* 900
-1 2

ob=(2)
fn=(2)
0 900
ob=(1)
fn=(3) other
4 1
totals: 915
"""


def changed(case, what, factor):
    now = copy.deepcopy(THEN)
    now["cases"][case][what] = round(now["cases"][case][what] * factor)
    return now


class Judge(unittest.TestCase):
    def status(self, now):
        return gate.judge(now, THEN)[0]

    def test_one_per_cent(self):
        for what in ("own", "total"):
            self.assertEqual(self.status(changed("a", what, 1.0)), 0)
            self.assertEqual(self.status(changed("a", what, 1.0099)), 0)
            self.assertEqual(self.status(changed("a", what, 1.02)), 1)
            self.assertEqual(self.status(changed("a", what, 0.98)), 1, "what has become cheaper is written down too")
        self.assertIn("+2.000 %", gate.judge(changed("b", "own", 1.02), THEN)[1][0])

    def test_cases_come_and_go(self):
        now = copy.deepcopy(THEN)
        now["cases"]["c"] = {"own": 1, "total": 1}
        self.assertEqual(self.status(now), 1)
        del now["cases"]["c"], now["cases"]["a"]
        self.assertEqual(self.status(now), 1)

    def test_what_may_not_cost_more_than_so_many_times_another(self):
        now = copy.deepcopy(THEN)
        for dear, cheap, most in gate.RATIOS:
            now["cases"][cheap] = {"own": 1000, "total": 1000}
            now["cases"][dear] = {"own": 1, "total": round(1000 * most)}
            self.assertEqual(gate.judge(now, now)[0], 0)
            now["cases"][dear]["total"] += 10
            status, lines = gate.judge(now, now)
            self.assertEqual((status, len(lines)), (1, 1))
            self.assertIn(dear, lines[0])
            del now["cases"][cheap], now["cases"][dear]
        baseline = gate.json.loads(gate.BASELINE.read_text(encoding="utf-8"))
        self.assertEqual(len(gate.ratios(baseline)), len(gate.RATIOS))

    def test_another_compiler_is_not_compared(self):
        for where, what, other in (("built", "compiler", "GNU 13.1.0"), ("built", "flags", "-O3"), ("built", "type", "Debug")):
            now = changed("a", "own", 2)
            now[where][what] = other
            self.assertEqual(self.status(now), callgrind.SKIPPED)
        now = changed("a", "own", 2)
        now["processor"] = "avx"
        self.assertEqual(self.status(now), callgrind.SKIPPED)

    def test_other_libraries_leave_the_programs_own(self):
        now = changed("a", "total", 1.5)
        now["libc"] = "2.40"
        self.assertEqual(self.status(now), 0)
        now["cases"]["b"]["own"] *= 2
        self.assertEqual(self.status(now), 1)

    def test_the_largest_change_first(self):
        now = changed("a", "own", 1.03)
        now["cases"]["b"]["own"] = 4000
        self.assertEqual([text.split()[-1] for _, text in gate.changes(now, THEN)[:2]], ["b", "a"])

    def test_the_baseline_can_be_judged(self):
        import json
        baseline = json.loads(gate.BASELINE.read_text(encoding="utf-8"))
        self.assertEqual(gate.judge(baseline, baseline)[0], 0)
        self.assertGreaterEqual(len(baseline["cases"]), 10)
        self.assertTrue(all(len(reason.split()) > 2 for reason in baseline["reasons"]))
        self.assertTrue(all(0 < c["own"] <= c["total"] for c in baseline["cases"].values()))

    def test_what_callgrind_wrote(self):
        names = {}
        self.assertEqual(callgrind.total(DUMP), 915)
        self.assertEqual(callgrind.own(DUMP, "/program", names), 15)
        again = DUMP.replace("(1) /program", "(1)", 1)  # a later dump of the same run may use the numbers alone
        self.assertEqual(callgrind.own(again, "/program", names), 15)


if __name__ == "__main__":
    unittest.main()
