#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Devices of the gallery as whole solids, without solving any: what tools/solids/gallery.csv has of them lies in the bands of what the
program says today, or docs/gallery/truth.md says why not, and that page has the program's numbers of today.

    tests/docs/gallery_solids.py PROGRAM"""
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools/solids"))
import truth  # noqa: E402  (after its path)

rows = truth.read()
problems, page = truth.compared(pathlib.Path(sys.argv[1]).resolve(), rows)
if page != truth.PAGE.read_text(encoding="utf-8"):
    problems.append("docs/gallery/truth.md is not what the table and the program say: tools/solids/gallery --page")
print("\n".join(problems) or f"{len(rows)} quantities of solids in their bands")
sys.exit(1 if problems else 0)
