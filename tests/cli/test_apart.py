#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A process pack that says by how much hinges of one device differ decides the verdict of the reference six-bar."""
import json
import os
import pathlib
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


if __name__ == "__main__":
    unittest.main()
