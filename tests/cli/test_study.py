#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""flexwright study: samples say what check says, in any number of threads, shards and attempts the same bytes."""
import contextlib
import csv
import functools
import json
import math
import os
import pathlib
import re
import resource
import shutil
import signal
import sqlite3
import statistics
import subprocess
import tempfile
import time
import unittest

from common import ALL, GALLERY, PROGRAM, TURNED_LEAF, only_all, run

FLOW = ("--flow", "al-masked-rie")


def flow_of(path):
    """the six-bar is made by several flows; a device without any takes no --flow (FW-D228)"""
    text = path.read_text()
    device = re.search(r'<study [^>]*device="([^"]+)"', text)
    return FLOW if "<flow" in ((path.parent / device[1]).read_text() if device else text) else ()


def study(name, kind, rows, device=GALLERY, **attributes):
    more = "".join(f' {k.replace("_", "-")}="{v}"' for k, v in attributes.items())
    return (f'<study xmlns="urn:flexwright:study:1" name="{name}" kind="{kind}" device="{device}"{more}>\n'
            f'{rows}\n</study>\n')


def few(samples):
    """the usual run draws half as many, but at least the 200 that a probability takes"""
    return samples if ALL else max(200, samples // 2)


ONE_LEAF = """<device xmlns="urn:flexwright:device:1" name="one-leaf">
  <parameter name="push" value="20 uN"/>
  <parameter name="width" value="8 um"/>
  <parameter name="length" value="400 um"/>
  <material ref="silicon-100" thickness="50 um"/>
  <limits safety-factor="2"/>
  <flexure id="leaf" kind="leaf" length="length" width="width"/>
  <mechanism>
    <body id="bar" x="0 mm" y="0.75 mm" width="120 um"/>
    <revolute id="A" a="ground" b="bar" b-y="-0.75 mm" hinge="leaf"/>
  </mechanism>
  <scene name="push" duration="1 ms"><force on="bar" fx="push" law="ramp" rise="0.5 ms"/><air kind="slide" gap="10 um"/></scene>
</device>
"""
# the same with another body at its end, on a leaf of its own
TWO_LEAVES = ONE_LEAF.replace('y="0.75 mm"', 'y="2.25 mm"').replace(
    "    <revolute", '    <body id="base" x="0 mm" y="0.75 mm" width="120 um"/>\n    <revolute id="B" a="ground" b="base" b-y="-0.75 mm" '
    'hinge="first"/>\n    <revolute', 1).replace('a="ground" b="bar"', 'a="base" b="bar" a-y="0.75 mm"').replace(
    '<flexure id="leaf"', '<flexure id="first" kind="leaf" length="400 um" width="8 um"/>\n  <flexure id="leaf"')
# the gap of its spiral is the least space of its mask
ONE_HINGE = """<device xmlns="urn:flexwright:device:1" name="one-hinge">
  <parameter name="gap" value="15 um" min="6 um" max="25 um"/>
  <material ref="silicon-100" thickness="50 um"/>
  <limits safety-factor="2"/>
  <flow ref="al-masked-rie"/>
  <flexure id="c" kind="csfh" length="360 um" angle="220 deg" width="10 um" gap="gap"/>
  <mechanism>
    <body id="lever" x="0 mm" y="0.7 mm" width="120 um"><plate y="0.3 mm" width="150 um" height="1 mm"/></body>
    <revolute id="A" a="ground" b="lever" b-y="-0.7 mm" axis="180 deg" hinge="c"/>
  </mechanism>
  <require frequency="1" plane="in" min="1 Hz"/>
  <scene name="push" duration="60 ms"><torque on="lever" value="30 uN mm" law="ramp" rise="30 ms"/><air kind="slide" gap="10 um"/></scene>
  <die clearance="900 um"/>
</device>
"""
SWEEP = """<vary what="arc" from="200 deg" to="260 deg" steps="4"/>
<vary what="flexure[C]/@width" values="7.5 um; 8 um"/>
<respond name="U" value="governing.utilisation" max="1"/>
<respond name="C" value="hinges[C].utilisation"/>
<respond name="largest" value="hinges[*].utilisation" take="largest"/>
<respond name="f" value="modes:modes[0].f_Hz"/>"""


@functools.cache
def load_at_the_limit():
    """mN of push that use the limit of ONE_LEAF up: where the straight line between two neighbours of a sweep passes 1. That
    samples say what check says is another test's."""
    with tempfile.TemporaryDirectory() as place:
        device, file = pathlib.Path(place, "one.xml"), pathlib.Path(place, "sweep.xml")
        device.write_text(ONE_LEAF)
        file.write_text(study("s", "sweep", '<vary what="push" from="0.18 mN" to="0.19 mN" steps="3"/>'
                              '<respond name="U" value="governing.utilisation"/>', device))
        assert run("study", file, "-o", pathlib.Path(place, "out"), "-q").returncode == 0
        with open(pathlib.Path(place, "out/study.csv"), newline="") as rows:
            points = [(1e3 * float(r["push"]), float(r["U"])) for r in csv.DictReader(rows)]
    (low, below), (high, above) = next((p, q) for p, q in zip(points, points[1:]) if p[1] < 1 <= q[1])
    return low + (high - low) * (1 - below) / (above - below)


class Study(unittest.TestCase):
    def setUp(self):
        self.place = pathlib.Path(tempfile.mkdtemp(prefix="fw-study-"))
        self.addCleanup(shutil.rmtree, self.place)

    def write(self, text, name="study.xml"):
        path = self.place / name
        path.write_text(text)
        return path

    def run_study(self, path, out, *more, status=0):
        done = run("study", path, "-o", self.place / out, *flow_of(path), *more)
        self.assertEqual(done.returncode, status, done.stderr)
        return json.loads((self.place / out / "study.json").read_text()) if status == 0 else done

    def rows(self, out):
        with open(self.place / out / "study.csv", newline="") as file:
            return list(csv.DictReader(file))

    def test_somebody_reads_the_store_while_a_study_begins(self):
        # who looks at the samples keeps a lock while he reads: it is waited for, before the tables and after them
        path = self.write(study("patient", "sweep", SWEEP))
        self.run_study(path, "out")
        store, wanted = self.place / "out/study.sqlite", (self.place / "out/study.csv").read_bytes()
        with contextlib.closing(sqlite3.connect(store, isolation_level=None)) as db:
            self.assertEqual(db.execute("PRAGMA journal_mode = DELETE").fetchone(), ("delete",))
            db.execute("BEGIN")
            self.assertEqual(db.execute("SELECT count(*) FROM sample").fetchone(), (8,))
            with subprocess.Popen([PROGRAM, "study", path, "-o", self.place / "out", *FLOW, "--resume"], text=True,
                                  stdout=subprocess.DEVNULL, stderr=subprocess.PIPE) as resumed:
                with self.assertRaises(subprocess.TimeoutExpired):
                    resumed.wait(timeout=1)
                db.execute("COMMIT")
                self.assertEqual(resumed.wait(timeout=60), 0, resumed.stderr.read())
        self.assertEqual((self.place / "out/study.csv").read_bytes(), wanted)

    def test_as_made_is_one_quantity(self):
        """Strain goes with the torque. What a flow makes of a device is asked whatever the drawing is decided as: of a rejected one the drawn
        share stood in the same column, so that the largest of a range was where the drawing was just accepted. And more load is never judged
        more gently: an undecided drawing of which the flow makes what breaks is rejected."""
        device = self.write(TURNED_LEAF, "turned.xml")
        pushes = [0.14, 0.17, 0.19, 0.2, 0.21, 0.218, 0.222, 0.226, 0.23, 0.235, 0.25]
        self.run_study(self.write(study("s", "sweep", f'<vary what="push" values="{"; ".join(f"{x} mN" for x in pushes)}"/>'
                                        '<respond name="used" value="governing.utilisation"/>', device=device)), "out")
        rows = self.rows("out")
        shares = [float(row["used"]) / x for row, x in zip(rows, pushes)]
        self.assertLess(max(shares) / min(shares), 1.02)
        states = [row["state"] for row in rows]
        self.assertEqual(states, sorted(states, key=["accept", "inconclusive", "reject"].index), states)
        self.assertEqual(set(states), {"accept", "inconclusive", "reject"})
        quick = ("--json", "--advice", "none", "--measurements", "none")
        drawn = [json.loads(run("check", device, "--set", f"push={x} mN", *quick).stdout) for x in pushes[4:]]
        self.assertEqual([d["verdict"] for d in drawn], states[4:])
        self.assertTrue(any(d["drawn"] == "inconclusive" and d["verdict"] == "reject" for d in drawn), [(d["drawn"], d["verdict"]) for d in drawn])

    def test_a_sample_says_what_check_says(self):
        result = self.run_study(self.write(study("s", "sweep", SWEEP).replace("<study", "<study as=\"drawn\"")), "out")
        rows = self.rows("out")
        self.assertEqual(len(rows), 8)
        self.assertEqual(result["samples"]["run"], 8)
        for row in rows:
            settings = ("--set", f"arc={float(row['arc'])!r} rad", "--set",
                        f"flexure[C]/@width={row['flexure[C]/@width']}")
            said = json.loads(run("check", GALLERY, "--json", "--corners", "none", *FLOW, *settings).stdout)
            self.assertAlmostEqual(float(row["U"]) / said["governing"]["utilisation"], 1, places=9)
            self.assertEqual(row["state"], said["verdict"])
            self.assertEqual(float(row["largest"]), max(float(row["U"]), float(row["largest"])))
        names = {r["name"]: r for r in result["responses"]}
        self.assertEqual(names["U"]["largest"], max(float(r["U"]) for r in rows))
        self.assertEqual(names["f"]["unit"], "Hz")
        with sqlite3.connect(self.place / "out/study.sqlite") as store:
            asked = store.execute('SELECT count(*), max("U") FROM sample WHERE state = ?', ("accept",)).fetchone()
        self.assertEqual(asked, (sum(r["state"] == "accept" for r in rows), names["U"]["largest"]))

    def test_pictures_have_the_listed_values_at_their_axes(self):
        """where there were numbers of the list, 0, 0.5 and 1; and a response that differs in its last bits alone is drawn"""
        rows = ('<vary what="flexure[C]/@width" values="7.5 um; 8.25 um; 9 um"/><vary what="arc" from="200 deg" to="260 deg" steps="2"/>'
                '<respond name="U" value="hinges[C].utilisation"/><respond name="F" value="hinges[F].peak_angle_rad"/>')
        self.run_study(self.write(study("s", "sweep", rows).replace("<study", '<study as="hinges"')), "out")
        for name in ("map-U", "U-flexure-C---width", "parallel"):
            texts = re.findall(r"<text [^>]*>([^<]*)</text>", (self.place / f"out/pictures/{name}.svg").read_text())
            self.assertTrue({"7.5 um", "9 um"} <= set(texts), (name, texts))
            self.assertEqual("8.25 um" in texts, name != "parallel", (name, texts))
            self.assertNotIn("of the list", " ".join(texts))
            self.assertFalse({"0.5", "1.5"} & set(texts), (name, texts))

    def bytes_of(self, out):
        return {p.name: p.read_bytes() for p in sorted((self.place / out).rglob("*")) if p.is_file()}

    def test_threads_shards_and_attempts_change_no_byte(self):
        path = self.write(study("s", "sweep", SWEEP).replace("<study", '<study as="drawn" points="grid"'))
        self.run_study(path, "one", "--jobs", 1)
        wanted = self.bytes_of("one")
        self.run_study(path, "three", "--jobs", 3)
        self.assertEqual(self.bytes_of("three"), wanted)
        for i in (1, 2, 3):
            done = run("study", path, "-o", self.place / f"shard{i}", *FLOW, "--shard", f"{i}/3")
            self.assertEqual(done.returncode, 0, done.stderr)
        merge = ["study", "merge", *(self.place / f"shard{i}" for i in (3, 1, 2)), "-o", self.place / "merged", *FLOW]
        done = run(*merge)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.bytes_of("merged"), wanted)
        self.assertEqual([p.name for p in (self.place / "shard1").iterdir()], ["study.sqlite"])
        for wrong, says in ((merge[:3] + merge[5:], "shard 3 of 3, and 1 directories"),
                            (merge[:3] + merge[2:3] + merge[4:], "named twice"),
                            (merge + ["--accuracy", "1e-4"], "than " + str(path) + " is now; now there is --accuracy 0.0001; merge takes"),
                            (merge + ["--set", "arc=235 deg"], "; now there is --set arc=235 deg; merge takes"),
                            (merge + ["--lab", self.lab()], "lab.xml is read now and was not then; merge takes"),
                            (["study", "merge", self.place, "-o", self.place / "m"], "no store of a study")):
            done = run(*wrong)
            self.assertEqual(done.returncode, 3, done.stderr)
            self.assertIn(says, done.stderr)
            self.assertIn("FW-D497", done.stderr)

    def lab(self):
        return self.write('<process xmlns="urn:flexwright:process:1" flow="al-masked-rie"><source id="lab">measured</source>'
                          '<q id="rie.R" value="0.5" u="0.01" unit="um/min" status="measured" src="lab"/></process>', "lab.xml")

    def test_a_merge_says_what_differs(self):
        path = self.write(study("s", "sweep", SWEEP).replace("<study", '<study as="drawn" points="grid"'))
        lab = self.lab()
        done = run("study", path, "-o", self.place / "shard1", *FLOW, "--shard", "1/1", "--lab", lab)
        self.assertEqual(done.returncode, 0, done.stderr)
        merge = ["study", "merge", self.place / "shard1", "-o", self.place / "merged", *FLOW]
        done = run(*merge)
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("lab.xml was read then and is not now (the same --lab", done.stderr)
        self.assertFalse((self.place / "merged").exists())  # nothing is left of what failed
        lab.write_text(lab.read_text().replace("0.01", "0.02"))
        done = run(*merge, "--lab", lab)
        self.assertIn("lab.xml was another file; merge takes", done.stderr)
        self.lab()
        path.write_text(path.read_text().replace('<respond name="f"', '<respond name="f1"'))
        self.assertIn("; it was asked for something else (inputs,", run(*merge, "--lab", lab).stderr)

    def test_derivatives_elsewhere_than_the_description_are_said(self):
        rows = ('<vary what="arc" from="242 deg" to="250 deg"/><vary what="flexure[C]/@width" from="7.5 um" to="8.5 um"/>'
                '<respond name="U" value="hinges[C].utilisation"/>')
        path = self.write(study("s", "sensitivity", rows, samples=128).replace("<study", '<study as="hinges"'))
        done = run("study", path, "-o", self.place / "s", *FLOW)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("'arc': the description has another value than its range", done.stderr)
        self.assertIn("FW-D649", done.stderr)
        words = "derivatives are taken at arc = 246 deg, the middle of its range: the description has 240 deg, outside of it"
        self.assertIn(words, done.stdout)
        self.assertIn(words, (self.place / "s/study.html").read_text())
        self.assertIn("derivatives are taken at flexure[C]/@width = 8 um, the middle of its range: it is no parameter", done.stdout)
        by = json.loads((self.place / "s/study.json").read_text())["responses"][0]["by"]
        self.assertAlmostEqual(by[0]["at_SI"], math.radians(246), delta=1e-6)
        self.assertEqual([d["at_description"] for d in by], [False, False])
        for d, half in zip(by, (math.radians(4), 0.5e-6)):
            self.assertAlmostEqual(d["half_range_effect"] / (d["derivative_SI"] * half), 1, 9)
        inside = self.write(path.read_text().replace("242 deg", "232 deg"), "inside.xml")
        done = run("study", inside, "--plan", *FLOW)
        self.assertNotIn("FW-D649", done.stderr)

    def test_killed_and_interrupted_studies_go_on(self):
        path = self.write(study("s", "sweep", SWEEP.replace('steps="4"', 'steps="30"')).replace(
            "<study", '<study as="drawn"'))
        self.run_study(path, "whole", "--jobs", 1)
        for number, out in ((signal.SIGKILL, "killed"), (signal.SIGINT, "interrupted")):
            child = subprocess.Popen([PROGRAM, "study", path, "-o", self.place / out, *FLOW, "--jobs", "1"],
                                     stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            store = self.place / out / "study.sqlite"
            for _ in range(6000):
                time.sleep(0.005)
                child.send_signal(signal.SIGSTOP)  # while somebody looks: a busy machine may look late
                try:
                    with sqlite3.connect(store, timeout=0) as db:
                        if db.execute("SELECT count(*) FROM sample").fetchone()[0] > 3:
                            break
                except sqlite3.Error:
                    pass
                child.send_signal(signal.SIGCONT)
            child.send_signal(number)
            child.send_signal(signal.SIGCONT)
            child.wait()
            self.assertEqual(child.returncode, -9 if number == signal.SIGKILL else 130)
            with sqlite3.connect(store) as db:
                done = db.execute("SELECT count(*) FROM sample").fetchone()[0]
            self.assertTrue(3 < done < 60, done)
            self.run_study(path, out, "--resume")
            self.assertEqual(self.bytes_of(out), self.bytes_of("whole"))

    def test_a_store_of_another_study_is_left_alone(self):
        first = self.write(study("s", "sweep", SWEEP).replace("<study", '<study as="drawn"'))
        self.run_study(first, "out")
        before = self.bytes_of("out")
        other = self.write(study("t", "sweep", SWEEP).replace("<study", '<study as="drawn"'), "other.xml")
        done = self.run_study(other, "out", "--resume", status=3)
        self.assertIn("FW-D495", done.stderr)
        self.assertEqual(self.bytes_of("out"), before)
        (self.place / "mine").mkdir()
        (self.place / "mine/study.sqlite").write_text("notes")
        done = run("study", first, "-o", self.place / "mine", *FLOW)
        self.assertEqual(done.returncode, 3)
        self.assertIn("FW-D496", done.stderr)
        self.assertEqual((self.place / "mine/study.sqlite").read_text(), "notes")

    def test_samples_are_given_up_with_a_word_and_those_of_another_study_not_at_all(self):
        path = self.write(study("s", "sweep", SWEEP).replace("<study", '<study as="drawn"'))
        part = lambda path, *more: run("study", path, "-o", self.place / "part", *FLOW, *more)
        self.assertEqual(part(path, "--shard", "1/2").stderr, "")
        with contextlib.closing(sqlite3.connect(self.place / "part/study.sqlite")) as db:
            held = db.execute("SELECT count(*) FROM sample").fetchone()[0]
        self.assertGreater(held, 0)
        again = part(path, "--shard", "1/2")
        self.assertRegex(again.stderr, r"the %d samples of study 's' .* --resume would have gone on with them \[FW-D745\]" % held)
        again = part(path, "--accuracy", "2e-3")
        self.assertRegex(again.stderr, r"the %d samples of study 's' .* of other inputs or options.* \[FW-D745\]" % held)
        self.assertEqual(again.returncode, 0)
        self.assertEqual(part(path).stderr, "")  # its results are there, and come again
        other = self.write(study("t", "sweep", SWEEP).replace("<study", '<study as="drawn"'), "other.xml")
        before = self.bytes_of("part")
        done = part(other)
        self.assertEqual(done.returncode, 3)
        self.assertRegex(done.stderr, r"it holds \d+ samples of study 's' .* and this is study 't' .*\[FW-D743\]")
        self.assertEqual(self.bytes_of("part"), before)

    def test_what_cannot_be_kept_is_said_and_nothing_is_torn(self):
        path = self.write(study("s", "sweep", SWEEP.replace('steps="4"', 'steps="40"')).replace(
            "<study", '<study as="drawn"'))
        done = run("study", path, "-o", self.place / "full", *FLOW,
                   preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (24576, 24576)))
        self.assertEqual(done.returncode, 5, done.stderr)
        self.assertIn("FW-D496", done.stderr)
        done = run("study", path, "-o", self.place / "full", *FLOW, "--resume")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(len(self.rows("full")), 80)

    def test_devices_that_cannot_be_judged_are_counted(self):
        rows = ('<vary what="arc" values="200 deg; 240 deg"/><vary what="flexure[C]/@width" values="8 um; 300 um"/>'
                '<respond name="U" value="governing.utilisation"/>')
        result = self.run_study(self.write(study("s", "sweep", rows).replace("<study", '<study as="drawn"')), "out")
        self.assertEqual(result["samples"]["run"], 2)
        self.assertEqual(result["samples"]["failed"], 2)
        self.assertTrue(result["samples"]["example_why"])
        failed = [r for r in self.rows("out") if r["state"] == "failed"]
        self.assertEqual([r["flexure[C]/@width"] for r in failed], ["300 um"] * 2)
        self.assertTrue(all(r["why"] and not r["U"] for r in failed))

    def test_devices_without_a_value_are_told_beside_the_ends_of_the_others(self):
        """a leaf that is too stout for its formulas is not judged: with it at the end of a range, that the others have a largest value is
        not the worst case"""
        path = self.write(ONE_LEAF, "one.xml")
        rows = ('<vary what="width" from="8 um" to="120 um"/><respond name="U" value="governing.utilisation" {}/>')
        for kind, goal, more in (("worst-case", "", {"samples": 3}), ("size", 'goal="minimise"', {"samples": 20}),
                                 ("sensitivity", "", {"samples": 128})):
            file = self.write(study("s", kind, rows.format(goal), path, **{"as": "drawn" if goal else "hinges"}, **more))
            done = run("study", file, "-o", self.place / kind)
            self.assertEqual(done.returncode, 0, done.stderr)
            result = json.loads((self.place / kind / "study.json").read_text())
            samples, response = result["samples"], result["responses"][0]
            devices, without = samples["run"] + samples["failed"], response["without"]
            self.assertGreater(without["failed"], 0)
            self.assertEqual(without["devices"], devices - response["values"])
            self.assertEqual(without["devices"], sum(without[k] for k in ("accepted", "rejected", "inconclusive", "failed")))
            first = next(r for r in self.rows(kind) if r["U"] == "")
            self.assertEqual((without["first_at"], without["first_state"]), (int(first["i"]), first["state"]))
            self.assertAlmostEqual(float(without["set"][0]["value"].split()[0]), 1e6 * float(first["width"]), delta=1e-6)
            told = (f"{without['devices']} of {devices} devices have no value of U: {without['failed']} could not be judged; number "
                    f"{first['i']} (failed) is the first of them: --set \"width={without['set'][0]['value']}\"")
            self.assertIn(told, done.stdout)
            self.assertIn(told.replace('"', "&quot;"), (self.place / kind / "study.html").read_text())
            if kind == "worst-case":
                self.assertRegex(done.stdout, rf"U +largest of the {response['values']} that have one ")
                self.assertNotIn("found", done.stdout)
                self.assertEqual(without["set"], [{"path": "width", "value": "120 um"}])  # its corner
            if kind == "sensitivity":
                self.assertLess(response["index_groups"], response["index_groups_of"])
                self.assertIn(f"of the {response['index_groups']} of {response['index_groups_of']} groups", done.stdout)

    def test_hinges_alone_are_said(self):
        """in a directory that is made with those above it"""
        rows = ('<vary what="arc" values="230 deg; 240 deg"/>'
                '<respond name="U" value="governing.utilisation"/>')
        file, place = self.write(study("alone", "sweep", rows, **{"as": "hinges"})), self.place / "further/down/alone"
        plan = run("study", file, "--plan", *FLOW)
        self.assertIn("nothing of clearances", plan.stdout)
        done = run("study", file, "-o", place, *FLOW)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("of hinges and requirements as drawn alone", done.stdout)
        self.assertIn("of hinges and requirements as drawn alone", (place / "study.html").read_text())
        self.assertEqual(json.loads((place / "study.json").read_text())["judged_as"], "hinges")

    def test_mistakes_are_said_at_their_places(self):
        vary = '<vary what="arc" from="200 deg" to="260 deg"/>'
        respond = '<respond name="U" value="governing.utilisation"/>'
        ends = '<uncertain what="link" mean="130 um" sd="1 um"/>' + "".join(
            f'<uncertain what="flexure[{h}]/@{what}" spread="interval" from="{low} um" to="{high} um"/>'
            for h in "ABCDEF" for what, low, high in (("width", 7, 8), ("gap", 9, 10)))
        cases = (
            ("sweep", vary.replace("260", "160") + respond, "FW-D490", "from must be below to"),
            ("sweep", vary.replace("260 deg", "260 um") + respond, "FW-D025", ""),
            ("sweep", vary.replace("arc", "ark") + respond, "FW-D493", "no parameter has this name"),
            ("sweep", vary.replace("260", "900") + respond, "FW-D493", "allows at most 260 deg"),
            ("sweep", vary + respond.replace("utilisation", "utilization"), "FW-D492", "utilisation_band"),
            ("sweep", vary + respond.replace("governing", "hinges[Q]"), "FW-D492", "it has A B C D E F"),
            ("sweep", vary + respond.replace("governing.", "hinges[*]."), "FW-D492", "take="),
            ("sweep", vary + respond.replace("governing", "masses:x"), "FW-D492", "no document 'masses'; there are verdict, simulate, statics, modes, workspace, masks and recipes"),
            ("sweep", vary + respond.replace("governing.", "mask."), "FW-D492", "masks: recipes:"),
            ("sweep\" as=\"hinges", vary + respond.replace("governing.utilisation", "clearances[0].clearance_m"), "FW-D576",
             "about something else"),
            ("size\" as=\"hinges", vary + respond.replace("/>", ' goal="minimise"/>'), "FW-D490", "hinges alone do not say"),
            ("sweep", vary, "FW-D490", "nothing is asked"),
            ("sweep", respond, "FW-D490", "at least one &lt;vary&gt;"),
            ("worst-case", respond, "FW-D490", 'write kind="sweep" as="die" points="sobol" samples="200" without'),
            ("size", vary + respond, "FW-D490", "goal="),
            ("sweep", vary + vary + respond, "FW-D490", "two rows"),
            ("sweep", vary + respond.replace('"U"', '"arc"'), "FW-D492", "another column"),
            ("yield", vary, "FW-D490", "chooses nothing"),
            ("sweep\" yield=\"0.9", vary + respond, "FW-D490", "wanted of a size"),
            ("size\" yield=\"0.9", vary + respond.replace("/>", ' goal="minimise"/>')
             + '<uncertain what="arc" mean="240 deg" sd="1 deg"/>', "FW-D491", "from what is chosen"),
            ("size\" yield=\"0.9", vary + respond.replace("/>", ' goal="minimise"/>') + '<uncertain what="arc" sd="1 um"/>',
             "FW-D491", "same dimension"),
            ("size\" yield=\"0.9", vary + respond.replace("/>", ' goal="minimise"/>')
             + '<uncertain what="ark" mean="1 um" sd="1 um"/>', "FW-D493", "no parameter has this name"),
            ("yield", respond, "FW-D490", "give it min or max"),
            ("yield\" as=\"drawn", "", "FW-D490", "as they are made; take as"),
            ("sweep", vary + respond + '<uncertain what="link" mean="120 um" sd="1 um"/>', "FW-D490", "belongs to kind"),
            ("yield", '<uncertain what="arc" spread="normal" mean="240 deg" sd="0 deg"/>', "FW-D491", "above 0"),
            ("yield", '<uncertain what="arc" spread="uniform" mean="240 deg"/>', "FW-D491", "uniform"),
            ("yield", '<uncertain what="arc" level="hinge" mean="240 deg" sd="1 deg"/>', "FW-D556", "flexure[*]/@width"),
            ("yield", '<uncertain what="arc" mean="240 deg" sd="1 deg"/><uncertain what="arc" sd="2 deg"/>', "FW-D556",
             "different levels"),
            ("yield", '<uncertain what="arc" level="lot" mean="240 deg" sd="1 deg"/><uncertain what="arc" level="wafer" '
             'mean="240 deg" sd="2 deg"/>', "FW-D491", "deviation"),
            ("yield", '<uncertain what="thickness" flow="al-masked-rie" level="wafer" sd="1 deg"/>', "FW-D556", "is in um"),
            ("yield", '<uncertain what="thicknes" flow="al-masked-rie" sd="1 um"/>', "FW-D556", "edge of the aluminium"),
            ("yield", '<uncertain what="thickness" flow="rie" sd="1 um"/>', "FW-D556", "names no flow"),
            ("yield", '<uncertain what="arc" mean="240 deg" sd="1 deg"/><trend what="arc" radial="1 deg"/>', "FW-D557",
             "wafer diameter"),
            ("yield", '<trend what="arc"/>', "FW-D557", "radial="),
            ("yield", '<uncertain what="arc" level="lot" spread="interval" from="230 deg" to="240 deg"/>', "FW-D556", "interval"),
            ("sweep", vary + respond + '<trend what="arc" radial="1 deg"/>', "FW-D490", "belongs to kind"),
            ("sweep", vary + respond + '<correlation of="arc" with="link" value="0.5"/>', "FW-D490", "belongs to kind"),
            ("yield", '<uncertain what="arc" mean="240 deg" sd="1 deg"/><correlation of="arc" with="link" value="0.5"/>',
             "FW-D589", "has no &lt;uncertain&gt;"),
            ("yield", '<correlation of="thickness" with="thicknes" flow="al-masked-rie" value="0.5"/>', "FW-D589",
             "called 'thicknes'"),
            ("yield", '<uncertain what="arc" mean="240 deg" sd="1 deg"/><uncertain what="link" mean="130 um" sd="1 um"/>'
             '<correlation of="arc" with="link" value="1.5"/>', "FW-D047", ""),
            ("yield", '<uncertain what="arc" mean="240 deg" sd="1 deg"/><uncertain what="link" level="wafer" mean="130 um" '
             'sd="1 um"/><correlation of="arc" with="link" value="0.5"/>', "FW-D589", "level"),
            ("yield", '<uncertain what="arc" spread="table" table="230 deg 0; 240 um 1"/>', "FW-D491", "240 um 1"),
            ("yield", '<uncertain what="arc" spread="table" table="230 deg 0; 220 deg 1"/>', "FW-D491", "rise"),
            ("yield", '<uncertain what="arc" spread="table" table="230 deg 0.1; 240 deg 1"/>', "FW-D491", "0 to 1"),
            ("yield", '<uncertain what="arc" spread="table"/>', "FW-D491", "needs table"),
            ("yield", '<uncertain what="arc" table="230 deg 0; 240 deg 1" mean="240 deg" sd="1 deg"/>', "FW-D491", "belongs to"),
            ("sweeep", vary + respond, "FW-D048", "sweep"),
            # limits were turned to SI where the number is in another unit, and of another kind they were taken
            ("sweep", vary + respond.replace("/>", ' max="5 kg"/>'), "FW-D025", "max is given as a mass, and the number has no unit"),
            ("sweep", vary + respond.replace("governing.utilisation", "modes:modes[0].f_Hz").replace("/>", ' min="10 um"/>'), "FW-D025",
             "min is given as a length, and the number is in Hz"),
            ("sweep", vary + respond.replace("governing.utilisation", "masks:masks[0].layers[0].area_um2").replace("/>", ' max="3 um"/>'),
             "FW-D025", "the number is in um2"),
            ("sweep", vary + respond.replace("governing.utilisation", "hinges[A].peak_angle_rad").replace("/>", ' min="1 deg" max="3"/>'),
             "FW-D024", ""),
            ("yield", '<uncertain what="arc" mean="20 Cel" sd="5 Cel"/>', "FW-D491", "write it in K"),
            # of these a store was left behind, and the first ran all derivatives before it was refused
            ("sensitivity\" samples=\"32", vary + respond, "FW-D490", "at least 128 rows"),
            ("sensitivity", '<vary what="arc" values="200 deg; 230 deg"/>' + respond, "FW-D490", "a derivative is by a number"),
            ("sweep", vary.replace("/>", ' steps="1001"/>') + '<vary what="link" from="120 um" to="140 um" steps="100000"/>' + respond,
             "FW-D490", "the grid has more than"),
            ("sweep\" points=\"list", '<vary what="arc" values="200 deg; 230 deg"/><vary what="link" values="120 um; 125 um; 130 um"/>'
             + respond, "FW-D490", "give each as many"),
            ("yield\" samples=\"100", '<uncertain what="arc" mean="240 deg" sd="1 deg"/>', "FW-D490", "at least 200 evaluations"),
            ("yield", ends, "FW-D490", "of at most 10 are looked at"),
            ("size\" yield=\"0.9", vary + respond.replace("/>", ' goal="minimise"/>') + ends, "FW-D490",
             "of at most 10 are looked at"),
        )
        for kind, rows, code, says in cases:
            done = run("study", self.write(study("s", kind, rows)), "-o", self.place / "bad", *FLOW)
            self.assertEqual(done.returncode, 3, (rows, done.stderr))
            self.assertIn(code, done.stderr)
            self.assertIn(says.replace("&lt;", "<").replace("&gt;", ">"), done.stderr)
            self.assertRegex(done.stderr, r"study\.xml:\d+:\d+: error")
            self.assertFalse((self.place / "bad").exists(), rows)

    def test_limits_hold_in_whatever_unit_they_are_stated(self):
        """of a key in um and in um2, in rad, and of a number whose unit stands beside it"""
        path = self.write(ONE_HINGE, "hinge.xml")
        layer = "masks:masks[0].layers[0]"
        rows = (f'<vary what="gap" from="6 um" to="25 um"/><respond name="area" value="{layer}.area_um2" goal="minimise"/>'
                f'<respond name="space" value="{layer}.min_space_um" min="{{}}"/>')
        found = {}
        for name, least in (("um", "12 um"), ("mm", "0.012 mm"), ("bare", "12")):
            self.run_study(self.write(study("s", "size", rows.format(least), path, samples=20, **{"as": "drawn"})), name)
            result = json.loads((self.place / name / "study.json").read_text())
            found[name] = result["found"][0]["set"]
            at = {r["name"]: r["value"] for r in result["found"][0]["responses"]}
            self.assertGreaterEqual(at["space"], 12)
            self.assertLess(at["space"], 12.1)
            self.assertAlmostEqual(result["responses"][1]["min"], 12, places=9)
        self.assertEqual(found["um"], found["bare"])
        self.assertEqual(found["mm"], found["bare"])
        asked = {"masks:masks[0].layers[0].area_um2": ("max", "3.7 mm^2", "at most 3.7e+06 um2"),
                 "hinges[A].peak_angle_rad": ("max", "1 deg", "at most 0.017453 rad"),
                 "requirements[frequency-1].value": ("min", "0.2 kHz", "at least 200 Hz"),
                 "governing.utilisation": ("max", "80 %", "at most 80 %")}
        for value, (end, limit, says) in asked.items():
            file = self.write(study("s", "sweep", '<vary what="gap" from="6 um" to="25 um"/>'
                                    f'<respond name="r" value="{value}" {end}="{limit}"/>', path, **{"as": "drawn"}))
            plan = run("study", file, "--plan")
            self.assertEqual(plan.returncode, 0, plan.stderr)
            self.assertIn(says, plan.stdout)
        wrong = self.write(study("s", "sweep", '<vary what="gap" from="6 um" to="25 um"/><respond name="r" '
                                 'value="requirements[frequency-1].value" min="10 um"/>', path, **{"as": "drawn"}))
        done = run("study", wrong, "--plan")
        self.assertEqual(done.returncode, 3)
        self.assertIn("min is given as a length, and the number is in Hz", done.stderr)

    def test_where_no_device_can_be_judged_the_exit_status_says_it(self):
        """a hinge that a plate covers is not drawn"""
        path = self.write(ONE_LEAF, "one.xml")
        for kind in ("sweep", "worst-case"):
            rows = ('<vary what="width" from="900 um" to="990 um"/><respond name="U" value="governing.utilisation"/>'
                    '<respond name="turned" value="hinges[A].peak_angle_rad"/>')
            done = run("study", self.write(study("s", kind, rows, path, **{"as": "hinges"})), "-o", self.place / kind)
            self.assertEqual(done.returncode, 4, done.stderr)
            self.assertIn("devices could be judged (number 0", done.stderr)
            self.assertIn("FW-D498", done.stderr)
            self.assertNotIn("number -1", done.stdout)
            self.assertEqual(len(re.findall(r"^  (?:U|turned) .*no value[^\n]*$", done.stdout, re.M)), 2 if kind == "sweep" else 4)

    def test_that_a_rejected_device_has_no_masks_is_said(self):
        path = self.write(ONE_HINGE.replace('min="1 Hz"', 'min="1 MHz"'), "rejected.xml")
        rows = ('<vary what="gap" from="6 um" to="25 um"/><respond name="area" value="masks:masks[0].layers[0].area_um2"/>')
        done = run("study", self.write(study("s", "sweep", rows, path, **{"as": "drawn"})), "--plan")
        self.assertEqual(done.returncode, 3)
        self.assertIn("there are no masks and recipes, since check rejects the description as it stands", done.stderr)

    def test_what_has_no_effect_is_told(self):
        path = self.write(ONE_LEAF, "one.xml")
        ask = '<respond name="U" value="governing.utilisation"/>'
        width = '<vary what="width" from="7 um" to="9 um"{}/>'
        direct = '<vary what="flexure[leaf]/@width" from="7 um" to="9 um" steps="2"/>'
        for more, rows, says in (
                ({}, width.format(' steps="2"') + direct, '<vary what="width"> has no effect'),
                ({"points": "sobol", "samples": 4}, width.format(' steps="2"'), 'steps="..." has no effect'),
                ({"samples": 3}, width.format(' steps="5"'), 'samples="..." has no effect'),
                ({"confidence": 0.9}, width.format(""), 'confidence="..." has no effect'),
                ({"seed": 7}, width.format(' steps="2"'), 'seed="..." has no effect'),
                ({"seed": 7, "points": "sobol", "samples": 4}, width.format(""), None),
                ({}, width.format(' steps="2"') + direct.replace("@width", "@length").replace("7 um", "300 um").replace("9 um", "400 um"), None),
                ({"points": "sobol", "samples": 4}, width.format(""), None)):
            done = run("study", self.write(study("s", "sweep", rows + ask, path, **{"as": "hinges"}, **more)), "--plan")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual("FW-D737" in done.stderr, says is not None, done.stderr)
            self.assertIn(says or "", done.stderr)

    def test_of_two_uncertain_the_one_without_effect_is_told(self):
        path = self.write(ONE_LEAF, "one.xml")
        width = '<uncertain what="width" mean="8 um" sd="0.3 um"/>'
        direct = '<uncertain what="flexure[leaf]/@{}" mean="{} um" sd="0.3 um"/>'
        for other, told in (("width", True), ("length", False)):
            rows = width + direct.format(other, 8 if told else 400)
            done = run("study", self.write(study("s", "yield", rows, path, samples=200)), "--plan")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual('<uncertain what="width"> has no effect' in done.stderr, told, done.stderr)

    def test_what_differs_beyond_a_parameter_is_told_beforehand_and_of_each_device(self):
        """devices there were not judged, without a word why or that there would be some"""
        path = self.write(ONE_LEAF.replace('value="20 uN"', 'value="20 uN" min="16 uN" max="21 uN"'), "one.xml")
        row = '<uncertain what="push" {}/>'
        for spread, share in (('mean="20 uN" sd="1 uN"', "0.16"), ('mean="20 uN" sd="0.8 uN"/><uncertain what="push" level="wafer" sd="0.6 uN"', "0.16"),
                              ('spread="lognormal" mean="20 uN" sd="2 uN"', "0.3"), ('spread="interval" from="17 uN" to="22 uN"', "a part"),
                              ('mean="20 uN" sd="0.1 uN"', None), ('spread="truncated" mean="20 uN" sd="1 uN" from="17 uN" to="21 uN"', None)):
            width = '<uncertain what="width" mean="8 um" sd="0.1 um"/>'
            file = self.write(study("y", "yield", row.format(spread) + width, path, samples=200))
            done = run("study", file, "--plan")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual("FW-D738" in done.stderr, share is not None, done.stderr)
            if share: self.assertIn(share, done.stderr)
        file = self.write(study("y", "yield", row.format('mean="20 uN" sd="1 uN"'), path, samples=200))
        done = run("study", file, "-o", self.place / "beyond")
        self.assertEqual(done.returncode, 0, done.stderr)
        lost = [r for r in self.rows("beyond") if r["state"] == "failed"]
        self.assertGreater(len(lost), 10)
        for r in lost: self.assertRegex(r["why"], "parameter 'push' is .*; its declaration allows at most 21 uN")
        self.assertRegex(done.stdout, "could not be judged \\(number [0-9]+: parameter 'push' is")

    def test_of_a_row_that_is_refused_nothing_else_is_said(self):
        """it may be what the kind needs"""
        rows = '<vary what="arc" from="200 deg" to="260 deg"/><respond name="a b" value="governing.utilisation"{}/>'
        for kind, goal in (("sweep", ""), ("size", ' goal="minimise"')):
            done = run("study", self.write(study("s", kind, rows.format(goal))), "--plan", *FLOW)
            self.assertEqual(done.returncode, 3)
            self.assertEqual(re.findall("FW-D[0-9]+", done.stderr), ["FW-D044"], done.stderr)

    def test_what_looks_back_has_no_shards(self):
        rows = '<vary what="arc" from="200 deg" to="260 deg"/><respond name="U" value="governing.utilisation" goal="minimise"/>'
        done = run("study", self.write(study("s", "size", rows)), *FLOW, "--shard", "1/2", "-o", self.place / "o")
        self.assertEqual(done.returncode, 3)
        self.assertIn("run it in one piece", done.stderr)
        self.assertIn("a study on each with a part of the ranges", " ".join(done.stderr.split()))

    def test_shards_of_yields_and_worst_cases_are_the_bytes_of_one_machine(self):
        path = self.write(ONE_LEAF, "one.xml")
        load = '<uncertain what="push" mean="0.17 mN" sd="0.02 mN"/><uncertain what="width" mean="8 um" sd="0.1 um"/>'
        range_of = '<vary what="push" from="10 uN" to="40 uN"/><respond name="U" value="governing.utilisation"/>'
        # of 3000 the first choose how the rest is looked at
        for kind, rows, more in (("yield", load, {"samples": 3000 if ALL else 200}), ("worst-case", range_of, {"samples": 4})):
            file = self.write(study("s", kind, rows, path, **more, **({"as": "drawn"} if kind != "yield" else {})))
            self.run_study(file, f"{kind}-one")
            shards = [self.place / f"{kind}-{i}" for i in (1, 2)]
            for i, out in enumerate(shards, 1):
                self.assertEqual(run("study", file, "-o", out, "--shard", f"{i}/2").returncode, 0)
            missing = run("study", "merge", shards[0], shards[0], "-o", self.place / "twice")
            self.assertEqual(missing.returncode, 3)
            merged = run("study", "merge", *shards, "-o", self.place / f"{kind}-merged")
            self.assertEqual(merged.returncode, 0, merged.stderr)
            self.assertEqual(self.bytes_of(f"{kind}-merged"), self.bytes_of(f"{kind}-one"))
            counts = [sqlite3.connect(out / "study.sqlite").execute("SELECT count(*) FROM sample").fetchone()[0]
                      for out in (*shards, self.place / f"{kind}-one")]
            self.assertLess(max(counts[:2]), counts[2])

    def test_a_ridge_is_followed_to_the_ends_of_other_inputs(self):
        """what is used peaks over a, as over the frequency of a drive, and rises with all others: their ends are worst"""
        text = ONE_LEAF.replace('<parameter name="width"', '<parameter name="a" value="0.2"/>\n  <parameter name="width"').replace(
            'fx="push"', 'fx="push/(1 + ((a - 0.63)/0.02)^2)"')
        inputs = (("push", "2 uN", "20 uN"), ("limits/@safety-factor", "1.5", "2.5"), ("length", "350 um", "450 um"))
        for n in (1, 3):
            rows = '<vary what="a" from="0" to="1"/>' + "".join(
                f'<vary what="{what}" from="{low}" to="{high}"/>' for what, low, high in inputs[:n])
            rows += ('<respond name="used" value="hinges[A].utilisation"/>'
                     '<respond name="turned" value="hinges[A].peak_angle_rad"/>')
            file = self.write(study("s", "worst-case", rows, self.write(text, "ridge.xml"), **{"as": "hinges"}))
            used, turned = self.run_study(file, f"ridge-{n}")["responses"]
            self.assertEqual([s["value"] for s in used["worst_largest"]["set"]][1:], [high for what, low, high in inputs[:n]])
            self.assertIn("20 uN", [s["value"] for s in turned["worst_least"]["set"]])
            # of all devices, whatever search came to them
            for r in (used, turned):
                self.assertEqual([r["worst_least"]["value"], r["worst_largest"]["value"]], [r["least"], r["largest"]])
            # and at its end it is what check says
            at = [f"--set={s['path']}={s['value']}" for s in used["worst_largest"]["set"]]
            said = json.loads(run("check", self.place / "ridge.xml", "--json", "--corners", "none", "--advice", "none", *at).stdout)
            self.assertAlmostEqual(said["hinges"][0]["utilisation"], used["worst_largest"]["value"], places=12)
        done = run("study", file, "-o", self.place / "again")
        self.assertIn("largest found", done.stdout)
        self.assertIn("that none lies beyond it where none was", " ".join(done.stdout.split()))

    def test_a_plan_says_how_many_and_writes_nothing(self):
        path = self.write(study("s", "sweep", SWEEP).replace("<study", '<study as="drawn"'))
        done = run("study", path, "--plan", *FLOW)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("8 devices", done.stdout)
        self.assertEqual([p.name for p in self.place.iterdir()], ["study.xml"])

    def test_a_plan_of_a_size_at_a_wanted_yield_counts_dies(self):
        """most of its time is theirs"""
        rows = ('<vary what="push" from="0.11 mN" to="0.19 mN"/><uncertain what="push" sd="0.01 mN"/>'
                '<respond name="turned" value="hinges[A].peak_angle_rad" goal="minimise"/>')
        text = study("s", "size", rows, self.write(ONE_LEAF, "one.xml"), samples=6, **{"as": "drawn", "yield": 0.9})
        done = run("study", self.write(text), "--plan")
        dies = re.search(r"at most 6 devices and some (\d+) dies in ", done.stdout)
        self.assertTrue(dies, done.stdout)
        self.assertGreater(int(dies[1]), 700)  # three first estimates, and one whole
        self.assertLess(int(dies[1]), 3000)

    def test_a_plan_of_a_yield_counts_all_of_its_estimates(self):
        """as computed and with the limit moved either way; where dies are merely counted all three have the same ones"""
        path = self.write(ONE_LEAF, "one.xml")
        file = self.write(study("s", "yield", '<uncertain what="push" mean="0.15 mN" sd="0.01 mN"/>', path, samples=400))
        done = run("study", file, "--plan")
        self.assertEqual(done.returncode, 0, done.stderr)
        said = re.search(r"(\d+) devices where they are merely counted, about .*; at most (\d+), .*about .*one took", done.stdout)
        self.assertTrue(said, done.stdout)
        estimates = re.search(r"(\d+) estimates of at most 400 devices: .* counts takes 256, ", done.stdout)
        self.assertTrue(estimates, done.stdout)
        self.assertEqual(int(said[2]), 400 * int(estimates[1]))
        self.assertEqual(int(said[1]), 256 * int(estimates[1]) // 3)

    def test_a_study_of_the_device_file_and_the_choice_of_one(self):
        text = GALLERY.read_text().replace("</device>", '<study name="a" kind="sweep" as="drawn">' + SWEEP +
                                           '</study><study name="b" kind="worst-case" as="drawn">' +
                                           '<vary what="arc" from="200 deg" to="260 deg"/>' +
                                           '<respond name="U" value="governing.utilisation"/></study></device>')
        path = self.write(text, "device.xml")
        self.assertEqual(run("check", path, *FLOW).returncode, 0)
        path.write_text(text.replace("<device ", "<!-- no urn:flexwright:study:1 of its own --><device ", 1))
        done = run("study", path, *FLOW)
        self.assertEqual(done.returncode, 3)
        self.assertIn("name one with --study; there are a b", done.stderr)
        self.run_study(path, "a", "--study", "a")
        self.assertEqual(len(self.rows("a")), 8)
        worst = self.run_study(path, "b", "--study", "b")["responses"][0]
        ends = [json.loads(run("check", path, "--json", "--corners", "none", *FLOW, "--set",
                               f"arc={arc} deg").stdout)["governing"]["utilisation"] for arc in (200, 260)]
        self.assertEqual([worst["worst_least"]["value"], worst["worst_largest"]["value"]], sorted(ends))

    @only_all
    def test_why_a_device_could_not_be_judged_is_its_own(self):
        """near pull-in: those behind one that is not known had its reason in study.csv, and the reason was none"""
        leaf = '<flexure id="a" kind="leaf" length="400 um" width="6 um" fillet="6 um"/>'
        pins = "".join(f'<revolute id="{id}" a="{a}" a-x="{ax} mm" a-y="{ay} mm" b="{b}" b-x="{bx} mm" b-y="{by} mm" hinge="a" axis="{axis} deg"/>'
                       for id, a, ax, ay, b, bx, by, axis in (("A", "ground", 0, 0, "r", 0, -0.7, 0), ("B", "r", 0, 0.7, "c", -0.6, 0, 0),
                                                              ("C", "c", 0.6, 0, "s", 0, 0.7, 180), ("D", "s", 0, -0.7, "ground", 1.2, 0, 180)))
        path = self.write(
            '<device xmlns="urn:flexwright:device:1" name="near"><parameter name="volts" value="42 V" min="1 V" max="100 V"/>'
            '<material ref="silicon-100" youngs-modulus="169 GPa" strength="1.5 GPa" thickness="50 um"/><limits safety-factor="1"/>'
            f'<flow ref="silicon-on-glass"/>{leaf}<mechanism><body id="r" x="0 mm" y="0.7 mm" width="120 um"/>'
            f'<body id="c" x="0.6 mm" y="1.4 mm" width="160 um"/><body id="s" x="1.2 mm" y="0.7 mm" width="120 um"/>{pins}</mechanism>'
            '<scene name="drive" duration="5 ms"><comb-drive id="P" kind="plate" on="r" x="-60 um" y="0.1 mm" direction="180 deg" '
            'gap="8 um" length="300 um" voltage="volts" law="ramp" rise="4 ms"/><material-damping loss-factor="0.05"/></scene></device>',
            "near.xml")
        file = self.write(study("near", "yield", '<uncertain what="volts" mean="47 V" sd="0.8 V"/>', path, samples=300), "near-study.xml")
        done = run("study", file, "-o", self.place / "near", "--jobs", "2")
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.place / "near/study.csv", newline="") as text:
            rows = list(csv.DictReader(text))
        lost = [r for r in rows if r["state"] == "failed"]
        self.assertGreater(len(lost), 0)
        self.assertTrue(all("pulls in at" in r["why"] for r in lost), lost)
        self.assertTrue(all(r["why"] == "" for r in rows if r["state"] != "failed"))

    def test_a_yield_has_the_band_of_what_governs(self):
        """all dies are within what is required by less than its band: that they hold is not known, whatever hinges bear"""
        path = pathlib.Path(__file__).parents[1] / "data/turned-by-a-moment.xml"
        row = '<uncertain what="mo" mean="1.385 uN mm" sd="0.003 uN mm"/>'
        file = self.write(study("y", "yield", row, path, samples=200))
        found = self.run_study(file, "band")["yields"][0]
        self.assertGreater(found["sampling_interval"][0], 0.9)
        self.assertEqual(found["yield_range"], [0, 1])
        self.assertGreater(found["model_band"], 1.05)
        judged = json.loads(run("check", path, "--set", "mo=1.385 uN mm", "--json").stdout)
        self.assertEqual(judged["verdict"], "inconclusive")

    @only_all
    def test_a_load_that_no_check_follows_up_to_its_limit(self):
        """another check holds most dies at the same share: searches have no slope there, and go nowhere where inputs overflow"""
        path = pathlib.Path(__file__).parents[1] / "data/turned-by-a-moment.xml"
        row = '<uncertain what="pp" spread="lognormal" mean="1 uN" sd="0.3 uN"/>'
        found = self.run_study(self.write(study("y", "yield", row, path, samples=3000, seed=2)), "load")["yields"][0]
        s = math.sqrt(math.log(1.09))
        fails = 0.5 * math.erfc((math.log(3) + s * s / 2) / s / math.sqrt(2))
        least, most = found["sampling_interval"]
        self.assertTrue(1 - most <= 1.02 * fails and 0.98 * fails <= 1 - least, (fails, found))
        self.assertLess(most - least, fails)

    @only_all
    def test_a_yield_of_one_uncertain_load_is_that_of_its_limit(self):
        """U rises with the load, so a device fails where the load is beyond the one that uses the limit up"""
        path = self.write(ONE_LEAF, "one.xml")
        low = load_at_the_limit()
        for sigmas, samples in ((1.3, few(200)), (3.2, few(600))):
            sd = 0.25 * low / sigmas
            truth = 0.5 * math.erfc(-sigmas / math.sqrt(2))
            rows = f'<uncertain what="push" mean="{low - sigmas * sd:.9g} mN" sd="{sd:.9g} mN"/>'
            file = self.write(study("y", "yield", rows, path, samples=samples))
            result = self.run_study(file, f"y{sigmas}")
            found = result["yields"][0]
            least, most = found["sampling_interval"]
            slack = 5e-3 * (1 - truth)  # the root's, and that the study judges at the usual accuracy
            self.assertTrue(least - slack <= truth <= most + slack, (sigmas, truth, found))
            self.assertTrue(found["yield_range"][0] <= least and most <= found["yield_range"][1])
            if ALL and sigmas == 1.3:  # as likely in the other: nothing but the number of samples differs
                self.assertEqual(self.run_study(file, f"z{sigmas}", "--jobs", 1), result)

    def test_loads_that_scatter_together_and_by_a_table(self):
        """a device fails where the sum of two loads is beyond the limit: its deviation goes by how alike they are"""
        text = ONE_LEAF.replace('fx="push"', 'fx="push + pull"').replace(
            '<parameter name="push"', '<parameter name="pull" value="0 mN"/>\n  <parameter name="push"', 1)
        path = self.write(text, "two.xml")
        limit = load_at_the_limit()
        sd = 0.1 * limit
        rows = "".join(f'<uncertain what="{w}" mean="{0.5 * (limit - sd):.9g} mN" sd="{sd} mN"/>' for w in ("push", "pull"))
        yields = []
        for together in (0.9, -0.9):
            truth = 0.5 * math.erfc(-1 / math.sqrt(2 + 2 * together) / math.sqrt(2))
            asked = rows + f'<correlation of="push" with="pull" value="{together}"/>'
            found = self.run_study(self.write(study("y", "yield", asked, path, samples=few(300))), f"y{together}")["yields"][0]
            least, most = found["sampling_interval"]
            self.assertTrue(least - 5e-3 <= truth <= most + 5e-3, (together, truth, found["sampling_interval"]))
            yields.append(found["yield"])
        self.assertGreater(yields[1], yields[0] + 0.2)
        table = f'<uncertain what="push" spread="table" table="0.04 mN 0; {limit:.9g} mN 0.4; 0.45 mN 1"/>'
        file = self.write(study("y", "yield", table, path, samples=few(300)))
        least, most = self.run_study(file, "table")["yields"][0]["sampling_interval"]
        self.assertTrue(least - 5e-3 <= 0.4 <= most + 5e-3, (least, most))

    def test_a_table_has_units_of_several_symbols(self):
        """joined by a blank, '.', '*' or '/', as those of all values"""
        turned = ONE_LEAF.replace("push\" value=\"20 uN\"", "push\" value=\"1e-8 N m\"").replace(
            '<force on="bar" fx="push"', '<torque on="bar" value="push"')
        path = self.write(turned, "turned.xml")
        for unit in ("N m", "N.m", "N*m", "uN  mm", "kg m^2/s^2"):
            table = f'<uncertain what="push" spread="table" table="1e-8 {unit} 0;1.7e-8 {unit}  0.4 ; 2e-8 {unit} 1"/>'
            plan = run("study", self.write(study("y", "yield", table, path, samples=200)), "--plan")
            self.assertEqual(plan.returncode, 0, plan.stderr)

    def test_what_is_only_assumed_makes_a_range(self):
        """its ends are the yields of the two values themselves: the same devices, and never counted together"""
        path = self.write(ONE_LEAF, "leaf.xml")
        row = '<uncertain what="push" mean="0.17 mN" sd="0.04 mN"/>'
        assumed = row + '<uncertain what="length" spread="interval" from="380 um" to="420 um"/>'
        file = self.write(study("y", "yield", row, path, samples=few(200)), "one.xml")
        single = [self.run_study(file, f"y{length}", "--set", f"length={length} um") for length in (380, 420)]
        for length, said in zip((380, 420), single):
            self.assertEqual(said["set"], [{"path": "length", "value": f"{length} um"}])
            self.assertIn(f"length={length} um", (self.place / f"y{length}/study.html").read_text())
            self.assertEqual([said["yields"][0][end] for end in ("least", "most")], [None, None])
        least, most = sorted((s["yields"][0] for s in single), key=lambda y: y["yield"])
        self.assertGreater(most["yield"], least["yield"])
        done = run("study", self.write(study("y", "yield", assumed, path, samples=few(200)), "range.xml"), "-o", self.place / "r")
        both = json.loads((self.place / "r/study.json").read_text())
        self.assertEqual(both["set"], [])
        found = both["yields"][0]
        self.assertIsNone(found["yield"])
        for end, alone in ((found["least"], least), (found["most"], most)):
            for key in ("yield", "sampling_interval", "convergence"):
                self.assertEqual(end[key], alone[key])
        self.assertEqual({round(1e6 * e["assumed"][0]["value_SI"]) for e in (found["least"], found["most"])}, {380, 420})
        self.assertEqual(found["sampling_interval"], [least["sampling_interval"][0], most["sampling_interval"][1]])
        self.assertEqual([found["settings"], found["inside"]], [2, False])
        self.assertIn("nothing inside was estimated", found["sought"])
        self.assertIn(found["sought"], done.stdout)
        # and those that say that the ends are enough
        # (an estimate of the ends may take some hundred more than that of the middle: each looks both ways along its inputs)
        self.assertLess(found["devices"], 2 * found["devices_of_one_estimate"] + 600)
        for before, end in (("yield", least), (") to", most)):
            share = f"{100 * end['yield']:.2f}".rstrip("0").rstrip(".")
            self.assertIn(f"{before} {share} % (", done.stdout)
        self.assertIn(f'samples="{few(200)}" is the most for one estimate, and one took {found["devices_of_one_estimate"]}', done.stdout)

    def test_limits_that_oppose_each_other_have_the_most_inside(self):
        """a leaf that has to bend so far, and no farther: the one limit binds where it is short, the other where it is long"""
        rise = "<probe id=\"way\" kind=\"displacement\" on=\"bar\" direction=\"0 deg\"/>"
        limits = "".join(f'<require probe="way" measure="final" {end}="{value} um" scene="push"/>' for end, value in (("min", 9), ("max", 11)))
        device = ONE_LEAF.replace("  <scene", f"  {rise}\n  {limits}\n  <scene")
        way = run("check", self.write(device, "way.xml"), "--corners", "none", "--effects", "none", "-o", self.place / "way")
        at = [r["value"] for r in json.loads((self.place / "way/verdict.json").read_text())["requirements"]][0]
        mean = 20 * 10e-6 / at  # uN: 400 um long it goes 10 um
        path = self.write(device.replace('"20 uN"', f'"{mean:.6g} uN"'), "window.xml")
        row = f'<uncertain what="push" mean="{mean:.6g} uN" sd="{0.04 * mean:.6g} uN"/>'
        assumed = row + '<uncertain what="length" spread="interval" from="360 um" to="440 um"/>'
        file = self.write(study("y", "yield", row, path, samples=few(400)), "one.xml")
        alone = {length: self.run_study(file, f"y{length}", "--set", f"length={length} um", "--effects", "none")["yields"][0]
                 for length in (360, 400, 440)}
        file = self.write(study("y", "yield", assumed, path, samples=few(400)), "range.xml")
        plan = run("study", file, "--plan", "--effects", "none").stdout
        self.assertIn("more where the ends of what is only assumed do not do", plan)
        found = self.run_study(file, "window", "--effects", "none")["yields"][0]
        # 400 um: the way is 10 um, 4 % of it one standard deviation, and a tenth either way is 2.5
        truth = 2 * statistics.NormalDist().cdf(2.5) - 1
        self.assertTrue(alone[400]["sampling_interval"][0] - 5e-3 <= truth <= alone[400]["sampling_interval"][1] + 5e-3, (truth, alone[400]))
        self.assertGreater(alone[400]["yield"], max(alone[360]["yield"], alone[440]["yield"]) + 0.3)
        self.assertGreaterEqual(found["most"]["yield"], alone[400]["yield"] - 0.01)
        self.assertTrue(found["sampling_interval"][0] <= min(a["yield"] for a in alone.values()))
        self.assertTrue(found["inside"] and 2 < found["settings"] <= 18, found["settings"])
        self.assertLess(abs(1e6 * found["most"]["assumed"][0]["value_SI"] - 400), 6)
        self.assertIn("inside its ends", found["sought"])
        # the store has all of them: going on judges nothing and says the same
        again = run("study", file, "--resume", "--effects", "none", "-o", self.place / "window")
        self.assertEqual(json.loads((self.place / "window/study.json").read_text())["yields"][0], found)
        # where to look next is told by all dies, and a shard has a share of them
        shard = run("study", file, "--shard", "1/2", "--effects", "none", "-o", self.place / "shard")
        self.assertNotEqual(shard.returncode, 0)
        self.assertIn("inside what is only assumed", shard.stderr)

    def test_levels_and_places_are_those_of_the_closed_form(self):
        """U rises with the load alone, so that its levels are the load's, and a die holds where the load is below a limit"""
        path = self.write(ONE_LEAF.replace("</device>", '<wafer diameter="50.8 mm" flat="16 mm"/></device>'), "one.xml")
        mean, lot, wafer, radial = 0.157, 0.019, 0.019, 0.09
        rows = (f'<uncertain what="push" level="lot" mean="{mean} mN" sd="{lot} mN"/>'
                f'<uncertain what="push" level="wafer" sd="{wafer} mN"/><trend what="push" radial="{radial} mN"/>')
        file = self.write(study("y", "yield", rows, path, samples=few(400)))
        found = self.run_study(file, "y")["yields"][0]
        levels, rim = found["levels"], 25.4e-3
        squares = [(p["x_m"] ** 2 + p["y_m"] ** 2) / rim ** 2 for p in levels["places"]]
        self.assertGreater(len(squares), 20)
        average = sum(squares) / len(squares)
        place = radial ** 2 * sum((s - average) ** 2 for s in squares) / len(squares)
        every = lot ** 2 + wafer ** 2 + place
        for name, truth in (("lot", lot ** 2 / every), ("wafer", wafer ** 2 / every), ("place", place / every),
                            ("die", 0), ("hinge", 0)):
            least, most = levels["shares"][name]["interval"]
            self.assertTrue(least - 0.05 <= truth <= most + 0.05, (name, truth, levels["shares"]))  # U is not straight
        least, most = levels["dies_of_one_wafer"]["interval"]
        self.assertTrue(least - 0.05 <= (lot ** 2 + wafer ** 2) / every <= most + 0.05, levels)
        held = total = 0
        for p, s in zip(levels["places"], squares):
            truth = 0.5 * math.erfc((mean + radial * (s - 0.5) - load_at_the_limit()) / math.hypot(lot, wafer) / math.sqrt(2))
            least, most = p["yield"]["interval"]
            held, total = held + (least - 0.01 <= truth <= most + 0.01), total + truth
        self.assertGreaterEqual(held, 0.9 * len(squares))
        least, most = found["sampling_interval"]
        self.assertTrue(least - 0.01 <= total / len(squares) <= most + 0.01, (total / len(squares), found))
        self.assertLess(min(p["yield"]["value"] for p in levels["places"]) + 0.1,
                        max(p["yield"]["value"] for p in levels["places"]))
        steps = found["convergence"]
        self.assertEqual([steps[-1]["yield"], steps[-1]["sampling_interval"]], [found["yield"], found["sampling_interval"]])
        for name in ("wafer", "levels", "convergence"):
            self.assertTrue((self.place / f"y/pictures/{name}-one-leaf.svg").exists())

    def test_what_differs_from_hinge_to_hinge(self):
        """one width for all hinges and one for each: the second has less of a spread where the most strained one rules less"""
        rows = '<uncertain what="flexure[*]/@width" level="{}" mean="8 um" sd="0.2 um"/>'
        path = self.write(TWO_LEAVES, "two.xml")
        self.run_study(self.write(study("y", "yield", rows.format("hinge"), path, samples=few(200))), "h")
        self.run_study(self.write(study("y", "yield", rows.format("lot"), path, samples=few(200)), "lot.xml"), "l")
        # what few dies tell is told with its interval, shares and deviations, on the terminal and as JSON
        done = run("study", self.place / "lot.xml", "-o", self.place / "again")
        of = json.loads((self.place / "again/study.json").read_text())["yields"][0]["levels"]
        least, most = (round(100 * v) for v in of["shares"]["wafer"]["interval"])
        self.assertRegex(done.stdout, rf"devices use, \d+ % \(\d+ to \d+ %\) is from lot to lot, \d+ % \({least} to {most} %\) is from wafer to wafer")
        self.assertRegex(done.stdout, r"the yield of a wafer is off by [\d.]+ % \([\d.]+ to [\d.]+ %\), that of a lot by [\d.]+ % \([\d.]+ to [\d.]+ %\)")
        for name in ("wafers", "lots"):
            low, high = of[f"yield_deviation_of_{name}_interval"]
            self.assertTrue(low <= of[f"yield_deviation_of_{name}"] <= high)
        hinge, lot = (json.loads((self.place / f"{k}/study.json").read_text())["yields"][0]["levels"]["shares"] for k in "hl")
        self.assertEqual(hinge["lot"]["interval"][0], 0)
        self.assertGreater(hinge["hinge"]["value"], 0.6)
        self.assertGreater(lot["lot"]["value"], 0.6)
        self.assertEqual(lot["hinge"]["value"], 0)
        row = self.rows("h")[0]
        widths = [float(row[f"flexure[{k}]/@width"]) for k in ("first", "leaf")]
        self.assertEqual(len(set(widths)), 2)
        row = self.rows("l")[0]
        self.assertEqual(len({row[f"flexure[{k}]/@width"] for k in ("first", "leaf")}), 1)

    def test_a_size_is_within_a_percent_of_what_trying_everything_finds(self):
        """the widest hinge C that is accepted and keeps U below 0.7, as drawn"""
        rows = ('<vary what="flexure[C]/@width" from="6 um" to="12 um"/><vary what="arc" from="200 deg" to="260 deg"/>'
                '<respond name="U" value="governing.utilisation" max="0.7"/>'
                '<respond name="angle" value="hinges[C].limit_angle_rad" goal="{}"/>')
        path = self.write(study("s", "size", rows.format("minimise")).replace("<study", '<study as="drawn"'))
        found = self.run_study(path, "size")["found"]
        self.assertEqual(len(found), 1)
        grid = rows.format("none").replace('to="12 um"', f'to="12 um" steps="{49 if ALL else 25}"').replace(
            'to="260 deg"', 'to="260 deg" steps="5"')
        self.run_study(self.write(study("g", "sweep", grid).replace("<study", '<study as="drawn"')), "grid")
        tried = [float(r["angle"]) for r in self.rows("grid") if r["state"] == "accept" and float(r["U"]) <= 0.7]
        is_ = {r["name"]: r["value"] for r in found[0]["responses"]}
        # shares of a limit are in %, in the digits of a verdict, wherever somebody reads them
        page, share = (self.place / "size/study.html").read_text(), f"{100 * is_['U']:.3g} %"
        self.assertIn(f"U {share}, angle ", page)
        self.assertIn(f"<td>{share}</td>", page)
        self.assertIn("<td>70 %</td>", page)
        self.assertRegex((self.place / "size/pictures/U-arc.svg").read_text(), r">U \(%\)<")
        drawn = (self.place / "size/pictures/design-1.svg").read_text()
        used = max(float(u) for u in re.findall(r"</tspan>\s([\d.]+)\s%</text>", drawn))
        self.assertAlmostEqual(used, 100 * is_["U"], delta=0.06)  # the hinge that uses most, as the drawing writes it
        self.assertIn("<figcaption>Design 1", (self.place / "size/study.html").read_text())
        self.assertLessEqual(is_["angle"], 1.01 * min(tried))
        self.assertLessEqual(is_["U"], 0.7)
        sets = [w for s in found[0]["set"] for w in ("--set", f"{s['path']}={s['value']}")]
        said = run("check", GALLERY, "--json", "--corners", "none", *FLOW, *sets)
        self.assertEqual(said.returncode, 0, said.stderr)
        self.assertEqual(json.loads(said.stdout)["hinges"][2]["limit_angle_rad"], is_["angle"])
        none = rows.format("minimise").replace('max="0.7"', 'max="0.1"')
        done = self.run_study(self.write(study("s", "size", none).replace("<study", '<study as="drawn" samples="20"')),
                              "none", status=1)
        self.assertIn("no device was found", done.stdout)
        self.assertRegex(done.stdout, r"in the way: U is [\d.]+ %, and at most 10 % is asked for")
        nearest = json.loads((self.place / "none/study.json").read_text())["nearest"]
        self.assertEqual([t.split(" ")[0] for t in nearest["limits"]], ["U", "arc"])

    def test_of_the_nearest_device_is_said_what_check_refuses(self):
        rows = ('<vary what="push" from="0.2 mN" to="0.3 mN"/>'
                '<respond name="turned" value="hinges[A].peak_angle_rad" goal="minimise"/>')
        text = study("s", "size", rows, self.write(ONE_LEAF, "one.xml"), samples=8, **{"as": "drawn"})
        done = self.run_study(self.write(text), "refused", status=1)
        self.assertRegex(done.stdout, r"in the way: hinge A uses 1\d\d\.\d % of its ")

    def test_of_few_devices_the_end_of_a_range_is_one(self):
        path = self.write(ONE_LEAF, "one.xml")
        for goal, end in (("minimise", 0.15), ("maximise", 0.05)):
            rows = f'<vary what="push" from="0.05 mN" to="0.15 mN"/><respond name="turned" value="hinges[A].peak_angle_rad" goal="{goal}"/>'
            found = self.run_study(self.write(study("s", "size", rows, path, samples=10, **{"as": "drawn"})), goal)["found"]
            self.assertEqual(found[0]["set"], [{"path": "push", "value": f"{end} mN"}])
            self.assertEqual(found[0]["limits"], [f"push is at the end of its range, {end} mN"])

    def test_few_dies_are_enough_where_hardly_one_fails(self):
        """and the interval that is stated is that of these few"""
        rows = ('<vary what="push" from="50 uN" to="60 uN"/><uncertain what="push" sd="2 uN"/>'
                '<respond name="turned" value="hinges[A].peak_angle_rad" goal="minimise"/>')
        text = study("s", "size", rows, self.write(ONE_LEAF, "one.xml"), samples=6, **{"as": "drawn", "yield": 0.9})
        again = run("study", self.write(text), "-o", self.place / "few")
        self.assertEqual(again.returncode, 0, again.stderr)
        result = json.loads((self.place / "few/study.json").read_text())
        self.assertNotIn("is the most for one estimate", again.stdout)  # it is not of the dies
        found = result["yields"][0]
        self.assertEqual(result["found"][0]["verdict"], "accept")
        self.assertLess(found["devices_of_one_estimate"], 150)  # 400 of a device that is near what is wanted
        self.assertGreaterEqual(found["yield_range"][0], 0.925)

    def test_a_device_that_was_judged_and_has_the_yield_is_found(self):
        """five devices and no search: the best of them is too near its limit, the others are not"""
        rows = ('<vary what="push" from="0.11 mN" to="0.19 mN"/><uncertain what="push" sd="0.01 mN"/>'
                '<respond name="turned" value="hinges[A].peak_angle_rad" goal="minimise"/>')
        text = study("s", "size", rows, self.write(ONE_LEAF, "one.xml"), samples=6, **{"as": "drawn", "yield": 0.9})
        result = self.run_study(self.write(text), "judged")
        self.assertEqual(result["found"][0]["verdict"], "accept")
        self.assertGreaterEqual(result["yields"][0]["yield_range"][0], 0.9)
        # four of the five have the yield; the answer is the best of these
        judged = sorted((float(r["turned"]), 1e3 * float(r["push"])) for r in self.rows("judged"))
        self.assertEqual(len(judged), 5)
        self.assertGreater(judged[0][1] + 0.0128, load_at_the_limit())
        self.assertAlmostEqual(float(result["found"][0]["set"][0]["value"].split()[0]), judged[1][1], places=6)

    @unittest.skipUnless(ALL, "two thousand dies")
    def test_a_size_at_a_wanted_yield_keeps_as_many_deviations_from_the_limit(self):
        """the largest load is that of the limit, less the deviations that belong to the share that may fail"""
        path = self.write(ONE_LEAF, "one.xml")
        vary = '<vary what="push" from="0.1 mN" to="0.3 mN"/>'
        goal = '<respond name="turned" value="hinges[A].peak_angle_rad" goal="minimise"/>'

        def push(text, out):
            result = self.run_study(self.write(text), out)
            self.assertEqual(result["found"][0]["verdict"], "accept")
            return float(result["found"][0]["set"][0]["value"].split()[0]), result

        limit, _ = push(study("s", "size", vary + goal, path, **{"as": "drawn"}), "drawn")
        for wanted, deviations, slack in ((0.9, 1.2816, 0.35), (0.99, 2.3263, 0.12)):
            rows = vary + '<uncertain what="push" sd="0.01 mN"/>' + goal
            found, result = push(study("s", "size", rows, path, **{"as": "drawn", "yield": wanted}), f"yield{wanted}")
            self.assertEqual(result["wanted_yield"], wanted)
            self.assertGreaterEqual(result["yields"][0]["yield_range"][0], wanted)
            # not above it, but for what a search leaves; below by what intervals add
            off = (limit - found) / 0.01 - deviations
            self.assertTrue(-0.02 < off < slack, (limit, found, off))
            done = run("check", path, "--corners", "none", "--advice", "none", "-q", "--set", f"push={found} mN")
            self.assertEqual(done.returncode, 0)

    def test_derivatives_are_those_of_tight_runs(self):
        rows = ('<vary what="arc" from="230 deg" to="250 deg"/><vary what="flexure[C]/@width" from="7.5 um" to="8.5 um"/>'
                '<respond name="U" value="hinges[C].utilisation"/>')
        judged = "drawn" if ALL else "hinges"  # the same derivatives, without bodies, masks and clearances
        result = self.run_study(self.write(study("s", "sensitivity", rows, samples=160 if ALL else 128).replace("<study", f'<study as="{judged}"')), "s")
        by = {d["what"]: d for d in result["responses"][0]["by"]}
        at = {"arc": (240, "deg", math.pi / 180), "flexure[C]/@width": (8, "um", 1e-6)}
        for what, (centre, unit, factor) in at.items() if ALL else [*at.items()][1:]:
            step = centre * 1e-3
            u = []
            for k in (-2, -1, 1, 2):
                said = run("check", GALLERY, "--json", "--corners", "none", "--accuracy", "1e-10", *FLOW, "--set",
                           f"{what}={centre + k * step!r} {unit}")
                u.append(json.loads(said.stdout)["hinges"][2]["utilisation"])
            exact = (8 * (u[2] - u[1]) - (u[3] - u[0])) / (12 * step * factor)
            self.assertLess(abs(by[what]["derivative_SI"] / exact - 1), 1e-6, (what, exact, by[what]))
            self.assertLess(abs(by[what]["derivative_SI"] - exact), by[what]["derivative_error_SI"] + 1e-9 * abs(exact))
        self.assertAlmostEqual(sum(d["first"] for d in by.values()), 1, delta=0.1)
        # those that the shares are of are as accurate as check, and not as the others
        row = self.rows("s")[11 * len(at) + 7]
        sets = [w for what, (_, unit, factor) in at.items() for w in ("--set", f"{what}={float(row[what]) / factor!r} {unit}")]
        said = json.loads(run("check", GALLERY, "--json", "--corners", "none", *FLOW, *sets).stdout)
        self.assertLess(abs(float(row["U"]) / said["hinges"][2]["utilisation"] - 1), 1e-12)

    def test_a_plan_of_a_sensitivity_says_the_time_that_it_takes(self):
        """of a processor, within a factor of two: some of its devices are run at 1e-9. One of three, since other processes slow either"""
        rows = '<vary what="flexure[C]/@width" from="7 um" to="9 um"/><respond name="U" value="hinges[C].utilisation"/>'
        path = self.write(study("s", "sensitivity", rows, samples=128).replace("<study", '<study as="hinges"'))
        ratios = []
        for attempt in range(3):
            said = run("study", path, "--plan", "--jobs", 1, *FLOW).stdout
            planned = re.search(r"at most (\d+) devices in 1 threads, about ([0-9.]+) s .*; the 11 that derivatives are taken from are run at 1e-9, [0-9.e-]+ s each", said)
            self.assertTrue(planned, said)
            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            self.run_study(path, f"s{attempt}", "--jobs", 1)
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
            self.assertEqual(int(planned[1]), len(self.rows(f"s{attempt}")))
            ratios.append((after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime) / float(planned[2]))
            if 0.5 < ratios[-1] < 2:
                return
        self.fail(ratios)


if __name__ == "__main__":
    unittest.main()
