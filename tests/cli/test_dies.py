#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A sweep as="die": each device is one die of its flow. Told ones are what judged ones are, a die has all that an uncertain
input and a place on the wafer make of it, and nothing changes a byte."""
import json
import pathlib
import shutil
import sqlite3
import tempfile
import unittest

from common import ALL, GALLERY, run
from test_fitted import FILES, rows_of
from test_study import ONE_LEAF, study

FLOW = "al-masked-rie"
# as short as shows the whole swing, with a load that thinner dies do not bear
LEAF = (ONE_LEAF.replace('duration="1 ms"', 'duration="0.3 ms"').replace('value="20 uN"', 'value="76 uN"').replace(' law="ramp" rise="0.5 ms"', "")
        .replace("<limits ", f'<flow ref="{FLOW}"/>\n  <limits ')
        .replace("</device>", '<die width="3 mm" height="3 mm"/>\n<wafer diameter="100 mm"/>\n</device>'))
CHOSEN = '<vary what="push" from="{low}" to="{high}" steps="4"/>'
TREND = f'<trend what="printed edge" flow="{FLOW}" radial="0.1 um"/>'
DIFFERS = '<uncertain what="width" mean="8 um" sd="0.05 um"/>' + TREND
ASKED = '<respond name="U" value="hinges[A].utilisation"/><respond name="top" value="governing.utilisation"/>'


class Dies(unittest.TestCase):
    def setUp(self):
        self.place = pathlib.Path(tempfile.mkdtemp(prefix="fw-dies-"))
        self.addCleanup(shutil.rmtree, self.place)
        (self.place / "leaf.xml").write_text(LEAF)

    def study(self, name, rows, **more):
        asked = {"points": "sobol", "samples": 1000, "as": "die", **more}
        path = self.place / f"{name}.xml"
        path.write_text(study("s", "sweep", rows, "leaf.xml", **{k: v for k, v in asked.items() if v is not None}))
        return path

    def run_study(self, path, name, *options):
        done = run("study", path, "-o", self.place / name, *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return self.place / name, done.stdout

    def test_told_dies_are_what_judged_ones_are(self):
        """of the process alone, one drawing for all; and of other drawings, with a setting and a place besides"""
        chosen = CHOSEN.format(low="70 uN", high="85 uN")
        for name, rows in (("process", TREND + ASKED), *([("all", chosen + DIFFERS + ASKED)] if ALL else [])):
            path = self.study(name, rows, fitted=0.05)
            told, said = self.run_study(path, f"{name}-told")
            path.write_text(path.read_text().replace(' fitted="0.05"', ""))
            judged, _ = self.run_study(path, f"{name}-judged", "--shard", "2/10")
            within = json.loads((told / "study.json").read_text())
            self.assertGreater(within["fitted"]["told"], 700, said)
            self.assertIn("all came as told", said)
            off = [within["fitted"]["limit_used_within"]] + [r["told_within"] for r in within["responses"]]
            of_told = {row[0]: row for row in rows_of(told)}
            count, states = 0, set()
            for is_ in rows_of(judged):
                says = of_told[is_[0]]
                states.add(is_[1])
                if says[2] is None:
                    self.assertEqual(is_, says)
                    continue
                self.assertEqual((says[1], says[2], says[4:-2]), (is_[1], "response surface", is_[4:-2]))
                for x, y, far in zip((is_[3], *is_[-2:]), (says[3], *says[-2:]), off):
                    self.assertLessEqual(abs(x - y), far * (1 + 1e-6) + 1e-6 * abs(x))
                count += 1
            self.assertGreater(count, 50)
            self.assertEqual(states, {"accept", "reject"})

    def test_a_die_has_values_of_its_own(self):
        """their spread is what is stated, and both a setting and a trend are in what a die uses"""
        out, _ = self.run_study(self.study("some", CHOSEN.format(low="76 uN", high="76.1 uN") + DIFFERS + ASKED,
                                           samples=40), "some")
        with sqlite3.connect(out / "study.sqlite") as store:
            got = store.execute('SELECT "width", "printed edge", "thickness", U FROM sample').fetchall()
        for column, mean, sd in ((0, 8e-6, 0.05e-6), (2, 50e-6, 0.5e-6)):
            values = [row[column] for row in got]
            middle = sum(values) / len(values)
            self.assertAlmostEqual(middle, mean, delta=0.3 * sd)
            self.assertAlmostEqual((sum((v - middle) ** 2 for v in values) / len(values)) ** 0.5, sd, delta=0.2 * sd)
        # the pack knows the edge within 0.15 um; what is beyond is the place on the wafer
        self.assertGreater(max(abs(row[1]) for row in got), 0.15e-6)
        self.assertEqual(len({row[3] for row in got}), 40)

    def test_threads_shards_and_attempts_change_no_byte(self):
        # of told ones test_fitted.py asks the same
        for name, rows, more in (*([("told", ASKED, {"fitted": 0.1, "samples": 200})] if ALL else []),
                                 ("judged", CHOSEN.format(low="70 uN", high="85 uN") + DIFFERS + ASKED,
                                  {"points": "grid", "samples": None})):
            path = self.study(name, rows, **more)
            one, _ = self.run_study(path, f"{name}-one", "--jobs", "1")
            many, _ = self.run_study(path, f"{name}-many", "--jobs", "3")
            shards = [self.run_study(path, f"{name}-shard{i}", "--shard", f"{i}/2")[0] for i in (1, 2)]
            merged = self.place / f"{name}-merged"
            done = run("study", "merge", *shards, "-o", merged)
            self.assertEqual(done.returncode, 0, done.stderr)
            with sqlite3.connect(many / "study.sqlite") as store:
                store.execute("DELETE FROM sample WHERE i % 3 = 1")
            self.run_study(path, f"{name}-many", "--resume")
            for other in (many, merged):
                for file in FILES:
                    self.assertEqual((one / file).read_bytes(), (other / file).read_bytes(), f"{other.name}/{file}")

    def test_what_is_no_die_is_refused(self):
        for what, kind, rows, more, says in (
                ("two flows", "sweep", ASKED, {"device": GALLERY}, "FW-D658"),
                ("a yield", "yield", "", {"points": None}, "a yield is of dies in any case"),
                ("a grid of nothing", "sweep", ASKED, {"points": "grid"}, "add points=&quot;sobol&quot;"),
                ("a clearance", "sweep", '<respond name="c" value="clearances[0].least_m"/>', {}, "FW-D576")):
            asked = {"points": "sobol", "as": "die", "samples": 300, **more}
            path = self.place / "refused.xml"
            device = asked.pop("device", "leaf.xml")
            path.write_text(study("s", kind, rows, device, **{k: v for k, v in asked.items() if v}))
            done = run("study", path, "-o", self.place / "refused")
            self.assertEqual(done.returncode, 3, f"{what}: {done.stdout}{done.stderr}")
            self.assertIn(says.replace("&quot;", '"'), done.stderr, what)


if __name__ == "__main__":
    unittest.main()
