#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A sweep with fitted=...: devices that response surfaces tell are what a sweep that judges all says of them, in any
number of threads, shards and attempts the same bytes; what surfaces cannot know is refused."""
import json
import pathlib
import re
import shutil
import sqlite3
import tempfile
import unittest

from common import GALLERY, run
from test_study import ONE_LEAF, study

ROWS = """<vary what="push" from="{low}" to="{high}" steps="14"/>
<vary what="width" from="7 um" to="9 um" steps="14"/>
<respond name="U" value="hinges[A].utilisation"/>
<respond name="turned" value="hinges[A].peak_angle_rad"/>"""
FEW = {"samples": 150, "fitted": 0.05, "low": "20 uN", "high": "60 uN"}  # none near its limit, which costs most
FILES = ("study.sqlite", "study.csv", "study.json", "study.html")


def bare():
    """the gallery's six-bar as drawn, of no flow: what differs from device to device is what the test says"""
    text = re.sub(r'\s*<(flow|workspace) [^>]*/>', "", GALLERY.read_text())
    text = re.sub(r'\s*<scene name="gentle-step".*?</scene>', "", text, flags=re.S)
    text = text.replace(' flow="al-masked-rie"', "").replace('fx="0.25 mN"', 'fx="push"')
    return text.replace("<material ", '<parameter name="push" value="0.25 mN"/>\n  <material ', 1)


def rows_of(place):
    with sqlite3.connect(place / "study.sqlite") as store:
        return store.execute("SELECT * FROM sample ORDER BY i").fetchall()


def named_rows(place):
    """a dictionary each"""
    with sqlite3.connect(place / "study.sqlite") as store:
        found = store.execute("SELECT * FROM sample ORDER BY i")
        names = [c[0] for c in found.description]
        return [dict(zip(names, row)) for row in found]


