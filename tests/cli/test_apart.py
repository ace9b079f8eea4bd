#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A process pack that says by how much hinges of one device differ decides the verdict of the reference six-bar."""
import json
import os
import pathlib
import re
import shutil
import tempfile
import unittest

from common import FLOWS, GALLERY, ROOT, run


class Apart(unittest.TestCase):
    def judged(self, apart_um=None):
        """the verdict in the silicon flow, whose pack says that edges differ by that much from hinge to hinge"""
        here = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, here)
        for folder in ("processes", "masks"):
            shutil.copytree(ROOT / folder, here / folder, ignore=shutil.ignore_patterns("gallery"))
        pack = here / f"processes/{FLOWS[0]}.xml"
        if apart_um is not None:
            corner = '<corner of="thickness"'
            text = pack.read_text()
            self.assertEqual(text.count(corner), 1)
            own = (f'<q id="made.apart" value="0" lo="-{apart_um}" hi="{apart_um}" unit="um" status="measured" src="neighbours" range="edge"/>\n'
                   '  <corner of="local" name="edge from hinge to hinge" q="made.apart"/>\n  ')
            source = '<source id="neighbours" kind="measured" date="2026-11-01">widths of neighbouring hinges of one die</source>\n  '
            text = text.replace(corner, own + corner).replace("<source ", source + "<source ", 1)
            pack.write_text(text)
        done = run("check", GALLERY, "--flow", FLOWS[0], "--json", env={**os.environ, "FLEXWRIGHT_DATA": str(here)})
        self.assertIn(done.returncode, (0, 4), done.stderr)
        return json.loads(done.stdout)

    def test_it_decides(self):
        alike, little, much = self.judged(), self.judged("0.05"), self.judged("0.3")
        self.assertEqual((alike["verdict"], little["verdict"], much["verdict"]), ("accept", "accept", "inconclusive"))
        used = [v["governing"]["utilisation"] for v in (alike, little, much)]
        # a load: 3 dt/t of the stiffness of one hinge, and less of what the others take over
        self.assertTrue(1.005 * used[0] < used[1] < 1.06 * used[0], used)
        self.assertGreater(used[2], 1.1 * used[0])
        self.assertRegex(much["governing"]["corner"], r"edge from hinge to hinge 0.3 um, .*narrower: A [A-F ]+$")
        self.assertNotIn("narrower", json.dumps(alike["hinges"]))
        # what would have to be known is tried with the hinges as they differ there
        self.assertRegex(json.dumps(much["reasons"]), r"accepted where [^\"]* is known to be at (most|least)")


class Nearest(unittest.TestCase):
    """Two jaws that keep 32 um as drawn, and next to nothing at the corner of the flow where they go farthest."""

    def judged(self, pull_uN):
        jaws = ROOT / "tests/data/jaws-that-close.xml"
        pulls = [f"--set=tendon[{cable}]/@pull={pull_uN} uN" for cable in ("cable-1", "cable-1-mirrored")]
        done = run("check", jaws, *pulls, "--json")
        self.assertIn(done.returncode, (0, 3, 4), done.stderr)
        return json.loads(done.stdout)

    def test_the_line_says_which_it_is_and_has_the_least_as_made(self):
        told = self.judged(49.7)
        self.assertEqual(told["verdict"], "accept")
        line = {x["label"]: x["text"] for x in told["summary"]}["nearest, as made at the corners run"]
        made, drawn = re.match(r"link part-1 and link part-1-mirrored (\S+) um \(\S+ to \S+\) in scene-1, with .*; as drawn (\S+) um \(\S+ to \S+\)$", line).groups()
        self.assertAlmostEqual(float(drawn), 1e6 * told["clearances"][0]["clearance_m"], delta=0.06)
        # 0.3 uN more, and the corner itself says what is left there
        more = self.judged(50)["flows"][0]["as_fabricated"]["corners"][-1]["why"]
        left = float(re.search(r"(\S+) um as made", more)[1])
        self.assertTrue(left < float(made) < left + 1, (left, made))

    def test_where_no_corner_counts_it_is_as_drawn(self):
        labels = [x["label"] for x in self.judged(10)["summary"]]
        self.assertIn("nearest, as drawn", labels)

    def test_the_share_that_would_just_not_meet(self):
        def why(pull_uN):
            return self.judged(pull_uN)["flows"][0]["as_fabricated"]["corners"][-1]["why"] or ""
        pull = 50.9
        share = float(re.search(r"with (\S+) % of that motion they would just not meet", why(pull))[1]) / 100
        self.assertNotRegex(why(pull * (share - 0.002)), r"mirrored meet in")
        self.assertRegex(why(pull * (share + 0.003)), r"mirrored meet in")



if __name__ == "__main__":
    unittest.main()
