#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""coupons.py: the test die of every flow has what its steps read. Each coupon that a measurement names is a pattern of
masks/FLOW.xml, and so is each kind of pattern that an endpoint, a purpose or a measurement of the test die speaks of."""
import pathlib
import re
import sys
import xml.etree.ElementTree as tree

ROOT = pathlib.Path(__file__).resolve().parents[2]
SPOKEN = {  # words about the test die: the kind of pattern that they mean
    "release ladder": "release-holes", "ladder": "undercut-ladder", "slots": "arde-slots", "beams": "cantilevers",
    "pointer": "stress-pointer", "pads of the test die": "plating-pads",
}
problems, asked, spoken = [], 0, 0


def name(element):
    return element.tag.split("}")[-1]


for pack in sorted((ROOT / "processes").glob("*.xml")):
    table = ROOT / "masks" / pack.name
    if not table.exists():
        continue  # base.xml: what packs share
    patterns = [e for e in tree.parse(table).iter() if name(e) == "pattern"]
    ids, kinds = {e.get("id") for e in patterns}, {e.get("kind") for e in patterns}
    if any(e.get("reach") for e in tree.parse(pack).iter() if name(e) == "change") and "release-holes" not in kinds:
        problems.append(f"{pack.stem} releases, and {table.name} has no release-holes to stop by")
    for step in (e for e in tree.parse(pack).iter() if name(e) == "step"):
        where = f"{pack.stem} {step.get('id')}"
        for e in step.iter():
            if name(e) == "accept" and e.get("coupon"):
                asked += 1
                if e.get("coupon") not in ids:
                    problems.append(f"{where} measures {e.get('coupon')}, which {table.name} does not have")
            told = e.text or "" if name(e) in ("endpoint", "purpose", "instruction") else ""
            if "test die" not in told:
                continue
            left = told.lower()
            for words, kind in SPOKEN.items():
                if words not in left:
                    continue
                left = left.replace(words, "")
                spoken += 1
                if kind not in kinds:
                    problems.append(f"{where} reads the {words} of the test die, and {table.name} has no {kind}")
print("\n".join(problems) or f"{asked} coupons measured, {spoken} times a pattern spoken of: all on their test dies")
sys.exit(1 if problems or asked == 0 else 0)