class Fitted(unittest.TestCase):
    def setUp(self):
        self.place = pathlib.Path(tempfile.mkdtemp(prefix="fw-fitted-"))
        self.addCleanup(shutil.rmtree, self.place)
        # a load that is there at once: what a ramp leaves ringing goes in waves of the width, which no surface follows
        text = ONE_LEAF.replace(' law="ramp" rise="0.5 ms"', "")
        assert text != ONE_LEAF
        (self.place / "leaf.xml").write_text(text)

    def study(self, name, low="40 uN", high="110 uN", rows=ROWS, **more):
        asked = {"points": "sobol", "samples": 240, "as": "hinges", "fitted": 0.02, **more}
        path = self.place / f"{name}.xml"
        path.write_text(study("s", "sweep", rows.format(low=low, high=high), "leaf.xml",
                              **{k: v for k, v in asked.items() if v is not None}))
        return path

    def run_study(self, name, *options, **more):
        out = self.place / name
        done = run("study", self.study("study", **more), "-o", out, *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return out, done.stdout

    def compare(self, told, judged):
        """decisions, and responses within what is stated; how many were told"""
        within = json.loads((told / "study.json").read_text())
        off = [within["fitted"]["limit_used_within"]] + [r["told_within"] for r in within["responses"]]
        a, b = rows_of(judged), rows_of(told)
        self.assertEqual([r[0] for r in a], [r[0] for r in b])
        count, states = 0, set()
        for is_, said in zip(a, b):
            if said[2] is None:
                self.assertEqual(is_, said, "a judged device is the same in both")
                continue
            self.assertEqual(said[2], "response surface")
            self.assertEqual(is_[1], said[1], f"number {is_[0]}")
            self.assertEqual(is_[4:6], said[4:6])
            for x, y, far in zip((is_[3], *is_[6:]), (said[3], *said[6:]), off):
                self.assertLessEqual(abs(x - y), far * (1 + 1e-6) + 1e-6 * abs(x))
            count, states = count + 1, states | {said[1]}
        fitted = within["fitted"]
        self.assertEqual(fitted["told"], count)
        self.assertEqual(fitted["told"] + fitted["judged"] + fitted["left_open"], len(b))
        for r, far in zip(range(6, 8), off[1:]):
            self.assertLessEqual(far, 0.02 * max(abs(row[r]) for row in a) * (1 + 1e-9))
        return count, states

    def test_told_devices_are_what_judged_ones_are(self):
        for points, more in (("sobol", {}), ("grid", {"samples": None})):
            told, said = self.run_study(f"told-{points}", points=points, **more)
            judged, _ = self.run_study(f"judged-{points}", points=points, fitted=None, **more)
            count, states = self.compare(told, judged)
            self.assertGreater(count, 50, said)
            self.assertEqual(states & {"accept", "reject"}, {"accept", "reject"})
            self.assertIn(f"{count} of them were told by response surfaces", said)
            self.assertIn("all came as told", said)

    def test_the_hinge_that_governs_may_be_another_one(self):
        """the largest of many has edges where another comes to be it, which a surface through it would not follow"""
        (self.place / "bare.xml").write_text(bare())
        rows = """<vary what="flexure[F]/@width" from="8 um" to="12 um"/>
            <vary what="flexure[A]/@width" from="7 um" to="11 um"/>
            <respond name="governing" value="governing.utilisation"/>
            <respond name="highest" value="hinges[*].utilisation_band[1]" take="largest"/>
            <respond name="F" value="hinges[F].utilisation"/>
            <respond name="A" value="hinges[A].utilisation"/>"""
        for name, more in (("told", {"fitted": "0.03", "samples": 3000}), ("judged", {"samples": 400})):
            path = self.place / f"{name}.xml"
            path.write_text(study("s", "sweep", rows, "bare.xml", points="sobol", **{"as": "hinges"}, **more))
            done = run("study", path, "-o", self.place / name)
            self.assertEqual(done.returncode, 0, done.stderr)
        said = json.loads((self.place / "told/study.json").read_text())
        self.assertGreater(said["fitted"]["told"], 2600)
        off = [r["told_within"] for r in said["responses"]]
        governs = set()
        for is_, told in zip(rows_of(self.place / "judged"), rows_of(self.place / "told")):
            self.assertEqual(is_[1], told[1])
            for x, y, far in zip(is_[6:], told[6:], off):
                self.assertLessEqual(abs(x - y), far + 1e-6 * x, str(is_))
            governs.add("A" if is_[9] > is_[8] else "F")
        self.assertEqual(governs, {"A", "F"})

    def test_what_a_requirement_rejects_is_told(self):
        """and uses of it what the requirement says at the upper end of its band, without what advice keeps back"""
        leaf = self.place / "leaf.xml"
        text = leaf.read_text().replace("  <scene", '  <probe id="turn" kind="angle" on="bar"/>\n'
                                        '  <require probe="turn" measure="peak" min="2.5 deg" scene="push"/>\n  <scene')
        leaf.write_text(text)
        told, said = self.run_study("asked", **FEW)
        rows = [r for r in named_rows(told) if r["why"] != "response surface" and r["state"] == "reject"]
        self.assertGreater(len(rows), 3)
        for r in rows[:3]:
            done = run("check", leaf, "--json", "--corners", "none", "--advice", "none", f"--set=push={r['push']} N", f"--set=width={r['width']} m")
            asked = json.loads(done.stdout)["requirements"][0]
            self.assertAlmostEqual(r["limit_used"], asked["min"] / asked["band"][0], places=9)

    def test_threads_shards_and_attempts_change_no_byte(self):
        one, _ = self.run_study("one", "--jobs", "1", **FEW)
        path = self.study("study", **FEW)
        shards = [self.place / f"shard{i}" for i in (1, 2)]
        for i, out in enumerate(shards, 1):
            self.assertEqual(run("study", path, "-o", out, "--shard", f"{i}/2", "--jobs", "3").returncode, 0)
        merged = self.place / "merged"
        done = run("study", "merge", *shards, "-o", merged)
        self.assertEqual(done.returncode, 0, done.stderr)
        begun = self.place / "begun"
        shutil.copytree(one, begun)
        with sqlite3.connect(begun / "study.sqlite") as store:
            store.execute("DELETE FROM sample WHERE i % 3 = 1")
        done = run("study", path, "-o", begun, "--resume")
        self.assertEqual(done.returncode, 0, done.stderr)
        for other in (merged, begun):
            for name in FILES:
                self.assertEqual((one / name).read_bytes(), (other / name).read_bytes(), f"{other.name}/{name}")

    def test_what_surfaces_know_nothing_of_is_refused(self):
        """what is searched in each device anew, what lies between no two values, devices that cannot be drawn"""
        for what, more, says in (
                ("as made", {"as": "made"}, "since what flows make"),
                ("a list", {"points": "list", "samples": None}, "a list has few points"),
                ("words", {"rows": ROWS.replace('from="7 um" to="9 um" steps="14"', 'values="7 um; 8 um"')}, "lists its own"),
                ("nothing", {"fitted": 0}, "above 0"),
                ("all of it", {"fitted": 0.5}, "what is off by more tells nothing"),
                ("not drawn", {"rows": ROWS.replace('to="9 um"', 'to="900 um"')}, "FW-D660")):
            done = run("study", self.study("refused", **more), "-o", self.place / "refused")
            self.assertEqual(done.returncode, 3, f"{what}: {done.stdout}{done.stderr}")
            self.assertIn(says, done.stderr, what)
            self.assertEqual(done.stderr.count(": error:"), 1, "the first by number, whichever thread comes first")


if __name__ == "__main__":
    unittest.main()
