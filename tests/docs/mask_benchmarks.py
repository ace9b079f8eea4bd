#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/mask-benchmarks.md is what its CSV says, and our rows in it keep what is promised of masks: vertices within the grid's 0.71 nm
of the exact arcs, no edge below 5 nm, and GEOS's clearance at least 0.9 of the shortest chord."""
import csv
import pathlib
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "bench"))
import mask_peers  # noqa: E402

problems = []
with mask_peers.DATA.open(newline="", encoding="utf-8") as file:
    rows = list(csv.DictReader(file))
if mask_peers.PAGE.read_text(encoding="utf-8") != "".join(mask_peers.page(rows)):
    problems.append("docs/mask-benchmarks.md is not what its CSV says: tests/bench/mask_peers.py --report")
ours = [r for r in rows if r["task"] == "bias" and r["tool"] == "Flexwright"]
if len(ours) < 2:
    problems.append("rows are missing")
for r in ours:
    if max(-float(r["error_low_nm"]), float(r["error_high_nm"])) > 0.71:
        problems.append(r["setting"] + ": a vertex is farther than 0.71 nm from its arc")
    if int(r["short_edges"]) or float(r["clearance_nm"]) < 0.9 * float(r["shortest_nm"]):
        problems.append(r["setting"] + ": slivers")
print("\n".join(problems) or "%d rows" % len(rows))
sys.exit(1 if problems else 0)
