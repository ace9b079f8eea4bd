#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""test_docs.py BUILD: the snippets of docs/python.md run from the top of the source tree and the cells of
docs/tutorial.ipynb from its own folder, as a notebook's kernel does, and print what the pages say they do."""
import contextlib
import io
import json
import os
import re
import sys
import tempfile
import types
import unittest

import common
from common import ROOT



class Plot(types.ModuleType):
    """Stands in for matplotlib.pyplot where it is not installed: remembers what was drawn."""

    drawn = []

    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        return lambda *arguments, **named: self.drawn.append((name, arguments))


def plotting():
    if "matplotlib.pyplot" in sys.modules:
        return
    try:
        import matplotlib
        matplotlib.use("Agg")
    except ImportError:
        parent = types.ModuleType("matplotlib")
        parent.pyplot = Plot("matplotlib.pyplot")
        sys.modules["matplotlib"] = parent
        sys.modules["matplotlib.pyplot"] = parent.pyplot


class Pages(unittest.TestCase):
    """Snippets in their order, in one name space, as a reader would type them."""

    def setUp(self):
        self.directory = tempfile.TemporaryDirectory()
        self.before = os.getcwd()
        for name in ("docs", "processes", "masks"):  # what the snippets write goes elsewhere
            os.symlink(ROOT / name, os.path.join(self.directory.name, name))
        os.mkdir(os.path.join(self.directory.name, "out"))
        os.chdir(self.directory.name)
        plotting()

    def tearDown(self):
        os.chdir(self.before)
        self.directory.cleanup()

    def run_all(self, snippets, file):
        space, printed = {"__name__": "__main__"}, io.StringIO()
        for i, (line, code) in enumerate(snippets):
            with contextlib.redirect_stdout(printed):
                try:
                    exec(compile("\n" * line + code, file, "exec"), space)
                except BaseException as error:
                    raise AssertionError(f"{file}, snippet {i + 1}: {error}") from error
        return space, printed.getvalue().splitlines()

    def test_python_page(self):
        text = (ROOT / "docs/python.md").read_text()
        found = [(text[:m.start(1)].count("\n"), m.group(1))
                 for m in re.finditer(r"^```python\n(.*?)^```", text, re.M | re.S)]
        self.assertGreater(len(found), 9)
        space, printed = self.run_all(found, "docs/python.md")
        self.assertIn("4.014257279586958 rad", printed)
        self.assertIn("('step-load', 'gentle-step')", printed)
        self.assertIn("(2001,) (2001, 3)", printed)
        self.assertTrue(any(line.startswith("x.xml:1:") for line in printed))
        self.assertIn("accept", printed)
        self.assertIn("True", printed)  # the longer hinge
        self.assertTrue(os.path.exists("out/from-python/verdict.json"))
        self.assertEqual(len(space["rows"]["arc"]), 6)
        if Plot.drawn:
            self.assertEqual([name for name, _ in Plot.drawn], ["scatter", "ylabel", "savefig"])

    def test_notebook(self):
        book = json.loads((ROOT / "docs/tutorial.ipynb").read_text())
        self.assertEqual(book["nbformat"], 4)
        ids = [cell["id"] for cell in book["cells"]]
        self.assertEqual(len(ids), len(set(ids)))
        code = [(0, "".join(cell["source"])) for cell in book["cells"] if cell["cell_type"] == "code"]
        self.assertGreater(len(code), 6)
        os.chdir("docs")
        space, printed = self.run_all(code, "docs/tutorial.ipynb")
        for cell in book["cells"]:  # the last line of a cell is shown: it can be
            if cell["cell_type"] != "code":
                continue
            self.assertEqual(cell["outputs"], [])
            last = "".join(cell["source"]).splitlines()[-1]
            if re.fullmatch(r"[\w.]+(\[.*\])?", last):
                shown = eval(last, space)
                picture = getattr(shown, "_repr_html_", None)
                self.assertTrue(picture() if picture else repr(shown))
        self.assertIn("accept", printed)


if __name__ == "__main__":
    assert common.BUILD
    unittest.main()
